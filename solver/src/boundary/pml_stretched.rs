//! The published layer of absorbing particles (K25 2.1-2.6, after Chen et al.), part by part.
//!
//! ```text
//! C'_j = alpha (d_j/L)^beta                                                               (9)
//! m_j  = (1 + C'_j)^2 m                                                                   (16)
//! P_jj = (lambda + 2G) u_j,j + (1 + C'_j) sum_{m /= j} lambda u_m,m                       (11)
//! P_jm = (1 + C'_j) G u_m,j + (1 + C'_j)^2 G u_j,m
//! f_c  = alpha_M m_j v_j                                                                  (36)
//! factor of the stiffness with E_0:  1 + c (E_inf - E_0)/E_0                              (28), (40)
//! memory: c E_inf/E_0 sum_q A_(q+1) ubar^(n+1-q),  q = 1..4                               (28)
//! ubar = (1 - c) (E_inf - E_0)/E_inf u - c sum_q A_(q+1) ubar^(n+1-q)                     (33)
//! c = tau^a/(tau^a + dt^a),  A_(q+1) = (q - a - 1)/q A_q                                  (29), (30)
//! ```
//!
//! Misprints mended: (22) and (25) exchange lambda and G of (11); (37) and (43) print the factor of
//! (40) wrongly. With C' = C/(i omega) the stretch is real: it slows the wave and absorbs nothing;
//! what absorbs is the Rayleigh term and the displacement sent to nodes and back in every step, (17a)
//! and (18). The operator is not symmetric and grows without damping. Each part has a parameter that
//! takes it away. The memory is kept on nodes, where the paper sends it to points and back.

use super::layer::{by_axis, relative_depth};
use super::params::{Ladder, MethodInfo, Param, ParamKind, Rungs, SideMethod, Upkeep};
use super::{Context, DisplacementTransfer, End, LayerPoints, Layout, Parts, walls};
use crate::basis::Discretisation;
use crate::error::SolverError;
use crate::linear::block_matrix::BlockMatrix;
use crate::material::MaterialBlock;
use crate::material::linear_elastic::LinearElastic;
use crate::physics::inertia::PointInertia;
use crate::physics::kernel::{RegionKernel, Stiffness, Trial};
use crate::physics::stiffness::scatter_moduli;
use crate::points::{BLOCK, Points, blocks};
use crate::problem::{Elastic, Problem, Scheme, Side, Transfer};
use crate::tensor::{Tensor4, Vector, contract, zero};
use std::ops::Range;

const fn number(
    name: &'static str,
    doc: &'static str,
    unit: &'static str,
    default: f64,
    max: f64,
) -> Param {
    Param {
        name,
        doc,
        kind: ParamKind::Number {
            unit,
            default: Some(default),
            min: 0.0,
            max,
        },
    }
}

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "pml-stretched",
    summary: "the published layer of absorbing particles: real stretch, Rayleigh damping, memory",
    params: &[
        Param {
            name: "thickness_m",
            doc: "thickness L; by default 50 cells",
            kind: ParamKind::Number {
                unit: "m",
                default: None,
                min: 1e-9,
                max: 1e9,
            },
        },
        number(
            "alpha",
            "largest stretch C' at the outer edge; 0: no stretch",
            "1",
            4.0,
            1e6,
        ),
        number("beta", "power of the stretch's profile", "1", 1.0, 10.0),
        number(
            "rayleigh_per_s",
            "mass-proportional damping alpha_M; 0: none",
            "1/s",
            1.0,
            1e6,
        ),
        number(
            "relaxed_modulus_ratio",
            "E_0/E of the viscoelastic model; 1: elastic",
            "1",
            0.99,
            1.0,
        ),
        number(
            "fractional_order",
            "order of the fractional derivative",
            "1",
            0.95,
            1.0,
        ),
        number(
            "relaxation_steps",
            "relaxation time tau over the time step",
            "1",
            2.0,
            1e6,
        ),
        Param {
            name: "displacement",
            doc: "how points that carry the motion get their displacement: from the nodes anew in every step, as published, or by increments",
            kind: ParamKind::Choice(&["replaced", "incremental"]),
        },
    ],
    ladder: &[Ladder {
        param: "thickness_m",
        rungs: Rungs::Cells(&[10.0, 20.0, 30.0, 50.0, 100.0]),
    }],
    extremes: &[
        Ladder {
            param: "thickness_m",
            rungs: Rungs::Cells(&[1.0, 100.0]),
        },
        Ladder {
            param: "alpha",
            rungs: Rungs::Numbers(&[0.0, 40.0, 1e4]),
        },
        Ladder {
            param: "rayleigh_per_s",
            rungs: Rungs::Numbers(&[0.0, 100.0, 1e5]),
        },
        Ladder {
            param: "relaxed_modulus_ratio",
            rungs: Rungs::Numbers(&[1.0, 0.1]),
        },
    ],
    passive: false,
    upkeep,
};

