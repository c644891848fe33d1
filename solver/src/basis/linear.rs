//! Linear functions, `N = 1 - |xi|` over a cell either side.

use super::along::{Along, Basis, whole};

/// The multilinear basis: 2^D nodes a point.
#[derive(Clone, Copy, Debug)]
pub struct Linear;

impl Basis for Linear {
    const NAME: &'static str = "linear";
    const WIDTH: usize = 2;

    /// A place on the upper end of the grid belongs to the last cell.
    #[inline(always)]
    fn point(&self, s: f64, cells: usize) -> Along {
        let (below, last) = (s.floor(), cells as f64 - 1.0);
        let cell = if below < last { below } else { last };
        let up = s - cell;
        Along {
            first: whole(cell),
            values: [1.0 - up, up, 0.0],
            slopes: [-1.0, 1.0, 0.0],
        }
    }
}
