//! Sparse assembly, factorisation, iteration.

pub mod bicgstab;
pub mod block_matrix;
pub mod cg;
pub mod dense;
pub mod direct;

use crate::error::SolverError;
use crate::problem::SolverKind;
use crate::tensor::Vector;
use crate::time::ForceScale;
use bicgstab::BiCgStab;
use block_matrix::BlockMatrix;
use cg::{ConjugateGradients, Iterated};
use direct::Cholesky;

/// Conjugate gradients give way to a factorisation beyond this many iterations: a triangular solve
/// costs about as much as eight of them, a factorisation as much as forty.
pub(crate) const ITERATIONS_WORTH_A_FACTOR: usize = 50;
/// Without a factorisation to fall back on, conjugate gradients may go on this long.
const MOST_ITERATIONS: usize = 5_000;

/// When a solve happens, for error messages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Time step, from 1.
    pub step: usize,
    /// Time at its end (s).
    pub time_s: f64,
}

/// The system A x = b on the unknowns that are not held.
#[derive(Clone, Copy, Debug)]
pub struct Equations<'a, const D: usize> {
    /// A.
    pub matrix: &'a BlockMatrix<D>,
    /// Is A symmetric (and positive definite)?
    pub symmetric: bool,
    /// Unknowns that stay zero.
    pub held: &'a [[bool; D]],
    /// b.
    pub b: &'a [Vector<D>],
    /// The forces that b is what they lack to balance; tolerances refer to them.
    pub scale: ForceScale,
}

/// Chooses between iteration and factorisation, and remembers why.
#[derive(Debug)]
pub struct LinearSolver<const D: usize> {
    kind: SolverKind,
    rel_tol: f64,
    /// Order of elimination; made when a factorisation is first needed.
    order: Option<Vec<u32>>,
    iterative: ConjugateGradients<D>,
    direct: Option<Cholesky<D>>,
    unsymmetric: Option<BiCgStab<D>>,
    /// Is the factorisation that of the present matrix?
    factorised: bool,
    /// Iterations that made it change over.
    changed_over: Option<usize>,
    /// All iterations so far.
    pub iterations: usize,
    solves: usize,
}

impl<const D: usize> LinearSolver<D> {
    /// A solver for `nodes` nodes.
    pub fn new(kind: SolverKind, rel_tol: f64, nodes: usize) -> Self {
        LinearSolver {
            kind,
            rel_tol,
            order: None,
            iterative: ConjugateGradients::new(nodes),
            direct: None,
            unsymmetric: None,
            factorised: false,
            changed_over: None,
            iterations: 0,
            solves: 0,
        }
    }

    /// Says that the matrix has changed.
    pub fn invalidate(&mut self) {
        self.factorised = false;
    }

    /// Solves the equations to `rel_tol` times their scale.
    ///
    /// # Errors
    /// No convergence, or a pivot that is not positive.
    pub fn solve(
        &mut self,
        equations: &Equations<'_, D>,
        order: impl FnOnce() -> Vec<u32>,
        x: &mut [Vector<D>],
        moment: Moment,
    ) -> Result<(), SolverError> {
        let Equations {
            matrix,
            symmetric,
            held,
            b,
            scale,
        } = *equations;
        self.solves += 1;
        let tolerance = self.rel_tol * scale.largest + scale.rounding;
        if !symmetric {
            let solver = self
                .unsymmetric
                .get_or_insert_with(|| BiCgStab::new(b.len()));
            let done = solver.solve(matrix, held, b, x, tolerance, MOST_ITERATIONS);
            self.iterations += done.iterations;
            let name = "stabilised bi-conjugate gradients";
            return if done.converged {
                Ok(())
            } else {
                Err(gave_up(name, done, scale, moment))
            };
        }
        let iterate = match self.kind {
            SolverKind::Cg => true,
            SolverKind::Direct => false,
            SolverKind::Auto => self.changed_over.is_none(),
        };
        if iterate {
            let most = if self.kind == SolverKind::Auto {
                ITERATIONS_WORTH_A_FACTOR
            } else {
                MOST_ITERATIONS
            };
            let done = self.iterative.solve(matrix, held, b, x, tolerance, most);
            self.iterations += done.iterations;
            if done.converged {
                return Ok(());
            }
            if self.kind == SolverKind::Cg {
                return Err(gave_up("conjugate gradients", done, scale, moment));
            }
            self.changed_over = Some(done.iterations);
        }
        let singular = |reason| SolverError::SingularPivot {
            step: moment.step,
            time_s: moment.time_s,
            reason,
        };
        if self.direct.as_ref().is_none_or(|d| !d.serves(held)) {
            let order = self.order.get_or_insert_with(order);
            self.direct = Some(Cholesky::new(matrix, held, order).map_err(singular)?);
            self.factorised = false;
        }
        let Some(direct) = self.direct.as_mut() else {
            return Ok(());
        };
        if !self.factorised {
            direct.factorise(matrix).map_err(singular)?;
            self.factorised = true;
        }
        direct.solve(b, x);
        Ok(())
    }

    /// What was used and why.
    pub fn describe(&self) -> String {
        let mean = self.iterations as f64 / self.solves.max(1) as f64;
        if self.unsymmetric.is_some() {
            return format!(
                "stabilised bi-conjugate gradients, Jacobi (unsymmetric; {mean:.1} iterations a solve)"
            );
        }
        match (self.kind, self.changed_over) {
            (SolverKind::Direct, _) => "Cholesky, nested dissection (as asked)".to_owned(),
            (_, Some(n)) => format!(
                "Cholesky, nested dissection (conjugate gradients had not converged after {n} iterations)"
            ),
            (kind, None) => format!(
                "conjugate gradients, Jacobi ({}{mean:.1} iterations a solve)",
                if kind == SolverKind::Cg {
                    "as asked, "
                } else {
                    ""
                },
            ),
        }
    }
}

fn gave_up(solver: &'static str, done: Iterated, scale: ForceScale, moment: Moment) -> SolverError {
    SolverError::LinearNotConverged {
        solver,
        step: moment.step,
        time_s: moment.time_s,
        residual: done.residual / scale.largest,
        iterations: done.iterations,
    }
}
