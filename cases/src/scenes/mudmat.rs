//! mudmat: a slide of soft clay runs against a mudmat that stands out of the base (S21, section 3.2).
//!
//! ```text
//!   -L                              0    free
//!    |------------------------------|  y = 10 m
//!    |  slide, 6 m/s ->     o B     |        A 0.1 m high, 8 m upstream; B 5 m high, 2.5 m upstream
//!    |             A                |____________
//!    |_____________o________________| mudmat     |  y = e = 1 m
//!    ============================================   smooth rigid base, y = 0
//! ```
//!
//! S21: Shan, Liao, Dong, Wang, Cui 2021, doi 10.1631/jzus.A2000399. Deviations from the paper:
//! - Eq (9) as printed vanishes in simple shear; the rate of shear is that of the principal strain rates.
//! - The stress at the start is not stated: it carries the weight, K0 = nu/(1 - nu); preset `weightless`.
//! - The dashpot lies on the material's own top and moves with it; the layer and the inflow move at 6 m/s,
//!   and damp what departs from it.
//! - The mudmat's corners are arcs of half a cell, so that the normal turns.

mod claims;
mod paper;
mod values;

use crate::checks::Checks;
use crate::field::{Field, Kind, Range};
use crate::posed::Posed;
use crate::scene::{self, Beside, Curve, OwnNumber, OwnPicture, Scene, SceneClaim, SceneInfo};
use crate::spec::*;
use anechoic_solver::boundary::extended;
use anechoic_solver::contact::Contact;
use anechoic_solver::contact::body::{Motion, RigidBody};
use anechoic_solver::contact::shape::Shape;
use anechoic_solver::material::herschel_bulkley::RateStrength;
use anechoic_solver::material::strength::Strength;
use anechoic_solver::probe::Probes;
use anechoic_solver::problem::{
    Aabb, BasisKind, FlowSetup, Intruder, PointMode, Problem, Scheme, SolverKind,
};
use anechoic_solver::record::Record;
use serde::{Deserialize, Serialize};

/// The scene; `Default` holds the paper's values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mudmat {
    /// Shape functions.
    pub basis: BasisKind,
    /// Size of the slide; its front is at x = 0.
    pub body: BodySpec,
    /// Background grid.
    pub grid: GridSpec,
    /// Time integration; the step is the given share of the time of the fastest wave through a cell.
    pub time: SlideTime,
    /// Material points.
    pub points: PointsSpec,
    /// Explicit steps.
    pub flow: FlowSpec,
    /// Soft clay.
    pub material: SoftClay,
    /// How the slide runs.
    pub slide: Slide,
    /// The mudmat.
    pub mudmat: Mat,
    /// Anywhere in the slide; they move with it.
    pub receivers: Vec<ReceiverSpec>,
    /// Sides of the slide: inflow or a layer with it on the left, free or a dashpot on top.
    pub boundary: BoundarySpec,
}

/// Time integration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SlideTime {
    /// Scheme.
    pub scheme: Scheme,
    /// Time step over the time that the fastest wave takes through a cell.
    pub courant: f64,
    /// End of the run (s).
    pub end_s: f64,
}

/// Clay whose strength grows with the rate of shear.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SoftClay {
    /// Elastic constants and density.
    #[serde(flatten)]
    pub elastic: MaterialSpec,
    /// Strength at rest s_u0 (Pa).
    #[serde(rename = "s_u0_Pa")]
    pub strength: f64,
    /// Viscosity coefficient mu.
    pub viscosity: f64,
    /// Shear-thinning index n.
    pub index: f64,
    /// Reference rate of shear (1/s).
    pub reference_rate_1_s: f64,
}

/// How the slide runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slide {
    /// Velocity at the start, towards the mudmat (m/s).
    pub velocity_m_s: f64,
    /// Gravity less buoyancy (m/s2).
    pub gravity_m_s2: f64,
}

/// The mudmat.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Mat {
    /// Height e above the base (m).
    pub exposed_m: f64,
    /// Length along the way (m).
    pub length_m: f64,
    /// Coulomb's coefficient; 0 is smooth.
    pub friction: f64,
    /// How far outside it a node may lie to be touched, over the edge of a cell.
    pub reach: f64,
}

