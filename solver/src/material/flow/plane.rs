//! The elastic step of plane strain, written out.
//!
//! With A = [a b; c d], delta = a d - b c, det = 4 + 2 (a + d) + delta:
//!
//! ```text
//! G = 2/det [2 a + delta, 2 b; 2 c, 2 d + delta]
//! W_xy = 2 e/det,  e = b - c,     the step turns clockwise by phi, tan(phi/2) = e/det
//! ```
//!
//! Half of that turns r = (xx - yy)/2 and s = xy by phi, being twice phi/2: r cos phi + s sin phi and
//! s cos phi - r sin phi; their sum of normal stresses stays.

use super::Hypoelastic;
use crate::tensor::Matrix;

/// Strain and rotation of a step.
#[derive(Clone, Copy, Debug)]
pub struct PlaneStep {
    /// sym G: xx, yy, xy.
    strain: [f64; 3],
    /// cos phi and sin phi.
    turn: [f64; 2],
}

impl PlaneStep {
    /// Of the velocity gradient `l` (1/s) over `dt` (s). Not finite where the step turns the material
    /// inside out so far that 2 I + A is singular.
    #[inline(always)]
    pub fn new(l: &Matrix<2>, dt: f64) -> Self {
        let [[a, b], [c, d]] = [[dt * l[0][0], dt * l[0][1]], [dt * l[1][0], dt * l[1][1]]];
        let delta = a * d - b * c;
        let det = 4.0 + 2.0 * (a + d) + delta;
        let (scale, e) = (2.0 / det, b - c);
        let whole = 1.0 / (det * det + e * e);
        PlaneStep {
            strain: [
                scale * (2.0 * a + delta),
                scale * (2.0 * d + delta),
                scale * (b + c),
            ],
            turn: [whole * (det * det - e * e), whole * 2.0 * det * e],
        }
    }

    /// Engineering shear strain: the difference of the principal strains in the plane.
    #[inline(always)]
    pub fn shear(&self) -> f64 {
        let [xx, yy, xy] = self.strain;
        ((xx - yy) * (xx - yy) + 4.0 * xy * xy).sqrt()
    }

    /// The stress (Pa; xx, yy, xy, zz) that an elastic step leaves.
    #[inline(always)]
    pub fn trial(&self, law: &Hypoelastic, stress: &[f64; 4]) -> [f64; 4] {
        let ([cos, sin], [e_xx, e_yy, e_xy]) = (self.turn, self.strain);
        let [xx, yy, xy, zz] = *stress;
        let pressure = law.lambda * (e_xx + e_yy);
        let mean = 0.5 * (xx + yy) + pressure + law.shear * (e_xx + e_yy);
        let (r, s) = (0.5 * (xx - yy), xy);
        let half_r = r * cos + s * sin + law.shear * (e_xx - e_yy);
        let half_s = s * cos - r * sin + 2.0 * law.shear * e_xy;
        let (r, s) = (half_r * cos + half_s * sin, half_s * cos - half_r * sin);
        [mean + r, mean - r, s, zz + pressure]
    }
}
