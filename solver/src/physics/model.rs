//! The semi-discrete system: points, nodes, regions and terms joined.

use super::flowing::Flowing;
use super::inertia::{Consistent, PointInertia, lump};
use super::kernel::{Constraints, Lumped, NodeTerm, RegionKernel, Stiffness, Trial};
use super::stiffness::{Matrices, Surroundings};
use super::transfer::KeptNodes;
use crate::basis::Discretisation;
use crate::error::SolverError;
use crate::grid::Grid;
use crate::linear::{LinearSolver, Moment};
use crate::points::Points;
use crate::problem::Transfer;
use crate::tensor::Vector;
use crate::time::Rates;
use std::ops::Range;

/// A range of points with its kernel.
pub struct Region<const D: usize> {
    /// Its points.
    pub range: Range<usize>,
    /// Does it belong to the body of interest?
    pub in_target: bool,
    /// What its points do.
    pub kernel: Box<dyn RegionKernel<D>>,
}

/// Nodal state.
#[derive(Clone, Debug)]
pub struct Nodes<const D: usize> {
    /// Lumped coefficients.
    pub lumped: Lumped<D>,
    /// Nodes with mass.
    pub active: Vec<bool>,
    /// Sum of the increments (m): the displacement where nodes keep the motion or move little.
    pub u: Vec<Vector<D>>,
    /// Velocity (m/s).
    pub v: Vec<Vector<D>>,
    /// Acceleration (m/s2).
    pub a: Vec<Vector<D>>,
    /// Increment of displacement of the last step (m).
    pub increment: Vec<Vector<D>>,
}

/// The parts that a model is joined from.
pub struct Parts<const D: usize> {
    /// Background grid.
    pub grid: Grid<D>,
    /// Shape functions.
    pub disc: Box<dyn Discretisation<D>>,
    /// Material points: those that carry the motion first, layers at rest last.
    pub points: Points<D>,
    /// Regions of points.
    pub regions: Vec<Region<D>>,
    /// Terms on nodes.
    pub terms: Vec<Box<dyn NodeTerm<D>>>,
    /// The first so many points move; `None`: the body is frozen.
    pub movable: Option<usize>,
    /// From here on points rest and their nodes keep the motion.
    pub first_kept: usize,
    /// Do points take their displacement from the nodes in every step (K25 (18)), or by increments?
    pub replaced_displacement: bool,
    /// Transfer between points and nodes.
    pub transfer: Transfer,
    /// Points that explicit steps move, in place of the regions of plain material.
    pub flow: Option<Flowing<D>>,
    /// Velocity (m/s) of the frame that all the others are in.
    pub frame: Vector<D>,
    /// Linear solver.
    pub solver: LinearSolver<D>,
    /// Does inertia couple nodes as the shape functions do?
    pub consistent: bool,
    /// Are steps explicit, velocities standing between them?
    pub explicit: bool,
}

/// Points, nodes, regions and terms.
pub struct Model<const D: usize> {
    /// Background grid.
    pub grid: Grid<D>,
    /// Shape functions.
    pub disc: Box<dyn Discretisation<D>>,
    /// Material points.
    pub points: Points<D>,
    /// Regions of points.
    pub regions: Vec<Region<D>>,
    /// Terms on nodes.
    pub terms: Vec<Box<dyn NodeTerm<D>>>,
    /// Nodal state.
    pub nodes: Nodes<D>,
    /// Do points move?
    pub moving: bool,
    /// Transfer between points and nodes.
    pub transfer: Transfer,
    /// Linear solver.
    pub solver: LinearSolver<D>,
    /// Points that explicit steps move.
    pub flow: Option<Flowing<D>>,
    /// Velocity (m/s) of the frame that places and velocities are in; energies and momenta are not.
    pub frame: Vector<D>,
    pub(super) explicit: bool,
    pub(super) movable: usize,
    pub(super) replaced_displacement: bool,
    pub(super) kept: KeptNodes<D>,
    pub(super) matrices: Matrices<D>,
    pub(super) moment: Moment,
    pub(super) dt: f64,
    /// What points at rest contribute, once and for all.
    resting: Lumped<D>,
    first_kept: usize,
    inertia: PointInertia<D>,
    pub(super) consistent: Option<Consistent<D>>,
    pub(super) constraints: Constraints<D>,
    pub(super) work: Vec<Vector<D>>,
    pub(super) times: [f64; 2],
}

