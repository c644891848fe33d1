//! compression-1d: a column of elastic soil struck at its top (S21, section 3.1, Eqs 5-7).
//!
//! ```text
//!   A  o=========  top: v = sin(2 pi f t) downward for half a period, then free
//!      ||       ||  left, right: roller
//!   B  o|       ||  A at the top, B five metres above the base
//!      ||_______||  base: roller | dashpot | damping layer | PML | extended
//! ```
//!
//! S21: Shan, Liao, Dong, Wang, Cui 2021, doi 10.1631/jzus.A2000399. Deviations from the paper:
//! - nu = 0.49 gives the 63 m/s that the paper states; the printed 0.3 gives 17.6 m/s (preset `printed`).
//! - Implicit, with nodal dashpots and the damping layer as a rate: the paper's layer depends on the
//!   time step; alpha = 0.01 over 10 m at its step (Courant number 0.4) is 15.7/s at the outer end.
//! - The layer's end is free: behind a fixed end the paper's 15 % is not met.
//! - The paper looks at the residual at t = 3 s, when A and B rest even over a roller: the largest of
//!   3..4 s is taken.
//! - Series are y-up, so the paper's pulse is negative. Metrics are taken of velocities: a half sine
//!   leaves a lasting displacement, which no echo is.

mod column;
mod layer;
mod paper;
mod values;

use crate::checks::Checks;
use crate::posed::Posed;
use crate::scene::{self, Reference, Scene, SceneClaim, SceneInfo, Window};
use crate::spec::*;
use anechoic_solver::probe::Probes;
use anechoic_solver::problem::{BasisKind, Drive, FlowSetup, Problem, Scheme, Side};
use anechoic_solver::wavelet::{Pulse, Wavelet};
use serde::{Deserialize, Serialize};

/// S21's step of explicit runs over the time that the fastest wave takes through a cell.
const COURANT: f64 = 0.4;

/// The scene; `Default` holds the paper's values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compression1d {
    /// Shape functions.
    pub basis: BasisKind,
    /// Size of the body.
    pub body: BodySpec,
    /// Background grid.
    pub grid: GridSpec,
    /// Time integration; the step defaults to 0.005 s per metre of cell, or 0.4 h/c_p where it is explicit.
    pub time: TimeSpec,
    /// Material points.
    pub points: PointsSpec,
    /// Linear solver.
    pub solver: SolverSpec,
    /// Soil.
    pub material: MaterialSpec,
    /// Motion of the top.
    pub source: Source,
    /// A (top) and B (5 m above the base).
    pub receivers: Vec<ReceiverSpec>,
    /// Sides; the method under test is at the bottom.
    pub boundary: BoundarySpec,
}

/// Motion of the top.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// Shape.
    pub wavelet: Wavelet,
    /// Largest velocity, downward (m/s).
    pub amplitude_m_s: f64,
    /// Frequency f (Hz).
    #[serde(rename = "frequency_Hz")]
    pub frequency: f64,
}

impl Default for Compression1d {
    fn default() -> Self {
        toml::from_str(values::PAPER).expect("the paper's values are a scene")
    }
}

/// The registry's entry.
pub static INFO: SceneInfo = SceneInfo {
    name: "compression-1d",
    title: "an elastic column struck at its top: the echo of its base",
    summary: "A block of soil, 50 m wide and high, is struck at its top with half a sine of vertical velocity. The wave runs down, meets the base, and whatever comes back is the base's doing: d'Alembert's solution is exact, so every number has a known truth.",
    source: "S21, section 3.1 (doi 10.1631/jzus.A2000399)",
    fields: &[
        NUMERICS,
        BODY,
        values::SOURCE,
        ELASTIC,
        INCLUSION,
        PROBES_AND_SIDES,
    ],
    profiles: values::PROFILES,
    presets: values::PRESETS,
    methods: values::METHODS,
    ablation: &[],
    sweeps: &[&layer::S21_LAYER],
    ledger: paper::LEDGER,
    standard: "fixed",
    defaults: scene::defaults::<Compression1d>,
    build: scene::build::<Compression1d>,
};

impl Compression1d {
    /// Time step (s).
    fn dt(&self) -> f64 {
        self.time.dt_s.unwrap_or_else(|| match self.time.scheme {
            Scheme::Explicit => COURANT * self.cell_m() / self.material.elastic().p_speed(),
            _ => 0.005 * self.cell_m(),
        })
    }

    /// The top's velocity over time, upward.
    fn pulse(&self) -> Pulse {
        Pulse {
            wavelet: self.source.wavelet,
            amplitude: -self.source.amplitude_m_s,
            frequency: self.source.frequency,
            t0: 0.0,
        }
    }

    /// What the solver is given.
    pub fn problem(&self) -> Problem<2> {
        let steps = self.time.end_s / self.dt();
        // Some 250 lines and 1000 energies make smooth pictures at any step size.
        let every = |samples: f64| (steps / samples).ceil().max(1.0) as usize;
        Problem {
            target: self.body.target(),
            cell_size: self.grid.h_m,
            aspect: self.grid.aspect(),
            basis: self.basis,
            scheme: self.time.scheme,
            mass: self.time.mass,
            dt: self.dt(),
            end_time: self.time.end_s,
            point_mode: self.points.mode,
            transfer: self.points.transfer,
            points_per_cell: self.points.per_cell,
            face_gap: self.points.face_gap,
            inclusion: self.material.inclusion,
            material: self.material.elastic(),
            flow: FlowSetup::default(),
            sides: self.boundary.sides(),
            drives: vec![Drive::SideVelocity {
                side: Side::TOP,
                pulse: self.pulse(),
            }],
            probes: Probes {
                receivers: self.receivers.iter().map(ReceiverSpec::probe).collect(),
                lines: vec![self.body.middle_line(every(250.0))],
                snapshot_times: Vec::new(),
                energy_every: Some(every(1000.0)),
            },
            solver: self.solver.kind,
            rel_tol: self.solver.rel_tol,
        }
    }
}

impl Scene for Compression1d {
    fn posed(&self) -> Posed {
        self.problem().into()
    }

    fn boundary(&self) -> &BoundarySpec {
        &self.boundary
    }

    fn check(&self, checks: &mut Checks<'_>) {
        let size = self.body.size();
        checks.cells(self.grid.h_m, size);
        checks.layers(&self.boundary, size);
        checks.points(&self.points);
        checks.receivers(&self.receivers, &self.body.target());
        checks.pulse(&self.pulse(), self.dt(), self.time.end_s);
        checks.step(self.dt(), self.time.end_s);
        checks.inertia(&self.time);
    }

    fn pulse_amplitude(&self) -> Option<f64> {
        Some(self.source.amplitude_m_s)
    }

    fn windows(&self) -> Vec<Window> {
        self.receivers
            .iter()
            .flat_map(|r| column::windows(self, r))
            .collect()
    }

    fn references(&self, times: &[f64]) -> Result<Vec<Reference>, String> {
        column::references(self, times)
    }

    fn claims(&self) -> Vec<SceneClaim> {
        column::claims(self)
    }

    /// Their height: waves run up and down alone.
    fn cell_m(&self) -> f64 {
        self.grid.cell(&self.body.target())[1]
    }

    fn orders(&self, sizes: &[f64]) -> Vec<SceneClaim> {
        column::orders(self, sizes)
    }

    fn serves_until_s(&self) -> Option<f64> {
        column::serves_until_s(self)
    }
}
