//! From the nodes to a block of points.
//!
//! Velocity and acceleration of a node stand side by side in the lanes of one vector `f`. By rows of
//! nodes along the first axis, with `r` and `r_d` as in [`super::scatter`]:
//!
//! ```text
//! sum N f = sum r (sum n_x f),   d/dx = sum r (sum n_x' f),   d/dx_d = sum r_d (sum n_x f)
//! ```

use super::stencils::Stencils;
use crate::basis::along::WIDEST;
use crate::points::BLOCK;
use crate::tensor::{Matrix, Vector};
use pulp::NullaryFnOnce;

/// A block of points and the motion of the nodes. `W` nodes along an axis; `AFFINE`: gradients are
/// there; `KICK`: the motion of the points changes; `MOVE`: their places do.
pub(super) struct Gather<
    'a,
    const D: usize,
    const W: usize,
    const AFFINE: bool,
    const KICK: bool,
    const MOVE: bool,
> {
    pub stencils: &'a Stencils<D>,
    /// From a node to the next along each axis.
    pub stride: [usize; D],
    /// Velocities of all nodes (m/s).
    pub v: &'a [Vector<D>],
    /// Accelerations of all nodes (m/s2).
    pub a: &'a [Vector<D>],
    /// The step (s).
    pub dt: f64,
    /// Share of the nodes' velocity.
    pub pic: f64,
    pub place: &'a mut [Vector<D>],
    pub velocity: &'a mut [Vector<D>],
    pub gradient: &'a mut [Matrix<D>],
    /// Gradient of the nodes' velocity (1/s), for the law.
    pub l: &'a mut [Matrix<D>; BLOCK],
}

/// Velocity and acceleration side by side.
type Lanes<const D: usize> = [[f64; D]; 2];

/// Most rows of nodes that a point sees.
const ROWS: usize = WIDEST * WIDEST;

impl<const D: usize, const W: usize, const AFFINE: bool, const KICK: bool, const MOVE: bool>
    NullaryFnOnce for Gather<'_, D, W, AFFINE, KICK, MOVE>
{
    /// Are all new velocities finite?
    type Output = bool;

    #[inline(always)]
    fn call(mut self) -> bool {
        let n = self.place.len().min(BLOCK);
        let mut nodes = [[[[0.0; D]; 2]; WIDEST]; ROWS];
        let mut last = u32::MAX;
        let mut zero = 0.0;
        for p in 0..n {
            let base = self.stencils.base[p];
            if base != last {
                self.load(base as usize, &mut nodes);
                last = base;
            }
            zero += self.point(p, &nodes);
        }
        zero == 0.0
    }
}

impl<const D: usize, const W: usize, const AFFINE: bool, const KICK: bool, const MOVE: bool>
    Gather<'_, D, W, AFFINE, KICK, MOVE>
{
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

    /// Moves point `p`; returns zero when its new velocity is finite, NaN otherwise.
    #[inline(always)]
    fn point(&mut self, p: usize, nodes: &[[Lanes<D>; WIDEST]; ROWS]) -> f64 {
        let s = self.stencils;
        let mut value: Lanes<D> = [[0.0; D]; 2];
        let mut slopes: [Lanes<D>; D] = [[[0.0; D]; 2]; D];
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
                add(&mut line, s.values[0][i][p], &nodes[row][i]);
                add(&mut line_slope, s.slopes[0][i][p], &nodes[row][i]);
            }
            add(&mut value, r, &line);
            add(&mut slopes[0], r, &line_slope);
            for d in 1..D {
                let mut slope = s.slopes[d][index[d]][p];
                for e in 1..D {
                    if e != d {
                        slope *= s.values[e][index[e]][p];
                    }
                }
                add(&mut slopes[d], slope, &line);
            }
        }
        if MOVE {
            for i in 0..D {
                self.place[p][i] += self.dt * value[0][i];
            }
            for i in 0..D {
                for d in 0..D {
                    self.l[p][i][d] = slopes[d][0][i];
                }
            }
        }
        let mut zero = 0.0;
        if KICK {
            for i in 0..D {
                let v = &mut self.velocity[p][i];
                *v = (1.0 - self.pic) * (*v + self.dt * value[1][i]) + self.pic * value[0][i];
                zero += 0.0 * *v;
            }
            if AFFINE {
                for i in 0..D {
                    for d in 0..D {
                        self.gradient[p][i][d] += self.dt * slopes[d][1][i];
                    }
                }
            }
        }
        zero
    }
}

/// `sum += s x`.
#[inline(always)]
fn add<const D: usize>(sum: &mut Lanes<D>, s: f64, x: &Lanes<D>) {
    for c in 0..2 {
        for i in 0..D {
            sum[c][i] += s * x[c][i];
        }
    }
}
