//! Discretisation by shape functions on the background grid: kept nodes, values and gradients of all
//! points. Nodes to which points give next to nothing get nothing: see [`super::faint`].

use super::along::{Basis, evaluate};
use super::faint::Faint;
use super::{Discretisation, Sample};
use crate::grid::Grid;
use crate::linear::block_matrix::{BlockMatrix, Pattern, add_into};
use crate::tensor::{Matrix, Tensor4, Vector, dot};
use std::ops::Range;
use std::sync::Arc;

/// Nodes that a point sees at most: three along each of three axes.
const MOST_NODES: usize = 27;

/// Keeps nodes, values and gradients of all points, `width` a point.
#[derive(Debug)]
pub struct GridDiscretisation<B, const D: usize> {
    grid: Grid<D>,
    basis: B,
    faint: Faint,
    pattern: Arc<Pattern>,
    nodes: Vec<u32>,
    values: Vec<f64>,
    gradients: Vec<Vector<D>>,
}

impl<B: Basis, const D: usize> GridDiscretisation<B, D> {
    /// Nodes couple over so many cells.
    const REACH: usize = B::WIDTH - 1;
    /// Nodes that a point sees.
    const NODES: usize = B::WIDTH.pow(D as u32);

    /// On `grid`, which has at least as many nodes along each axis as a point sees, its full cells with
    /// `per_cell` points; without points yet.
    pub fn new(grid: Grid<D>, basis: B, per_cell: usize) -> Self {
        let pattern = Arc::new(neighbours(&grid, Self::REACH));
        GridDiscretisation {
            grid,
            basis,
            faint: Faint::new(per_cell),
            pattern,
            nodes: Vec::new(),
            values: Vec::new(),
            gradients: Vec::new(),
        }
    }

    #[inline]
    fn stencil(&self, p: usize) -> (&[u32], &[f64], &[Vector<D>]) {
        let w = Self::NODES;
        let range = p * w..(p + 1) * w;
        (
            &self.nodes[range.clone()],
            &self.values[range.clone()],
            &self.gradients[range],
        )
    }

    /// Adds the blocks of one stencil and clears them.
    fn flush(&self, nodes: &[u32], local: &mut [Matrix<D>], out: &mut BlockMatrix<D>) {
        for (i, &row) in nodes.iter().enumerate() {
            let (mut slot, mut before) = (usize::MAX, u32::MAX - 1);
            for (j, &column) in nodes.iter().enumerate() {
                // neighbours along x stand side by side in a row
                slot = if column == before + 1 {
                    slot + 1
                } else {
                    self.pattern.slot(row as usize, column as usize)
                };
                before = column;
                add_into(&mut out.blocks[slot], &local[i * nodes.len() + j]);
            }
        }
        local.fill([[0.0; D]; D]);
    }
}

