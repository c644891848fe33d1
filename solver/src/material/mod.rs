//! Constitutive models, one file each. Chosen once a region, called once a block of points.

pub mod flow;
pub mod herschel_bulkley;
pub mod law;
pub mod linear_elastic;
pub mod strength;
pub mod von_mises;

use crate::tensor::{Matrix, Tensor4};

/// Stress and tangent of blocks of points.
///
/// Small strain works on Cauchy stress; finite strain on Kirchhoff stress `tau = J sigma` with
/// volumes of the start, and returns the first Piola-Kirchhoff stress and its derivative with
/// respect to the configuration at the start of the step.
pub trait MaterialBlock<const D: usize>: Send {
    /// Name as in scenes.
    fn name(&self) -> &'static str;

    /// The moduli of small strain, `C_ijkl`.
    fn small_moduli(&self) -> Tensor4<D>;

    /// Adds the stress of the increments' gradients: `sigma += C : sym grad du`.
    fn small_stress(&self, increments: &[Matrix<D>], stress: &mut [Matrix<D>]);

    /// Stress after the step: `next` becomes the Kirchhoff stress, `first` the first Piola-Kirchhoff
    /// stress, both for the increment `grad du` on the configuration at the start of the step.
    ///
    /// # Errors
    /// The point of the block whose increment has no positive determinant, with the determinant.
    fn finite_stress(
        &self,
        increments: &[Matrix<D>],
        stress: &[Matrix<D>],
        next: &mut [Matrix<D>],
        first: &mut [Matrix<D>],
    ) -> Result<(), (usize, f64)>;

    /// Derivative of the first Piola-Kirchhoff stress with respect to `grad du`.
    fn finite_moduli(
        &self,
        increments: &[Matrix<D>],
        stress: &[Matrix<D>],
        moduli: &mut [Tensor4<D>],
    );

    /// Elastic energy per volume of the start (J/m3).
    fn energy_density(&self, stress: &Matrix<D>) -> f64;
}
