//! Which nodes a point sees, with which `N` and `grad N`: one file a basis.
//!
//! Kernels speak to a [`Discretisation`] in blocks of points, so that the choice of the basis is
//! made once a block and the loops within are compiled for it.

pub mod along;
pub mod bspline;
mod faint;
pub mod gimp;
pub mod grid_basis;
pub mod linear;

use crate::grid::Grid;
use crate::linear::block_matrix::{BlockMatrix, Pattern};
use crate::problem::BasisKind;
use crate::tensor::{Matrix, Tensor4, Vector};
use grid_basis::GridDiscretisation;
use std::ops::Range;
use std::sync::Arc;

/// Nodes and weights at one place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Sample {
    /// Nodes.
    pub nodes: Vec<u32>,
    /// Values of their shape functions.
    pub weights: Vec<f64>,
}

impl Sample {
    /// Sum of the weights of active nodes.
    pub fn active_weight(&self, active: &[bool]) -> f64 {
        let pairs = self.nodes.iter().zip(&self.weights);
        pairs
            .filter(|(n, _)| active[**n as usize])
            .map(|(_, w)| w)
            .sum()
    }

    /// The interpolated vector, by the nodes that `active` names alone: weights of nodes without
    /// mass go to the others, so that a place on the surface reads the material's motion.
    pub fn interpolate<const D: usize>(&self, field: &[Vector<D>], active: &[bool]) -> Vector<D> {
        let (mut sum, mut total) = ([0.0; D], 0.0);
        for (&node, &w) in self.nodes.iter().zip(&self.weights) {
            if active[node as usize] {
                total += w;
                for i in 0..D {
                    sum[i] += w * field[node as usize][i];
                }
            }
        }
        if total > 0.0 {
            sum.map(|s| s / total)
        } else {
            sum
        }
    }
}

/// Answers for all points which nodes they see. Blocks are ranges of points; outputs of a block are
/// indexed from its start.
pub trait Discretisation<const D: usize>: Send {
    /// Name of the basis.
    fn name(&self) -> &'static str;

    /// Number of nodes.
    fn node_count(&self) -> usize;

    /// Which nodes can couple.
    fn pattern(&self) -> Arc<Pattern>;

    /// Order of elimination for a direct solver.
    fn elimination_order(&self) -> Vec<u32>;

    /// Takes the places of all points. `Err(p)` names the first point that no node sees.
    fn place(&mut self, places: &[Vector<D>]) -> Result<(), usize>;

    /// Takes new places of the first points. `Err(p)` as for [`Discretisation::place`].
    ///
    /// # Errors
    /// The first point that no node sees.
    fn replace(&mut self, places: &[Vector<D>]) -> Result<(), usize>;

    /// Nodes and weights at `x`; empty outside.
    fn sample(&self, x: &Vector<D>) -> Sample {
        let mut sample = Sample::default();
        self.sample_into(x, &mut sample);
        sample
    }

    /// The same, in place of what `out` holds.
    fn sample_into(&self, x: &Vector<D>, out: &mut Sample);

    /// Adds `w_p N_I` to the nodes: lumped masses from the points' masses.
    fn scatter_scalar(&self, block: Range<usize>, values: &[f64], out: &mut [f64]);

    /// Adds `w_p N_I f_p` to the nodes.
    fn scatter_vector(
        &self,
        block: Range<usize>,
        weights: &[f64],
        values: &[Vector<D>],
        out: &mut [Vector<D>],
    );

    /// Adds `w_p N_I [f_p + L_p (x_I - x_p)]` to the nodes: the affine transfer.
    fn scatter_affine(
        &self,
        block: Range<usize>,
        weights: &[f64],
        values: &[Vector<D>],
        gradients: &[Matrix<D>],
        places: &[Vector<D>],
        out: &mut [Vector<D>],
    );

    /// Interpolates a nodal field to the points of a block.
    fn gather(&self, block: Range<usize>, field: &[Vector<D>], out: &mut [Vector<D>]);

    /// Gradient of a nodal field, `out[p][i][j] = d f_i / d x_j`.
    fn gradient(&self, block: Range<usize>, field: &[Vector<D>], out: &mut [Matrix<D>]);

    /// Adds `V_p P_ij dN_I/dx_j` to component i of node I.
    fn scatter_stress(
        &self,
        block: Range<usize>,
        volumes: &[f64],
        stress: &[Matrix<D>],
        out: &mut [Vector<D>],
    );

    /// Adds `w_p N_I N_J` in each direction to the diagonal of block (I, J): consistent masses.
    fn scatter_mass(&self, block: Range<usize>, weights: &[Vector<D>], out: &mut BlockMatrix<D>);

    /// Adds `V_p dN_I/dx_j A_ijkl dN_J/dx_l` to entry (i, k) of block (I, J).
    fn scatter_tangent(
        &self,
        block: Range<usize>,
        volumes: &[f64],
        moduli: &[Tensor4<D>],
        out: &mut BlockMatrix<D>,
    );

    /// Nodes that a node couples with, itself included.
    fn couplings(&self) -> usize;

    /// Memory of one point in bytes.
    fn bytes_per_point(&self) -> usize;
}

/// The discretisation by the basis called `kind` of `grid`, whose cells are filled with `per_axis`
/// points along each axis.
pub fn on_grid<const D: usize>(
    kind: BasisKind,
    grid: &Grid<D>,
    per_axis: usize,
) -> Box<dyn Discretisation<D>> {
    let (grid, per_cell) = (grid.clone(), per_axis.pow(D as u32));
    match kind {
        BasisKind::Linear => Box::new(GridDiscretisation::new(grid, linear::Linear, per_cell)),
        BasisKind::Gimp => Box::new(GridDiscretisation::new(
            grid,
            gimp::Gimp::new(per_axis),
            per_cell,
        )),
        BasisKind::Bspline => Box::new(GridDiscretisation::new(
            grid,
            bspline::QuadraticBSpline,
            per_cell,
        )),
    }
}
