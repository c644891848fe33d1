//! Damping layer: viscous forces `-sigma m v` on the nodes of a layer, with the rate
//!
//! ```text
//! sigma = sigma_max (d / L)^p,     d from the inner edge
//! ```
//!
//! This is S21 (6)-(7) made independent of the time step: over a step it is the factor
//! (1 - sigma dt/2)/(1 + sigma dt/2), exp(-sigma dt) to third order. What is printed there
//! (`form = "printed"`, explicit steps alone) scales velocities in every step,
//!
//! ```text
//! v' = (1 - beta) v,     beta = alpha d
//! ```
//!
//! which is the rate beta/dt and so depends on the step. Where layers of two sides meet the larger rate
//! holds.

use super::params::{Ladder, MethodInfo, Param, ParamKind, Rungs, SideMethod, Upkeep};
use super::{Context, End, Layout, Parts, walls};
use crate::error::SolverError;
use crate::physics::kernel::{Lumped, NodeTerm};
use crate::problem::{Problem, Scheme, Side, Transfer};
use crate::tensor::Vector;

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "damping-layer",
    summary: "viscous layer, rate sigma_max (d/L)^p growing towards its outer end",
    params: &[
        Param {
            name: "thickness_m",
            doc: "thickness L of the layer",
            kind: ParamKind::Number {
                unit: "m",
                default: None,
                min: 1e-9,
                max: 1e9,
            },
        },
        Param {
            name: "sigma_max_per_s",
            doc: "damping rate at the outer end",
            kind: ParamKind::Number {
                unit: "1/s",
                default: Some(12.0),
                min: 0.0,
                max: 1e9,
            },
        },
        Param {
            name: "power",
            doc: "power p of the profile",
            kind: ParamKind::Number {
                unit: "1",
                default: Some(2.0),
                min: 0.0,
                max: 10.0,
            },
        },
        Param {
            name: "form",
            doc: "rate: sigma, whatever the step; printed: S21's factor 1 - alpha d in every step, explicit alone",
            kind: ParamKind::Choice(&["rate", "printed"]),
        },
        Param {
            name: "alpha_per_m",
            doc: "S21's coefficient alpha of the printed form",
            kind: ParamKind::Number {
                unit: "1/m",
                default: Some(0.01),
                min: 0.0,
                max: 1e3,
            },
        },
        Param {
            name: "placement",
            doc: "outside: material is added to the body; inside: the outermost part of the body is damped",
            kind: ParamKind::Choice(&["outside", "inside"]),
        },
        Param {
            name: "end",
            doc: "condition behind the layer",
            kind: ParamKind::Choice(&["fixed", "roller", "free"]),
        },
    ],
    ladder: &[
        Ladder {
            param: "thickness_m",
            rungs: Rungs::Cells(&[5.0, 10.0, 20.0, 30.0, 50.0, 100.0]),
        },
        Ladder {
            param: "sigma_max_per_s",
            rungs: Rungs::Numbers(&[6.0, 12.0, 24.0]),
        },
    ],
    extremes: &[
        Ladder {
            param: "thickness_m",
            rungs: Rungs::Cells(&[1.0, 100.0]),
        },
        Ladder {
            param: "sigma_max_per_s",
            rungs: Rungs::Numbers(&[0.0, 1e3, 1e6]),
        },
    ],
    passive: true,
    upkeep,
};

fn upkeep(_: &SideMethod, _: Transfer) -> Upkeep {
    Upkeep {
        holds: "rate, damping",
        node_vectors: 2,
        ..Upkeep::default()
    }
}

