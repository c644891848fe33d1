//! The elastic step in three dimensions.
//!
//! The half turn from W, whose whole turn has the angle phi with tan(phi/2)^2 = W:W/8:
//!
//! ```text
//! q = (I - X)^-1 (I + X),   X = W / (2 (1 + sqrt(1 + W:W/8)))
//! ```
//!
//! since tan(phi/4) = tan(phi/2) / (1 + sqrt(1 + tan(phi/2)^2)).

use super::Hypoelastic;
use crate::tensor::{
    Matrix, add_scaled, contract, identity, inverse, mul, mul_transposed, skew, sym, trace,
};

/// Strain and rotation of a step.
#[derive(Clone, Copy, Debug)]
pub struct SolidStep {
    /// sym G.
    strain: Matrix<3>,
    /// q.
    half_turn: Matrix<3>,
}

impl SolidStep {
    /// Of the velocity gradient `l` (1/s) over `dt` (s). Not finite where the step turns the material
    /// inside out so far that 2 I + A is singular.
    #[inline(always)]
    pub fn new(l: &Matrix<3>, dt: f64) -> Self {
        let unit = identity::<3>();
        let doubled = l.map(|row| row.map(|rate| 2.0 * dt * rate));
        let twice_mid = add_scaled(&add_scaled(&unit, 1.0, &unit), 0.5, &doubled);
        let gradient = mul(&doubled, &inverse(&twice_mid).1);
        let spin = skew(&gradient);
        let quarter = 0.5 / (1.0 + (1.0 + 0.125 * contract(&spin, &spin)).sqrt());
        let (_, behind) = inverse(&add_scaled(&unit, -quarter, &spin));
        SolidStep {
            strain: sym(&gradient),
            half_turn: mul(&behind, &add_scaled(&unit, quarter, &spin)),
        }
    }

    /// The stress (Pa; xx, yy, zz, xy, yz, zx) that an elastic step leaves.
    #[inline(always)]
    pub fn trial(&self, law: &Hypoelastic, stress: &[f64; 6]) -> [f64; 6] {
        let mut half_way = self.turned(&tensor(stress));
        half_way = add_scaled(&half_way, 2.0 * law.shear, &self.strain);
        half_way = add_scaled(&half_way, law.lambda * trace(&self.strain), &identity());
        components(&self.turned(&half_way))
    }

    /// Half a step on.
    #[inline(always)]
    fn turned(&self, m: &Matrix<3>) -> Matrix<3> {
        mul_transposed(&mul(&self.half_turn, m), &self.half_turn)
    }
}

/// The stress tensor of its components.
#[inline(always)]
pub fn tensor([xx, yy, zz, xy, yz, zx]: &[f64; 6]) -> Matrix<3> {
    [[*xx, *xy, *zx], [*xy, *yy, *yz], [*zx, *yz, *zz]]
}

/// The components of a stress tensor.
#[inline(always)]
pub fn components(m: &Matrix<3>) -> [f64; 6] {
    [m[0][0], m[1][1], m[2][2], m[0][1], m[1][2], m[2][0]]
}
