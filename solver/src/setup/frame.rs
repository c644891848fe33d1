//! The frame in which a problem is solved. A layer whose points rest moves with material that starts at V0 when
//! all is solved in the frame that moves so (Galilei):
//!
//! ```text
//! x' = x - V0 t,   v' = v - V0,   a' = a,   sigma' = sigma
//! ```
//!
//! There the body starts at rest, the layer damps what departs from V0 and its displacement is u - V0 t, while
//! rigid bodies come at it. What is recorded is turned back.

use crate::geometry::Geometry;
use crate::problem::Problem;
use crate::tensor::Vector;

/// A problem in its frame.
pub(super) struct Framed<const D: usize> {
    /// The problem, at rest at the start.
    pub problem: Problem<D>,
    /// Velocity of the frame (m/s).
    pub velocity: Vector<D>,
}

/// The problem in the frame of its layers, where these rest and the material starts with a velocity; else
/// `None`.
pub(super) fn of_layers<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
) -> Option<Framed<D>> {
    let velocity = problem.flow.velocity;
    if velocity == [0.0; D] || !geometry.assigned.iter().any(|a| a.layout.rests()) {
        return None;
    }
    let mut framed = problem.clone();
    framed.flow.velocity = [0.0; D];
    Some(Framed {
        problem: framed,
        velocity,
    })
}