/// Largest c_p/c_s (nu = 0.396) for which the equations are well-posed at any stretch.
///
/// Eq (8) stretches row j by s_j = 1 + C'_j alone. With r = (c_p/c_s)^2 its symbol in a side's layer,
/// `[r c^2/s^2 + q^2, (r-1) c q/s; (r-1) c q, r q^2 + c^2]` for the direction (c, q), has a negative
/// determinant somewhere as soon as `r^2 (s-1) > 4 r s + s (s-1)`, which no s allows up to
/// `r = (1 + sqrt 2)^2`; in a corner `(r-1)^2 s^2 > (r + s^2)^2` has the same limit, at s = 1 + sqrt 2.
/// Beyond, plane waves grow like exp(k c_s g t): without bound as cells shrink, and no damping that is
/// independent of the wave number k helps.
pub const LARGEST_SPEED_RATIO: f64 = 1.0 + std::f64::consts::SQRT_2;

/// Cells of a layer whose thickness is not given.
pub const DEFAULT_CELLS: f64 = 50.0;
/// N_t: steps that the memory reaches back.
const HISTORY: usize = 4;

fn upkeep(method: &SideMethod, transfer: Transfer) -> Upkeep {
    let remembers = method.number(&METHOD, "relaxed_modulus_ratio") < 1.0;
    let carried = transfer != Transfer::Keep;
    Upkeep {
        holds: "stretch; damping, memory, matrix and unsymmetric solver of the nodes",
        // with inertia, where points carry it
        point_vectors: if carried { 2 } else { 1 },
        point_matrices: 0,
        overlap_matrices: 0,
        node_vectors: 9 + if remembers { HISTORY + 1 } else { 0 },
        // of the displacement, of its increment, of the memory; each point's moduli are made anew
        forces: if remembers { 6.0 } else { 4.0 },
        // displacements to nodes and back
        passes: if carried { 2.0 } else { 0.0 },
    }
}

pub(crate) fn layout<const D: usize>(
    problem: &Problem<D>,
    side: Side,
    method: &SideMethod,
) -> Result<Layout, SolverError> {
    let obstacle = match problem.scheme {
        Scheme::Newmark => None,
        Scheme::Explicit => Some(
            "the published layer has implicit steps alone; with time.scheme = \"explicit\" use pml, dashpot, damping-layer or extended",
        ),
        Scheme::QuasiStatic => {
            Some("an absorbing layer absorbs waves; use fixed or roller with quasi-static")
        }
    };
    if let Some(reason) = obstacle {
        return Err(SolverError::Setup {
            field: format!("boundary.{}.method", side.name()),
            reason: reason.to_owned(),
        });
    }
    let outside = method
        .given_number("thickness_m")
        .unwrap_or(DEFAULT_CELLS * problem.cell_size);
    let layer = match problem.transfer {
        Transfer::Keep => LayerPoints::Kept,
        _ => LayerPoints::Carried,
    };
    Ok(Layout {
        outside,
        inside: 0.0,
        end: End::Fixed,
        layer: Some(layer),
    })
}

