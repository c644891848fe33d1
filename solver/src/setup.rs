//! From a problem to a model: points, regions, terms.

mod flowing;
mod frame;

use crate::basis::on_grid;
use crate::boundary::{self, Assigned, Context, DisplacementTransfer, LayerPoints};
use crate::drive::{PointForce, SideDrive};
use crate::error::SolverError;
use crate::flow::{Dimension, Space};
use crate::geometry::{Geometry, Owner};
use crate::linear::LinearSolver;
use crate::material::MaterialBlock;
use crate::material::linear_elastic::LinearElastic;
use crate::physics::bulk::{Carried, Kept};
use crate::physics::flowing::Flowing;
use crate::physics::kernel::{NodeTerm, RegionKernel};
use crate::physics::model::{Model, Parts, Region};
use crate::points::Points;
use crate::problem::{Drive, MassKind, PointMode, Problem, Scheme, SolverKind, Transfer};
use crate::tensor::Vector;
use std::ops::Range;

/// Builds the model of a problem.
///
/// # Errors
/// [`SolverError::Setup`] naming the field at fault.
pub fn model<const D: usize>(problem: &Problem<D>) -> Result<Model<D>, SolverError>
where
    Space: Dimension<D>,
{
    flowing::check(problem)?;
    let geometry = Geometry::new(problem)?;
    let framed = frame::of_layers(problem, &geometry);
    let (problem, frame) = match &framed {
        Some(framed) => (&framed.problem, framed.velocity),
        None => (problem, [0.0; D]),
    };
    let frozen = problem.point_mode == PointMode::Frozen;
    let Filled {
        mut points,
        mut ranges,
    } = fill(problem, &geometry)?;
    let flow = take_flowing(problem, &geometry, &mut points, &mut ranges)?;
    let mut regions = Vec::new();
    let mut terms = Vec::new();
    let mut first_kept = points.len();
    let mut movable = 0;
    let mut displacement = None;
    let mut inertia: Option<Vec<Vector<D>>> = None;
    for (owner, range) in &ranges {
        if let Owner::Layer(_, layer) = owner {
            if *layer == LayerPoints::Kept {
                first_kept = first_kept.min(range.start);
            }
            continue;
        }
        movable = range.end;
        regions.push(Region {
            range: range.clone(),
            in_target: *owner != Owner::Outside,
            kernel: bulk(problem, *owner, range.clone()),
        });
    }
    for info in boundary::METHODS {
        let owned = ranges
            .iter()
            .find(|(o, _)| matches!(o, Owner::Layer(n, _) if *n == info.name));
        let layer = owned.map_or(0..0, |(_, r)| r.clone());
        let Some(context) = context(problem, &geometry, info.name, &points, layer.clone()) else {
            continue;
        };
        let parts = boundary::build(info.name, &context)?;
        terms.extend(parts.terms);
        if let Some(kernel) = parts.kernel {
            regions.push(Region {
                range: layer.clone(),
                in_target: false,
                kernel,
            });
        }
        if let Some(factors) = parts.inertia {
            let all = inertia.get_or_insert_with(|| vec![[1.0; D]; points.len()]);
            all[layer.clone()].copy_from_slice(&factors);
        }
        if let Some(how) = parts.displacement {
            displacement = Some(how);
        }
    }
    points.inertia = inertia;
    terms.extend(drives(problem, &geometry));
    if let Some(flow) = &flow {
        terms.extend(flowing::intruders(
            problem,
            frame,
            &geometry,
            flow,
            &points.place,
        )?);
    }
    let carries = flow.is_none() && problem.transfer != Transfer::Keep;
    if carries && problem.scheme != Scheme::QuasiStatic {
        let affine = problem.transfer == Transfer::Affine;
        points.carry_motion(first_kept, affine, problem.scheme != Scheme::Explicit);
        if let (Some(_), Some(motion)) = (displacement, points.motion.as_mut()) {
            motion.u = Some(vec![[0.0; D]; first_kept]);
        }
    }
    let kind = match (problem.solver, problem.scheme) {
        // without inertia the condition of the matrix grows with the mesh
        (SolverKind::Auto, Scheme::QuasiStatic) => SolverKind::Direct,
        (kind, _) => kind,
    };
    Model::new(Parts {
        solver: LinearSolver::new(kind, problem.rel_tol, geometry.grid.node_count()),
        disc: on_grid(problem.basis, &geometry.grid, geometry.per_axis),
        grid: geometry.grid,
        points,
        regions,
        terms,
        flow,
        frame,
        movable: (!frozen).then_some(movable),
        first_kept: if problem.transfer == Transfer::Keep {
            0
        } else {
            first_kept
        },
        replaced_displacement: displacement == Some(DisplacementTransfer::Replaced),
        transfer: problem.transfer,
        consistent: problem.mass == MassKind::Consistent,
        explicit: problem.scheme == Scheme::Explicit,
    })
}

