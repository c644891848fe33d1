//! Von Mises: elastic, then perfectly plastic where sqrt(J2) reaches the undrained shear strength.
//!
//! Source: S21 (Shan et al. 2021, doi 10.1631/jzus.A2000399), section 3.3, for the clay; the return is
//! Wilkins's (1964), exact for a strain increment of constant direction that ends on the surface:
//!
//! ```text
//! tau = p I + s min(1, s_u / sqrt(J2)),   p, s, J2 of the elastic trial
//! ```
//!
//! In plane strain `s_u` is the shear stress at yield and 2 s_u the difference of principal stresses.
//! The surface holds for the Kirchhoff stress, so that the Cauchy stress yields at s_u/J.

use super::flow::{Hypoelastic, PlaneStep, SolidStep, components, radial_return, tensor};
use super::law::Law;
use crate::problem::Elastic;
use crate::tensor::Matrix;

/// Elastic, perfectly plastic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VonMises {
    elastic: Hypoelastic,
    strength: f64,
}

impl VonMises {
    /// With undrained shear strength `s_u` (Pa), positive.
    pub fn new(elastic: &Elastic, s_u: f64) -> Self {
        VonMises {
            elastic: Hypoelastic::new(elastic),
            strength: s_u,
        }
    }
}

/// State: xx, yy, xy, zz (Pa).
impl Law<2> for VonMises {
    type State = [f64; 4];
    const NAME: &'static str = "von Mises";

    #[inline(always)]
    fn advance(&self, l: &Matrix<2>, dt: f64, state: &mut [f64; 4]) {
        let trial = PlaneStep::new(l, dt).trial(&self.elastic, state);
        *state = radial_return(trial, self.strength, || self.strength);
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

/// State: xx, yy, zz, xy, yz, zx (Pa).
impl Law<3> for VonMises {
    type State = [f64; 6];
    const NAME: &'static str = "von Mises";

    #[inline(always)]
    fn advance(&self, l: &Matrix<3>, dt: f64, state: &mut [f64; 6]) {
        let trial = SolidStep::new(l, dt).trial(&self.elastic, state);
        *state = radial_return(trial, self.strength, || self.strength);
    }

    #[inline(always)]
    fn stress(&self, state: &[f64; 6]) -> Matrix<3> {
        tensor(state)
    }

    fn prestressed(&self, stress: &Matrix<3>) -> [f64; 6] {
        components(stress)
    }

    fn energy_density(&self, state: &[f64; 6]) -> f64 {
        self.elastic.energy_density(state)
    }

    fn p_modulus(&self) -> f64 {
        self.elastic.p_modulus()
    }
}

#[cfg(test)]
mod tests;
