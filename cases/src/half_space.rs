//! What scenes of a force on a half-space share: a rectangle below the surface y = 0, and the force.

use crate::checks::Checks;
use crate::field::{Field, Kind, Range};
use anechoic_solver::problem::{Aabb, Drive};
use anechoic_solver::wavelet::{Pulse, Wavelet};
use serde::{Deserialize, Serialize};

/// A rectangle below the surface y = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TargetSpec {
    /// Left side (m).
    pub x_min_m: f64,
    /// Right side (m).
    pub x_max_m: f64,
    /// Depth (m).
    pub depth_m: f64,
}

impl TargetSpec {
    /// The solver's box.
    pub fn body(&self) -> Aabb<2> {
        Aabb {
            lower: [self.x_min_m, -self.depth_m],
            upper: [self.x_max_m, 0.0],
        }
    }

    /// Width and depth (m).
    pub fn size(&self) -> [f64; 2] {
        [self.x_max_m - self.x_min_m, self.depth_m]
    }

    /// It must have a width; a depth has its range.
    pub fn check(&self, checks: &mut Checks<'_>) {
        checks.require(self.size()[0] > 0.0, "target.x_max_m", || {
            format!(
                "{} m is not right of target.x_min_m = {} m",
                self.x_max_m, self.x_min_m
            )
        });
    }
}

/// The force.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Place (m).
    pub x_m: f64,
    /// Place (m).
    pub y_m: f64,
    /// Line of action.
    pub direction: Direction,
    /// Shape over time.
    pub wavelet: Wavelet,
    /// Frequency f (Hz).
    #[serde(rename = "frequency_Hz")]
    pub frequency: f64,
    /// Largest force per metre of thickness (N/m).
    #[serde(rename = "amplitude_N_m")]
    pub amplitude: f64,
    /// Centre of the Ricker wavelet (s).
    pub t0_s: f64,
}

/// Line of action of the force.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Positive downward.
    Vertical,
    /// Positive to the right.
    Horizontal,
}

impl Source {
    /// The force over time.
    pub fn pulse(&self) -> Pulse {
        Pulse {
            wavelet: self.wavelet,
            amplitude: self.amplitude,
            frequency: self.frequency,
            t0: self.t0_s,
        }
    }

    /// The solver's force.
    pub fn force(&self) -> Drive<2> {
        Drive::PointForce {
            place: [self.x_m, self.y_m],
            direction: match self.direction {
                Direction::Vertical => [0.0, -1.0],
                Direction::Horizontal => [1.0, 0.0],
            },
            pulse: self.pulse(),
        }
    }

    /// It must act inside the body, and be over before the run is.
    pub fn check(&self, checks: &mut Checks<'_>, body: &Aabb<2>, end_s: f64) {
        checks.inside("source.x_m", "the source", self.x_m, body, 0);
        checks.inside("source.y_m", "the source", self.y_m, body, 1);
        checks.pulse(&self.pulse(), end_s);
    }
}

/// Fields of target and source.
pub const TARGET_AND_SOURCE: &[Field] = &[
    Field::new(
        "t1_s",
        Kind::Number(Range::within(0.0, f64::INFINITY)),
        "from when on echoes are looked for (s)",
    ),
    Field::new(
        "target.x_min_m",
        Kind::Number(Range::ANY),
        "left side of the target (m)",
    ),
    Field::new(
        "target.x_max_m",
        Kind::Number(Range::ANY),
        "right side of the target (m)",
    ),
    Field::new(
        "target.depth_m",
        Kind::Number(Range::POSITIVE),
        "depth of the target below the surface y = 0 (m)",
    ),
    Field::new("source.x_m", Kind::Number(Range::ANY), "where it acts (m)"),
    Field::new("source.y_m", Kind::Number(Range::ANY), "where it acts (m)"),
    Field::new(
        "source.direction",
        Kind::Word(&["vertical", "horizontal"]),
        "a positive force acts downward or to the right",
    ),
    Field::new(
        "source.wavelet",
        Kind::Word(&["sine", "half-sine", "sine-squared", "ricker"]),
        "shape of the force over time",
    ),
    Field::new(
        "source.frequency_Hz",
        Kind::Number(Range::POSITIVE),
        "its frequency f; sine lasts 1/f, half-sine and sine-squared 1/(2f) (Hz)",
    ),
    Field::new(
        "source.amplitude_N_m",
        Kind::Number(Range::POSITIVE),
        "largest force per metre of thickness (N/m)",
    ),
    Field::new(
        "source.t0_s",
        Kind::Number(Range::POSITIVE),
        "centre of the Ricker wavelet, which lasts 2 t0 (s)",
    ),
];
