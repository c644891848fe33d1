//! Conjugate gradients with Jacobi preconditioning, on the free unknowns alone.
//!
//! Held unknowns are projected out: their entries of residual and direction stay zero, which is the
//! same as solving the reduced system. All sums run in the order of the nodes, so the same input
//! gives the same bits.

use super::block_matrix::BlockMatrix;
use crate::tensor::Vector;

/// Work space, kept between solves.
#[derive(Clone, Debug)]
pub struct ConjugateGradients<const D: usize> {
    inverse_diagonal: Vec<Vector<D>>,
    direction: Vec<Vector<D>>,
    image: Vec<Vector<D>>,
    residual: Vec<Vector<D>>,
}

/// How an iterative solve ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iterated {
    /// Iterations made.
    pub iterations: usize,
    /// Norm of the residual reached.
    pub residual: f64,
    /// Is it within the tolerance?
    pub converged: bool,
}

impl<const D: usize> ConjugateGradients<D> {
    /// Work space for `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        let zeros = || vec![[0.0; D]; nodes];
        ConjugateGradients {
            inverse_diagonal: zeros(),
            direction: zeros(),
            image: zeros(),
            residual: zeros(),
        }
    }

    /// Solves A x = b on the unknowns that are not `held`; x starts at zero.
    ///
    /// Stops when the norm of the residual is at most `tolerance`, an absolute value, or after
    /// `most` iterations.
    pub fn solve(
        &mut self,
        matrix: &BlockMatrix<D>,
        held: &[[bool; D]],
        b: &[Vector<D>],
        x: &mut [Vector<D>],
        tolerance: f64,
        most: usize,
    ) -> Iterated {
        self.start(matrix, held, b);
        x.fill([0.0; D]);
        let mut rho = self.precondition_into_direction(None);
        let mut norm = norm(&self.residual);
        let mut iterations = 0;
        while norm > tolerance && iterations < most && norm.is_finite() {
            matrix.apply(&self.direction, &mut self.image);
            let mut curvature = 0.0;
            for ((p, q), h) in self.direction.iter().zip(&mut self.image).zip(held) {
                for i in 0..D {
                    if h[i] {
                        q[i] = 0.0;
                    }
                    curvature += p[i] * q[i];
                }
            }
            let step = rho / curvature;
            let mut square = 0.0;
            let work = x
                .iter_mut()
                .zip(&mut self.residual)
                .zip(self.direction.iter().zip(&self.image));
            for ((x, r), (p, q)) in work {
                for i in 0..D {
                    x[i] += step * p[i];
                    r[i] -= step * q[i];
                    square += r[i] * r[i];
                }
            }
            norm = square.sqrt();
            iterations += 1;
            rho = self.precondition_into_direction(Some(rho));
        }
        Iterated {
            iterations,
            residual: norm,
            converged: norm <= tolerance,
        }
    }

    fn start(&mut self, matrix: &BlockMatrix<D>, held: &[[bool; D]], b: &[Vector<D>]) {
        matrix.diagonal(&mut self.inverse_diagonal);
        for (((d, r), h), b) in self
            .inverse_diagonal
            .iter_mut()
            .zip(&mut self.residual)
            .zip(held)
            .zip(b)
        {
            for i in 0..D {
                d[i] = if h[i] { 0.0 } else { 1.0 / d[i] };
                r[i] = if h[i] { 0.0 } else { b[i] };
            }
        }
    }

    /// p = z + (rho'/rho) p with z the preconditioned residual; returns rho' = r.z.
    fn precondition_into_direction(&mut self, before: Option<f64>) -> f64 {
        let mut rho = 0.0;
        for (r, d) in self.residual.iter().zip(&self.inverse_diagonal) {
            for i in 0..D {
                rho += r[i] * d[i] * r[i];
            }
        }
        let beta = before.map_or(0.0, |before| rho / before);
        for ((p, r), d) in self
            .direction
            .iter_mut()
            .zip(&self.residual)
            .zip(&self.inverse_diagonal)
        {
            for i in 0..D {
                // beta = 0 must also clear what an earlier solve left
                p[i] = d[i] * r[i] + if beta == 0.0 { 0.0 } else { beta * p[i] };
            }
        }
        rho
    }
}

/// Euclidean norm over all nodes.
pub fn norm<const D: usize>(v: &[Vector<D>]) -> f64 {
    let mut square = 0.0;
    for x in v {
        for value in x {
            square += value * value;
        }
    }
    square.sqrt()
}
