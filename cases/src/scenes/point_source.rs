//! point-source: a force on the surface of an elastic half-space (K25, sections 2 and 3.1).
//!
//! ```text
//!   1000        source A1   A2   A3   A4   3000   x (m)
//!    |------------v-----------------------|  y = 0: free
//!    |            .  o    o    o    o     |
//!    |            B1                      |  left, right, bottom:
//!    |            B2   C1                 |  fixed beyond 1000 m of elastic material (standard) |
//!    |            B3         C2           |  dashpot | damping layer | published layer |
//!    |            B4              C3      |  true perfectly matched layer | extended
//!    |____________________________________|  y = -2000
//! ```
//!
//! K25: Kurima, Chandra, Soga 2025, doi 10.1016/j.soildyn.2025.109219. Deviations from the paper:
//! - The printed geometry contradicts itself. The receivers' places are taken as printed (x from the
//!   corner of the whole mesh), which makes the target 2000 x 2000 m; the preset `counts` has the
//!   printed numbers of points. C2 and C3 get back the offset of 1000 m that A and C1 carry.
//! - The source's place, amplitude and the pulses' shapes stand in figures: 1120 m, 1e6 N/m, one full
//!   sine of 2 Hz or a Ricker wavelet of 3 Hz. Without movement the problem is linear in the force.
//! - Receivers are massless tracers at the exact places.
//! - There is no closed form: the reference is the same scheme on the same mesh, extended until
//!   nothing can come back (certified); it judges the boundary alone.

mod claims;
mod methods;
mod paper;
mod values;

use crate::checks::Checks;
use crate::half_space::{Source, TARGET_AND_SOURCE, TargetSpec};
use crate::scene::{self, Reference, Scene, SceneClaim, SceneInfo, Window};
use crate::spec::*;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::probe::Probes;
use anechoic_solver::problem::{BasisKind, Problem, Scheme};
use serde::{Deserialize, Serialize};

/// The scene; `Default` holds the paper's values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointSource {
    /// Shape functions.
    pub basis: BasisKind,
    /// From when on echoes are looked for (s).
    pub t1_s: f64,
    /// The body of interest.
    pub target: TargetSpec,
    /// Background grid.
    pub grid: GridSpec,
    /// Time integration.
    pub time: TimeSpec,
    /// Material points.
    pub points: PointsSpec,
    /// Linear solver.
    pub solver: SolverSpec,
    /// Soil.
    pub material: MaterialSpec,
    /// The force.
    pub source: Source,
    /// A along the surface, B downward, C along the diagonal.
    pub receivers: Vec<ReceiverSpec>,
    /// Sides; the method under test is left, right and at the bottom.
    pub boundary: BoundarySpec,
}

impl Default for PointSource {
    fn default() -> Self {
        toml::from_str(values::PAPER).expect("the paper's values are a scene")
    }
}

/// The registry's entry.
pub static INFO: SceneInfo = SceneInfo {
    name: "point-source",
    title: "a force on an elastic half-space: the echo of a mesh's edges",
    summary: "A short force on the surface of a half-space sends out compressional, shear and surface waves. The mesh ends somewhere, and whatever comes back from there is the boundary method's doing. The reference is the same scheme on a mesh so large that nothing can come back in time.",
    source: "K25, sections 2 and 3.1 (doi 10.1016/j.soildyn.2025.109219)",
    fields: &[NUMERICS, TARGET_AND_SOURCE, ELASTIC, PROBES_AND_SIDES],
    profiles: values::PROFILES,
    presets: values::PRESETS,
    methods: methods::METHODS,
    ablation: methods::ABLATION,
    ledger: paper::LEDGER,
    standard: "fixed",
    defaults: scene::defaults::<PointSource>,
    build: scene::build::<PointSource>,
};

/// Times (s) at which the paper shows the field.
const SNAPSHOTS: [f64; 4] = [2.0, 4.0, 6.0, 10.0];

/// Energies in a run: enough for pictures and for the growth rate's windows.
const ENERGIES: f64 = 200.0;

impl PointSource {
    /// Time step (s).
    fn dt(&self) -> f64 {
        self.time.dt_s.unwrap_or(0.01)
    }
}

impl Scene for PointSource {
    fn problem(&self) -> Problem<2> {
        let end = self.time.end_s;
        let steps = end / self.dt();
        Problem {
            target: self.target.body(),
            cell_size: self.grid.h_m,
            basis: self.basis,
            scheme: self.time.scheme,
            mass: self.time.mass,
            dt: self.dt(),
            end_time: end,
            point_mode: self.points.mode,
            transfer: self.points.transfer,
            points_per_cell: self.points.per_cell,
            material: self.material.elastic(),
            sides: self.boundary.sides(),
            drives: vec![self.source.force()],
            probes: Probes {
                receivers: self.receivers.iter().map(ReceiverSpec::probe).collect(),
                lines: Vec::new(),
                snapshot_times: SNAPSHOTS.into_iter().filter(|t| *t <= end).collect(),
                energy_every: Some((steps / ENERGIES).ceil().max(1.0) as usize),
            },
            solver: self.solver.kind,
            rel_tol: self.solver.rel_tol,
        }
    }

    fn boundary(&self) -> &BoundarySpec {
        &self.boundary
    }

    fn check(&self, checks: &mut Checks<'_>) {
        let body = self.target.body();
        self.target.check(checks);
        checks.layers(&self.boundary, self.target.size());
        checks.points(&self.points);
        checks.receivers(&self.receivers, &body);
        self.source.check(checks, &body, self.time.end_s);
        checks.step(self.dt(), self.time.end_s);
        checks.require(self.t1_s < self.time.end_s, "t1_s", || {
            format!(
                "no time is left for echoes: the run ends at time.end_s = {} s",
                self.time.end_s
            )
        });
        checks.require(self.time.scheme == Scheme::Newmark, "time.scheme", || {
            "a pulse is lost without inertia; allowed: \"newmark\"".into()
        });
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

    fn extended(&self) -> Option<Problem<2>> {
        let mut problem = self.problem();
        for side in problem.sides.iter_mut().flatten() {
            // What is free or a plane of symmetry belongs to the scene; all else is a way to end it.
            if !["free", "roller"].contains(&side.method.as_str()) {
                *side = SideMethod::new("extended");
            }
        }
        Some(problem)
    }

    fn paper_test(&self) -> Option<&'static str> {
        paper::test(self)
    }

    fn claims(&self) -> Vec<SceneClaim> {
        claims::claims(self)
    }

    fn cell_m(&self) -> f64 {
        self.grid.cell_m(&self.target.body())
    }
}
