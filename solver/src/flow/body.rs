//! The points of one region: a basis, a law, columns, and the passes over strips and blocks.

use super::columns::{Columns, Part, Sorting};
use super::fbar::{Cells, give_divergences, take_means};
use super::gather::Gather;
use super::lanes::{PackMotion, Packed, Unpack};
use super::law_blocks::{Advance, PackStress};
use super::scatter::{Run, Scatter};
use super::stencils::Stencils;
use super::strips::{Strips, Sums, each};
use super::{Carry, Fault, Flow, NodeSums, Start};
use crate::basis::along::Basis;
use crate::grid::Grid;
use crate::material::law::Law;
use crate::points::{BLOCK, blocks};
use crate::tensor::{Matrix, Vector, add_scaled, identity, inverse, zero};
use pulp::Arch;
use std::sync::atomic::{AtomicBool, Ordering};

/// Steps after which points are sorted again at the latest: sorting costs about as much as a step.
const SORT_EVERY: usize = 32;

/// Points of a region.
#[derive(Debug)]
pub(super) struct Body<B, L: Law<D>, const D: usize> {
    fixed: Fixed<B, L, D>,
    columns: Columns<L::State, D>,
    sorting: Sorting<L::State, D>,
    strips: Strips,
    /// Where cells' divergences replace the points'.
    cells: Option<Cells>,
    /// Steps since the points were sorted.
    age: usize,
    /// Has a point left its strip?
    strayed: AtomicBool,
}

/// What does not change during a run.
#[derive(Clone, Debug)]
struct Fixed<B, L, const D: usize> {
    arch: Arch,
    grid: Grid<D>,
    basis: B,
    law: L,
    carry: Carry,
    shared: bool,
    mass: f64,
    volume: f64,
    /// From a node to the next along each axis.
    stride: [usize; D],
}

/// The motion of the nodes and the step.
#[derive(Clone, Copy)]
struct Nodes<'a, const D: usize> {
    v: &'a [Vector<D>],
    a: &'a [Vector<D>],
    dt: f64,
}

impl<B: Basis + Sync, L: Law<D>, const D: usize> Body<B, L, D> {
    /// The points of `start`.
    pub fn new(basis: B, law: L, start: Start<D>) -> Result<Self, Fault<D>> {
        let n = start.places.len();
        let grid = start.grid;
        let mut stride = [1; D];
        for a in 1..D {
            stride[a] = stride[a - 1] * grid.nodes_along(a - 1);
        }
        let state = match &start.stress {
            Some(stress) => stress.iter().map(|s| law.prestressed(s)).collect(),
            None => vec![L::State::default(); n],
        };
        let affine = start.carry == Carry::Affine;
        let cells = start.mean_volumes.then(|| Cells::new(&grid));
        let mut body = Body {
            strips: Strips::new(&grid, B::WIDTH),
            fixed: Fixed {
                arch: Arch::new(),
                grid,
                basis,
                law,
                carry: start.carry,
                shared: start.shared,
                mass: start.density * start.volume,
                volume: start.volume,
                stride,
            },
            columns: Columns {
                place: start.places,
                velocity: start.velocities,
                gradient: vec![zero(); if affine { n } else { 0 }],
                state,
            },
            sorting: Sorting::default(),
            cells,
            age: 0,
            strayed: AtomicBool::new(false),
        };
        body.sort()?;
        Ok(body)
    }

    /// Orders the points by the first node that they see.
    fn sort(&mut self) -> Result<(), Fault<D>> {
        let n = self.columns.place.len();
        self.sorting.key.resize(n, 0);
        let mut stencils = Stencils::new();
        for block in blocks(0..n) {
            let places = &self.columns.place[block.clone()];
            self.fixed.fill(&mut stencils, places)?;
            let keys = &mut self.sorting.key[block];
            keys.copy_from_slice(&stencils.base[..keys.len()]);
        }
        let nodes = self.fixed.grid.node_count();
        self.columns.sort(nodes, &mut self.sorting);
        self.strips.find(&self.sorting.start);
        self.age = 0;
        *self.strayed.get_mut() = false;
        Ok(())
    }

