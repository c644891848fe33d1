//! What scenes of a force on a half-space share: a rectangle below the surface y = 0, the force,
//! receivers, and what is solved for them.

use crate::checks::Checks;
use crate::field::{Field, Kind, Range};
use crate::scene::Window;
use crate::spec::*;
use anechoic_solver::probe::Probes;
use anechoic_solver::problem::{Aabb, BasisKind, Drive, FlowSetup, Problem};
use anechoic_solver::wavelet::{Pulse, Wavelet};
use serde::{Deserialize, Serialize};

/// A force on a half-space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct HalfSpace {
    /// Shape functions.
    pub basis: BasisKind,
    /// From when on echoes are looked for (s).
    pub t1_s: f64,
    /// The body of interest.
    pub target: TargetSpec,
    /// Background grid.
    pub grid: GridSpec,
    /// Time integration; the scene says what step it takes where none is given.
    pub time: TimeSpec,
    /// Material points.
    pub points: PointsSpec,
    /// Linear solver.
    pub solver: SolverSpec,
    /// Soil.
    pub material: MaterialSpec,
    /// The force.
    pub source: Source,
    /// Anywhere in the body.
    pub receivers: Vec<ReceiverSpec>,
    /// Sides; the method under test is left, right and at the bottom.
    pub boundary: BoundarySpec,
}

/// Energies in a run: enough for pictures and for the growth rate's windows.
const ENERGIES: f64 = 200.0;

impl HalfSpace {
    /// What the solver is given, with steps of `dt` (s) and fields at `snapshot_times` (s).
    pub fn problem(&self, dt: f64, snapshot_times: Vec<f64>) -> Problem<2> {
        let end = self.time.end_s;
        Problem {
            target: self.target.body(),
            cell_size: self.grid.h_m,
            aspect: self.grid.aspect(),
            basis: self.basis,
            scheme: self.time.scheme,
            mass: self.time.mass,
            dt,
            end_time: end,
            point_mode: self.points.mode,
            transfer: self.points.transfer,
            points_per_cell: self.points.per_cell,
            face_gap: self.points.face_gap,
            inclusion: self.material.inclusion,
            material: self.material.elastic(),
            flow: FlowSetup::default(),
            sides: self.boundary.sides(),
            drives: vec![self.source.force()],
            probes: Probes {
                receivers: self.receivers.iter().map(ReceiverSpec::probe).collect(),
                lines: Vec::new(),
                snapshot_times,
                energy_every: Some((end / dt / ENERGIES).ceil().max(1.0) as usize),
            },
            solver: self.solver.kind,
            rel_tol: self.solver.rel_tol,
        }
    }

    /// What must hold between fields, with steps of `dt` (s).
    pub fn check(&self, checks: &mut Checks<'_>, dt: f64) {
        let body = self.target.body();
        self.target.check(checks);
        checks.layers(&self.boundary, self.target.size());
        checks.points(&self.points);
        checks.receivers(&self.receivers, &body);
        self.source.check(checks, &body, dt, self.time.end_s);
        self.apart(checks);
        checks.step(dt, self.time.end_s);
        checks.require(self.t1_s < self.time.end_s, "t1_s", || {
            format!(
                "no time is left for echoes: the run ends at time.end_s = {} s",
                self.time.end_s
            )
        });
        checks.inertia(&self.time);
    }

    /// No receiver is at the force, where the displacement grows without limit as cells shrink.
    fn apart(&self, checks: &mut Checks<'_>) {
        for (index, receiver) in self.receivers.iter().enumerate() {
            let place = [receiver.x_m, receiver.y_m];
            let apart = place != [self.source.x_m, self.source.y_m];
            checks.require(apart, &format!("receivers[{index}].x_m"), || {
                format!(
                    "receiver {} is at the force, where the displacement has no limit; move it away",
                    receiver.name
                )
            });
        }
    }

    /// Echoes are looked for at all receivers from `t1_s` to the end.
    pub fn windows(&self) -> Vec<Window> {
        let window = |receiver: &ReceiverSpec| Window {
            receiver: receiver.name.clone(),
            label: String::new(),
            from_s: self.t1_s,
            to_s: None,
            stated_by: None,
        };
        self.receivers.iter().map(window).collect()
    }

    /// Longer edge of the cells in use (m).
    pub fn cell_m(&self) -> f64 {
        let [x, y] = self.grid.cell(&self.target.body());
        x.max(y)
    }
}

/// Makes a scene that is a [`HalfSpace`] and claims things of its own: a newtype that reads like it.
macro_rules! half_space_scene {
    ($(#[$doc:meta])* $name:ident, $values:expr) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        #[serde(transparent)]
        pub struct $name(pub crate::half_space::HalfSpace);

        impl Default for $name {
            fn default() -> Self {
                toml::from_str($values).expect("the scene's own values are a scene")
            }
        }

        impl std::ops::Deref for $name {
            type Target = crate::half_space::HalfSpace;

            fn deref(&self) -> &Self::Target {
                &self.0
            }
        }

        impl std::ops::DerefMut for $name {
            fn deref_mut(&mut self) -> &mut Self::Target {
                &mut self.0
            }
        }
    };
}
pub(crate) use half_space_scene;

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
    pub fn check(&self, checks: &mut Checks<'_>, body: &Aabb<2>, dt: f64, end_s: f64) {
        checks.inside("source.x_m", "the source", self.x_m, body, 0);
        checks.inside("source.y_m", "the source", self.y_m, body, 1);
        checks.pulse(&self.pulse(), dt, end_s);
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
        Kind::Word(&["sine", "half-sine", "sine-squared", "ricker", "step"]),
        "shape of the force over time",
    ),
    Field::new(
        "source.frequency_Hz",
        Kind::Number(Range::POSITIVE),
        "its frequency f; sine lasts 1/f, half-sine and sine-squared 1/(2f), in which step rises (Hz)",
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
