//! What regions of points and terms on nodes contribute to the system
//!
//! ```text
//! M a + C v + K u + f_int(u) = f_ext
//! ```

use super::inertia::PointInertia;
use crate::basis::Discretisation;
use crate::error::SolverError;
use crate::grid::Grid;
use crate::linear::Moment;
use crate::linear::block_matrix::BlockMatrix;
use crate::points::Points;
use crate::tensor::Vector;
use std::ops::Range;

/// Lumped coefficients of the nodes, one an unknown.
#[derive(Clone, Debug, Default)]
pub struct Lumped<const D: usize> {
    /// Inertia M (kg).
    pub mass: Vec<Vector<D>>,
    /// Damping C (kg/s); empty when nothing is damped.
    pub viscous: Vec<Vector<D>>,
    /// Springs to the ground (N/m); empty when there are none.
    pub stiffness: Vec<Vector<D>>,
}

impl<const D: usize> Lumped<D> {
    /// No mass, for `nodes` nodes.
    pub fn zeros(nodes: usize) -> Self {
        Lumped {
            mass: vec![[0.0; D]; nodes],
            viscous: Vec::new(),
            stiffness: Vec::new(),
        }
    }

    /// The damping, to add to.
    pub fn viscous_mut(&mut self) -> &mut [Vector<D>] {
        self.viscous.resize(self.mass.len(), [0.0; D]);
        &mut self.viscous
    }

    /// The springs, to add to.
    pub fn stiffness_mut(&mut self) -> &mut [Vector<D>] {
        self.stiffness.resize(self.mass.len(), [0.0; D]);
        &mut self.stiffness
    }

    /// Becomes `whole` less itself.
    pub fn become_rest_of(&mut self, whole: &Self) {
        let pairs = [
            (&mut self.mass, &whole.mass),
            (&mut self.viscous, &whole.viscous),
            (&mut self.stiffness, &whole.stiffness),
        ];
        for (part, whole) in pairs {
            part.resize(whole.len(), [0.0; D]);
            for (x, all) in part.iter_mut().zip(whole) {
                *x = std::array::from_fn(|i| all[i] - x[i]);
            }
        }
    }

    /// Becomes `other`, without giving memory back.
    pub fn copy_from(&mut self, other: &Self) {
        self.mass.clone_from(&other.mass);
        self.viscous.clone_from(&other.viscous);
        self.stiffness.clone_from(&other.stiffness);
    }
}

/// What the tangent of a region depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stiffness {
    /// On nothing, and the force is the tangent times the total displacement: the model applies the
    /// assembled matrix instead of visiting the points.
    Linear,
    /// On the length of the step alone.
    Constant,
    /// On the state.
    Varying,
}

/// A trial state of the end of a step.
#[derive(Clone, Copy)]
pub struct Trial<'a, const D: usize> {
    /// Shape functions.
    pub disc: &'a dyn Discretisation<D>,
    /// Points at the start of the step.
    pub points: &'a Points<D>,
    /// Nodal displacement at the start of the step, where nodes keep it (m).
    pub start: &'a [Vector<D>],
    /// Its increment (m).
    pub increment: &'a [Vector<D>],
    /// Length of the step (s).
    pub dt: f64,
    /// When it ends.
    pub moment: Moment,
}

/// A region of points: its internal force, tangent and memory.
pub trait RegionKernel<const D: usize>: Send {
    /// Says what inertia, damping and springs the points of `block` have; plain masses unless changed.
    fn inertia(&self, _block: Range<usize>, _out: &mut PointInertia<D>) {}

