//! A constitutive law of one point, as explicit steps need it: no tangent, the state by value, compiled
//! into the loop over points.

use crate::tensor::Matrix;
use std::fmt::Debug;

/// Moves what a point remembers through one explicit step.
///
/// Stresses are Kirchhoff stresses `tau = J sigma` (Pa), which go with volumes of the start; tension is
/// positive. In plane strain a law that flows keeps the stress across the plane as well.
///
/// `advance` and `stress`, and all that they call, are best `#[inline(always)]`: they are compiled into
/// loops over points for wider vectors than the rest of the program, and what stays outside does not
/// follow. (Twice the rate of the whole step for von Mises.)
pub trait Law<const D: usize>: Copy + Debug + Send + Sync + 'static {
    /// What a point remembers: a short array of numbers, zero where it is free of stress.
    type State: Copy + Debug + Default + AsRef<[f64]> + AsMut<[f64]> + Send + Sync + 'static;

    /// Name as in scenes.
    const NAME: &'static str;

    /// Moves the state by the velocity gradient `l` (1/s), `l[i][j] = d v_i / d x_j`, over `dt` (s).
    fn advance(&self, l: &Matrix<D>, dt: f64, state: &mut Self::State);

    /// The stress (Pa).
    fn stress(&self, state: &Self::State) -> Matrix<D>;

    /// The state of a point that starts under `stress` (Pa); across the plane as K0 conditions say.
    fn prestressed(&self, stress: &Matrix<D>) -> Self::State;

    /// Elastic energy per volume of the start (J/m3).
    fn energy_density(&self, state: &Self::State) -> f64;

    /// Modulus of compressional waves, lambda + 2 G (Pa): with the density it gives the fastest wave.
    fn p_modulus(&self) -> f64;
}