impl<B: Basis, const D: usize> Discretisation<D> for GridDiscretisation<B, D> {
    fn name(&self) -> &'static str {
        B::NAME
    }

    fn node_count(&self) -> usize {
        self.grid.node_count()
    }

    fn pattern(&self) -> Arc<Pattern> {
        Arc::clone(&self.pattern)
    }

    fn elimination_order(&self) -> Vec<u32> {
        self.grid.nested_dissection(Self::REACH)
    }

    fn place(&mut self, places: &[Vector<D>]) -> Result<(), usize> {
        let w = Self::NODES;
        self.nodes.resize(places.len() * w, 0);
        self.values.resize(places.len() * w, 0.0);
        self.gradients.resize(places.len() * w, [0.0; D]);
        self.replace(places)
    }

    fn replace(&mut self, places: &[Vector<D>]) -> Result<(), usize> {
        let w = Self::NODES;
        let stencils = self
            .nodes
            .chunks_exact_mut(w)
            .zip(self.values.chunks_exact_mut(w))
            .zip(self.gradients.chunks_exact_mut(w));
        for (p, (((nodes, values), gradients), x)) in stencils.zip(places).enumerate() {
            let along = |s, cells| self.basis.point(s, cells);
            if !evaluate(&self.grid, B::WIDTH, along, x, (nodes, values, gradients)) {
                return Err(p);
            }
        }
        if B::WIDTH == 3 {
            let moved = ..places.len() * w;
            self.faint
                .find(self.grid.node_count(), &self.nodes, &self.values);
            let (nodes, values) = (&self.nodes[moved], &mut self.values[moved]);
            self.faint
                .unburden(nodes, values, &mut self.gradients[moved]);
        }
        Ok(())
    }

    fn sample_into(&self, x: &Vector<D>, out: &mut Sample) {
        let w = Self::NODES;
        out.nodes.resize(w, 0);
        out.weights.resize(w, 0.0);
        let mut gradients = [[0.0; D]; MOST_NODES];
        let gradients = &mut gradients[..w];
        let along = |s, cells| self.basis.place(s, cells);
        let stencil = (&mut out.nodes[..], &mut out.weights[..], &mut *gradients);
        if !evaluate(&self.grid, B::WIDTH, along, x, stencil) {
            out.nodes.clear();
            out.weights.clear();
        } else if B::WIDTH == 3 {
            self.faint.unburden(&out.nodes, &mut out.weights, gradients);
        }
    }

    fn scatter_scalar(&self, block: Range<usize>, values: &[f64], out: &mut [f64]) {
        for (p, value) in block.zip(values) {
            let (nodes, n, _) = self.stencil(p);
            for (&node, &n) in nodes.iter().zip(n) {
                out[node as usize] += n * value;
            }
        }
    }

    fn scatter_vector(
        &self,
        block: Range<usize>,
        weights: &[f64],
        values: &[Vector<D>],
        out: &mut [Vector<D>],
    ) {
        for (p, (weight, value)) in block.zip(weights.iter().zip(values)) {
            let (nodes, n, _) = self.stencil(p);
            for (&node, &n) in nodes.iter().zip(n) {
                let target = &mut out[node as usize];
                for i in 0..D {
                    target[i] += n * weight * value[i];
                }
            }
        }
    }

    fn scatter_affine(
        &self,
        block: Range<usize>,
        weights: &[f64],
        values: &[Vector<D>],
        gradients: &[Matrix<D>],
        places: &[Vector<D>],
        out: &mut [Vector<D>],
    ) {
        for (q, p) in block.enumerate() {
            let (nodes, n, _) = self.stencil(p);
            for (&node, &n) in nodes.iter().zip(n) {
                let x = self.grid.node_place(node as usize);
                let away: Vector<D> = std::array::from_fn(|a| x[a] - places[q][a]);
                let target = &mut out[node as usize];
                for i in 0..D {
                    target[i] += n * weights[q] * (values[q][i] + dot(&gradients[q][i], &away));
                }
            }
        }
    }

    fn gather(&self, block: Range<usize>, field: &[Vector<D>], out: &mut [Vector<D>]) {
        for (p, out) in block.zip(out) {
            let (nodes, n, _) = self.stencil(p);
            *out = [0.0; D];
            for (&node, &n) in nodes.iter().zip(n) {
                let f = &field[node as usize];
                for i in 0..D {
                    out[i] += n * f[i];
                }
            }
        }
    }

    fn gradient(&self, block: Range<usize>, field: &[Vector<D>], out: &mut [Matrix<D>]) {
        for (p, out) in block.zip(out) {
            let (nodes, _, gradients) = self.stencil(p);
            *out = [[0.0; D]; D];
            for (&node, g) in nodes.iter().zip(gradients) {
                let f = &field[node as usize];
                for i in 0..D {
                    for j in 0..D {
                        out[i][j] += f[i] * g[j];
                    }
                }
            }
        }
    }

    fn scatter_stress(
        &self,
        block: Range<usize>,
        volumes: &[f64],
        stress: &[Matrix<D>],
        out: &mut [Vector<D>],
    ) {
        for (p, (volume, stress)) in block.zip(volumes.iter().zip(stress)) {
            let (nodes, _, gradients) = self.stencil(p);
            for (&node, g) in nodes.iter().zip(gradients) {
                let target = &mut out[node as usize];
                for i in 0..D {
                    target[i] += volume * dot(&stress[i], g);
                }
            }
        }
    }

    fn scatter_mass(&self, block: Range<usize>, weights: &[Vector<D>], out: &mut BlockMatrix<D>) {
        let w = Self::NODES;
        let mut local = std::mem::take(&mut out.scratch);
        local.resize(w * w, [[0.0; D]; D]);
        let mut last = block.start;
        for (p, weight) in block.clone().zip(weights) {
            let (nodes, n, _) = self.stencil(p);
            if nodes != self.stencil(last).0 {
                self.flush(self.stencil(last).0, &mut local, out);
            }
            last = p;
            for (i, ni) in n.iter().enumerate() {
                for (j, nj) in n.iter().enumerate() {
                    for (k, weight) in weight.iter().enumerate() {
                        local[i * w + j][k][k] += weight * ni * nj;
                    }
                }
            }
        }
        if !block.is_empty() {
            self.flush(self.stencil(last).0, &mut local, out);
        }
        out.scratch = local;
    }

    fn scatter_tangent(
        &self,
        block: Range<usize>,
        volumes: &[f64],
        moduli: &[Tensor4<D>],
        out: &mut BlockMatrix<D>,
    ) {
        let w = Self::NODES;
        let mut local = std::mem::take(&mut out.scratch);
        local.resize(w * w, [[0.0; D]; D]);
        let mut last = block.start;
        for (q, p) in block.clone().enumerate() {
            let (nodes, _, gradients) = self.stencil(p);
            if nodes != self.stencil(last).0 {
                self.flush(self.stencil(last).0, &mut local, out);
            }
            last = p;
            for (j, gj) in gradients.iter().enumerate() {
                let half = half_contracted(&moduli[q], gj, volumes[q]);
                for (i, gi) in gradients.iter().enumerate() {
                    let entry = &mut local[i * w + j];
                    for (row, half) in entry.iter_mut().zip(&half) {
                        for (value, half) in row.iter_mut().zip(half) {
                            *value += dot(half, gi);
                        }
                    }
                }
            }
        }
        if !block.is_empty() {
            self.flush(self.stencil(last).0, &mut local, out);
        }
        out.scratch = local;
    }

    fn couplings(&self) -> usize {
        (2 * Self::REACH + 1).pow(D as u32)
    }

    fn bytes_per_point(&self) -> usize {
        Self::NODES * (size_of::<u32>() + size_of::<f64>() + size_of::<Vector<D>>())
    }
}

