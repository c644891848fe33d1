//! Where things are: the sides laid out, all material, the grid around it; and what is refused before
//! anything is allocated.

mod refused;

use crate::boundary::{self, Assigned, End, LayerPoints};
use crate::error::SolverError;
use crate::grid::Grid;
use crate::problem::{Aabb, PointMode, Problem, Side};
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
        refused::problem(problem)?;
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
        refused::size(problem, &material_box, &h, &assigned)?;
        refused::corners(&assigned)?;
        refused::moving_layers(problem, &assigned)?;
        refused::width(problem, &material_box, &h)?;
        refused::inclusion(problem, &h, &assigned)?;
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
    pub(crate) fn owner(&self, problem: &Problem<D>, centre: &Vector<D>) -> Owner {
        let target = &problem.target;
        let mut owner = match problem.included() {
            Some(region) if region.contains(centre) => Owner::Inclusion,
            _ => Owner::Target,
        };
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

/// Whose points a cell holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Owner {
    /// The body.
    Target,
    /// Its part of another stiffness.
    Inclusion,
    /// Plain material outside it.
    Outside,
    /// A method's own layer.
    Layer(&'static str, LayerPoints),
}
