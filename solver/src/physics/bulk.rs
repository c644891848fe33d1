//! Plain solid.
//!
//! Two kernels: [`Kept`] for frozen points whose nodes keep the displacement (the force is K u), and
//! [`Carried`] for points that carry their stress, in small strain when frozen and in finite strain
//! when they move.

use super::kernel::{ExplicitKernel, RegionKernel, Stiffness, Trial};
use crate::basis::Discretisation;
use crate::error::SolverError;
use crate::linear::block_matrix::BlockMatrix;
use crate::material::MaterialBlock;
use crate::points::{BLOCK, Points, blocks};
use crate::tensor::{Matrix, Tensor4, Vector, zero};
use std::ops::Range;

/// Frozen points, displacement kept on nodes.
pub struct Kept<const D: usize> {
    range: Range<usize>,
    material: Box<dyn MaterialBlock<D>>,
}

impl<const D: usize> Kept<D> {
    /// The points of `range` with their material.
    pub fn new(range: Range<usize>, material: Box<dyn MaterialBlock<D>>) -> Self {
        Kept { range, material }
    }

    /// Stress of a block at the displacement `u`.
    fn stress(
        &self,
        disc: &dyn Discretisation<D>,
        block: Range<usize>,
        u: &[Vector<D>],
        out: &mut [Matrix<D>],
    ) {
        let mut gradient = [zero::<D>(); BLOCK];
        let gradient = &mut gradient[..block.len()];
        disc.gradient(block, u, gradient);
        out.fill(zero());
        self.material.small_stress(gradient, out);
    }
}

impl<const D: usize> RegionKernel<D> for Kept<D> {
    fn force(&mut self, trial: &Trial<'_, D>, out: &mut [Vector<D>]) -> Result<(), SolverError> {
        let mut stress = [zero::<D>(); BLOCK];
        for displacement in [trial.start, trial.increment] {
            for block in blocks(self.range.clone()) {
                let stress = &mut stress[..block.len()];
                self.stress(trial.disc, block.clone(), displacement, stress);
                trial
                    .disc
                    .scatter_stress(block.clone(), &trial.points.volume[block], stress, out);
            }
        }
        Ok(())
    }

    fn tangent(&mut self, trial: &Trial<'_, D>, out: &mut BlockMatrix<D>) {
        let moduli = [self.material.small_moduli(); BLOCK];
        for block in blocks(self.range.clone()) {
            let volumes = &trial.points.volume[block.clone()];
            trial
                .disc
                .scatter_tangent(block.clone(), volumes, &moduli[..block.len()], out);
        }
    }

    fn commit(&mut self, _trial: &Trial<'_, D>) -> Result<(), SolverError> {
        Ok(())
    }

    fn stiffness(&self) -> Stiffness {
        Stiffness::Linear
    }

    fn explicit(&mut self) -> Option<&mut dyn ExplicitKernel<D>> {
        Some(self)
    }

    fn strain_energy(
        &self,
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        u: &[Vector<D>],
    ) -> f64 {
        let mut stress = [zero::<D>(); BLOCK];
        let mut energy = 0.0;
        for block in blocks(self.range.clone()) {
            let stress = &mut stress[..block.len()];
            self.stress(disc, block.clone(), u, stress);
            for (s, v) in stress.iter().zip(&points.volume[block]) {
                energy += v * self.material.energy_density(s);
            }
        }
        energy
    }
}

impl<const D: usize> ExplicitKernel<D> for Kept<D> {
    /// Nothing: the model applies the assembled matrix.
    fn present_force(
        &mut self,
        _disc: &dyn Discretisation<D>,
        _points: &Points<D>,
        _out: &mut [Vector<D>],
    ) {
    }

    fn advance(&mut self, _trial: &Trial<'_, D>) -> Result<(), SolverError> {
        Ok(())
    }
}

/// Points that carry their stress.
pub struct Carried<const D: usize> {
    range: Range<usize>,
    material: Box<dyn MaterialBlock<D>>,
    finite: bool,
    /// Cauchy (small strain) or Kirchhoff stress (Pa).
    stress: Vec<Matrix<D>>,
    /// The same at the end of the trial step whose force was asked for last.
    next: Vec<Matrix<D>>,
}

impl<const D: usize> Carried<D> {
    /// The points of `range`, free of stress; `finite` strain when they move.
    pub fn new(range: Range<usize>, material: Box<dyn MaterialBlock<D>>, finite: bool) -> Self {
        let stress = vec![zero(); range.len()];
        Carried {
            range,
            material,
            finite,
            next: stress.clone(),
            stress,
        }
    }

