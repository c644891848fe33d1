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
use super::{Assigned, Context, End, Layout, Parts, inflow, walls};
use crate::error::SolverError;
use crate::grid::Grid;
use crate::physics::kernel::{Lumped, NodeTerm, Step};
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
            kind: ParamKind::Choice(&["fixed", "roller", "free", "inflow"]),
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
        "inflow" => {
            inflow::check(problem, side)?;
            End::Inflow
        }
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
    let profiles: Vec<Profile> = context
        .sides
        .iter()
        .map(|a| Profile::of(context, a))
        .collect();
    let mut terms = walls(context);
    if context.velocity != [0.0; D] || profiles.iter().any(|p| p.printed) {
        terms.push(Box::new(ScaledVelocities {
            profiles,
            grid: context.grid.clone(),
            velocity: context.velocity,
        }));
        return Ok(Parts::of_terms(terms));
    }
    let rate = |n: usize| {
        (
            n as u32,
            strongest(&profiles, &context.grid.node_place(n), [0.0; D]).0,
        )
    };
    let nodes = (0..context.grid.node_count()).map(rate);
    let nodes = nodes.filter(|(_, rate)| *rate != 0.0).collect();
    terms.push(Box::new(DampingLayer { nodes }));
    Ok(Parts::of_terms(terms))
}

/// How the layer of a side grows.
struct Profile {
    side: Side,
    /// Coordinate of the inner edge at the start (m).
    inner_edge: f64,
    thickness: f64,
    /// Rate (1/s), or S21's beta, at the outer end.
    largest: f64,
    power: f64,
    printed: bool,
}

impl Profile {
    fn of<const D: usize>(context: &Context<'_, D>, assigned: &Assigned) -> Self {
        let (side, layout) = (assigned.side, assigned.layout);
        let thickness = layout.outside + layout.inside;
        let number = |key: &str| assigned.method.number(&METHOD, key);
        let printed = assigned.method.choice(&METHOD, "form") == "printed";
        let (largest, power) = match printed {
            true => (number("alpha_per_m") * thickness, 1.0),
            false => (number("sigma_max_per_s"), number("power")),
        };
        let inwards = if side.upper {
            -layout.inside
        } else {
            layout.inside
        };
        Profile {
            side,
            inner_edge: context.plane(side) + inwards,
            thickness,
            largest,
            power,
            printed,
        }
    }

    /// Rate or beta at `x` (m), `moved` (m) from where the layer started.
    fn at<const D: usize>(&self, x: &Vector<D>, moved: &Vector<D>) -> f64 {
        let axis = self.side.axis;
        let beyond = x[axis] - moved[axis] - self.inner_edge;
        let depth = if self.side.upper { beyond } else { -beyond };
        if depth <= 0.0 {
            return 0.0;
        }
        self.largest * (depth / self.thickness).min(1.0).powf(self.power)
    }
}

/// The rate or beta at `x` (m) and whether it is beta: the larger in size, so that a layer of negative
/// rate feeds energy in and is found out.
fn strongest<const D: usize>(profiles: &[Profile], x: &Vector<D>, moved: Vector<D>) -> (f64, bool) {
    let mut found = (0.0_f64, false);
    for profile in profiles {
        let here = profile.at(x, &moved);
        if here.abs() > found.0.abs() {
            found = (here, profile.printed);
        }
    }
    found
}

/// Nodes with their damping rates (1/s).
struct DampingLayer {
    nodes: Vec<(u32, f64)>,
}

impl<const D: usize> NodeTerm<D> for DampingLayer {
    fn lump(&self, _t: f64, out: &mut Lumped<D>) {
        for &(node, rate) in &self.nodes {
            let node = node as usize;
            for i in 0..D {
                let damping = rate * out.mass[node][i];
                out.viscous_mut()[node][i] += damping;
            }
        }
    }
}

/// Velocities less that of the material scaled in every explicit step, by 1 - beta or exp(-sigma dt), in
/// a layer that moves with the material.
struct ScaledVelocities<const D: usize> {
    profiles: Vec<Profile>,
    grid: Grid<D>,
    /// Velocity of the material without waves (m/s).
    velocity: Vector<D>,
}

impl<const D: usize> NodeTerm<D> for ScaledVelocities<D> {
    fn correct(&mut self, step: &Step<'_, D>, v: &mut [Vector<D>]) {
        let [start, end] = step.times;
        let moved = self.velocity.map(|v| v * start);
        for (node, v) in v.iter_mut().enumerate() {
            if step.mass[node][0] <= 0.0 {
                continue;
            }
            let x = self.grid.node_place(node);
            let keep = match strongest(&self.profiles, &x, moved) {
                (0.0, _) => continue,
                (beta, true) => 1.0 - beta,
                (rate, false) => (-rate * (end - start)).exp(),
            };
            for i in 0..D {
                v[i] = self.velocity[i] + keep * (v[i] - self.velocity[i]);
            }
        }
    }
}