    /// A pass to the nodes: the strips of one colour, then those of the other.
    fn scatter(&self, mut out: Sums<'_, D>) -> Result<(), Fault<D>> {
        let strips = &self.strips;
        for colour in 0..2 {
            each(
                0..strips.of_colour(colour),
                out.again(),
                self.fixed.shared,
                &|out, k| out.split_at(strips.first_node(colour, k)),
                &|k, mut out| self.scatter_strip(2 * k + colour, &mut out),
            )?;
        }
        Ok(())
    }

    fn scatter_strip(&self, strip: usize, out: &mut Sums<'_, D>) -> Result<(), Fault<D>> {
        let (fixed, columns) = (&self.fixed, &self.columns);
        let (mut stencils, mut run) = (Stencils::new(), Run::new());
        let mut packed = [Packed::ZERO; BLOCK];
        for block in blocks(self.strips.points[strip]..self.strips.points[strip + 1]) {
            fixed.fill(&mut stencils, &columns.place[block.clone()])?;
            let gradient: &[Matrix<D>] = match fixed.carry {
                Carry::Affine => &columns.gradient[block.clone()],
                Carry::Flip { .. } => &[],
            };
            fixed.arch.dispatch(PackMotion {
                mass: fixed.mass,
                velocity: &columns.velocity[block.clone()],
                gradient,
                packed: &mut packed,
            });
            let places = &columns.place[block.clone()];
            if out.others.is_some() {
                fixed.arch.dispatch(PackStress {
                    law: &fixed.law,
                    volume: fixed.volume,
                    state: &columns.state[block.clone()],
                    packed: &mut packed,
                });
            }
            if let Some(cells) = &mut out.cells {
                take_means(&fixed.grid, places, &mut packed, out.first, cells);
            }
            macro_rules! pass {
                ($width:literal) => {
                    fixed.arch.dispatch(Scatter::<D, $width> {
                        n: block.len(),
                        stencils: &stencils,
                        h: &fixed.grid.h,
                        stride: fixed.stride,
                        mass: fixed.mass,
                        packed: &packed,
                        run: &mut run,
                        out,
                    })
                };
            }
            match B::WIDTH {
                2 => pass!(2),
                _ => pass!(3),
            }
        }
        Ok(())
    }

    /// A pass to the points.
    fn gather<const KICK: bool, const MOVE: bool>(
        &mut self,
        nodes: Nodes<'_, D>,
    ) -> Result<(), Fault<D>> {
        let (fixed, strips, strayed) = (&self.fixed, &self.strips, &self.strayed);
        let cells = match &mut self.cells {
            Some(cells) if MOVE => {
                cells.diverge(&fixed.grid, nodes.v);
                Some(&cells.values[..])
            }
            _ => None,
        };
        let work = |strip: usize, mut part: Part<'_, L::State, D>| {
            let leash = strips.leash(strip, B::WIDTH);
            let mut stencils = Stencils::new();
            let mut inside = true;
            while !part.place.is_empty() {
                let n = part.place.len().min(BLOCK);
                let (mut block, rest) = part.split_at(n);
                fixed.fill(&mut stencils, block.place)?;
                fixed.gather_block::<KICK, MOVE>(&stencils, nodes, cells, &mut block)?;
                if MOVE {
                    let (axis, grid) = (D - 1, &fixed.grid);
                    for x in block.place.iter() {
                        inside &= leash.contains(&((x[axis] - grid.origin[axis]) / grid.h[axis]));
                    }
                }
                part = rest;
            }
            if !inside {
                strayed.store(true, Ordering::Relaxed);
            }
            Ok(())
        };
        each(
            0..strips.len(),
            (0, self.columns.all()),
            fixed.shared,
            // a part starts where its first strip does
            &|(first, part), strip| {
                let start = strips.points[strip];
                let (lower, upper) = part.split_at(start - first);
                ((first, lower), (start, upper))
            },
            &|strip, (_, part)| work(strip, part),
        )?;
        if MOVE {
            self.age += 1;
        }
        Ok(())
    }
}

impl<B: Basis, L, const D: usize> Fixed<B, L, D> {
    fn fill(&self, stencils: &mut Stencils<D>, places: &[Vector<D>]) -> Result<(), Fault<D>> {
        stencils
            .fill(self.arch, &self.basis, &self.grid, places)
            .map_err(|p| Fault::Left { place: places[p] })
    }
}

