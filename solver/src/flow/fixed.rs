//! What a region's passes do to a block of points.

use super::columns::{Columns, Part};
use super::fbar::{Diverge, Find, give_traces};
use super::gather::Gather;
use super::lanes::{PackMotion, Packed, Unpack};
use super::law_blocks::{Advance, PackStress, StressTraces};
use super::scatter::{Run, Scatter};
use super::stencils::Stencils;
use super::strips::Sums;
use super::{Carry, Fault};
use crate::basis::along::Basis;
use crate::grid::Grid;
use crate::material::law::Law;
use crate::points::BLOCK;
use crate::tensor::{Vector, add_scaled, identity, inverse};
use pulp::Arch;
use std::ops::Range;

/// What does not change during a run.
#[derive(Clone, Debug)]
pub(super) struct Fixed<B, L, const D: usize> {
    pub arch: Arch,
    pub grid: Grid<D>,
    pub basis: B,
    pub law: L,
    pub carry: Carry,
    /// Share the work with the threads of the pool?
    pub shared: bool,
    /// Mass of a point (kg).
    pub mass: f64,
    /// Volume of a point at the start (m3).
    pub volume: f64,
    /// From a node to the next along each axis.
    pub stride: [usize; D],
}

/// The motion of the nodes and the step.
#[derive(Clone, Copy)]
pub(super) struct Nodes<'a, const D: usize> {
    /// Velocities (m/s).
    pub v: &'a [Vector<D>],
    /// Accelerations (m/s2).
    pub a: &'a [Vector<D>],
    /// Divergences of the cells (1/s), where they replace the points'.
    pub cells: Option<&'a [f64]>,
    /// The step (s).
    pub dt: f64,
}

impl<B: Basis, L, const D: usize> Fixed<B, L, D> {
    /// What a block of points sees.
    pub fn fill(&self, stencils: &mut Stencils<D>, places: &[Vector<D>]) -> Result<(), Fault<D>> {
        stencils
            .fill(self.arch, &self.basis, &self.grid, places)
            .map_err(|p| Fault::Left { place: places[p] })
    }
}

impl<B, L, const D: usize> Fixed<B, L, D> {
    /// The cells of a block of points.
    pub fn cells(&self, places: &[Vector<D>]) -> [u32; BLOCK] {
        let mut cells = [0; BLOCK];
        self.arch.dispatch(Find {
            grid: &self.grid,
            places,
            cells: &mut cells,
        });
        cells
    }
}

impl<B: Basis, L: Law<D>, const D: usize> Fixed<B, L, D> {
    /// Packs what a block of points gives to the nodes; with the traces of their stresses from `cells` where
    /// there are any.
    pub fn pack(
        &self,
        columns: &Columns<L::State, D>,
        block: Range<usize>,
        out: &Sums<'_, D>,
        cells: Option<&[f64]>,
        packed: &mut [Packed<D>; BLOCK],
    ) {
        self.arch.dispatch(PackMotion {
            mass: self.mass,
            velocity: &columns.velocity[block.clone()],
            gradient: match self.carry {
                Carry::Affine { .. } => &columns.gradient[block.clone()],
                Carry::Flip { .. } => &[],
            },
            packed,
        });
        if out.others.is_none() {
            return;
        }
        self.arch.dispatch(PackStress {
            law: &self.law,
            volume: self.volume,
            state: &columns.state[block.clone()],
            packed,
        });
        if let Some(cells) = cells {
            let own = self.cells(&columns.place[block.clone()]);
            give_traces::<1, D>(&own[..block.len()], packed, -self.volume, cells);
        }
    }

    /// Traces (Pa) of the stresses of a block.
    pub fn stress_traces(&self, state: &[L::State], traces: &mut [f64; BLOCK]) {
        self.arch.dispatch(StressTraces {
            law: &self.law,
            state,
            traces,
        });
    }

