//! The parts that scenes share, with the keys that are the same everywhere.

mod fields;

pub use fields::*;

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::geometry::fitted_cell;
use anechoic_solver::probe::{LineProbe, Receiver};
use anechoic_solver::problem::{
    Aabb, Elastic, MassKind, PointMode, Scheme, SolverKind, StressUpdate, Transfer, edges,
};
use serde::{Deserialize, Serialize};

/// Background grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GridSpec {
    /// Largest edge of a cell (m); cells are made to fit the body.
    pub h_m: f64,
    /// Edge along x over edge along y; left out: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aspect: Option<f64>,
}

impl GridSpec {
    /// Edge along x over edge along y.
    pub fn aspect(&self) -> f64 {
        self.aspect.unwrap_or(1.0)
    }

    /// Edges (m) of the cells that fit a body.
    pub fn cell<const D: usize>(&self, body: &Aabb<D>) -> [f64; D] {
        fitted_cell(body, edges(self.h_m, self.aspect()))
    }
}

/// A rectangular body with its lower left corner at the origin.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BodySpec {
    /// Width (m).
    pub width_m: f64,
    /// Height (m).
    pub height_m: f64,
}

impl BodySpec {
    /// Width and height (m).
    pub fn size(&self) -> [f64; 2] {
        [self.width_m, self.height_m]
    }

    /// The solver's box.
    pub fn target(&self) -> Aabb<2> {
        Aabb {
            lower: [0.0; 2],
            upper: self.size(),
        }
    }

    /// Vertical velocity along the middle from bottom to top, every so many steps.
    pub fn middle_line(&self, every: usize) -> LineProbe<2> {
        let x = 0.5 * self.width_m;
        LineProbe {
            from: [x, 0.0],
            to: [x, self.height_m],
            samples: 101,
            component: 1,
            every,
        }
    }
}

/// Time integration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TimeSpec {
    /// Scheme.
    pub scheme: Scheme,
    /// How the inertia of points reaches the nodes.
    #[serde(default)]
    pub mass: MassKind,
    /// Time step (s); left out, the scene derives it from the cell size.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dt_s: Option<f64>,
    /// End of the run (s).
    pub end_s: f64,
}

/// Material points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointsSpec {
    /// Do they move?
    pub mode: PointMode,
    /// Transfer between points and nodes.
    pub transfer: Transfer,
    /// Points in a cell, all directions together.
    pub per_cell: usize,
    /// Distance of a cell's outermost points from its faces over its edges; left out: half of a part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub face_gap: Option<f64>,
}

/// What explicit steps of moving points have besides.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlowSpec {
    /// When the stress moves on.
    pub update: StressUpdate,
    /// Share of the nodes' velocity that points take over in a step (`flip`, `affine`).
    pub pic_share: f64,
    /// Whose change of volume the stress follows.
    pub volume: Volume,
}

/// Whose change of volume the stress follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Volume {
    /// Each point's own: locks where the volume hardly changes.
    Point,
    /// That of the cell (F-bar).
    Cell,
}

/// Linear solver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SolverSpec {
    /// Relative tolerance.
    pub rel_tol: f64,
    /// Which one.
    pub kind: SolverKind,
}

/// Linear elastic material.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MaterialSpec {
    /// Young's modulus (Pa).
    #[serde(rename = "E_Pa")]
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub nu: f64,
    /// Density (kg/m3).
    pub rho_kg_m3: f64,
    /// Stiffness of the middle third of the body along each axis over that of all else; left out: 1.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inclusion: Option<f64>,
}

impl MaterialSpec {
    /// The solver's material.
    pub fn elastic(&self) -> Elastic {
        Elastic {
            youngs_modulus: self.youngs_modulus,
            poissons_ratio: self.nu,
            density: self.rho_kg_m3,
        }
    }
}

/// A place whose motion is recorded.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ReceiverSpec {
    /// Name in rows.
    pub name: String,
    /// Place (m).
    pub x_m: f64,
    /// Place (m).
    pub y_m: f64,
    /// Place (m); 0 in the plane.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub z_m: f64,
}

/// What is left out of a table.
fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

impl ReceiverSpec {
    /// The receiver `name` at (`x_m`, `y_m`).
    pub fn new(name: &str, x_m: f64, y_m: f64) -> Self {
        ReceiverSpec {
            name: name.to_owned(),
            x_m,
            y_m,
            z_m: 0.0,
        }
    }

    /// The solver's receiver, with as many coordinates as there are dimensions.
    pub fn probe<const D: usize>(&self) -> Receiver<D> {
        let place = [self.x_m, self.y_m, self.z_m];
        Receiver {
            name: self.name.clone(),
            place: std::array::from_fn(|axis| place[axis]),
        }
    }
}

/// The boundary method of each side.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct BoundarySpec {
    /// x smallest.
    pub left: SideMethod,
    /// x largest.
    pub right: SideMethod,
    /// y smallest.
    pub bottom: SideMethod,
    /// y largest.
    pub top: SideMethod,
    /// z smallest; in three dimensions alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub back: Option<SideMethod>,
    /// z largest; in three dimensions alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub front: Option<SideMethod>,
}

impl BoundarySpec {
    /// As the solver wants them: by axis, lower end first.
    pub fn sides(&self) -> [[SideMethod; 2]; 2] {
        [
            [self.left.clone(), self.right.clone()],
            [self.bottom.clone(), self.top.clone()],
        ]
    }

    /// The same in three dimensions; sides that are not named are free.
    pub fn sides_in_space(&self) -> [[SideMethod; 2]; 3] {
        let [across, up] = self.sides();
        let through = [&self.back, &self.front].map(|side| {
            let free = || SideMethod::new("free");
            side.clone().unwrap_or_else(free)
        });
        [across, up, through]
    }

    /// Sides by name, axis by axis, the lower end first.
    pub fn named(&self) -> Vec<(&'static str, &SideMethod)> {
        let plane = [
            ("left", &self.left),
            ("right", &self.right),
            ("bottom", &self.bottom),
            ("top", &self.top),
        ];
        let through = [("back", &self.back), ("front", &self.front)];
        let through = through
            .into_iter()
            .filter_map(|(name, side)| Some((name, side.as_ref()?)));
        plane.into_iter().chain(through).collect()
    }
}
