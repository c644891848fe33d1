//! Linear elasticity in explicit steps: the finite-strain law, point by point.
//!
//! Written out for the plane, with A = dt l, e = A_xy - A_yx and n = det(2 I + A):
//!
//! ```text
//! G = 2/n (2 A + det(A) I),   cos phi = (n^2 - e^2)/(n^2 + e^2),   sin phi = 2 n e/(n^2 + e^2)
//! ```
//!
//! and the deviator in the plane turns by 2 phi.

use super::{Increment, LinearElastic};
use crate::material::MaterialBlock;
use crate::material::law::Law;
use crate::tensor::{Matrix, add_scaled, sym};

/// State: xx, yy, xy (Pa).
impl Law<2> for LinearElastic {
    type State = [f64; 3];

    const NAME: &'static str = "linear elastic";

    #[inline(always)]
    fn advance(&self, l: &Matrix<2>, dt: f64, state: &mut [f64; 3]) {
        let [[a, b], [c, d]] = [[dt * l[0][0], dt * l[0][1]], [dt * l[1][0], dt * l[1][1]]];
        let (delta, e) = (a * d - b * c, b - c);
        let n = 4.0 + 2.0 * (a + d) + delta;
        let squares = n * n + e * e;
        // both quotients by one division
        let inverse = 1.0 / (n * squares);
        let (scale, turn) = (2.0 * inverse * squares, inverse * n);
        let (cos, sin) = (turn * (n * n - e * e), turn * 2.0 * n * e);
        let (cos_2, sin_2) = (cos * cos - sin * sin, 2.0 * cos * sin);
        let [xx, yy, xy] = *state;
        let (mean, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let volume = 2.0 * scale * (a + d + delta);
        let shear = 2.0 * self.shear * scale;
        let mean = mean + (self.lambda + self.shear) * volume;
        let turned = half * cos_2 + xy * sin_2 + shear * (a - d);
        let xy = xy * cos_2 - half * sin_2 + shear * (b + c);
        *state = [mean + turned, mean - turned, xy];
    }

    #[inline(always)]
    fn stress(&self, state: &[f64; 3]) -> Matrix<2> {
        let [xx, yy, xy] = *state;
        [[xx, xy], [xy, yy]]
    }

    fn prestressed(&self, stress: &Matrix<2>) -> [f64; 3] {
        [stress[0][0], stress[1][1], stress[0][1]]
    }

    fn energy_density(&self, state: &[f64; 3]) -> f64 {
        MaterialBlock::<2>::energy_density(self, &Law::<2>::stress(self, state))
    }

    fn p_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.shear
    }
}

/// State: xx, yy, zz, yz, xz, xy (Pa).
impl Law<3> for LinearElastic {
    type State = [f64; 6];

    const NAME: &'static str = "linear elastic";

    #[inline(always)]
    fn advance(&self, l: &Matrix<3>, dt: f64, state: &mut [f64; 6]) {
        let increment = Increment::new(&l.map(|row| row.map(|x| dt * x)));
        let stress = Law::<3>::stress(self, state);
        let strain = self.law(&sym(&increment.gradient));
        let next = add_scaled(&increment.rotated(&stress), 1.0, &strain);
        *state = Law::<3>::prestressed(self, &next);
    }

    #[inline(always)]
    fn stress(&self, state: &[f64; 6]) -> Matrix<3> {
        let [xx, yy, zz, yz, xz, xy] = *state;
        [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    }

    #[inline(always)]
    fn prestressed(&self, s: &Matrix<3>) -> [f64; 6] {
        [s[0][0], s[1][1], s[2][2], s[1][2], s[0][2], s[0][1]]
    }

    fn energy_density(&self, state: &[f64; 6]) -> f64 {
        MaterialBlock::<3>::energy_density(self, &Law::<3>::stress(self, state))
    }

    fn p_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.shear
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Elastic;
    use crate::tensor::{contract, zero};

    #[test]
    fn explicit_steps_are_the_finite_strain_law() {
        const ELASTIC: Elastic = Elastic {
            youngs_modulus: 10.0,
            poissons_ratio: 0.3,
            density: 1.0,
        };
        fn check<const D: usize>(l: Matrix<D>, stress: Matrix<D>)
        where
            LinearElastic: Law<D>,
        {
            let law = LinearElastic::new(&ELASTIC);
            let increment = l.map(|row| row.map(|x| 0.1 * x));
            let (mut next, mut first) = ([zero::<D>()], [zero::<D>()]);
            law.finite_stress(&[increment], &[stress], &mut next, &mut first)
                .unwrap();
            let mut state = law.prestressed(&stress);
            Law::<D>::advance(&law, &l, 0.1, &mut state);
            let difference = add_scaled(&Law::<D>::stress(&law, &state), -1.0, &next[0]);
            assert!(contract(&difference, &difference).sqrt() < 1e-13);
        }
        check([[0.8, -3.0], [2.1, -1.2]], [[1.0, 0.4], [0.4, -0.7]]);
        let stress = [[1.0, 0.4, -0.2], [0.4, -0.7, 0.3], [-0.2, 0.3, 0.5]];
        check(
            [[0.8, -3.0, 1.0], [2.1, -1.2, 0.4], [-0.6, 1.5, 0.9]],
            stress,
        );
    }
}
