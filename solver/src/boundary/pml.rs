//! The true perfectly matched layer: complex stretch `s_j = 1 + beta_j / (alpha + W)`, symmetric and
//! unsplit (Basu & Chopra 2004; Kucukcoban & Kallivokas 2013), W discretised by the same bilinear map as
//! the motion, so that only the mesh reflects.
//!
//! ```text
//! M = rho,  C = rho (b_1 + b_2),  Kd = rho b_1 b_2 - alpha C      (and forces: shift.rs)
//! beta_j = b_0 (d/L)^2,     b_0 = 3 c_p ln(1/R) / (2 L)
//! s2/s1 = (Z + b_2)/(Z + b_1) = 1 + r_1/(W + p_1),   Z = W + alpha      (2 the other way round)
//! p_1 = alpha + b_1,   r_1 = b_2 - b_1
//! dphi_kl/dt + p_l phi_kl = g_kl,          g_kl = u_k,l
//! phi' = A_l phi + Q_l (g + g'),  A_l = (1 - p_l dt/2)/(1 + p_l dt/2),  Q_l = (dt/2)/(1 + p_l dt/2)
//! P_ij = sum_k C_ijkj (g_kj + r_j phi_kj) + sum_{l /= j} sum_k C_ijkl g_kl
//! ```
//!
//! Where the material starts with a velocity, all this is so in the frame that moves along: setup/frame.rs.
//! The points of the layer rest and its nodes keep their motion; the outer edge is fixed. This is the layer
//! of the plane; in three dimensions it remembers more: solid.rs.
//!
//! Without the shift alpha (Kuzuoglu & Mittra 1996) the stretch of a load that stays on grows for ever,
//! and the layer clamps it. With it the stretch ends at 1 + beta_j/alpha: the layer rests like elastic
//! material of the thickness L + c_p ln(1/R)/(2 alpha), which is c_p T and some for alpha = ln(1/R)/(2 T),
//! T the length of the run. One alpha holds in the whole layer, or corners would need a third memory.

mod shift;
mod solid;

use super::layer::{by_axis, relative_depth};
use super::params::{Ladder, MethodInfo, Param, ParamKind, Rungs, SideMethod, Upkeep};
use super::{Assigned, Context, End, LayerPoints, Layout, Parts, walls};
use crate::basis::Discretisation;
use crate::error::SolverError;
use crate::linear::block_matrix::BlockMatrix;
use crate::material::MaterialBlock;
use crate::material::linear_elastic::LinearElastic;
use crate::physics::inertia::PointInertia;
use crate::physics::kernel::{ExplicitKernel, RegionKernel, Stiffness, Trial};
use crate::physics::stiffness::scatter_moduli;
use crate::points::{BLOCK, Points, blocks};
use crate::problem::{MassKind, Problem, Scheme, Side, Transfer};
use crate::tensor::{Matrix, Tensor4, Vector, contract, zero};
use shift::{Layer, STATIC_LOADS, ShiftedInertia, asks_for_shift, one_shift, shift_of};
use solid::Solid;
use std::ops::Range;

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "pml",
    summary: "true perfectly matched layer: complex stretch with memory, outer edge fixed",
    params: &[
        Param {
            name: "thickness_m",
            doc: "thickness L; by default 10 cells",
            kind: ParamKind::Number {
                unit: "m",
                default: None,
                min: 1e-9,
                max: 1e9,
            },
        },
        Param {
            name: "reflection",
            doc: "reflection R aimed at head-on; by default 1e-3, 1e-4, 1e-6, 1e-8 at 5, 10, 20, 50 cells",
            kind: ParamKind::Number {
                unit: "1",
                default: None,
                min: 1e-300,
                max: 0.999,
            },
        },
        Param {
            name: "static_load",
            doc: "clamp: what stays on is held at the outer edge; follow: the layer gives way as so much ground as waves cross in the run, alpha = ln(1/R)/(2 T)",
            kind: ParamKind::Choice(STATIC_LOADS),
        },
        Param {
            name: "alpha_per_s",
            doc: "frequency shift alpha of the stretch; by default as static_load says (0 with clamp)",
            kind: ParamKind::Number {
                unit: "1/s",
                default: None,
                min: 0.0,
                max: 1e9,
            },
        },
        Param {
            name: "with_flip",
            doc: "run where flip makes the layer unstable, its points taking part in the transfer, to study it",
            kind: ParamKind::Choice(&["refuse", "force"]),
        },
    ],
    ladder: &[Ladder {
        param: "thickness_m",
        rungs: Rungs::Cells(&[2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 50.0]),
    }],
    extremes: &[
        Ladder {
            param: "thickness_m",
            rungs: Rungs::Cells(&[1.0, 100.0]),
        },
        Ladder {
            param: "reflection",
            rungs: Rungs::Numbers(&[0.5, 1e-6, 1e-12]),
        },
    ],
    passive: false,
    upkeep,
};

