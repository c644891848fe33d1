//! What moves: grid, points, kernels, boundary methods, time integration.
//!
//! A [`problem::Problem`] goes in, a [`record::Record`] comes out; see [`solve`].
//!
//! | module | what |
//! |---|---|
//! | [`problem`], [`probe`], [`wavelet`] | the problem as a caller puts it |
//! | [`boundary`] | one file a boundary method |
//! | [`grid`], [`points`], [`basis`] | background grid, material points, shape functions |
//! | [`material`] | one file a constitutive model |
//! | [`physics`] | region kernels, terms on nodes, the model that joins them |
//! | [`flow`] | material points in explicit steps |
//! | [`time`], [`linear`] | integrators, Newton, sparse solvers |
//! | [`record`], [`error`] | what comes out |
//! | [`Bill`] | what it will cost |

pub mod basis;
mod bill;
pub mod boundary;
mod drive;
pub mod error;
pub mod flow;
pub mod geometry;
pub mod grid;
pub mod linear;
pub mod material;
pub mod physics;
pub mod points;
pub mod probe;
pub mod problem;
pub mod record;
mod run;
mod sampler;
pub mod setup;
pub mod tensor;
pub mod time;
pub mod wavelet;

pub use bill::{Bill, Item};
use error::SolverError;
use problem::{Aabb, Problem};
use record::Record;

/// Told of every step; says whether to go on.
pub trait Monitor: Sync {
    /// `done` of `total` steps are made. Returns false to stop the run.
    fn step(&self, done: usize, total: usize) -> bool;
}

/// What a solve leaves: the record of everything computed, and why it ended early if it did.
#[derive(Debug)]
pub struct Outcome {
    /// What was computed, also after a failure.
    pub record: Record,
    /// The failure, if any.
    pub error: Option<SolverError>,
}

/// Solves a problem.
///
/// # Errors
/// [`SolverError::Setup`] when the problem cannot be set up; failures during the run are in
/// [`Outcome::error`], beside what was computed before.
pub fn solve<const D: usize>(
    problem: &Problem<D>,
    monitor: &dyn Monitor,
) -> Result<Outcome, SolverError> {
    run::run(problem, monitor)
}

/// Runs a model that [`setup::model`] built for `problem` and the caller may have altered.
pub fn run_model<const D: usize>(
    problem: &Problem<D>,
    model: physics::model::Model<D>,
    monitor: &dyn Monitor,
) -> Outcome {
    run::run_model(problem, model, monitor)
}

/// The bill of a problem.
///
/// # Errors
/// [`SolverError::Setup`] as for [`solve`].
pub fn bill<const D: usize>(problem: &Problem<D>) -> Result<Bill, SolverError> {
    bill::bill(problem)
}

/// The box (m) of all material of a problem: the body and what its sides' methods add to it.
///
/// # Errors
/// [`SolverError::Setup`] as for [`solve`].
pub fn material_box<const D: usize>(problem: &Problem<D>) -> Result<Aabb<D>, SolverError> {
    Ok(geometry::Geometry::new(problem)?.material_box)
}
