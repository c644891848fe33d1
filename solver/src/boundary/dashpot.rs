//! Dashpots: tractions that take up a wave that meets the side head-on (Lysmer & Kuhlemeyer 1969):
//!
//! ```text
//! t = - a rho [c_p (v.n) n + c_s (v - (v.n) n)]
//! ```
//!
//! consistent over the side, `C_IJ = sum_b A_b N_I N_J Z` over surface points b that move with the
//! material. Summed over a row of nodes this is rho c per unit area, which is what S21 (5) means to
//! be: the mass of one full cell times c/h; with the half-cell mass of the boundary nodes alone the
//! impedance is halved. A wave that meets it head-on is reflected by (1 - a)/(1 + a).
//!
//! Explicit steps sum the rows to the nodes, `C_I = sum_b A_b N_I Z`, and centre the traction in time.

use super::params::{Ladder, MethodInfo, Param, ParamKind, Rungs, SideMethod, Upkeep};
use super::surface::Surface;
use super::{Context, End, Layout, Parts};
use crate::basis::Discretisation;
use crate::error::SolverError;
use crate::linear::block_matrix::BlockMatrix;
use crate::physics::kernel::{Lumped, NodeTerm};
use crate::problem::{Problem, Scheme, Side};
use crate::tensor::{Matrix, Vector};

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "dashpot",
    summary: "viscous tractions rho c_p (normal) and rho c_s (tangential) on the side",
    params: &[Param {
        name: "impedance",
        doc: "share of the material's impedance that the dashpots have",
        kind: ParamKind::Number {
            unit: "1",
            default: Some(1.0),
            min: 0.0,
            max: 1e6,
        },
    }],
    ladder: &[],
    extremes: &[Ladder {
        param: "impedance",
        rungs: Rungs::Numbers(&[0.0, 1e3, 1e6]),
    }],
    passive: true,
    upkeep: Upkeep::none,
};

pub(crate) fn layout<const D: usize>(
    problem: &Problem<D>,
    side: Side,
    _method: &SideMethod,
) -> Result<Layout, SolverError> {
    if problem.scheme == Scheme::QuasiStatic {
        return Err(SolverError::Setup {
            field: format!("boundary.{}.method", side.name()),
            reason: "a dashpot holds nothing without motion; use roller or fixed with quasi-static"
                .to_owned(),
        });
    }
    Ok(Layout::plain(End::Free))
}

pub(crate) fn build<const D: usize>(context: &Context<'_, D>) -> Result<Parts<D>, SolverError> {
    let (density, cp, cs) = (
        context.material.density,
        context.material.p_speed(),
        context.material.s_speed(),
    );
    let terms = context.sides.iter().map(|assigned| {
        let share = assigned.method.number(&METHOD, "impedance");
        let mut impedance = [share * density * cs; D];
        impedance[assigned.side.axis] = share * density * cp;
        let surface = Surface::new(context, assigned.side);
        Box::new(Dashpot {
            surface,
            impedance,
            moving: context.moving,
            velocity: context.velocity,
            lumped: context.explicit_dt.is_some(),
        }) as Box<dyn NodeTerm<D>>
    });
    Ok(Parts::of_terms(terms.collect()))
}

/// Dashpots on one side.
struct Dashpot<const D: usize> {
    surface: Surface<D>,
    /// Impedance in each direction (kg/(m2 s)).
    impedance: Vector<D>,
    moving: bool,
    /// What the material moves at without waves (m/s): the dashpot moves along.
    velocity: Vector<D>,
    /// Are its rows summed to the nodes?
    lumped: bool,
}

impl<const D: usize> Dashpot<D> {
    /// Tells `give` the area (m2) that each node `with` mass has of the side.
    fn shares(&self, with: impl Fn(usize) -> bool, mut give: impl FnMut(usize, f64)) {
        for sample in &self.surface.samples {
            let pairs = || {
                let pairs = sample.nodes.iter().zip(&sample.weights);
                let pairs = pairs.map(|(n, w)| (*n as usize, *w));
                pairs.filter(|(n, _)| with(*n))
            };
            let total: f64 = pairs().map(|(_, w)| w).sum();
            for (node, w) in pairs() {
                give(node, self.surface.area * w / total);
            }
        }
    }
}

impl<const D: usize> NodeTerm<D> for Dashpot<D> {
    fn attach(&mut self, disc: &dyn Discretisation<D>) -> Result<(), Vector<D>> {
        self.surface.attach(disc)
    }

    fn lump(&self, _t: f64, out: &mut Lumped<D>) {
        if !self.lumped {
            return;
        }
        out.viscous_mut();
        let Lumped { mass, viscous, .. } = out;
        let has_mass = |node: usize| mass[node][0] > 0.0;
        self.shares(has_mass, |node, share| {
            for i in 0..D {
                viscous[node][i] += share * self.impedance[i];
            }
        });
    }

    fn force(&self, _t: f64, v: &[Vector<D>], active: &[bool], out: &mut [Vector<D>]) {
        if self.lumped {
            if self.velocity != [0.0; D] {
                self.shares(
                    |node| active[node],
                    |node, share| {
                        for i in 0..D {
                            out[node][i] += share * self.impedance[i] * self.velocity[i];
                        }
                    },
                );
            }
            return;
        }
        for sample in &self.surface.samples {
            let velocity = sample.interpolate(v, active);
            let total = sample.active_weight(active);
            for (&node, w) in sample.nodes.iter().zip(&sample.weights) {
                if active[node as usize] {
                    for i in 0..D {
                        let traction = self.impedance[i] * velocity[i];
                        out[node as usize][i] -= self.surface.area * w / total * traction;
                    }
                }
            }
        }
    }

    fn tangent(&self, rate: f64, active: &[bool], out: &mut BlockMatrix<D>) {
        for sample in &self.surface.samples {
            let total = sample.active_weight(active);
            let seen = || {
                sample
                    .nodes
                    .iter()
                    .zip(&sample.weights)
                    .filter(|(n, _)| active[**n as usize])
            };
            for (&row, wi) in seen() {
                for (&column, wj) in seen() {
                    let factor = rate * self.surface.area * wi * wj / (total * total);
                    let mut block: Matrix<D> = [[0.0; D]; D];
                    for i in 0..D {
                        block[i][i] = factor * self.impedance[i];
                    }
                    out.add(row as usize, column as usize, &block);
                }
            }
        }
    }

    fn advance(
        &mut self,
        disc: &dyn Discretisation<D>,
        increment: &[Vector<D>],
        active: &[bool],
    ) -> Result<(), Vector<D>> {
        if self.moving {
            self.surface.advance(disc, increment, active)
        } else {
            Ok(())
        }
    }
}