/// Cells of a layer whose thickness is not given.
pub const DEFAULT_CELLS: f64 = 10.0;

fn upkeep(_: &SideMethod, _: Transfer) -> Upkeep {
    Upkeep {
        holds: "damping, gradient, memory; springs and matrix of the nodes",
        point_vectors: 1,
        point_matrices: 2,
        overlap_matrices: 1,
        node_vectors: 4,
        // and once more the gradient, when the step is accepted
        forces: 2.0,
        passes: 0.0,
    }
}

pub(crate) fn layout<const D: usize>(
    problem: &Problem<D>,
    side: Side,
    method: &SideMethod,
) -> Result<Layout, SolverError> {
    let refuse = |reason: &str| {
        let field = format!("boundary.{}.method", side.name());
        Err(SolverError::Setup {
            field,
            reason: reason.to_owned(),
        })
    };
    if problem.scheme == Scheme::QuasiStatic {
        return refuse(
            "a perfectly matched layer absorbs waves; use fixed or roller with quasi-static",
        );
    }
    let flip = problem.transfer == Transfer::Flip;
    let forced = flip && method.choice(&METHOD, "with_flip") == "force";
    if flip && !forced {
        return refuse(
            "unstable with points.transfer = \"flip\", whose motion is filtered and the layer's damping is not; use \"affine\", or pml.with_flip = \"force\" to see it grow",
        );
    }
    if forced && problem.flow.velocity != [0.0; D] {
        return refuse(
            "a layer whose points take part in the transfer does not move with the material",
        );
    }
    one_shift(problem, side, method)?;
    if D == 3 && asks_for_shift(method) {
        return refuse(
            "in three dimensions the layer clamps what stays on; leave out static_load and alpha_per_s",
        );
    }
    if D == 3 && problem.mass == MassKind::Consistent {
        return refuse("in three dimensions the layer needs time.mass = \"lumped\"");
    }
    let outside = method
        .given_number("thickness_m")
        .unwrap_or(DEFAULT_CELLS * problem.cell_size);
    // forced, the layer takes part in the transfer, which is what makes it grow
    let layer = if forced {
        LayerPoints::Carried
    } else {
        LayerPoints::Kept
    };
    Ok(Layout {
        outside,
        inside: 0.0,
        end: End::Fixed,
        layer: Some(layer),
    })
}

/// Reflection aimed at head-on by a side's layer of so many cells.
pub fn reflection(method: &SideMethod, cells: f64) -> f64 {
    method
        .given_number("reflection")
        .unwrap_or(default_reflection(cells))
}

/// Reflection aimed at on a side.
fn aim<const D: usize>(context: &Context<'_, D>, a: &Assigned) -> f64 {
    reflection(&a.method, a.layout.outside / context.grid.h[a.side.axis])
}

/// Reflection aimed at for a layer of so many cells: thin layers want a large one.
fn default_reflection(cells: f64) -> f64 {
    const TABLE: [(f64, f64); 4] = [(5.0, -3.0), (10.0, -4.0), (20.0, -6.0), (50.0, -8.0)];
    let n = cells.clamp(TABLE[0].0, TABLE[3].0);
    let upper = TABLE.iter().position(|(c, _)| *c >= n).unwrap_or(3).max(1);
    let ((c0, r0), (c1, r1)) = (TABLE[upper - 1], TABLE[upper]);
    10.0_f64.powf(r0 + (r1 - r0) * (n / c0).ln() / (c1 / c0).ln())
}