impl<B: Basis, L: Law<D>, const D: usize> Fixed<B, L, D> {
    fn gather_block<const KICK: bool, const MOVE: bool>(
        &self,
        stencils: &Stencils<D>,
        nodes: Nodes<'_, D>,
        cells: Option<&[f64]>,
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
        if let Some(cells) = cells {
            give_divergences(&self.grid, block.place, &mut packed, cells);
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
            Carry::Affine => unpack!(true, 0.0),
            Carry::Flip { pic } => unpack!(false, pic),
        };
        if !finite {
            return Err(unsound(block.place, |p| {
                block.velocity[p].iter().all(|v| v.is_finite())
            }));
        }
        if !MOVE {
            return Ok(());
        }
        let packed = &packed[..n];
        let sound = self.arch.dispatch(Advance {
            law: &self.law,
            packed,
            dt: nodes.dt,
            state: block.state,
        });
        if sound {
            return Ok(());
        }
        for (packed, &place) in packed.iter().zip(block.place.iter()) {
            let increment = add_scaled(&identity(), nodes.dt, &packed.gradient());
            let (determinant, _) = inverse(&increment);
            if determinant <= 0.0 {
                return Err(Fault::Inverted { place, determinant });
            }
        }
        Err(unsound(block.place, |p| {
            block.state[p].as_ref().iter().all(|x| x.is_finite())
        }))
    }
}

impl<B: Basis + Sync, L: Law<D>, const D: usize> Flow<D> for Body<B, L, D> {
    fn to_nodes(&mut self, out: &mut NodeSums<D>) -> Result<(), Fault<D>> {
        if *self.strayed.get_mut() || self.age >= SORT_EVERY {
            self.sort()?;
        }
        let mut cells = self.cells.take();
        let sums = cells.as_mut().map(|cells| {
            cells.values.fill(0.0);
            &mut cells.values[..]
        });
        let done = self.scatter(Sums::all(out, sums));
        if let Some(cells) = &cells {
            cells.force(&self.fixed.grid, &mut out.force);
        }
        self.cells = cells;
        done
    }

    fn to_points(&mut self, v: &[Vector<D>], a: &[Vector<D>], dt: f64) -> Result<(), Fault<D>> {
        self.gather::<true, true>(Nodes { v, a, dt })
    }

    fn kick(&mut self, v: &[Vector<D>], a: &[Vector<D>], dt: f64) -> Result<(), Fault<D>> {
        self.gather::<true, false>(Nodes { v, a, dt })
    }

    fn momentum(&mut self, out: &mut [Vector<D>]) -> Result<(), Fault<D>> {
        self.scatter(Sums {
            first: 0,
            momentum: out,
            others: None,
            cells: None,
        })
    }

    fn drift(&mut self, v: &[Vector<D>], dt: f64) -> Result<(), Fault<D>> {
        self.gather::<false, true>(Nodes { v, a: v, dt })
    }

    fn len(&self) -> usize {
        self.columns.place.len()
    }

    fn point_mass(&self) -> f64 {
        self.fixed.mass
    }

    fn point_volume(&self) -> f64 {
        self.fixed.volume
    }

    fn places(&self) -> &[Vector<D>] {
        &self.columns.place
    }

    fn velocities(&self) -> &[Vector<D>] {
        &self.columns.velocity
    }

    fn stress(&self, point: usize) -> Matrix<D> {
        self.fixed.law.stress(&self.columns.state[point])
    }

    fn state(&self, point: usize) -> &[f64] {
        self.columns.state[point].as_ref()
    }

    fn strain_energy(&self) -> f64 {
        let states = self.columns.state.iter();
        let densities: f64 = states.map(|s| self.fixed.law.energy_density(s)).sum();
        self.fixed.volume * densities
    }

    fn bytes_per_point(&self) -> usize {
        let (vector, state) = (size_of::<Vector<D>>(), size_of::<L::State>());
        let gradient = match self.fixed.carry {
            Carry::Affine => size_of::<Matrix<D>>(),
            Carry::Flip { .. } => 0,
        };
        // places and velocities share a second copy
        3 * vector + 2 * (gradient + state) + 2 * size_of::<u32>()
    }
}

/// The failure of the first point of a block whose field is not `sound`.
fn unsound<const D: usize>(places: &[Vector<D>], sound: impl Fn(usize) -> bool) -> Fault<D> {
    let first = (0..places.len()).find(|&p| !sound(p));
    Fault::NonFinite {
        field: "motion",
        place: places[first.unwrap_or(0)],
    }
}
