//! Leapfrog: velocities stand between steps,
//!
//! ```text
//! v_n+1/2 = v_n-1/2 + dt a_n,     u_n+1 = u_n + dt v_n+1/2
//! ```
//!
//! and v_n = v_n-1/2 + dt/2 a_n is what is recorded, so that a step is prepared before the one before it
//! is looked at. Second order, no equations to solve; stable while the largest frequency w of the mesh has w dt < 2,
//! which c_p dt < h ensures on linear elements of equal edges (Courant, Friedrichs & Lewy 1928).

use super::{Integrator, Motion, System};
use crate::error::SolverError;
use crate::linear::Moment;
use crate::tensor::Vector;

/// The integrator with its work space.
#[derive(Clone, Debug)]
pub struct Explicit<const D: usize> {
    increment: Vec<Vector<D>>,
    v: Vec<Vector<D>>,
    a: Vec<Vector<D>>,
}

impl<const D: usize> Explicit<D> {
    /// For `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        let zeros = || vec![[0.0; D]; nodes];
        Explicit {
            increment: zeros(),
            v: zeros(),
            a: zeros(),
        }
    }
}

impl<const D: usize> Integrator<D> for Explicit<D> {
    fn prepare(
        &mut self,
        system: &mut dyn System<D>,
        times: [f64; 2],
        moment: Moment,
    ) -> Result<(), SolverError> {
        system.begin_step(times, moment)?;
        system.accelerate()
    }

    fn step(
        &mut self,
        system: &mut dyn System<D>,
        times: [f64; 2],
        _moment: Moment,
    ) -> Result<usize, SolverError> {
        let dt = times[1] - times[0];
        let start = system.motion();
        for ((v, start), a) in self.v.iter_mut().zip(start.v).zip(start.a) {
            *v = std::array::from_fn(|i| start[i] + dt * a[i]);
        }
        system.correct(&mut self.v);
        // what corrects a velocity changes the acceleration that points are given
        let start = system.motion();
        for ((a, start), v) in self.a.iter_mut().zip(start.v).zip(&self.v) {
            *a = std::array::from_fn(|i| (v[i] - start[i]) / dt);
        }
        system.impose_between(&mut self.v, &mut self.a);
        for (d, v) in self.increment.iter_mut().zip(&self.v) {
            *d = v.map(|v| dt * v);
        }
        system.commit(&Motion {
            increment: &self.increment,
            v: &self.v,
            a: &self.a,
        })?;
        Ok(0)
    }
}
