//! Sparse Cholesky factorisation by faer, with geometric nested dissection.
//!
//! The only place that names faer. Symbolic work is done once for a set of free unknowns; numeric
//! factorisations reuse factor and work space.

use super::block_matrix::BlockMatrix;
use crate::tensor::Vector;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering,
    factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};

/// A factorisation with its structure.
pub struct Cholesky<const D: usize> {
    held: Vec<[bool; D]>,
    /// Free unknowns: (node, direction) of each row of the reduced system.
    unknowns: Vec<(u32, u8)>,
    structure: SymbolicSparseColMat<usize>,
    /// For each stored value of the lower triangle, its block and the place within.
    sources: Vec<(u32, u8, u8)>,
    values: Vec<f64>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    memory: MemBuffer,
    right: Vec<f64>,
}

impl<const D: usize> std::fmt::Debug for Cholesky<D> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Cholesky")
            .field("unknowns", &self.unknowns.len())
            .finish_non_exhaustive()
    }
}

impl<const D: usize> Cholesky<D> {
    /// Analyses the structure of `matrix` on the unknowns that are not `held`, with the nodes
    /// eliminated in `order`.
    ///
    /// # Errors
    /// What the symbolic factorisation says, as text.
    pub fn new(matrix: &BlockMatrix<D>, held: &[[bool; D]], order: &[u32]) -> Result<Self, String> {
        // the reduced system is numbered in the order of elimination
        let mut number = vec![[usize::MAX; D]; held.len()];
        let mut unknowns = Vec::new();
        for &node in order {
            for i in 0..D {
                if !held[node as usize][i] {
                    number[node as usize][i] = unknowns.len();
                    unknowns.push((node, i as u8));
                }
            }
        }
        let (mut starts, mut rows, mut sources) = (vec![0], Vec::new(), Vec::new());
        let mut column_entries = Vec::new();
        for (column, &(node, j)) in unknowns.iter().enumerate() {
            column_entries.clear();
            let node = node as usize;
            for slot in matrix.pattern.starts[node]..matrix.pattern.starts[node + 1] {
                let other = matrix.pattern.columns[slot] as usize;
                for i in 0..D {
                    let row = number[other][i];
                    if row != usize::MAX && row >= column {
                        // symmetric: the block (node, other) transposed is (other, node)
                        column_entries.push((row, (slot as u32, j, i as u8)));
                    }
                }
            }
            column_entries.sort_unstable();
            for &(row, source) in &column_entries {
                rows.push(row);
                sources.push(source);
            }
            starts.push(rows.len());
        }
        let n = unknowns.len();
        let structure = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let identity: Vec<usize> = (0..n).collect();
        let symbolic = factorize_symbolic_cholesky(
            SymbolicSparseColMatRef::from(structure.as_ref()),
            Side::Lower,
            SymmetricOrdering::Custom(PermRef::new_checked(&identity, &identity, n)),
            CholeskySymbolicParams::default(),
        )
        .map_err(|e| format!("{e:?}"))?;
        let scratch = symbolic
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Ok(Cholesky {
            held: held.to_vec(),
            values: vec![0.0; sources.len()],
            factor: vec![0.0; symbolic.len_val()],
            memory: MemBuffer::try_new(scratch).map_err(|_| "out of memory".to_owned())?,
            right: vec![0.0; n],
            unknowns,
            structure,
            sources,
            symbolic,
        })
    }

    /// Does it serve for these held unknowns?
    pub fn serves(&self, held: &[[bool; D]]) -> bool {
        self.held == held
    }

    /// Factorises the values of `matrix`.
    ///
    /// # Errors
    /// The pivot that is not positive, as text.
    pub fn factorise(&mut self, matrix: &BlockMatrix<D>) -> Result<(), String> {
        for (value, &(slot, i, j)) in self.values.iter_mut().zip(&self.sources) {
            *value = matrix.blocks[slot as usize][i as usize][j as usize];
        }
        if self.unknowns.is_empty() {
            return Ok(());
        }
        let lower = SparseColMatRef::new(self.structure.as_ref(), self.values.as_slice());
        self.symbolic
            .factorize_numeric_llt(
                &mut self.factor,
                lower,
                Side::Lower,
                LltRegularization::default(),
                Par::Seq,
                MemStack::new(&mut self.memory),
                Default::default(),
            )
            .map(|_| ())
            .map_err(|e| format!("{e:?}"))
    }

    /// Solves with the last factorisation; held unknowns of `x` become zero.
    pub fn solve(&mut self, b: &[Vector<D>], x: &mut [Vector<D>]) {
        for (value, &(node, i)) in self.right.iter_mut().zip(&self.unknowns) {
            *value = b[node as usize][i as usize];
        }
        let n = self.right.len();
        if n > 0 {
            LltRef::<usize, f64>::new(&self.symbolic, &self.factor).solve_in_place_with_conj(
                Conj::No,
                MatMut::from_column_major_slice_mut(&mut self.right, n, 1),
                Par::Seq,
                MemStack::new(&mut self.memory),
            );
        }
        x.fill([0.0; D]);
        for (value, &(node, i)) in self.right.iter().zip(&self.unknowns) {
            x[node as usize][i as usize] = *value;
        }
    }

    /// Memory of factor and work space in bytes.
    pub fn bytes(&self) -> usize {
        size_of::<f64>() * (self.factor.len() + self.values.len()) + self.memory.len()
    }
}
