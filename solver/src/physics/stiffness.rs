//! The effective matrix `rates.mass M + rates.viscous C + K`, and the parts of K that stay.

use super::kernel::{Lumped, NodeTerm, Stiffness, Trial};
use super::model::Region;
use crate::basis::Discretisation;
use crate::linear::Moment;
use crate::linear::block_matrix::BlockMatrix;
use crate::points::Points;
use crate::tensor::Vector;
use crate::time::Rates;

/// Steps end at multiples of their length, so that lengths taken as differences vary by rounding: by
/// so much of themselves at most in a run of a million steps.
const ROUNDING: f64 = 1e-9;

/// Are two lengths of steps, or rates made of them, the same but for rounding? NaN never is.
fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * b.abs()
}

/// Matrices of a model.
pub struct Matrices<const D: usize> {
    /// Stiffness of the regions whose force is K times the displacement.
    linear: Option<BlockMatrix<D>>,
    /// Tangent of the regions whose tangent stays; made when the length of the step is known.
    constant: Option<BlockMatrix<D>>,
    constant_dt: f64,
    effective: BlockMatrix<D>,
    rates: Option<Rates>,
}

/// What the effective matrix is made of besides the regions.
pub struct Surroundings<'a, const D: usize> {
    /// Lumped coefficients of the nodes; those of terms alone when there is consistent inertia.
    pub diagonal: &'a Lumped<D>,
    /// Terms on nodes.
    pub terms: &'a [Box<dyn NodeTerm<D>>],
    /// Nodes with mass.
    pub active: &'a [bool],
}

impl<const D: usize> Matrices<D> {
    /// Assembles what does not depend on the step; `solved` with room for the effective matrix.
    pub fn new(
        regions: &mut [Region<D>],
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        solved: bool,
    ) -> Self {
        let rest = vec![[0.0; D]; disc.node_count()];
        let moment = Moment {
            step: 0,
            time_s: 0.0,
        };
        let trial = Trial {
            disc,
            points,
            start: &rest,
            increment: &rest,
            dt: 0.0,
            moment,
        };
        Matrices {
            linear: assembled(regions, &trial, Stiffness::Linear),
            constant: None,
            constant_dt: f64::NAN,
            effective: if solved {
                BlockMatrix::zeros(disc.pattern())
            } else {
                BlockMatrix::empty(disc.pattern())
            },
            rates: None,
        }
    }

    /// Stiffness of the regions whose force is linear in the displacement.
    pub fn linear(&self) -> Option<&BlockMatrix<D>> {
        self.linear.as_ref()
    }

    /// The effective matrix.
    pub fn effective(&self) -> &BlockMatrix<D> {
        &self.effective
    }

    /// The effective matrix, to add to.
    pub fn effective_mut(&mut self) -> &mut BlockMatrix<D> {
        &mut self.effective
    }

    /// Does the effective matrix stand for these rates?
    pub fn stands_for(&self, rates: Rates) -> bool {
        self.rates.is_some_and(|standing| {
            same(standing.mass, rates.mass) && same(standing.viscous, rates.viscous)
        })
    }

    /// Says that points have moved.
    pub fn invalidate(&mut self) {
        self.rates = None;
    }

    /// Assembles the effective matrix at a trial state.
    pub fn assemble(
        &mut self,
        rates: Rates,
        regions: &mut [Region<D>],
        trial: &Trial<'_, D>,
        around: &Surroundings<'_, D>,
    ) {
        if !same(self.constant_dt, trial.dt) {
            self.constant = assembled(regions, trial, Stiffness::Constant);
            self.constant_dt = trial.dt;
        }
        match (&self.linear, &self.constant) {
            (Some(first), None) | (None, Some(first)) => {
                self.effective.blocks.copy_from_slice(&first.blocks);
            }
            (Some(first), Some(second)) => {
                self.effective.blocks.copy_from_slice(&first.blocks);
                self.effective.add_matrix(second);
            }
            (None, None) => self.effective.clear(),
        }
        for region in regions.iter_mut() {
            if region.kernel.stiffness() == Stiffness::Varying {
                region.kernel.tangent(trial, &mut self.effective);
            }
        }
        let lumped = around.diagonal;
        self.effective.add_diagonal(rates.mass, &lumped.mass);
        self.effective.add_diagonal(rates.viscous, &lumped.viscous);
        self.effective.add_diagonal(1.0, &lumped.stiffness);
        for term in around.terms {
            term.tangent(rates.viscous, around.active, &mut self.effective);
        }
        self.rates = Some(rates);
    }
}

/// The tangent of all regions of one kind; `None` when there are none.
fn assembled<const D: usize>(
    regions: &mut [Region<D>],
    trial: &Trial<'_, D>,
    kind: Stiffness,
) -> Option<BlockMatrix<D>> {
    let mut of_kind = regions
        .iter_mut()
        .filter(|r| r.kernel.stiffness() == kind)
        .peekable();
    of_kind.peek()?;
    let mut matrix = BlockMatrix::zeros(trial.disc.pattern());
    for region in of_kind {
        region.kernel.tangent(trial, &mut matrix);
    }
    Some(matrix)
}

/// Adds the tangent of a range of points with one tensor a point.
pub fn scatter_moduli<const D: usize>(
    range: std::ops::Range<usize>,
    trial: &Trial<'_, D>,
    mut moduli_of: impl FnMut(usize) -> crate::tensor::Tensor4<D>,
    out: &mut BlockMatrix<D>,
) {
    let mut moduli = Vec::with_capacity(crate::points::BLOCK);
    for block in crate::points::blocks(range) {
        moduli.clear();
        moduli.extend(block.clone().map(&mut moduli_of));
        trial
            .disc
            .scatter_tangent(block.clone(), &trial.points.volume[block], &moduli, out);
    }
}

/// Sum of squares weighted by a nodal coefficient.
pub fn weighted_square<const D: usize>(weights: &[Vector<D>], values: &[Vector<D>]) -> f64 {
    let mut sum = 0.0;
    for (w, x) in weights.iter().zip(values) {
        for i in 0..D {
            sum += (w[i] * x[i]).powi(2);
        }
    }
    sum
}
