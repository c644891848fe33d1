//! Where things are: the sides laid out, all material, the grid around it; and what is refused before
//! anything is allocated.

use crate::boundary::{self, Assigned, End, LayerPoints};
use crate::error::SolverError;
use crate::grid::Grid;
use crate::problem::{Aabb, BasisKind, MassKind, PointMode, Problem, Scheme, Side, Transfer};
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
        let h = fitted_cell(&problem.target, problem.edges());
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
                let room = whole_cells(problem.flow.room[axis][usize::from(upper)], h[axis]);
                let least = match moving && layout.end == End::Free {
                    true => MARGIN_CELLS,
                    false => 0,
                };
                margin[axis][usize::from(upper)] = least.max(room as usize);
                assigned.push(Assigned {
                    side,
                    method: method.clone(),
                    layout,
                });
            }
        }
        check_size(problem, &material_box, &h, &assigned)?;
        check_corners(&assigned)?;
        check_width(problem, &material_box, &h)?;
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
    pub(crate) fn owner(&self, target: &Aabb<D>, centre: &Vector<D>) -> Owner {
        let mut owner = Owner::Target;
        for a in &self.assigned {
            if !is_beyond(a.side, target, centre) {
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

    /// How many sides have layers of their own that hold this place.
    pub(crate) fn layers_at(&self, target: &Aabb<D>, centre: &Vector<D>) -> usize {
        let own = self.assigned.iter().filter(|a| a.layout.layer.is_some());
        own.filter(|a| is_beyond(a.side, target, centre)).count()
    }

    /// Lower corner of a cell of the material (m), counted with the first axis fastest.
    pub(crate) fn cell_corner(&self, cell: usize) -> Vector<D> {
        let (counts, mut rest) = (self.material_cells_along(), cell);
        std::array::from_fn(|a| {
            let index = rest % counts[a];
            rest /= counts[a];
            self.material_box.lower[a] + self.grid.h[a] * index as f64
        })
    }

    /// Its centre (m).
    pub(crate) fn cell_centre(&self, cell: usize) -> Vector<D> {
        let lower = self.cell_corner(cell);
        std::array::from_fn(|a| lower[a] + 0.5 * self.grid.h[a])
    }

    /// Cells of all material along each axis.
    pub(crate) fn material_cells_along(&self) -> [usize; D] {
        std::array::from_fn(|a| cells_along(&self.material_box, a, self.grid.h[a]))
    }
}

/// Does a place lie beyond a side of the body?
fn is_beyond<const D: usize>(side: Side, target: &Aabb<D>, place: &Vector<D>) -> bool {
    if side.upper {
        place[side.axis] > target.upper[side.axis]
    } else {
        place[side.axis] < target.lower[side.axis]
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
pub fn fitted_cell<const D: usize>(target: &Aabb<D>, largest: Vector<D>) -> Vector<D> {
    std::array::from_fn(|a| {
        let length = target.upper[a] - target.lower[a];
        length / whole_cells(length, largest[a])
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
    assigned: &[Assigned],
) -> Result<(), SolverError> {
    let points_of = |region: &Aabb<D>| -> f64 {
        let cells = |a: usize| (region.upper[a] - region.lower[a]) / h[a];
        (0..D).map(cells).product::<f64>() * problem.points_per_cell as f64
    };
    let points = points_of(material);
    let thickest = assigned
        .iter()
        .max_by(|a, b| a.layout.outside.total_cmp(&b.layout.outside));
    if let Some(a) = thickest
        && points > MOST_POINTS
        && points_of(&problem.target) <= MOST_POINTS
    {
        let reason = format!(
            "a layer of {} m makes {points:.1e} points of cells of {} m, more than {MOST_POINTS:.0e}",
            a.layout.outside, problem.cell_size
        );
        return Err(setup_error(
            format!("boundary.{}.thickness_m", a.side.name()),
            reason,
        ));
    }
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

/// Wide functions need two cells along each axis.
fn check_width<const D: usize>(
    problem: &Problem<D>,
    material: &Aabb<D>,
    h: &Vector<D>,
) -> Result<(), SolverError> {
    let narrow = (0..D).find(|&a| cells_along(material, a, h[a]) < 2);
    match narrow {
        Some(axis) if problem.basis != BasisKind::Linear => {
            let reason = format!(
                "wider than the body's single cell along {}; use \"linear\" or smaller cells",
                ["x", "y", "z"][axis.min(2)]
            );
            Err(setup_error("basis", reason))
        }
        _ => Ok(()),
    }
}

/// Layers with kernels of their own cannot share a corner with each other.
fn check_corners(assigned: &[Assigned]) -> Result<(), SolverError> {
    let layers: Vec<&Assigned> = assigned
        .iter()
        .filter(|a| a.layout.layer.is_some())
        .collect();
    for (i, one) in layers.iter().enumerate() {
        for other in &layers[i + 1..] {
            if one.method.method != other.method.method && one.side.axis != other.side.axis {
                let reason = format!(
                    "layers of {} ({}) and {} meet in a corner; one method for both sides works",
                    one.method.method,
                    one.side.name(),
                    other.method.method
                );
                let field = format!("boundary.{}.method", other.side.name());
                return Err(setup_error(field, reason));
            }
        }
    }
    Ok(())
}

/// What a problem must hold whatever its boundaries.
fn check<const D: usize>(problem: &Problem<D>) -> Result<(), SolverError> {
    let positive = [
        ("grid.h_m", problem.cell_size),
        ("grid.aspect", problem.aspect),
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
        if problem.edges()[axis] > length {
            let reason = format!(
                "a cell of {} m is larger than the body's {length} m ({field})",
                problem.edges()[axis]
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
    if problem.scheme == Scheme::Explicit && problem.mass == MassKind::Consistent {
        return Err(setup_error(
            "time.mass",
            "explicit steps need lumped masses",
        ));
    }
    if let Some(gap) = problem.face_gap
        && !(gap > 0.0 && gap < 0.5 && per_axis > 1)
    {
        let reason = format!(
            "{gap} is not between 0 and 0.5, both excluded, of cells with two points along each axis at least"
        );
        return Err(setup_error("points.face_gap", reason));
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

/// Whose points a cell holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Owner {
    /// The body.
    Target,
    /// Plain material outside it.
    Outside,
    /// A method's own layer.
    Layer(&'static str, LayerPoints),
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::{Layout, SideMethod};

    fn layer(side: Side, method: &str) -> Assigned {
        let layout = Layout {
            layer: Some(LayerPoints::Kept),
            ..Layout::plain(End::Fixed)
        };
        Assigned {
            side,
            method: SideMethod::new(method),
            layout,
        }
    }

    #[test]
    fn every_corner_is_looked_at() {
        let [left, right, bottom] = [Side::LEFT, Side::RIGHT, Side::BOTTOM];
        let both = [layer(left, "pml"), layer(right, "pml-stretched")];
        assert!(check_corners(&both).is_ok());
        // the first two agree with the third in turn: the corner at fault is the last one
        let mixed = [
            layer(left, "pml"),
            layer(right, "pml-stretched"),
            layer(bottom, "pml"),
        ];
        assert!(check_corners(&mixed).is_err());
    }
}
