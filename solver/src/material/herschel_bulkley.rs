//! Herschel-Bulkley: a von Mises surface that grows with the shear strain rate of the step.
//!
//! Source: S21 (Shan et al. 2021, doi 10.1631/jzus.A2000399), Eqs (8) and (9):
//!
//! ```text
//! s_u = s_u0 (1 + mu (g / g_ref)^n)                                  (8)
//! g   = sqrt((D_xx - D_yy)^2 + 4 D_xy^2),   D = sym l at mid-step    (9)
//! ```
//!
//! g is the difference of the principal strain rates in the plane: the rate of the engineering shear
//! strain. As printed, (9) has `4 l_xy l_yx` where `4 D_xy^2 = (l_xy + l_yx)^2` stands here: it is the
//! difference of the eigenvalues of l itself, which vanishes in simple shear and is imaginary in a
//! rotation. Both agree where l is symmetric.
//!
//! g is that of the whole strain, elastic part included, so that the strength is known before the
//! return: the return is closed, and a step of any length ends on the surface or inside. A rate that
//! drops takes stress down with it within the step.

use super::flow::{Hypoelastic, PlaneStep, radial_return};
use super::law::Law;
use crate::problem::Elastic;
use crate::tensor::Matrix;

/// How strength depends on the rate of shear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RateStrength {
    /// Strength at rest s_u0 (Pa), positive.
    pub s_u0: f64,
    /// Viscosity coefficient mu, from 0.
    pub viscosity: f64,
    /// Shear-thinning index n, in 0..=1 without 0.
    pub index: f64,
    /// Reference shear strain rate g_ref (1/s), positive.
    pub reference_rate: f64,
}

impl RateStrength {
    /// Undrained shear strength (Pa) at the shear strain `rate` (1/s), Eq (8).
    #[inline(always)]
    pub fn at(&self, rate: f64) -> f64 {
        self.s_u0 * (1.0 + self.viscosity * (rate / self.reference_rate).powf(self.index))
    }
}

/// Elastic, then flowing with a strength that depends on the rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HerschelBulkley {
    elastic: Hypoelastic,
    strength: RateStrength,
}

impl HerschelBulkley {
    /// With the given strength.
    pub fn new(elastic: &Elastic, strength: RateStrength) -> Self {
        HerschelBulkley {
            elastic: Hypoelastic::new(elastic),
            strength,
        }
    }
}

/// State: xx, yy, xy, zz (Pa). `dt` must be positive.
impl Law<2> for HerschelBulkley {
    type State = [f64; 4];
    const NAME: &'static str = "Herschel-Bulkley";

    #[inline(always)]
    fn advance(&self, l: &Matrix<2>, dt: f64, state: &mut [f64; 4]) {
        let step = PlaneStep::new(l, dt);
        let trial = step.trial(&self.elastic, state);
        *state = radial_return(trial, self.strength.s_u0, || {
            self.strength.at(step.shear() / dt)
        });
    }

    #[inline(always)]
    fn stress(&self, state: &[f64; 4]) -> Matrix<2> {
        let [xx, yy, xy, _] = *state;
        [[xx, xy], [xy, yy]]
    }

    fn prestressed(&self, stress: &Matrix<2>) -> [f64; 4] {
        self.elastic.under(stress)
    }

    fn energy_density(&self, state: &[f64; 4]) -> f64 {
        self.elastic.energy_density(state)
    }

    fn p_modulus(&self) -> f64 {
        self.elastic.p_modulus()
    }
}

#[cfg(test)]
mod tests;
