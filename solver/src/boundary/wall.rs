//! Rollers and fixed ends: nodes at or behind a plane are held.

use super::{Context, End};
use crate::physics::kernel::{Constraints, NodeTerm, nodes_where};
use crate::problem::Side;

/// A held plane.
pub struct Wall {
    nodes: Vec<u32>,
    /// Held direction; `None`: all.
    direction: Option<usize>,
}

impl Wall {
    /// Holds the outer end of `side`.
    pub fn new<const D: usize>(context: &Context<'_, D>, side: Side, end: End) -> Self {
        let (axis, tolerance) = (side.axis, 1e-6 * context.grid.h[side.axis]);
        let nodes = if side.upper {
            let plane = context.material_box.upper[axis];
            nodes_where(context.grid, |x| x[axis] >= plane - tolerance)
        } else {
            let plane = context.material_box.lower[axis];
            nodes_where(context.grid, |x| x[axis] <= plane + tolerance)
        };
        Wall {
            nodes,
            direction: (end == End::Roller).then_some(axis),
        }
    }
}

impl<const D: usize> NodeTerm<D> for Wall {
    fn constrain(&self, _times: [f64; 2], out: &mut Constraints<D>) {
        match self.direction {
            Some(axis) => out.hold(&self.nodes, axis),
            None => (0..D).for_each(|axis| out.hold(&self.nodes, axis)),
        }
    }
}