const END: &[Field] = &[Field::new(
    "time.end_s",
    Kind::Number(Range::POSITIVE),
    "end of the run (s)",
)];

const SLIDE: &[Field] = &[
    Field::new(
        "material.s_u0_Pa",
        Kind::Number(Range::POSITIVE),
        "shear strength at rest (Pa)",
    ),
    Field::new(
        "material.viscosity",
        Kind::Number(Range::within(0.0, 1e6)),
        "viscosity coefficient mu of Herschel and Bulkley",
    ),
    Field::new(
        "material.index",
        Kind::Number(Range {
            max: 1.0,
            max_open: false,
            ..Range::POSITIVE
        }),
        "shear-thinning index n",
    ),
    Field::new(
        "material.reference_rate_1_s",
        Kind::Number(Range::POSITIVE),
        "reference rate of shear (1/s)",
    ),
    Field::new(
        "slide.velocity_m_s",
        Kind::Number(Range::POSITIVE),
        "velocity at the start, towards the mudmat (m/s)",
    ),
    Field::new(
        "slide.gravity_m_s2",
        Kind::Number(Range::within(0.0, 1e3)),
        "gravity less buoyancy, (1 - rho_w/rho) g (m/s2)",
    ),
    Field::new(
        "mudmat.exposed_m",
        Kind::Number(Range::POSITIVE),
        "height e of the mudmat above the base (m)",
    ),
    Field::new(
        "mudmat.length_m",
        Kind::Number(Range::POSITIVE),
        "length of the mudmat along the way (m)",
    ),
    Field::new(
        "mudmat.friction",
        Kind::Number(Range::within(0.0, 10.0)),
        "Coulomb's coefficient; 0 is smooth",
    ),
    Field::new(
        "mudmat.reach",
        Kind::Number(Range::within(0.0, 1.0)),
        "how far outside it a node may lie to be touched, over a cell's edge",
    ),
];

impl Default for Mudmat {
    fn default() -> Self {
        toml::from_str(values::PAPER).expect("the paper's values are a scene")
    }
}

/// The registry's entry.
pub static INFO: SceneInfo = SceneInfo {
    name: "mudmat",
    title: "a slide against a mudmat: the echo of its top and of its end",
    summary: "A slide of soft clay, 10 m high, runs at 6 m/s against a mudmat that stands one metre out of the base. The blow sends out a wave; it comes back from the slide's free top and from where the model ends, and shakes the pressure on the mudmat.",
    source: "S21, section 3.2 (doi 10.1631/jzus.A2000399)",
    fields: &[
        FLOW_NUMERICS,
        END,
        FLOW,
        BODY,
        ELASTIC,
        SLIDE,
        PROBES_AND_SIDES,
    ],
    profiles: values::PROFILES,
    presets: values::PRESETS,
    methods: values::METHODS,
    ablation: &[],
    sweeps: &[],
    ledger: paper::LEDGER,
    standard: "none",
    defaults: scene::defaults::<Mudmat>,
    build: scene::build::<Mudmat>,
};

/// Times (s) at which the paper shows velocities.
const SNAPSHOTS: [f64; 3] = [0.05, 0.3, 0.53];

impl Mudmat {
    /// The slide at the start.
    fn slab(&self) -> Aabb<2> {
        Aabb {
            lower: [-self.body.width_m, 0.0],
            upper: [0.0, self.body.height_m],
        }
    }

    /// Shortest edge of a cell (m).
    fn h(&self) -> f64 {
        let [x, y] = self.grid.cell(&self.slab());
        x.min(y)
    }

    /// Time step (s).
    fn dt(&self) -> f64 {
        self.time.courant * self.h() / self.material.elastic.elastic().p_speed()
    }

