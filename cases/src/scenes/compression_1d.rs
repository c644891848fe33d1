//! compression-1d: a column of elastic soil struck at its top (S21, section 3.1, Eqs 5-7).
//!
//! ```text
//!   A  o=========  top: v = sin(2 pi f t) downward for half a period, then free
//!      ||       ||  left, right: roller
//!   B  o|       ||  A at the top, B five metres above the base
//!      ||_______||  base: roller | dashpot | damping layer | extended
//! ```
//!
//! S21: Shan, Fang, Wang, Chen 2021, doi 10.1631/jzus.A2000399. Deviations from the paper:
//! - nu = 0.49 gives the 63 m/s that the paper states; the printed 0.3 gives 17.6 m/s (preset `printed`).
//! - Implicit, with nodal dashpots and the damping layer as a rate: the paper's layer depends on the
//!   time step; alpha = 0.01 over 10 m at its step (Courant number 0.4) is 15.7/s at the outer end.
//! - The layer's end is free: behind a fixed end the paper's 15 % is not met.
//! - The paper looks at the residual at t = 3 s, when A and B rest even over a roller: the largest of
//!   3..4 s is taken.
//! - Series are y-up, so the paper's pulse is negative. Metrics are taken of velocities: a half sine
//!   leaves a lasting displacement, which no echo is.

mod column;
mod paper;

use crate::checks::Checks;
use crate::field::{Field, Kind, Range};
use crate::scene::{self, Overlay, Reference, Scene, SceneClaim, SceneInfo, Window};
use crate::spec::*;
use anechoic_solver::probe::{LineProbe, Probes};
use anechoic_solver::problem::{
    Aabb, BasisKind, Drive, Problem, Scheme, Side,
};
use anechoic_solver::wavelet::{Pulse, Wavelet};
use serde::{Deserialize, Serialize};

/// The scene; `Default` holds the paper's values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Compression1d {
    /// Shape functions.
    pub basis: BasisKind,
    /// Size of the body.
    pub body: BodySpec,
    /// Background grid.
    pub grid: GridSpec,
    /// Time integration; the step defaults to 0.005 s per metre of cell.
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

/// The paper's values.
const PAPER: &str = r#"
basis = "linear"
body = { width_m = 50.0, height_m = 50.0 }
grid = { h_m = 1.0 }
time = { scheme = "newmark", end_s = 5.0 }
points = { mode = "moving", transfer = "affine", per_cell = 4 }
solver = { rel_tol = 1e-10, kind = "auto" }
material = { E_Pa = 150e3, nu = 0.49, rho_kg_m3 = 650.0 }
source = { wavelet = "half-sine", amplitude_m_s = 1.0, frequency_Hz = 1.0 }
receivers = [{ name = "A", x_m = 25.0, y_m = 50.0 }, { name = "B", x_m = 25.0, y_m = 5.0 }]

[boundary]
left = { method = "roller" }
right = { method = "roller" }
bottom = { method = "roller" }
top = { method = "free" }
"#;

impl Default for Compression1d {
    fn default() -> Self {
        toml::from_str(PAPER).expect("the text above is a scene")
    }
}

const OWN_FIELDS: &[Field] = &[
    Field::new(
        "source.wavelet",
        Kind::Word(&["half-sine", "sine-squared", "sine"]),
        "shape of the top's velocity",
    ),
    Field::new(
        "source.amplitude_m_s",
        Kind::Number(Range::POSITIVE),
        "largest velocity of the top, downward (m/s)",
    ),
    Field::new(
        "source.frequency_Hz",
        Kind::Number(Range::POSITIVE),
        "its frequency f; half-sine and sine-squared last 1/(2f) (Hz)",
    ),
];

const PROFILES: &[Overlay] = &[
    Overlay::new(
        "gate",
        "as quick, to 4 s",
        "points = { mode = 'frozen', transfer = 'keep' }
        source.amplitude_m_s = 1e-3
        time.end_s = 4.0",
    ),
    Overlay::new(
        "quick",
        "frozen points, amplitude 1e-3 m/s: the targets hold",
        "points = { mode = 'frozen', transfer = 'keep' }
        source.amplitude_m_s = 1e-3",
    ),
    Overlay::new("paper", "moving points, amplitude 1 m/s as printed", ""),
];

const PRESETS: &[Overlay] = &[
    Overlay::new(
        "linear",
        "amplitude 1e-3 m/s, at which d'Alembert holds",
        "source.amplitude_m_s = 1e-3",
    ),
    Overlay::new(
        "printed",
        "Poisson's ratio 0.3 as printed: 17.6 m/s",
        "material.nu = 0.3",
    ),
];

