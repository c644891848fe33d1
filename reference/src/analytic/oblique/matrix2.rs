//! Complex matrices of two rows: what P and S, or two components, couple through.

use num_complex::Complex64;

/// A matrix by rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Matrix2(pub [[Complex64; 2]; 2]);

impl Matrix2 {
    /// All zero.
    pub fn zero() -> Self {
        Matrix2([[Complex64::ZERO; 2]; 2])
    }

    /// A diagonal.
    pub fn diagonal(entries: [Complex64; 2]) -> Self {
        let mut out = Self::zero();
        out.0[0][0] = entries[0];
        out.0[1][1] = entries[1];
        out
    }

    /// Two columns.
    pub fn columns(first: [Complex64; 2], second: [Complex64; 2]) -> Self {
        Matrix2([[first[0], second[0]], [first[1], second[1]]])
    }

    /// A column.
    pub fn column(&self, j: usize) -> [Complex64; 2] {
        [self.0[0][j], self.0[1][j]]
    }

    /// Matrix times vector.
    pub fn apply(&self, x: [Complex64; 2]) -> [Complex64; 2] {
        self.0.map(|row| row[0] * x[0] + row[1] * x[1])
    }

    /// Entry by entry.
    pub fn zip(&self, other: &Self, f: impl Fn(Complex64, Complex64) -> Complex64) -> Self {
        let mut out = *self;
        for (row, others) in out.0.iter_mut().zip(&other.0) {
            for (x, y) in row.iter_mut().zip(others) {
                *x = f(*x, *y);
            }
        }
        out
    }

    /// Times a number.
    pub fn scale(&self, factor: Complex64) -> Self {
        Matrix2(self.0.map(|row| row.map(|x| factor * x)))
    }

    /// The determinant.
    pub fn determinant(&self) -> Complex64 {
        self.0[0][0] * self.0[1][1] - self.0[0][1] * self.0[1][0]
    }

    /// The inverse; not finite for a singular matrix.
    pub fn inverse(&self) -> Self {
        let [[a, b], [c, d]] = self.0;
        Matrix2([[d, -b], [-c, a]]).scale(self.determinant().inv())
    }

    /// The largest entry's size.
    pub fn largest(&self) -> f64 {
        let entries = self.0.iter().flatten();
        entries.map(|x| x.norm()).fold(0.0, f64::max)
    }

    /// Are all entries finite?
    pub fn is_finite(&self) -> bool {
        self.0.iter().flatten().all(|x| x.is_finite())
    }
}

impl std::ops::Mul for Matrix2 {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::columns(self.apply(other.column(0)), self.apply(other.column(1)))
    }
}

impl std::ops::Add for Matrix2 {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.zip(&other, |x, y| x + y)
    }
}

impl std::ops::Sub for Matrix2 {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.zip(&other, |x, y| x - y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_times_its_inverse_is_one() {
        let c = Complex64::new;
        let a = Matrix2([[c(1.0, 2.0), c(0.0, -1.0)], [c(3.0, 0.5), c(-2.0, 1.0)]]);
        let one = Matrix2::diagonal([Complex64::ONE; 2]);
        assert!((a * a.inverse() - one).largest() < 1e-15);
        assert_eq!((a + a).column(1), a.scale(c(2.0, 0.0)).column(1));
        assert!(!Matrix2::zero().inverse().is_finite());
    }
}
