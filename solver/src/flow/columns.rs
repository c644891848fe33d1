//! Columns of points, their parts, and their order.

use super::ahead::fetch;
use crate::tensor::{Matrix, Vector};
use std::ops::Range;

/// What points remember, one entry a point in each column; no gradients without the affine transfer.
#[derive(Debug)]
pub(super) struct Columns<S, const D: usize> {
    /// Places (m).
    pub place: Vec<Vector<D>>,
    /// Velocities (m/s).
    pub velocity: Vec<Vector<D>>,
    /// Gradients of velocity (1/s).
    pub gradient: Vec<Matrix<D>>,
    /// States of the law.
    pub state: Vec<S>,
}

/// Asks the memory for a range of points, column by column.
#[inline]
fn fetch_points<S, const D: usize>(
    place: &[Vector<D>],
    velocity: &[Vector<D>],
    gradient: &[Matrix<D>],
    state: &[S],
    range: Range<usize>,
) {
    fetch(place, range.clone());
    fetch(velocity, range.clone());
    fetch(gradient, range.clone());
    fetch(state, range);
}

/// Consecutive points.
#[derive(Debug)]
pub(super) struct Part<'a, S, const D: usize> {
    pub place: &'a mut [Vector<D>],
    pub velocity: &'a mut [Vector<D>],
    pub gradient: &'a mut [Matrix<D>],
    pub state: &'a mut [S],
}

impl<'a, S, const D: usize> Part<'a, S, D> {
    /// Asks the memory for the points in `range`, as far as there are such.
    #[inline]
    pub fn fetch(&self, range: Range<usize>) {
        fetch_points(self.place, self.velocity, self.gradient, self.state, range);
    }

    /// The first `n` points and the others.
    pub fn split_at(self, n: usize) -> (Self, Self) {
        let (place, places) = self.place.split_at_mut(n);
        let (velocity, velocities) = self.velocity.split_at_mut(n);
        let (gradient, gradients) = self.gradient.split_at_mut(n.min(self.gradient.len()));
        let (state, states) = self.state.split_at_mut(n);
        (
            Part {
                place,
                velocity,
                gradient,
                state,
            },
            Part {
                place: places,
                velocity: velocities,
                gradient: gradients,
                state: states,
            },
        )
    }
}

/// What sorting needs besides the columns.
#[derive(Debug, Default)]
pub(super) struct Sorting<S, const D: usize> {
    /// Key of each point: the first node that it sees.
    pub key: Vec<u32>,
    /// For each node, where its points start; one more for the end.
    pub start: Vec<u32>,
    /// For each place in the new order, the point that comes there.
    order: Vec<u32>,
    vectors: Vec<Vector<D>>,
    matrices: Vec<Matrix<D>>,
    states: Vec<S>,
}

impl<S: Copy, const D: usize> Columns<S, D> {
    /// Asks the memory for the points in `range`, as far as there are such.
    #[inline]
    pub fn fetch(&self, range: Range<usize>) {
        fetch_points(
            &self.place,
            &self.velocity,
            &self.gradient,
            &self.state,
            range,
        );
    }

    /// All points as one part.
    pub fn all(&mut self) -> Part<'_, S, D> {
        Part {
            place: &mut self.place,
            velocity: &mut self.velocity,
            gradient: &mut self.gradient,
            state: &mut self.state,
        }
    }

    /// Orders the points by their keys, all below `nodes`, without changing the order among equals.
    pub fn sort(&mut self, nodes: usize, sorting: &mut Sorting<S, D>) {
        let Sorting {
            key,
            start,
            order,
            vectors,
            matrices,
            states,
        } = sorting;
        start.clear();
        start.resize(nodes + 1, 0);
        for &k in key.iter() {
            start[k as usize + 1] += 1;
        }
        for k in 0..nodes {
            start[k + 1] += start[k];
        }
        order.resize(key.len(), 0);
        for (p, &k) in key.iter().enumerate() {
            let to = &mut start[k as usize];
            order[*to as usize] = p as u32;
            *to += 1;
        }
        // each start is now the next one's
        start.rotate_right(1);
        start[0] = 0;
        permute(order, &mut self.place, vectors);
        permute(order, &mut self.velocity, vectors);
        permute(order, &mut self.state, states);
        if !self.gradient.is_empty() {
            permute(order, &mut self.gradient, matrices);
        }
    }
}

/// Brings a column into the new order; the old one stays in `spare`.
fn permute<T: Copy>(order: &[u32], column: &mut Vec<T>, spare: &mut Vec<T>) {
    spare.clear();
    spare.extend(order.iter().map(|&from| column[from as usize]));
    std::mem::swap(column, spare);
}
