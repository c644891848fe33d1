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

mod appendix;
mod claims;
mod methods;
mod paper;
mod settlement;
mod values;

use crate::checks::Checks;
use crate::half_space::{TARGET_AND_SOURCE, half_space_scene};
use crate::posed::Posed;
use crate::scene::{self, Reference, Scene, SceneClaim, SceneInfo, Window};
use crate::spec::*;
use anechoic_reference::claim::Claim;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::problem::Problem;

half_space_scene!(
    /// The scene; `Default` holds the paper's values.
    PointSource,
    values::PAPER
);

/// The registry's entry.
pub static INFO: SceneInfo = SceneInfo {
    name: "point-source",
    title: "a force on an elastic half-space: the echo of a mesh's edges",
    summary: "A short force on the surface of a half-space sends out compressional, shear and surface waves. The mesh ends somewhere, and whatever comes back from there is the boundary method's doing. The reference is the same scheme on a mesh so large that nothing can come back in time.",
    source: "K25, sections 2 and 3.1 (doi 10.1016/j.soildyn.2025.109219)",
    fields: &[
        NUMERICS,
        TARGET_AND_SOURCE,
        ELASTIC,
        INCLUSION,
        PROBES_AND_SIDES,
    ],
    profiles: values::PROFILES,
    presets: values::PRESETS,
    methods: methods::METHODS,
    ablation: methods::ABLATION,
    sweeps: &[&appendix::APPENDIX_A],
    ledger: paper::LEDGER,
    standard: "fixed",
    defaults: scene::defaults::<PointSource>,
    build: scene::build::<PointSource>,
};

/// Times (s) at which the paper shows the field.
const SNAPSHOTS: [f64; 4] = [2.0, 4.0, 6.0, 10.0];

impl PointSource {
    /// Time step (s).
    fn dt(&self) -> f64 {
        self.time.dt_s.unwrap_or(0.01)
    }

    /// What the solver is given.
    pub fn problem(&self) -> Problem<2> {
        let end = self.time.end_s;
        let shown = SNAPSHOTS.into_iter().filter(|t| *t <= end);
        self.0.problem(self.dt(), shown.collect())
    }
}

impl Scene for PointSource {
    fn posed(&self) -> Posed {
        self.problem().into()
    }

    fn boundary(&self) -> &BoundarySpec {
        &self.boundary
    }

    fn check(&self, checks: &mut Checks<'_>) {
        self.0.check(checks, self.dt());
    }

    fn pulse_amplitude(&self) -> Option<f64> {
        None
    }

    fn windows(&self) -> Vec<Window> {
        self.0.windows()
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

    fn paper_test(&self) -> Option<&'static str> {
        paper::test(self)
    }

    fn claims(&self) -> Vec<SceneClaim> {
        claims::claims(self)
    }

    fn trades(&self) -> Vec<Claim> {
        claims::trades(self)
    }

    fn cell_m(&self) -> f64 {
        self.0.cell_m()
    }
}
