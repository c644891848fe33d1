//! The points of one region: a basis, a law, columns, and the passes over strips and blocks.

use super::columns::{Columns, Part, Sorting};
use super::fbar::{Cells, Sum, add_traces};
use super::fixed::{Fixed, Nodes};
use super::lanes::Packed;
use super::scatter::Run;
use super::stencils::Stencils;
use super::strips::{Strips, Sums, each};
use super::{Carry, Fault, Flow, NodeSums, Start};
use crate::basis::along::Basis;
use crate::material::law::Law;
use crate::points::{BLOCK, blocks};
use crate::tensor::{Matrix, Vector, zero};
use pulp::Arch;
use std::ops::Range;
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
    /// Where means over cells replace the points' traces.
    cells: Option<Cells>,
    /// Steps since the points were sorted.
    age: usize,
    /// Has a point left its strip?
    strayed: AtomicBool,
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
        let affine = matches!(start.carry, Carry::Affine { .. });
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
            columns.fetch(block.end..block.end + BLOCK);
            fixed.fill(&mut stencils, &columns.place[block.clone()])?;
            let cells = self.cells.as_ref().map(|cells| &cells.means[..]);
            fixed.pack(columns, block.clone(), out, cells, &mut packed);
            fixed.scatter(block.len(), &stencils, &packed, &mut run, out);
        }
        Ok(())
    }

    /// Means over cells of what `trace` gives for points and a block of them.
    fn average(
        &mut self,
        trace: impl Fn(&Self, Range<usize>, &mut Stencils<D>, &mut [f64; BLOCK]) -> Result<(), Fault<D>>
        + Sync,
    ) -> Result<(), Fault<D>> {
        let Some(mut cells) = self.cells.take() else {
            return Ok(());
        };
        let body = &*self;
        let (strips, places) = (&body.strips, &body.columns.place);
        let work = |strip: usize, (first, sums): (usize, &mut [Sum])| {
            let (mut stencils, mut traces) = (Stencils::new(), [0.0; BLOCK]);
            for block in blocks(strips.points[strip]..strips.points[strip + 1]) {
                trace(body, block.clone(), &mut stencils, &mut traces)?;
                let cells = body.fixed.cells(&places[block.clone()]);
                add_traces(&cells[..block.len()], &traces, first, sums);
            }
            Ok(())
        };
        let mut done = Ok(());
        for colour in 0..2 {
            done = done.and(each(
                0..strips.of_colour(colour),
                (0, &mut cells.sums[..]),
                body.fixed.shared,
                &|(first, sums), k| {
                    let node = strips.first_node(colour, k);
                    let (lower, upper) = sums.split_at_mut(node - first);
                    ((first, lower), (node, upper))
                },
                &|k, part| work(2 * k + colour, part),
            ));
        }
        cells.divide();
        self.cells = Some(cells);
        done
    }

    /// A pass to the points.
    fn gather<const KICK: bool, const MOVE: bool>(
        &mut self,
        v: &[Vector<D>],
        a: &[Vector<D>],
        dt: f64,
    ) -> Result<(), Fault<D>> {
        if MOVE {
            self.average(|body, block, stencils, traces| {
                let fixed = &body.fixed;
                fixed.fill(stencils, &body.columns.place[block.clone()])?;
                fixed.diverge(block.len(), stencils, v, traces);
                Ok(())
            })?;
        }
        let (fixed, strips, strayed) = (&self.fixed, &self.strips, &self.strayed);
        let cells = self.cells.as_ref().filter(|_| MOVE);
        let cells = cells.map(|cells| &cells.means[..]);
        let nodes = Nodes { v, a, cells, dt };
        let work = |strip: usize, mut part: Part<'_, L::State, D>| {
            let leash = strips.leash(strip, B::WIDTH);
            let mut stencils = Stencils::new();
            let mut inside = true;
            while !part.place.is_empty() {
                let n = part.place.len().min(BLOCK);
                let (mut block, rest) = part.split_at(n);
                rest.fetch(0..BLOCK);
                fixed.fill(&mut stencils, block.place)?;
                fixed.gather::<KICK, MOVE>(&stencils, nodes, &mut block)?;
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

impl<B: Basis + Sync, L: Law<D>, const D: usize> Flow<D> for Body<B, L, D> {
    fn to_nodes(&mut self, out: &mut NodeSums<D>) -> Result<(), Fault<D>> {
        if *self.strayed.get_mut() || self.age >= SORT_EVERY {
            self.sort()?;
        }
        self.average(|body, block, _, traces| {
            body.fixed.stress_traces(&body.columns.state[block], traces);
            Ok(())
        })?;
        self.scatter(Sums::all(out))
    }

    fn to_points(&mut self, v: &[Vector<D>], a: &[Vector<D>], dt: f64) -> Result<(), Fault<D>> {
        self.gather::<true, true>(v, a, dt)
    }

    fn kick(&mut self, v: &[Vector<D>], a: &[Vector<D>], dt: f64) -> Result<(), Fault<D>> {
        self.gather::<true, false>(v, a, dt)
    }

    fn momentum(&mut self, out: &mut [Vector<D>]) -> Result<(), Fault<D>> {
        self.scatter(Sums {
            first: 0,
            momentum: out,
            others: None,
        })
    }

    fn drift(&mut self, v: &[Vector<D>], dt: f64) -> Result<(), Fault<D>> {
        self.gather::<false, true>(v, v, dt)
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
            Carry::Affine { .. } => size_of::<Matrix<D>>(),
            Carry::Flip { .. } => 0,
        };
        // places and velocities share a second copy
        3 * vector + 2 * (gradient + state) + 2 * size_of::<u32>()
    }
}
