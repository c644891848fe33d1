//! Shape functions as products of functions of one coordinate, folded at the ends of the grid.
//!
//! Wide functions reach over the ends of the grid, where there are no nodes. What they would give to a
//! node beyond the end goes to the two before it, as if the field went on straight:
//!
//! ```text
//! u_-1 = 2 u_0 - u_1      so      N_0 += 2 N_-1,   N_1 -= N_-1
//! ```
//!
//! The folded functions are a partition of unity, reproduce linear fields, stay positive inside and
//! are 1 and 0 at the end itself, so that what holds or drives the nodes of a side holds or drives the
//! side. Frozen material ends where its grid ends; a free side of moving material has empty cells
//! beyond it, and its functions are whole, but that nodes to which points give next to nothing get
//! nothing: see [`super::faint`].

use crate::grid::Grid;
use crate::tensor::Vector;

/// Most nodes that a place sees along an axis.
pub const WIDEST: usize = 3;

/// The nodes that a place sees along an axis.
#[derive(Clone, Copy, Debug)]
pub struct Along {
    /// The first node; may lie one beyond the ends of the grid.
    pub first: i32,
    /// Values of the functions of this node and the next ones.
    pub values: [f64; WIDEST],
    /// Their derivatives (1 a cell).
    pub slopes: [f64; WIDEST],
}

/// Shape functions of one coordinate, alike at all nodes.
pub trait Basis: Send + 'static {
    /// Name as in scenes.
    const NAME: &'static str;
    /// Nodes along an axis that a point sees.
    const WIDTH: usize;

    /// At `s`, in cells from the grid's first node, of an axis of `cells` cells: what a point sees. Made
    /// for loops over points: without branches, and of no meaning beyond the grid.
    fn point(&self, s: f64, cells: usize) -> Along;

    /// What a place without extent sees.
    fn place(&self, s: f64, cells: usize) -> Along {
        self.point(s, cells)
    }
}

/// `x`, a whole number of a size that grids have, as an integer.
///
/// Adding 1.5 2^52 leaves it in the lowest bits. `as` would saturate, which no vector instruction does.
#[inline(always)]
pub(crate) fn whole(x: f64) -> i32 {
    const SHIFT: f64 = 1.5 * (1u64 << 52) as f64;
    (x + SHIFT).to_bits() as i32
}

/// Gives what belongs to nodes beyond the ends of an axis of `cells` cells to those within.
#[inline]
pub(crate) fn fold(mut along: Along, width: usize, cells: usize) -> Along {
    if along.first < 0 {
        for n in [&mut along.values, &mut along.slopes] {
            *n = [n[1] + 2.0 * n[0], n[2] - n[0], 0.0];
        }
        along.first = 0;
    } else if along.first + width as i32 - 1 > cells as i32 {
        for n in [&mut along.values, &mut along.slopes] {
            *n = [0.0, n[0] - n[2], n[1] + 2.0 * n[2]];
        }
        along.first -= 1;
    }
    along
}

/// Nodes, values and gradients at `x`, products of what `along` gives for each axis; false when `x`
/// is outside the grid.
#[inline]
pub(super) fn evaluate<const D: usize>(
    grid: &Grid<D>,
    width: usize,
    along: impl Fn(f64, usize) -> Along,
    x: &Vector<D>,
    stencil: (&mut [u32], &mut [f64], &mut [Vector<D>]),
) -> bool {
    let (nodes, values, gradients) = stencil;
    let mut axes = [Along {
        first: 0,
        values: [0.0; WIDEST],
        slopes: [0.0; WIDEST],
    }; D];
    for a in 0..D {
        let s = (x[a] - grid.origin[a]) / grid.h[a];
        if !(s >= 0.0 && s <= grid.cells[a] as f64) {
            return false;
        }
        axes[a] = fold(along(s, grid.cells[a]), width, grid.cells[a]);
    }
    for (k, ((node, value), gradient)) in nodes.iter_mut().zip(values).zip(gradients).enumerate() {
        let mut rest = k;
        let mut index = [0; D];
        *value = 1.0;
        *gradient = grid.h.map(|h| 1.0 / h);
        for a in 0..D {
            let i = rest % width;
            rest /= width;
            index[a] = axes[a].first as usize + i;
            let n = axes[a].values[i];
            *value *= n;
            for (b, g) in gradient.iter_mut().enumerate() {
                *g *= if a == b { axes[a].slopes[i] } else { n };
            }
        }
        *node = grid.node(index) as u32;
    }
    true
}
