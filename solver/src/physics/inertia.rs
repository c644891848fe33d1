//! Inertia and what acts like it: M on accelerations, C on velocities, springs on displacements, from
//! coefficients of the points, either lumped to the nodes or consistent with the shape functions:
//!
//! ```text
//! lumped       M_I  = sum_p m_p N_I
//! consistent   M_IJ = sum_p m_p N_I N_J
//! ```
//!
//! Lumped masses delay waves by (kh)^2/24 with linear functions and (kh)^2/8 with quadratic B-splines,
//! which blur the motion twice; with consistent ones B-splines are exact to (kh)^4.

use super::kernel::{Lumped, RegionKernel};
use super::model::Region;
use crate::basis::Discretisation;
use crate::linear::block_matrix::BlockMatrix;
use crate::points::{BLOCK, Points, blocks};
use crate::tensor::Vector;
use crate::time::{Motion, Rates};
use std::ops::Range;

/// Coefficients of a block of points over their masses, in each direction.
#[derive(Clone, Debug, Default)]
pub struct PointInertia<const D: usize> {
    /// On accelerations; 1 for plain material.
    pub mass: Vec<Vector<D>>,
    /// On velocities (1/s); empty when nothing is damped.
    pub viscous: Vec<Vector<D>>,
    /// On displacements (1/s2); empty when there are no springs.
    pub stiffness: Vec<Vector<D>>,
}

impl<const D: usize> PointInertia<D> {
    /// Asks a kernel for those of `block`.
    fn ask(&mut self, kernel: &dyn RegionKernel<D>, block: Range<usize>) {
        self.mass.clear();
        self.mass.resize(block.len(), [1.0; D]);
        self.viscous.clear();
        self.stiffness.clear();
        kernel.inertia(block, self);
    }
}

/// Adds the lumped coefficients of a region.
pub(super) fn lump<const D: usize>(
    region: &Region<D>,
    disc: &dyn Discretisation<D>,
    points: &Points<D>,
    own: &mut PointInertia<D>,
    out: &mut Lumped<D>,
) {
    for block in blocks(region.range.clone()) {
        own.ask(region.kernel.as_ref(), block.clone());
        let mass = &points.mass[block.clone()];
        disc.scatter_vector(block.clone(), mass, &own.mass, &mut out.mass);
        if !own.viscous.is_empty() {
            disc.scatter_vector(block.clone(), mass, &own.viscous, out.viscous_mut());
        }
        if !own.stiffness.is_empty() {
            disc.scatter_vector(block, mass, &own.stiffness, out.stiffness_mut());
        }
    }
}

/// What consistent inertia needs beside the points.
#[derive(Debug)]
pub(super) struct Consistent<const D: usize> {
    /// What terms on nodes lump: all that is left on the diagonal.
    pub diagonal: Lumped<D>,
    own: PointInertia<D>,
}

impl<const D: usize> Consistent<D> {
    pub(super) fn new(nodes: usize) -> Self {
        Consistent {
            diagonal: Lumped::zeros(nodes),
            own: PointInertia::default(),
        }
    }

    /// Subtracts `M a + C v + K (u + increment)` of all regions; `u` is the displacement at the start.
    pub(super) fn subtract(
        &mut self,
        regions: &[Region<D>],
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        trial: &Motion<'_, D>,
        u: &[Vector<D>],
        out: &mut [Vector<D>],
    ) {
        let own = &mut self.own;
        let (mut sum, mut part) = ([[0.0; D]; BLOCK], [[0.0; D]; BLOCK]);
        for region in regions {
            for block in blocks(region.range.clone()) {
                own.ask(region.kernel.as_ref(), block.clone());
                let (sum, part) = (&mut sum[..block.len()], &mut part[..block.len()]);
                sum.fill([0.0; D]);
                let products = [
                    (&own.mass, trial.a),
                    (&own.viscous, trial.v),
                    (&own.stiffness, u),
                    (&own.stiffness, trial.increment),
                ];
                for (coefficients, field) in products {
                    if coefficients.is_empty() {
                        continue;
                    }
                    disc.gather(block.clone(), field, part);
                    for ((s, c), x) in sum.iter_mut().zip(coefficients).zip(&*part) {
                        for i in 0..D {
                            s[i] -= c[i] * x[i];
                        }
                    }
                }
                disc.scatter_vector(block.clone(), &points.mass[block], sum, out);
            }
        }
    }

    /// Adds `rates.mass M + rates.viscous C + K` of all regions.
    pub(super) fn add_to(
        &mut self,
        out: &mut BlockMatrix<D>,
        regions: &[Region<D>],
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        rates: Rates,
    ) {
        let own = &mut self.own;
        let mut weights = [[0.0; D]; BLOCK];
        for region in regions {
            for block in blocks(region.range.clone()) {
                own.ask(region.kernel.as_ref(), block.clone());
                let weights = &mut weights[..block.len()];
                for (b, w) in weights.iter_mut().enumerate() {
                    let at = |values: &[Vector<D>], i: usize| values.get(b).map_or(0.0, |v| v[i]);
                    *w = std::array::from_fn(|i| {
                        rates.mass * own.mass[b][i]
                            + rates.viscous * at(&own.viscous, i)
                            + at(&own.stiffness, i)
                    });
                    *w = w.map(|x| x * points.mass[block.start + b]);
                }
                disc.scatter_mass(block, weights, out);
            }
        }
    }
}