impl<const D: usize> Model<D> {
    /// Joins the parts and assembles what stays constant.
    ///
    /// # Errors
    /// A point outside the grid.
    pub fn new(parts: Parts<D>) -> Result<Self, SolverError> {
        let Parts {
            grid,
            mut disc,
            points,
            mut regions,
            mut terms,
            transfer,
            solver,
            consistent,
            ..
        } = parts;
        let n = grid.node_count();
        let vectors = || vec![[0.0; D]; n];
        let moment = Moment {
            step: 0,
            time_s: 0.0,
        };
        disc.place(&points.place)
            .map_err(|p| left_grid(&points.place[p], moment))?;
        for term in &mut terms {
            term.attach(disc.as_ref())
                .map_err(|x| left_grid(&x, moment))?;
        }
        let kept = match (&points.motion, &parts.flow) {
            (Some(_), _) | (_, Some(_)) => {
                KeptNodes::touched(disc.as_ref(), &points, parts.first_kept)
            }
            (None, None) => KeptNodes::default(),
        };
        let mut model = Model {
            matrices: Matrices::new(&mut regions, disc.as_ref(), &points, !parts.explicit),
            explicit: parts.explicit,
            flow: parts.flow,
            frame: parts.frame,
            nodes: Nodes {
                lumped: Lumped::zeros(n),
                active: vec![false; n],
                u: vectors(),
                v: vectors(),
                a: vectors(),
                increment: vectors(),
            },
            constraints: Constraints::none(n),
            work: vectors(),
            moving: parts.movable.is_some(),
            movable: parts.movable.unwrap_or(0),
            replaced_displacement: parts.replaced_displacement,
            kept,
            resting: Lumped::default(),
            first_kept: parts.first_kept,
            inertia: PointInertia::default(),
            consistent: consistent.then(|| Consistent::new(n)),
            grid,
            disc,
            points,
            regions,
            terms,
            transfer,
            solver,
            times: [0.0; 2],
            moment,
            dt: 0.0,
        };
        model.resting = model.lumped_at_rest();
        model.lump();
        Ok(model)
    }

    /// Material points, those that flow included.
    pub fn point_count(&self) -> usize {
        self.points.len() + self.flow.as_ref().map_or(0, Flowing::len)
    }

    /// Adds a region of points at rest with its kernel, or puts it in place of one that was taken out.
    pub fn add_layer(&mut self, kernel: Box<dyn RegionKernel<D>>, range: Range<usize>) {
        self.regions.push(Region {
            range,
            in_target: false,
            kernel,
        });
        self.resting = self.lumped_at_rest();
        self.lump();
    }

    fn lumped_at_rest(&mut self) -> Lumped<D> {
        let mut resting = Lumped::zeros(self.grid.node_count());
        let (disc, own) = (self.disc.as_ref(), &mut self.inertia);
        let at_rest = |r: &&Region<D>| r.range.start >= self.first_kept;
        for region in self.regions.iter().filter(at_rest) {
            lump(region, disc, &self.points, own, &mut resting);
        }
        resting
    }

    /// Gathers masses and damping of the nodes.
    pub(super) fn lump(&mut self) {
        let lumped = &mut self.nodes.lumped;
        lumped.copy_from(&self.resting);
        let (disc, own) = (self.disc.as_ref(), &mut self.inertia);
        let not_at_rest = |r: &&Region<D>| r.range.start < self.first_kept;
        for region in self.regions.iter().filter(not_at_rest) {
            lump(region, disc, &self.points, own, lumped);
        }
        if let Some(flow) = &self.flow {
            flow.lump(lumped);
        }
        if let Some(consistent) = &mut self.consistent {
            consistent.diagonal.copy_from(lumped);
        }
        for term in &self.terms {
            term.lump(self.times[0], lumped);
        }
        if let Some(consistent) = &mut self.consistent {
            consistent.diagonal.become_rest_of(lumped);
        }
        for (active, mass) in self.nodes.active.iter_mut().zip(&lumped.mass) {
            *active = mass.iter().all(|m| *m > 0.0);
        }
    }

