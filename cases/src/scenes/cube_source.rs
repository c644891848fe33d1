//! cube-source: a force on the surface of an elastic half-space in three dimensions.
//!
//! ```text
//!            y                        the quarter x > 0, z > 0 of a block of ground:
//!            |                        left (x = 0) and back (z = 0) are planes of symmetry (rollers),
//!            v force                  the top (y = 0) is free,
//!   A2   A1  |______ A1 __ A2 ___ x   right, front and bottom:
//!          / B1     |      |          fixed beyond 8 cells of elastic material (standard) |
//!        /   |  C1  |      |          dashpot | damping layer | true perfectly matched layer |
//!      z    B2      | C2   |          extended
//!            |______|______|  y = -400 m
//! ```
//!
//! No paper has it: it shows what boundaries of solids do where faces, edges and corners of layers meet.
//! The material is point-source's (c_p = 1095 m/s, c_s = 632 m/s); a Ricker wavelet of 3 Hz has shear waves
//! of 211 m, 10.5 cells of 20 m. Steps are explicit, 0.55 of the time of a compressional wave through a
//! cell. The quarter of the force acts on the quarter of the ground. There is no closed form: the reference
//! is the same scheme on the same mesh, extended until nothing can come back (certified).

mod claims;
mod values;

use crate::checks::Checks;
use crate::posed::Posed;
use crate::scene::{self, Reference, Scene, SceneClaim, SceneInfo, Window};
use crate::spec::*;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::probe::Probes;
use anechoic_solver::problem::{Aabb, BasisKind, Drive, FlowSetup, Problem, Scheme};
use anechoic_solver::wavelet::{Pulse, Wavelet};
use serde::{Deserialize, Serialize};

/// The scene; `Default` holds the values of the profile `paper`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CubeSource {
    /// Shape functions.
    pub basis: BasisKind,
    /// From when on echoes are looked for (s).
    pub t1_s: f64,
    /// The body of interest.
    pub target: Cube,
    /// Background grid.
    pub grid: GridSpec,
    /// Time integration.
    pub time: TimeSpec,
    /// Material points.
    pub points: PointsSpec,
    /// Linear solver of implicit steps.
    pub solver: SolverSpec,
    /// Soil.
    pub material: MaterialSpec,
    /// The force.
    pub source: Source,
    /// Anywhere in the body.
    pub receivers: Vec<ReceiverSpec>,
    /// Sides; the method under test is right, in front and at the bottom.
    pub boundary: BoundarySpec,
}

/// The quarter of a block below the surface y = 0, symmetric about x = 0 and z = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cube {
    /// Its edges (m).
    pub size_m: f64,
}

impl Cube {
    /// The solver's box.
    pub fn body(&self) -> Aabb<3> {
        Aabb {
            lower: [0.0, -self.size_m, 0.0],
            upper: [self.size_m, 0.0, self.size_m],
        }
    }
}

/// The force at the origin, downward.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Shape over time.
    pub wavelet: Wavelet,
    /// Frequency f (Hz).
    #[serde(rename = "frequency_Hz")]
    pub frequency: f64,
    /// Largest force on the whole ground (N); a quarter of it acts on the quarter.
    #[serde(rename = "amplitude_N")]
    pub amplitude: f64,
    /// Centre of the Ricker wavelet (s).
    pub t0_s: f64,
}

/// The registry's entry.
pub static INFO: SceneInfo = SceneInfo {
    name: "cube-source",
    title: "a force on a half-space in three dimensions: layers that meet in edges and corners",
    summary: "A short force on the surface of a block of ground sends out waves in all directions; two planes of symmetry leave a quarter to solve. Where the sides' layers meet they have edges and a corner, which the plane does not know. The reference is the same scheme on a mesh so large that nothing can come back in time.",
    source: "this program's own; the layer after Basu & Chopra 2004",
    fields: &[
        NUMERICS,
        values::FIELDS,
        ELASTIC,
        INCLUSION,
        PROBES_AND_SIDES,
        SIDES_IN_SPACE,
    ],
    profiles: values::PROFILES,
    presets: values::PRESETS,
    methods: values::METHODS,
    ablation: &[],
    sweeps: &[],
    ledger: &[],
    standard: "fixed",
    defaults: scene::defaults::<CubeSource>,
    build: scene::build::<CubeSource>,
};

/// Explicit steps, over the time of a compressional wave through a cell: trilinear cells are stable up to
/// about 1.01.
const COURANT: f64 = 0.55;

