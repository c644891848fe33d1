//! Discretisation by shape functions on the background grid.

use super::{Discretisation, Sample};
use crate::grid::Grid;
use crate::linear::block_matrix::{BlockMatrix, Pattern, add_into};
use crate::tensor::{Matrix, Tensor4, Vector, dot};
use std::marker::PhantomData;
use std::ops::Range;
use std::sync::Arc;

/// Shape functions on a grid.
pub trait Basis: Send + 'static {
    /// Name as in scenes.
    const NAME: &'static str;
    /// Nodes couple over so many cells.
    const REACH: usize;

    /// Nodes that a point sees.
    fn width(dimension: usize) -> usize;

    /// Nodes, values and gradients at `x`; false when `x` is outside the grid.
    fn evaluate<const D: usize>(
        grid: &Grid<D>,
        x: &Vector<D>,
        nodes: &mut [u32],
        values: &mut [f64],
        gradients: &mut [Vector<D>],
    ) -> bool;
}

/// Keeps nodes, values and gradients of all points, `width` a point.
#[derive(Debug)]
pub struct GridDiscretisation<B, const D: usize> {
    grid: Grid<D>,
    pattern: Arc<Pattern>,
    nodes: Vec<u32>,
    values: Vec<f64>,
    gradients: Vec<Vector<D>>,
    basis: PhantomData<B>,
}

impl<B: Basis, const D: usize> GridDiscretisation<B, D> {
    /// On `grid`, without points yet.
    pub fn new(grid: Grid<D>) -> Self {
        let pattern = Arc::new(neighbours(&grid, B::REACH));
        GridDiscretisation {
            grid,
            pattern,
            nodes: Vec::new(),
            values: Vec::new(),
            gradients: Vec::new(),
            basis: PhantomData,
        }
    }

    #[inline]
    fn stencil(&self, p: usize) -> (&[u32], &[f64], &[Vector<D>]) {
        let w = B::width(D);
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
        self.grid.nested_dissection(B::REACH)
    }

    fn place(&mut self, places: &[Vector<D>]) -> Result<(), usize> {
        let w = B::width(D);
        self.nodes.resize(places.len() * w, 0);
        self.values.resize(places.len() * w, 0.0);
        self.gradients.resize(places.len() * w, [0.0; D]);
        self.replace(places)
    }

    fn replace(&mut self, places: &[Vector<D>]) -> Result<(), usize> {
        let w = B::width(D);
        let stencils = self
            .nodes
            .chunks_exact_mut(w)
            .zip(self.values.chunks_exact_mut(w))
            .zip(self.gradients.chunks_exact_mut(w));
        for (p, (((nodes, values), gradients), x)) in stencils.zip(places).enumerate() {
            if !B::evaluate(&self.grid, x, nodes, values, gradients) {
                return Err(p);
            }
        }
        Ok(())
    }