pub(crate) fn build<const D: usize>(context: &Context<'_, D>) -> Result<Parts<D>, SolverError> {
    let speed = context.material.p_speed();
    let strength = |a: &Assigned| 1.5 * speed * (1.0 / aim(context, a)).ln() / a.layout.outside;
    let places = &context.points.place[context.layer.clone()];
    let beta = places.iter().map(|x| {
        let (depth, strength) = (relative_depth(context, x), by_axis(context, x, strength));
        std::array::from_fn(|a| strength[a] * depth[a] * depth[a])
    });
    let beta: Vec<Vector<D>> = beta.collect();
    if D == 3 {
        let material = LinearElastic::new(&context.material);
        let kernel = Solid::new(context.layer.clone(), material, beta, context.explicit_dt);
        return Ok(Parts {
            kernel: Some(Box::new(kernel)),
            ..Parts::of_terms(walls(context))
        });
    }
    let n = places.len();
    let alpha = shift_of(context);
    let consistent = context.mass == MassKind::Consistent;
    let shifted =
        (alpha > 0.0).then(|| ShiftedInertia::new(alpha, consistent, context.grid.node_count()));
    let kernel = Pml {
        range: context.layer.clone(),
        material: LinearElastic::new(&context.material),
        moduli: LinearElastic::new(&context.material).small_moduli(),
        beta,
        alpha,
        shifted,
        gradient: vec![zero(); n],
        memory: vec![zero(); n],
    };
    Ok(Parts {
        kernel: Some(Box::new(kernel)),
        ..Parts::of_terms(walls(context))
    })
}

/// The layer's points.
struct Pml<const D: usize> {
    range: Range<usize>,
    material: LinearElastic,
    moduli: Tensor4<D>,
    /// Damping beta_j of each point (1/s).
    beta: Vec<Vector<D>>,
    /// Frequency shift alpha (1/s).
    alpha: f64,
    /// What it adds to the inertia.
    shifted: Option<ShiftedInertia<D>>,
    /// g, the displacement gradient of each point.
    gradient: Vec<Matrix<D>>,
    /// phi, its low-passed integral (s).
    memory: Vec<Matrix<D>>,
}

/// Coefficients of a point for a step.
struct Coefficients<const D: usize> {
    /// r_l (1/s).
    r: Vector<D>,
    /// A_l.
    keep: Vector<D>,
    /// Q_l (s).
    gain: Vector<D>,
}

/// r_l of each axis (1/s): the other axes' damping less its own.
#[inline]
fn opposite_less_own<const D: usize>(beta: &Vector<D>) -> Vector<D> {
    let total: f64 = beta.iter().sum();
    beta.map(|b| total - 2.0 * b)
}

impl<const D: usize> Coefficients<D> {
    #[inline]
    fn new(beta: &Vector<D>, alpha: f64, dt: f64) -> Self {
        let half = 0.5 * dt;
        let p = beta.map(|b| alpha + b);
        Coefficients {
            r: opposite_less_own(beta),
            keep: p.map(|p| (1.0 - p * half) / (1.0 + p * half)),
            gain: p.map(|p| half / (1.0 + p * half)),
        }
    }

    /// phi' from phi, g and g'.
    #[inline]
    fn advance(&self, phi: &Matrix<D>, g: &Matrix<D>, next: &Matrix<D>) -> Matrix<D> {
        let mut out = zero::<D>();
        for k in 0..D {
            for l in 0..D {
                out[k][l] = self.keep[l] * phi[k][l] + self.gain[l] * (g[k][l] + next[k][l]);
            }
        }
        out
    }
}

/// g' of a block at the trial increment; `own` has the g of its points.
fn next_gradient<const D: usize>(
    trial: &Trial<'_, D>,
    block: &Range<usize>,
    own: &[Matrix<D>],
    out: &mut [Matrix<D>],
) {
    trial.disc.gradient(block.clone(), trial.increment, out);
    for (o, g) in out.iter_mut().zip(own) {
        for k in 0..D {
            for l in 0..D {
                o[k][l] += g[k][l];
            }
        }
    }
}

/// `P_ij = sum_k C_ijkj (g_kj + r_j phi_kj) + sum_{l /= j} sum_k C_ijkl g_kl`.
#[inline]
fn stretched_stress<const D: usize>(
    moduli: &Tensor4<D>,
    r: &Vector<D>,
    g: &Matrix<D>,
    phi: &Matrix<D>,
) -> Matrix<D> {
    let mut stress = zero::<D>();
    for i in 0..D {
        for j in 0..D {
            let mut sum = contract(&moduli[i][j], g);
            for k in 0..D {
                sum += moduli[i][j][k][j] * r[j] * phi[k][j];
            }
            stress[i][j] = sum;
        }
    }
    stress
}