pub(crate) fn build<const D: usize>(context: &Context<'_, D>) -> Result<Parts<D>, SolverError> {
    let places = &context.points.place[context.layer.clone()];
    let stretch: Vec<Vector<D>> = places
        .iter()
        .map(|x| {
            let depth = relative_depth(context, x);
            let alpha = by_axis(context, x, |a| a.method.number(&METHOD, "alpha"));
            let power = by_axis(context, x, |a| a.method.number(&METHOD, "beta"));
            std::array::from_fn(|a| 1.0 + alpha[a] * depth[a].powf(power[a]))
        })
        .collect();
    // damping and memory are the same in all directions: those of the first side that names them
    let first = &context.sides[0].method;
    let ratio = first.number(&METHOD, "relaxed_modulus_ratio");
    let relaxed = Elastic {
        youngs_modulus: ratio * context.material.youngs_modulus,
        ..context.material
    };
    let nodes = context.grid.node_count();
    let memory = (ratio < 1.0).then(|| Memory {
        order: first.number(&METHOD, "fractional_order"),
        steps: first.number(&METHOD, "relaxation_steps"),
        ratio,
        history: (0..HISTORY).map(|_| vec![[0.0; D]; nodes]).collect(),
        load: vec![[0.0; D]; nodes],
    });
    let carried = context.transfer != Transfer::Keep;
    let inertia = carried.then(|| stretch.iter().map(|s| s.map(|s| s * s)).collect());
    let displacement = carried.then(|| match first.choice(&METHOD, "displacement") {
        "replaced" => DisplacementTransfer::Replaced,
        _ => DisplacementTransfer::Incremental,
    });
    let kernel = Stretched {
        range: context.layer.clone(),
        moduli: LinearElastic::new(&relaxed).small_moduli(),
        elastic: LinearElastic::new(&context.material),
        stretch,
        rayleigh: first.number(&METHOD, "rayleigh_per_s"),
        memory,
    };
    Ok(Parts {
        kernel: Some(Box::new(kernel)),
        inertia,
        displacement,
        ..Parts::of_terms(walls(context))
    })
}

/// Viscoelastic memory on nodes.
struct Memory<const D: usize> {
    order: f64,
    steps: f64,
    /// E_0 / E_inf.
    ratio: f64,
    /// ubar of the last steps, the latest first (m).
    history: Vec<Vec<Vector<D>>>,
    /// sum_q A_(q+1) ubar^(n+1-q) (m).
    load: Vec<Vector<D>>,
}

impl<const D: usize> Memory<D> {
    /// c of (30).
    fn balance(&self) -> f64 {
        let tau = self.steps.powf(self.order);
        tau / (tau + 1.0)
    }

    /// Factor of the displacement in the stress, in units of E_0.
    fn instant(&self) -> f64 {
        1.0 + self.balance() * (1.0 - self.ratio) / self.ratio
    }

    /// Factor of the memory's load in the stress, in units of E_0.
    fn delayed(&self) -> f64 {
        self.balance() / self.ratio
    }

    /// Takes the displacement at the end of a step.
    fn commit(&mut self, start: &[Vector<D>], increment: &[Vector<D>]) {
        let c = self.balance();
        let gain = (1.0 - c) * (1.0 - self.ratio);
        let mut latest = self.history.pop().unwrap_or_default();
        for (n, bar) in latest.iter_mut().enumerate() {
            *bar = std::array::from_fn(|i| {
                gain * (start[n][i] + increment[n][i]) - c * self.load[n][i]
            });
        }
        self.history.insert(0, latest);
        let mut coefficient = 1.0;
        self.load.fill([0.0; D]);
        for (q, bar) in self.history.iter().enumerate() {
            let q = (q + 1) as f64;
            coefficient *= (q - self.order - 1.0) / q;
            for (load, bar) in self.load.iter_mut().zip(bar) {
                for i in 0..D {
                    load[i] += coefficient * bar[i];
                }
            }
        }
    }
}

/// The layer's points.
struct Stretched<const D: usize> {
    range: Range<usize>,
    /// C_ijkl with E_0.
    moduli: Tensor4<D>,
    elastic: LinearElastic,
    /// 1 + C'_j of each point.
    stretch: Vec<Vector<D>>,
    rayleigh: f64,
    memory: Option<Memory<D>>,
}

