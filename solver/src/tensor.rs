//! Small tensors of dimension `D` as plain arrays; row-major, `m[i][j]`.

/// Vector.
pub type Vector<const D: usize> = [f64; D];
/// Second-order tensor.
pub type Matrix<const D: usize> = [[f64; D]; D];
/// Fourth-order tensor, `t[i][j][k][l]`.
pub type Tensor4<const D: usize> = [[[[f64; D]; D]; D]; D];

/// The zero tensor.
pub const fn zero<const D: usize>() -> Matrix<D> {
    [[0.0; D]; D]
}

/// The unit tensor.
#[inline]
pub fn identity<const D: usize>() -> Matrix<D> {
    let mut out = zero::<D>();
    for (i, row) in out.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    out
}

/// `a b`.
#[inline]
pub fn mul<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    let mut out = zero::<D>();
    for i in 0..D {
        for k in 0..D {
            for j in 0..D {
                out[i][j] += a[i][k] * b[k][j];
            }
        }
    }
    out
}

/// `a b^T`.
#[inline]
pub fn mul_transposed<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> Matrix<D> {
    let mut out = zero::<D>();
    for i in 0..D {
        for j in 0..D {
            for k in 0..D {
                out[i][j] += a[i][k] * b[j][k];
            }
        }
    }
    out
}

/// `a^T`.
#[inline]
pub fn transposed<const D: usize>(a: &Matrix<D>) -> Matrix<D> {
    let mut out = zero::<D>();
    for i in 0..D {
        for j in 0..D {
            out[j][i] = a[i][j];
        }
    }
    out
}

/// `a + s b`.
#[inline]
pub fn add_scaled<const D: usize>(a: &Matrix<D>, s: f64, b: &Matrix<D>) -> Matrix<D> {
    let mut out = *a;
    for i in 0..D {
        for j in 0..D {
            out[i][j] += s * b[i][j];
        }
    }
    out
}

/// Symmetric part.
#[inline]
pub fn sym<const D: usize>(a: &Matrix<D>) -> Matrix<D> {
    let mut out = zero::<D>();
    for i in 0..D {
        for j in 0..D {
            out[i][j] = 0.5 * (a[i][j] + a[j][i]);
        }
    }
    out
}

/// Skew part.
#[inline]
pub fn skew<const D: usize>(a: &Matrix<D>) -> Matrix<D> {
    let mut out = zero::<D>();
    for i in 0..D {
        for j in 0..D {
            out[i][j] = 0.5 * (a[i][j] - a[j][i]);
        }
    }
    out
}

/// Trace.
#[inline]
pub fn trace<const D: usize>(a: &Matrix<D>) -> f64 {
    (0..D).map(|i| a[i][i]).sum()
}

/// `a : b`.
#[inline]
pub fn contract<const D: usize>(a: &Matrix<D>, b: &Matrix<D>) -> f64 {
    let mut out = 0.0;
    for i in 0..D {
        for j in 0..D {
            out += a[i][j] * b[i][j];
        }
    }
    out
}

/// Scalar product.
#[inline]
pub fn dot<const D: usize>(a: &Vector<D>, b: &Vector<D>) -> f64 {
    let mut out = 0.0;
    for i in 0..D {
        out += a[i] * b[i];
    }
    out
}

/// Determinant and inverse by cofactors; the inverse is not finite when the determinant is zero.
///
/// For up to three dimensions.
#[inline]
pub fn inverse<const D: usize>(a: &Matrix<D>) -> (f64, Matrix<D>) {
    let mut out = zero::<D>();
    let det = match D {
        1 => {
            out[0][0] = 1.0 / a[0][0];
            a[0][0]
        }
        2 => {
            let det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
            let r = 1.0 / det;
            out[0][0] = a[1][1] * r;
            out[0][1] = -a[0][1] * r;
            out[1][0] = -a[1][0] * r;
            out[1][1] = a[0][0] * r;
            det
        }
        _ => {
            let c = |i: usize, j: usize| {
                let (i1, i2) = ((i + 1) % 3, (i + 2) % 3);
                let (j1, j2) = ((j + 1) % 3, (j + 2) % 3);
                a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]
            };
            let det = a[0][0] * c(0, 0) + a[0][1] * c(0, 1) + a[0][2] * c(0, 2);
            let r = 1.0 / det;
            for i in 0..3 {
                for j in 0..3 {
                    out[j][i] = c(i, j) * r;
                }
            }
            det
        }
    };
    (det, out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_times_matrix_is_identity() {
        let a2 = [[2.0, 0.3], [-0.7, 1.1]];
        let a3 = [[2.0, 0.3, -0.1], [0.4, 1.5, 0.2], [-0.3, 0.6, 0.9]];
        let (d2, i2) = inverse(&a2);
        assert!((d2 - 2.41).abs() < 1e-14);
        assert!(
            contract(
                &add_scaled(&mul(&a2, &i2), -1.0, &identity()),
                &[[1.0; 2]; 2]
            )
            .abs()
                < 1e-14
        );
        let (_, i3) = inverse(&a3);
        let product = mul(&a3, &i3);
        for i in 0..3 {
            for j in 0..3 {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((product[i][j] - expected).abs() < 1e-14);
            }
        }
    }
}
