//! Damping layer: viscous forces `-sigma m v` on the nodes of a layer, with the rate
//!
//! ```text
//! sigma = sigma_max (d / L)^p,     d from the inner edge
//! ```
//!
//! This is S21 (6)-(7) made independent of the time step: what is printed there scales velocities by
//! 1 - beta in every step, which is the rate beta/dt. Where layers of two sides meet the larger rate
//! holds.

use super::params::{MethodInfo, Param, ParamKind, SideMethod, Upkeep};
use super::{Context, End, Layout, Parts, walls};
use crate::error::SolverError;
use crate::physics::kernel::{Lumped, NodeTerm};
use crate::problem::{Problem, Side, Transfer};

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
    let mut rate = vec![0.0_f64; context.grid.node_count()];
    for assigned in &context.sides {
        let (side, layout) = (assigned.side, assigned.layout);
        let thickness = layout.outside + layout.inside;
        let largest = assigned.method.number(&METHOD, "sigma_max_per_s");
        let power = assigned.method.number(&METHOD, "power");
        let inwards = if side.upper {
            -layout.inside
        } else {
            layout.inside
        };
        let inner_edge = context.plane(side) + inwards;
        for (node, rate) in rate.iter_mut().enumerate() {
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
    let damped = rate.iter().enumerate().filter(|(_, s)| **s != 0.0);
    let nodes = damped.map(|(n, s)| (n as u32, *s)).collect();
    let mut terms = walls(context);
    terms.push(Box::new(DampingLayer { nodes }));
    Ok(Parts::of_terms(terms))
}

/// Nodes with their damping rates (1/s).
struct DampingLayer {
    nodes: Vec<(u32, f64)>,
}

impl<const D: usize> NodeTerm<D> for DampingLayer {
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
