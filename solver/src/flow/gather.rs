//! From the nodes to a block of points.
//!
//! Velocity and acceleration of a node stand side by side in `f`. By rows of nodes along the first
//! axis, with `r` and `r_d` as in [`super::scatter`]:
//!
//! ```text
//! sum N f = sum r (sum n_x f),   d/dx = sum r (sum n_x' f),   d/dx_d = sum r_d (sum n_x f)
//! ```

use super::lanes::{Lanes, Packed, add};
use super::stencils::Stencils;
use crate::basis::along::WIDEST;
use crate::points::BLOCK;
use crate::tensor::Vector;
use pulp::{Simd, WithSimd};

/// A block of points that see `W` nodes along an axis, and the motion of the nodes.
pub(super) struct Gather<'a, const D: usize, const W: usize> {
    /// Number of points.
    pub n: usize,
    pub stencils: &'a Stencils<D>,
    /// From a node to the next along each axis.
    pub stride: [usize; D],
    /// Velocities of all nodes (m/s).
    pub v: &'a [Vector<D>],
    /// Accelerations of all nodes (m/s2).
    pub a: &'a [Vector<D>],
    /// `[v, a]` and its derivatives at each point.
    pub packed: &'a mut [Packed<D>; BLOCK],
}

/// Most rows of nodes that a point sees.
const ROWS: usize = WIDEST * WIDEST;

impl<const D: usize, const W: usize> WithSimd for Gather<'_, D, W> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, _: S) {
        let n = self.n.min(BLOCK);
        let mut nodes = [[[[0.0; D]; 2]; WIDEST]; ROWS];
        let mut last = u32::MAX;
        for p in 0..n {
            let base = self.stencils.base[p];
            if base != last {
                self.load(base as usize, &mut nodes);
                last = base;
            }
            self.point::<S>(p, &nodes);
        }
    }
}

impl<const D: usize, const W: usize> Gather<'_, D, W> {
    /// Rows of nodes that a point sees.
    const ROWS: usize = W.pow(D as u32 - 1);

    /// Takes the motion of the nodes from `base` on.
    #[inline(always)]
    fn load(&self, base: usize, nodes: &mut [[Lanes<D>; WIDEST]; ROWS]) {
        for row in 0..Self::ROWS {
            let mut rest = row;
            let mut node = base;
            for d in 1..D {
                node += rest % W * self.stride[d];
                rest /= W;
            }
            let (v, a) = (&self.v[node..node + W], &self.a[node..node + W]);
            for i in 0..W {
                nodes[row][i] = [v[i], a[i]];
            }
        }
    }

    /// What point `p` gets.
    #[inline(always)]
    fn point<S: Simd>(&mut self, p: usize, nodes: &[[Lanes<D>; WIDEST]; ROWS]) {
        let s = self.stencils;
        let mut packed = Packed::ZERO;
        for row in 0..Self::ROWS {
            let mut index = [0; D];
            let mut rest = row;
            let mut r = 1.0;
            for d in 1..D {
                index[d] = rest % W;
                rest /= W;
                r *= s.values[d][index[d]][p];
            }
            let (mut line, mut line_slope): (Lanes<D>, Lanes<D>) = ([[0.0; D]; 2], [[0.0; D]; 2]);
            for i in 0..W {
                let (n, slope) = (s.values[0][i][p], s.slopes[0][i][p]);
                add::<S, D>(&mut line, [n, n], &nodes[row][i]);
                add::<S, D>(&mut line_slope, [slope, slope], &nodes[row][i]);
            }
            add::<S, D>(&mut packed.value, [r, r], &line);
            add::<S, D>(&mut packed.columns[0], [r, r], &line_slope);
            for d in 1..D {
                let mut slope = s.slopes[d][index[d]][p];
                for e in 1..D {
                    if e != d {
                        slope *= s.values[e][index[e]][p];
                    }
                }
                add::<S, D>(&mut packed.columns[d], [slope, slope], &line);
            }
        }
        self.packed[p] = packed;
    }
}
