//! Newton's iteration on the increment of displacement.

use super::{Motion, Rates, System};
use crate::error::SolverError;
use crate::linear::cg::norm;
use crate::tensor::Vector;

/// Residual, relative to the largest force, at which a step counts as solved. Two digits below the
/// error of a fine mesh in space and time; a step of small strain meets it with its first correction.
const TOLERANCE: f64 = 1e-8;
/// More iterations than this mean that the step is too large.
const MOST_ITERATIONS: usize = 20;

/// Trial state and work space, kept between steps.
#[derive(Clone, Debug)]
pub struct Newton<const D: usize> {
    /// Trial increment (m).
    pub increment: Vec<Vector<D>>,
    /// Trial velocity (m/s).
    pub v: Vec<Vector<D>>,
    /// Trial acceleration (m/s2).
    pub a: Vec<Vector<D>>,
    residual: Vec<Vector<D>>,
    correction: Vec<Vector<D>>,
}

impl<const D: usize> Newton<D> {
    /// For `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        let zeros = || vec![[0.0; D]; nodes];
        Newton {
            increment: zeros(),
            v: zeros(),
            a: zeros(),
            residual: zeros(),
            correction: zeros(),
        }
    }

    /// The trial state.
    pub fn motion(&self) -> Motion<'_, D> {
        Motion {
            increment: &self.increment,
            v: &self.v,
            a: &self.a,
        }
    }

    /// Corrects the increment until the forces balance. `kinematics` sets the velocity and
    /// acceleration that belong to the increment. Returns the number of corrections.
    ///
    /// A linear system needs one correction and no second look at its residual.
    ///
    /// # Errors
    /// Those of the system; [`SolverError::NotConverged`].
    pub fn solve(
        &mut self,
        system: &mut dyn System<D>,
        rates: Rates,
        kinematics: impl Fn(&[Vector<D>], &mut [Vector<D>], &mut [Vector<D>]),
    ) -> Result<usize, SolverError> {
        system.impose(&mut self.increment);
        let mut relative = f64::INFINITY;
        for iteration in 0..=MOST_ITERATIONS {
            kinematics(&self.increment, &mut self.v, &mut self.a);
            if system.is_linear() && iteration == 1 {
                return Ok(1);
            }
            let trial = Motion {
                increment: &self.increment,
                v: &self.v,
                a: &self.a,
            };
            let scale = system.residual(&trial, &mut self.residual)?;
            let size = norm(&self.residual);
            relative = if scale.largest > 0.0 {
                size / scale.largest
            } else {
                0.0
            };
            let balanced = size <= TOLERANCE * scale.largest + scale.rounding;
            if balanced && !system.is_linear() || size == 0.0 {
                return Ok(iteration);
            }
            if iteration == MOST_ITERATIONS {
                break;
            }
            system.solve(
                rates,
                &self.increment,
                &self.residual,
                scale,
                &mut self.correction,
            )?;
            for (d, c) in self.increment.iter_mut().zip(&self.correction) {
                for i in 0..D {
                    d[i] += c[i];
                }
            }
        }
        let moment = system.moment();
        Err(SolverError::NotConverged {
            step: moment.step,
            time_s: moment.time_s,
            residual: relative,
            iterations: MOST_ITERATIONS,
            place: system.place_of_largest(&self.residual),
        })
    }
}
