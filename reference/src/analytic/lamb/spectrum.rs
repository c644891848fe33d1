//! Slowness spectrum of the half-space under an impulse of the line force.
//!
//! With potentials u_x = phi_x - psi_z, u_z = phi_z + psi_x (z downward), phi = A exp(-s (p x + eta_a z)),
//! psi = B exp(-s (p x + eta_b z)) and chi = b^2 - 2 p^2, the stresses on z = 0 are
//!
//! ```text
//! s_zz = s^2 G [chi A + 2 p eta_b B] = -s F_v,   s_xz = s^2 G [2 p eta_a A - chi B] = -s F_h
//! ```
//!
//! whose determinant is minus Rayleigh's function R = chi^2 + 4 p^2 eta_a eta_b. Solved for A and B and
//! put back into u, every power of s cancels.

use super::super::elastic::{Elastic, rayleigh_function, vertical_slowness};
use num_complex::Complex64;

/// Displacements of one wave: (u_x, u_y up) under the vertical force, then under the horizontal one.
pub(super) type Green = [Complex64; 4];

/// The half-space in terms of slownesses (s/m) and stiffness.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spectrum {
    /// Slowness of P.
    pub(super) a: f64,
    /// Slowness of S.
    pub(super) b: f64,
    /// Slowness of the Rayleigh wave.
    pub(super) rayleigh: f64,
    shear_modulus: f64,
}

impl Spectrum {
    pub(super) fn new(material: &Elastic) -> Self {
        Spectrum {
            a: 1.0 / material.p_speed(),
            b: 1.0 / material.s_speed(),
            rayleigh: 1.0 / material.rayleigh_speed(),
            shear_modulus: material.shear_modulus(),
        }
    }

    /// P(p) (s/(m Pa)).
    pub(super) fn p_wave(&self, p: Complex64) -> Green {
        self.scale(p, self.p_numerator(p))
    }

    /// S(p) (s/(m Pa)).
    pub(super) fn s_wave(&self, p: Complex64) -> Green {
        self.scale(p, self.s_numerator(p))
    }

    /// P(p) + S(p): at depth 0 both carry the same exponential.
    pub(super) fn surface(&self, p: Complex64) -> Green {
        self.scale(p, self.surface_numerator(p))
    }

    /// Residue of [`Spectrum::surface`] at the Rayleigh pole, on the upper side of the cuts.
    pub(super) fn rayleigh_residue(&self) -> Green {
        let p = Complex64::from(self.rayleigh);
        let (eta_a, eta_b) = self.etas(p);
        // R' by d(eta)/dp = -p/eta.
        let slope = 8.0 * p * (eta_a * eta_b - self.chi(p))
            - 4.0 * p * p * p * (eta_b / eta_a + eta_a / eta_b);
        self.surface_numerator(p)
            .map(|numerator| numerator / (self.shear_modulus * slope))
    }

    fn scale(&self, p: Complex64, numerators: Green) -> Green {
        let factor = (self.shear_modulus * rayleigh_function(p, self.a, self.b)).inv();
        numerators.map(|numerator| numerator * factor)
    }

    fn etas(&self, p: Complex64) -> (Complex64, Complex64) {
        (vertical_slowness(p, self.a), vertical_slowness(p, self.b))
    }

    fn chi(&self, p: Complex64) -> Complex64 {
        self.b * self.b - 2.0 * p * p
    }

    fn p_numerator(&self, p: Complex64) -> Green {
        let ((eta_a, eta_b), chi) = (self.etas(p), self.chi(p));
        [
            p * chi,
            -eta_a * chi,
            2.0 * p * p * eta_b,
            -2.0 * p * eta_a * eta_b,
        ]
    }

    fn s_numerator(&self, p: Complex64) -> Green {
        let ((eta_a, eta_b), chi) = (self.etas(p), self.chi(p));
        [
            -2.0 * p * eta_a * eta_b,
            -2.0 * p * p * eta_a,
            chi * eta_b,
            p * chi,
        ]
    }

    fn surface_numerator(&self, p: Complex64) -> Green {
        let (one, other) = (self.p_numerator(p), self.s_numerator(p));
        std::array::from_fn(|i| one[i] + other[i])
    }
}
