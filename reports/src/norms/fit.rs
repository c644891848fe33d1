//! Straight lines by least squares, with intervals.

use serde::{Deserialize, Serialize};

/// A fitted slope with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slope {
    /// Least-squares slope.
    pub value: f64,
    /// Lower and upper end of the 95 % interval; `None` when there are too few values for one.
    pub interval: Option<[f64; 2]>,
}

/// A straight line y = intercept + slope x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Line {
    pub intercept: f64,
    pub slope: f64,
}

impl Line {
    /// Least squares over at least two values with distinct `x`.
    pub fn fit(x: &[f64], y: &[f64]) -> Line {
        let n = x.len() as f64;
        let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
        let sxy: f64 = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
        let slope = sxy / spread(x);
        Line {
            intercept: my - slope * mx,
            slope,
        }
    }

    /// Differences of `y` to the line.
    pub fn residuals(&self, x: &[f64], y: &[f64]) -> Vec<f64> {
        x.iter()
            .zip(y)
            .map(|(x, y)| y - self.intercept - self.slope * x)
            .collect()
    }
}

/// Sum of squared distances of `x` to their mean.
fn spread(x: &[f64]) -> f64 {
    let mean = x.iter().sum::<f64>() / x.len() as f64;
    x.iter().map(|x| (x - mean).powi(2)).sum()
}

/// Slope with Student's 95 % interval under independent normal errors; none below three values.
pub(super) fn student_slope(x: &[f64], y: &[f64]) -> Slope {
    let line = Line::fit(x, y);
    let interval = (x.len() >= 3).then(|| {
        let freedom = x.len() - 2;
        let squares: f64 = line.residuals(x, y).iter().map(|r| r * r).sum();
        let deviation = (squares / freedom as f64 / spread(x)).sqrt();
        let half = t_quantile(freedom) * deviation;
        [line.slope - half, line.slope + half]
    });
    Slope {
        value: line.slope,
        interval,
    }
}

/// 97.5 % quantile of Student's t for `freedom` >= 1 degrees of freedom.
///
/// Tabulated to ten; beyond, the Cornish-Fisher expansion about the normal quantile, which is
/// within 2e-4 there.
fn t_quantile(freedom: usize) -> f64 {
    const TABLE: [f64; 10] = [
        12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060, 2.2622, 2.2281,
    ];
    const NORMAL: f64 = 1.959_964;
    if let Some(tabulated) = TABLE.get(freedom.saturating_sub(1)) {
        return *tabulated;
    }
    let n = freedom as f64;
    let z = NORMAL;
    let first = (z.powi(3) + z) / 4.0;
    let second = (5.0 * z.powi(5) + 16.0 * z.powi(3) + 3.0 * z) / 96.0;
    let third = (3.0 * z.powi(7) + 19.0 * z.powi(5) + 17.0 * z.powi(3) - 15.0 * z) / 384.0;
    z + first / n + second / (n * n) + third / n.powi(3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_exact_line_has_no_width() {
        let slope = student_slope(&[0.0, 1.0, 2.0], &[1.0, 3.0, 5.0]);
        assert!((slope.value - 2.0).abs() < 1e-15);
        let [low, high] = slope.interval.expect("three values");
        assert!(high - low < 1e-12);
    }

    #[test]
    fn the_interval_is_students() {
        // Residuals -1/6, 1/3, -1/6 about the line of slope 1: s^2 = 1/6, spread 2.
        let slope = student_slope(&[0.0, 1.0, 2.0], &[0.0, 1.5, 2.0]);
        assert!((slope.value - 1.0).abs() < 1e-15);
        let [low, high] = slope.interval.expect("three values");
        let half = 12.7062 * (1.0f64 / 12.0).sqrt();
        assert!((high - 1.0 - half).abs() < 1e-10 && (1.0 - low - half).abs() < 1e-10);
        assert_eq!(student_slope(&[0.0, 1.0], &[0.0, 1.0]).interval, None);
    }

    #[test]
    fn quantiles_join_smoothly_and_tend_to_the_normal() {
        assert!((t_quantile(11) - 2.2010).abs() < 2e-4);
        assert!((t_quantile(30) - 2.0423).abs() < 2e-4);
        assert!((t_quantile(1000) - 1.9623).abs() < 2e-4);
    }
}