    fn intruder(&self) -> Intruder {
        let Mat {
            exposed_m: exposed,
            length_m: length,
            ..
        } = self.mudmat;
        // it reaches down into the base, so that what touches it at the base is pushed back and not down
        let half = [0.5 * length, 0.5 * (exposed + length)];
        Intruder {
            name: "mudmat".to_owned(),
            body: RigidBody {
                shape: Shape::Rectangle {
                    centre: [half[0], exposed - half[1]],
                    half,
                    corner_radius: (0.5 * self.h()).min(half[1]).min(half[0]),
                },
                motion: Motion {
                    velocity: [0.0; 2],
                    rise: 0.0,
                },
            },
            contact: Contact {
                friction: self.mudmat.friction,
                reach: self.mudmat.reach,
            },
        }
    }

    fn strength(&self) -> Strength {
        Strength::HerschelBulkley(RateStrength {
            s_u0: self.material.strength,
            viscosity: self.material.viscosity,
            index: self.material.index,
            reference_rate: self.material.reference_rate_1_s,
        })
    }

    /// What the solver is given.
    pub fn problem(&self) -> Problem<2> {
        let (dt, end) = (self.dt(), self.time.end_s);
        let nu = self.material.elastic.nu;
        let every = |samples: f64| (end / dt / samples).ceil().max(1.0) as usize;
        Problem {
            target: self.slab(),
            cell_size: self.grid.h_m,
            aspect: self.grid.aspect(),
            face_gap: self.points.face_gap,
            inclusion: None,
            basis: self.basis,
            scheme: self.time.scheme,
            mass: Default::default(),
            dt,
            end_time: end,
            point_mode: PointMode::Moving,
            transfer: self.points.transfer,
            points_per_cell: self.points.per_cell,
            material: self.material.elastic.elastic(),
            flow: FlowSetup {
                strength: self.strength(),
                update: self.flow.update,
                pic_share: self.flow.pic_share,
                mean_volumes: self.flow.volume == Volume::Cell,
                gravity: self.slide.gravity_m_s2,
                k0: (self.slide.gravity_m_s2 > 0.0).then_some(nu / (1.0 - nu)),
                velocity: [self.slide.velocity_m_s, 0.0],
                intruders: vec![self.intruder()],
                // the front runs on over the mudmat, and heaps up before it
                room: [
                    [0.0, 2.5 * self.slide.velocity_m_s * end + 2.0],
                    [0.0, 0.2 * self.body.height_m],
                ],
                ..FlowSetup::default()
            },
            sides: self.boundary.sides(),
            drives: Vec::new(),
            probes: Probes {
                receivers: self.receivers.iter().map(ReceiverSpec::probe).collect(),
                lines: Vec::new(),
                snapshot_times: SNAPSHOTS.into_iter().filter(|t| *t <= end).collect(),
                energy_every: Some(every(200.0)),
            },
            solver: SolverKind::Auto,
            rel_tol: 1e-10,
        }
    }
}

impl Scene for Mudmat {
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
        checks.receivers(&self.receivers, &self.slab());
        let (exposed, height) = (self.mudmat.exposed_m, self.body.height_m);
        checks.require(exposed < height, "mudmat.exposed_m", || {
            format!("the slide is {height} m high and would not pass")
        });
    }

    fn measures(&self, run: &Record, beside: &Beside<'_>) -> Vec<OwnNumber> {
        claims::numbers(self, run, beside)
    }

    fn needs_extended(&self) -> bool {
        true
    }

    /// Until the mudmat hears the outer end start: it moves along, and its wave runs at c + v.
    fn serves_until_s(&self) -> Option<f64> {
        let left = &self.boundary.left;
        let added = (left.method == extended::METHOD.name)
            .then(|| extended::thickness(&self.problem(), left))?;
        let speed = self.material.elastic.elastic().p_speed() + self.slide.velocity_m_s;
        Some((self.body.width_m + added) / speed)
    }

    fn pictures(&self) -> Vec<OwnPicture> {
        claims::pictures(self)
    }

    fn curve(&self, _name: &str, run: &Record) -> Option<Curve> {
        claims::curve(self, run)
    }

    fn claims(&self) -> Vec<SceneClaim> {
        claims::claims(self)
    }

    fn cell_m(&self) -> f64 {
        self.h()
    }
}
