//! Sparse matrix of D x D blocks, a row a node.

use crate::tensor::{Matrix, Vector};
use std::sync::Arc;

/// Which nodes couple: compressed rows, columns ascending.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pattern {
    /// Start of each row in `columns`; one more than there are rows.
    pub starts: Vec<usize>,
    /// Column of each block.
    pub columns: Vec<u32>,
}

impl Pattern {
    /// Place of the block (row, column).
    ///
    /// # Panics
    /// When the two do not couple, a bug of the caller.
    pub fn slot(&self, row: usize, column: usize) -> usize {
        let start = self.starts[row];
        let columns = &self.columns[start..self.starts[row + 1]];
        let found = columns.binary_search(&(column as u32));
        start + found.expect("nodes of one stencil couple by the pattern's construction")
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }
}

/// Values on a [`Pattern`].
#[derive(Clone, Debug)]
pub struct BlockMatrix<const D: usize> {
    /// Where the blocks are.
    pub pattern: Arc<Pattern>,
    /// The blocks, in the pattern's order.
    pub blocks: Vec<Matrix<D>>,
    /// Work space of assembly for the blocks of one stencil.
    pub(crate) scratch: Vec<Matrix<D>>,
}

impl<const D: usize> BlockMatrix<D> {
    /// Zero matrix.
    pub fn zeros(pattern: Arc<Pattern>) -> Self {
        let blocks = vec![[[0.0; D]; D]; pattern.columns.len()];
        BlockMatrix {
            pattern,
            blocks,
            scratch: Vec::new(),
        }
    }

    /// Without blocks, for a matrix that is never assembled.
    pub fn empty(pattern: Arc<Pattern>) -> Self {
        BlockMatrix {
            pattern,
            blocks: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// Sets all values to zero.
    pub fn clear(&mut self) {
        self.blocks.fill([[0.0; D]; D]);
    }

    /// Adds `value` to block (row, column).
    pub fn add(&mut self, row: usize, column: usize, value: &Matrix<D>) {
        let slot = self.pattern.slot(row, column);
        add_into(&mut self.blocks[slot], value);
    }

    /// Adds a matrix of the same pattern.
    pub fn add_matrix(&mut self, other: &Self) {
        for (a, b) in self.blocks.iter_mut().zip(&other.blocks) {
            add_into(a, b);
        }
    }

    /// Adds a diagonal, one entry an unknown.
    pub fn add_diagonal(&mut self, scale: f64, diagonal: &[Vector<D>]) {
        for (row, d) in diagonal.iter().enumerate() {
            let slot = self.pattern.slot(row, row);
            for i in 0..D {
                self.blocks[slot][i][i] += scale * d[i];
            }
        }
    }

    /// The diagonal.
    pub fn diagonal(&self, out: &mut [Vector<D>]) {
        for (row, d) in out.iter_mut().enumerate() {
            let block = &self.blocks[self.pattern.slot(row, row)];
            for i in 0..D {
                d[i] = block[i][i];
            }
        }
    }

    /// `y = A x`.
    pub fn apply(&self, x: &[Vector<D>], y: &mut [Vector<D>]) {
        for (row, out) in y.iter_mut().enumerate() {
            let range = self.pattern.starts[row]..self.pattern.starts[row + 1];
            let mut sum = [0.0; D];
            for (block, &column) in self.blocks[range.clone()]
                .iter()
                .zip(&self.pattern.columns[range])
            {
                let v = &x[column as usize];
                for i in 0..D {
                    for j in 0..D {
                        sum[i] += block[i][j] * v[j];
                    }
                }
            }
            *out = sum;
        }
    }
}

/// `a += b`.
#[inline]
pub fn add_into<const D: usize>(a: &mut Matrix<D>, b: &Matrix<D>) {
    for i in 0..D {
        for j in 0..D {
            a[i][j] += b[i][j];
        }
    }
}
