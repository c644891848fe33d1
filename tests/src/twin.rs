//! A second implementation of the true perfectly matched layer, point by point from its equations,
//! with parts that can be broken on purpose.
//!
//! Unbroken it must agree with the solver's own to rounding; each break must make the echo gate fail.
//! Its matrices give the spectrum of the semi-discrete operator.

use crate::twin_shift::ShiftedTwin;
use anechoic_solver::basis::Discretisation;
use anechoic_solver::error::SolverError;
use anechoic_solver::linear::block_matrix::BlockMatrix;
use anechoic_solver::physics::inertia::PointInertia;
use anechoic_solver::physics::kernel::{RegionKernel, Stiffness, Trial};
use anechoic_solver::points::Points;
use anechoic_solver::problem::Elastic;
use anechoic_solver::tensor::{Matrix, Tensor4, Vector};
use std::ops::Range;

/// What is wrong with the layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Broken {
    /// Nothing.
    Nothing,
    /// The memory's weight has the wrong sign.
    SignOfMemory,
    /// The memory is that of the step before.
    LaggedMemory,
    /// Corners forget the term rho b1 b2 u.
    NoCornerTerm,
    /// The profile starts one cell too far inside: a jump at the inner edge.
    ShiftedProfile,
    /// The inertia's first memory, T_1 theta_1, is forgotten.
    NoFirstMemory,
    /// The springs' part alpha S_1 has the wrong sign.
    SignOfShiftedSprings,
    /// The memory of gradients decays as if there were no frequency shift.
    UnshiftedMemory,
}

/// The layer's points.
#[derive(Debug)]
pub struct Twin {
    /// Its points.
    pub range: Range<usize>,
    /// Damping of each point in x and y (1/s).
    pub beta: Vec<[f64; 2]>,
    lambda: f64,
    shear: f64,
    broken: Broken,
    /// The inertia under a frequency shift.
    shifted: Option<ShiftedTwin>,
    /// u_k,l of each point.
    g: Vec<Matrix<2>>,
    /// The memory of each point.
    phi: Vec<Matrix<2>>,
}

impl Twin {
    /// A layer of `depth` metres around the left, right and bottom of the box from `x[0]` to `x[1]`
    /// and from `bottom` up, aiming at the reflection `r`.
    pub fn new(
        points: &Points<2>,
        range: Range<usize>,
        material: &Elastic,
        [x, [bottom, _]]: [[f64; 2]; 2],
        (depth, r, cell): (f64, f64, f64),
        broken: Broken,
    ) -> Self {
        let largest = 3.0 * material.p_speed() * (1.0 / r).ln() / (2.0 * depth);
        let shift = if broken == Broken::ShiftedProfile {
            cell
        } else {
            0.0
        };
        let profile = |inwards: f64| {
            if inwards > 0.0 {
                largest * ((inwards + shift) / depth).powi(2)
            } else {
                0.0
            }
        };
        let beta = points.place[range.clone()]
            .iter()
            .map(|p| {
                [
                    profile(x[0] - p[0]) + profile(p[0] - x[1]),
                    profile(bottom - p[1]),
                ]
            })
            .collect();
        let n = range.len();
        let zero = [[0.0; 2]; 2];
        Twin {
            range,
            beta,
            lambda: material.lambda(),
            shear: material.shear_modulus(),
            broken,
            shifted: None,
            g: vec![zero; n],
            phi: vec![zero; n],
        }
    }

    /// The same under the frequency shift `alpha` (1/s), with lumped inertia.
    pub fn shifted(mut self, alpha: f64) -> Self {
        self.shifted = Some(ShiftedTwin::new(alpha));
        self
    }

    /// Frequency shift (1/s).
    fn alpha(&self) -> f64 {
        self.shifted.as_ref().map_or(0.0, |shifted| shifted.alpha)
    }

    /// Stress-like tensor of a point from gradient and memory.
    pub fn stress(&self, q: usize, g: &Matrix<2>, phi: &Matrix<2>) -> Matrix<2> {
        let [b1, b2] = self.beta[q];
        let sign = if self.broken == Broken::SignOfMemory {
            -1.0
        } else {
            1.0
        };
        let (r1, r2) = (sign * (b2 - b1), sign * (b1 - b2));
        let (l, s) = (self.lambda, self.shear);
        let p = l + 2.0 * s;
        [
            [
                p * (g[0][0] + r1 * phi[0][0]) + l * g[1][1],
                s * (g[0][1] + r2 * phi[0][1]) + s * g[1][0],
            ],
            [
                s * (g[1][0] + r1 * phi[1][0]) + s * g[0][1],
                p * (g[1][1] + r2 * phi[1][1]) + l * g[0][0],
            ],
        ]
    }

    /// What the shift adds to the decay of gradients' memory (1/s).
    fn memory_shift(&self) -> f64 {
        match self.broken {
            Broken::UnshiftedMemory => 0.0,
            _ => self.alpha(),
        }
    }

