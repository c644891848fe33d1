//! The inertia of a layer under a frequency shift, in another form than the solver's: with a the
//! acceleration,
//!
//! ```text
//! rho s_1 s_2 W^2 u = M a + S_1 q_1 + S_2 q_2,     q_1 = a/(W + alpha),   q_2 = q_1/(W + alpha)
//! ```
//!
//! on nodes that keep their motion and start at rest. No damping and no springs: both follow from q.

use anechoic_solver::linear::block_matrix::BlockMatrix;
use anechoic_solver::physics::kernel::Trial;
use anechoic_solver::tensor::Vector;
use std::ops::Range;

/// What a node remembers, one an unknown.
#[derive(Clone, Copy, Debug, Default)]
struct Memory {
    v: f64,
    a: f64,
    q: [f64; 2],
    /// u and u/(W + alpha), for the break that forgets the latter.
    u: f64,
    theta: f64,
}

/// The nodes.
#[derive(Debug)]
pub(crate) struct ShiftedTwin {
    pub alpha: f64,
    /// S_1 (kg/s) and S_2 (kg/s^2) of each node.
    weights: Vec<[f64; 2]>,
    memory: Vec<[Memory; 2]>,
}

impl ShiftedTwin {
    pub fn new(alpha: f64) -> Self {
        ShiftedTwin {
            alpha,
            weights: Vec::new(),
            memory: Vec::new(),
        }
    }

    /// Lumps S_1 and S_2 of the points of `range` once.
    pub fn weigh(&mut self, trial: &Trial<'_, 2>, range: &Range<usize>, beta: &[[f64; 2]]) {
        if !self.weights.is_empty() {
            return;
        }
        let mut lumped = vec![[0.0; 2]; trial.disc.node_count()];
        for (p, [b1, b2]) in range.clone().zip(beta) {
            let mass = &trial.points.mass[p..p + 1];
            let values = [[b1 + b2, b1 * b2]];
            trial
                .disc
                .scatter_vector(p..p + 1, mass, &values, &mut lumped);
        }
        self.weights = lumped;
        self.memory = vec![[Memory::default(); 2]; self.weights.len()];
    }

    /// The state at the end of a step of `dt` (s) with the increment `d` (m): Newmark's velocity and
    /// acceleration, the trapezoidal rule for the rest.
    fn next(&self, old: &Memory, d: f64, dt: f64) -> Memory {
        let decay = 0.5 * self.alpha * dt;
        let filter = |x: f64, from: f64, to: f64| {
            (x * (1.0 - decay) + 0.5 * dt * (from + to)) / (1.0 + decay)
        };
        let a = 4.0 * (d / dt - old.v) / dt - old.a;
        let first = filter(old.q[0], old.a, a);
        Memory {
            v: 2.0 * d / dt - old.v,
            a,
            q: [first, filter(old.q[1], old.q[0], first)],
            u: old.u + d,
            theta: filter(old.theta, old.u, old.u + d),
        }
    }

    /// Adds `S_1 q_1 + S_2 q_2`; one that `forgets` lacks the part T_1 theta_1 of it.
    pub fn force(&self, trial: &Trial<'_, 2>, forgets: bool, out: &mut [Vector<2>]) {
        for (n, (old, [s1, s2])) in self.memory.iter().zip(&self.weights).enumerate() {
            for i in 0..2 {
                let new = self.next(&old[i], trial.increment[n][i], trial.dt);
                out[n][i] += s1 * new.q[0] + s2 * new.q[1];
                if forgets {
                    let t1 = self.alpha * (self.alpha * s1 - 2.0 * s2);
                    out[n][i] -= t1 * new.theta;
                }
            }
        }
    }

    /// Adds the derivative of the unbroken force.
    pub fn tangent(&self, dt: f64, out: &mut BlockMatrix<2>) {
        let gain = 0.5 * dt / (1.0 + 0.5 * self.alpha * dt);
        let rate = 4.0 / (dt * dt);
        let of = |[s1, s2]: &[f64; 2]| [rate * gain * (s1 + gain * s2); 2];
        let diagonal: Vec<Vector<2>> = self.weights.iter().map(of).collect();
        out.add_diagonal(1.0, &diagonal);
    }

    pub fn commit(&mut self, trial: &Trial<'_, 2>) {
        for n in 0..self.memory.len() {
            for i in 0..2 {
                self.memory[n][i] = self.next(&self.memory[n][i], trial.increment[n][i], trial.dt);
            }
        }
    }
}
