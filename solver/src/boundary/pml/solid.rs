//! The layer in three dimensions: the stretched equations times s_1 s_2 s_3, with one integration more
//! than in the plane. Below, m and n are the axes other than l, or m the one other than j and l; e_1, e_2,
//! e_3 are the sums of the beta, of their products in pairs, and the product of all three.
//!
//! ```text
//! rho s_1 s_2 s_3 W^2 u = rho (W^2 + e_1 W + e_2 + e_3/W) u
//! s_m s_n/s_l = 1 + r_l/(W + b_l) + q_l/(W (W + b_l)),   r_l = b_m + b_n - b_l,   q_l = b_m b_n
//! s_m = 1 + b_m/W
//! dphi_kl/dt + b_l phi_kl = g_kl,   dpsi_kl/dt = phi_kl    =>   g_kl/W = phi_kl + b_l psi_kl
//! P_ij = sum_k C_ijkj (g + r_j phi + q_j psi)_kj
//!        + sum_{l /= j} sum_k C_ijkl (g + b_m (phi + b_l psi))_kl
//! ```
//!
//! Partial fractions of s_m s_n/s_l would have 1/b_l; this cascade stays regular where b_l = 0. All
//! memories follow the trapezoidal rule, phi as in the plane, psi' = psi + dt/2 (phi + phi'), and U' = U +
//! dt/2 (u + u') for U = u/W.
//!
//! An explicit step sees e_3/W as it sees everything: times (z + 1)^2/(4 z), which makes of it
//!
//! ```text
//! rho e_3 (U_n+1 + 2 U_n + U_n-1)/4 = rho e_3 [U_n + dt^2/4 (v_n-1/2 + v_n+1/2)/2]
//! ```
//!
//! so that the force e_3 U_n and a damping of e_3 dt^2/4 beside e_1 complete the masses of the two ends of a
//! step, rho prod_j (1 +- b_j dt/2). A Newmark step has the force e_3 U'.
//!
//! psi matters where two sides' layers overlap, U where three do; other points and nodes do not have them.

use super::{Coefficients, next_gradient, opposite_less_own};
use crate::basis::Discretisation;
use crate::error::SolverError;
use crate::linear::block_matrix::BlockMatrix;
use crate::material::MaterialBlock;
use crate::material::linear_elastic::LinearElastic;
use crate::physics::inertia::PointInertia;
use crate::physics::kernel::{ExplicitKernel, RegionKernel, Stiffness, Trial};
use crate::physics::stiffness::scatter_moduli;
use crate::points::{BLOCK, Points, blocks};
use crate::tensor::{Matrix, Tensor4, Vector, contract, zero};
use std::ops::Range;

/// The layer's points, in three dimensions.
pub(super) struct Solid<const D: usize> {
    range: Range<usize>,
    material: LinearElastic,
    moduli: Tensor4<D>,
    /// Damping beta_j of each point (1/s).
    beta: Vec<Vector<D>>,
    /// Length (s) of an explicit step; `None` for implicit ones.
    explicit_dt: Option<f64>,
    /// g, the displacement gradient of each point.
    gradient: Vec<Matrix<D>>,
    /// phi, its low-passed integral (s).
    memory: Vec<Matrix<D>>,
    /// psi, the integral of phi (s2), of the points in edges and corners, in the points' order.
    integral: Vec<Matrix<D>>,
    /// Nodes of corners; `None` until their weights are asked for.
    corners: Option<Corners<D>>,
}

/// The nodes that three layers reach.
struct Corners<const D: usize> {
    nodes: Vec<usize>,
    /// e_3 times the mass of each (kg/s3).
    weight: Vec<Vector<D>>,
    /// U, the integral of the displacement of each (m s).
    integral: Vec<Vector<D>>,
}

impl<const D: usize> Corners<D> {
    /// `U' - U` of a node: dt/2 (u + u').
    fn step(trial: &Trial<'_, D>, node: usize) -> Vector<D> {
        let (u, d) = (&trial.start[node], &trial.increment[node]);
        std::array::from_fn(|i| 0.5 * trial.dt * (2.0 * u[i] + d[i]))
    }

    /// Sets U'.
    fn advance(&mut self, trial: &Trial<'_, D>) {
        for (node, integral) in self.nodes.iter().zip(&mut self.integral) {
            let step = Self::step(trial, *node);
            *integral = std::array::from_fn(|i| integral[i] + step[i]);
        }
    }

    /// Adds `e_3 U`, or `e_3 U'` of a trial.
    fn force(&self, trial: Option<&Trial<'_, D>>, out: &mut [Vector<D>]) {
        for ((node, weight), integral) in self.nodes.iter().zip(&self.weight).zip(&self.integral) {
            let step = trial.map_or([0.0; D], |trial| Self::step(trial, *node));
            for i in 0..D {
                out[*node][i] += weight[i] * (integral[i] + step[i]);
            }
        }
    }
}

