//! From a block of points to the nodes.
//!
//! What a point gives to a node splits into rows of nodes along the first axis. With the products
//! `r` of the other axes' functions, `r_d` with the slope along d, and `Y_d` from the point to the row:
//!
//! ```text
//! momentum   n_x [r (m v + sum_d m L_d Y_d)] + (n_x X) [r m L_x]
//! force      n_x [- V sum_d tau_d r_d]       + n_x'    [- V r tau_x]
//! ```
//!
//! Both stand side by side in the lanes of one vector.

use super::stencils::Stencils;
use super::strips::Sums;
use crate::basis::along::WIDEST;
use crate::points::BLOCK;
use crate::tensor::{Matrix, Vector, zero};
use pulp::NullaryFnOnce;

/// A block of points of a body, and where it gives to. `W` nodes along an axis; `AFFINE`: gradients
/// are there; `FORCE`: masses and forces are asked for.
pub(super) struct Scatter<
    'a,
    'b,
    const D: usize,
    const W: usize,
    const AFFINE: bool,
    const FORCE: bool,
> {
    pub stencils: &'a Stencils<D>,
    /// Edges of a cell (m).
    pub h: &'a Vector<D>,
    /// From a node to the next along each axis.
    pub stride: [usize; D],
    /// Mass of a point (kg).
    pub mass: f64,
    /// Volume of a point at the start (m3).
    pub volume: f64,
    pub velocity: &'a [Vector<D>],
    pub gradient: &'a [Matrix<D>],
    /// Kirchhoff stress (Pa).
    pub stress: &'a [Matrix<D>; BLOCK],
    pub out: &'a mut Sums<'b, D>,
}

/// Momentum and force side by side.
type Lanes<const D: usize> = [[f64; D]; 2];

/// Most rows of nodes that a point sees.
const ROWS: usize = WIDEST * WIDEST;

/// What a run of points with the same nodes gives to them.
struct Run<const D: usize> {
    lanes: [[Lanes<D>; WIDEST]; ROWS],
    /// Sums of `N`; the fourth is there to fill a vector.
    count: [[f64; WIDEST + 1]; ROWS],
}

impl<const D: usize, const W: usize, const AFFINE: bool, const FORCE: bool> NullaryFnOnce
    for Scatter<'_, '_, D, W, AFFINE, FORCE>
{
    type Output = ();

    #[inline(always)]
    fn call(mut self) {
        let n = self.velocity.len().min(BLOCK);
        let mut at = 0;
        while at < n {
            let base = self.stencils.base[at];
            let mut run = Run {
                lanes: [[[[0.0; D]; 2]; WIDEST]; ROWS],
                count: [[0.0; WIDEST + 1]; ROWS],
            };
            while at < n && self.stencils.base[at] == base {
                self.add(at, &mut run);
                at += 1;
            }
            self.flush(base as usize, &run);
        }
    }
}

impl<const D: usize, const W: usize, const AFFINE: bool, const FORCE: bool>
    Scatter<'_, '_, D, W, AFFINE, FORCE>
{
    /// Rows of nodes that a point sees.
    const ROWS: usize = W.pow(D as u32 - 1);

    /// Adds what point `p` gives.
    #[inline(always)]
    fn add(&self, p: usize, run: &mut Run<D>) {
        let s = self.stencils;
        let (m, v) = (self.mass, &self.velocity[p]);
        let l = if AFFINE { self.gradient[p] } else { zero() };
        let tau = if FORCE { self.stress[p] } else { zero() };
        let along = |i: usize| s.values[0][i][p];
        // columns of L and tau
        let column = |d: usize| -> Lanes<D> {
            [
                std::array::from_fn(|i| m * l[i][d]),
                std::array::from_fn(|i| -self.volume * tau[i][d]),
            ]
        };
        let first = column(0);
        for row in 0..Self::ROWS {
            let mut index = [0; D];
            let mut rest = row;
            let mut r = 1.0;
            for d in 1..D {
                index[d] = rest % W;
                rest /= W;
                r *= s.values[d][index[d]][p];
            }
            let mut even: Lanes<D> = [v.map(|v| r * m * v), [0.0; D]];
            for d in 1..D {
                let mut slope = s.slopes[d][index[d]][p];
                for e in 1..D {
                    if e != d {
                        slope *= s.values[e][index[e]][p];
                    }
                }
                let away = r * (s.away[d][p] + self.h[d] * index[d] as f64);
                add(&mut even, [away, slope], &column(d));
            }
            let odd = first.map(|c| c.map(|c| r * c));
            for i in 0..W {
                let n = along(i);
                let away = n * (s.away[0][p] + self.h[0] * i as f64);
                let lanes = &mut run.lanes[row][i];
                add(lanes, [n, n], &even);
                add(lanes, [away, s.slopes[0][i][p]], &odd);
            }
            if FORCE {
                for i in 0..W {
                    run.count[row][i] += r * along(i);
                }
            }
        }
    }

    /// Gives to the nodes from `base` on.
    #[inline(always)]
    fn flush(&mut self, base: usize, run: &Run<D>) {
        for row in 0..Self::ROWS {
            let mut rest = row;
            let mut node = base - self.out.first;
            for d in 1..D {
                node += rest % W * self.stride[d];
                rest /= W;
            }
            for (x, lanes) in self.out.momentum[node..node + W]
                .iter_mut()
                .zip(&run.lanes[row])
            {
                for i in 0..D {
                    x[i] += lanes[0][i];
                }
            }
            if !FORCE {
                continue;
            }
            let Some((mass, force)) = &mut self.out.others else {
                continue;
            };
            for (x, count) in mass[node..node + W].iter_mut().zip(&run.count[row]) {
                *x += self.mass * count;
            }
            for (x, lanes) in force[node..node + W].iter_mut().zip(&run.lanes[row]) {
                for i in 0..D {
                    x[i] += lanes[1][i];
                }
            }
        }
    }
}

/// `sum += s x`, with a factor for momenta and one for forces.
#[inline(always)]
fn add<const D: usize>(sum: &mut Lanes<D>, s: [f64; 2], x: &Lanes<D>) {
    for c in 0..2 {
        for i in 0..D {
            sum[c][i] += s[c] * x[c][i];
        }
    }
}
