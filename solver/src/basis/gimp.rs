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

use super::along::{Along, Basis};
use super::linear::Linear;

/// The basis: 3^D nodes a point.
#[derive(Clone, Copy, Debug)]
pub struct Gimp {
    /// Half-length of a point in cells, at most 1/2.
    half: f64,
}

impl Gimp {
    /// For cells filled with `per_axis` points along each axis.
    pub fn new(per_axis: usize) -> Self {
        Gimp {
            half: 0.5 / per_axis as f64,
        }
    }

    /// Value and slope of the function at a distance of `xi` cells.
    #[inline]
    fn function(&self, xi: f64) -> (f64, f64) {
        let (l, away) = (self.half, xi.abs());
        if away >= 1.0 + l {
            (0.0, 0.0)
        } else if away > 1.0 - l {
            let rest = 1.0 + l - away;
            (rest * rest / (4.0 * l), -xi.signum() * rest / (2.0 * l))
        } else if away >= l {
            (1.0 - away, -xi.signum())
        } else {
            (1.0 - (xi * xi + l * l) / (2.0 * l), -xi / l)
        }
    }
}

impl Basis for Gimp {
    const NAME: &'static str = "gimp";
    const WIDTH: usize = 3;

    #[inline]
    fn point(&self, s: f64, cells: usize) -> Along {
        let nearest = (s + 0.5).floor().min(cells as f64);
        let (mut values, mut slopes) = ([0.0; 3], [0.0; 3]);
        for (k, (value, slope)) in values.iter_mut().zip(&mut slopes).enumerate() {
            (*value, *slope) = self.function(s - (nearest + k as f64 - 1.0));
        }
        Along {
            first: nearest as i32 - 1,
            values,
            slopes,
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
