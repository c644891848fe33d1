//! Volumes by cell against locking: the trace of a point's velocity gradient is replaced by its cell's,
//! the divergence at the cell's centre by multilinear functions of its 2^D nodes (the F-bar idea of de
//! Souza Neto et al. 1996 in rates, over cells of the grid):
//!
//! ```text
//! l = l_p + (d_c - tr l_p)/D I,    d_c = sum v_I . grad N_I(centre)
//! ```
//!
//! Forces are the adjoint, so that they do the work that the stress does: mean stresses
//! `p = tr tau / D` act through the centre's gradients, the rest through the points' own,
//!
//! ```text
//! f_I = - sum_p V (tau - p I) grad N_I(x_p) - sum_c (sum_p V p) grad N_I(centre)
//! ```
//!
//! In plane strain both traces are those in the plane. Cells are numbered by their lowest node.

use super::lanes::Packed;
use crate::grid::Grid;
use crate::tensor::Vector;

/// A number a cell, under the number of its lowest node: sums of `- V p` (J) on the way to the nodes,
/// divergences (1/s) on the way back.
#[derive(Debug)]
pub(super) struct Cells {
    pub values: Vec<f64>,
    /// For the cells whose lowest node is first in a row along x: that node.
    rows: Vec<u32>,
}

impl Cells {
    /// For the cells of a grid.
    pub fn new<const D: usize>(grid: &Grid<D>) -> Self {
        let rows = (0..grid.node_count()).filter(|&node| {
            let index = grid.lattice(node);
            index[0] == 0 && (1..D).all(|a| index[a] < grid.cells[a])
        });
        Cells {
            rows: rows.map(|node| node as u32).collect(),
            values: vec![0.0; grid.node_count()],
        }
    }

    /// Gives the mean stresses of all cells to their nodes.
    pub fn force<const D: usize>(&self, grid: &Grid<D>, out: &mut [Vector<D>]) {
        let corners = corners(grid);
        for &row in &self.rows {
            for cell in row as usize..row as usize + grid.cells[0] {
                let sum = self.values[cell];
                if sum == 0.0 {
                    continue;
                }
                for (offset, gradient) in &corners[..1 << D] {
                    let force = &mut out[cell + offset];
                    *force = std::array::from_fn(|i| force[i] + sum * gradient[i]);
                }
            }
        }
    }

    /// Takes the divergences of all cells from the velocities `v` (m/s) of the nodes.
    pub fn diverge<const D: usize>(&mut self, grid: &Grid<D>, v: &[Vector<D>]) {
        let corners = corners(grid);
        for &row in &self.rows {
            for cell in row as usize..row as usize + grid.cells[0] {
                let mut divergence = 0.0;
                for (offset, gradient) in &corners[..1 << D] {
                    let v = &v[cell + offset];
                    for i in 0..D {
                        divergence += v[i] * gradient[i];
                    }
                }
                self.values[cell] = divergence;
            }
        }
    }
}

/// The nodes of a cell, from its lowest, and the gradients (1/m) of their functions at its centre.
fn corners<const D: usize>(grid: &Grid<D>) -> [(usize, Vector<D>); 8] {
    let share = 0.5f64.powi(D as i32 - 1);
    std::array::from_fn(|k| {
        let up: [usize; D] = std::array::from_fn(|a| k >> a & 1);
        let gradient = std::array::from_fn(|a| (2.0 * up[a] as f64 - 1.0) * share / grid.h[a]);
        (grid.node(up), gradient)
    })
}

/// The cell of a point within the grid.
#[inline]
fn cell<const D: usize>(grid: &Grid<D>, x: &Vector<D>) -> usize {
    let index = std::array::from_fn(|a| {
        (((x[a] - grid.origin[a]) / grid.h[a]) as usize).min(grid.cells[a] - 1)
    });
    grid.node(index)
}

/// Takes the mean stresses of a block's points at `places` out of what is packed for the nodes and adds
/// them to the cells from number `first` on.
pub(super) fn take_means<const D: usize>(
    grid: &Grid<D>,
    places: &[Vector<D>],
    packed: &mut [Packed<D>],
    first: usize,
    cells: &mut [f64],
) {
    for (x, packed) in places.iter().zip(packed) {
        let trace: f64 = (0..D).map(|d| packed.columns[d][1][d]).sum();
        let mean = trace / D as f64;
        for d in 0..D {
            packed.columns[d][1][d] -= mean;
        }
        cells[cell(grid, x) - first] += mean;
    }
}

/// Gives the points of a block at `places` the divergences of their cells.
pub(super) fn give_divergences<const D: usize>(
    grid: &Grid<D>,
    places: &[Vector<D>],
    packed: &mut [Packed<D>],
    cells: &[f64],
) {
    for (x, packed) in places.iter().zip(packed) {
        let trace: f64 = (0..D).map(|d| packed.columns[d][0][d]).sum();
        let more = (cells[cell(grid, x)] - trace) / D as f64;
        for d in 0..D {
            packed.columns[d][0][d] += more;
        }
    }
}
