//! Isotropic linear elasticity, plane strain in 2D.
//!
//! Small strain: `sigma = lambda tr(eps) I + 2 G eps`.
//!
//! Finite strain: the same law between the Jaumann rate of the Kirchhoff stress and the rate of
//! deformation, integrated at the mid-point of the step so that a rigid rotation changes nothing but
//! the stress's direction (Hughes & Winget 1980):
//!
//! ```text
//! A = grad du,  F = I + A,  G = 2 A (F + I)^-1,  Q = (I - W/2)^-1 (I + W/2),  W = skew G
//! tau' = Q tau Q^T + C : sym G,       P = tau' F^-T
//! ```
//!
//! Along one axis this is Hencky's law, tau = (lambda + 2 G) ln s, to third order in the increment.
//! The Kirchhoff stress makes the tangent symmetric at the start of a step.

mod explicit;

use super::MaterialBlock;
use crate::problem::Elastic;
use crate::tensor::{
    Matrix, Tensor4, add_scaled, contract, dot, identity, inverse, mul, mul_transposed, skew, sym,
    trace, transposed, zero,
};

/// Lamé's constants (Pa).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearElastic {
    lambda: f64,
    shear: f64,
}

impl LinearElastic {
    /// The law of `elastic`.
    pub fn new(elastic: &Elastic) -> Self {
        LinearElastic {
            lambda: elastic.lambda(),
            shear: elastic.shear_modulus(),
        }
    }

    /// Elastic energy (J) of points under these displacement gradients, with their volumes.
    pub(crate) fn energy_of<const D: usize>(
        &self,
        gradients: &[Matrix<D>],
        volumes: &[f64],
    ) -> f64 {
        let energy = |(g, v): (&Matrix<D>, &f64)| {
            let mut stress = [zero::<D>()];
            self.small_stress(&[*g], &mut stress);
            v * self.energy_density(&stress[0])
        };
        gradients.iter().zip(volumes).map(energy).sum()
    }

    #[inline]
    fn law<const D: usize>(&self, strain: &Matrix<D>) -> Matrix<D> {
        let pressure = self.lambda * trace(strain);
        let mut out = zero::<D>();
        for i in 0..D {
            for j in 0..D {
                out[i][j] = 2.0 * self.shear * strain[i][j];
            }
            out[i][i] += pressure;
        }
        out
    }
}

/// What a step's increment does to stress.
struct Increment<const D: usize> {
    /// `G`, the mid-point gradient.
    gradient: Matrix<D>,
    /// `(F + I)^-1`.
    mid_inverse: Matrix<D>,
    /// `Q`.
    rotation: Matrix<D>,
    /// `(I - W/2)^-1`.
    half_spin_inverse: Matrix<D>,
    /// `F^-1`.
    inverse: Matrix<D>,
    /// `det F`.
    determinant: f64,
}

impl<const D: usize> Increment<D> {
    #[inline]
    fn new(a: &Matrix<D>) -> Self {
        let unit = identity::<D>();
        let f = add_scaled(&unit, 1.0, a);
        let (determinant, inverse_f) = inverse(&f);
        let (_, mid_inverse) = inverse(&add_scaled(&f, 1.0, &unit));
        let gradient = mul(&add_scaled(a, 1.0, a), &mid_inverse);
        let spin = skew(&gradient);
        let (_, half_spin_inverse) = inverse(&add_scaled(&unit, -0.5, &spin));
        let rotation = mul(&half_spin_inverse, &add_scaled(&unit, 0.5, &spin));
        Increment {
            gradient,
            mid_inverse,
            rotation,
            half_spin_inverse,
            inverse: inverse_f,
            determinant,
        }
    }

    #[inline]
    fn rotated(&self, stress: &Matrix<D>) -> Matrix<D> {
        mul_transposed(&mul(&self.rotation, stress), &self.rotation)
    }
}

