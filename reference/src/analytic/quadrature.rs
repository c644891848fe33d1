//! Gauss-Legendre quadrature, shared by the closed forms.

use std::f64::consts::PI;

/// Nodes and weights on -1..1.
#[derive(Clone, Debug)]
pub struct GaussLegendre {
    rule: Vec<(f64, f64)>,
}

impl GaussLegendre {
    /// Rule of `order` points, exact for polynomials of degree 2 `order` - 1.
    ///
    /// Newton's method on the Legendre polynomial from Tricomi's estimate of its zeros.
    pub fn new(order: usize) -> Self {
        let n = order as f64;
        let rule = (0..order)
            .map(|i| {
                let mut x = -(PI * (i as f64 + 0.75) / (n + 0.5)).cos();
                let mut slope = legendre(order, x).1;
                // Quadratic convergence: six steps reach round-off from any of these starts.
                for _ in 0..6 {
                    x -= legendre(order, x).0 / slope;
                    slope = legendre(order, x).1;
                }
                (x, 2.0 / ((1.0 - x * x) * slope * slope))
            })
            .collect();
        GaussLegendre { rule }
    }

    /// Nodes and weights on `low`..`high`.
    pub fn on(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        self.rule
            .iter()
            .map(move |&(x, w)| (middle + half * x, half * w))
    }
}

/// Legendre polynomial of degree `n` and its derivative at `x`, |x| < 1.
fn legendre(n: usize, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = k as f64;
        (before, value) = (
            value,
            ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k,
        );
    }
    (value, n as f64 * (x * value - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integrates_polynomials_exactly() {
        for order in [2, 3, 8, 16] {
            let rule = GaussLegendre::new(order);
            for degree in 0..2 * order as i32 {
                let sum: f64 = rule.on(0.0, 2.0).map(|(x, w)| w * x.powi(degree)).sum();
                let exact = 2f64.powi(degree + 1) / f64::from(degree + 1);
                assert!((sum / exact - 1.0).abs() < 1e-13, "{order}, {degree}");
            }
        }
    }
}