    /// Places of the block's stresses in the region's own column.
    fn own(&self, block: &Range<usize>) -> Range<usize> {
        block.start - self.range.start..block.end - self.range.start
    }

    /// Stress `next` and first Piola-Kirchhoff stress `first` of a block at the end of the trial.
    fn trial_stress(
        &self,
        trial: &Trial<'_, D>,
        block: &Range<usize>,
        next: &mut [Matrix<D>],
        first: &mut [Matrix<D>],
    ) -> Result<(), SolverError> {
        let mut gradient = [zero::<D>(); BLOCK];
        let gradient = &mut gradient[..block.len()];
        trial
            .disc
            .gradient(block.clone(), trial.increment, gradient);
        let start = &self.stress[self.own(block)];
        if !self.finite {
            next.copy_from_slice(start);
            self.material.small_stress(gradient, next);
            first.copy_from_slice(next);
            return Ok(());
        }
        self.material
            .finite_stress(gradient, start, next, first)
            .map_err(|(p, determinant)| SolverError::InvertedPoint {
                step: trial.moment.step,
                time_s: trial.moment.time_s,
                place: trial.points.place[block.start + p].to_vec(),
                determinant,
            })
    }
}

impl<const D: usize> RegionKernel<D> for Carried<D> {
    fn force(&mut self, trial: &Trial<'_, D>, out: &mut [Vector<D>]) -> Result<(), SolverError> {
        let mut first = [zero::<D>(); BLOCK];
        let mut next = std::mem::take(&mut self.next);
        let mut result = Ok(());
        for block in blocks(self.range.clone()) {
            let n = block.len();
            let own = self.own(&block);
            result = self.trial_stress(trial, &block, &mut next[own], &mut first[..n]);
            if result.is_err() {
                break;
            }
            let volumes = &trial.points.volume[block.clone()];
            trial.disc.scatter_stress(block, volumes, &first[..n], out);
        }
        self.next = next;
        result
    }

    fn tangent(&mut self, trial: &Trial<'_, D>, out: &mut BlockMatrix<D>) {
        let mut gradient = [zero::<D>(); BLOCK];
        let mut moduli: [Tensor4<D>; BLOCK] = [self.material.small_moduli(); BLOCK];
        for block in blocks(self.range.clone()) {
            let n = block.len();
            if self.finite {
                trial
                    .disc
                    .gradient(block.clone(), trial.increment, &mut gradient[..n]);
                let start = &self.stress[self.own(&block)];
                self.material
                    .finite_moduli(&gradient[..n], start, &mut moduli[..n]);
            }
            let volumes = &trial.points.volume[block.clone()];
            trial
                .disc
                .scatter_tangent(block, volumes, &moduli[..n], out);
        }
    }

    fn commit(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError> {
        if !self.finite {
            // a linear step is accepted without a second look at its forces
            return self.advance(trial);
        }
        std::mem::swap(&mut self.stress, &mut self.next);
        Ok(())
    }

    fn explicit(&mut self) -> Option<&mut dyn ExplicitKernel<D>> {
        Some(self)
    }

    fn stiffness(&self) -> Stiffness {
        if self.finite {
            Stiffness::Varying
        } else {
            Stiffness::Constant
        }
    }

    fn strain_energy(
        &self,
        _disc: &dyn Discretisation<D>,
        points: &Points<D>,
        _u: &[Vector<D>],
    ) -> f64 {
        let volumes = &points.volume[self.range.clone()];
        self.stress
            .iter()
            .zip(volumes)
            .map(|(s, v)| v * self.material.energy_density(s))
            .sum()
    }
}

impl<const D: usize> ExplicitKernel<D> for Carried<D> {
    /// By the Kirchhoff stress and the volumes of the start; at the start of a step it is the first
    /// Piola-Kirchhoff stress too.
    fn present_force(
        &mut self,
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        out: &mut [Vector<D>],
    ) {
        for block in blocks(self.range.clone()) {
            let stress = &self.stress[self.own(&block)];
            disc.scatter_stress(block.clone(), &points.volume[block], stress, out);
        }
    }

    fn advance(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError> {
        let mut first = [zero::<D>(); BLOCK];
        let mut next = std::mem::take(&mut self.next);
        let mut result = Ok(());
        for block in blocks(self.range.clone()) {
            let own = self.own(&block);
            result = self.trial_stress(trial, &block, &mut next[own], &mut first[..block.len()]);
            if result.is_err() {
                break;
            }
        }
        self.next = next;
        result?;
        std::mem::swap(&mut self.stress, &mut self.next);
        Ok(())
    }
}
