//! Velocity inflow: the end of material that moves at the body's own velocity V0 at the start, held at
//! it along the side's normal. The end moves with the material; nothing is added behind it.

use super::params::{MethodInfo, SideMethod, Upkeep};
use super::{Context, End, Layout, Parts};
use crate::error::SolverError;
use crate::physics::kernel::{Constraints, Driven, NodeTerm};
use crate::problem::{PointMode, Problem, Scheme, Side};

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "inflow",
    summary: "the end of moving material, held at the velocity that it starts with",
    params: &[],
    ladder: &[],
    extremes: &[],
    passive: false,
    upkeep: Upkeep::none,
};

pub(crate) fn layout<const D: usize>(
    problem: &Problem<D>,
    side: Side,
    _method: &SideMethod,
) -> Result<Layout, SolverError> {
    check(problem, side)?;
    Ok(Layout::plain(End::Inflow))
}

/// Refuses an inflow that does not flow in, or has nowhere to flow.
pub(super) fn check<const D: usize>(problem: &Problem<D>, side: Side) -> Result<(), SolverError> {
    let refuse = |reason: String| {
        Err(SolverError::Setup {
            field: format!("boundary.{}.method", side.name()),
            reason,
        })
    };
    if problem.scheme != Scheme::Explicit || problem.point_mode != PointMode::Moving {
        return refuse("an inflow needs explicit steps and moving points".to_owned());
    }
    let speed = problem.flow.velocity[side.axis];
    let inwards = if side.upper { -speed } else { speed };
    if inwards <= 0.0 {
        return refuse(format!(
            "the material moves at {inwards} m/s into the body here: an inflow needs more than 0"
        ));
    }
    let opposite = &problem.sides[side.axis][usize::from(!side.upper)];
    if opposite.method != "free" {
        return refuse(format!(
            "it flows against the opposite side, which is {:?} and stays; use \"free\" there",
            opposite.method
        ));
    }
    Ok(())
}

pub(crate) fn build<const D: usize>(context: &Context<'_, D>) -> Result<Parts<D>, SolverError> {
    Ok(Parts::of_terms(super::walls(context)))
}

/// Nodes at and just behind the moving end.
pub(super) struct MovingEnd {
    side: Side,
    /// Where the end starts (m), and its velocity (m/s), along the axis.
    start: f64,
    velocity: f64,
    /// Edge of a cell (m).
    h: f64,
    /// Nodes with their coordinate along the axis (m), where the end may come to.
    nodes: Vec<(u32, f64)>,
}

impl MovingEnd {
    /// The outer end of `side`.
    pub(super) fn new<const D: usize>(context: &Context<'_, D>, side: Side) -> Self {
        let axis = side.axis;
        let place = |n: usize| (n as u32, context.grid.node_place(n)[axis]);
        let material = &context.material_box;
        MovingEnd {
            side,
            start: if side.upper {
                material.upper
            } else {
                material.lower
            }[axis],
            velocity: context.velocity[axis],
            h: context.grid.h[axis],
            nodes: (0..context.grid.node_count()).map(place).collect(),
        }
    }
}

impl<const D: usize> NodeTerm<D> for MovingEnd {
    fn constrain(&self, times: [f64; 2], out: &mut Constraints<D>) {
        let end = self.start + self.velocity * times[0];
        let axis = self.side.axis;
        let driven = Driven {
            velocity: [self.velocity; 2],
            acceleration: [0.0; 2],
        };
        for &(node, x) in &self.nodes {
            let behind = if self.side.upper { x - end } else { end - x };
            if (-1e-6 * self.h..2.0 * self.h).contains(&behind) {
                out.held[node as usize][axis] = true;
                out.driven.push((node, axis as u8, driven));
            }
        }
    }
}