    fn sample(&self, x: &Vector<D>) -> Sample {
        let w = B::width(D);
        let mut sample = Sample {
            nodes: vec![0; w],
            weights: vec![0.0; w],
        };
        let mut gradients = vec![[0.0; D]; w];
        if !B::evaluate(
            &self.grid,
            x,
            &mut sample.nodes,
            &mut sample.weights,
            &mut gradients,
        ) {
            return Sample::default();
        }
        sample
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

    fn scatter_tangent(
        &self,
        block: Range<usize>,
        volumes: &[f64],
        moduli: &[Tensor4<D>],
        out: &mut BlockMatrix<D>,
    ) {
        let w = B::width(D);
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

    fn bytes_per_point(&self) -> usize {
        B::width(D) * (size_of::<u32>() + size_of::<f64>() + size_of::<Vector<D>>())
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
mod tests {
    use super::super::linear::Linear;
    use super::*;

    fn cloud() -> (GridDiscretisation<Linear, 2>, Vec<Vector<2>>) {
        let grid = Grid {
            origin: [-1.0, 0.5],
            h: [0.5; 2],
            cells: [4, 3],
        };
        let places: Vec<Vector<2>> = (0..40)
            .map(|k| {
                let k = k as f64;
                [
                    -1.0 + 2.0 * (0.37 * k).fract(),
                    0.5 + 1.5 * (0.61 * k + 0.1).fract(),
                ]
            })
            .collect();
        let mut disc = GridDiscretisation::new(grid);
        disc.place(&places).unwrap();
        (disc, places)
    }

    #[test]
    fn gradient_of_a_linear_field_is_exact_on_any_cloud() {
        let (disc, places) = cloud();
        let field: Vec<Vector<2>> = (0..disc.node_count())
            .map(|n| disc.grid.node_place(n))
            .map(|x| [1.0 + 2.0 * x[0] - 3.0 * x[1], 0.5 * x[0] + 4.0 * x[1]])
            .collect();
        let mut gradients = vec![[[0.0; 2]; 2]; places.len()];
        let mut values = vec![[0.0; 2]; places.len()];
        disc.gradient(0..places.len(), &field, &mut gradients);
        disc.gather(0..places.len(), &field, &mut values);
        for ((g, v), x) in gradients.iter().zip(&values).zip(&places) {
            for (got, expected) in g.as_flattened().iter().zip([2.0, -3.0, 0.5, 4.0]) {
                assert!((got - expected).abs() < 1e-12);
            }
            assert!((v[0] - (1.0 + 2.0 * x[0] - 3.0 * x[1])).abs() < 1e-12);
        }
    }

    #[test]
    fn scatters_conserve_mass_and_momentum() {
        let (disc, places) = cloud();
        let n = places.len();
        let mass: Vec<f64> = (0..n).map(|k| 1.0 + 0.1 * k as f64).collect();
        let v: Vec<Vector<2>> = places.iter().map(|x| [x[1], -x[0]]).collect();
        let l = vec![[[0.3, -0.7], [0.2, 0.9]]; n];
        let mut nodal = vec![0.0; disc.node_count()];
        let mut momentum = vec![[0.0; 2]; disc.node_count()];
        disc.scatter_scalar(0..n, &mass, &mut nodal);
        disc.scatter_affine(0..n, &mass, &v, &l, &places, &mut momentum);
        assert!((nodal.iter().sum::<f64>() - mass.iter().sum::<f64>()).abs() < 1e-11);
        for i in 0..2 {
            let nodes: f64 = momentum.iter().map(|p| p[i]).sum();
            let points: f64 = mass.iter().zip(&v).map(|(m, v)| m * v[i]).sum();
            assert!((nodes - points).abs() < 1e-11);
        }
    }

    #[test]
    fn tangent_is_the_derivative_of_the_internal_force() {
        let (disc, places) = cloud();
        let n = places.len();
        let volumes: Vec<f64> = (0..n).map(|k| 0.01 * (1 + k % 3) as f64).collect();
        let mut a: Tensor4<2> = Default::default();
        for (k, x) in a
            .as_flattened_mut()
            .as_flattened_mut()
            .as_flattened_mut()
            .iter_mut()
            .enumerate()
        {
            *x = 1.0 + 0.3 * k as f64;
        }
        let mut matrix = BlockMatrix::zeros(disc.pattern());
        disc.scatter_tangent(0..n, &volumes, &vec![a; n], &mut matrix);
        let u: Vec<Vector<2>> = (0..disc.node_count())
            .map(|k| [(k as f64).sin(), (1.7 * k as f64).cos()])
            .collect();
        let mut g = vec![[[0.0; 2]; 2]; n];
        disc.gradient(0..n, &u, &mut g);
        let stress: Vec<Matrix<2>> = g
            .iter()
            .map(|g| {
                std::array::from_fn(|i| {
                    std::array::from_fn(|j| crate::tensor::contract(&a[i][j], g))
                })
            })
            .collect();
        let (mut force, mut image) = (vec![[0.0; 2]; u.len()], vec![[0.0; 2]; u.len()]);
        disc.scatter_stress(0..n, &volumes, &stress, &mut force);
        matrix.apply(&u, &mut image);
        for (f, k) in force.iter().zip(&image) {
            assert!((f[0] - k[0]).abs() < 1e-11 && (f[1] - k[1]).abs() < 1e-11);
        }
    }
}
