//! From a block of points to the nodes.
//!
//! What a point gives to a node splits into rows of nodes along the first axis. With the products
//! `r` of the other axes' functions, `r_d` with the slope along d, and `Y_d` from the point to the row:
//!
//! ```text
//! momentum   n_x [r (m v + sum_d m L_d Y_d)] + (n_x X) [r m L_x]
//! force      n_x [- V sum_d tau_d r_d]       + n_x'    [- V r tau_x]
//! ```

use super::lanes::{Lanes, Packed, add};
use super::stencils::Stencils;
use super::strips::Sums;
use crate::basis::along::WIDEST;
use crate::points::BLOCK;
use crate::tensor::Vector;
use pulp::{Simd, WithSimd};

/// A block of points that see `W` nodes along an axis, and where it gives to.
pub(super) struct Scatter<'a, 'b, const D: usize, const W: usize> {
    /// Number of points.
    pub n: usize,
    pub stencils: &'a Stencils<D>,
    /// Edges of a cell (m).
    pub h: &'a Vector<D>,
    /// From a node to the next along each axis.
    pub stride: [usize; D],
    /// Mass of a point (kg).
    pub mass: f64,
    /// `[m v, 0]` and columns `[m L_d, - V tau_d]` of each point.
    pub packed: &'a [Packed<D>; BLOCK],
    /// Sums of a run of points with the same nodes.
    pub run: &'a mut Run<D>,
    pub out: &'a mut Sums<'b, D>,
}

/// Most rows of nodes that a point sees.
const ROWS: usize = WIDEST * WIDEST;

/// What a run of points with the same nodes gives to them.
#[derive(Debug)]
pub(super) struct Run<const D: usize> {
    lanes: [[Lanes<D>; WIDEST]; ROWS],
    /// Sums of `N`; the fourth is there to fill a vector.
    count: [[f64; WIDEST + 1]; ROWS],
}

impl<const D: usize> Run<D> {
    /// Nothing.
    pub fn new() -> Self {
        Run {
            lanes: [[[[0.0; D]; 2]; WIDEST]; ROWS],
            count: [[0.0; WIDEST + 1]; ROWS],
        }
    }
}

impl<const D: usize, const W: usize> WithSimd for Scatter<'_, '_, D, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        let n = self.n.min(BLOCK);
        let mut at = 0;
        while at < n {
            let base = self.stencils.base[at];
            while at < n && self.stencils.base[at] == base {
                self.add::<S>(at);
                at += 1;
            }
            self.flush(base as usize);
        }
    }
}

impl<const D: usize, const W: usize> Scatter<'_, '_, D, W> {
    /// Rows of nodes that a point sees.
    const ROWS: usize = W.pow(D as u32 - 1);

    /// Adds what point `p` gives.
    #[inline(always)]
    fn add<S: Simd>(&mut self, p: usize) {
        let s = self.stencils;
        let packed = &self.packed[p];
        let (mut evens, mut odds) = ([[[0.0; D]; 2]; ROWS], [[[0.0; D]; 2]; ROWS]);
        let mut along = [0.0; WIDEST + 1];
        for i in 0..W {
            along[i] = s.values[0][i][p];
        }
        for row in 0..Self::ROWS {
            let mut index = [0; D];
            let mut rest = row;
            let mut r = 1.0;
            for d in 1..D {
                index[d] = rest % W;
                rest /= W;
                r *= s.values[d][index[d]][p];
            }
            let even = &mut evens[row];
            add::<S, D>(even, [r, r], &packed.value);
            for d in 1..D {
                let mut slope = s.slopes[d][index[d]][p];
                for e in 1..D {
                    if e != d {
                        slope *= s.values[e][index[e]][p];
                    }
                }
                let away = r * (s.away[d][p] + self.h[d] * index[d] as f64);
                add::<S, D>(even, [away, slope], &packed.columns[d]);
            }
            add::<S, D>(&mut odds[row], [r, r], &packed.columns[0]);
            for (count, n) in self.run.count[row].iter_mut().zip(&along) {
                *count += r * n;
            }
        }
        for i in 0..W {
            let n = along[i];
            let away = n * (s.away[0][p] + self.h[0] * i as f64);
            for row in 0..Self::ROWS {
                let mut lanes = self.run.lanes[row][i];
                add::<S, D>(&mut lanes, [n, n], &evens[row]);
                add::<S, D>(&mut lanes, [away, s.slopes[0][i][p]], &odds[row]);
                self.run.lanes[row][i] = lanes;
            }
        }
    }

    /// Gives to the nodes from `base` on, and starts anew.
    #[inline(always)]
    fn flush(&mut self, base: usize) {
        for row in 0..Self::ROWS {
            let mut rest = row;
            let mut node = base - self.out.first;
            for d in 1..D {
                node += rest % W * self.stride[d];
                rest /= W;
            }
            let lanes = &mut self.run.lanes[row][..W];
            let count = &mut self.run.count[row][..W];
            for (x, lanes) in self.out.momentum[node..node + W].iter_mut().zip(&*lanes) {
                *x = std::array::from_fn(|i| x[i] + lanes[0][i]);
            }
            if let Some((mass, force)) = &mut self.out.others {
                for (x, count) in mass[node..node + W].iter_mut().zip(&*count) {
                    *x += self.mass * count;
                }
                for (x, lanes) in force[node..node + W].iter_mut().zip(&*lanes) {
                    *x = std::array::from_fn(|i| x[i] + lanes[1][i]);
                }
            }
            lanes.fill([[0.0; D]; 2]);
            count.fill(0.0);
        }
    }
}
