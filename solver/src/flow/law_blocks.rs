//! The law over blocks of points.

use super::lanes::Packed;
use crate::material::law::Law;
use crate::points::BLOCK;
use crate::tensor::{add_scaled, identity, inverse, trace};
use pulp::NullaryFnOnce;

/// Packs the stresses of a block.
pub(super) struct PackStress<'a, L: Law<D>, const D: usize> {
    pub law: &'a L,
    /// Volume of a point at the start (m3).
    pub volume: f64,
    pub state: &'a [L::State],
    pub packed: &'a mut [Packed<D>; BLOCK],
}

impl<L: Law<D>, const D: usize> NullaryFnOnce for PackStress<'_, L, D> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (packed, state) in self.packed.iter_mut().zip(self.state) {
            let stress = self.law.stress(state);
            for d in 0..D {
                for i in 0..D {
                    packed.columns[d][1][i] = -self.volume * stress[i][d];
                }
            }
        }
    }
}

/// Traces (Pa) of the stresses of a block, in plane strain those in the plane.
pub(super) struct StressTraces<'a, L: Law<D>, const D: usize> {
    pub law: &'a L,
    pub state: &'a [L::State],
    pub traces: &'a mut [f64; BLOCK],
}

impl<L: Law<D>, const D: usize> NullaryFnOnce for StressTraces<'_, L, D> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        for (sum, state) in self.traces.iter_mut().zip(self.state) {
            *sum = trace(&self.law.stress(state));
        }
    }
}

/// A step of the law for a block; false when an increment has no positive determinant or a state is
/// not finite.
pub(super) struct Advance<'a, L: Law<D>, const D: usize> {
    pub law: &'a L,
    pub packed: &'a [Packed<D>],
    pub dt: f64,
    pub state: &'a mut [L::State],
}

impl<L: Law<D>, const D: usize> NullaryFnOnce for Advance<'_, L, D> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let mut sound = true;
        for (packed, state) in self.packed.iter().zip(self.state) {
            let l = packed.gradient();
            let (determinant, _) = inverse(&add_scaled(&identity(), self.dt, &l));
            sound &= determinant > 0.0;
            self.law.advance(&l, self.dt, state);
            for x in state.as_ref() {
                sound &= x.is_finite();
            }
        }
        sound
    }
}
