//! Two vectors side by side, so that a machine's vector is full in 2D as well; and what points hand to
//! the kernels in that form.
//!
//! Blocks are packed and unpacked by loops of their own: a kernel that reads and writes full lanes is
//! compiled to full vectors, one that takes its operands apart is not.

use crate::points::BLOCK;
use crate::tensor::{Matrix, Vector};
use pulp::{NullaryFnOnce, Simd};

/// Momentum and force, or velocity and acceleration.
pub(super) type Lanes<const D: usize> = [[f64; D]; 2];

/// A value and its columns: to the nodes `[m v, 0]` and `[m L_d, - V tau_d]`, to the points `[v, a]` and
/// the derivatives along each axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packed<const D: usize> {
    pub value: Lanes<D>,
    pub columns: [Lanes<D>; D],
}

impl<const D: usize> Packed<D> {
    pub const ZERO: Self = Packed {
        value: [[0.0; D]; 2],
        columns: [[[0.0; D]; 2]; D],
    };

    /// The first vectors' gradient.
    #[inline(always)]
    pub fn gradient(&self) -> Matrix<D> {
        let mut out = [[0.0; D]; D];
        for i in 0..D {
            for d in 0..D {
                out[i][d] = self.columns[d][0][i];
            }
        }
        out
    }
}

/// `a b + c`, rounded once where the machine's vectors do so.
#[inline(always)]
fn fused<S: Simd>(a: f64, b: f64, c: f64) -> f64 {
    if S::IS_SCALAR {
        a * b + c
    } else {
        a.mul_add(b, c)
    }
}

/// `sum += s x`, with a factor for each vector.
#[inline(always)]
pub(super) fn add<S: Simd, const D: usize>(sum: &mut Lanes<D>, s: [f64; 2], x: &Lanes<D>) {
    for c in 0..2 {
        for i in 0..D {
            sum[c][i] = fused::<S>(s[c], x[c][i], sum[c][i]);
        }
    }
}

/// Packs the motion of a block; no gradients are all zero.
pub(super) struct PackMotion<'a, const D: usize> {
    /// Mass of a point (kg).
    pub mass: f64,
    pub velocity: &'a [Vector<D>],
    pub gradient: &'a [Matrix<D>],
    pub packed: &'a mut [Packed<D>; BLOCK],
}

impl<const D: usize> NullaryFnOnce for PackMotion<'_, D> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (packed, v) in self.packed.iter_mut().zip(self.velocity) {
            for i in 0..D {
                packed.value[0][i] = self.mass * v[i];
            }
        }
        for (packed, l) in self.packed.iter_mut().zip(self.gradient) {
            for d in 0..D {
                for i in 0..D {
                    packed.columns[d][0][i] = self.mass * l[i][d];
                }
            }
        }
    }
}

/// Moves a block of points. `AFFINE`: gradients are there; `KICK`: the motion of the points changes;
/// `MOVE`: their places do.
pub(super) struct Unpack<'a, const D: usize, const AFFINE: bool, const KICK: bool, const MOVE: bool>
{
    pub packed: &'a [Packed<D>; BLOCK],
    /// The step (s).
    pub dt: f64,
    /// Share of the nodes' velocity and its gradient.
    pub pic: f64,
    pub place: &'a mut [Vector<D>],
    pub velocity: &'a mut [Vector<D>],
    pub gradient: &'a mut [Matrix<D>],
}

impl<const D: usize, const AFFINE: bool, const KICK: bool, const MOVE: bool> NullaryFnOnce
    for Unpack<'_, D, AFFINE, KICK, MOVE>
{
    /// Are all new velocities finite?
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let keep = 1.0 - self.pic;
        for (p, (x, packed)) in self.place.iter_mut().zip(self.packed).enumerate() {
            let [v, a] = &packed.value;
            if MOVE {
                *x = std::array::from_fn(|i| x[i] + self.dt * v[i]);
            }
            if KICK {
                let own = &mut self.velocity[p];
                *own = std::array::from_fn(|i| keep * (own[i] + self.dt * a[i]) + self.pic * v[i]);
                if !own.iter().all(|v| v.is_finite()) {
                    return false;
                }
            }
            if KICK && AFFINE {
                let own = &mut self.gradient[p];
                *own = std::array::from_fn(|i| {
                    std::array::from_fn(|d| {
                        let [v, a] = &packed.columns[d];
                        keep * (own[i][d] + self.dt * a[i]) + self.pic * v[i]
                    })
                });
            }
        }
        true
    }
}
