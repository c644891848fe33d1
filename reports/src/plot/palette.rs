//! Colours: one for each method wherever it appears, and colour maps for fields.
//!
//! Methods take the colours of Okabe and Ito (2008) and of P. Tol's muted scheme, which stay apart
//! for colour-blind readers.

use plotters::style::RGBColor;

/// Text and axes.
pub const INK: RGBColor = RGBColor(0x22, 0x22, 0x22);
/// Secondary text.
pub const SOFT: RGBColor = RGBColor(0x66, 0x66, 0x66);
/// Grid lines.
pub const GRID: RGBColor = RGBColor(0xe6, 0xe6, 0xe6);
/// The reference under the methods.
pub const REFERENCE: RGBColor = RGBColor(0xc4, 0xc4, 0xc4);
/// A range that is shaded.
pub const BAND: RGBColor = RGBColor(0xf6, 0xd9, 0xd5);
/// Paper.
pub const PAPER: RGBColor = RGBColor(0xff, 0xff, 0xff);

const NAMED: [(&str, RGBColor); 12] = [
    ("fixed", RGBColor(0xd5, 0x5e, 0x00)),
    ("roller", RGBColor(0xd5, 0x5e, 0x00)),
    ("dashpot", RGBColor(0xe6, 0x9f, 0x00)),
    ("damping-layer", RGBColor(0x00, 0x9e, 0x73)),
    ("pml", RGBColor(0x00, 0x72, 0xb2)),
    ("pml-20", RGBColor(0x33, 0x22, 0x88)),
    ("pml-50", RGBColor(0xcc, 0x66, 0x99)),
    ("pml-stretched", RGBColor(0x56, 0xb4, 0xe9)),
    ("penalty", RGBColor(0xcc, 0x79, 0xa7)),
    ("extended", RGBColor(0x55, 0x55, 0x55)),
    ("hybrid-rate", RGBColor(0x66, 0x11, 0x00)),
    ("free", RGBColor(0xaa, 0x44, 0x99)),
];

const OTHERS: [RGBColor; 6] = [
    RGBColor(0x33, 0x22, 0x88),
    RGBColor(0x44, 0xaa, 0x99),
    RGBColor(0x99, 0x99, 0x33),
    RGBColor(0x88, 0x22, 0x55),
    RGBColor(0x66, 0x11, 0x00),
    RGBColor(0x7f, 0x7f, 0xc8),
];

/// The colour of a method: fixed for the known ones (`fixed` and `roller`, which never meet, share
/// theirs), by a hash of the name for others; a variant `METHOD/VARIANT` has that of its method.
pub fn method(name: &str) -> RGBColor {
    let name = name.split('/').next().unwrap_or(name);
    if let Some((_, colour)) = NAMED.iter().find(|(known, _)| *known == name) {
        return *colour;
    }
    // FNV-1a: stable between builds, unlike the standard hasher.
    let hash = name.bytes().fold(0xcbf2_9ce4_8422_2325_u64, |h, byte| {
        (h ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    });
    OTHERS[(hash % OTHERS.len() as u64) as usize]
}

/// The colour of a series in a picture: that of the method if it is named like a known one, else the
/// next of those that no method has.
pub fn series(name: &str, index: usize) -> RGBColor {
    if NAMED.iter().any(|(known, _)| *known == name) {
        return method(name);
    }
    OTHERS[index % OTHERS.len()]
}

/// Blue over white to red for `-1..1`: the scheme RdBu of ColorBrewer (Brewer and Harrower),
/// interpolated.
pub fn diverging(value: f64) -> RGBColor {
    const STOPS: [[u8; 3]; 11] = [
        [0x05, 0x30, 0x61],
        [0x21, 0x66, 0xac],
        [0x43, 0x93, 0xc3],
        [0x92, 0xc5, 0xde],
        [0xd1, 0xe5, 0xf0],
        [0xf7, 0xf7, 0xf7],
        [0xfd, 0xdb, 0xc7],
        [0xf4, 0xa5, 0x82],
        [0xd6, 0x60, 0x4d],
        [0xb2, 0x18, 0x2b],
        [0x67, 0x00, 0x1f],
    ];
    interpolate(&STOPS, 0.5 + 0.5 * value)
}

/// Dark blue over green to yellow for `0..1`: viridis (van der Walt and Smith), interpolated.
pub fn sequential(value: f64) -> RGBColor {
    const STOPS: [[u8; 3]; 11] = [
        [0x44, 0x01, 0x54],
        [0x48, 0x24, 0x75],
        [0x41, 0x44, 0x87],
        [0x35, 0x5f, 0x8d],
        [0x2a, 0x78, 0x8e],
        [0x21, 0x91, 0x8c],
        [0x22, 0xa8, 0x84],
        [0x42, 0xbe, 0x71],
        [0x7a, 0xd1, 0x51],
        [0xbd, 0xdf, 0x26],
        [0xfd, 0xe7, 0x25],
    ];
    interpolate(&STOPS, value)
}

fn interpolate(stops: &[[u8; 3]; 11], share: f64) -> RGBColor {
    let at = share.clamp(0.0, 1.0) * (stops.len() - 1) as f64;
    let lower = (at as usize).min(stops.len() - 2);
    let part = at - lower as f64;
    let channel = |c: usize| {
        let (a, b) = (f64::from(stops[lower][c]), f64::from(stops[lower + 1][c]));
        (a + part * (b - a)).round() as u8
    };
    RGBColor(channel(0), channel(1), channel(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_method_keeps_its_colour() {
        assert_eq!(method("pml"), RGBColor(0x00, 0x72, 0xb2));
        assert_eq!(method("springs"), method("springs"));
        let named: Vec<RGBColor> = ["fixed", "dashpot", "damping-layer", "extended", "pml"]
            .map(method)
            .to_vec();
        for (i, colour) in named.iter().enumerate() {
            assert!(!named[..i].contains(colour));
        }
    }

    #[test]
    fn maps_meet_their_ends_and_centre() {
        assert_eq!(diverging(0.0), RGBColor(0xf7, 0xf7, 0xf7));
        assert_eq!(diverging(-9.0), RGBColor(0x05, 0x30, 0x61));
        assert_eq!(diverging(1.0), RGBColor(0x67, 0x00, 0x1f));
        assert_eq!(sequential(0.0), RGBColor(0x44, 0x01, 0x54));
        assert_eq!(sequential(1.0), RGBColor(0xfd, 0xe7, 0x25));
    }
}
