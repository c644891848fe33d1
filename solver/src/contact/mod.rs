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
//! J = m [-w_n n - min(1, mu |w_n| / |w_t|) w_t],   v = v' + J/m,   force on the body -sum J / dt
//! ```
//!
//! # Which nodes are touched
//! A node's mass is that of points up to a cell and a half away, so a body that is near nodes need not
//! be near material. Two conditions: the material touches, `point gap <= 0`, where the point gap is the
//! least over the points that reach the node of (signed distance - extent of the point along n); and the
//! node lies inside the body or within `reach` of h outside it.
//!
//! A column of 120 cells (GIMP, 4 points a cell) struck at c/36, with its surface anywhere in a cell;
//! exact is p = 1.0209 rho c v (`column` in the tests):
//!
//! | rule | contact before touch | mean p/(rho c v) | scatter of p | deepest point |
//! |---|---|---|---|---|
//! | node inside the body | up to 0.7 h early | 1.000..1.023 | 8..20 % | 0.2 h |
//! | node within h | 1.0..1.3 h early | 1.22..1.26 | 40..50 % | never touches |
//! | points touch, node inside | none | 1.005..1.009 | 8 % | 0.2 h |
//! | points touch, node within h/2 | none | 1.016 | 3 % | 0.04 h |
//! | points touch, node within h | none | 1.020 | 1 % | 0.01 h |
//!
//! The price of a wide reach: the soil up to the last node touched moves with the body, whose outline
//! thus lies (reach - 1/2) h outside its own on average. Half a cell is free of that, a whole cell is the
//! smoothest; both go with h.

pub mod body;
pub mod shape;
pub(crate) mod term;

use crate::tensor::{Vector, dot};

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
    /// Is a node touched? `node_distance` (m) from the body to the node, `least_point_gap` (m) over the
    /// points that reach it, `h` the cell's edge (m).
    #[inline]
    pub fn touches(&self, node_distance: f64, least_point_gap: f64, h: f64) -> bool {
        least_point_gap <= 0.0 && node_distance <= self.reach * h
    }

    /// What contact does to a touched node of `mass` (kg, per metre in 2D) with trial `velocity` (m/s),
    /// at a body that moves at `body_velocity` (m/s) with unit `normal` out of it. None: they part.
    #[inline]
    pub fn respond<const D: usize>(
        &self,
        mass: f64,
        velocity: &Vector<D>,
        body_velocity: &Vector<D>,
        normal: &Vector<D>,
    ) -> Option<Response<D>> {
        let mut relative = *velocity;
        for (w, b) in relative.iter_mut().zip(body_velocity) {
            *w -= b;
        }
        let approach = -dot(&relative, normal);
        if approach <= 0.0 {
            return None;
        }
        let mut tangential = relative;
        for (w, n) in tangential.iter_mut().zip(normal) {
            *w += approach * n;
        }
        let slip = dot(&tangential, &tangential).sqrt();
        let most = self.friction * approach;
        let stopped = if slip <= most { 1.0 } else { most / slip };
        let (mut after, mut impulse) = (*velocity, [0.0; D]);
        for i in 0..D {
            let change = approach * normal[i] - stopped * tangential[i];
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
