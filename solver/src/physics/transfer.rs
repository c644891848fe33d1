//! Motion between points and nodes in every step.
//!
//! ```text
//! v_I = sum m_p N_I [v_p + L_v (x_I - x_p)] / m_I     (the gradients with the affine transfer alone)
//! a_p' = sum N_I a_I',   v_p' = v_p + dt/2 (a_p + a_p')                     (K25 (15), (19), (20))
//! ```
//!
//! and in explicit steps, where velocities stand between steps, `v_p' = v_p + dt sum N a_I`.
//!
//! Nodes that a layer at rest touches keep their motion. Points may carry a factor of inertia for
//! each direction (K25 (16), (17)) and their displacement (K25 (17a), (18)).

use super::model::Model;
use crate::error::SolverError;
use crate::points::{BLOCK, Points, blocks};
use crate::problem::Transfer;
use crate::tensor::{Matrix, Vector, zero};

/// Which nodal field a transfer fills.
#[derive(Clone, Copy, PartialEq)]
enum Field {
    Velocity,
    Acceleration,
    Displacement,
}

impl<const D: usize> Model<D> {
    /// Points to nodes.
    pub(super) fn transfer_to_nodes(&mut self) {
        if self.points.motion.is_none() {
            return;
        }
        let nodes = &mut self.nodes;
        for (saved, &n) in self.kept.saved.iter_mut().zip(&self.kept.nodes) {
            *saved = (nodes.v[n as usize], nodes.a[n as usize]);
        }
        self.scatter(Field::Velocity);
        if !self.explicit {
            self.scatter(Field::Acceleration);
        }
        if self.points.motion.as_ref().is_some_and(|m| m.u.is_some()) {
            self.scatter(Field::Displacement);
        }
        let nodes = &mut self.nodes;
        for (saved, &n) in self.kept.saved.iter().zip(&self.kept.nodes) {
            (nodes.v[n as usize], nodes.a[n as usize]) = *saved;
        }
    }

    /// Mass-weighted mean of what the points carry.
    fn scatter(&mut self, field: Field) {
        let Some(motion) = &self.points.motion else {
            return;
        };
        let (points, disc) = (&self.points, self.disc.as_ref());
        let (values, gradients, out) = match field {
            Field::Velocity => (
                &motion.v,
                motion.gradients.as_ref().map(|g| &g.v),
                &mut self.nodes.v,
            ),
            Field::Acceleration => (
                &motion.a,
                motion.gradients.as_ref().map(|g| &g.a),
                &mut self.nodes.a,
            ),
            Field::Displacement => match &motion.u {
                Some(u) => (u, None, &mut self.nodes.u),
                None => return,
            },
        };
        out.fill([0.0; D]);
        let (mut scaled, mut scaled_gradients) = ([[0.0; D]; BLOCK], [zero::<D>(); BLOCK]);
        for block in blocks(0..values.len()) {
            let n = block.len();
            let mass = &points.mass[block.clone()];
            let inertia = points.inertia.as_ref().map(|f| &f[block.clone()]);
            let v = match inertia {
                Some(f) => weigh(f, &values[block.clone()], &mut scaled[..n]),
                None => &values[block.clone()],
            };
            let Some(gradients) = gradients else {
                disc.scatter_vector(block, mass, v, out);
                continue;
            };
            let l = match inertia {
                Some(f) => weigh_rows(f, &gradients[block.clone()], &mut scaled_gradients[..n]),
                None => &gradients[block.clone()],
            };
            disc.scatter_affine(block.clone(), mass, v, l, &points.place[block], out);
        }
        for (x, m) in out.iter_mut().zip(&self.nodes.lumped.mass) {
            for i in 0..D {
                if m[i] > 0.0 {
                    x[i] /= m[i];
                }
            }
        }
    }

    /// Nodes to points; `pic` takes the nodes' velocity itself.
    pub(super) fn transfer_to_points(&mut self) {
        let Some(motion) = &mut self.points.motion else {
            return;
        };
        let (nodes, disc) = (&self.nodes, &self.disc);
        let rule = if self.explicit {
            Rule::Leapfrog(self.dt)
        } else {
            Rule::Trapezoid(0.5 * self.dt)
        };
        let (mut vector, mut matrix) = ([[0.0; D]; BLOCK], [zero::<D>(); BLOCK]);
        for block in blocks(0..motion.v.len()) {
            let n = block.len();
            disc.gather(block.clone(), &nodes.a, &mut vector[..n]);
            let v = &mut motion.v[block.clone()];
            let a = rule.old(&mut motion.a, &block);
            let next = vector[..n].as_flattened();
            rule.advance(v.as_flattened_mut(), a.as_flattened_mut(), next);
            if self.transfer == Transfer::Pic {
                disc.gather(block.clone(), &nodes.v, v);
            }
            match &mut motion.u {
                // K25 (18), of all points: what the next step sends back to the nodes is filtered
                Some(u) if self.replaced_displacement => {
                    disc.gather(block.clone(), &nodes.u, &mut u[block.clone()]);
                }
                Some(u) => {
                    disc.gather(block.clone(), &nodes.increment, &mut vector[..n]);
                    for (u, d) in u[block.clone()].iter_mut().zip(&vector) {
                        *u = std::array::from_fn(|i| u[i] + d[i]);
                    }
                }
                None => {}
            }
            if let Some(l) = &mut motion.gradients {
                disc.gradient(block.clone(), &nodes.a, &mut matrix[..n]);
                let v = &mut l.v[block.clone()];
                let a = rule.old(&mut l.a, &block);
                rule.advance(
                    v.as_flattened_mut().as_flattened_mut(),
                    a.as_flattened_mut().as_flattened_mut(),
                    matrix[..n].as_flattened().as_flattened(),
                );
            }
        }
    }