/// In an edge or a corner, where psi matters?
fn is_shared<const D: usize>(beta: &Vector<D>) -> bool {
    beta.iter().filter(|b| **b > 0.0).count() > 1
}

/// q_l of each axis (1/s2).
#[inline]
fn product_of_others<const D: usize>(beta: &Vector<D>) -> Vector<D> {
    std::array::from_fn(|l| (0..D).filter(|a| *a != l).map(|a| beta[a]).product())
}

/// e_2 (1/s2): the products in pairs.
fn pairs<const D: usize>(beta: &Vector<D>) -> f64 {
    (0..D)
        .flat_map(|a| (0..a).map(move |b| beta[a] * beta[b]))
        .sum()
}

/// P_ij of a point; see the head of this file.
#[inline]
fn stretched_stress<const D: usize>(
    moduli: &Tensor4<D>,
    beta: &Vector<D>,
    g: &Matrix<D>,
    [phi, psi]: [&Matrix<D>; 2],
) -> Matrix<D> {
    let (r, q) = (opposite_less_own(beta), product_of_others(beta));
    let total: f64 = beta.iter().sum();
    let mut stress = zero::<D>();
    for j in 0..D {
        let mut stretched = *g;
        for (k, row) in stretched.iter_mut().enumerate() {
            for (l, x) in row.iter_mut().enumerate() {
                *x += if l == j {
                    r[j] * phi[k][j] + q[j] * psi[k][j]
                } else {
                    let third = total - beta[j] - beta[l];
                    third * (phi[k][l] + beta[l] * psi[k][l])
                };
            }
        }
        for i in 0..D {
            stress[i][j] = contract(&moduli[i][j], &stretched);
        }
    }
    stress
}

/// `psi + dt/2 (phi + phi')`.
#[inline]
fn integrated<const D: usize>(
    psi: &Matrix<D>,
    phi: &Matrix<D>,
    next: &Matrix<D>,
    dt: f64,
) -> Matrix<D> {
    std::array::from_fn(|k| {
        std::array::from_fn(|l| psi[k][l] + 0.5 * dt * (phi[k][l] + next[k][l]))
    })
}

impl<const D: usize> Solid<D> {
    /// The points of `range`, at rest, with their damping `beta` (1/s).
    pub(super) fn new(
        range: Range<usize>,
        material: LinearElastic,
        beta: Vec<Vector<D>>,
        explicit_dt: Option<f64>,
    ) -> Self {
        let n = beta.len();
        let shared = beta.iter().filter(|b| is_shared(b)).count();
        Solid {
            range,
            moduli: material.small_moduli(),
            material,
            explicit_dt,
            gradient: vec![zero(); n],
            memory: vec![zero(); n],
            integral: vec![zero(); shared],
            corners: None,
            beta,
        }
    }

    /// The nodes of corners, their weights lumped once: the points of a layer rest.
    fn corners(&mut self, disc: &dyn Discretisation<D>, points: &Points<D>) -> &mut Corners<D> {
        let (range, beta) = (&self.range, &self.beta);
        self.corners.get_or_insert_with(|| {
            let mut weights = vec![[0.0; D]; disc.node_count()];
            let mut values = [[0.0; D]; BLOCK];
            for block in blocks(range.clone()) {
                let own = &beta[block.start - range.start..block.end - range.start];
                for (value, beta) in values.iter_mut().zip(own) {
                    *value = [beta.iter().product(); D];
                }
                let mass = &points.mass[block.clone()];
                disc.scatter_vector(block.clone(), mass, &values[..block.len()], &mut weights);
            }
            let weighty = weights.into_iter().enumerate();
            let weighty = weighty.filter(|(_, weight)| *weight != [0.0; D]);
            let (nodes, weight): (Vec<_>, Vec<_>) = weighty.unzip();
            Corners {
                integral: vec![[0.0; D]; nodes.len()],
                nodes,
                weight,
            }
        })
    }
}

impl<const D: usize> ExplicitKernel<D> for Solid<D> {
    fn present_force(
        &mut self,
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        out: &mut [Vector<D>],
    ) {
        let (mut stress, none) = ([zero::<D>(); BLOCK], zero::<D>());
        let mut integrals = self.integral.iter();
        for block in blocks(self.range.clone()) {
            let n = block.len();
            for (b, stress) in stress[..n].iter_mut().enumerate() {
                let q = block.start - self.range.start + b;
                let (beta, g, phi) = (&self.beta[q], &self.gradient[q], &self.memory[q]);
                let shared = is_shared(beta).then(|| integrals.next());
                let psi = shared.flatten().unwrap_or(&none);
                *stress = stretched_stress(&self.moduli, beta, g, [phi, psi]);
            }
            disc.scatter_stress(block.clone(), &points.volume[block], &stress[..n], out);
        }
        self.corners(disc, points).force(None, out);
    }

