//! Shape functions of a block of points, made on the fly: the same as those of
//! [`crate::basis::along::evaluate`], by axis instead of by node, and folded likewise at the ends of
//! the grid.

use crate::basis::along::{Along, Basis, WIDEST, fold};
use crate::grid::Grid;
use crate::points::BLOCK;
use crate::tensor::Vector;
use pulp::{Arch, NullaryFnOnce};

/// What the points of a block see along each axis.
#[derive(Debug)]
pub(super) struct Stencils<const D: usize> {
    /// The first node of each point.
    pub base: [u32; BLOCK],
    /// The first node along each axis.
    first: [[i32; BLOCK]; D],
    /// From the point to its first node (m), by axis.
    pub away: [[f64; BLOCK]; D],
    /// Values, by axis and node along it.
    pub values: [[[f64; BLOCK]; WIDEST]; D],
    /// Slopes (1/m).
    pub slopes: [[[f64; BLOCK]; WIDEST]; D],
}

impl<const D: usize> Stencils<D> {
    /// Room for a block.
    pub fn new() -> Self {
        Stencils {
            base: [0; BLOCK],
            first: [[0; BLOCK]; D],
            away: [[0.0; BLOCK]; D],
            values: [[[0.0; BLOCK]; WIDEST]; D],
            slopes: [[[0.0; BLOCK]; WIDEST]; D],
        }
    }

    /// Fills in the points at `places`, a block at most. `Err(p)` names the first beyond the grid.
    pub fn fill<B: Basis>(
        &mut self,
        arch: Arch,
        basis: &B,
        grid: &Grid<D>,
        places: &[Vector<D>],
    ) -> Result<(), usize> {
        let out = &mut *self;
        let inside = arch.dispatch(Fill {
            out,
            basis,
            grid,
            places,
        });
        if inside {
            return Ok(());
        }
        Err(places
            .iter()
            .position(|x| grid.locate(x).is_none())
            .unwrap_or(0))
    }
}

/// The work of [`Stencils::fill`]; false when a point is beyond the grid.
struct Fill<'a, B, const D: usize> {
    out: &'a mut Stencils<D>,
    basis: &'a B,
    grid: &'a Grid<D>,
    places: &'a [Vector<D>],
}

impl<B: Basis, const D: usize> NullaryFnOnce for Fill<'_, B, D> {
    type Output = bool;

    #[inline(always)]
    fn call(self) -> bool {
        let Fill {
            out,
            basis,
            grid,
            places,
        } = self;
        let n = places.len().min(BLOCK);
        let (mut inside, mut stride) = (true, 1);
        out.base = [0; BLOCK];
        for a in 0..D {
            let cells = grid.cells[a];
            let (origin, h, end) = (grid.origin[a], grid.h[a], cells as f64);
            let per_h = 1.0 / h;
            let last = cells as i32 + 1 - B::WIDTH as i32;
            let mut whole = true;
            for p in 0..n {
                let s = (places[p][a] - origin) / h;
                inside &= (s >= 0.0) & (s <= end);
                let along = basis.point(s, cells);
                whole &= (along.first >= 0) & (along.first <= last);
                out.first[a][p] = along.first;
                for k in 0..B::WIDTH {
                    out.values[a][k][p] = along.values[k];
                    out.slopes[a][k][p] = along.slopes[k] * per_h;
                }
            }
            if !whole {
                for p in 0..n {
                    out.fold(a, p, B::WIDTH, cells);
                }
            }
            for p in 0..n {
                let first = out.first[a][p];
                out.base[p] = out.base[p].wrapping_add((first * stride) as u32);
                out.away[a][p] = origin + h * f64::from(first) - places[p][a];
            }
            stride *= cells as i32 + 1;
        }
        inside
    }
}

impl<const D: usize> Stencils<D> {
    /// Folds what point `p` sees along axis `a`.
    fn fold(&mut self, a: usize, p: usize, width: usize, cells: usize) {
        let along = Along {
            first: self.first[a][p],
            values: self.values[a].map(|n| n[p]),
            slopes: self.slopes[a].map(|n| n[p]),
        };
        let along = fold(along, width, cells);
        self.first[a][p] = along.first;
        for k in 0..WIDEST {
            self.values[a][k][p] = along.values[k];
            self.slopes[a][k][p] = along.slopes[k];
        }
    }
}