/// Takes the points that explicit steps move out of all, if there are such.
fn take_flowing<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
    points: &mut Points<D>,
    ranges: &mut Vec<(Owner, Range<usize>)>,
) -> Result<Option<Flowing<D>>, SolverError>
where
    Space: Dimension<D>,
{
    if !flowing::flows(problem) {
        return Ok(None);
    }
    let (bulk, layers): (Vec<_>, Vec<_>) = std::mem::take(ranges)
        .into_iter()
        .partition(|(owner, _)| !matches!(owner, Owner::Layer(..)));
    let bulk: Vec<Range<usize>> = bulk.into_iter().map(|(_, range)| range).collect();
    let first = bulk.last().map_or(0, |range| range.end);
    let rest = flowing::without_flowing(points, first);
    let flow = flowing::flowing(problem, geometry, points, &bulk, &rest)?;
    let moved = |(owner, r): (Owner, Range<usize>)| (owner, r.start - first..r.end - first);
    *ranges = layers.into_iter().map(moved).collect();
    *points = rest;
    Ok(Some(flow))
}

/// The kernel of plain material, in the stiffness of its place.
fn bulk<const D: usize>(
    problem: &Problem<D>,
    owner: Owner,
    range: Range<usize>,
) -> Box<dyn RegionKernel<D>> {
    let elastic = match (owner, problem.inclusion) {
        (Owner::Inclusion, Some(ratio)) => problem.material.stiffened(ratio),
        _ => problem.material,
    };
    let material: Box<dyn MaterialBlock<D>> = Box::new(LinearElastic::new(&elastic));
    match problem.transfer {
        Transfer::Keep => Box::new(Kept::new(range, material)),
        _ => {
            let finite = problem.point_mode == PointMode::Moving;
            Box::new(Carried::new(range, material, finite))
        }
    }
}

/// Points with the ranges of their owners.
struct Filled<const D: usize> {
    points: Points<D>,
    ranges: Vec<(Owner, Range<usize>)>,
}

/// Fills the material with points: the body first, then plain material, layers that carry the motion,
/// layers at rest.
fn fill<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
) -> Result<Filled<D>, SolverError> {
    let mut owners = vec![Owner::Target, Owner::Inclusion, Owner::Outside];
    for layer in [LayerPoints::Carried, LayerPoints::Kept] {
        let has = |name: &str| {
            let mut sides = geometry.assigned.iter().filter(|a| a.method.method == name);
            sides.any(|a| a.layout.layer == Some(layer))
        };
        let names = boundary::METHODS
            .iter()
            .map(|m| m.name)
            .filter(|name| has(name));
        owners.extend(names.map(|name| Owner::Layer(name, layer)));
    }
    let h = geometry.grid.h;
    let cells = geometry.material_cells_along().iter().product();
    let mut points = Points::default();
    let mut ranges = Vec::new();
    for wanted in owners {
        let start = points.len();
        for cell in 0..cells {
            if geometry.owner(problem, &geometry.cell_centre(cell)) == wanted {
                let lower = geometry.cell_corner(cell);
                let (n, gap) = (geometry.per_axis, problem.face_gap);
                points.fill_cell(&lower, &h, n, gap, problem.material.density);
            }
        }
        if points.len() > start {
            ranges.push((wanted, start..points.len()));
        }
    }
    Ok(Filled { points, ranges })
}

/// What the method called `name` may know; `None` when no side uses it.
fn context<'a, const D: usize>(
    problem: &Problem<D>,
    geometry: &'a Geometry<D>,
    name: &str,
    points: &'a Points<D>,
    layer: Range<usize>,
) -> Option<Context<'a, D>> {
    let uses = |a: &&Assigned| a.method.method == name;
    let sides: Vec<Assigned> = geometry.assigned.iter().filter(uses).cloned().collect();
    (!sides.is_empty()).then(|| Context {
        grid: &geometry.grid,
        target: problem.target,
        material_box: geometry.material_box,
        material: problem.material,
        moving: problem.point_mode == PointMode::Moving,
        velocity: problem.flow.velocity,
        transfer: problem.transfer,
        mass: problem.mass,
        explicit_dt: (problem.scheme == Scheme::Explicit).then_some(problem.dt),
        end_time: problem.end_time,
        points,
        layer,
        sides,
    })
}

/// The drives, which come after the walls since they may move what a wall would hold.
fn drives<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
) -> Vec<Box<dyn NodeTerm<D>>> {
    let moving = problem.point_mode == PointMode::Moving;
    let term = |drive: &Drive<D>| -> Box<dyn NodeTerm<D>> {
        match drive {
            Drive::SideVelocity { side, pulse } => {
                let region = &problem.target;
                let plane = if side.upper {
                    region.upper
                } else {
                    region.lower
                }[side.axis];
                Box::new(SideDrive::new(&geometry.grid, *side, plane, *pulse, moving))
            }
            Drive::PointForce {
                place,
                direction,
                pulse,
            } => Box::new(PointForce::new(*place, *direction, *pulse, moving)),
        }
    };
    problem.drives.iter().map(term).collect()
}
