//! Plane waves on the strip: modes of the plain columns, and what the other columns send back.
//!
//! With motion exp(-i k_y y) along the side, plain columns obey L u_(i-1) + D u_i + R u_(i+1) = 0, which
//! waves u_i = phi mu^i solve when det(L + mu D + mu^2 R) = 0. The mirror image of a wave is one as
//! well, so that the quartic is palindromic and a quadratic in mu + 1/mu: two pairs, P and S. The layer
//! is eliminated from its outer end, u_(i+1) = T_i u_i; what is left are two equations for two
//! reflected amplitudes.

use super::AtlasError;
use super::strip::Stiffness;
use anechoic_reference::analytic::oblique::matrix2::Matrix2;
use anechoic_reference::analytic::oblique::{Reflection, Wave};
use num_complex::Complex64;
use std::f64::consts::PI;

/// A column with plain neighbours.
const PLAIN: usize = 1;

/// A wave of the plain mesh.
#[derive(Clone, Copy, Debug)]
pub struct Mode {
    /// By how much it changes from one column to the next, to the right: exp(-i k_x h).
    pub step: Complex64,
    /// Its displacement to the right, of length one.
    pub right: [Complex64; 2],
    /// That of its mirror image.
    pub left: [Complex64; 2],
    /// Energy that it carries to the right, up to a factor that all share; 0 if it decays.
    pub flux: f64,
}

impl Mode {
    /// Does it propagate?
    pub fn propagates(&self) -> bool {
        let exponent = self.step.ln();
        exponent.re.abs() < exponent.im.abs()
    }

    /// k_x h; 0 if it decays.
    pub fn turn(&self) -> f64 {
        if self.propagates() {
            -self.step.arg()
        } else {
            0.0
        }
    }
}

/// P and S of a column L, D, R.
///
/// # Errors
/// A column without waves.
pub fn modes([before, at, after]: [Matrix2; 3]) -> Result<[Mode; 2], AtlasError> {
    let entry = |i: usize, j: usize| [before.0[i][j], at.0[i][j], after.0[i][j]];
    let mut quartic = [Complex64::ZERO; 5];
    for (i, a) in entry(0, 0).iter().enumerate() {
        for (j, d) in entry(1, 1).iter().enumerate() {
            quartic[i + j] += a * d;
        }
    }
    for (i, b) in entry(0, 1).iter().enumerate() {
        for (j, c) in entry(1, 0).iter().enumerate() {
            quartic[i + j] -= b * c;
        }
    }
    // a s^2 + b s + c = 0 for s = mu + 1/mu
    let a = 0.5 * (quartic[0] + quartic[4]);
    let b = 0.5 * (quartic[1] + quartic[3]);
    let c = quartic[2] - 2.0 * a;
    let root = (b * b - 4.0 * a * c).sqrt();
    let mut sums = [(root - b) / (2.0 * a), (-root - b) / (2.0 * a)];
    if !sums.iter().all(|s| s.is_finite()) {
        return Err(AtlasError::Degenerate("a plain column's waves"));
    }
    // 2 cos(k_x h) of the faster wave is the larger one
    sums.sort_by(|x, y| y.re.total_cmp(&x.re));
    let mode = |sum: Complex64| {
        let root = (0.25 * sum * sum - 1.0).sqrt();
        let (one, other) = (0.5 * sum + root, 0.5 * sum - root);
        let exponent = one.ln();
        // to the right: the phase falls; where nothing propagates, the size does
        let first = if exponent.re.abs() < exponent.im.abs() {
            exponent.im < 0.0
        } else {
            exponent.re < 0.0
        };
        let step = if first { one } else { other };
        let balance = before + at.scale(step) + after.scale(step * step);
        let right = null_vector(&balance);
        let next = after.apply(right.map(|x| x * step));
        let power: Complex64 = right.iter().zip(next).map(|(u, f)| u.conj() * f).sum();
        let mut mode = Mode {
            step,
            right,
            left: [-right[0], right[1]],
            flux: power.im.abs(),
        };
        if !mode.propagates() {
            mode.flux = 0.0;
        }
        mode
    };
    Ok(sums.map(mode))
}

/// A vector of length one that a singular matrix sends to zero.
fn null_vector(matrix: &Matrix2) -> [Complex64; 2] {
    let size = |row: &[Complex64; 2]| row[0].norm().hypot(row[1].norm());
    let [first, second] = &matrix.0;
    let row = if size(first) > size(second) {
        first
    } else {
        second
    };
    let length = size(row);
    [-row[1] / length, row[0] / length]
}

/// Reflection of the waves that go along the side as exp(-i k_y y), `turn` = k_y h.
///
/// # Errors
/// A column without waves or a layer that resonates.
pub fn reflection(stiffness: &Stiffness, turn: f64) -> Result<Reflection, AtlasError> {
    let waves = modes(stiffness.turned(PLAIN, turn))?;
    let mut transfer = Matrix2::zero();
    for column in (PLAIN..stiffness.columns()).rev() {
        let [mut before, mut at, after] = stiffness.turned(column, turn);
        for i in 0..2 {
            // a direction that is held has no forces at all
            if at.0[i] == [Complex64::ZERO; 2] {
                at.0[i][i] = Complex64::ONE;
                before.0[i] = [Complex64::ZERO; 2];
            }
        }
        transfer = (at + after * transfer).inverse() * before.scale(-Complex64::ONE);
    }
    // u_1 = T u_0 with u_i = phi mu^i + sum of r phi^ mu^-i
    let unmet = |step: Complex64, shape: [Complex64; 2]| {
        let moved = transfer.apply(shape);
        [0, 1].map(|i| step * shape[i] - moved[i])
    };
    let [right, left] = [
        waves.map(|w| unmet(w.step, w.right)),
        waves.map(|w| unmet(w.step.inv(), w.left)),
    ]
    .map(|[p, s]| Matrix2::columns(p, s));
    let amplitudes = left.inverse() * right.scale(-Complex64::ONE);
    if !amplitudes.is_finite() {
        return Err(AtlasError::Degenerate("a layer's reflection"));
    }
    Ok(Reflection {
        amplitudes,
        flux: waves.map(|w| w.flux),
    })
}

/// k_y h of the mesh's own `wave` whose wave vector makes `angle` (degrees) with the normal.
///
/// # Errors
/// A column without waves.
pub fn turn_of(stiffness: &Stiffness, wave: Wave, angle: f64) -> Result<f64, AtlasError> {
    let slope = angle.to_radians().tan();
    let plain = |turn: f64| modes(stiffness.turned(PLAIN, turn)).map(|m| m[wave as usize].turn());
    // the steeper the wave along the side, the less is left across it
    let (mut low, mut high) = (0.0, PI);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if middle > slope * plain(middle)? {
            high = middle;
        } else {
            low = middle;
        }
    }
    Ok(if angle == 0.0 {
        0.0
    } else {
        0.5 * (low + high)
    })
}
