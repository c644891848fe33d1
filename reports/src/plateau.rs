//! Errors that no longer fall although the scene is refined, and what holds them up.

use crate::budget::Budget;
use crate::format;
use anechoic_reference::claim::Evidence;
use serde::{Deserialize, Serialize};

/// The metric of plateaus: the largest order between neighbours on one.
pub const PLATEAU: &str = "plateau";

/// Order with which errors are expected to fall: that of elements and of the trapezoidal rule.
pub const EXPECTED: f64 = 2.0;

/// Below this share of the expected order an error no longer falls.
pub const FLAT: f64 = 0.25;

/// An error within this factor of its reference's floor says nothing of the scheme.
const AT_FLOOR: f64 = 2.0;

/// A share holds an error up if it is this much of it at least.
const ENOUGH: f64 = 0.5;

/// The part of a refinement over which an error no longer falls, up to the finest level.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plateau {
    /// Its first level, counted from the coarsest.
    pub from: usize,
    /// Largest order between neighbours on it.
    pub order: f64,
    /// The error on the finest level.
    pub error: f64,
    /// The largest of the other shares of the scene's error, where they were measured.
    pub other: Option<Other>,
}

/// A share that is not of what was refined.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Other {
    /// Its cause.
    pub name: String,
    /// How much it is.
    pub value: f64,
    /// The kind of evidence behind it.
    pub evidence: Evidence,
}

impl Plateau {
    /// The plateau of `errors`, coarse to fine, with the orders `pairwise` between them, if they end
    /// in one above the reference's `floor` (0 where it has none).
    pub fn find(errors: &[f64], pairwise: &[f64], floor: f64) -> Option<Self> {
        let flat = |order: &&f64| **order < FLAT * EXPECTED;
        let levels = pairwise.iter().rev().take_while(flat).count();
        let error = *errors.last()?;
        if levels == 0 || error <= AT_FLOOR * floor {
            return None;
        }
        let from = pairwise.len() - levels;
        let on_it = pairwise[from..].iter().copied();
        Some(Plateau {
            from,
            order: on_it.fold(f64::NEG_INFINITY, f64::max),
            error,
            other: None,
        })
    }

    /// The same with the largest share of `budget` that is not of `cause`, for the error `metric` at
    /// `place`.
    pub fn with_budget(mut self, budget: &Budget, cause: &str, metric: &str, place: &str) -> Self {
        let largest = budget.largest_but(cause, metric, place);
        self.other = largest.map(|(share, value)| Other {
            name: share.name.clone(),
            value,
            evidence: share.against.0,
        });
        self
    }

    /// What holds the error up, in words.
    pub fn held_by(&self) -> String {
        match &self.other {
            Some(other) if other.value >= ENOUGH * self.error => {
                format!(
                    "held up by {} ({})",
                    other.name,
                    format::number(other.value)
                )
            }
            Some(other) => format!(
                "held up by no share that was measured: the largest, {}, is {}",
                other.name,
                format::number(other.value)
            ),
            None => "what holds it up was not measured: --budget does".to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::budget::Share;

    #[test]
    fn a_plateau_is_where_errors_end_flat() {
        let errors = [0.4, 0.1, 0.09, 0.085];
        let found = Plateau::find(&errors, &[2.0, 0.15, 0.08], 0.0).expect("it is flat");
        assert_eq!((found.from, found.order, found.error), (1, 0.15, 0.085));
        // an error that rises is one as well
        assert!(Plateau::find(&[0.1, 0.2], &[-1.0], 0.0).is_some());
        // flat at first, before the mesh resolves anything, and falling then
        assert_eq!(Plateau::find(&[0.9, 0.89, 0.3], &[0.02, 1.6], 0.0), None);
        // a kink's first order falls
        assert_eq!(Plateau::find(&[0.2, 0.1], &[1.0], 0.0), None);
    }

    #[test]
    fn at_the_references_floor_nothing_is_said() {
        assert_eq!(Plateau::find(&[2e-6, 1.9e-6], &[0.1], 1e-6), None);
        assert!(Plateau::find(&[2e-6, 1.9e-6], &[0.1], 1e-7).is_some());
    }

    #[test]
    fn what_holds_it_up_is_named_if_it_is_large_enough() {
        let plateau = Plateau::find(&[0.1, 0.099], &[0.01], 0.0).expect("it is flat");
        assert!(plateau.held_by().contains("--budget"));
        let held = |time: f64| {
            let share = |name: &str, value| Share {
                name: name.into(),
                place: "A".into(),
                metric: "rel_l2".into(),
                value: Ok(value),
                against: (Evidence::Refinement, String::new()),
            };
            let budget = Budget {
                method: "pml".into(),
                shares: vec![share("space", 0.9), share("time", time)],
            };
            let plateau = plateau.clone();
            plateau
                .with_budget(&budget, "space", "rel_l2", "A")
                .held_by()
        };
        assert_eq!(held(0.08), "held up by time (0.0800)");
        assert!(held(0.01).starts_with("held up by no share"));
    }
}
