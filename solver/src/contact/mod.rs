//! Rigid bodies that move as prescribed and touch the soil, node by node.
//!
//! - [`shape`]: circle, rectangle, half-plane by signed distance;
//! - [`body`]: a shape that moves; its place, velocity, and how far points have got into it;
//! - [`Contact`]: which nodes are touched, and what that does to one of them.
//!
//! The law of one node is Bardenhagen's (Bardenhagen, Guilkey, Roessig, Brackbill, Witzel, Foster 2001)
//! against a body of infinite mass: with n the normal out of the body, v' the trial velocity, v_b the
//! body's,
//!
//! ```text
//! w = v' - v_b,   w_n = w.n,   w_t = w - w_n n          nothing where w_n >= 0: no pull
//! J = m [-a w_n n - min(1, mu a |w_n| / |w_t|) w_t],   v = v' + J/m,   force on the body -sum J / dt
//! ```
//!
//! with a = 1 inside the body and, against noise, less outside.
//!
//! # Which nodes are touched, and how much
//! A node's mass is that of points up to a cell and a half away, so a body that is near nodes need not
//! be near material. The material must touch, `point gap <= 0`: the least over the points that reach the
//! node of (signed distance - extent of the point along n). Of the nodes of such material those inside
//! the body count in full and those at a distance d outside, up to `reach` h, by
//!
//! ```text
//! a = min(1, 4 (c dt/h) (1 - d/(reach h))^2)
//! ```
//!
//! a dashpot of four of the soil's impedances that fades out: nodes take up the body's velocity over
//! many steps as it comes, not in one.
//!
//! A column of 120 cells (GIMP, 4 points a cell) struck at c/36, with its surface anywhere in a cell;
//! exact is p = 1.0209 rho c v (`column` in the tests):
//!
//! | rule | contact before touch | mean p/(rho c v) | scatter of p | deepest point |
//! |---|---|---|---|---|
//! | node inside the body, points or not | up to 0.7 h early | 1.000..1.023 | 8..20 % | 0.2 h |
//! | points touch, node inside (reach 0) | none | 1.005..1.009 | 8 % | 0.2 h |
//! | reach 0.75 | none | 1.012..1.014 | 4 % | 0.08 h |
//! | reach 1.5 | none | 1.015..1.017 | 2.5 % | 0.04 h |
//!
//! The price of a wide reach: soil down to the last node that follows moves with the body, whose outline
//! thus lies off its own by the depth of that node, anything from `reach` h to a cell less, on average
//! (reach - 1/2) h. Reach 0 makes bodies half a cell too small all round, 0.5 to 0.75 keeps the outline
//! within a quarter of a cell, 1 and more makes them too large and shakes a curved body, whose nodes
//! come in one by one. All goes with h.

pub mod body;
pub mod shape;
pub(crate) mod term;

use crate::tensor::{Vector, dot};

/// Impedances of the dashpot by which a node outside the body is touched.
const IMPEDANCES: f64 = 4.0;

/// How bodies touch soil.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Coulomb's coefficient; 0 is frictionless.
    pub friction: f64,
    /// How far outside the body a node may lie, as a share of the cell edge h.
    pub reach: f64,
}

/// What contact does to a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response<const D: usize> {
    /// Corrected velocity (m/s).
    pub velocity: Vector<D>,
    /// Impulse on the soil (N s, per metre of thickness in 2D); the body gets its opposite.
    pub impulse: Vector<D>,
}

/// Gap (m) between a body and the box of a point: `distance` (m) from the body to its centre, less what
/// half of its edges `half_extent` (m) reach along the `normal`.
#[inline]
pub fn point_gap<const D: usize>(
    distance: f64,
    half_extent: &Vector<D>,
    normal: &Vector<D>,
) -> f64 {
    distance - dot(half_extent, &normal.map(f64::abs))
}

impl Contact {
    /// How much of a node is touched, 0..=1: `node_distance` (m) from the body to the node,
    /// `least_point_gap` (m) over the points that reach it, `h` the cell's edge (m), `courant` = c dt/h.
    #[inline]
    pub fn share(&self, node_distance: f64, least_point_gap: f64, h: f64, courant: f64) -> f64 {
        if least_point_gap > 0.0 {
            return 0.0;
        }
        if node_distance <= 0.0 {
            return 1.0;
        }
        let near = (1.0 - node_distance / (self.reach * h)).max(0.0);
        (IMPEDANCES * courant * near * near).min(1.0)
    }

    /// What contact does to a node of `mass` (kg, per metre in 2D) with trial `velocity` (m/s) of which
    /// `share` is touched, at a body that moves at `body_velocity` (m/s) with unit `normal` out of it.
    /// None: it is not touched, or they part.
    #[inline]
    pub fn respond<const D: usize>(
        &self,
        mass: f64,
        velocity: &Vector<D>,
        body_velocity: &Vector<D>,
        normal: &Vector<D>,
        share: f64,
    ) -> Option<Response<D>> {
        let mut relative = *velocity;
        for (w, b) in relative.iter_mut().zip(body_velocity) {
            *w -= b;
        }
        let approach = -dot(&relative, normal);
        if approach <= 0.0 || share <= 0.0 {
            return None;
        }
        let mut tangential = relative;
        for (w, n) in tangential.iter_mut().zip(normal) {
            *w += approach * n;
        }
        let slip = dot(&tangential, &tangential).sqrt();
        let taken = share * approach;
        let most = self.friction * taken;
        let stopped = if slip <= most { 1.0 } else { most / slip };
        let (mut after, mut impulse) = (*velocity, [0.0; D]);
        for i in 0..D {
            let change = taken * normal[i] - stopped * tangential[i];
            after[i] += change;
            impulse[i] = mass * change;
        }
        Some(Response {
            velocity: after,
            impulse,
        })
    }
}

/// Force on the body (N, per metre in 2D) from the `impulses` (N s) on the soil's nodes over `dt` (s).
pub fn reaction<'a, const D: usize>(
    impulses: impl IntoIterator<Item = &'a Vector<D>>,
    dt: f64,
) -> Vector<D> {
    let mut sum = [0.0; D];
    for impulse in impulses {
        for (s, j) in sum.iter_mut().zip(impulse) {
            *s -= j;
        }
    }
    sum.map(|s| s / dt)
}

#[cfg(test)]
mod tests;