    /// Divergences (1/s) of the nodes' velocities `v` (m/s) at `n` points.
    pub fn diverge(
        &self,
        n: usize,
        stencils: &Stencils<D>,
        v: &[Vector<D>],
        traces: &mut [f64; BLOCK],
    ) {
        macro_rules! pass {
            ($width:literal) => {
                self.arch.dispatch(Diverge::<D, $width> {
                    n,
                    stencils,
                    stride: self.stride,
                    v,
                    traces,
                })
            };
        }
        match B::WIDTH {
            2 => pass!(2),
            _ => pass!(3),
        }
    }

    /// Gives to the nodes what `n` points have packed.
    pub fn scatter(
        &self,
        n: usize,
        stencils: &Stencils<D>,
        packed: &[Packed<D>; BLOCK],
        run: &mut Run<D>,
        out: &mut Sums<'_, D>,
    ) {
        macro_rules! pass {
            ($width:literal) => {
                self.arch.dispatch(Scatter::<D, $width> {
                    n,
                    stencils,
                    h: &self.grid.h,
                    stride: self.stride,
                    mass: self.mass,
                    packed,
                    run,
                    out,
                })
            };
        }
        match B::WIDTH {
            2 => pass!(2),
            _ => pass!(3),
        }
    }

    /// Moves a block of points.
    pub fn gather<const KICK: bool, const MOVE: bool>(
        &self,
        stencils: &Stencils<D>,
        nodes: Nodes<'_, D>,
        block: &mut Part<'_, L::State, D>,
    ) -> Result<(), Fault<D>> {
        let n = block.place.len();
        let mut packed = [Packed::ZERO; BLOCK];
        macro_rules! gather {
            ($width:literal) => {
                self.arch.dispatch(Gather::<D, $width> {
                    n,
                    stencils,
                    stride: self.stride,
                    v: nodes.v,
                    a: nodes.a,
                    packed: &mut packed,
                })
            };
        }
        match B::WIDTH {
            2 => gather!(2),
            _ => gather!(3),
        }
        if let Some(cells) = nodes.cells {
            let own = self.cells(block.place);
            give_traces::<0, D>(&own[..n], &mut packed, 1.0, cells);
        }
        macro_rules! unpack {
            ($affine:literal, $pic:expr) => {
                self.arch.dispatch(Unpack::<D, $affine, KICK, MOVE> {
                    packed: &packed,
                    dt: nodes.dt,
                    pic: $pic,
                    place: block.place,
                    velocity: block.velocity,
                    gradient: block.gradient,
                })
            };
        }
        let finite = match self.carry {
            Carry::Affine { pic } => unpack!(true, pic),
            Carry::Flip { pic } => unpack!(false, pic),
        };
        if !finite {
            return Err(unsound("velocity", block.place, |p| {
                block.velocity[p].iter().all(|v| v.is_finite())
            }));
        }
        if !MOVE {
            return Ok(());
        }
        self.advance(&packed[..n], nodes.dt, block)
    }

    /// Moves the states of a block of points.
    fn advance(
        &self,
        packed: &[Packed<D>],
        dt: f64,
        block: &mut Part<'_, L::State, D>,
    ) -> Result<(), Fault<D>> {
        let sound = self.arch.dispatch(Advance {
            law: &self.law,
            packed,
            dt,
            state: block.state,
        });
        if sound {
            return Ok(());
        }
        for (packed, &place) in packed.iter().zip(block.place.iter()) {
            let increment = add_scaled(&identity(), dt, &packed.gradient());
            let (determinant, _) = inverse(&increment);
            if determinant <= 0.0 {
                return Err(Fault::Inverted { place, determinant });
            }
        }
        Err(unsound("stress", block.place, |p| {
            block.state[p].as_ref().iter().all(|x| x.is_finite())
        }))
    }
}

/// The failure of the first point of a block whose field is not `sound`.
fn unsound<const D: usize>(
    field: &'static str,
    places: &[Vector<D>],
    sound: impl Fn(usize) -> bool,
) -> Fault<D> {
    let first = (0..places.len()).find(|&p| !sound(p));
    Fault::NonFinite {
        field,
        place: places[first.unwrap_or(0)],
    }
}
