//! Material points in explicit steps: one fused pass from the points to the nodes and one back.
//!
//! ```text
//! to nodes    m_I = sum m N,   (m v)_I = sum m N [v_p + L_p (x_I - x_p)],   f_I = - sum V tau grad N
//! to points   v_p' = (1 - eta) (v_p + dt sum N a) + eta sum N v'
//!             L_p' = (1 - eta) (L_p + dt sum a (x) grad N) + eta sum v' (x) grad N
//!             tau' from l = sum v' (x) grad N,                      x_p' = x_p + dt sum N v'
//! ```
//!
//! `N` and `grad N` are those of the places at the start of the step; `tau` is the Kirchhoff stress and
//! `V` the volume of the start, so that no point remembers its density. `L_p` belongs to the affine
//! transfer alone. Stress last (USL): [`Flow::to_points`]. Modified USL (Sulsky, Zhou
//! & Schreyer 1995): [`Flow::kick`], then momentum once more to the nodes by [`Flow::momentum`], then
//! [`Flow::drift`] by the velocities that it gives.
//!
//! Points stand in structures of arrays, sorted by the first node that they see. Runs of points with
//! the same nodes share their loads and sums; shape functions are made on the fly, a block of points
//! at once, and the next block is asked for while one is worked on. Passes are compiled for the widest
//! vectors of the machine and chosen as the program runs.
//! Strips of rows in two colours write without overlap, always in the same order, so that the number
//! of threads changes no bit.
//!
//! Kernels for the grid (dimension, width of the basis, transfer) and for the law meet in blocks of
//! points: their instances add up.

mod ahead;
mod body;
mod columns;
mod fbar;
mod fixed;
mod gather;
mod lanes;
mod law_blocks;
mod scatter;
mod stencils;
mod strips;
pub mod surface;
#[cfg(test)]
mod tests;

use crate::basis::bspline::QuadraticBSpline;
use crate::basis::gimp::Gimp;
use crate::basis::linear::Linear;
use crate::error::SolverError;
use crate::grid::Grid;
use crate::linear::Moment;
use crate::material::herschel_bulkley::HerschelBulkley;
use crate::material::law::Law;
use crate::material::linear_elastic::LinearElastic;
use crate::material::von_mises::VonMises;
use crate::problem::BasisKind;
use crate::tensor::{Matrix, Vector};
use body::Body;
use thiserror::Error;

/// What points give to the nodes, one entry a node.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NodeSums<const D: usize> {
    /// Masses (kg, per metre of thickness in 2D).
    pub mass: Vec<f64>,
    /// Momenta (kg m/s).
    pub momentum: Vec<Vector<D>>,
    /// Forces of the stress (N).
    pub force: Vec<Vector<D>>,
}

impl<const D: usize> NodeSums<D> {
    /// Zeros for so many nodes.
    pub fn new(nodes: usize) -> Self {
        NodeSums {
            mass: vec![0.0; nodes],
            momentum: vec![[0.0; D]; nodes],
            force: vec![[0.0; D]; nodes],
        }
    }

    /// Sets all sums to zero.
    pub fn clear(&mut self) {
        self.mass.fill(0.0);
        self.momentum.fill([0.0; D]);
        self.force.fill([0.0; D]);
    }
}

/// How points carry the motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carry {
    /// Velocities with their gradients.
    Affine {
        /// Share `eta` of the nodes' velocity and its gradient, 0..1: 0 forgets nothing, 1 is affine pic.
        pic: f64,
    },
    /// Velocities alone.
    Flip {
        /// Share `eta` of the nodes' velocity, 0..1: 0 is flip itself, 1 is pic.
        pic: f64,
    },
}

/// Why a pass over the points failed; places in metres.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Fault<const D: usize> {
    /// A point is beyond the ends of the grid.
    #[error("the material point at {place:?} m left the background grid")]
    Left {
        /// Its place.
        place: Vector<D>,
    },
    /// A point's field became NaN or infinite.
    #[error("{field} of the material point at {place:?} m is not finite")]
    NonFinite {
        /// Which field.
        field: &'static str,
        /// The point's place.
        place: Vector<D>,
    },
    /// A step turns a point inside out.
    #[error("the material point at {place:?} m is inverted, det(I + dt l) = {determinant:.3e}")]
    Inverted {
        /// Its place.
        place: Vector<D>,
        /// Determinant of the increment of the deformation gradient.
        determinant: f64,
    },
}

impl<const D: usize> Fault<D> {
    /// The failure of the solve in this step.
    pub fn at(self, moment: Moment) -> SolverError {
        let Moment { step, time_s } = moment;
        match self {
            Fault::Left { place } => SolverError::LeftGrid {
                step,
                time_s,
                place: place.to_vec(),
            },
            Fault::NonFinite { field, place } => SolverError::NonFinite {
                field,
                step,
                time_s,
                place: place.to_vec(),
            },
            Fault::Inverted { place, determinant } => SolverError::InvertedPoint {
                step,
                time_s,
                place: place.to_vec(),
                determinant,
            },
        }
    }
}

/// The points of one region in explicit steps. Nodal fields have one entry a node of the grid.
pub trait Flow<const D: usize>: Send {
    /// Adds masses, momenta and forces of the points to `out`.
    ///
    /// # Errors
    /// [`Fault::Left`].
    fn to_nodes(&mut self, out: &mut NodeSums<D>) -> Result<(), Fault<D>>;

    /// Ends a step of `dt` (s), stress last: motion, stress and places of the points by the new
    /// velocities `v` (m/s) and accelerations `a` (m/s2) of the nodes.
    ///
    /// # Errors
    /// Any [`Fault`].
    fn to_points(&mut self, v: &[Vector<D>], a: &[Vector<D>], dt: f64) -> Result<(), Fault<D>>;

