//! Newmark's method with beta = 1/4, gamma = 1/2 (the average acceleration):
//!
//! ```text
//! v' = 2 du/dt - v,     a' = 4 du/dt^2 - 4 v/dt - a
//! ```
//!
//! Second order, unconditionally stable, keeps the energy of a linear body (Newmark 1959).

use super::newton::Newton;
use super::{Integrator, Rates, System};
use crate::error::SolverError;
use crate::linear::Moment;
use crate::tensor::Vector;

/// The integrator with its work space.
#[derive(Clone, Debug)]
pub struct Newmark<const D: usize> {
    newton: Newton<D>,
    v: Vec<Vector<D>>,
    a: Vec<Vector<D>>,
}

impl<const D: usize> Newmark<D> {
    /// For `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        let zeros = || vec![[0.0; D]; nodes];
        Newmark {
            newton: Newton::new(nodes),
            v: zeros(),
            a: zeros(),
        }
    }
}

impl<const D: usize> Integrator<D> for Newmark<D> {
    fn step(
        &mut self,
        system: &mut dyn System<D>,
        times: [f64; 2],
        moment: Moment,
    ) -> Result<usize, SolverError> {
        system.begin_step(times, moment)?;
        let dt = times[1] - times[0];
        let start = system.motion();
        self.v.copy_from_slice(start.v);
        self.a.copy_from_slice(start.a);
        let (v, a) = (&self.v, &self.a);
        // first trial: the acceleration stays as it is
        for ((d, v), a) in self.newton.increment.iter_mut().zip(v).zip(a) {
            *d = std::array::from_fn(|i| dt * v[i] + 0.5 * dt * dt * a[i]);
        }
        let rates = Rates {
            mass: 4.0 / (dt * dt),
            viscous: 2.0 / dt,
        };
        let iterations = self.newton.solve(system, rates, |increment, v1, a1| {
            for ((d, (v, a)), (v1, a1)) in increment
                .iter()
                .zip(v.iter().zip(a))
                .zip(v1.iter_mut().zip(a1))
            {
                for i in 0..D {
                    v1[i] = 2.0 * d[i] / dt - v[i];
                    a1[i] = 4.0 * (d[i] / dt - v[i]) / dt - a[i];
                }
            }
        })?;
        system.impose_end(&mut self.newton.v, &mut self.newton.a);
        system.commit(&self.newton.motion())?;
        Ok(iterations)
    }
}
