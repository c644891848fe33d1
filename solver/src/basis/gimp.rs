//! The generalised interpolation material point basis (Bardenhagen & Kober 2004), uniform: linear
//! functions averaged over the extent of a point, a square of half-length l (in cells) that does not
//! deform:
//!
//! ```text
//! N = 1 - (xi^2 + l^2)/(2 l)          |xi| <= l
//!     1 - |xi|                    l <= |xi| <= 1 - l
//!     (1 + l - |xi|)^2/(4 l)  1 - l <= |xi| <= 1 + l
//! ```
//!
//! Gradients are continuous, so that a point does not jerk when it crosses a cell's face. Places
//! without extent (receivers, surfaces, forces) see the linear functions themselves.

use super::along::{Along, Basis, whole};
use super::linear::Linear;

/// The basis: 3^D nodes a point.
#[derive(Clone, Copy, Debug)]
pub struct Gimp {
    /// Half-length of a point in cells, at most 1/2.
    half: f64,
    /// 1/(2 l).
    per_length: f64,
}

impl Gimp {
    /// For cells filled with `per_axis` points along each axis.
    pub fn new(per_axis: usize) -> Self {
        Gimp {
            half: 0.5 / per_axis as f64,
            per_length: per_axis as f64,
        }
    }

    /// Value and slope of the function of the node above a point that is `xi` cells above its nearest
    /// node, |xi| <= 1/2: `t^2/(4 l) + max(xi - l, 0)` and `t/(2 l)` with t = xi + l between 0 and 2 l,
    /// which are the pieces above without a branch.
    #[inline(always)]
    fn above(&self, xi: f64) -> (f64, f64) {
        let l = self.half;
        // comparisons that fail on NaN, as the machine's own maximum does
        let reach = if xi > -l { xi + l } else { 0.0 };
        let t = if xi < l { reach } else { 2.0 * l };
        let beyond = if xi > l { xi - l } else { 0.0 };
        let slope = t * self.per_length;
        (0.5 * t * slope + beyond, slope)
    }
}

impl Basis for Gimp {
    const NAME: &'static str = "gimp";
    const WIDTH: usize = 3;

    #[inline(always)]
    fn point(&self, s: f64, _: usize) -> Along {
        let nearest = (s + 0.5).floor();
        let xi = s - nearest;
        let (up, up_slope) = self.above(xi);
        let (down, down_slope) = self.above(-xi);
        Along {
            first: whole(nearest) - 1,
            values: [down, 1.0 - up - down, up],
            slopes: [-down_slope, down_slope - up_slope, up_slope],
        }
    }

    /// Linear functions, with a third node of weight zero.
    fn place(&self, s: f64, cells: usize) -> Along {
        let mut along = Linear.point(s, cells);
        if along.first as usize + 2 > cells {
            along.first -= 1;
            along.values = [0.0, along.values[0], along.values[1]];
            along.slopes = [0.0, along.slopes[0], along.slopes[1]];
        }
        along
    }
}