    /// Unknowns that are not held.
    pub fn unknowns(&self) -> usize {
        self.constraints
            .held
            .as_flattened()
            .iter()
            .filter(|h| !**h)
            .count()
    }

    /// How long before the end of a step nodal velocities stand (s): half of it in explicit steps.
    pub fn velocity_lag(&self) -> f64 {
        if self.explicit { 0.5 * self.dt } else { 0.0 }
    }

    pub(super) fn trial<'a>(&'a self, increment: &'a [Vector<D>]) -> Trial<'a, D> {
        Trial {
            disc: self.disc.as_ref(),
            points: &self.points,
            start: &self.nodes.u,
            increment,
            dt: self.dt,
            moment: self.moment,
        }
    }

    /// Internal force of the trial increment.
    pub(super) fn internal_force(
        &mut self,
        increment: &[Vector<D>],
        out: &mut [Vector<D>],
    ) -> Result<(), SolverError> {
        match self.matrices.linear() {
            Some(stiffness) => {
                for ((w, u), d) in self.work.iter_mut().zip(&self.nodes.u).zip(increment) {
                    *w = std::array::from_fn(|i| u[i] + d[i]);
                }
                stiffness.apply(&self.work, out);
            }
            None => out.fill([0.0; D]),
        }
        let mut regions = std::mem::take(&mut self.regions);
        let trial = self.trial(increment);
        let mut result = Ok(());
        for region in regions
            .iter_mut()
            .filter(|r| r.kernel.stiffness() != Stiffness::Linear)
        {
            result = result.and_then(|()| region.kernel.force(&trial, out));
        }
        self.regions = regions;
        result
    }

    /// Internal force of the state at the start of the step.
    pub(super) fn present_force(&mut self, out: &mut [Vector<D>]) {
        match self.matrices.linear() {
            Some(stiffness) => stiffness.apply(&self.nodes.u, out),
            None => out.fill([0.0; D]),
        }
        let (disc, points) = (self.disc.as_ref(), &self.points);
        for region in &mut self.regions {
            if let Some(kernel) = region.kernel.explicit() {
                kernel.present_force(disc, points, out);
            }
        }
    }

    /// The effective matrix at the trial increment.
    pub(super) fn assemble(&mut self, rates: Rates, increment: &[Vector<D>]) {
        let trial = Trial {
            disc: self.disc.as_ref(),
            points: &self.points,
            start: &self.nodes.u,
            increment,
            dt: self.dt,
            moment: self.moment,
        };
        let consistent = self.consistent.as_ref();
        let around = Surroundings {
            diagonal: consistent.map_or(&self.nodes.lumped, |c| &c.diagonal),
            terms: &self.terms,
            active: &self.nodes.active,
        };
        self.matrices
            .assemble(rates, &mut self.regions, &trial, &around);
        if let Some(consistent) = &mut self.consistent {
            let (disc, out) = (self.disc.as_ref(), self.matrices.effective_mut());
            consistent.add_to(out, &self.regions, disc, &self.points, rates);
        }
        self.solver.invalidate();
    }

    pub(super) fn check_finite(
        &self,
        values: &[Vector<D>],
        field: &'static str,
    ) -> Result<(), SolverError> {
        match values.iter().position(|x| x.iter().any(|v| !v.is_finite())) {
            None => Ok(()),
            Some(node) => Err(SolverError::NonFinite {
                field,
                step: self.moment.step,
                time_s: self.moment.time_s,
                place: self.grid.node_place(node).to_vec(),
            }),
        }
    }
}

/// The error of a place outside the grid.
pub(super) fn left_grid<const D: usize>(place: &Vector<D>, moment: Moment) -> SolverError {
    SolverError::LeftGrid {
        step: moment.step,
        time_s: moment.time_s,
        place: place.to_vec(),
    }
}