    /// Trapezoidal rule for dphi/dt + p phi = g.
    fn memory(&self, q: usize, next: &Matrix<2>, dt: f64) -> Matrix<2> {
        let mut out = self.phi[q];
        for k in 0..2 {
            for l in 0..2 {
                let p = self.beta[q][l] + self.memory_shift();
                let rate = 0.5 * (self.g[q][k][l] + next[k][l]) - 0.5 * p * self.phi[q][k][l];
                out[k][l] = (self.phi[q][k][l] + dt * rate) / (1.0 + 0.5 * p * dt);
            }
        }
        out
    }

    fn gradient(&self, trial: &Trial<'_, 2>, q: usize) -> Matrix<2> {
        let p = self.range.start + q;
        let mut out = [[[0.0; 2]; 2]];
        trial.disc.gradient(p..p + 1, trial.increment, &mut out);
        let [mut g] = out;
        for k in 0..2 {
            for l in 0..2 {
                g[k][l] += self.g[q][k][l];
            }
        }
        g
    }
}

impl RegionKernel<2> for Twin {
    fn inertia(&self, block: Range<usize>, out: &mut PointInertia<2>) {
        let own = block.start - self.range.start..block.end - self.range.start;
        if self.shifted.is_some() {
            // all of it is in the forces
            let wrong = match self.broken {
                Broken::SignOfShiftedSprings => 2.0 * self.alpha(),
                _ => 0.0,
            };
            out.stiffness
                .extend(self.beta[own].iter().map(|[b1, b2]| [wrong * (b1 + b2); 2]));
            return;
        }
        for [b1, b2] in &self.beta[own] {
            let corner = if self.broken == Broken::NoCornerTerm {
                0.0
            } else {
                b1 * b2
            };
            out.viscous.push([b1 + b2; 2]);
            out.stiffness.push([corner; 2]);
        }
    }

    fn force(&mut self, trial: &Trial<'_, 2>, out: &mut [Vector<2>]) -> Result<(), SolverError> {
        for (q, p) in self.range.clone().enumerate() {
            let g = self.gradient(trial, q);
            let phi = match self.broken {
                Broken::LaggedMemory => self.phi[q],
                _ => self.memory(q, &g, trial.dt),
            };
            let stress = self.stress(q, &g, &phi);
            trial
                .disc
                .scatter_stress(p..p + 1, &trial.points.volume[p..p + 1], &[stress], out);
        }
        if let Some(mut shifted) = self.shifted.take() {
            let forgets = self.broken == Broken::NoFirstMemory;
            shifted.weigh(trial, &self.range, &self.beta);
            shifted.force(trial, forgets, out);
            self.shifted = Some(shifted);
        }
        Ok(())
    }

    fn tangent(&mut self, trial: &Trial<'_, 2>, out: &mut BlockMatrix<2>) {
        for (q, p) in self.range.clone().enumerate() {
            // by differentiation: the stress is linear in the gradient
            let mut moduli: Tensor4<2> = Default::default();
            for k in 0..2 {
                for l in 0..2 {
                    let mut unit = [[0.0; 2]; 2];
                    unit[k][l] = 1.0;
                    let mut phi = [[0.0; 2]; 2];
                    if self.broken != Broken::LaggedMemory {
                        phi[k][l] = 0.5 * trial.dt
                            / (1.0 + 0.5 * (self.beta[q][l] + self.memory_shift()) * trial.dt);
                    }
                    let stress = self.stress(q, &unit, &phi);
                    for i in 0..2 {
                        for j in 0..2 {
                            moduli[i][j][k][l] = stress[i][j];
                        }
                    }
                }
            }
            trial
                .disc
                .scatter_tangent(p..p + 1, &trial.points.volume[p..p + 1], &[moduli], out);
        }
        if let Some(shifted) = &mut self.shifted {
            shifted.weigh(trial, &self.range, &self.beta);
            shifted.tangent(trial.dt, out);
        }
    }

    fn commit(&mut self, trial: &Trial<'_, 2>) -> Result<(), SolverError> {
        for q in 0..self.range.len() {
            let g = self.gradient(trial, q);
            self.phi[q] = self.memory(q, &g, trial.dt);
            self.g[q] = g;
        }
        if let Some(shifted) = &mut self.shifted {
            shifted.commit(trial);
        }
        Ok(())
    }

    fn stiffness(&self) -> Stiffness {
        Stiffness::Constant
    }

    fn is_symmetric(&self) -> bool {
        true
    }

    fn strain_energy(&self, _: &dyn Discretisation<2>, points: &Points<2>, _: &[Vector<2>]) -> f64 {
        let zero = [[0.0; 2]; 2];
        let energy = |(q, p): (usize, usize)| {
            let stress = self.stress(q, &self.g[q], &zero);
            0.5 * points.volume[p] * anechoic_solver::tensor::contract(&stress, &self.g[q])
        };
        self.range.clone().enumerate().map(energy).sum()
    }
}