    fn advance(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError> {
        self.commit(trial)
    }
}

impl<const D: usize> RegionKernel<D> for Solid<D> {
    fn inertia(&self, block: Range<usize>, out: &mut PointInertia<D>) {
        let own = block.start - self.range.start..block.end - self.range.start;
        let quarter = self.explicit_dt.map_or(0.0, |dt| 0.25 * dt * dt);
        for beta in &self.beta[own] {
            let (first, third): (f64, f64) = (beta.iter().sum(), beta.iter().product());
            out.viscous.push([first + quarter * third; D]);
            out.stiffness.push([pairs(beta); D]);
        }
    }

    fn force(&mut self, trial: &Trial<'_, D>, out: &mut [Vector<D>]) -> Result<(), SolverError> {
        let (mut next, mut stress) = ([zero::<D>(); BLOCK], [zero::<D>(); BLOCK]);
        let mut integrals = self.integral.iter();
        for block in blocks(self.range.clone()) {
            let n = block.len();
            let first = block.start - self.range.start;
            next_gradient(trial, &block, &self.gradient[first..], &mut next[..n]);
            for (b, (g, stress)) in next[..n].iter().zip(&mut stress).enumerate() {
                let (beta, memory) = (&self.beta[first + b], &self.memory[first + b]);
                let c = Coefficients::new(beta, 0.0, trial.dt);
                let phi = c.advance(memory, &self.gradient[first + b], g);
                let shared = is_shared(beta).then(|| integrals.next()).flatten();
                let psi = shared.map_or(zero(), |psi| integrated(psi, memory, &phi, trial.dt));
                *stress = stretched_stress(&self.moduli, beta, g, [&phi, &psi]);
            }
            let volumes = &trial.points.volume[block.clone()];
            trial.disc.scatter_stress(block, volumes, &stress[..n], out);
        }
        let corners = self.corners(trial.disc, trial.points);
        corners.force(Some(trial), out);
        Ok(())
    }

    /// A_ijkl = C_ijkl s1 s2 s3/(s_j s_l) with s_a = 1 + b_a dt/2, and on corners' nodes e_3 dt/2: symmetric,
    /// constant while dt is.
    fn tangent(&mut self, trial: &Trial<'_, D>, out: &mut BlockMatrix<D>) {
        let moduli_of = |p: usize| {
            let s = self.beta[p - self.range.start].map(|b| 1.0 + 0.5 * trial.dt * b);
            let whole: f64 = s.iter().product();
            let mut a = self.moduli;
            for i in 0..D {
                for j in 0..D {
                    for k in 0..D {
                        for l in 0..D {
                            a[i][j][k][l] *= whole / (s[j] * s[l]);
                        }
                    }
                }
            }
            a
        };
        scatter_moduli(self.range.clone(), trial, moduli_of, out);
        let corners = self.corners(trial.disc, trial.points);
        for (node, weight) in corners.nodes.iter().zip(&corners.weight) {
            let mut own = zero::<D>();
            for i in 0..D {
                own[i][i] = 0.5 * trial.dt * weight[i];
            }
            out.add(*node, *node, &own);
        }
    }

    fn commit(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError> {
        let mut next = [zero::<D>(); BLOCK];
        let mut integrals = self.integral.iter_mut();
        for block in blocks(self.range.clone()) {
            let n = block.len();
            let first = block.start - self.range.start;
            next_gradient(trial, &block, &self.gradient[first..], &mut next[..n]);
            for (b, g) in next[..n].iter().enumerate() {
                let (q, beta) = (first + b, &self.beta[first + b]);
                let c = Coefficients::new(beta, 0.0, trial.dt);
                let phi = c.advance(&self.memory[q], &self.gradient[q], g);
                if let Some(psi) = is_shared(beta).then(|| integrals.next()).flatten() {
                    *psi = integrated(psi, &self.memory[q], &phi, trial.dt);
                }
                self.memory[q] = phi;
                self.gradient[q] = *g;
            }
        }
        self.corners(trial.disc, trial.points).advance(trial);
        Ok(())
    }

    fn memories(&mut self) -> Vec<&mut [f64]> {
        let mut all = vec![
            self.memory.as_flattened_mut().as_flattened_mut(),
            self.integral.as_flattened_mut().as_flattened_mut(),
        ];
        all.extend(
            self.corners
                .iter_mut()
                .map(|c| c.integral.as_flattened_mut()),
        );
        all
    }

    fn stiffness(&self) -> Stiffness {
        Stiffness::Constant
    }

    fn explicit(&mut self) -> Option<&mut dyn ExplicitKernel<D>> {
        Some(self)
    }

    /// Of the gradients alone; what the memories hold is not energy.
    fn strain_energy(
        &self,
        _disc: &dyn Discretisation<D>,
        points: &Points<D>,
        _u: &[Vector<D>],
    ) -> f64 {
        let volumes = &points.volume[self.range.clone()];
        self.material.energy_of(&self.gradient, volumes)
    }
}

#[cfg(test)]
mod tests;
