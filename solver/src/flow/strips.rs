//! Strips of rows of cells, in two colours: strips of one colour write to nodes of their own.
//!
//! A row is what shares the last coordinate: a row of cells in 2D, a slab in 3D. Points of a strip of
//! H rows may stray by a row to either side before they are sorted again, and see at most three rows
//! of nodes, so that they write to at most H + 4 rows of nodes, from one row before the strip; with
//! H = 4, strips s and s + 2 have none in common.

use super::NodeSums;
use crate::grid::Grid;
use crate::tensor::Vector;
use std::ops::Range;

/// Rows of a strip.
const ROWS: usize = 4;

/// The strips of a grid.
#[derive(Clone, Debug)]
pub(super) struct Strips {
    /// Nodes of a row.
    row: usize,
    /// Rows of nodes.
    rows: usize,
    /// Where the strips' points start; one more for the end.
    pub points: Vec<usize>,
}

impl Strips {
    /// For points that see `width` nodes along each axis.
    pub fn new<const D: usize>(grid: &Grid<D>, width: usize) -> Self {
        let row = (0..D - 1).map(|a| grid.nodes_along(a)).product();
        let rows = grid.nodes_along(D - 1);
        let first_nodes = rows + 1 - width;
        Strips {
            row,
            rows,
            points: vec![0; first_nodes.div_ceil(ROWS) + 1],
        }
    }

    /// Number of strips.
    pub fn len(&self) -> usize {
        self.points.len() - 1
    }

    /// Takes over where the points of each first node start.
    pub fn find(&mut self, start: &[u32]) {
        for (s, first) in self.points.iter_mut().enumerate() {
            let node = (s * ROWS * self.row).min(start.len() - 1);
            *first = start[node] as usize;
        }
    }

    /// Between which coordinates along the last axis, in cells, points of strip `s` may be until they
    /// are sorted, for a basis of so many nodes along an axis.
    pub fn leash(&self, s: usize, width: usize) -> Range<f64> {
        // wide functions change nodes in the middle of cells
        let shift = 0.5 * (width as f64 - 2.0);
        // a little less than a row, for rounding
        let slack = 1.0 - 1e-6;
        let lower = (s * ROWS) as f64 + shift - slack;
        let upper = ((s + 1) * ROWS) as f64 + shift + slack;
        let first = if s == 0 { f64::NEG_INFINITY } else { lower };
        let last = s + 1 == self.len();
        first..if last { f64::INFINITY } else { upper }
    }

    /// Number of strips of a colour.
    pub fn of_colour(&self, colour: usize) -> usize {
        (self.len() + 1 - colour) / 2
    }

    /// The first node that strip `k` of a colour may write to.
    pub fn first_node(&self, colour: usize, k: usize) -> usize {
        let strip = 2 * k + colour;
        (strip * ROWS).saturating_sub(1).min(self.rows) * self.row
    }
}

/// Sums of consecutive nodes.
#[derive(Debug)]
pub(super) struct Sums<'a, const D: usize> {
    /// Number of the first node.
    pub first: usize,
    pub momentum: &'a mut [Vector<D>],
    /// Masses and forces, where they are asked for.
    pub others: Option<(&'a mut [f64], &'a mut [Vector<D>])>,
}

impl<'a, const D: usize> Sums<'a, D> {
    /// All sums.
    pub fn all(out: &'a mut NodeSums<D>) -> Self {
        Sums {
            first: 0,
            momentum: &mut out.momentum,
            others: Some((&mut out.mass, &mut out.force)),
        }
    }

    /// The same for less long.
    pub fn again(&mut self) -> Sums<'_, D> {
        Sums {
            first: self.first,
            momentum: self.momentum,
            others: self.others.as_mut().map(|(m, f)| (&mut **m, &mut **f)),
        }
    }

    /// The nodes before `node` and the others.
    pub fn split_at(self, node: usize) -> (Self, Self) {
        let n = node - self.first;
        let (momentum, momenta) = self.momentum.split_at_mut(n);
        let (others, rest) = match self.others {
            None => (None, None),
            Some((mass, force)) => {
                let (mass, masses) = mass.split_at_mut(n);
                let (force, forces) = force.split_at_mut(n);
                (Some((mass, force)), Some((masses, forces)))
            }
        };
        (
            Sums {
                first: self.first,
                momentum,
                others,
            },
            Sums {
                first: node,
                momentum: momenta,
                others: rest,
            },
        )
    }
}

/// Works on each of some strips with its own part of the data; with the threads of the pool around
/// the call when `shared`. The failure of the first strip that failed is returned.
pub(super) fn each<P: Send, E: Send>(
    strips: Range<usize>,
    part: P,
    shared: bool,
    split: &(impl Fn(P, usize) -> (P, P) + Sync),
    work: &(impl Fn(usize, P) -> Result<(), E> + Sync),
) -> Result<(), E> {
    match strips.len() {
        0 => Ok(()),
        1 => work(strips.start, part),
        n => {
            let middle = strips.start + n / 2;
            let (lower, upper) = split(part, middle);
            let first = || each(strips.start..middle, lower, shared, split, work);
            let second = || each(middle..strips.end, upper, shared, split, work);
            if shared {
                let (first, second) = rayon::join(first, second);
                first.and(second)
            } else {
                first().and_then(|()| second())
            }
        }
    }
}
