//! Observed order of convergence.

use super::fit::{Slope, student_slope};
use super::{NormError, check_finite, check_length};
use serde::{Deserialize, Serialize};

/// Order of convergence on the levels that were given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Order {
    /// Between neighbouring levels: log(e_i / e_{i+1}) / log(h_i / h_{i+1}).
    pub pairwise: Vec<f64>,
    /// Slope of log e over log h over all levels.
    pub fit: Slope,
}

/// Order of `errors` at cell sizes `h` (m), coarse to fine, at least two levels.
///
/// The caller states the window by the levels it passes. A level with an error of zero has no
/// logarithm and is refused.
pub fn order(h: &[f64], errors: &[f64]) -> Result<Order, NormError> {
    if h.len() < 2 {
        return Err(NormError::TooFew {
            what: "an order",
            needed: 2,
            found: h.len(),
        });
    }
    check_length("the errors", h.len(), errors.len())?;
    check_finite("h", h)?;
    check_finite("the errors", errors)?;
    check_positive("h", h)?;
    check_positive("an error", errors)?;
    if let Some(i) = h.windows(2).position(|w| w[1] >= w[0]) {
        return Err(NormError::NotPositive {
            what: format!("the refinement from level {i} to {}", i + 1),
            value: h[i] - h[i + 1],
        });
    }
    let x: Vec<f64> = h.iter().map(|h| h.ln()).collect();
    let y: Vec<f64> = errors.iter().map(|e| e.ln()).collect();
    let pairwise = (1..x.len())
        .map(|i| (y[i - 1] - y[i]) / (x[i - 1] - x[i]))
        .collect();
    Ok(Order {
        pairwise,
        fit: student_slope(&x, &y),
    })
}

fn check_positive(what: &str, values: &[f64]) -> Result<(), NormError> {
    match values.iter().find(|v| **v <= 0.0) {
        None => Ok(()),
        Some(value) => Err(NormError::NotPositive {
            what: what.to_owned(),
            value: *value,
        }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_order_is_two() {
        let o = order(&[4.0, 2.0, 1.0], &[0.16, 0.04, 0.01]).expect("defined");
        assert!(o.pairwise.iter().all(|p| (p - 2.0).abs() < 1e-12));
        assert!((o.fit.value - 2.0).abs() < 1e-12);
        let [low, high] = o.fit.interval.expect("three levels");
        assert!(high - low < 1e-9);
    }

    #[test]
    fn a_plateau_shows_between_the_levels() {
        let o = order(&[4.0, 2.0, 1.0], &[0.4, 0.1, 0.1]).expect("defined");
        assert!((o.pairwise[0] - 2.0).abs() < 1e-12);
        assert_eq!(o.pairwise[1], 0.0);
        assert!((o.fit.value - 1.0).abs() < 1e-12);
        let [low, high] = o.fit.interval.expect("three levels");
        assert!(low < 0.0 && high > 2.0);
    }

    #[test]
    fn meaningless_levels_are_refused() {
        assert!(matches!(
            order(&[1.0], &[1.0]),
            Err(NormError::TooFew { .. })
        ));
        assert!(order(&[2.0, 1.0], &[1.0, 0.0]).is_err());
        assert!(order(&[1.0, 2.0], &[1.0, 0.5]).is_err());
        assert!(order(&[2.0, 1.0], &[1.0, f64::NAN]).is_err());
        assert!(order(&[2.0, 1.0], &[1.0]).is_err());
    }
}
