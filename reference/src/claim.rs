//! Claims are data: what is measured, against what, what is accepted and why.

use serde::{Deserialize, Serialize};

/// What kind of evidence a reference gives. Only the first three verify.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Evidence {
    /// A closed form.
    Analytic,
    /// Another code.
    Independent,
    /// The same scheme on an extended domain, causally free of the boundary: verifies the boundary alone.
    Certified,
    /// A number printed in a paper.
    Paper,
    /// An earlier result of this program.
    Regression,
    /// The same scheme, finer or with one part exchanged: says what that part still changes, not what is
    /// true.
    Refinement,
}

impl Evidence {
    /// Does agreement with it count as verification?
    pub fn verifies(self) -> bool {
        matches!(
            self,
            Evidence::Analytic | Evidence::Independent | Evidence::Certified
        )
    }

    /// Name in rows.
    pub fn name(self) -> &'static str {
        match self {
            Evidence::Analytic => "analytic",
            Evidence::Independent => "independent",
            Evidence::Certified => "certified",
            Evidence::Paper => "paper",
            Evidence::Regression => "regression",
            Evidence::Refinement => "refinement",
        }
    }
}

/// What values of a metric are accepted. At least one end is set; a rate sets both.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Accept {
    /// Smallest accepted value.
    pub min: Option<f64>,
    /// Largest accepted value.
    pub max: Option<f64>,
}

impl Accept {
    /// At most `max`.
    pub const fn at_most(max: f64) -> Self {
        Accept {
            min: None,
            max: Some(max),
        }
    }

    /// At least `min`.
    pub const fn at_least(min: f64) -> Self {
        Accept {
            min: Some(min),
            max: None,
        }
    }

    /// Between `min` and `max`, both included.
    pub const fn within(min: f64, max: f64) -> Self {
        Accept {
            min: Some(min),
            max: Some(max),
        }
    }

    /// Is `value` accepted? NaN never is.
    pub fn holds(&self, value: f64) -> bool {
        value.is_finite()
            && self.min.is_none_or(|min| value >= min)
            && self.max.is_none_or(|max| value <= max)
    }
}

/// A claim about one number of one method on one scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Claim {
    /// Boundary method as in `--method`.
    pub method: String,
    /// Metric id, see the reports crate.
    pub metric: String,
    /// Receiver, group or field.
    pub place: String,
    /// What is accepted.
    pub accept: Accept,
    /// Kind of evidence behind it.
    pub evidence: Evidence,
    /// Why this bound and not another.
    pub why: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn acceptance_is_closed_and_refuses_nan() {
        assert!(Accept::within(1.6, 2.2).holds(1.6));
        assert!(Accept::within(1.6, 2.2).holds(2.2));
        assert!(!Accept::within(1.6, 2.2).holds(2.3));
        assert!(!Accept::within(1.6, 2.2).holds(1.5));
        assert!(!Accept::at_most(1.0).holds(f64::NAN));
        assert!(!Accept::at_least(1.0).holds(f64::INFINITY));
    }

    #[test]
    fn only_three_kinds_verify() {
        assert!(Evidence::Certified.verifies());
        assert!(!Evidence::Paper.verifies());
        assert!(!Evidence::Regression.verifies());
        assert!(!Evidence::Refinement.verifies());
    }
}
