//! Why a solve failed: each variant says when and where, and its text what to do.

use thiserror::Error;

/// A failed solve. Times in seconds, places in metres.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SolverError {
    /// Newton's method did not reach its tolerance.
    #[error(
        "Newton did not converge in step {step} (t = {time_s} s): residual {residual:.3e} after {iterations} iterations, largest at {place:?} m; try a smaller time.dt_s"
    )]
    NotConverged {
        /// Time step, from 1.
        step: usize,
        /// Time at the end of the step.
        time_s: f64,
        /// Relative residual reached.
        residual: f64,
        /// Iterations made.
        iterations: usize,
        /// Where the residual is largest.
        place: Vec<f64>,
    },
    /// The linear solver did not reach its tolerance.
    #[error(
        "{solver} did not converge in step {step} (t = {time_s} s): relative residual {residual:.3e} after {iterations} iterations; try solver.kind = \"direct\""
    )]
    LinearNotConverged {
        /// Name of the linear solver.
        solver: &'static str,
        /// Time step, from 1.
        step: usize,
        /// Time at the end of the step.
        time_s: f64,
        /// Relative residual reached.
        residual: f64,
        /// Iterations made.
        iterations: usize,
    },
    /// A field became NaN or infinite.
    #[error(
        "{field} is not finite in step {step} (t = {time_s} s), first at {place:?} m: the run has diverged"
    )]
    NonFinite {
        /// Which field.
        field: &'static str,
        /// Time step, from 1.
        step: usize,
        /// Time at the end of the step.
        time_s: f64,
        /// Place of the first bad value.
        place: Vec<f64>,
    },
    /// A material point was turned inside out.
    #[error(
        "the material point at {place:?} m is inverted in step {step} (t = {time_s} s), det F = {determinant:.3e}; try a smaller time.dt_s"
    )]
    InvertedPoint {
        /// Time step, from 1.
        step: usize,
        /// Time at the end of the step.
        time_s: f64,
        /// Place of the point.
        place: Vec<f64>,
        /// Determinant of the increment of the deformation gradient.
        determinant: f64,
    },
    /// The factorisation met a pivot that is not positive.
    #[error(
        "the stiffness matrix is singular or not positive definite in step {step} (t = {time_s} s): {reason}; is the body held anywhere?"
    )]
    SingularPivot {
        /// Time step, from 1.
        step: usize,
        /// Time at the end of the step.
        time_s: f64,
        /// What the factorisation said.
        reason: String,
    },
    /// A material point moved off the background grid.
    #[error(
        "the material point at {place:?} m left the background grid in step {step} (t = {time_s} s)"
    )]
    LeftGrid {
        /// Time step, from 1.
        step: usize,
        /// Time at the end of the step.
        time_s: f64,
        /// Place of the point.
        place: Vec<f64>,
    },
    /// The problem as put cannot be set up.
    #[error("{field}: {reason}")]
    Setup {
        /// The scene's field that is at fault, for example `boundary.bottom`.
        field: String,
        /// What is wrong and what works.
        reason: String,
    },
}

impl SolverError {
    /// The same with its place (m) as seen from where a frame that moves at `velocity` (m/s) comes from.
    pub(crate) fn out_of_frame(mut self, velocity: &[f64]) -> Self {
        use SolverError::{InvertedPoint, LeftGrid, NonFinite, NotConverged};
        if let NotConverged { place, time_s, .. }
        | NonFinite { place, time_s, .. }
        | InvertedPoint { place, time_s, .. }
        | LeftGrid { place, time_s, .. } = &mut self
        {
            for (x, v) in place.iter_mut().zip(velocity) {
                *x += v * *time_s;
            }
        }
        self
    }
}