/// Times (s) at which the field is shown.
const SNAPSHOTS: [f64; 3] = [0.6, 0.9, 1.2];

/// Energies in a run: enough for pictures and for the growth rate's windows.
const ENERGIES: f64 = 200.0;

impl Default for CubeSource {
    fn default() -> Self {
        toml::from_str(values::WHOLE).expect("the scene's own values are a scene")
    }
}

impl CubeSource {
    /// Time step (s).
    fn dt(&self) -> f64 {
        self.time.dt_s.unwrap_or_else(|| match self.time.scheme {
            Scheme::Explicit => COURANT * self.cell_m() / self.material.elastic().p_speed(),
            _ => 0.01,
        })
    }

    fn pulse(&self) -> Pulse {
        Pulse {
            wavelet: self.source.wavelet,
            amplitude: 0.25 * self.source.amplitude,
            frequency: self.source.frequency,
            t0: self.source.t0_s,
        }
    }

    /// What the solver is given.
    pub fn problem(&self) -> Problem<3> {
        let (dt, end) = (self.dt(), self.time.end_s);
        let shown = SNAPSHOTS.into_iter().filter(|t| *t <= end);
        Problem {
            target: self.target.body(),
            cell_size: self.grid.h_m,
            aspect: self.grid.aspect(),
            face_gap: self.points.face_gap,
            inclusion: self.material.inclusion,
            basis: self.basis,
            scheme: self.time.scheme,
            mass: self.time.mass,
            dt,
            end_time: end,
            point_mode: self.points.mode,
            transfer: self.points.transfer,
            points_per_cell: self.points.per_cell,
            material: self.material.elastic(),
            flow: FlowSetup::default(),
            sides: self.boundary.sides_in_space(),
            drives: vec![Drive::PointForce {
                place: [0.0; 3],
                direction: [0.0, -1.0, 0.0],
                pulse: self.pulse(),
            }],
            probes: Probes {
                receivers: self.receivers.iter().map(ReceiverSpec::probe).collect(),
                lines: Vec::new(),
                snapshot_times: shown.collect(),
                energy_every: Some((end / dt / ENERGIES).ceil().max(1.0) as usize),
            },
            solver: self.solver.kind,
            rel_tol: self.solver.rel_tol,
        }
    }
}

impl Scene for CubeSource {
    fn posed(&self) -> Posed {
        self.problem().into()
    }

    fn boundary(&self) -> &BoundarySpec {
        &self.boundary
    }

    fn check(&self, checks: &mut Checks<'_>) {
        let body = self.target.body();
        checks.layers(&self.boundary, [self.target.size_m; 3]);
        checks.points_in_space(&self.points);
        checks.receivers(&self.receivers, &body);
        for (index, receiver) in self.receivers.iter().enumerate() {
            let apart = [receiver.x_m, receiver.y_m, receiver.z_m] != [0.0; 3];
            checks.require(apart, &format!("receivers[{index}].x_m"), || {
                format!(
                    "receiver {} is at the force, where the displacement has no limit; move it away",
                    receiver.name
                )
            });
        }
        checks.pulse(&self.pulse(), self.dt(), self.time.end_s);
        checks.step(self.dt(), self.time.end_s);
        checks.require(self.t1_s < self.time.end_s, "t1_s", || {
            format!(
                "no time is left for echoes: the run ends at time.end_s = {} s",
                self.time.end_s
            )
        });
        checks.inertia(&self.time);
    }

    fn pulse_amplitude(&self) -> Option<f64> {
        None
    }

    fn windows(&self) -> Vec<Window> {
        let window = |receiver: &ReceiverSpec| Window {
            receiver: receiver.name.clone(),
            label: String::new(),
            from_s: self.t1_s,
            to_s: None,
            stated_by: None,
        };
        self.receivers.iter().map(window).collect()
    }

    fn references(&self, _times: &[f64]) -> Result<Vec<Reference>, String> {
        Ok(Vec::new())
    }

    fn extended(&self) -> Option<Posed> {
        let mut problem = self.problem();
        for side in problem.sides.iter_mut().flatten() {
            // What is free or a plane of symmetry belongs to the scene; all else is a way to end it.
            if !["free", "roller"].contains(&side.method.as_str()) {
                *side = SideMethod::new("extended");
            }
        }
        Some(problem.into())
    }

    fn claims(&self) -> Vec<SceneClaim> {
        claims::claims(self)
    }

    fn cell_m(&self) -> f64 {
        let edges = self.grid.cell(&self.target.body());
        edges.into_iter().fold(0.0, f64::max)
    }
}
