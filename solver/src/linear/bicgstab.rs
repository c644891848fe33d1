//! Stabilised bi-conjugate gradients with Jacobi preconditioning, for layers whose operator is not
//! symmetric (van der Vorst 1992). Held unknowns are projected out as in [`super::cg`].

use super::block_matrix::BlockMatrix;
use super::cg::{Iterated, norm};
use crate::tensor::Vector;

/// Work space, kept between solves.
#[derive(Clone, Debug)]
pub struct BiCgStab<const D: usize> {
    inverse_diagonal: Vec<Vector<D>>,
    residual: Vec<Vector<D>>,
    shadow: Vec<Vector<D>>,
    direction: Vec<Vector<D>>,
    scaled: Vec<Vector<D>>,
    image: Vec<Vector<D>>,
    second: Vec<Vector<D>>,
}

impl<const D: usize> BiCgStab<D> {
    /// Work space for `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        let zeros = || vec![[0.0; D]; nodes];
        BiCgStab {
            inverse_diagonal: zeros(),
            residual: zeros(),
            shadow: zeros(),
            direction: zeros(),
            scaled: zeros(),
            image: zeros(),
            second: zeros(),
        }
    }

    /// Solves A x = b on the unknowns that are not `held`; x starts at zero. Stops as
    /// [`super::cg::ConjugateGradients::solve`] does.
    pub fn solve(
        &mut self,
        matrix: &BlockMatrix<D>,
        held: &[[bool; D]],
        b: &[Vector<D>],
        x: &mut [Vector<D>],
        tolerance: f64,
        most: usize,
    ) -> Iterated {
        matrix.diagonal(&mut self.inverse_diagonal);
        for d in self.inverse_diagonal.as_flattened_mut() {
            *d = 1.0 / *d;
        }
        project(held, &mut self.inverse_diagonal);
        self.residual.copy_from_slice(b);
        project(held, &mut self.residual);
        self.shadow.copy_from_slice(&self.residual);
        self.direction.copy_from_slice(&self.residual);
        x.fill([0.0; D]);
        let mut rho = inner(&self.shadow, &self.residual);
        let mut size = norm(&self.residual);
        let mut iterations = 0;
        while size > tolerance && iterations < most && size.is_finite() && rho != 0.0 {
            multiply(&self.inverse_diagonal, &self.direction, &mut self.scaled);
            matrix.apply(&self.scaled, &mut self.image);
            project(held, &mut self.image);
            let alpha = rho / inner(&self.shadow, &self.image);
            add(x, alpha, &self.scaled);
            add(&mut self.residual, -alpha, &self.image);
            multiply(&self.inverse_diagonal, &self.residual, &mut self.scaled);
            matrix.apply(&self.scaled, &mut self.second);
            project(held, &mut self.second);
            let square = inner(&self.second, &self.second);
            let omega = if square > 0.0 {
                inner(&self.second, &self.residual) / square
            } else {
                0.0
            };
            add(x, omega, &self.scaled);
            add(&mut self.residual, -omega, &self.second);
            size = norm(&self.residual);
            iterations += 1;
            let next = inner(&self.shadow, &self.residual);
            let beta = next / rho * (alpha / omega);
            rho = next;
            add(&mut self.direction, -omega, &self.image);
            for (p, r) in self
                .direction
                .as_flattened_mut()
                .iter_mut()
                .zip(self.residual.as_flattened())
            {
                *p = r + beta * *p;
            }
        }
        Iterated {
            iterations,
            residual: size,
            converged: size <= tolerance,
        }
    }
}

fn project<const D: usize>(held: &[[bool; D]], values: &mut [Vector<D>]) {
    for (x, h) in values
        .as_flattened_mut()
        .iter_mut()
        .zip(held.as_flattened())
    {
        if *h {
            *x = 0.0;
        }
    }
}

fn inner<const D: usize>(a: &[Vector<D>], b: &[Vector<D>]) -> f64 {
    a.as_flattened()
        .iter()
        .zip(b.as_flattened())
        .map(|(a, b)| a * b)
        .sum()
}

fn add<const D: usize>(a: &mut [Vector<D>], scale: f64, b: &[Vector<D>]) {
    for (a, b) in a.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *a += scale * b;
    }
}

fn multiply<const D: usize>(a: &[Vector<D>], b: &[Vector<D>], out: &mut [Vector<D>]) {
    let pairs = a.as_flattened().iter().zip(b.as_flattened());
    for (o, (a, b)) in out.as_flattened_mut().iter_mut().zip(pairs) {
        *o = a * b;
    }
}
