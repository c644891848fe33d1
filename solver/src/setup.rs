//! From a problem to a model: sides laid out, grid, points, regions, terms.

use crate::Bill;
use crate::basis::on_grid;
use crate::boundary::{self, Assigned, Context, DisplacementTransfer, End, LayerPoints, Layout};
use crate::drive::{PointForce, SideDrive};
use crate::error::SolverError;
use crate::grid::Grid;
use crate::linear::LinearSolver;
use crate::material::MaterialBlock;
use crate::material::linear_elastic::LinearElastic;
use crate::physics::bulk::{Carried, Kept};
use crate::physics::kernel::{NodeTerm, RegionKernel};
use crate::physics::model::{Model, Parts, Region};
use crate::points::Points;
use crate::problem::{Aabb, Drive, PointMode, Problem, Scheme, Side, SolverKind, Transfer};
use crate::tensor::Vector;
use std::ops::Range;

/// Free surfaces of moving material get so many empty cells to move into.
const MARGIN_CELLS: usize = 2;

/// Where things are: the sides' layouts, all material, the grid around it.
pub(crate) struct Geometry<const D: usize> {
    pub(crate) assigned: Vec<Assigned>,
    pub(crate) material_box: Aabb<D>,
    pub(crate) grid: Grid<D>,
    pub(crate) per_axis: usize,
}

impl<const D: usize> Geometry<D> {
    /// Lays out a problem. Cells are fitted to the body: the largest that divide its lengths and are
    /// not larger than asked. Layers get whole cells.
    ///
    /// # Errors
    /// [`SolverError::Setup`] naming the field at fault.
    pub(crate) fn new(problem: &Problem<D>) -> Result<Self, SolverError> {
        check(problem)?;
        let moving = problem.point_mode == PointMode::Moving;
        let h = fitted_cell(&problem.target, problem.cell_size);
        let mut material_box = problem.target;
        let mut assigned = Vec::new();
        let mut margin = [[0; 2]; D];
        for axis in 0..D {
            for (upper, method) in [false, true].into_iter().zip(&problem.sides[axis]) {
                let side = Side { axis, upper };
                let mut layout = boundary::layout(problem, side, method)?;
                layout.outside = h[axis] * whole_cells(layout.outside, h[axis]);
                if upper {
                    material_box.upper[axis] += layout.outside;
                } else {
                    material_box.lower[axis] -= layout.outside;
                }
                if moving && layout.end == End::Free {
                    margin[axis][usize::from(upper)] = MARGIN_CELLS;
                }
                assigned.push(Assigned {
                    side,
                    method: method.clone(),
                    layout,
                });
            }
        }
        check_size(problem, &material_box, &h)?;
        check_corners(&assigned)?;
        let grid = Grid {
            origin: std::array::from_fn(|a| material_box.lower[a] - h[a] * margin[a][0] as f64),
            h,
            cells: std::array::from_fn(|a| {
                cells_along(&material_box, a, h[a]) + margin[a][0] + margin[a][1]
            }),
        };
        let per_axis = (problem.points_per_cell as f64)
            .powf(1.0 / D as f64)
            .round() as usize;
        Ok(Geometry {
            assigned,
            material_box,
            grid,
            per_axis,
        })
    }

    /// Whose points a cell with this centre holds: a layer of its own has what lies beyond its side.
    fn owner(&self, target: &Aabb<D>, centre: &Vector<D>) -> Owner {
        let mut owner = Owner::Target;
        for a in &self.assigned {
            let axis = a.side.axis;
            let beyond = if a.side.upper {
                centre[axis] > target.upper[axis]
            } else {
                centre[axis] < target.lower[axis]
            };
            if !beyond {
                continue;
            }
            owner = match (owner, a.layout.layer) {
                (_, Some(layer)) => {
                    let info = boundary::find(&a.method.method);
                    Owner::Layer(info.map_or("", |m| m.name), layer)
                }
                (layer @ Owner::Layer(..), None) => layer,
                (_, None) => Owner::Outside,
            };
        }
        owner
    }

    fn material_cells_along(&self) -> [usize; D] {
        std::array::from_fn(|a| cells_along(&self.material_box, a, self.grid.h[a]))
    }
}

fn cells_along<const D: usize>(region: &Aabb<D>, axis: usize, h: f64) -> usize {
    ((region.upper[axis] - region.lower[axis]) / h).round() as usize
}

/// Cells of length `h` that cover `length`, forgiving rounding errors.
fn whole_cells(length: f64, h: f64) -> f64 {
    (length / h - 1e-6).ceil().max(0.0)
}

/// Edges (m) of the cells in use: the longest that divide the lengths of `target` and are not longer
/// than `largest` (m).
pub fn fitted_cell<const D: usize>(target: &Aabb<D>, largest: f64) -> Vector<D> {
    std::array::from_fn(|a| {
        let length = target.upper[a] - target.lower[a];
        length / whole_cells(length, largest)
    })
}