const METHODS: &[Overlay] = &[
    Overlay::new(
        "fixed",
        "base on rollers: everything comes back",
        "boundary.bottom.method = 'roller'",
    ),
    Overlay::new(
        "dashpot",
        "viscous traction rho c_p on the base",
        "boundary.bottom.method = 'dashpot'",
    ),
    Overlay::new(
        "damping-layer",
        "the lowest 10 m are damped",
        "[boundary.bottom]
        method = 'damping-layer'
        placement = 'inside'
        thickness_m = 10.0
        power = 1.0
        sigma_max_per_s = 15.7
        end = 'free'",
    ),
    Overlay::new(
        "extended",
        "the column goes on below the base",
        "boundary.bottom.method = 'extended'",
    ),
];

/// The registry's entry.
pub static INFO: SceneInfo = SceneInfo {
    name: "compression-1d",
    title: "an elastic column struck at its top: the echo of its base",
    summary: "A block of soil, 50 m wide and high, is struck at its top with half a sine of vertical velocity. The wave runs down, meets the base, and whatever comes back is the base's doing: d'Alembert's solution is exact, so every number has a known truth.",
    source: "S21, section 3.1 (doi 10.1631/jzus.A2000399)",
    fields: &[NUMERICS, BODY, OWN_FIELDS, ELASTIC, PROBES_AND_SIDES],
    profiles: PROFILES,
    presets: PRESETS,
    methods: METHODS,
    ledger: paper::LEDGER,
    standard: "fixed",
    defaults: scene::defaults::<Compression1d>,
    build: scene::build::<Compression1d>,
};

impl Compression1d {
    /// Time step (s).
    fn dt(&self) -> f64 {
        self.time.dt_s.unwrap_or(0.005 * self.grid.h_m)
    }

    /// The top's velocity over time, upward.
    fn pulse(&self) -> Pulse {
        Pulse { wavelet: self.source.wavelet, amplitude: -self.source.amplitude_m_s, frequency: self.source.frequency, t0: 0.0 }
    }
}

impl Scene for Compression1d {
    fn problem(&self) -> Problem<2> {
        let (width, height, h) = (self.body.width_m, self.body.height_m, self.grid.h_m);
        let steps = self.time.end_s / self.dt();
        // Some 250 lines and 1000 energies make smooth pictures at any step size.
        let every = |samples: f64| (steps / samples).ceil().max(1.0) as usize;
        Problem {
            target: Aabb { lower: [0.0; 2], upper: [width, height] },
            cell_size: h,
            basis: self.basis,
            scheme: self.time.scheme,
            dt: self.dt(),
            end_time: self.time.end_s,
            point_mode: self.points.mode,
            transfer: self.points.transfer,
            points_per_cell: self.points.per_cell,
            material: self.material.elastic(),
            sides: self.boundary.sides(),
            drives: vec![Drive::SideVelocity { side: Side::TOP, pulse: self.pulse() }],
            probes: Probes {
                receivers: self.receivers.iter().map(ReceiverSpec::probe).collect(),
                lines: vec![LineProbe { from: [0.5 * width, 0.0], to: [0.5 * width, height], samples: 101, component: 1, every: every(250.0) }],
                snapshot_times: Vec::new(),
                energy_every: Some(every(1000.0)),
            },
            solver: self.solver.kind,
            rel_tol: self.solver.rel_tol,
        }
    }

    fn boundary(&self) -> &BoundarySpec {
        &self.boundary
    }

    fn check(&self, checks: &mut Checks<'_>) {
        let (size, h) = ([self.body.width_m, self.body.height_m], self.grid.h_m);
        checks.whole_cells("body.width_m", size[0], h);
        checks.whole_cells("body.height_m", size[1], h);
        checks.layers(&self.boundary, size, h);
        checks.points(&self.points);
        checks.receivers(&self.receivers, size);
        checks.pulse(&self.pulse(), self.time.end_s);
        checks.step(self.dt(), self.time.end_s);
        checks.require(self.time.scheme == Scheme::Newmark, "time.scheme", || {
            "a pulse is lost without inertia; allowed: \"newmark\"".into()
        });
    }

    fn pulse_amplitude(&self) -> f64 {
        self.source.amplitude_m_s
    }

    fn windows(&self) -> Vec<Window> {
        self.receivers.iter().flat_map(|r| column::windows(self, r)).collect()
    }

    fn references(&self, times: &[f64]) -> Result<Vec<Reference>, String> {
        column::references(self, times)
    }

    fn claims(&self) -> Vec<SceneClaim> {
        column::claims(self)
    }
}