    /// Moves points and what is attached to the material; finds the points' nodes anew.
    pub(super) fn move_points(&mut self) -> Result<(), SolverError> {
        let mut step = [[0.0; D]; BLOCK];
        for block in blocks(0..self.movable) {
            let step = &mut step[..block.len()];
            self.disc.gather(block.clone(), &self.nodes.increment, step);
            for (x, s) in self.points.place[block].iter_mut().zip(step) {
                for i in 0..D {
                    x[i] += s[i];
                }
            }
        }
        for term in &mut self.terms {
            term.advance(
                self.disc.as_ref(),
                &self.nodes.increment,
                &self.nodes.active,
            )
            .map_err(|x| super::model::left_grid(&x, self.moment))?;
        }
        let places = &self.points.place[..self.movable];
        self.disc
            .replace(places)
            .map_err(|p| super::model::left_grid(&places[p], self.moment))?;
        self.matrices.invalidate();
        Ok(())
    }
}

/// Nodes that keep their motion though others get it from points.
#[derive(Clone, Debug, Default)]
pub struct KeptNodes<const D: usize> {
    /// The nodes.
    pub nodes: Vec<u32>,
    /// Their velocity and acceleration while the others are filled.
    pub saved: Vec<(Vector<D>, Vector<D>)>,
}

impl<const D: usize> KeptNodes<D> {
    /// The nodes that points from `first` on touch.
    pub fn touched(
        disc: &dyn crate::basis::Discretisation<D>,
        points: &Points<D>,
        first: usize,
    ) -> Self {
        let mut weight = vec![0.0; disc.node_count()];
        for block in blocks(first..points.len()) {
            disc.scatter_scalar(block.clone(), &points.mass[block], &mut weight);
        }
        let nodes: Vec<u32> = (0..weight.len())
            .filter(|&n| weight[n] > 0.0)
            .map(|n| n as u32)
            .collect();
        let saved = vec![([0.0; D], [0.0; D]); nodes.len()];
        KeptNodes { nodes, saved }
    }
}

fn weigh<'a, const D: usize>(
    factors: &[Vector<D>],
    values: &[Vector<D>],
    out: &'a mut [Vector<D>],
) -> &'a [Vector<D>] {
    for ((o, f), v) in out.iter_mut().zip(factors).zip(values) {
        *o = std::array::from_fn(|i| f[i] * v[i]);
    }
    out
}

fn weigh_rows<'a, const D: usize>(
    factors: &[Vector<D>],
    values: &[Matrix<D>],
    out: &'a mut [Matrix<D>],
) -> &'a [Matrix<D>] {
    for ((o, f), v) in out.iter_mut().zip(factors).zip(values) {
        *o = std::array::from_fn(|i| v[i].map(|x| f[i] * x));
    }
    out
}

/// How a rate moves on through a step.
#[derive(Clone, Copy)]
enum Rule {
    /// `rate += dt/2 (a + a')`, then `a = a'`; with dt/2 (s).
    Trapezoid(f64),
    /// `rate += dt a'`; with dt (s).
    Leapfrog(f64),
}

impl Rule {
    /// What the block carries of the step before.
    fn old<'a, T>(&self, all: &'a mut [T], block: &std::ops::Range<usize>) -> &'a mut [T] {
        match self {
            Rule::Trapezoid(_) => &mut all[block.clone()],
            Rule::Leapfrog(_) => &mut [],
        }
    }

    fn advance(&self, rate: &mut [f64], a: &mut [f64], next: &[f64]) {
        match self {
            Rule::Trapezoid(half_step) => {
                for ((v, a), n) in rate.iter_mut().zip(a).zip(next) {
                    *v += half_step * (*a + n);
                    *a = *n;
                }
            }
            Rule::Leapfrog(step) => {
                for (v, n) in rate.iter_mut().zip(next) {
                    *v += step * n;
                }
            }
        }
    }
}