    /// The motion of the points alone, by new velocities (m/s) and accelerations (m/s2) of the nodes.
    ///
    /// # Errors
    /// [`Fault::Left`], [`Fault::NonFinite`].
    fn kick(&mut self, v: &[Vector<D>], a: &[Vector<D>], dt: f64) -> Result<(), Fault<D>>;

    /// Adds the momenta (kg m/s) of the points alone to `out`.
    ///
    /// # Errors
    /// [`Fault::Left`].
    fn momentum(&mut self, out: &mut [Vector<D>]) -> Result<(), Fault<D>>;

    /// Stress and places of the points by the velocities `v` (m/s) of the nodes.
    ///
    /// # Errors
    /// Any [`Fault`].
    fn drift(&mut self, v: &[Vector<D>], dt: f64) -> Result<(), Fault<D>>;

    /// Number of points.
    fn len(&self) -> usize;

    /// Are there none?
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Mass of each point (kg, per metre of thickness in 2D).
    fn point_mass(&self) -> f64;

    /// Volume of each point at the start (m3, per metre of thickness in 2D).
    fn point_volume(&self) -> f64;

    /// Places (m). All columns of points are in one order, which changes between steps.
    fn places(&self) -> &[Vector<D>];

    /// Velocities (m/s).
    fn velocities(&self) -> &[Vector<D>];

    /// Kirchhoff stress (Pa) of a point.
    fn stress(&self, point: usize) -> Matrix<D>;

    /// Numbers that the law keeps of a point.
    fn state(&self, point: usize) -> &[f64];

    /// Kinetic energy (J) of the points' velocities; what their gradients hold is not in it.
    fn kinetic_energy(&self) -> f64 {
        let twice: f64 = self.velocities().as_flattened().iter().map(|v| v * v).sum();
        0.5 * self.point_mass() * twice
    }

    /// Elastic energy (J).
    fn strain_energy(&self) -> f64;

    /// Momentum (kg m/s).
    fn total_momentum(&self) -> Vector<D> {
        let mut sum = [0.0; D];
        for v in self.velocities() {
            for i in 0..D {
                sum[i] += self.point_mass() * v[i];
            }
        }
        sum
    }

    /// Memory of a point in bytes, the second copy and the keys of sorting included.
    fn bytes_per_point(&self) -> usize;
}

/// A region as it starts. The columns are as long as `places`.
#[derive(Clone, Debug)]
pub struct Start<const D: usize> {
    /// The background grid, with at least as many nodes along each axis as a point sees.
    pub grid: Grid<D>,
    /// The basis.
    pub basis: BasisKind,
    /// Points along each axis of a full cell: the extent of a point for GIMP.
    pub per_axis: usize,
    /// Places (m) of the points.
    pub places: Vec<Vector<D>>,
    /// Velocities (m/s), one a place.
    pub velocities: Vec<Vector<D>>,
    /// Kirchhoff stress (Pa), one a place; `None` where all is free of stress.
    pub stress: Option<Vec<Matrix<D>>>,
    /// Volume of each point (m3, per metre of thickness in 2D).
    pub volume: f64,
    /// Density (kg/m3).
    pub density: f64,
    /// How points carry the motion.
    pub carry: Carry,
    /// Replace the points' divergences by their cells' (F-bar), against locking of what hardly changes
    /// its volume?
    pub mean_volumes: bool,
    /// Share the work with the threads of the pool that the passes are called in?
    pub shared: bool,
}

/// The points of `start` under a law. Every pair of a law and a basis is compiled here and nowhere else.
///
/// # Errors
/// [`Fault::Left`] for a place beyond the grid.
pub fn flow<L: Law<D>, const D: usize>(
    law: L,
    start: Start<D>,
) -> Result<Box<dyn Flow<D>>, Fault<D>> {
    Ok(match start.basis {
        BasisKind::Linear => Box::new(Body::new(Linear, law, start)?),
        BasisKind::Gimp => Box::new(Body::new(Gimp::new(start.per_axis), law, start)?),
        BasisKind::Bspline => Box::new(Body::new(QuadraticBSpline, law, start)?),
    })
}

/// The laws of explicit steps.
#[derive(Clone, Copy, Debug)]
pub enum Constitution {
    /// Linear elasticity, objective.
    LinearElastic(LinearElastic),
    /// Elastic, perfectly plastic.
    VonMises(VonMises),
    /// Strength that grows with the rate of shear.
    HerschelBulkley(HerschelBulkley),
}

/// The dimensions in which there are laws: [`Space`] has those of 2 and 3.
pub trait Dimension<const D: usize> {
    /// The points of `start` under a law.
    ///
    /// # Errors
    /// As for [`flow`].
    fn flow(law: Constitution, start: Start<D>) -> Result<Box<dyn Flow<D>>, Fault<D>>;
}

/// What has dimensions.
#[derive(Clone, Copy, Debug)]
pub struct Space;

impl Dimension<2> for Space {
    fn flow(law: Constitution, start: Start<2>) -> Result<Box<dyn Flow<2>>, Fault<2>> {
        match law {
            Constitution::LinearElastic(law) => flow(law, start),
            Constitution::VonMises(law) => flow(law, start),
            Constitution::HerschelBulkley(law) => flow(law, start),
        }
    }
}

impl Dimension<3> for Space {
    fn flow(law: Constitution, start: Start<3>) -> Result<Box<dyn Flow<3>>, Fault<3>> {
        match law {
            Constitution::LinearElastic(law) => flow(law, start),
            Constitution::VonMises(law) => flow(law, start),
            Constitution::HerschelBulkley(_) => {
                unreachable!("its rate is that of plane strain: refused as the problem is set up")
            }
        }
    }
}
