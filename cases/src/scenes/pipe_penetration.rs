//! pipe-penetration: a smooth pipe is pushed into undrained clay from its surface (S21, section 3.3).
//!
//! ```text
//!      O  pipe, D = 0.8 m, pushed down at 5 m/s        half model: x = 0 is a plane of symmetry
//!  ----+------------------|  y = 0: free
//!  |                      |
//!  | clay, von Mises      |  right, bottom: roller | dashpot | damping layer | PML | extended
//!  | 3.125 D x 3.125 D    |
//!  |______________________|
//! ```
//!
//! S21: Shan, Liao, Dong, Wang, Cui 2021, doi 10.1631/jzus.A2000399. Deviations from the paper:
//! - c_p = sqrt((lambda + 2 G)/rho) = 181.4 m/s; the printed 178 m/s is sqrt(lambda/rho).
//! - The reference of the slow push is a slip-line solution, not another program; that of the fast one is
//!   the same scheme on soil so large that nothing comes back (certified).
//! - Transfer `affine` for all methods of a comparison; the paper's flip is an option.

mod claims;
mod paper;
mod values;

use crate::checks::Checks;
use crate::field::{Field, Kind, Range};
use crate::posed::Posed;
use crate::scene::{self, Beside, Curve, OwnNumber, OwnPicture, Scene, SceneClaim, SceneInfo};
use crate::spec::*;
use anechoic_solver::boundary::{SideMethod, extended};
use anechoic_solver::contact::Contact;
use anechoic_solver::contact::body::{Motion, RigidBody};
use anechoic_solver::contact::shape::Shape;
use anechoic_solver::material::strength::Strength;
use anechoic_solver::probe::Probes;
use anechoic_solver::problem::{
    Aabb, BasisKind, FlowSetup, Intruder, PointMode, Problem, Scheme, SolverKind,
};
use anechoic_solver::record::Record;
use serde::{Deserialize, Serialize};

/// The scene; `Default` holds the paper's values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PipePenetration {
    /// Shape functions.
    pub basis: BasisKind,
    /// Size of the soil; the plane of symmetry is its left side.
    pub body: BodySpec,
    /// Background grid.
    pub grid: GridSpec,
    /// Time integration; the step defaults to 0.4 of the time of the fastest wave through a cell, the end
    /// to the time that the pipe takes to its depth.
    pub time: PushTime,
    /// Material points.
    pub points: PointsSpec,
    /// Explicit steps.
    pub flow: FlowSpec,
    /// Clay.
    pub material: Clay,
    /// The pipe.
    pub pipe: Pipe,
    /// Anywhere in the soil.
    pub receivers: Vec<ReceiverSpec>,
    /// Sides; the method under test is right and at the bottom.
    pub boundary: BoundarySpec,
}

/// Time integration of a push.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PushTime {
    /// Scheme.
    pub scheme: Scheme,
    /// Time step over the time that the fastest wave takes through a cell.
    pub courant: f64,
}

/// Elastic, perfectly plastic clay.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Clay {
    /// Elastic constants and density.
    #[serde(flatten)]
    pub elastic: MaterialSpec,
    /// Undrained shear strength s_u (Pa).
    #[serde(rename = "s_u_Pa")]
    pub strength: f64,
}

/// A pipe pushed at constant velocity.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pipe {
    /// Diameter D (m).
    pub diameter_m: f64,
    /// Velocity, downward (m/s).
    pub velocity_m_s: f64,
    /// How deep it is pushed, over D.
    pub depth: f64,
    /// Coulomb's coefficient; 0 is smooth.
    pub friction: f64,
    /// How far outside the pipe a node may lie to be touched, over the edge of a cell.
    pub reach: f64,
}

const PIPE: &[Field] = &[
    Field::new(
        "material.s_u_Pa",
        Kind::Number(Range::POSITIVE),
        "undrained shear strength s_u, sqrt(J2) at yield (Pa)",
    ),
    Field::new(
        "pipe.diameter_m",
        Kind::Number(Range::POSITIVE),
        "diameter D (m)",
    ),
    Field::new(
        "pipe.velocity_m_s",
        Kind::Number(Range::POSITIVE),
        "velocity, downward (m/s)",
    ),
    Field::new(
        "pipe.depth",
        Kind::Number(Range::inside(0.0, 1.0)),
        "how deep it is pushed, over D",
    ),
    Field::new(
        "pipe.friction",
        Kind::Number(Range::within(0.0, 10.0)),
        "Coulomb's coefficient; 0 is smooth",
    ),
    Field::new(
        "pipe.reach",
        Kind::Number(Range::within(0.0, 1.0)),
        "how far outside the pipe a node may lie to be touched, over a cell's edge",
    ),
];

impl Default for PipePenetration {
    fn default() -> Self {
        toml::from_str(values::PAPER).expect("the paper's values are a scene")
    }
}

