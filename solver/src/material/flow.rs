//! What laws that flow share: the elastic step in a turning frame and the return to a yield surface.
//!
//! The strain is that of [`super::linear_elastic`] (Hughes & Winget 1980), with `A = dt l`:
//!
//! ```text
//! G = 2 A (2 I + A)^-1,   W = skew G,   q q = (I - W/2)^-1 (I + W/2)
//! trial = q (q tau q^T + lambda tr(G) I + 2 G_s sym G) q^T
//! ```
//!
//! q is half of the step's rotation, exact where the step only turns. The strain counts in the frame
//! half-way through the step, so it turns by the second half alone; turned by none it would lag, an
//! error of first order where material stretches and turns at once. Without spin this is the law of
//! `linear_elastic`.
//!
//! Yield is judged by `J2 = s : s / 2`, s the deviator in three dimensions; the return shortens s and
//! leaves the mean stress alone (Wilkins 1964). In plane strain the stress across the plane belongs
//! to s, though no strain goes with it.

mod plane;
mod solid;

pub use plane::PlaneStep;
pub use solid::{SolidStep, components, tensor};

use crate::problem::Elastic;
use crate::tensor::Matrix;
use std::fmt::Debug;

/// Stress (Pa) by its independent components. In two dimensions the one across the plane is among them.
pub trait Components<const D: usize>:
    Copy + Debug + Default + AsRef<[f64]> + AsMut<[f64]> + Send + Sync + 'static
{
    /// Places of the normal stresses.
    const NORMAL: [usize; 3];
    /// Places of the shear stresses, each once.
    const SHEAR: &'static [usize];

    /// Mean stress (Pa).
    #[inline(always)]
    fn mean(&self) -> f64 {
        let (s, [a, b, c]) = (self.as_ref(), Self::NORMAL);
        (s[a] + s[b] + s[c]) * (1.0 / 3.0)
    }

    /// J2 (Pa2), from the differences of the normal stresses.
    #[inline(always)]
    fn j2(&self) -> f64 {
        let (s, [a, b, c]) = (self.as_ref(), Self::NORMAL);
        let (ab, bc, ca) = (s[a] - s[b], s[b] - s[c], s[c] - s[a]);
        let mut j2 = (ab * ab + bc * bc + ca * ca) * (1.0 / 6.0);
        for &i in Self::SHEAR {
            j2 += s[i] * s[i];
        }
        j2
    }

    /// The same stress with its deviator at `share` of itself.
    #[inline(always)]
    fn with_deviator(mut self, share: f64) -> Self {
        let mean = self.mean();
        let s = self.as_mut();
        for i in Self::NORMAL {
            s[i] = mean + share * (s[i] - mean);
        }
        for &i in Self::SHEAR {
            s[i] *= share;
        }
        self
    }
}

/// xx, yy, xy, zz.
impl Components<2> for [f64; 4] {
    const NORMAL: [usize; 3] = [0, 1, 3];
    const SHEAR: &'static [usize] = &[2];
}

/// xx, yy, zz, xy, yz, zx.
impl Components<3> for [f64; 6] {
    const NORMAL: [usize; 3] = [0, 1, 2];
    const SHEAR: &'static [usize] = &[3, 4, 5];
}

/// Elastic constants (Pa) behind a law that flows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hypoelastic {
    lambda: f64,
    shear: f64,
}

impl Hypoelastic {
    /// The constants of `elastic`.
    pub fn new(elastic: &Elastic) -> Self {
        Hypoelastic {
            lambda: elastic.lambda(),
            shear: elastic.shear_modulus(),
        }
    }

    /// The plane state under `stress` (Pa) where the strain across the plane is elastic and zero:
    /// zz = nu (xx + yy), nu = lambda/(2 (lambda + G)); with K0 = nu/(1 - nu) that is xx.
    pub fn under(&self, stress: &Matrix<2>) -> [f64; 4] {
        let poisson = 0.5 * self.lambda / (self.lambda + self.shear);
        let [[xx, xy], [_, yy]] = *stress;
        [xx, yy, xy, poisson * (xx + yy)]
    }

    /// Energy of pressure and of shear, p^2/(2 K) + J2/(2 G) (J/m3), K = lambda + 2 G/3.
    pub fn energy_density<const D: usize, S: Components<D>>(&self, stress: &S) -> f64 {
        let bulk = self.lambda + 2.0 / 3.0 * self.shear;
        0.5 * (stress.mean().powi(2) / bulk + stress.j2() / self.shear)
    }

    /// lambda + 2 G (Pa).
    pub fn p_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.shear
    }
}

/// Shortens the deviator of `trial` until sqrt(J2) is the strength (Pa).
///
/// `strength` is asked only where sqrt(J2) exceeds `least`, which it must not fall below.
#[inline(always)]
pub fn radial_return<const D: usize, S: Components<D>>(
    trial: S,
    least: f64,
    strength: impl FnOnce() -> f64,
) -> S {
    let j2 = trial.j2();
    if j2 <= least * least {
        return trial;
    }
    let strength = strength();
    if j2 <= strength * strength {
        return trial;
    }
    trial.with_deviator(strength / j2.sqrt())
}

#[cfg(test)]
pub(super) mod tests;
