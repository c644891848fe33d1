//! Bearing of a shallow pipe in clay by slip lines.
//!
//! Source: Prandtl's fan between an inclined face and free level ground (e.g. Hill, The Mathematical
//! Theory of Plasticity, 1950, chapter IX), taken for each element of the wetted arc; phi is the angle
//! of the element to the horizontal. Below the ground's wedge, at 45 degrees and mean stress s_u, the
//! mean stress grows by 2 s_u times the angle of the fan:
//!
//! ```text
//! smooth   slip lines at 45 degrees to the face: fan pi/2 - phi
//!          p = s_u (2 + pi - 2 phi),      t = 0
//! rough    a slip line along the face: fan 3 pi/4 - phi
//!          p = s_u (1 + 3 pi/2 - 2 phi),  t = s_u
//!
//! F = D integral over 0..beta of (p cos phi + t sin phi) d phi,   sin beta = b = 2 sqrt(x - x^2)
//!
//! smooth   F/(D s_u) = (2 + pi) b - 2 (b beta + cos beta - 1)
//! rough    F/(D s_u) = (1 + 3 pi/2) b - 2 (b beta + cos beta - 1) + (1 - cos beta)
//! ```
//!
//! with x = w/D the embedment of the invert. F is the force on the whole pipe, both halves, per metre.
//!
//! **Assumptions**: level ground at its old height (no heave), fans that do not hinder each other, no
//! weight of the soil and no strength in the ground beside the pipe: heave and depth add a few per cent.
//! A rough pipe slips along all of its arc; near x = 0 a wedge that sticks to it would be weaker
//! (2 + pi instead of 1 + 3 pi/2 on the width), so that there the rough value is too high.

use std::f64::consts::{FRAC_PI_2, PI};
use thiserror::Error;

/// An embedment that the slip lines do not serve.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error(
    "embedment w/D = {embedment} of the pipe is out of range: use 0 up to 0.5, where the pipe is as wide at the ground as it gets"
)]
pub struct EmbedmentError {
    /// w/D as given.
    pub embedment: f64,
}

/// Between pipe and soil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interface {
    /// No shear.
    Smooth,
    /// Shear up to the soil's strength.
    Rough,
}

/// Normal pressure over s_u on a face at the angle `phi` (rad) to the horizontal.
pub fn pressure(interface: Interface, phi: f64) -> f64 {
    match interface {
        Interface::Smooth => 2.0 + PI - 2.0 * phi,
        Interface::Rough => 1.0 + 3.0 * FRAC_PI_2 - 2.0 * phi,
    }
}

/// F/(D s_u) at embedment `x` = w/D.
pub fn bearing_factor(interface: Interface, x: f64) -> Result<f64, EmbedmentError> {
    let width = width(x)?;
    let (beta, cosine) = (width.asin(), 1.0 - 2.0 * x);
    let flat = pressure(interface, 0.0) * width - 2.0 * (width * beta + cosine - 1.0);
    Ok(match interface {
        Interface::Smooth => flat,
        Interface::Rough => flat + 1.0 - cosine,
    })
}

/// F/(D s_u) of a smooth pipe at embedment `x` = w/D as fitted to finite element runs with large
/// deformation: 5.3 x^0.25 (Merifield, White, Randolph 2009, Geotechnique 59; the coefficients as
/// commonly quoted, not checked against the paper). Evidence of kind `paper`: it has heave, so that it
/// lies above the slip line.
pub fn merifield_smooth(x: f64) -> Result<f64, EmbedmentError> {
    width(x)?;
    Ok(5.3 * x.powf(0.25))
}

