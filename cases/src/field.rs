//! What a scene's fields are called and what they may hold: data, from which overlays are checked,
//! errors name the allowed range, and `show --toml` writes its comments.

use std::fmt;

/// A range of numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lower end.
    pub min: f64,
    /// Is the lower end itself excluded?
    pub min_open: bool,
    /// Upper end.
    pub max: f64,
    /// Is the upper end itself excluded?
    pub max_open: bool,
}

impl Range {
    /// All finite numbers.
    pub const ANY: Range = Range::above(f64::NEG_INFINITY);
    /// Larger than zero.
    pub const POSITIVE: Range = Range::above(0.0);

    /// Larger than `min`.
    pub const fn above(min: f64) -> Self {
        Range::inside(min, f64::INFINITY)
    }

    /// Between `min` and `max`, both excluded.
    pub const fn inside(min: f64, max: f64) -> Self {
        Range {
            min,
            min_open: true,
            max,
            max_open: true,
        }
    }

    /// Between `min` and `max`, both included.
    pub const fn within(min: f64, max: f64) -> Self {
        Range {
            min,
            min_open: false,
            max,
            max_open: false,
        }
    }

    /// Is `value` in the range? Never for what is not finite.
    pub fn holds(&self, value: f64) -> bool {
        let above = value > self.min || (!self.min_open && value == self.min);
        let below = value < self.max || (!self.max_open && value == self.max);
        value.is_finite() && above && below
    }
}

impl fmt::Display for Range {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (left, right) = (
            if self.min_open { "<" } else { "<=" },
            if self.max_open { "<" } else { "<=" },
        );
        match (self.min.is_finite(), self.max.is_finite()) {
            (true, true) => write!(
                f,
                "{} {left} value {right} {}",
                short(self.min),
                short(self.max)
            ),
            (true, false) => write!(f, "value {} {}", flip(left), short(self.min)),
            (false, true) => write!(f, "value {right} {}", short(self.max)),
            (false, false) => write!(f, "any finite number"),
        }
    }
}

/// The same relation, read from the other side.
fn flip(relation: &str) -> &'static str {
    if relation == "<" { ">" } else { ">=" }
}

/// A number with as many digits as it needs, with a power of ten when it is large or small.
pub fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e6).contains(&value.abs()) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// What a field may hold.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// A number in the unit that the key ends in.
    Number(Range),
    /// A number that may be left out; the text says what it is then.
    OptionalNumber(Range, &'static str),
    /// A whole number between both ends.
    Whole(i64, i64),
    /// One of several words.
    Word(&'static [&'static str]),
    /// The list of receivers.
    Receivers,
    /// A side of the body: `{ method = "...", parameters }`.
    Side,
}

impl Kind {
    /// What is expected, for error messages.
    pub fn expected(&self) -> String {
        match self {
            Kind::Number(_) | Kind::OptionalNumber(..) => "a number".into(),
            Kind::Whole(..) => "a whole number".into(),
            Kind::Word(words) => format!("one of {}", quoted(words)),
            Kind::Receivers => "a list of tables { name = \"A\", x_m = 0.0, y_m = 0.0 }".into(),
            Kind::Side => "a table { method = \"...\", parameters }".into(),
        }
    }
}

/// Words in quotation marks, separated by commas.
pub fn quoted(words: &[&str]) -> String {
    let words: Vec<String> = words.iter().map(|word| format!("\"{word}\"")).collect();
    words.join(", ")
}

/// A field of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Where it stands, for example `grid.h_m`.
    pub path: &'static str,
    /// What it is, in a line.
    pub doc: &'static str,
    /// What it may hold.
    pub kind: Kind,
}

impl Field {
    /// A field.
    pub const fn new(path: &'static str, kind: Kind, doc: &'static str) -> Self {
        Field { path, doc, kind }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_know_their_ends() {
        assert!(!Range::POSITIVE.holds(0.0));
        assert!(Range::POSITIVE.holds(1e-300));
        assert!(!Range::inside(-1.0, 0.5).holds(0.5));
        assert!(Range::within(0.0, 1.0).holds(1.0));
        assert!(!Range::ANY.holds(f64::NAN));
        assert!(!Range::POSITIVE.holds(f64::INFINITY));
    }

    #[test]
    fn ranges_print_as_they_are_read() {
        assert_eq!(Range::POSITIVE.to_string(), "value > 0");
        assert_eq!(Range::inside(-1.0, 0.5).to_string(), "-1 < value < 0.5");
        assert_eq!(Range::within(0.0, 1e9).to_string(), "0 <= value <= 1e9");
    }
}
