//! Boundary methods: one file a method, one line here.
//!
//! A method's file exports its entry `METHOD` (name, parameters with units and ranges), a function
//! `layout` that says how much material it adds to a side and what holds the outer end, and a
//! function `build` that makes its terms for all sides that use it. The line in the list below makes
//! the `mod`, the table [`METHODS`] and the dispatch.

mod layer;
pub mod params;
mod surface;
mod wall;

pub use params::{Ladder, MethodInfo, Param, ParamKind, Rungs, SideMethod, Value};

use crate::error::SolverError;
use crate::grid::Grid;
use crate::physics::kernel::{NodeTerm, RegionKernel};
use crate::points::Points;
use crate::problem::{Aabb, Elastic, MassKind, Problem, Side, Transfer};
use crate::tensor::Vector;
use std::ops::Range;

/// What holds the outer end of a side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Nothing.
    Free,
    /// The normal displacement is held.
    Roller,
    /// All displacements are held.
    Fixed,
    /// The normal velocity is that of the material at the start, and the end moves along.
    Inflow,
}

/// What a method makes of a side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Material added outside the body (m).
    pub outside: f64,
    /// Part of the body that the method takes for itself, from the side inwards (m).
    pub inside: f64,
    /// What holds the outer end.
    pub end: End,
    /// Who handles the points of the added material: the method's own kernel, or `None` for the
    /// material's.
    pub layer: Option<LayerPoints>,
}

/// How the points of a layer with a kernel of its own behave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerPoints {
    /// They rest, and their nodes keep the motion.
    Kept,
    /// They carry the motion as the body's points do, from places that stay.
    Carried,
}

impl Layout {
    /// Are there points that rest?
    pub fn rests(&self) -> bool {
        self.layer == Some(LayerPoints::Kept)
    }

    /// Nothing added, the body's own side held by `end`.
    pub fn plain(end: End) -> Self {
        Layout {
            layer: None,
            outside: 0.0,
            inside: 0.0,
            end,
        }
    }
}

/// A side with its method's parameters and layout.
#[derive(Clone, Debug)]
pub struct Assigned {
    /// Which side.
    pub side: Side,
    /// The method with its parameters.
    pub method: SideMethod,
    /// What the method made of the side.
    pub layout: Layout,
}

/// What a method may know when it builds its terms.
#[derive(Debug)]
pub struct Context<'a, const D: usize> {
    /// Background grid.
    pub grid: &'a Grid<D>,
    /// The body.
    pub target: Aabb<D>,
    /// All material, layers included.
    pub material_box: Aabb<D>,
    /// Its material.
    pub material: Elastic,
    /// Do points move?
    pub moving: bool,
    /// Velocity of all material at the start (m/s).
    pub velocity: Vector<D>,
    /// Transfer between points and nodes.
    pub transfer: Transfer,
    /// How the inertia of points reaches the nodes.
    pub mass: MassKind,
    /// Length of an explicit step (s); `None` when steps are implicit.
    pub explicit_dt: Option<f64>,
    /// When the run ends (s).
    pub end_time: f64,
    /// All points.
    pub points: &'a Points<D>,
    /// Those of the method's own layer.
    pub layer: Range<usize>,
    /// The sides that use the method.
    pub sides: Vec<Assigned>,
}

impl<const D: usize> Context<'_, D> {
    /// Coordinate of the body's side (m).
    pub fn plane(&self, side: Side) -> f64 {
        if side.upper {
            self.target.upper[side.axis]
        } else {
            self.target.lower[side.axis]
        }
    }
}

/// What a method contributes.
pub struct Parts<const D: usize> {
    /// Terms on nodes.
    pub terms: Vec<Box<dyn NodeTerm<D>>>,
    /// The kernel of its own layer.
    pub kernel: Option<Box<dyn RegionKernel<D>>>,
    /// Factors of inertia of the layer's points in each direction, when they carry the motion.
    pub inertia: Option<Vec<Vector<D>>>,
    /// Do points carry their displacement, and do those of the layer take it from the nodes anew in
    /// every step?
    pub displacement: Option<DisplacementTransfer>,
}

/// How points get their displacement where a layer asks for it: all of them, so that what the nodes
/// between body and layer get is filtered alike on both sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DisplacementTransfer {
    /// From the nodes anew in every step (K25 (18)): a low-pass filter.
    Replaced,
    /// By the step's increment.
    Incremental,
}

impl<const D: usize> Parts<D> {
    /// Terms alone.
    pub fn of_terms(terms: Vec<Box<dyn NodeTerm<D>>>) -> Self {
        Parts {
            terms,
            kernel: None,
            inertia: None,
            displacement: None,
        }
    }
}

macro_rules! methods {
    ($($module:ident),* $(,)?) => {
        $(pub mod $module;)*

        /// All boundary methods, in the order in which they are listed.
        pub static METHODS: &[&MethodInfo] = &[$(&$module::METHOD),*];

        /// What the side's method makes of it.
        pub(crate) fn layout<const D: usize>(
            problem: &Problem<D>,
            side: Side,
            method: &SideMethod,
        ) -> Result<Layout, SolverError> {
            $(if method.method == $module::METHOD.name {
                return $module::layout(problem, side, method);
            })*
            Err(unknown(side, method))
        }

        /// Builds the terms of the method called `name`.
        pub(crate) fn build<const D: usize>(
            name: &str,
            context: &Context<'_, D>,
        ) -> Result<Parts<D>, SolverError> {
            $(if name == $module::METHOD.name {
                return $module::build(context);
            })*
            Ok(Parts::of_terms(Vec::new()))
        }
    };
}

methods! {
    free,
    roller,
    fixed,
    dashpot,
    damping_layer,
    pml,
    pml_stretched,
    extended,
    inflow,
}

/// The method called `name`.
pub fn find(name: &str) -> Option<&'static MethodInfo> {
    METHODS.iter().copied().find(|m| m.name == name)
}

fn unknown(side: Side, method: &SideMethod) -> SolverError {
    let names: Vec<&str> = METHODS.iter().map(|m| m.name).collect();
    SolverError::Setup {
        field: format!("boundary.{}.method", side.name()),
        reason: format!(
            "no method is called {:?}; known are {}",
            method.method,
            names.join(", ")
        ),
    }
}

/// Terms that hold the outer ends of the sides in `context`.
pub(crate) fn walls<const D: usize>(context: &Context<'_, D>) -> Vec<Box<dyn NodeTerm<D>>> {
    let ends = context.sides.iter();
    let term = |s: &Assigned| -> Option<Box<dyn NodeTerm<D>>> {
        match s.layout.end {
            End::Free => None,
            End::Inflow => Some(Box::new(inflow::MovingEnd::new(context, s.side))),
            held => Some(Box::new(wall::Wall::new(context, s.side, held))),
        }
    };
    ends.filter_map(term).collect()
}
