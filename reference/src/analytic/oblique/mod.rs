//! Reflection of plane P and S waves that meet a plane boundary at an angle, in plane strain.
//!
//! Sources: Achenbach, Wave Propagation in Elastic Solids (1973), chapter 5, for partial waves and the
//! elastic boundary; Lysmer and Kuhlemeyer (1969, doi 10.1061/JMCEA3.0001144) for the dashpots; Basu and
//! Chopra (2003, doi 10.1016/S0045-7825(02)00642-4) for the stretched layer.
//!
//! The body fills x < 0, motion is exp(i w t - i w p y): by Snell's law all waves share the slowness p
//! along the boundary. With xi = sqrt(1/c^2 - p^2), on the branch that decays away from the boundary
//! beyond the critical angle, waves that run to the right have the displacements
//!
//! ```text
//! P: c_p (xi_p, p) exp(-i w xi_p x),      S: c_s (-p, xi_s) exp(-i w xi_s x)
//! ```
//!
//! unit vectors where they propagate; those that run to the left are their mirror images. Tractions on
//! planes x = const are divided by -i w. A boundary is two conditions for two reflected amplitudes:
//! [`Medium::dashpot`], [`Medium::fixed`], [`Medium::stretched`] (both in closed form), and
//! [`damping`], where a differential equation is left.

pub mod damping;
pub mod matrix2;
#[cfg(test)]
mod tests;

use super::elastic::{Elastic, vertical_slowness};
use matrix2::Matrix2;
use num_complex::Complex64;
use thiserror::Error;

/// A body wave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Wave {
    /// Compressional.
    P,
    /// Shear, in the plane.
    S,
}

impl Wave {
    /// Both, in the order of rows and columns of a [`Reflection`].
    pub const BOTH: [Wave; 2] = [Wave::P, Wave::S];

    /// Letter in rows.
    pub fn letter(self) -> char {
        match self {
            Wave::P => 'P',
            Wave::S => 'S',
        }
    }
}

/// Why there is no reflection to compute.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum ObliqueError {
    /// A parameter out of range.
    #[error("{field} = {value} of a reflection is out of range: use {allowed}")]
    OutOfRange {
        /// Which parameter.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A wave that runs along the boundary is its own mirror image.
    #[error(
        "a wave runs along the boundary at this angle, where reflection has no meaning: choose another"
    )]
    Grazing,
    /// Step halving did not settle.
    #[error(
        "the reflection still changes by {change:.1e} at {steps} steps through the layer: is its profile smooth and finite?"
    )]
    NotConverged {
        /// Steps in the finest integration.
        steps: usize,
        /// Last change.
        change: f64,
    },
}

/// Amplitudes of displacement that come back: row the reflected, column the incident wave, P first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflection {
    /// The amplitudes.
    pub amplitudes: Matrix2,
    /// Energy that each wave carries along x at unit amplitude, over rho w^2/2 (m/s); 0 where the wave
    /// does not propagate.
    pub flux: [f64; 2],
}

impl Reflection {
    /// Size of the reflected `out` over that of the incident `wave`.
    pub fn amplitude(&self, wave: Wave, out: Wave) -> f64 {
        self.amplitudes.0[out as usize][wave as usize].norm()
    }

    /// All that comes back of `wave`: square root of the reflected over the incident energy. Equals
    /// the amplitude where no other wave comes back.
    pub fn total(&self, wave: Wave) -> f64 {
        let shares = Wave::BOTH.map(|out| {
            let ratio = self.flux[out as usize] / self.flux[wave as usize];
            ratio * self.amplitude(wave, out).powi(2)
        });
        shares.iter().sum::<f64>().sqrt()
    }
}

/// The waves of one slowness along the boundary.
#[derive(Clone, Copy, Debug)]
pub struct Medium {
    solid: Elastic,
    incident: Wave,
    /// xi of P and S (s/m).
    slowness: [Complex64; 2],
    /// Displacements of waves that run to the right, a column each.
    motion: Matrix2,
    /// Their tractions (kg/(m2 s)).
    traction: Matrix2,
}