    /// Adds the internal force of the trial state.
    ///
    /// # Errors
    /// An inverted point.
    fn force(&mut self, trial: &Trial<'_, D>, out: &mut [Vector<D>]) -> Result<(), SolverError>;

    /// Adds the derivative of the internal force with respect to the increment.
    fn tangent(&mut self, trial: &Trial<'_, D>, out: &mut BlockMatrix<D>);

    /// Accepts the trial state: stress and memory move on. Where the tangent varies, it is the state
    /// whose force was asked for last.
    ///
    /// # Errors
    /// An inverted point.
    fn commit(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError>;

    /// What it remembers beside what follows from the nodes' displacement, all of it linear: a caller
    /// may read it and put something else there, as spectra do.
    fn memories(&mut self) -> Vec<&mut [f64]> {
        Vec::new()
    }

    /// What the tangent depends on.
    fn stiffness(&self) -> Stiffness;

    /// The region as explicit steps see it; `None` when it has no explicit form.
    fn explicit(&mut self) -> Option<&mut dyn ExplicitKernel<D>> {
        None
    }

    /// Is the tangent symmetric?
    fn is_symmetric(&self) -> bool {
        true
    }

    /// Elastic energy of the region (J, per metre of thickness in 2D) with the nodal displacement
    /// `u` where nodes keep it.
    fn strain_energy(
        &self,
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        u: &[Vector<D>],
    ) -> f64;
}

/// A region in explicit steps: the force is that of the state at hand, and the state moves on once
/// the increment is known.
pub trait ExplicitKernel<const D: usize> {
    /// Adds the internal force of the present state (N); not asked where the force is K times the
    /// displacement ([`Stiffness::Linear`]).
    fn present_force(
        &mut self,
        disc: &dyn Discretisation<D>,
        points: &Points<D>,
        out: &mut [Vector<D>],
    );

    /// Moves stress and memory on by the step's increment.
    ///
    /// # Errors
    /// An inverted point.
    fn advance(&mut self, trial: &Trial<'_, D>) -> Result<(), SolverError>;
}

/// How an unknown is held during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    /// Velocity at the start and end of the step (m/s).
    pub velocity: [f64; 2],
    /// Acceleration at the start and end of the step (m/s2).
    pub acceleration: [f64; 2],
}

/// Held unknowns of a step.
#[derive(Clone, Debug)]
pub struct Constraints<const D: usize> {
    /// Which unknowns are held.
    pub held: Vec<[bool; D]>,
    /// Those of them that follow a motion: (node, direction, motion); the others rest.
    pub driven: Vec<(u32, u8, Driven)>,
}

impl<const D: usize> Constraints<D> {
    /// Nothing held, for `nodes` nodes.
    pub fn none(nodes: usize) -> Self {
        Constraints {
            held: vec![[false; D]; nodes],
            driven: Vec::new(),
        }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.held.fill([false; D]);
        self.driven.clear();
    }

    /// Holds one direction of the nodes.
    pub fn hold(&mut self, nodes: &[u32], direction: usize) {
        for &node in nodes {
            self.held[node as usize][direction] = true;
        }
    }
}

/// An explicit step, as what corrects its velocities sees it.
#[derive(Clone, Copy)]
pub struct Step<'a, const D: usize> {
    /// Start and end (s).
    pub times: [f64; 2],
    /// Masses of the nodes (kg).
    pub mass: &'a [Vector<D>],
    /// Places of the moving points (m).
    pub places: &'a [Vector<D>],
}

/// A number of a rigid body after a step.
#[derive(Clone, Copy, Debug)]
pub struct Reading<'a> {
    /// The body's name.
    pub name: &'a str,
    /// Force of the soil on it (N, per metre of thickness in 2D).
    pub force: [f64; 2],
    /// Its way from the start (m).
    pub way: [f64; 2],
    /// Depth of the deepest point in it (m).
    pub penetration: f64,
}

/// A term on nodes: what holds, drives, damps or loads them.
pub trait NodeTerm<const D: usize>: Send {
    /// Holds unknowns during the step from `times[0]` to `times[1]` (s).
    fn constrain(&self, _times: [f64; 2], _out: &mut Constraints<D>) {}

    /// Adds lumped damping at time `t` (s), in terms of the nodes' masses.
    fn lump(&self, _t: f64, _out: &mut Lumped<D>) {}

    /// Adds the force on the nodes at time `t` (s) and velocity `v` (m/s).
    fn force(&self, _t: f64, _v: &[Vector<D>], _active: &[bool], _out: &mut [Vector<D>]) {}

    /// Adds minus the derivative of the force with respect to the velocity, times `rate` (1/s).
    fn tangent(&self, _rate: f64, _active: &[bool], _out: &mut BlockMatrix<D>) {}

    /// Corrects the velocities (m/s) that an explicit step has found.
    fn correct(&mut self, _step: &Step<'_, D>, _v: &mut [Vector<D>]) {}

    /// What the term has to say after a step, for the record.
    fn reading(&self) -> Option<Reading<'_>> {
        None
    }

    /// Finds the nodes of what is attached to the material. `Err` names a place outside the grid.
    ///
    /// # Errors
    /// A place outside the grid.
    fn attach(&mut self, _disc: &dyn Discretisation<D>) -> Result<(), Vector<D>> {
        Ok(())
    }

    /// Moves what is attached to the material by the increment.
    ///
    /// # Errors
    /// A place outside the grid.
    fn advance(
        &mut self,
        _disc: &dyn Discretisation<D>,
        _increment: &[Vector<D>],
        _active: &[bool],
    ) -> Result<(), Vector<D>> {
        Ok(())
    }
}

/// Nodes of the grid that `select` takes by their places.
pub fn nodes_where<const D: usize>(
    grid: &Grid<D>,
    select: impl Fn(&Vector<D>) -> bool,
) -> Vec<u32> {
    (0..grid.node_count())
        .filter(|&n| select(&grid.node_place(n)))
        .map(|n| n as u32)
        .collect()
}
