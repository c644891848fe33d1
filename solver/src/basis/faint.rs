//! Nodes to which points give next to nothing: those just beyond a surface that a wide function barely
//! reaches.
//!
//! Such a node has a mass that tends to zero while the forces on it do not keep pace: it would run
//! away with whatever load reaches it, and whether it is there at all would change with every breath
//! of the surface. It gets nothing instead: what a point would give it goes to the two nodes before
//! it, as at the ends of the grid (`N_1 += 2 N_2, N_0 -= N_2` along each axis on which the point's
//! middle node has a faint neighbour), which keeps masses, momenta and linear fields.

use crate::tensor::Vector;

/// A node is faint below this share of the points of a full cell. A surface that starts on a cell's face
/// has to move by a tenth of a cell before a node changes sides: by GIMP it gives (d/h)^2/2 to the
/// nodes beyond, by quadratic B-splines 1/64 at the start.
const FAINT: f64 = 5e-3;

/// Which nodes are faint.
#[derive(Debug)]
pub(super) struct Faint {
    least: f64,
    sums: Vec<f64>,
    is: Vec<bool>,
    any: bool,
}

impl Faint {
    /// For full cells of `per_cell` points.
    pub(super) fn new(per_cell: usize) -> Self {
        Faint {
            least: FAINT * per_cell as f64,
            sums: Vec::new(),
            is: Vec::new(),
            any: false,
        }
    }

    /// Looks at what all points give to the nodes.
    pub(super) fn find(&mut self, node_count: usize, nodes: &[u32], values: &[f64]) {
        self.sums.clear();
        self.sums.resize(node_count, 0.0);
        for (&node, n) in nodes.iter().zip(values) {
            self.sums[node as usize] += n;
        }
        self.is.clear();
        let least = self.least;
        self.is
            .extend(self.sums.iter().map(|s| *s > 0.0 && *s < least));
        self.any = self.is.contains(&true);
    }

    /// Takes from the faint nodes of stencils of 3^D nodes each what they have.
    pub(super) fn unburden<const D: usize>(
        &self,
        nodes: &[u32],
        values: &mut [f64],
        gradients: &mut [Vector<D>],
    ) {
        if !self.any {
            return;
        }
        let w = 3usize.pow(D as u32);
        let stencils = nodes.chunks_exact(w).zip(values.chunks_exact_mut(w));
        for ((nodes, values), gradients) in stencils.zip(gradients.chunks_exact_mut(w)) {
            let faint = |k: usize| self.is[nodes[k] as usize];
            let middle = (w - 1) / 2;
            if faint(middle) {
                continue;
            }
            for axis in 0..D {
                let stride = 3usize.pow(axis as u32);
                for end in [middle - stride, middle + stride] {
                    if faint(end) {
                        fold_lines(stride, end < middle, values, gradients);
                    }
                }
            }
        }
    }
}

/// Folds the first or last node of each line of three nodes, `stride` apart, of a stencil.
fn fold_lines<const D: usize>(
    stride: usize,
    first: bool,
    values: &mut [f64],
    gradients: &mut [Vector<D>],
) {
    let starts = (0..values.len()).filter(|k| (k / stride).is_multiple_of(3));
    for start in starts {
        let mut line = [start, start + stride, start + 2 * stride];
        if first {
            line.reverse();
        }
        let [far, next, end] = line;
        values[next] += 2.0 * values[end];
        values[far] -= values[end];
        values[end] = 0.0;
        let g = std::mem::replace(&mut gradients[end], [0.0; D]);
        for i in 0..D {
            gradients[next][i] += 2.0 * g[i];
            gradients[far][i] -= g[i];
        }
    }
}