impl Medium {
    /// The waves that belong to an incident `wave` at `angle` from the boundary's normal (degrees).
    ///
    /// # Errors
    /// An angle that is not in [0, 90), or at which the other wave grazes.
    pub fn new(solid: &Elastic, wave: Wave, angle: f64) -> Result<Self, ObliqueError> {
        if !(0.0..90.0).contains(&angle) {
            return Err(ObliqueError::OutOfRange {
                field: "angle (degrees)",
                value: angle,
                allowed: "0 <= angle < 90",
            });
        }
        let speeds = [solid.p_speed(), solid.s_speed()];
        let along = angle.to_radians().sin() / speeds[wave as usize];
        let slowness = speeds.map(|c| vertical_slowness(along.into(), 1.0 / c));
        if slowness
            .iter()
            .zip(speeds)
            .any(|(xi, c)| xi.norm() * c < 1e-6)
        {
            return Err(ObliqueError::Grazing);
        }
        let p = Complex64::from(along);
        let [xp, xs] = slowness;
        let motion = Matrix2::columns(
            [xp * speeds[0], p * speeds[0]],
            [-p * speeds[1], xs * speeds[1]],
        );
        let (lame, shear) = (solid.lame(), solid.shear_modulus());
        let stress = |xi: Complex64, [ux, uy]: [Complex64; 2]| {
            [
                lame * (xi * ux + p * uy) + 2.0 * shear * xi * ux,
                shear * (p * ux + xi * uy),
            ]
        };
        let traction = Matrix2::columns(stress(xp, motion.column(0)), stress(xs, motion.column(1)));
        Ok(Medium {
            solid: *solid,
            incident: wave,
            slowness,
            motion,
            traction,
        })
    }

    /// The wave that they belong to.
    pub fn incident(&self) -> Wave {
        self.incident
    }

    /// The reflection of a boundary whose tractions are `-impedance` times the velocity, for each
    /// direction (kg/(m2 s)); zero: a free surface.
    fn impedance(&self, impedance: [f64; 2]) -> Reflection {
        let z = Matrix2::diagonal(impedance.map(Complex64::from));
        // stress = -z v, and both are divided by -i w: T = z U
        let right = self.traction - z * self.motion;
        let left = self.mirrored_traction() - z * self.mirrored_motion();
        self.reflection(left.inverse() * right.scale(-Complex64::ONE))
    }

    /// Dashpots with the share `share` of the solid's impedances, rho c_p along the normal and rho c_s
    /// along the boundary.
    pub fn dashpot(&self, share: f64) -> Reflection {
        let speeds = [self.solid.p_speed(), self.solid.s_speed()];
        self.impedance(speeds.map(|c| share * self.solid.density() * c))
    }

    /// No motion at the boundary.
    pub fn fixed(&self) -> Reflection {
        self.reflection(self.wall())
    }

    /// A perfectly matched layer in the continuum, fixed at its outer edge: the stretch
    /// 1 + beta/(i w) makes each wave decay by exp(-xi integral of beta) on either way, and the edge
    /// turns one wave into the other. `strength` is the integral of beta over the layer (m/s).
    ///
    /// With the usual beta, whose integral is c_p ln(1/R)/2, P alone at an angle: R^cos(angle).
    pub fn stretched(&self, strength: f64) -> Reflection {
        let ways = self.slowness.map(|xi| (-xi * strength).exp());
        let ways = Matrix2::diagonal(ways);
        self.reflection(ways * self.wall() * ways)
    }

    fn wall(&self) -> Matrix2 {
        self.mirrored_motion().inverse() * self.motion.scale(-Complex64::ONE)
    }

    fn mirrored_motion(&self) -> Matrix2 {
        mirror() * self.motion
    }

    fn mirrored_traction(&self) -> Matrix2 {
        mirror().scale(-Complex64::ONE) * self.traction
    }

    fn reflection(&self, amplitudes: Matrix2) -> Reflection {
        let speeds = [self.solid.p_speed(), self.solid.s_speed()];
        let flux = [0, 1].map(|q| speeds[q] * speeds[q] * self.slowness[q].re);
        Reflection { amplitudes, flux }
    }
}

/// x to -x.
fn mirror() -> Matrix2 {
    Matrix2::diagonal([-Complex64::ONE, Complex64::ONE])
}
