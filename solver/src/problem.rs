//! The problem as a caller puts it: a box of material, what drives it, what bounds it, what to sample.
//!
//! Plain data; [`crate::solve`] turns it into grid, points and kernels.

use crate::boundary::SideMethod;
use crate::contact::Contact;
use crate::contact::body::RigidBody;
use crate::material::strength::Strength;
use crate::probe::Probes;
use crate::wavelet::Pulse;
use serde::{Deserialize, Serialize};

/// Axis-aligned box (m).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb<const D: usize> {
    /// Corner with the smallest coordinates.
    pub lower: [f64; D],
    /// Corner with the largest coordinates.
    pub upper: [f64; D],
}

/// One face of the box: axis and whether it is the upper end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Side {
    /// 0 for x, 1 for y, 2 for z.
    pub axis: usize,
    /// Upper end of the axis.
    pub upper: bool,
}

impl Side {
    /// Left face (x smallest).
    pub const LEFT: Side = Side {
        axis: 0,
        upper: false,
    };
    /// Right face (x largest).
    pub const RIGHT: Side = Side {
        axis: 0,
        upper: true,
    };
    /// Bottom face (y smallest).
    pub const BOTTOM: Side = Side {
        axis: 1,
        upper: false,
    };
    /// Top face (y largest).
    pub const TOP: Side = Side {
        axis: 1,
        upper: true,
    };

    /// Name as in `boundary.NAME`.
    pub fn name(self) -> &'static str {
        match (self.axis, self.upper) {
            (0, false) => "left",
            (0, true) => "right",
            (1, false) => "bottom",
            (1, true) => "top",
            (_, false) => "back",
            (_, true) => "front",
        }
    }
}

/// Shape functions on the background grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BasisKind {
    /// Multilinear, one cell wide.
    Linear,
    /// Linear functions averaged over the extent of a point (uniform GIMP): smooth across cells' faces.
    Gimp,
    /// Quadratic B-splines: smooth across cells' faces, three cells wide.
    Bspline,
}

/// Time integration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scheme {
    /// Newmark with beta = 1/4, gamma = 1/2: second order, keeps the energy of a linear body.
    Newmark,
    /// Leapfrog: velocities between steps, no equations to solve; stable below the step in which the
    /// fastest wave crosses a cell.
    Explicit,
    /// Without inertia: equilibrium at each step.
    QuasiStatic,
}

/// How the inertia of points reaches the nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MassKind {
    /// Summed to each node.
    #[default]
    Lumped,
    /// Coupling nodes as the shape functions do.
    Consistent,
}

/// Whether points move with the material.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PointMode {
    /// Points move; updated Lagrangian, finite strain.
    Moving,
    /// Points stay; small strain. The cheap model of a linear scene.
    Frozen,
}

/// How motion passes between points and nodes in every step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Transfer {
    /// Nodes keep their displacement, velocity and acceleration (frozen points only).
    Keep,
    /// Points carry velocity and acceleration with their gradients; only the checkerboard is damped.
    Affine,
    /// The papers' update of velocities by accelerations; filters by 0.625 + 0.375 cos kh a direction.
    Flip,
    /// Velocities replaced by the grid's: very dissipative.
    Pic,
}

/// Linear solver.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SolverKind {
    /// Conjugate gradients first; over to a factorisation when they need too many iterations.
    Auto,
    /// Conjugate gradients with Jacobi preconditioning.
    Cg,
    /// Sparse Cholesky with nested dissection of the grid.
    Direct,
}

/// Isotropic linear elasticity (plane strain in 2D).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Elastic {
    /// Young's modulus (Pa).
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Density (kg/m3).
    pub density: f64,
}

impl Elastic {
    /// The same with `ratio` times the stiffness.
    pub fn stiffened(self, ratio: f64) -> Self {
        Elastic {
            youngs_modulus: ratio * self.youngs_modulus,
            ..self
        }
    }

    /// Lamé's first constant (Pa).
    pub fn lambda(&self) -> f64 {
        let nu = self.poissons_ratio;
        self.youngs_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// Shear modulus (Pa).
    pub fn shear_modulus(&self) -> f64 {
        0.5 * self.youngs_modulus / (1.0 + self.poissons_ratio)
    }

    /// Speed of compressional waves, sqrt((lambda + 2 G)/rho) (m/s).
    pub fn p_speed(&self) -> f64 {
        ((self.lambda() + 2.0 * self.shear_modulus()) / self.density).sqrt()
    }

    /// Speed of shear waves, sqrt(G/rho) (m/s).
    pub fn s_speed(&self) -> f64 {
        (self.shear_modulus() / self.density).sqrt()
    }
}

/// What sets the body in motion.
#[derive(Clone, Debug, PartialEq)]
pub enum Drive<const D: usize> {
    /// The normal velocity of a side follows the pulse while it lasts; the side is free afterwards.
    SideVelocity {
        /// The driven side.
        side: Side,
        /// Velocity along `axis` (m/s), positive along the axis.
        pulse: Pulse,
    },
    /// A force on a point (N per metre of thickness in 2D).
    PointForce {
        /// Where it acts (m).
        place: [f64; D],
        /// Unit vector of its direction.
        direction: [f64; D],
        /// Force over time.
        pulse: Pulse,
    },
}

/// When in an explicit step the stress moves on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StressUpdate {
    /// Last, by the new velocities of the nodes.
    #[default]
    Usl,
    /// Last, by velocities that the points have sent to the nodes once more.
    Musl,
}

