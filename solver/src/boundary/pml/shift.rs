//! The frequency shift of the stretch: how sides ask for it, and what it adds to the layer's inertia, two
//! memories of the displacement.
//!
//! ```text
//! rho s_1 s_2 W^2 u = M W^2 u + (S_1/Z + S_2/Z^2) W^2 u,     Z = W + alpha
//! S_1 = rho (b_1 + b_2),   S_2 = rho b_1 b_2
//! ```
//!
//! and by division, with W = Z - alpha,
//!
//! ```text
//! W^2/Z = W - alpha + alpha^2/Z,     W^2/Z^2 = 1 - 2 alpha/Z + alpha^2/Z^2
//! => C = S_1,   Kd = S_2 - alpha S_1,   and forces T_1 theta_1 + T_2 theta_2
//!    T_1 = alpha^2 S_1 - 2 alpha S_2,   T_2 = alpha^2 S_2
//!    dtheta_1/dt + alpha theta_1 = u,   dtheta_2/dt + alpha theta_2 = theta_1
//! theta' = A theta + Q (x + x'),  A = (1 - alpha dt/2)/(1 + alpha dt/2),  Q = (dt/2)/(1 + alpha dt/2)
//! ```
//!
//! The rule for theta is the trapezoidal one, which is the bilinear map that the motion has, so that C
//! v, Kd u and the two forces stay the parts of one product. At rest theta_1 = u/alpha and theta_2 =
//! u/alpha^2: Kd u and the forces cancel, and nothing holds the layer but its stiffness.

use super::{METHOD, aim};
use crate::basis::Discretisation;
use crate::boundary::params::SideMethod;
use crate::boundary::{Assigned, Context};
use crate::error::SolverError;
use crate::linear::block_matrix::BlockMatrix;
use crate::physics::kernel::Trial;
use crate::points::{BLOCK, Points, blocks};
use crate::problem::{Problem, Side};
use crate::tensor::Vector;
use std::ops::Range;

/// What the layer does under a load that stays on.
pub(super) const STATIC_LOADS: &[&str] = &["clamp", "follow"];

/// How a side asks for the frequency shift: by number (1/s), or by word.
fn asked_shift(method: &SideMethod) -> (Option<f64>, &str) {
    let given = method.given_number("alpha_per_s");
    (given, method.choice(&METHOD, "static_load"))
}

/// Does a side ask for a shift at all?
pub(super) fn asks_for_shift(method: &SideMethod) -> bool {
    match asked_shift(method) {
        (Some(alpha), _) => alpha > 0.0,
        (None, word) => word == "follow",
    }
}

/// Refuses a layer whose sides do not ask for the same shift.
pub(super) fn one_shift<const D: usize>(
    problem: &Problem<D>,
    side: Side,
    method: &SideMethod,
) -> Result<(), SolverError> {
    let own = asked_shift(method);
    let layers = problem.sides.iter().flatten();
    let mut others = layers.filter(|other| other.method == METHOD.name);
    let Some(other) = others.find(|other| asked_shift(other) != own) else {
        return Ok(());
    };
    let key = if asked_shift(other).0 == own.0 {
        "static_load"
    } else {
        "alpha_per_s"
    };
    Err(SolverError::Setup {
        field: format!("boundary.{}.{key}", side.name()),
        reason: format!(
            "a layer has one frequency shift on all its sides, and another side asks for another; `--set pml.{key}=...` reaches all"
        ),
    })
}

/// The frequency shift alpha (1/s): as given, 0, or what lets each side give way as the ground that
/// waves cross in the run does.
pub(super) fn shift_of<const D: usize>(context: &Context<'_, D>) -> f64 {
    let of_side = |a: &Assigned| match asked_shift(&a.method) {
        (Some(alpha), _) => alpha,
        (None, "follow") => (1.0 / aim(context, a)).ln() / (2.0 * context.end_time),
        (None, _) => 0.0,
    };
    // the most yielding of thin and thick sides
    context
        .sides
        .iter()
        .map(of_side)
        .fold(f64::INFINITY, f64::min)
}

/// The points of a layer with their damping.
#[derive(Clone, Copy)]
pub(super) struct Layer<'a, const D: usize> {
    /// Which points.
    pub range: &'a Range<usize>,
    /// beta_j of each (1/s).
    pub beta: &'a [Vector<D>],
}

/// The memories of the nodes, and what they weigh.
pub(super) struct ShiftedInertia<const D: usize> {
    /// alpha (1/s).
    rate: f64,
    /// Does inertia couple nodes? The forces then do too, or they would not cancel Kd.
    consistent: bool,
    /// T_1 (kg/s^3), T_2 (kg/s^4) of the nodes where inertia is lumped; empty until they are asked for.
    lumped: [Vec<Vector<D>>; 2],
    /// theta_1 (m s), theta_2 (m s^2).
    theta: [Vec<Vector<D>>; 2],
    /// The same at the end of the trial step.
    next: [Vec<Vector<D>>; 2],
}

impl<const D: usize> ShiftedInertia<D> {
    /// A layer at rest with the shift `rate` (1/s) on a grid of so many nodes.
    pub fn new(rate: f64, consistent: bool, nodes: usize) -> Self {
        let fields = || std::array::from_fn(|_| vec![[0.0; D]; nodes]);
        ShiftedInertia {
            rate,
            consistent,
            lumped: Default::default(),
            theta: fields(),
            next: fields(),
        }
    }