/// `h[i][k][j] = V A_ijkl g_l`.
#[inline]
fn half_contracted<const D: usize>(
    moduli: &Tensor4<D>,
    g: &Vector<D>,
    volume: f64,
) -> [[[f64; D]; D]; D] {
    let mut half = [[[0.0; D]; D]; D];
    for i in 0..D {
        for j in 0..D {
            for k in 0..D {
                half[i][k][j] = volume * dot(&moduli[i][j][k], g);
            }
        }
    }
    half
}

/// Each node couples with those at most `reach` cells away.
fn neighbours<const D: usize>(grid: &Grid<D>, reach: usize) -> Pattern {
    let mut pattern = Pattern {
        starts: vec![0],
        columns: Vec::new(),
    };
    for node in 0..grid.node_count() {
        let index = grid.lattice(node);
        let lower: [usize; D] = std::array::from_fn(|a| index[a].saturating_sub(reach));
        let upper: [usize; D] = std::array::from_fn(|a| (index[a] + reach).min(grid.cells[a]));
        let mut at = lower;
        // x fastest, so columns ascend
        'box_: loop {
            pattern.columns.push(grid.node(at) as u32);
            for a in 0..D {
                if at[a] < upper[a] {
                    at[a] += 1;
                    continue 'box_;
                }
                at[a] = lower[a];
            }
            break;
        }
        pattern.starts.push(pattern.columns.len());
    }
    pattern
}

#[cfg(test)]
mod tests;