/// A rigid body that moves as prescribed, and how it touches the soil.
#[derive(Clone, Debug, PartialEq)]
pub struct Intruder {
    /// Name in series, for example `pipe`.
    pub name: String,
    /// Outline and motion; in three dimensions a prism along z.
    pub body: RigidBody,
    /// Friction and reach.
    pub contact: Contact,
}

/// What moving material in explicit steps may have besides; the default is elastic, at rest, without
/// weight.
#[derive(Clone, Debug, PartialEq)]
pub struct FlowSetup<const D: usize> {
    /// What bounds the shear stress.
    pub strength: Strength,
    /// When the stress moves on.
    pub update: StressUpdate,
    /// Share of the nodes' velocity that points take over in a step, 0..1 (`flip`, `affine`).
    pub pic_share: f64,
    /// Acceleration of the weight (m/s2), buoyancy taken off; along the second axis.
    pub gravity: f64,
    /// Ratio of horizontal to vertical stress at the start under the weight; `None`: free of stress.
    pub k0: Option<f64>,
    /// Velocity at the start (m/s); inflows, dashpots and layers of the sides move along, other walls stay.
    pub velocity: [f64; D],
    /// Rigid bodies.
    pub intruders: Vec<Intruder>,
    /// Take the divergence of the velocity from cells instead of points (F-bar), against locking of what
    /// hardly changes its volume?
    pub mean_volumes: bool,
    /// Share the work of a step with the threads of the pool that the run is in?
    pub shared: bool,
    /// Empty space around the material (m): `room[axis][0]` below, `room[axis][1]` above.
    pub room: [[f64; 2]; D],
}

impl<const D: usize> Default for FlowSetup<D> {
    fn default() -> Self {
        FlowSetup {
            strength: Strength::Elastic,
            update: StressUpdate::Usl,
            pic_share: 0.0,
            gravity: 0.0,
            k0: None,
            velocity: [0.0; D],
            intruders: Vec::new(),
            mean_volumes: false,
            shared: false,
            room: [[0.0; 2]; D],
        }
    }
}

impl<const D: usize> FlowSetup<D> {
    /// Can energy come from nothing but the drives?
    pub fn is_passive(&self) -> bool {
        self.intruders.is_empty() && self.gravity == 0.0 && self.velocity == [0.0; D]
    }
}

/// Everything that a solve needs.
#[derive(Clone, Debug)]
pub struct Problem<const D: usize> {
    /// The body of interest; layers may lie outside it.
    pub target: Aabb<D>,
    /// Largest edge of a cell (m); cells are made to fit the body.
    pub cell_size: f64,
    /// Edge of a cell along x over those along the other axes; the longer is `cell_size`.
    pub aspect: f64,
    /// Shape functions.
    pub basis: BasisKind,
    /// Time integration.
    pub scheme: Scheme,
    /// How the inertia of points reaches the nodes.
    pub mass: MassKind,
    /// Time step (s).
    pub dt: f64,
    /// End of the run (s).
    pub end_time: f64,
    /// Do points move?
    pub point_mode: PointMode,
    /// Transfer between points and nodes.
    pub transfer: Transfer,
    /// Material points in a cell: a D-th power.
    pub points_per_cell: usize,
    /// Distance of a cell's outermost points from its faces over its edges; `None`: points lie at the
    /// centres of equal parts.
    pub face_gap: Option<f64>,
    /// The material of target and layers.
    pub material: Elastic,
    /// Young's modulus of the middle third of the body along each axis over that of all else; `None`:
    /// one stiffness.
    pub inclusion: Option<f64>,
    /// What explicit steps of moving points have besides.
    pub flow: FlowSetup<D>,
    /// The boundary method of each side: `sides[axis][0]` lower, `sides[axis][1]` upper.
    pub sides: [[SideMethod; 2]; D],
    /// What drives it.
    pub drives: Vec<Drive<D>>,
    /// What to sample.
    pub probes: Probes<D>,
    /// Linear solver.
    pub solver: SolverKind,
    /// Relative tolerance of the linear solver.
    pub rel_tol: f64,
}

/// Edges (m) of cells whose longer one is given, by the edge along x over the others.
pub fn edges<const D: usize>(longest: f64, aspect: f64) -> [f64; D] {
    std::array::from_fn(|axis| match axis {
        0 => longest * aspect.min(1.0),
        _ => longest / aspect.max(1.0),
    })
}

impl<const D: usize> Aabb<D> {
    /// Is a place in it?
    pub fn contains(&self, place: &[f64; D]) -> bool {
        (0..D).all(|a| place[a] >= self.lower[a] && place[a] <= self.upper[a])
    }
}

impl<const D: usize> Problem<D> {
    /// Largest edges of a cell (m).
    pub fn edges(&self) -> [f64; D] {
        edges(self.cell_size, self.aspect)
    }

    /// Where another stiffness than the body's is, if anywhere (m).
    pub fn included(&self) -> Option<Aabb<D>> {
        self.inclusion?;
        let at = |third: f64| {
            std::array::from_fn(|a| {
                let (lower, upper) = (self.target.lower[a], self.target.upper[a]);
                lower + third / 3.0 * (upper - lower)
            })
        };
        Some(Aabb {
            lower: at(1.0),
            upper: at(2.0),
        })
    }

    /// The stiffest material that there is.
    pub fn stiffest(&self) -> Elastic {
        self.material
            .stiffened(self.inclusion.unwrap_or(1.0).max(1.0))
    }

    /// Steps that it takes to reach the end.
    pub fn steps(&self) -> usize {
        (self.end_time / self.dt - 1e-9).ceil().max(1.0) as usize
    }

    /// Time of the last step (s): not before the end, and past it where the step does not divide it.
    pub fn last_time(&self) -> f64 {
        self.steps() as f64 * self.dt
    }
}