impl<const D: usize> Stretched<D> {
    /// A_jmkl of a point: row j is stretched by C'_j alone.
    fn stretched_moduli(&self, q: usize, factor: f64) -> Tensor4<D> {
        let mut a = self.moduli;
        for j in 0..D {
            let s = self.stretch[q][j];
            for m in 0..D {
                for k in 0..D {
                    for l in 0..D {
                        // u_j,j and P_jj: 1; other components: s; own component across: s^2
                        let power = match (m == j, k == j) {
                            (true, true) => 1.0,
                            (false, true) => s * s,
                            _ => s,
                        };
                        a[j][m][k][l] *= factor * power;
                    }
                }
            }
        }
        a
    }

    fn add_force(
        &self,
        trial: &Trial<'_, D>,
        field: &[Vector<D>],
        factor: f64,
        out: &mut [Vector<D>],
    ) {
        let (mut gradient, mut stress) = ([zero::<D>(); BLOCK], [zero::<D>(); BLOCK]);
        for block in blocks(self.range.clone()) {
            let n = block.len();
            trial
                .disc
                .gradient(block.clone(), field, &mut gradient[..n]);
            for (b, (g, stress)) in gradient[..n].iter().zip(&mut stress).enumerate() {
                let q = block.start - self.range.start + b;
                let a = self.stretched_moduli(q, factor);
                *stress = std::array::from_fn(|i| std::array::from_fn(|j| contract(&a[i][j], g)));
            }
            let volumes = &trial.points.volume[block.clone()];
            trial.disc.scatter_stress(block, volumes, &stress[..n], out);
        }
    }
}

impl<const D: usize> RegionKernel<D> for Stretched<D> {
    fn inertia(&self, block: Range<usize>, out: &mut PointInertia<D>) {
        let own = block.start - self.range.start..block.end - self.range.start;
        out.mass.clear();
        for stretch in &self.stretch[own] {
            let inertia = stretch.map(|s| s * s);
            out.mass.push(inertia);
            if self.rayleigh > 0.0 {
                out.viscous.push(inertia.map(|m| self.rayleigh * m));
            }
        }
    }

    fn force(&mut self, trial: &Trial<'_, D>, out: &mut [Vector<D>]) -> Result<(), SolverError> {
        let instant = self.memory.as_ref().map_or(1.0, Memory::instant);
        self.add_force(trial, trial.start, instant, out);
        self.add_force(trial, trial.increment, instant, out);
        if let Some(memory) = &self.memory {
            self.add_force(trial, &memory.load, memory.delayed(), out);
        }
        Ok(())
    }

    fn tangent(&mut self, trial: &Trial<'_, D>, out: &mut BlockMatrix<D>) {
        let instant = self.memory.as_ref().map_or(1.0, Memory::instant);
        let moduli_of = |p: usize| self.stretched_moduli(p - self.range.start, instant);
        scatter_moduli(self.range.clone(), trial, moduli_of, out);
    }

    fn commit(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError> {
        if let Some(memory) = &mut self.memory {
            memory.commit(trial.start, trial.increment);
        }
        Ok(())
    }

    fn memories(&mut self) -> Vec<&mut [f64]> {
        let Some(memory) = &mut self.memory else {
            return Vec::new();
        };
        let all = memory.history.iter_mut().chain([&mut memory.load]);
        all.map(|values| values.as_flattened_mut()).collect()
    }

    fn stiffness(&self) -> Stiffness {
        Stiffness::Constant
    }

    fn is_symmetric(&self) -> bool {
        false
    }

    /// That of the plain material at the nodes' displacement.
    fn strain_energy(
        &self,
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        u: &[Vector<D>],
    ) -> f64 {
        let mut gradient = [zero::<D>(); BLOCK];
        let mut energy = 0.0;
        for block in blocks(self.range.clone()) {
            let n = block.len();
            disc.gradient(block.clone(), u, &mut gradient[..n]);
            let mut stress = [zero::<D>(); BLOCK];
            self.elastic.small_stress(&gradient[..n], &mut stress[..n]);
            for (s, v) in stress[..n].iter().zip(&points.volume[block]) {
                energy += v * self.elastic.energy_density(s);
            }
        }
        energy
    }
}
