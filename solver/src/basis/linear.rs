//! Multilinear shape functions, `N = prod (1 - |xi|)` over a cell.

use super::grid_basis::Basis;
use crate::grid::Grid;
use crate::tensor::Vector;

/// The multilinear basis: 2^D nodes a point.
#[derive(Clone, Copy, Debug)]
pub struct Linear;

impl Basis for Linear {
    const NAME: &'static str = "linear";
    const REACH: usize = 1;

    fn width(dimension: usize) -> usize {
        1 << dimension
    }

    #[inline]
    fn evaluate<const D: usize>(
        grid: &Grid<D>,
        x: &Vector<D>,
        nodes: &mut [u32],
        values: &mut [f64],
        gradients: &mut [Vector<D>],
    ) -> bool {
        let Some((cell, local)) = grid.locate(x) else {
            return false;
        };
        for corner in 0..1 << D {
            let mut index = cell;
            let mut value = 1.0;
            let mut gradient = grid.h.map(|h| 1.0 / h);
            for a in 0..D {
                let up = corner >> a & 1 == 1;
                let n = if up { local[a] } else { 1.0 - local[a] };
                let sign = if up { 1.0 } else { -1.0 };
                index[a] += usize::from(up);
                value *= n;
                for (b, g) in gradient.iter_mut().enumerate() {
                    *g *= if a == b { sign } else { n };
                }
            }
            nodes[corner] = grid.node(index) as u32;
            values[corner] = value;
            gradients[corner] = gradient;
        }
        true
    }
}
