//! Reflection of oblique plane waves from a viscous layer in the continuum.
//!
//! Source: S21 (Shan et al. 2021, doi 10.1631/jzus.A2000399), Eqs (6)-(7), for the layer; the invariant
//! imbedding of a reflection matrix is standard (e.g. Brekhovskikh, Waves in Layered Media, 1980).
//!
//! In the layer 0 <= x <= L the momentum balance is rho (v_t + g v) = div s with the rate g(x) (1/s).
//! Displacements and tractions (over -i w) are written in the waves of the undamped solid, a to the
//! right and b to the left; mirror symmetry leaves u_x and T_y to m = a - b, u_y and T_x to n = a + b,
//! with U_x, U_y, T_x, T_y the rows of the waves to the right:
//!
//! ```text
//! m' = P n,   P = -i w Xi - rho g [U_x; T_y]^-1 [0; U_y]
//! n' = Q m,   Q = -i w Xi - rho g [U_y; T_x]^-1 [0; U_x]
//! b = R a:    R' = [(Q - P) - (Q + P) R - R (P + Q) - R (P - Q) R]/2,   R(L) the wall's
//! ```
//!
//! For one wave alone this is the scalar equation of [`crate::analytic::damping_layer`].

use super::matrix2::Matrix2;
use super::{Medium, ObliqueError, Reflection};
use num_complex::Complex64;

/// A viscous layer behind a plane, fixed at its outer end.
#[derive(Clone, Copy, Debug)]
pub struct Layer<G> {
    /// Thickness L (m).
    pub thickness: f64,
    /// Damping rate g(x) (1/s), x in m from the inner edge.
    pub rate: G,
}

impl<G: Fn(f64) -> f64> Layer<G> {
    /// Reflection at the inner edge of waves of `frequency` (Hz).
    ///
    /// # Errors
    /// A thickness or frequency that is not positive; no convergence of the integration.
    pub fn reflection(&self, medium: &Medium, frequency: f64) -> Result<Reflection, ObliqueError> {
        const TOLERANCE: f64 = 1e-9;
        const MOST_STEPS: usize = 1 << 18;
        for (field, value) in [
            ("thickness (m)", self.thickness),
            ("frequency (Hz)", frequency),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                let allowed = "a positive finite number";
                return Err(ObliqueError::OutOfRange {
                    field,
                    value,
                    allowed,
                });
            }
        }
        let angular = 2.0 * std::f64::consts::PI * frequency;
        let mut steps = 64;
        let mut coarse = self.integrate(medium, angular, steps);
        loop {
            steps *= 2;
            let fine = self.integrate(medium, angular, steps);
            let change = (fine - coarse).largest();
            if change < TOLERANCE {
                return Ok(medium.reflection(fine));
            }
            if steps >= MOST_STEPS {
                return Err(ObliqueError::NotConverged { steps, change });
            }
            coarse = fine;
        }
    }

    /// `steps` classical Runge-Kutta steps from the wall to the inner edge.
    fn integrate(&self, medium: &Medium, angular: f64, steps: usize) -> Matrix2 {
        let free = Matrix2::diagonal(medium.slowness.map(|xi| Complex64::new(0.0, -angular) * xi));
        let ([ux, uy], [tx, ty]) = (medium.motion.0, medium.traction.0);
        let coupling = |above, below, driven: [Complex64; 2]| {
            let second = Matrix2([above, below]).inverse().column(1);
            Matrix2(second.map(|s| driven.map(|d| s * d)))
        };
        let (to_m, to_n) = (coupling(ux, ty, uy), coupling(uy, tx, ux));
        let slope = |x: f64, r: Matrix2| {
            let rate = Complex64::from(-medium.solid.density() * (self.rate)(x));
            let (p, q) = (free + to_m.scale(rate), free + to_n.scale(rate));
            let sum = p + q;
            ((q - p) - sum * r - r * sum - r * (p - q) * r).scale(0.5.into())
        };
        let h = self.thickness / steps as f64;
        let mut r = medium.wall();
        let after = |r: Matrix2, k: Matrix2, share: f64| r - k.scale((share * h).into());
        for step in (0..steps).rev() {
            let at = |share: f64| (step as f64 + share) * h;
            let k1 = slope(at(1.0), r);
            let k2 = slope(at(0.5), after(r, k1, 0.5));
            let k3 = slope(at(0.5), after(r, k2, 0.5));
            let k4 = slope(at(0.0), after(r, k3, 1.0));
            let mean = k1 + (k2 + k3).scale(2.0.into()) + k4;
            r = after(r, mean, 1.0 / 6.0);
        }
        r
    }
}