fn setup_error(field: impl Into<String>, reason: impl Into<String>) -> SolverError {
    SolverError::Setup {
        field: field.into(),
        reason: reason.into(),
    }
}

/// More points than this (some 10 GB) are a slip of a size rather than a scene.
const MOST_POINTS: f64 = 5e7;
/// More steps than this (years of work on a mesh of any size) likewise.
const MOST_STEPS: f64 = 1e9;

/// Refuses what no machine at hand can hold, before anything is allocated.
fn check_size<const D: usize>(
    problem: &Problem<D>,
    material: &Aabb<D>,
    h: &Vector<D>,
) -> Result<(), SolverError> {
    let cells: f64 = (0..D)
        .map(|a| (material.upper[a] - material.lower[a]) / h[a])
        .product();
    let points = cells * problem.points_per_cell as f64;
    if points.is_nan() || points > MOST_POINTS {
        let reason = format!(
            "cells of {} m make {points:.1e} points of body and layers, more than {MOST_POINTS:.0e}",
            problem.cell_size
        );
        return Err(setup_error("grid.h_m", reason));
    }
    let steps = problem.end_time / problem.dt;
    if steps.is_nan() || steps > MOST_STEPS {
        let reason = format!("{steps:.1e} steps to the end, more than {MOST_STEPS:.0e}");
        return Err(setup_error("time.dt_s", reason));
    }
    Ok(())
}

/// Layers with kernels of their own cannot share a corner with each other.
fn check_corners(assigned: &[Assigned]) -> Result<(), SolverError> {
    let mut layers = assigned.iter().filter(|a| a.layout.layer.is_some());
    let Some(first) = layers.next() else {
        return Ok(());
    };
    let other =
        layers.find(|a| a.method.method != first.method.method && a.side.axis != first.side.axis);
    match other {
        None => Ok(()),
        Some(other) => {
            let reason = format!(
                "layers of {} and {} meet in a corner; one method for both sides works",
                first.method.method, other.method.method
            );
            Err(setup_error(
                format!("boundary.{}.method", other.side.name()),
                reason,
            ))
        }
    }
}

/// What a problem must hold whatever its boundaries.
fn check<const D: usize>(problem: &Problem<D>) -> Result<(), SolverError> {
    let positive = [
        ("grid.h_m", problem.cell_size),
        ("time.dt_s", problem.dt),
        ("time.end_s", problem.end_time),
        ("material.E_Pa", problem.material.youngs_modulus),
        ("material.rho_kg_m3", problem.material.density),
        ("solver.rel_tol", problem.rel_tol),
    ];
    for (field, value) in positive {
        if !(value > 0.0 && value.is_finite()) {
            return Err(setup_error(field, format!("{value} is not positive")));
        }
    }
    let nu = problem.material.poissons_ratio;
    if !(nu > -1.0 && nu < 0.5) {
        return Err(setup_error(
            "material.nu",
            format!("{nu} is not between -1 and 0.5, both excluded"),
        ));
    }
    for axis in 0..D {
        let length = problem.target.upper[axis] - problem.target.lower[axis];
        let field = ["body.width_m", "body.height_m", "body.depth_m"][axis.min(2)];
        if !(length > 0.0 && length.is_finite()) {
            return Err(setup_error(field, format!("{length} is not positive")));
        }
        if problem.cell_size > length {
            let reason = format!(
                "a cell of {} m is larger than the body's {length} m ({field})",
                problem.cell_size
            );
            return Err(setup_error("grid.h_m", reason));
        }
    }
    let per_axis = (problem.points_per_cell as f64)
        .powf(1.0 / D as f64)
        .round() as usize;
    if per_axis == 0 || per_axis.pow(D as u32) != problem.points_per_cell {
        let reason = format!(
            "{} is not the same number along each axis to the power {D}",
            problem.points_per_cell
        );
        return Err(setup_error("points.per_cell", reason));
    }
    let keeps = problem.transfer == Transfer::Keep;
    if keeps && problem.point_mode == PointMode::Moving {
        return Err(setup_error(
            "points.transfer",
            "keep needs points.mode = \"frozen\"",
        ));
    }
    Ok(())
}