    /// T_1 and T_2 of a point over its mass.
    fn weights(&self, beta: &Vector<D>) -> [f64; 2] {
        let (first, second): (f64, f64) = (beta.iter().sum(), beta.iter().product());
        let square = self.rate * self.rate;
        [square * first - 2.0 * self.rate * second, square * second]
    }

    /// A and Q (s).
    fn rule(&self, dt: f64) -> (f64, f64) {
        let half = 0.5 * dt;
        let below = 1.0 + self.rate * half;
        ((1.0 - self.rate * half) / below, half / below)
    }

    /// Lumps T_1 and T_2 once; the points of a layer rest.
    fn lump(&mut self, disc: &dyn Discretisation<D>, points: &Points<D>, layer: Layer<'_, D>) {
        if !self.lumped[0].is_empty() {
            return;
        }
        let mut lumped: [Vec<Vector<D>>; 2] =
            std::array::from_fn(|_| vec![[0.0; D]; disc.node_count()]);
        let mut values = [[0.0; D]; BLOCK];
        for block in blocks(layer.range.clone()) {
            for (k, out) in lumped.iter_mut().enumerate() {
                let values = &mut values[..block.len()];
                for (value, beta) in values.iter_mut().zip(layer.of(&block)) {
                    *value = [self.weights(beta)[k]; D];
                }
                disc.scatter_vector(block.clone(), &points.mass[block.clone()], values, out);
            }
        }
        self.lumped = lumped;
    }

    /// theta_1 and theta_2.
    pub fn memory(&mut self) -> impl Iterator<Item = &mut [f64]> {
        self.theta.iter_mut().map(|theta| theta.as_flattened_mut())
    }

    /// Sets the memories of the end of the trial step.
    fn advance(&mut self, trial: &Trial<'_, D>) {
        let (keep, gain) = self.rule(trial.dt);
        let [first, second] = &self.theta;
        let [next_first, next_second] = &mut self.next;
        for n in 0..first.len() {
            for i in 0..D {
                let (u, d) = (trial.start[n][i], trial.increment[n][i]);
                let theta = keep * first[n][i] + gain * (u + (u + d));
                next_second[n][i] = keep * second[n][i] + gain * (first[n][i] + theta);
                next_first[n][i] = theta;
            }
        }
    }

    /// Adds `T_1 theta_1' + T_2 theta_2'`.
    pub fn force(&mut self, trial: &Trial<'_, D>, layer: Layer<'_, D>, out: &mut [Vector<D>]) {
        self.advance(trial);
        if !self.consistent {
            self.lump(trial.disc, trial.points, layer);
            add_products(&self.lumped, &self.next, out);
            return;
        }
        let (mut sum, mut part) = ([[0.0; D]; BLOCK], [[0.0; D]; BLOCK]);
        for block in blocks(layer.range.clone()) {
            let (sum, part) = (&mut sum[..block.len()], &mut part[..block.len()]);
            sum.fill([0.0; D]);
            for (k, theta) in self.next.iter().enumerate() {
                trial.disc.gather(block.clone(), theta, part);
                for ((s, x), beta) in sum.iter_mut().zip(&*part).zip(layer.of(&block)) {
                    let weight = self.weights(beta)[k];
                    *s = std::array::from_fn(|i| s[i] + weight * x[i]);
                }
            }
            let mass = &trial.points.mass[block.clone()];
            trial.disc.scatter_vector(block, mass, sum, out);
        }
    }

    /// Adds `T_1 theta_1 + T_2 theta_2` of the present, which explicit steps ask for.
    pub fn present_force(
        &mut self,
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        layer: Layer<'_, D>,
        out: &mut [Vector<D>],
    ) {
        self.lump(disc, points, layer);
        add_products(&self.lumped, &self.theta, out);
    }

    /// Adds the force's derivative, `T_1 Q + T_2 Q^2`.
    pub fn tangent(&mut self, trial: &Trial<'_, D>, layer: Layer<'_, D>, out: &mut BlockMatrix<D>) {
        let (_, gain) = self.rule(trial.dt);
        let factors = [gain, gain * gain];
        if !self.consistent {
            self.lump(trial.disc, trial.points, layer);
            for (weight, factor) in self.lumped.iter().zip(factors) {
                out.add_diagonal(factor, weight);
            }
            return;
        }
        let mut weights = [[0.0; D]; BLOCK];
        for block in blocks(layer.range.clone()) {
            let weights = &mut weights[..block.len()];
            let mass = &trial.points.mass[block.clone()];
            for ((w, beta), m) in weights.iter_mut().zip(layer.of(&block)).zip(mass) {
                let [first, second] = self.weights(beta);
                *w = [m * (factors[0] * first + factors[1] * second); D];
            }
            trial.disc.scatter_mass(block, weights, out);
        }
    }

    /// Accepts the trial step.
    pub fn commit(&mut self, trial: &Trial<'_, D>) {
        self.advance(trial);
        std::mem::swap(&mut self.theta, &mut self.next);
    }
}

/// Adds the products of the nodes' weights and memories.
fn add_products<const D: usize>(
    weights: &[Vec<Vector<D>>; 2],
    memories: &[Vec<Vector<D>>; 2],
    out: &mut [Vector<D>],
) {
    for (weight, theta) in weights.iter().zip(memories) {
        for ((f, w), x) in out.iter_mut().zip(weight).zip(theta) {
            for i in 0..D {
                f[i] += w[i] * x[i];
            }
        }
    }
}

impl<const D: usize> Layer<'_, D> {
    /// Those of a block.
    fn of(&self, block: &Range<usize>) -> &[Vector<D>] {
        let first = self.range.start;
        &self.beta[block.start - first..block.end - first]
    }
}
