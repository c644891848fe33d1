//! Numbers as readers want them: few digits, readable sizes.

use anechoic_reference::claim::Accept;

/// `value` with three significant digits; powers of ten outside 1e-3 .. 1e6.
pub fn number(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if !value.is_finite() {
        return value.to_string();
    }
    // Rounded first, so that 0.9996 counts as 1.00 and not as 1.000.
    let scientific = format!("{value:.2e}");
    let exponent = scientific
        .split_once('e')
        .and_then(|(_, e)| e.parse::<i32>().ok())
        .expect("the format e always writes an integer exponent");
    match exponent {
        -3..=2 => format!("{value:.*}", (2 - exponent) as usize),
        3..=5 => grouped(value.round()),
        _ => scientific,
    }
}

/// As [`number`], without zeros at the end of a fraction: `0.8`, `2`.
pub fn short(value: f64) -> String {
    let text = number(value);
    if text.contains('.') && !text.contains('e') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// A whole number with thousands set apart: `120 000` with narrow no-break spaces.
pub fn count(value: usize) -> String {
    grouped(value as f64)
}

/// Bytes in the largest fitting binary unit.
pub fn bytes(value: f64) -> String {
    const UNITS: [&str; 4] = ["KiB", "MiB", "GiB", "TiB"];
    if value < 1024.0 {
        return format!("{value:.0} B");
    }
    let mut scaled = value / 1024.0;
    let mut unit = 0;
    while scaled >= 1024.0 && unit + 1 < UNITS.len() {
        scaled /= 1024.0;
        unit += 1;
    }
    format!("{} {}", number(scaled), UNITS[unit])
}

/// A value in its unit, as tables show it.
pub fn with_unit(value: f64, unit: &str) -> String {
    match unit {
        "1" | "" => number(value),
        "B" => bytes(value),
        _ => format!("{} {unit}", number(value)),
    }
}

/// What is accepted, for people: `≤ 0.0100`, `≥ 1.00`, `1.60 … 2.20`.
pub fn accept(accept: &Accept) -> String {
    match (accept.min, accept.max) {
        (Some(min), Some(max)) => format!("{} … {}", number(min), number(max)),
        (None, Some(max)) => format!("≤ {}", number(max)),
        (Some(min), None) => format!("≥ {}", number(min)),
        (None, None) => "anything".to_owned(),
    }
}

fn grouped(value: f64) -> String {
    let digits = format!("{:.0}", value.abs());
    let mut text = if value < 0.0 {
        "-".to_owned()
    } else {
        String::new()
    };
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_digits_at_any_size() {
        assert_eq!(number(0.0), "0");
        assert_eq!(number(0.004_567), "0.00457");
        assert_eq!(number(-12.345), "-12.3");
        assert_eq!(number(0.9996), "1.00");
        assert_eq!(number(999.6), "1\u{202f}000");
        assert_eq!(number(4.2e-7), "4.20e-7");
        assert_eq!(number(60_701.0), "60\u{202f}701");
        assert_eq!(number(1.5e9), "1.50e9");
        assert_eq!(short(0.8), "0.8");
        assert_eq!(short(2.0), "2");
        assert_eq!(short(100.0), "100");
        assert_eq!(count(1_234_567), "1\u{202f}234\u{202f}567");
    }

    #[test]
    fn bytes_and_bounds() {
        assert_eq!(bytes(512.0), "512 B");
        assert_eq!(bytes(1536.0), "1.50 KiB");
        assert_eq!(bytes(3.0 * 1024f64.powi(3)), "3.00 GiB");
        assert_eq!(accept(&Accept::within(1.6, 2.2)), "1.60 … 2.20");
        assert_eq!(accept(&Accept::at_most(0.01)), "≤ 0.0100");
        assert_eq!(with_unit(2.0, "s"), "2.00 s");
    }
}
