//! Eigenvalues of small dense matrices, for spectra of operators.

use faer::Mat;
use thiserror::Error;

/// A matrix whose eigenvalues were not found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the eigenvalues of a matrix of {rows} rows were not found")]
pub struct NoEigenvalues {
    /// Its rows.
    pub rows: usize,
}

/// Real and imaginary parts of the eigenvalues of a matrix of `rows` rows and columns.
///
/// # Errors
/// Entries that are not finite, an iteration that does not end.
pub fn eigenvalues(
    rows: usize,
    entry: impl Fn(usize, usize) -> f64,
) -> Result<Vec<[f64; 2]>, NoEigenvalues> {
    let mut a = Mat::from_fn(rows, rows, entry);
    if (0..rows).any(|j| a.col(j).iter().any(|x| !x.is_finite())) {
        return Err(NoEigenvalues { rows });
    }
    // entries span many orders of magnitude (stiffness over mass against rates): diagonal scaling by
    // powers of two makes the eigenvalues as accurate as the rest
    balance(&mut a);
    let found = a.eigenvalues().map_err(|_| NoEigenvalues { rows })?;
    Ok(found.iter().map(|z| [z.re, z.im]).collect())
}

/// Osborne's balancing: similar rows and columns, eigenvalues unchanged to the last bit.
fn balance(a: &mut Mat<f64>) {
    let n = a.nrows();
    for _ in 0..20 {
        let mut quiet = true;
        for i in 0..n {
            let others = || (0..n).filter(|j| *j != i);
            let column: f64 = others().map(|j| a[(j, i)].abs()).sum();
            let row: f64 = others().map(|j| a[(i, j)].abs()).sum();
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let factor = 2.0_f64.powf((0.5 * (row / column).log2()).round());
            if factor != 1.0 {
                quiet = false;
                for j in 0..n {
                    a[(i, j)] /= factor;
                    a[(j, i)] *= factor;
                }
            }
        }
        if quiet {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_badly_scaled_oscillator_has_its_frequency() {
        // du = v, dv = -w^2 u - 2 d w v with w = 1e6/s, d = 0.1: real parts -d w
        let (w, d) = (1e6, 0.1);
        let a = [[0.0, 1.0], [-w * w, -2.0 * d * w]];
        for [re, im] in eigenvalues(2, |i, j| a[i][j]).unwrap() {
            assert!((re / (-d * w) - 1.0).abs() < 1e-12);
            assert!((im.abs() / (w * (1.0 - d * d).sqrt()) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn what_is_not_finite_is_refused() {
        assert_eq!(
            eigenvalues(3, |_, _| f64::NAN),
            Err(NoEigenvalues { rows: 3 })
        );
    }
}
