//! lamb: a line force on an elastic half-space, against the closed form (Lamb 1904).
//!
//! ```text
//!  -100   source                R1                    1000   x (m)
//!    |------v--------------------o----------------------|  y = 0: free
//!    |               o R2                               |
//!    |                                                  |  left, right, bottom:
//!    |                                           o R3   |  extended (the solver against Lamb) |
//!    |      o R4                                        |  fixed | dashpot | damping layer |
//!    |__________________________________________________|  true perfectly matched layer
//!                                                           y = -700
//! ```
//!
//! Lamb 1904, Phil. Trans. R. Soc. A 203, solved by the contour of Cagniard 1939 and de Hoop 1960. The
//! material is that of `point-source` (K25 3.1), whose certified reference cannot see what it shares
//! with the solver: the scheme and the mesh. Lamb's solution shares nothing with it.
//! - A force of 1 N/m moves nothing visibly: the problem is linear, and moving points test their
//!   transfer alone.
//! - The step is 0.0005 s per metre of cell unless it is given, so that space and time are refined
//!   together.
//! - Extended sides get as much material as this source needs until the end of the run.

mod claims;
mod exact;
mod values;

use crate::certified::causality::{serves_until, with_buffers};
use crate::checks::Checks;
use crate::half_space::{TARGET_AND_SOURCE, half_space_scene};
use crate::posed::Posed;
use crate::scene::{self, Reference, Scene, SceneClaim, SceneInfo, Window};
use crate::spec::*;
use anechoic_solver::problem::Problem;
use anechoic_solver::wavelet::Wavelet;

half_space_scene!(
    /// The scene; `Default` holds its own values.
    Lamb,
    values::VALUES
);

/// The registry's entry.
pub static INFO: SceneInfo = SceneInfo {
    name: "lamb",
    title: "a line force on an elastic half-space, against Lamb's closed form",
    summary: "A short force on the surface of a half-space sends out compressional, shear and surface waves. Lamb's solution says what every receiver feels at every time, so it judges both: the solver, on a mesh so large that nothing comes back, and boundary methods on a small one.",
    source: "Lamb 1904 (doi 10.1098/rsta.1904.0013); material of K25, section 3.1",
    fields: &[
        NUMERICS,
        TARGET_AND_SOURCE,
        ELASTIC,
        INCLUSION,
        PROBES_AND_SIDES,
    ],
    profiles: values::PROFILES,
    presets: values::PRESETS,
    methods: values::METHODS,
    ablation: &[],
    sweeps: &[],
    ledger: &[],
    standard: "fixed",
    defaults: scene::defaults::<Lamb>,
    build: scene::build::<Lamb>,
};

/// Time step per metre of cell (s/m): a Courant number of 0.55 of the compressional wave of the
/// scene's own material.
const STEP_PER_METRE: f64 = 0.0005;

/// Panels of the finer quadrature over those of the usual one.
const FINER: f64 = 0.25;

impl Lamb {
    /// Time step (s).
    fn dt(&self) -> f64 {
        self.time.dt_s.unwrap_or(STEP_PER_METRE * self.cell_m())
    }

    /// What the solver is given.
    pub fn problem(&self) -> Problem<2> {
        let end = self.time.end_s;
        let problem = self.0.problem(self.dt(), vec![0.5 * end, end]);
        with_buffers(&problem, 1.0)
    }
}

impl Scene for Lamb {
    fn posed(&self) -> Posed {
        self.problem().into()
    }

    fn boundary(&self) -> &BoundarySpec {
        &self.boundary
    }

    fn check(&self, checks: &mut Checks<'_>) {
        self.0.check(checks, self.dt());
        checks.require(self.source.y_m == 0.0, "source.y_m", || {
            format!(
                "{} m is not on the surface, where Lamb's force acts; allowed: 0",
                self.source.y_m
            )
        });
        let start = self.source.pulse().value(0.0).abs() / self.source.amplitude;
        let ricker = self.source.wavelet == Wavelet::Ricker;
        checks.require(!ricker || start <= exact::LARGEST_START, "source.t0_s", || {
            format!(
                "the wavelet starts with a jump of {start:.1e} of its peak, under which the surface has no limit; allowed: so late that it is at most {:e}, for example {:.2} s",
                exact::LARGEST_START,
                1.25 / self.source.frequency
            )
        });
    }

    fn pulse_amplitude(&self) -> Option<f64> {
        None
    }

    fn windows(&self) -> Vec<Window> {
        self.0.windows()
    }

    fn references(&self, times: &[f64]) -> Result<Vec<Reference>, String> {
        exact::references(self, times, 1.0)
    }

    fn finer_references(&self, times: &[f64]) -> Result<Option<Vec<Reference>>, String> {
        exact::references(self, times, FINER).map(Some)
    }

    fn claims(&self) -> Vec<SceneClaim> {
        claims::claims(self)
    }

    fn cell_m(&self) -> f64 {
        self.0.cell_m()
    }

    fn orders(&self, sizes: &[f64]) -> Vec<SceneClaim> {
        claims::orders(self, sizes)
    }

    fn serves_until_s(&self) -> Option<f64> {
        serves_until(&self.problem())
    }
}
