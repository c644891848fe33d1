//! The model as integrators see it: residual, tangent, commit.

use super::kernel::Step;
use super::model::Model;
use super::stiffness::weighted_square;
use crate::error::SolverError;
use crate::linear::cg::norm;
use crate::linear::{Equations, Moment};
use crate::tensor::Vector;
use crate::time::{ForceScale, Motion, Rates, System};

impl<const D: usize> System<D> for Model<D> {
    fn begin_step(&mut self, times: [f64; 2], moment: Moment) -> Result<(), SolverError> {
        self.times = times;
        self.dt = times[1] - times[0];
        self.moment = moment;
        self.collect_flow()?;
        if self.moving {
            self.lump();
        }
        self.transfer_to_nodes();
        self.constrain();
        Ok(())
    }

    fn is_linear(&self) -> bool {
        !self.moving
    }

    fn moment(&self) -> Moment {
        self.moment
    }

    fn motion(&self) -> Motion<'_, D> {
        Motion {
            increment: &self.nodes.increment,
            v: &self.nodes.v,
            a: &self.nodes.a,
        }
    }

    fn impose(&self, increment: &mut [Vector<D>]) {
        for (d, held) in increment.iter_mut().zip(&self.constraints.held) {
            for i in 0..D {
                if held[i] {
                    d[i] = 0.0;
                }
            }
        }
        for &(node, i, motion) in &self.constraints.driven {
            let mean = 0.5 * (motion.velocity[0] + motion.velocity[1]);
            increment[node as usize][i as usize] = self.dt * mean;
        }
    }

    fn impose_end(&self, v: &mut [Vector<D>], a: &mut [Vector<D>]) {
        for &(node, i, motion) in &self.constraints.driven {
            v[node as usize][i as usize] = motion.velocity[1];
            a[node as usize][i as usize] = motion.acceleration[1];
        }
    }

    fn residual(
        &mut self,
        trial: &Motion<'_, D>,
        out: &mut [Vector<D>],
    ) -> Result<ForceScale, SolverError> {
        self.internal_force(trial.increment, out)?;
        let mut scale = norm(out);
        let lumped = &self.nodes.lumped;
        scale = scale.max(weighted_square(&lumped.mass, trial.a).sqrt());
        let rate = 4.0 / (self.dt * self.dt);
        let large = rate * weighted_square(&lumped.mass, trial.increment).sqrt();
        for f in out.as_flattened_mut() {
            *f = -*f;
        }
        let consistent = self.consistent.as_ref();
        let diagonal = consistent.map_or(lumped, |c| &c.diagonal);
        subtract_product(out, &diagonal.mass, trial.a);
        subtract_product(out, &diagonal.viscous, trial.v);
        subtract_product(out, &diagonal.stiffness, &self.nodes.u);
        subtract_product(out, &diagonal.stiffness, trial.increment);
        if let Some(consistent) = &mut self.consistent {
            let (disc, points) = (self.disc.as_ref(), &self.points);
            consistent.subtract(&self.regions, disc, points, trial, &self.nodes.u, out);
        }
        for term in &self.terms {
            term.force(self.times[1], trial.v, &self.nodes.active, out);
        }
        for (f, held) in out.iter_mut().zip(&self.constraints.held) {
            for i in 0..D {
                if held[i] {
                    f[i] = 0.0;
                }
            }
        }
        self.check_finite(out, "the balance of forces")?;
        Ok(ForceScale {
            largest: scale.max(norm(out)),
            rounding: 8.0 * f64::EPSILON * large,
        })
    }

    fn solve(
        &mut self,
        rates: Rates,
        increment: &[Vector<D>],
        right: &[Vector<D>],
        scale: ForceScale,
        correction: &mut [Vector<D>],
    ) -> Result<(), SolverError> {
        // a moving model's tangent changes with every trial, a frozen one's only with the rates
        if self.moving || !self.matrices.stands_for(rates) {
            self.assemble(rates, increment);
        }
        let disc = &self.disc;
        let equations = Equations {
            matrix: self.matrices.effective(),
            symmetric: self.regions.iter().all(|r| r.kernel.is_symmetric()),
            held: &self.constraints.held,
            b: right,
            scale,
        };
        self.solver.solve(
            &equations,
            || disc.elimination_order(),
            correction,
            self.moment,
        )?;
        self.check_finite(correction, "the displacement")
    }

    /// `(M + C dt/2 + K dt^2/4) a = f_ext(t_n) - f_int(n) - K u_n - C v`, with C the lumped damping and K
    /// the springs: v' = v + dt a is then the bilinear map of the lumped terms, the one that memories of
    /// layers have.
    fn accelerate(&mut self) -> Result<(), SolverError> {
        let mut acceleration = std::mem::take(&mut self.nodes.a);
        let out = &mut acceleration[..];
        self.present_force(out);
        for f in out.as_flattened_mut() {
            *f = -*f;
        }
        if let Some(flow) = &self.flow {
            flow.add_forces(out);
        }
        let lumped = &self.nodes.lumped;
        subtract_product(out, &lumped.stiffness, &self.nodes.u);
        subtract_product(out, &lumped.viscous, &self.nodes.v);
        for term in &self.terms {
            term.force(self.times[0], &self.nodes.v, &self.nodes.active, out);
        }
        let (half, quarter) = (0.5 * self.dt, 0.25 * self.dt * self.dt);
        let at = |field: &[Vector<D>], n: usize, i: usize| field.get(n).map_or(0.0, |x| x[i]);
        for (n, (a, held)) in out.iter_mut().zip(&self.constraints.held).enumerate() {
            for i in 0..D {
                if held[i] {
                    a[i] = 0.0;
                } else {
                    a[i] /= lumped.mass[n][i]
                        + half * at(&lumped.viscous, n, i)
                        + quarter * at(&lumped.stiffness, n, i);
                }
            }
        }
        self.nodes.a = acceleration;
        self.check_finite(&self.nodes.a, "the acceleration")
    }

    fn correct(&mut self, v: &mut [Vector<D>]) {
        let places = self.flow.as_ref().map_or(&[][..], |flow| flow.places());
        let step = Step {
            times: self.times,
            mass: &self.nodes.lumped.mass,
            places,
        };
        for term in &mut self.terms {
            term.correct(&step, v);
        }
        for (v, held) in v.iter_mut().zip(&self.constraints.held) {
            for i in 0..D {
                if held[i] {
                    v[i] = 0.0;
                }
            }
        }
    }

    fn impose_between(&self, v: &mut [Vector<D>], a: &mut [Vector<D>]) {
        for &(node, i, motion) in &self.constraints.driven {
            let [start, end] = motion.velocity;
            v[node as usize][i as usize] = 0.5 * (start + end);
            a[node as usize][i as usize] = (end - start) / self.dt;
        }
    }

    fn place_of_largest(&self, field: &[Vector<D>]) -> Vec<f64> {
        let size = |n: &usize| field[*n].iter().map(|x| x.abs()).fold(0.0, f64::max);
        let node = (0..field.len())
            .max_by(|a, b| size(a).total_cmp(&size(b)))
            .unwrap_or(0);
        self.grid.node_place(node).to_vec()
    }

    fn commit(&mut self, end: &Motion<'_, D>) -> Result<(), SolverError> {
        let mut regions = std::mem::take(&mut self.regions);
        let trial = self.trial(end.increment);
        let mut result = Ok(());
        for region in &mut regions {
            result = result.and_then(|()| match region.kernel.explicit() {
                Some(kernel) if self.explicit => kernel.advance(&trial),
                _ => region.kernel.commit(&trial),
            });
        }
        self.regions = regions;
        result?;
        self.nodes.increment.copy_from_slice(end.increment);
        self.nodes.v.copy_from_slice(end.v);
        self.nodes.a.copy_from_slice(end.a);
        for (u, d) in self.nodes.u.iter_mut().zip(end.increment) {
            for i in 0..D {
                u[i] += d[i];
            }
        }
        self.transfer_to_points();
        self.move_flow()?;
        if self.moving {
            self.move_points()
        } else {
            Ok(())
        }
    }
}

/// `out -= coefficients * values`, entry by entry; nothing when there are no coefficients.
fn subtract_product<const D: usize>(
    out: &mut [Vector<D>],
    coefficients: &[Vector<D>],
    values: &[Vector<D>],
) {
    for ((f, c), x) in out.iter_mut().zip(coefficients).zip(values) {
        for i in 0..D {
            f[i] -= c[i] * x[i];
        }
    }
}