impl<const D: usize> MaterialBlock<D> for LinearElastic {
    fn name(&self) -> &'static str {
        "linear elastic"
    }

    fn small_moduli(&self) -> Tensor4<D> {
        let mut c = [[[[0.0; D]; D]; D]; D];
        for i in 0..D {
            for j in 0..D {
                c[i][i][j][j] += self.lambda;
                c[i][j][i][j] += self.shear;
                c[i][j][j][i] += self.shear;
            }
        }
        c
    }

    fn small_stress(&self, increments: &[Matrix<D>], stress: &mut [Matrix<D>]) {
        for (a, s) in increments.iter().zip(stress) {
            *s = add_scaled(s, 1.0, &self.law(&sym(a)));
        }
    }

    fn finite_stress(
        &self,
        increments: &[Matrix<D>],
        stress: &[Matrix<D>],
        next: &mut [Matrix<D>],
        first: &mut [Matrix<D>],
    ) -> Result<(), (usize, f64)> {
        for (p, (a, s)) in increments.iter().zip(stress).enumerate() {
            let increment = Increment::new(a);
            if increment.determinant <= 0.0 {
                return Err((p, increment.determinant));
            }
            next[p] = add_scaled(
                &increment.rotated(s),
                1.0,
                &self.law(&sym(&increment.gradient)),
            );
            first[p] = mul_transposed(&next[p], &increment.inverse);
        }
        Ok(())
    }

    /// With dF = dA: dG = L dA R, L = 2 I - G, R = (F + I)^-1; dQ = H (dW/2) (Q + I),
    /// H = (I - W/2)^-1; dtau = dQ tau Q^T + Q tau dQ^T + C : sym dG;
    /// dP = (dtau - P dA^T) F^-T.
    ///
    /// For dA = e_k e_l the first is the product of column k of L and row l of R, so that each
    /// derivative is a handful of products of entries.
    fn finite_moduli(
        &self,
        increments: &[Matrix<D>],
        stress: &[Matrix<D>],
        moduli: &mut [Tensor4<D>],
    ) {
        let unit = identity::<D>();
        for ((a, s), out) in increments.iter().zip(stress).zip(moduli) {
            let x = Increment::new(a);
            let next = add_scaled(&x.rotated(s), 1.0, &self.law(&sym(&x.gradient)));
            let first = mul_transposed(&next, &x.inverse);
            let left = add_scaled(&add_scaled(&unit, 1.0, &unit), -1.0, &x.gradient);
            let right = transposed(&x.mid_inverse);
            // M^T with M = (Q + I) tau Q^T
            let turned = mul(
                &x.rotation,
                &mul_transposed(s, &add_scaled(&x.rotation, 1.0, &unit)),
            );
            let (h_left, h_right) = (
                mul(&x.half_spin_inverse, &left),
                mul(&x.half_spin_inverse, &right),
            );
            let (m_left, m_right) = (mul(&turned, &left), mul(&turned, &right));
            for k in 0..D {
                for l in 0..D {
                    let mut d_tau = zero::<D>();
                    let mut d_volume = 0.0;
                    for i in 0..D {
                        d_volume += left[i][k] * right[i][l];
                        for j in 0..D {
                            let strain = left[i][k] * right[j][l] + left[j][k] * right[i][l];
                            let spin = h_left[i][k] * m_right[j][l] - h_right[i][l] * m_left[j][k]
                                + h_left[j][k] * m_right[i][l]
                                - h_right[j][l] * m_left[i][k];
                            d_tau[i][j] = self.shear * strain + 0.25 * spin;
                        }
                    }
                    for i in 0..D {
                        d_tau[i][i] += self.lambda * d_volume;
                        d_tau[i][k] -= first[i][l];
                    }
                    for i in 0..D {
                        for j in 0..D {
                            out[i][j][k][l] = dot(&d_tau[i], &x.inverse[j]);
                        }
                    }
                }
            }
        }
    }

    /// `tau : eps / 2` with eps = tau / (2 G) - lambda tr(tau) / (2 G (D lambda + 2 G)) I; with
    /// D = 2 this is plane strain.
    fn energy_density(&self, stress: &Matrix<D>) -> f64 {
        let tr = trace(stress);
        let dimension = D as f64;
        let bulk_like = self.lambda / (dimension * self.lambda + 2.0 * self.shear);
        0.25 / self.shear * (contract(stress, stress) - bulk_like * tr * tr)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law() -> LinearElastic {
        LinearElastic::new(&Elastic {
            youngs_modulus: 10.0,
            poissons_ratio: 0.3,
            density: 1.0,
        })
    }

    #[test]
    fn tangent_matches_finite_differences() {
        let a = [[0.08, -0.11], [0.05, -0.06]];
        let s = [[1.0, 0.4], [0.4, -0.7]];
        let mut moduli = [Tensor4::<2>::default()];
        law().finite_moduli(&[a], &[s], &mut moduli);
        let step = 1e-6;
        let piola = |a: Matrix<2>| {
            let (mut next, mut first) = ([zero::<2>()], [zero::<2>()]);
            law()
                .finite_stress(&[a], &[s], &mut next, &mut first)
                .unwrap();
            first[0]
        };
        for k in 0..2 {
            for l in 0..2 {
                let (mut up, mut down) = (a, a);
                up[k][l] += step;
                down[k][l] -= step;
                let (up, down) = (piola(up), piola(down));
                for i in 0..2 {
                    for j in 0..2 {
                        let difference = (up[i][j] - down[i][j]) / (2.0 * step);
                        assert!(
                            (moduli[0][i][j][k][l] - difference).abs() < 1e-7,
                            "{i}{j}{k}{l}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn tangent_is_symmetric_at_the_start_of_a_step() {
        let s = [[1.0, 0.4], [0.4, -0.7]];
        let mut moduli = [Tensor4::<2>::default()];
        law().finite_moduli(&[zero()], &[s], &mut moduli);
        for i in 0..2 {
            for j in 0..2 {
                for k in 0..2 {
                    for l in 0..2 {
                        let d = moduli[0][i][j][k][l] - moduli[0][k][l][i][j];
                        assert!(d.abs() < 1e-14);
                    }
                }
            }
        }
    }

    #[test]
    fn a_rigid_rotation_turns_the_stress_and_adds_none() {
        let angle: f64 = 0.7;
        let (c, s) = (angle.cos(), angle.sin());
        let a = [[c - 1.0, -s], [s, c - 1.0]];
        let stress = [[2.0, 0.5], [0.5, -1.0]];
        let (mut next, mut first) = ([zero::<2>()], [zero::<2>()]);
        law()
            .finite_stress(&[a], &[stress], &mut next, &mut first)
            .unwrap();
        let r = [[c, -s], [s, c]];
        let turned = mul_transposed(&mul(&r, &stress), &r);
        for i in 0..2 {
            for j in 0..2 {
                assert!((next[0][i][j] - turned[i][j]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn one_axis_gives_henckys_law() {
        let steps = 200;
        let stretch: f64 = 0.8;
        let per_step = stretch.powf(1.0 / f64::from(steps)) - 1.0;
        let (mut stress, mut next, mut first) = ([zero::<2>()], [zero::<2>()], [zero::<2>()]);
        for _ in 0..steps {
            let a = [[0.0, 0.0], [0.0, per_step]];
            law()
                .finite_stress(&[a], &stress, &mut next, &mut first)
                .unwrap();
            stress = next;
        }
        let modulus = law().lambda + 2.0 * law().shear;
        assert!((stress[0][1][1] - modulus * stretch.ln()).abs() < 1e-6 * modulus);
    }

    #[test]
    fn an_inverted_increment_is_refused() {
        let a = [[-1.5, 0.0], [0.0, 0.0]];
        let (mut next, mut first) = ([zero::<2>()], [zero::<2>()]);
        let refused = law().finite_stress(&[a], &[zero()], &mut next, &mut first);
        assert_eq!(refused, Err((0, -0.5)));
    }

    #[test]
    fn energy_is_half_stress_times_strain() {
        let strain = [[0.01, 0.004], [0.004, -0.02]];
        let stress = law().law(&strain);
        let density = MaterialBlock::<2>::energy_density(&law(), &stress);
        assert!((density - 0.5 * contract(&stress, &strain)).abs() < 1e-15);
    }
}
