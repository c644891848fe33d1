//! The background grid: equal cells, nodes numbered with x fastest.

use crate::tensor::Vector;

/// A regular grid of equal cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<const D: usize> {
    /// Node with the smallest coordinates (m).
    pub origin: Vector<D>,
    /// Edges of a cell (m).
    pub h: Vector<D>,
    /// Cells along each axis.
    pub cells: [usize; D],
}

impl<const D: usize> Grid<D> {
    /// Nodes along an axis.
    pub fn nodes_along(&self, axis: usize) -> usize {
        self.cells[axis] + 1
    }

    /// All nodes.
    pub fn node_count(&self) -> usize {
        (0..D).map(|a| self.nodes_along(a)).product()
    }

    /// Number of the node at the lattice place `index`.
    #[inline]
    pub fn node(&self, index: [usize; D]) -> usize {
        let mut number = 0;
        for axis in (0..D).rev() {
            number = number * (self.cells[axis] + 1) + index[axis];
        }
        number
    }

    /// Lattice place of a node.
    #[inline]
    pub fn lattice(&self, mut node: usize) -> [usize; D] {
        let mut index = [0; D];
        for axis in 0..D {
            let n = self.cells[axis] + 1;
            index[axis] = node % n;
            node /= n;
        }
        index
    }

    /// Coordinates of a node (m).
    pub fn node_place(&self, node: usize) -> Vector<D> {
        let index = self.lattice(node);
        std::array::from_fn(|a| self.origin[a] + self.h[a] * index[a] as f64)
    }

    /// The cell that holds `x` with the local coordinates 0..1 in it; a place on the upper face of
    /// the grid belongs to the last cell. `None` outside the grid.
    #[inline]
    pub fn locate(&self, x: &Vector<D>) -> Option<([usize; D], Vector<D>)> {
        let mut cell = [0; D];
        let mut local = [0.0; D];
        for a in 0..D {
            let s = (x[a] - self.origin[a]) / self.h[a];
            if !(s >= 0.0 && s <= self.cells[a] as f64) {
                return None;
            }
            let c = (s as usize).min(self.cells[a] - 1);
            cell[a] = c;
            local[a] = s - c as f64;
        }
        Some((cell, local))
    }

    /// Order of elimination of the nodes by geometric nested dissection: halves first, the
    /// separating plane of nodes (`reach` planes thick) last.
    ///
    /// Separators as thick as the basis couples keep the halves independent. (George 1973; on
    /// regular grids it beats general orderings in time and fill.)
    pub fn nested_dissection(&self, reach: usize) -> Vec<u32> {
        let mut order = Vec::with_capacity(self.node_count());
        let upper: [usize; D] = std::array::from_fn(|a| self.nodes_along(a));
        self.dissect([0; D], upper, reach, &mut order);
        order
    }

    fn dissect(&self, lower: [usize; D], upper: [usize; D], reach: usize, order: &mut Vec<u32>) {
        let size: [usize; D] = std::array::from_fn(|a| upper[a] - lower[a]);
        let count: usize = size.iter().product();
        let axis = (0..D).max_by_key(|&a| size[a]).unwrap_or(0);
        if count <= 12 || size[axis] < 2 * reach + 1 {
            self.list(lower, upper, order);
            return;
        }
        let cut = lower[axis] + (size[axis] - reach) / 2;
        let (mut first, mut second) = (upper, lower);
        first[axis] = cut;
        second[axis] = cut + reach;
        self.dissect(lower, first, reach, order);
        self.dissect(second, upper, reach, order);
        let (mut from, mut to) = (lower, upper);
        from[axis] = cut;
        to[axis] = cut + reach;
        self.list(from, to, order);
    }

    /// Appends the nodes of a box, x fastest.
    fn list(&self, lower: [usize; D], upper: [usize; D], order: &mut Vec<u32>) {
        let count: usize = (0..D).map(|a| upper[a] - lower[a]).product();
        let mut index = lower;
        for _ in 0..count {
            order.push(self.node(index) as u32);
            for a in 0..D {
                index[a] += 1;
                if index[a] < upper[a] {
                    break;
                }
                index[a] = lower[a];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid<2> {
        Grid {
            origin: [-1.0, 2.0],
            h: [0.5; 2],
            cells: [7, 4],
        }
    }

    #[test]
    fn numbering_round_trips() {
        let g = grid();
        for node in 0..g.node_count() {
            assert_eq!(g.node(g.lattice(node)), node);
        }
        assert_eq!(g.node_place(g.node([2, 1])), [0.0, 2.5]);
    }

    #[test]
    fn places_on_the_upper_face_belong_to_the_last_cell() {
        let g = grid();
        assert_eq!(g.locate(&[2.5, 4.0]), Some(([6, 3], [1.0, 1.0])));
        assert_eq!(g.locate(&[2.6, 4.0]), None);
        assert_eq!(g.locate(&[f64::NAN, 3.0]), None);
    }

    #[test]
    fn dissection_is_a_permutation() {
        for reach in [1, 2] {
            let mut order = Grid {
                origin: [0.0; 3],
                h: [1.0; 3],
                cells: [6, 9, 3],
            }
            .nested_dissection(reach);
            order.sort_unstable();
            assert!(order.iter().enumerate().all(|(i, &n)| i == n as usize));
        }
    }
}