/// Leapfrog with the memory of the present: the rule by which phi moves on is that of implicit steps,
/// and the step limit is that of the elastic material (`pml.md`'s rule: one bilinear map for all).
impl<const D: usize> ExplicitKernel<D> for Pml<D> {
    fn present_force(
        &mut self,
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        out: &mut [Vector<D>],
    ) {
        let mut stress = [zero::<D>(); BLOCK];
        for block in blocks(self.range.clone()) {
            let n = block.len();
            for (b, stress) in stress[..n].iter_mut().enumerate() {
                let q = block.start - self.range.start + b;
                let r = opposite_less_own(&self.beta[q]);
                *stress = stretched_stress(&self.moduli, &r, &self.gradient[q], &self.memory[q]);
            }
            disc.scatter_stress(block.clone(), &points.volume[block], &stress[..n], out);
        }
        if let Some(shifted) = &mut self.shifted {
            let (range, beta) = (&self.range, self.beta.as_slice());
            shifted.present_force(disc, points, Layer { range, beta }, out);
        }
    }

    fn advance(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError> {
        self.commit(trial)
    }
}

impl<const D: usize> RegionKernel<D> for Pml<D> {
    fn inertia(&self, block: Range<usize>, out: &mut PointInertia<D>) {
        let own = block.start - self.range.start..block.end - self.range.start;
        for beta in &self.beta[own] {
            let (first, second): (f64, f64) = (beta.iter().sum(), beta.iter().product());
            out.viscous.push([first; D]);
            out.stiffness.push([second - self.alpha * first; D]);
        }
    }

    fn force(&mut self, trial: &Trial<'_, D>, out: &mut [Vector<D>]) -> Result<(), SolverError> {
        let (mut next, mut stress) = ([zero::<D>(); BLOCK], [zero::<D>(); BLOCK]);
        for block in blocks(self.range.clone()) {
            let n = block.len();
            let own = &self.gradient[block.start - self.range.start..];
            next_gradient(trial, &block, own, &mut next[..n]);
            for (b, (g, stress)) in next[..n].iter().zip(&mut stress).enumerate() {
                let q = block.start - self.range.start + b;
                let c = Coefficients::new(&self.beta[q], self.alpha, trial.dt);
                let phi = c.advance(&self.memory[q], &self.gradient[q], g);
                *stress = stretched_stress(&self.moduli, &c.r, g, &phi);
            }
            let volumes = &trial.points.volume[block.clone()];
            trial.disc.scatter_stress(block, volumes, &stress[..n], out);
        }
        if let Some(shifted) = &mut self.shifted {
            let (range, beta) = (&self.range, self.beta.as_slice());
            shifted.force(trial, Layer { range, beta }, out);
        }
        Ok(())
    }

    /// A_ijkl = C_ijkl, and for l = j times 1 + r_j Q_j, and what a shift adds: symmetric, constant while
    /// dt is.
    fn tangent(&mut self, trial: &Trial<'_, D>, out: &mut BlockMatrix<D>) {
        let moduli_of = |p: usize| {
            let c = Coefficients::new(&self.beta[p - self.range.start], self.alpha, trial.dt);
            let mut a = self.moduli;
            for i in 0..D {
                for j in 0..D {
                    for k in 0..D {
                        a[i][j][k][j] *= 1.0 + c.r[j] * c.gain[j];
                    }
                }
            }
            a
        };
        scatter_moduli(self.range.clone(), trial, moduli_of, out);
        if let Some(shifted) = &mut self.shifted {
            let (range, beta) = (&self.range, self.beta.as_slice());
            shifted.tangent(trial, Layer { range, beta }, out);
        }
    }

    fn commit(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError> {
        let mut next = [zero::<D>(); BLOCK];
        for block in blocks(self.range.clone()) {
            let n = block.len();
            let own = &self.gradient[block.start - self.range.start..];
            next_gradient(trial, &block, own, &mut next[..n]);
            for (b, g) in next[..n].iter().enumerate() {
                let q = block.start - self.range.start + b;
                let c = Coefficients::new(&self.beta[q], self.alpha, trial.dt);
                self.memory[q] = c.advance(&self.memory[q], &self.gradient[q], g);
                self.gradient[q] = *g;
            }
        }
        if let Some(shifted) = &mut self.shifted {
            shifted.commit(trial);
        }
        Ok(())
    }

    fn memories(&mut self) -> Vec<&mut [f64]> {
        let mut all = vec![self.memory.as_flattened_mut().as_flattened_mut()];
        all.extend(self.shifted.iter_mut().flat_map(ShiftedInertia::memory));
        all
    }

    fn stiffness(&self) -> Stiffness {
        Stiffness::Constant
    }

    fn explicit(&mut self) -> Option<&mut dyn ExplicitKernel<D>> {
        Some(self)
    }

    /// Of the gradients alone; what the memory holds is not energy.
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