/// Builds the model of a problem.
///
/// # Errors
/// [`SolverError::Setup`] naming the field at fault.
pub fn model<const D: usize>(problem: &Problem<D>) -> Result<Model<D>, SolverError> {
    let geometry = Geometry::new(problem)?;
    let frozen = problem.point_mode == PointMode::Frozen;
    let Filled { mut points, ranges } = fill(problem, &geometry)?;
    let mut regions = Vec::new();
    let mut terms = Vec::new();
    let mut first_kept = points.len();
    let mut movable = 0;
    let mut displacement = None;
    let mut replaced_displacement = None;
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
            in_target: *owner == Owner::Target,
            kernel: bulk(problem, range.clone()),
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
            if how == DisplacementTransfer::Replaced {
                replaced_displacement = Some(layer);
            }
        }
    }
    points.inertia = inertia;
    terms.extend(drives(problem, &geometry));
    if problem.transfer != Transfer::Keep && problem.scheme != Scheme::QuasiStatic {
        points.carry_motion(first_kept, problem.transfer == Transfer::Affine);
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
        disc: on_grid(problem.basis, &geometry.grid),
        grid: geometry.grid,
        points,
        regions,
        terms,
        movable: (!frozen).then_some(movable),
        first_kept: if problem.transfer == Transfer::Keep {
            0
        } else {
            first_kept
        },
        replaced_displacement,
        transfer: problem.transfer,
    })
}

/// The kernel of plain material.
fn bulk<const D: usize>(problem: &Problem<D>, range: Range<usize>) -> Box<dyn RegionKernel<D>> {
    let material: Box<dyn MaterialBlock<D>> = Box::new(LinearElastic::new(&problem.material));
    match problem.transfer {
        Transfer::Keep => Box::new(Kept::new(range, material)),
        _ => {
            let finite = problem.point_mode == PointMode::Moving;
            Box::new(Carried::new(range, material, finite))
        }
    }
}

/// Whose points a cell holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Owner {
    /// The body.
    Target,
    /// Plain material outside it.
    Outside,
    /// A method's own layer.
    Layer(&'static str, LayerPoints),
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
    let mut owners = vec![Owner::Target, Owner::Outside];
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
    let counts = geometry.material_cells_along();
    let mut points = Points::default();
    let mut ranges = Vec::new();
    for wanted in owners {
        let start = points.len();
        for cell in 0..counts.iter().product() {
            let mut rest = cell;
            let lower: Vector<D> = std::array::from_fn(|a| {
                let index = rest % counts[a];
                rest /= counts[a];
                geometry.material_box.lower[a] + h[a] * index as f64
            });
            let centre: Vector<D> = std::array::from_fn(|a| lower[a] + 0.5 * h[a]);
            if geometry.owner(&problem.target, &centre) == wanted {
                points.fill_cell(&lower, &h, geometry.per_axis, problem.material.density);
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
        transfer: problem.transfer,
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

/// Whole steps that reach the end of the run.
pub(crate) fn steps<const D: usize>(problem: &Problem<D>) -> usize {
    (problem.end_time / problem.dt - 1e-9).ceil().max(1.0) as usize
}

/// The bill, from the geometry alone.
pub(crate) fn bill<const D: usize>(problem: &Problem<D>) -> Result<Bill, SolverError> {
    let geometry = Geometry::new(problem)?;
    let nodes = geometry.grid.node_count();
    let mut sample = Points::<D>::default();
    sample.fill_cell(&[0.0; D], &[1.0; D], 1, 1.0);
    if problem.transfer != Transfer::Keep {
        sample.carry_motion(1, problem.transfer == Transfer::Affine);
    }
    let stress = if problem.transfer == Transfer::Keep {
        0
    } else {
        2 * size_of::<[[f64; D]; D]>()
    };
    let disc = on_grid(
        problem.basis,
        &Grid {
            cells: [1; D],
            ..geometry.grid.clone()
        },
    );
    let layers = |l: &Layout| l.outside + l.inside;
    let methods = geometry.assigned.iter().map(|a| match layers(&a.layout) {
        0.0 => format!("{}: {}", a.side.name(), a.method.method),
        t => format!("{}: {} of {t} m", a.side.name(), a.method.method),
    });
    let scheme = format!(
        "{:?}, {:?} points, transfer {:?}",
        problem.scheme, problem.point_mode, problem.transfer
    );
    let cell = geometry.grid.h.map(|h| format!("{h:.6}")).join(" x ");
    let basis = format!("{} basis on cells of {cell} m", disc.name());
    let mut features = vec![basis, scheme.to_lowercase()];
    features.extend(methods);
    let neighbours = 3usize.pow(D as u32);
    let matrices = if problem.transfer == Transfer::Keep {
        2
    } else {
        1
    };
    let block = size_of::<[[f64; D]; D]>() * matrices + size_of::<u32>();
    Ok(Bill {
        features,
        points: geometry.material_cells_along().iter().product::<usize>() * problem.points_per_cell,
        nodes,
        unknowns: nodes * D,
        steps: steps(problem),
        bytes_per_point: sample.bytes_per_point() + stress + disc.bytes_per_point(),
        bytes_per_node: neighbours * block + 16 * size_of::<Vector<D>>(),
    })
}
