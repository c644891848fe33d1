//! Quadratic B-splines centred on the nodes (Steffen, Kirby & Berzins 2008), whose gradients are
//! continuous:
//!
//! ```text
//! N = 3/4 - xi^2              |xi| <= 1/2
//!     (3/2 - |xi|)^2/2 1/2 <= |xi| <= 3/2
//! ```
//!
//! At the ends of the grid they are folded (see [`super::along`]), which makes them linear within
//! half a cell of an end; there is no knot to repeat, since nodes stay at the cells' corners.

use super::along::{Along, Basis, whole};

/// The basis: 3^D nodes a point.
#[derive(Clone, Copy, Debug)]
pub struct QuadraticBSpline;

impl Basis for QuadraticBSpline {
    const NAME: &'static str = "bspline";
    const WIDTH: usize = 3;

    #[inline(always)]
    fn point(&self, s: f64, _: usize) -> Along {
        let nearest = (s + 0.5).floor();
        let xi = s - nearest;
        let (down, up) = (0.5 - xi, 0.5 + xi);
        Along {
            first: whole(nearest) - 1,
            values: [0.5 * down * down, 0.75 - xi * xi, 0.5 * up * up],
            slopes: [-down, -2.0 * xi, up],
        }
    }
}
