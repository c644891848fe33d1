//! Volumes by cell against locking: the traces of the points' velocity gradients and of their stresses are
//! replaced by their means over the n_c points of a cell (the F-bar idea of de Souza Neto et al. 1996 in
//! rates, over cells of the grid):
//!
//! ```text
//! l = l_p + (d_c - tr l_p)/D I,                  d_c = 1/n_c sum_q tr l_q
//! f_I = - sum_p V [tau + (s_c - tr tau)/D I] grad N_I(x_p),   s_c = 1/n_c sum_q tr tau_q
//! ```
//!
//! Points of a region have one volume V, so that the forces do the work that the stress does,
//! `sum_I f_I . v_I = - sum_p V tau : l`. The square of a mean is at most the mean of the squares:
//!
//! ```text
//! sum_c n_c V K d_c^2 <= sum_p V K (tr l_p)^2
//! ```
//!
//! whatever the nodes' masses are, so a step that is stable with the points' own divergences stays so. The
//! divergence at the cell's centre, the usual choice, has no such bound: its gradients do not fall off
//! where the points' own do, and turn nodes of hardly any mass around within a step at a surface.
//!
//! In plane strain both traces are those in the plane. Cells are numbered by their lowest node.

use super::lanes::Packed;
use super::stencils::Stencils;
use crate::basis::along::{WIDEST, whole};
use crate::grid::Grid;
use crate::points::BLOCK;
use crate::tensor::Vector;
use pulp::NullaryFnOnce;

/// Sum and number of the points in a cell.
pub(super) type Sum = [f64; 2];

/// Means over the points of each cell, under the number of its lowest node.
#[derive(Debug)]
pub(super) struct Cells {
    pub sums: Vec<Sum>,
    pub means: Vec<f64>,
}

impl Cells {
    /// For the cells of a grid.
    pub fn new<const D: usize>(grid: &Grid<D>) -> Self {
        Cells {
            sums: vec![[0.0; 2]; grid.node_count()],
            means: vec![0.0; grid.node_count()],
        }
    }

    /// Takes the means of what has been summed, and starts anew; 0 where there is no point.
    pub fn divide(&mut self) {
        for (mean, sum) in self.means.iter_mut().zip(&mut self.sums) {
            let [total, number] = std::mem::replace(sum, [0.0; 2]);
            *mean = total / number.max(1.0);
        }
    }
}

/// The cells of a block of points within the grid; a point on a face is in either.
pub(super) struct Find<'a, const D: usize> {
    pub grid: &'a Grid<D>,
    pub places: &'a [Vector<D>],
    pub cells: &'a mut [u32; BLOCK],
}

impl<const D: usize> NullaryFnOnce for Find<'_, D> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        let grid = self.grid;
        let (mut stride, n) = (1, self.places.len().min(BLOCK));
        *self.cells = [0; BLOCK];
        for a in 0..D {
            let (per_h, last) = (1.0 / grid.h[a], grid.cells[a] as i32 - 1);
            for (cell, x) in self.cells.iter_mut().zip(&self.places[..n]) {
                let index = whole((x[a] - grid.origin[a]) * per_h - 0.5);
                *cell += (index.clamp(0, last) * stride) as u32;
            }
            stride *= last + 2;
        }
    }
}

/// Adds the `traces` of points in `cells` to the sums of those, which start with number `first`.
pub(super) fn add_traces(cells: &[u32], traces: &[f64], first: usize, sums: &mut [Sum]) {
    for (&cell, trace) in cells.iter().zip(traces) {
        let [total, number] = &mut sums[cell as usize - first];
        *total += trace;
        *number += 1.0;
    }
}

/// Gives points in `cells` the traces of those times `scale`, in place of those of the matrix in lane `LANE`
/// of `packed`.
pub(super) fn give_traces<const LANE: usize, const D: usize>(
    cells: &[u32],
    packed: &mut [Packed<D>],
    scale: f64,
    means: &[f64],
) {
    for (&cell, packed) in cells.iter().zip(packed) {
        let trace: f64 = (0..D).map(|d| packed.columns[d][LANE][d]).sum();
        let more = (scale * means[cell as usize] - trace) / D as f64;
        for d in 0..D {
            packed.columns[d][LANE][d] += more;
        }
    }
}

/// Divergences (1/s) of a field of the nodes at a block of points that see `W` nodes along an axis. By rows
/// of nodes along the first axis, with `r` and `r_d` as in [`super::scatter`]:
///
/// ```text
/// tr l = sum r (sum n_x' v_x) + sum_d r_d (sum n_x v_d)
/// ```
pub(super) struct Diverge<'a, const D: usize, const W: usize> {
    /// Number of points.
    pub n: usize,
    pub stencils: &'a Stencils<D>,
    /// From a node to the next along each axis.
    pub stride: [usize; D],
    /// Velocities of all nodes (m/s).
    pub v: &'a [Vector<D>],
    pub traces: &'a mut [f64; BLOCK],
}

impl<const D: usize, const W: usize> NullaryFnOnce for Diverge<'_, D, W> {
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        let n = self.n.min(BLOCK);
        *self.traces = [0.0; BLOCK];
        let mut at = 0;
        while at < n {
            let base = self.stencils.base[at];
            let start = at;
            while at < n && self.stencils.base[at] == base {
                at += 1;
            }
            self.run(base as usize, start, at);
        }
    }
}

impl<const D: usize, const W: usize> Diverge<'_, D, W> {
    /// Points `start..end`, which all see the nodes from `base` on.
    #[inline(always)]
    fn run(&mut self, base: usize, start: usize, end: usize) {
        let s = self.stencils;
        let mut products = [[0.0; BLOCK]; D];
        for row in 0..W.pow(D as u32 - 1) {
            let (mut rest, mut node, mut index) = (row, base, [0; D]);
            for d in 1..D {
                index[d] = rest % W;
                node += index[d] * self.stride[d];
                rest /= W;
            }
            // r, then r_d
            for (d, product) in products.iter_mut().enumerate() {
                for (p, product) in product.iter_mut().enumerate().take(end).skip(start) {
                    let mut value = 1.0;
                    for e in 1..D {
                        let functions = if e == d { &s.slopes } else { &s.values };
                        value *= functions[e][index[e]][p];
                    }
                    *product = value;
                }
            }
            let mut nodes = [[0.0; D]; WIDEST];
            nodes[..W].copy_from_slice(&self.v[node..node + W]);
            for (i, v) in nodes.iter().enumerate().take(W) {
                for p in start..end {
                    let mut across = 0.0;
                    for d in 1..D {
                        across += v[d] * products[d][p];
                    }
                    self.traces[p] +=
                        s.slopes[0][i][p] * v[0] * products[0][p] + s.values[0][i][p] * across;
                }
            }
        }
    }
}