pub(crate) fn layout<const D: usize>(
    problem: &Problem<D>,
    side: Side,
    method: &SideMethod,
) -> Result<Layout, SolverError> {
    let field = |key: &str| format!("boundary.{}.{key}", side.name());
    let Some(thickness) = method.given_number("thickness_m") else {
        return Err(SolverError::Setup {
            field: field("thickness_m"),
            reason: "a damping layer needs a thickness".to_owned(),
        });
    };
    let printed = method.choice(&METHOD, "form") == "printed";
    if printed && problem.scheme != Scheme::Explicit {
        return Err(SolverError::Setup {
            field: field("form"),
            reason: "the printed form is a factor of explicit steps; use rate, or time.scheme = \"explicit\""
                .to_owned(),
        });
    }
    let most = method.number(&METHOD, "alpha_per_m") * thickness;
    if printed && most > 1.0 {
        return Err(SolverError::Setup {
            field: field("alpha_per_m"),
            reason: format!(
                "alpha times the thickness is {most}: above 1 the velocity changes its sign in every step"
            ),
        });
    }
    let end = match method.choice(&METHOD, "end") {
        "free" => End::Free,
        "roller" => End::Roller,
        _ => End::Fixed,
    };
    if method.choice(&METHOD, "placement") == "outside" {
        return Ok(Layout {
            outside: thickness,
            inside: 0.0,
            end,
            layer: None,
        });
    }
    let depth = problem.target.upper[side.axis] - problem.target.lower[side.axis];
    if thickness > depth {
        return Err(SolverError::Setup {
            field: field("thickness_m"),
            reason: format!("a layer of {thickness} m does not fit inside a body of {depth} m"),
        });
    }
    Ok(Layout {
        outside: 0.0,
        inside: thickness,
        end,
        layer: None,
    })
}

pub(crate) fn build<const D: usize>(context: &Context<'_, D>) -> Result<Parts<D>, SolverError> {
    let nodes = context.grid.node_count();
    let (mut rate, mut factor) = (vec![0.0_f64; nodes], vec![0.0_f64; nodes]);
    for assigned in &context.sides {
        let (side, layout) = (assigned.side, assigned.layout);
        let thickness = layout.outside + layout.inside;
        let number = |key: &str| assigned.method.number(&METHOD, key);
        let printed = assigned.method.choice(&METHOD, "form") == "printed";
        let (largest, power, field) = match printed {
            true => (number("alpha_per_m") * thickness, 1.0, &mut factor),
            false => (number("sigma_max_per_s"), number("power"), &mut rate),
        };
        let inwards = if side.upper {
            -layout.inside
        } else {
            layout.inside
        };
        let inner_edge = context.plane(side) + inwards;
        for (node, rate) in field.iter_mut().enumerate() {
            let x = context.grid.node_place(node)[side.axis];
            let depth = if side.upper {
                x - inner_edge
            } else {
                inner_edge - x
            };
            if depth > 0.0 {
                let here = largest * (depth / thickness).min(1.0).powf(power);
                // the larger in size, so that a layer of negative rate feeds energy in and is found out
                if here.abs() > rate.abs() {
                    *rate = here;
                }
            }
        }
    }
    let mut terms = walls(context);
    terms.push(Box::new(DampingLayer {
        nodes: damped(&rate),
        factors: damped(&factor),
    }));
    Ok(Parts::of_terms(terms))
}

fn damped(strength: &[f64]) -> Vec<(u32, f64)> {
    let nodes = strength.iter().enumerate().filter(|(_, s)| **s != 0.0);
    nodes.map(|(n, s)| (n as u32, *s)).collect()
}

/// Nodes with their damping rates (1/s), or with S21's beta.
struct DampingLayer {
    nodes: Vec<(u32, f64)>,
    factors: Vec<(u32, f64)>,
}

impl<const D: usize> NodeTerm<D> for DampingLayer {
    fn scale(&self, v: &mut [Vector<D>]) {
        for &(node, beta) in &self.factors {
            for v in &mut v[node as usize] {
                *v *= 1.0 - beta;
            }
        }
    }

    fn lump(&self, out: &mut Lumped<D>) {
        for &(node, rate) in &self.nodes {
            let node = node as usize;
            for i in 0..D {
                let damping = rate * out.mass[node][i];
                out.viscous_mut()[node][i] += damping;
            }
        }
    }
}
