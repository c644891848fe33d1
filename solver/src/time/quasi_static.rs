//! Equilibrium without inertia: f_int(u) = f_ext at the end of each step.

use super::newton::Newton;
use super::{Integrator, Rates, System};
use crate::error::SolverError;
use crate::linear::Moment;

/// The integrator with its work space.
#[derive(Clone, Debug)]
pub struct QuasiStatic<const D: usize> {
    newton: Newton<D>,
}

impl<const D: usize> QuasiStatic<D> {
    /// For `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        QuasiStatic {
            newton: Newton::new(nodes),
        }
    }
}

impl<const D: usize> Integrator<D> for QuasiStatic<D> {
    fn step(
        &mut self,
        system: &mut dyn System<D>,
        times: [f64; 2],
        moment: Moment,
    ) -> Result<usize, SolverError> {
        system.begin_step(times, moment)?;
        let dt = times[1] - times[0];
        self.newton.increment.fill([0.0; D]);
        let rates = Rates {
            mass: 0.0,
            viscous: 0.0,
        };
        // forces see a body at rest
        let iterations = self.newton.solve(system, rates, |_, v, a| {
            v.fill([0.0; D]);
            a.fill([0.0; D]);
        })?;
        for (v, d) in self.newton.v.iter_mut().zip(&self.newton.increment) {
            *v = d.map(|d| d / dt);
        }
        system.commit(&self.newton.motion())?;
        Ok(iterations)
    }
}
