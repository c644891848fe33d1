//! Geometry that absorbing layers share: how deep a place lies in the layers of each axis.

use super::Context;
use crate::tensor::Vector;

/// Depth of `x` in the layers of each axis over their thickness (0 outside, at most 1).
///
/// Two sides of one axis never overlap, so there is one depth an axis.
pub(super) fn relative_depth<const D: usize>(context: &Context<'_, D>, x: &Vector<D>) -> Vector<D> {
    let mut depth = [0.0; D];
    for assigned in &context.sides {
        let axis = assigned.side.axis;
        let beyond = if assigned.side.upper {
            x[axis] - context.plane(assigned.side)
        } else {
            context.plane(assigned.side) - x[axis]
        };
        if beyond > 0.0 {
            depth[axis] = (beyond / assigned.layout.outside).min(1.0);
        }
    }
    depth
}

/// A number of the side whose layer holds `x`, for each axis; 0 where there is none.
pub(super) fn by_axis<const D: usize>(
    context: &Context<'_, D>,
    x: &Vector<D>,
    value: impl Fn(&super::Assigned) -> f64,
) -> Vector<D> {
    let mut out = [0.0; D];
    for assigned in &context.sides {
        let axis = assigned.side.axis;
        let plane = context.plane(assigned.side);
        let beyond = if assigned.side.upper {
            x[axis] > plane
        } else {
            x[axis] < plane
        };
        if beyond {
            out[axis] = value(assigned);
        }
    }
    out
}
