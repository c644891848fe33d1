//! Time integration. Integrators see only a [`System`].
//!
//! - [`newmark`]: beta = 1/4, gamma = 1/2.
//! - [`explicit`]: leapfrog, no equations.
//! - [`quasi_static`]: equilibrium without inertia.
//! - [`newton`]: the iteration that both share.

pub mod explicit;
pub mod newmark;
pub mod newton;
pub mod quasi_static;

use crate::error::SolverError;
use crate::linear::Moment;
use crate::tensor::Vector;

/// Factors of mass and damping in the effective matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rates {
    /// d a / d u (1/s2).
    pub mass: f64,
    /// d v / d u (1/s).
    pub viscous: f64,
}

/// A state of motion: increment of displacement, velocity, acceleration of the nodes.
#[derive(Clone, Copy, Debug)]
pub struct Motion<'a, const D: usize> {
    /// Increment of displacement over the step (m).
    pub increment: &'a [Vector<D>],
    /// Velocity (m/s).
    pub v: &'a [Vector<D>],
    /// Acceleration (m/s2).
    pub a: &'a [Vector<D>],
}

/// What a residual is to be judged by (N).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceScale {
    /// Norm of the largest of the forces that balance.
    pub largest: f64,
    /// What rounding alone leaves of the inertial forces, which are differences of large numbers.
    pub rounding: f64,
}

/// What integrators know of the body.
pub trait System<const D: usize> {
    /// Starts the step from `times[0]` to `times[1]` (s): transfers, masses, held unknowns.
    ///
    /// # Errors
    /// A point outside the grid.
    fn begin_step(&mut self, times: [f64; 2], moment: Moment) -> Result<(), SolverError>;

    /// Is the residual linear in the increment?
    fn is_linear(&self) -> bool;

    /// The present step.
    fn moment(&self) -> Moment;

    /// Motion at the start of the step; the increment is that of the step before.
    fn motion(&self) -> Motion<'_, D>;

    /// Puts held unknowns of a trial increment on their values.
    fn impose(&self, increment: &mut [Vector<D>]);

    /// Puts driven velocities and accelerations of the end of the step on their values.
    fn impose_end(&self, v: &mut [Vector<D>], a: &mut [Vector<D>]);

    /// External minus internal, viscous and inertial forces on free unknowns; returns what they are
    /// to be judged by.
    ///
    /// # Errors
    /// An inverted point, a force that is not finite.
    fn residual(
        &mut self,
        trial: &Motion<'_, D>,
        out: &mut [Vector<D>],
    ) -> Result<ForceScale, SolverError>;

    /// Solves the effective system at the trial increment for a correction; `scale` is what
    /// [`System::residual`] returned.
    ///
    /// # Errors
    /// The linear solver's.
    fn solve(
        &mut self,
        rates: Rates,
        increment: &[Vector<D>],
        right: &[Vector<D>],
        scale: ForceScale,
        correction: &mut [Vector<D>],
    ) -> Result<(), SolverError>;

    /// Finds the acceleration of the nodes at the start of an explicit step, 0 where they are held; it is
    /// that of [`System::motion`] from then on.
    ///
    /// # Errors
    /// An acceleration that is not finite.
    fn accelerate(&mut self) -> Result<(), SolverError>;

    /// Corrects the velocities that an explicit step has found, where terms do so.
    fn correct(&mut self, v: &mut [Vector<D>]);

    /// Puts driven velocities between start and end of an explicit step, and the accelerations that
    /// lead to its end, on their values.
    fn impose_between(&self, v: &mut [Vector<D>], a: &mut [Vector<D>]);

    /// Where a nodal field is largest (m).
    fn place_of_largest(&self, field: &[Vector<D>]) -> Vec<f64>;

    /// Accepts the state at the end of the step; unless the system is linear it is the one whose
    /// residual was asked for last.
    ///
    /// # Errors
    /// A point that is inverted or leaves the grid.
    fn commit(&mut self, end: &Motion<'_, D>) -> Result<(), SolverError>;
}

/// An integrator: makes one step at a time.
pub trait Integrator<const D: usize>: Send {
    /// Looks at the state at `times[0]`, before the step to `times[1]` is made: explicit steps find the
    /// acceleration there, which says what the velocity is.
    ///
    /// # Errors
    /// Those of the system.
    fn prepare(
        &mut self,
        _system: &mut dyn System<D>,
        _times: [f64; 2],
        _moment: Moment,
    ) -> Result<(), SolverError> {
        Ok(())
    }

    /// Makes the step from `times[0]` to `times[1]`; returns Newton's iterations.
    ///
    /// # Errors
    /// Those of the system, and no convergence.
    fn step(
        &mut self,
        system: &mut dyn System<D>,
        times: [f64; 2],
        moment: Moment,
    ) -> Result<usize, SolverError>;
}
