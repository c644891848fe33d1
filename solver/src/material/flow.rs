//! What laws that flow share: the elastic step in a turning frame and the return to a yield surface.
//!
//! The strain is that of [`super::linear_elastic`] (Hughes & Winget 1980), with `A = dt l`:
//!
//! ```text
//! G = 2 A (2 I + A)^-1,   W = skew G
//! X = W / (2 (1 + sqrt(1 + W:W/8))),   q = (I - X)^-1 (I + X)
//! trial = q (q tau q^T + lambda tr(G) I + 2 G_s sym G) q^T
//! ```
//!
//! q is half of the step's rotation: q q = (I - W/2)^-1 (I + W/2), exact where the step only turns
//! (tan of a quarter of the angle, from that of a half). The strain counts in the frame half-way
//! through the step, so it turns by the second half alone; turned by none it would lag, an error of
//! first order where material stretches and turns at once. Without spin both laws are one.
//!
//! Yield is judged by `J2 = s : s / 2`, s the deviator in three dimensions; the return shortens s and
//! leaves the mean stress alone (Wilkins 1964). In plane strain the stress across the plane belongs
//! to s, though no strain goes with it.

use crate::problem::Elastic;
use crate::tensor::{
    Matrix, add_scaled, contract, identity, inverse, mul, mul_transposed, skew, sym, trace,
};
use std::fmt::Debug;

/// Stress (Pa) by its independent components. In two dimensions the one across the plane is among them.
pub trait Components<const D: usize>:
    Copy + Debug + Default + AsRef<[f64]> + AsMut<[f64]> + Send + Sync + 'static
{
    /// From the stress in the plane and the normal stress across it, which 3D does not have.
    fn new(in_plane: &Matrix<D>, across: f64) -> Self;

    /// The stress in the plane; in 3D all of it.
    fn in_plane(&self) -> Matrix<D>;

    /// The normal stress across the plane; 0 in 3D.
    fn across(&self) -> f64;
}

/// xx, yy, xy, zz.
impl Components<2> for [f64; 4] {
    #[inline]
    fn new(m: &Matrix<2>, across: f64) -> Self {
        [m[0][0], m[1][1], m[0][1], across]
    }

    #[inline]
    fn in_plane(&self) -> Matrix<2> {
        [[self[0], self[2]], [self[2], self[1]]]
    }

    #[inline]
    fn across(&self) -> f64 {
        self[3]
    }
}

/// xx, yy, zz, xy, yz, zx.
impl Components<3> for [f64; 6] {
    #[inline]
    fn new(m: &Matrix<3>, _across: f64) -> Self {
        [m[0][0], m[1][1], m[2][2], m[0][1], m[1][2], m[2][0]]
    }

    #[inline]
    fn in_plane(&self) -> Matrix<3> {
        let [xx, yy, zz, xy, yz, zx] = *self;
        [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]]
    }

    #[inline]
    fn across(&self) -> f64 {
        0.0
    }
}

/// Strain and rotation of a step.
#[derive(Clone, Copy, Debug)]
pub struct MidPoint<const D: usize> {
    /// `sym G`, in the frame half-way through the step.
    pub strain: Matrix<D>,
    /// `q`, which turns from the start to half-way, and from there to the end.
    pub half_turn: Matrix<D>,
}

impl<const D: usize> MidPoint<D> {
    /// Of the velocity gradient `l` (1/s) over `dt` (s). Not finite where the step turns the material
    /// inside out so far that 2 I + A is singular.
    #[inline]
    pub fn new(l: &Matrix<D>, dt: f64) -> Self {
        let unit = identity::<D>();
        let doubled = l.map(|row| row.map(|rate| 2.0 * dt * rate));
        let twice_mid = add_scaled(&add_scaled(&unit, 1.0, &unit), 0.5, &doubled);
        let gradient = mul(&doubled, &inverse(&twice_mid).1);
        let spin = skew(&gradient);
        let quarter = 0.5 / (1.0 + (1.0 + 0.125 * contract(&spin, &spin)).sqrt());
        let (_, behind) = inverse(&add_scaled(&unit, -quarter, &spin));
        MidPoint {
            strain: sym(&gradient),
            half_turn: mul(&behind, &add_scaled(&unit, quarter, &spin)),
        }
    }

    /// A stress or strain half a step on.
    #[inline]
    fn turned(&self, m: &Matrix<D>) -> Matrix<D> {
        mul_transposed(&mul(&self.half_turn, m), &self.half_turn)
    }
}

/// Lamé's constants (Pa) behind a law that flows.
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

    /// The stress that an elastic step would leave.
    #[inline]
    pub fn trial<const D: usize, S: Components<D>>(&self, step: &MidPoint<D>, stress: &S) -> S {
        let pressure = self.lambda * trace(&step.strain);
        let mut half_way = step.turned(&stress.in_plane());
        half_way = add_scaled(&half_way, 2.0 * self.shear, &step.strain);
        half_way = add_scaled(&half_way, pressure, &identity::<D>());
        S::new(&step.turned(&half_way), stress.across() + pressure)
    }

    /// The state under `stress` where the strain across the plane is elastic and zero:
    /// zz = nu (xx + yy), nu = lambda/(2 (lambda + G)); with K0 = nu/(1 - nu) that is xx.
    pub fn under<const D: usize, S: Components<D>>(&self, stress: &Matrix<D>) -> S {
        let poisson = 0.5 * self.lambda / (self.lambda + self.shear);
        S::new(&sym(stress), poisson * trace(stress))
    }

    /// `tau : eps / 2`, eps = tau / (2 G) - lambda tr(tau) / (2 G (3 lambda + 2 G)) I, in J/m3.
    pub fn energy_density<const D: usize, S: Components<D>>(&self, stress: &S) -> f64 {
        let (m, across) = (stress.in_plane(), stress.across());
        let tr = trace(&m) + across;
        let share = self.lambda / (3.0 * self.lambda + 2.0 * self.shear);
        0.25 / self.shear * (contract(&m, &m) + across * across - share * tr * tr)
    }

    /// lambda + 2 G (Pa).
    pub fn p_modulus(&self) -> f64 {
        self.lambda + 2.0 * self.shear
    }
}

/// Shortens the deviator of `trial` until sqrt(J2) is the strength (Pa).
///
/// `strength` is asked only where sqrt(J2) exceeds `least`, which it must not fall below.
#[inline]
pub fn radial_return<const D: usize, S: Components<D>>(
    trial: S,
    least: f64,
    strength: impl FnOnce() -> f64,
) -> S {
    let (m, across) = (trial.in_plane(), trial.across());
    let mean = (trace(&m) + across) / 3.0;
    let deviator = add_scaled(&m, -mean, &identity::<D>());
    let deviator_across = if D < 3 { across - mean } else { 0.0 };
    let j2 = 0.5 * (contract(&deviator, &deviator) + deviator_across * deviator_across);
    if j2 <= least * least {
        return trial;
    }
    let strength = strength();
    if j2 <= strength * strength {
        return trial;
    }
    let kept = strength / j2.sqrt();
    S::new(
        &add_scaled(
            &deviator.map(|row| row.map(|s| kept * s)),
            mean,
            &identity(),
        ),
        kept * deviator_across + mean,
    )
}

#[cfg(test)]
pub(super) mod tests;