/// B/D, the wetted width.
fn width(x: f64) -> Result<f64, EmbedmentError> {
    if (0.0..=0.5).contains(&x) {
        return Ok(2.0 * (x - x * x).sqrt());
    }
    Err(EmbedmentError { embedment: x })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::quadrature::GaussLegendre;
    use crate::stored::Table;

    const BOTH: [Interface; 2] = [Interface::Smooth, Interface::Rough];

    fn table() -> Table {
        let text = include_str!("../../data/pipe_bearing.csv");
        Table::parse("pipe_bearing.csv", text).unwrap()
    }

    #[test]
    fn agrees_with_the_independent_table() {
        let table = table();
        let column = |name| table.column(name).unwrap();
        assert_eq!(table.rows(), 8);
        for i in 0..table.rows() {
            let x = column("w/D")[i];
            let own = [
                (width(x).unwrap(), column("B/D")[i]),
                (
                    bearing_factor(Interface::Smooth, x).unwrap(),
                    column("slip_smooth")[i],
                ),
                (
                    bearing_factor(Interface::Rough, x).unwrap(),
                    column("slip_rough")[i],
                ),
                (merifield_smooth(x).unwrap(), column("Merifield_smooth")[i]),
            ];
            for (own, stored) in own {
                assert!((own - stored).abs() < 6e-5, "{x}: {own}, {stored}");
            }
        }
    }

    /// The force by quadrature over the arc, with the shear written out.
    #[test]
    fn the_closed_form_is_the_integral_over_the_arc() {
        let rule = GaussLegendre::new(16);
        for interface in BOTH {
            let shear = match interface {
                Interface::Smooth => 0.0,
                Interface::Rough => 1.0,
            };
            for x in [0.01_f64, 0.1, 0.172, 0.35, 0.5] {
                let beta = (1.0 - 2.0 * x).acos();
                let force: f64 = rule
                    .on(0.0, beta)
                    .map(|(phi, w)| w * (pressure(interface, phi) * phi.cos() + shear * phi.sin()))
                    .sum();
                let own = bearing_factor(interface, x).unwrap();
                assert!((own - force).abs() < 1e-12, "{interface:?} {x}");
            }
        }
    }

    /// A trace of a pipe is a strip: Prandtl's 2 + pi on the width.
    #[test]
    fn a_shallow_smooth_pipe_is_prandtls_strip() {
        let x = 1e-8;
        let on_width = bearing_factor(Interface::Smooth, x).unwrap() / width(x).unwrap();
        assert!((on_width - (2.0 + PI)).abs() < 1e-3);
        assert_eq!(bearing_factor(Interface::Smooth, 0.0), Ok(0.0));
    }

    #[test]
    fn a_pipe_in_to_its_middle_has_the_round_values() {
        let at_half = |interface| bearing_factor(interface, 0.5).unwrap();
        assert!((at_half(Interface::Smooth) - 4.0).abs() < 1e-14);
        assert!((at_half(Interface::Rough) - (4.0 + FRAC_PI_2)).abs() < 1e-14);
        // A vertical smooth face is Rankine's wall: 2 s_u.
        assert!((pressure(Interface::Smooth, FRAC_PI_2) - 2.0).abs() < 1e-15);
    }

    #[test]
    fn force_grows_with_depth_and_roughness_and_stays_below_the_fit() {
        let mut before = [0.0; 2];
        for n in 1..=50 {
            let x = 0.01 * f64::from(n);
            let own = BOTH.map(|interface| bearing_factor(interface, x).unwrap());
            assert!(own[0] > before[0] && own[1] > before[1] && own[1] > own[0]);
            assert!(merifield_smooth(x).unwrap() > own[0], "{x}");
            before = own;
        }
    }

    #[test]
    fn embedments_outside_are_refused() {
        for x in [-0.01, 0.51, f64::NAN] {
            assert!(bearing_factor(Interface::Smooth, x).is_err());
            assert!(merifield_smooth(x).is_err());
        }
        let error = bearing_factor(Interface::Rough, 0.6)
            .unwrap_err()
            .to_string();
        assert!(error.contains("w/D = 0.6"), "{error}");
    }
}