/// The registry's entry.
pub static INFO: SceneInfo = SceneInfo {
    name: "pipe-penetration",
    title: "a pipe pushed into clay: the echo of the base in its resistance",
    summary: "A smooth pipe is pushed from the surface into clay that flows at its undrained strength. Pushed fast it sends out a wave that comes back from wherever the mesh ends and shakes the resistance; pushed slowly it meets the resistance of a slip-line solution.",
    source: "S21, section 3.3 (doi 10.1631/jzus.A2000399)",
    fields: &[FLOW_NUMERICS, FLOW, BODY, ELASTIC, PIPE, PROBES_AND_SIDES],
    profiles: values::PROFILES,
    presets: values::PRESETS,
    methods: values::METHODS,
    ablation: &[],
    sweeps: &[],
    ledger: paper::LEDGER,
    standard: "fixed",
    defaults: scene::defaults::<PipePenetration>,
    build: scene::build::<PipePenetration>,
};

impl PipePenetration {
    /// The soil.
    fn soil(&self) -> Aabb<2> {
        Aabb {
            lower: [0.0, -self.body.height_m],
            upper: [self.body.width_m, 0.0],
        }
    }

    /// Shortest edge of a cell (m).
    fn h(&self) -> f64 {
        let [x, y] = self.grid.cell(&self.soil());
        x.min(y)
    }

    /// Time step (s).
    fn dt(&self) -> f64 {
        self.time.courant * self.h() / self.material.elastic.elastic().p_speed()
    }

    /// When the pipe has reached its depth (s).
    fn end_s(&self) -> f64 {
        self.pipe.depth * self.pipe.diameter_m / self.pipe.velocity_m_s
    }

    fn intruder(&self) -> Intruder {
        let radius = 0.5 * self.pipe.diameter_m;
        Intruder {
            name: "pipe".to_owned(),
            body: RigidBody {
                shape: Shape::Circle {
                    centre: [0.0, radius],
                    radius,
                },
                motion: Motion {
                    velocity: [0.0, -self.pipe.velocity_m_s],
                    rise: 0.0,
                },
            },
            contact: Contact {
                friction: self.pipe.friction,
                reach: self.pipe.reach,
            },
        }
    }

    /// Empty space (m): what the pipe pushes aside has to go somewhere, and splashes on fine cells, over sides that
    /// hold nothing too.
    fn room(&self) -> [[f64; 2]; 2] {
        let right = self.boundary.right.method.as_str();
        let over = if ["free", "dashpot"].contains(&right) {
            0.5
        } else {
            0.0
        };
        let d = self.pipe.diameter_m;
        [[0.0, over * d], [0.0, 1.5 * d]]
    }

    /// What the solver is given.
    pub fn problem(&self) -> Problem<2> {
        let (dt, end) = (self.dt(), self.end_s());
        Problem {
            target: self.soil(),
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
                strength: Strength::VonMises {
                    s_u: self.material.strength,
                },
                update: self.flow.update,
                pic_share: self.flow.pic_share,
                mean_volumes: self.flow.volume == Volume::Cell,
                intruders: vec![self.intruder()],
                room: self.room(),
                ..FlowSetup::default()
            },
            sides: self.boundary.sides(),
            drives: Vec::new(),
            probes: Probes {
                receivers: self.receivers.iter().map(ReceiverSpec::probe).collect(),
                lines: Vec::new(),
                snapshot_times: [0.2, 0.6, 1.0].map(|share| share * end).to_vec(),
                energy_every: Some((end / dt / 200.0).ceil().max(1.0) as usize),
            },
            solver: SolverKind::Auto,
            rel_tol: 1e-10,
        }
    }
}

impl Scene for PipePenetration {
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
        checks.receivers(&self.receivers, &self.soil());
        let radius = 0.5 * self.pipe.diameter_m;
        checks.require(radius < self.body.width_m, "pipe.diameter_m", || {
            format!("the pipe is wider than the soil ({} m)", self.body.width_m)
        });
        let depth = self.pipe.depth * self.pipe.diameter_m;
        checks.require(depth < self.body.height_m, "pipe.depth", || {
            format!(
                "{depth} m is deeper than the soil ({} m)",
                self.body.height_m
            )
        });
    }

    fn needs_extended(&self) -> bool {
        !claims::is_slow(self)
    }

    fn measures(&self, run: &Record, beside: &Beside<'_>) -> Vec<OwnNumber> {
        claims::numbers(self, run, beside)
    }

    /// Until a wave from the pipe can be back from the outer ends.
    fn serves_until_s(&self) -> Option<f64> {
        let (problem, sides) = (self.problem(), &self.boundary);
        let added = |side: &SideMethod| {
            (side.method == extended::METHOD.name).then(|| extended::thickness(&problem, side))
        };
        let right = self.body.width_m + added(&sides.right)?;
        let down = self.body.height_m + added(&sides.bottom)?;
        let reach = 0.5 * self.pipe.diameter_m + self.pipe.depth * self.pipe.diameter_m;
        Some((2.0 * right.min(down) - reach) / self.material.elastic.elastic().p_speed())
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
