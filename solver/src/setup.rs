//! From a problem to a model: sides laid out, grid, points, regions, terms.

use crate::Bill;
use crate::basis::on_grid;
use crate::boundary::{self, Assigned, Context, End, Layout};
use crate::drive::{PointForce, SideDrive};
use crate::error::SolverError;
use crate::grid::Grid;
use crate::linear::LinearSolver;
use crate::material::MaterialBlock;
use crate::material::linear_elastic::LinearElastic;
use crate::physics::bulk::{Carried, Kept};
use crate::physics::kernel::{NodeTerm, RegionKernel};
use crate::physics::model::{Model, Region};
use crate::points::Points;
use crate::problem::{Aabb, Drive, PointMode, Problem, Scheme, Side, SolverKind, Transfer};
use crate::tensor::Vector;

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
        let h = fitted_cell(problem);
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

fn fitted_cell<const D: usize>(problem: &Problem<D>) -> Vector<D> {
    std::array::from_fn(|a| {
        let length = problem.target.upper[a] - problem.target.lower[a];
        length / whole_cells(length, problem.cell_size)
    })
}

fn setup_error(field: impl Into<String>, reason: impl Into<String>) -> SolverError {
    SolverError::Setup {
        field: field.into(),
        reason: reason.into(),
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
    let moving = problem.point_mode == PointMode::Moving;
    let (mut points, in_target) = fill(problem, &geometry);
    if problem.transfer != Transfer::Keep && problem.scheme != Scheme::QuasiStatic {
        points.carry_motion(problem.transfer == Transfer::Affine);
    }
    let kernel = |range: std::ops::Range<usize>| -> Box<dyn RegionKernel<D>> {
        let material: Box<dyn MaterialBlock<D>> = Box::new(LinearElastic::new(&problem.material));
        match problem.transfer {
            Transfer::Keep => Box::new(Kept::new(range, material)),
            _ => Box::new(Carried::new(range, material, moving)),
        }
    };
    let mut regions = vec![Region {
        range: 0..in_target,
        in_target: true,
        kernel: kernel(0..in_target),
    }];
    if points.len() > in_target {
        let range = in_target..points.len();
        regions.push(Region {
            range: range.clone(),
            in_target: false,
            kernel: kernel(range),
        });
    }
    let terms = terms(problem, &geometry, moving)?;
    let kind = match (problem.solver, problem.scheme) {
        // without inertia the condition of the matrix grows with the mesh
        (SolverKind::Auto, Scheme::QuasiStatic) => SolverKind::Direct,
        (kind, _) => kind,
    };
    let solver = LinearSolver::new(kind, problem.rel_tol, geometry.grid.node_count());
    let disc = on_grid(problem.basis, &geometry.grid);
    Model::new(
        geometry.grid,
        disc,
        points,
        regions,
        terms,
        moving,
        problem.transfer,
        solver,
    )
}

/// Fills the material with points, those of the body first; returns how many those are.
fn fill<const D: usize>(problem: &Problem<D>, geometry: &Geometry<D>) -> (Points<D>, usize) {
    let mut points = Points::default();
    let mut in_target = 0;
    let h = geometry.grid.h;
    let counts = geometry.material_cells_along();
    for body in [true, false] {
        for cell in 0..counts.iter().product() {
            let mut rest = cell;
            let lower: Vector<D> = std::array::from_fn(|a| {
                let index = rest % counts[a];
                rest /= counts[a];
                geometry.material_box.lower[a] + h[a] * index as f64
            });
            let inside = (0..D).all(|a| {
                let centre = lower[a] + 0.5 * h[a];
                centre > problem.target.lower[a] && centre < problem.target.upper[a]
            });
            if inside == body {
                points.fill_cell(&lower, &h, geometry.per_axis, problem.material.density);
            }
        }
        if body {
            in_target = points.len();
        }
    }
    (points, in_target)
}

/// Terms of all boundary methods, then of the drives, which may move what a wall would hold.
fn terms<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
    moving: bool,
) -> Result<Vec<Box<dyn NodeTerm<D>>>, SolverError> {
    let mut terms = Vec::new();
    for info in boundary::METHODS {
        let uses = |a: &&Assigned| a.method.method == info.name;
        let sides: Vec<Assigned> = geometry.assigned.iter().filter(uses).cloned().collect();
        if sides.is_empty() {
            continue;
        }
        let context = Context {
            grid: &geometry.grid,
            target: problem.target,
            material_box: geometry.material_box,
            material: problem.material,
            moving,
            sides,
        };
        terms.extend(boundary::build(info.name, &context)?.terms);
    }
    for drive in &problem.drives {
        terms.push(match drive {
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
            } => Box::new(PointForce::new(*place, *direction, *pulse, moving))
                as Box<dyn NodeTerm<D>>,
        });
    }
    Ok(terms)
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
        sample.carry_motion(problem.transfer == Transfer::Affine);
    }
    let stress = if problem.transfer == Transfer::Keep {
        0
    } else {
        size_of::<[[f64; D]; D]>()
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
