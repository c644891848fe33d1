//! What is refused before anything is allocated.

use super::{cells_along, setup_error};
use crate::boundary::{Assigned, End};
use crate::error::SolverError;
use crate::problem::{Aabb, BasisKind, MassKind, PointMode, Problem, Scheme, Transfer};
use crate::tensor::Vector;

/// More points than this (some 10 GB) are a slip of a size rather than a scene.
const MOST_POINTS: f64 = 5e7;
/// More steps than this (years of work on a mesh of any size) likewise.
const MOST_STEPS: f64 = 1e9;

/// Refuses what no machine at hand can hold, before anything is allocated.
pub(super) fn size<const D: usize>(
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
pub(super) fn width<const D: usize>(
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

/// Boundary methods know one material, that of the body around an inclusion.
pub(super) fn inclusion<const D: usize>(
    problem: &Problem<D>,
    h: &Vector<D>,
    assigned: &[Assigned],
) -> Result<(), SolverError> {
    let Some(ratio) = problem.inclusion else {
        return Ok(());
    };
    let refuse = |reason: String| Err(setup_error("material.inclusion", reason));
    if !(ratio > 0.0 && ratio.is_finite()) {
        return refuse(format!("{ratio} is not positive"));
    }
    if problem.scheme == Scheme::Explicit {
        return refuse("explicit steps have one stiffness; use time.scheme = \"newmark\"".into());
    }
    let plain = ["fixed", "roller", "free"];
    let cells = |a: &Assigned| cells_along(&problem.target, a.side.axis, h[a.side.axis]);
    let touched = assigned
        .iter()
        .find(|a| cells(a) < 3 && !plain.contains(&a.method.method.as_str()));
    match touched {
        Some(a) => refuse(format!(
            "the middle third of {} cells reaches the side {}, whose method {} knows one stiffness; take 3 cells at least",
            cells(a),
            a.side.name(),
            a.method.method
        )),
        None => Ok(()),
    }
}

/// Layers with kernels of their own cannot share a corner with each other.
pub(super) fn corners(assigned: &[Assigned]) -> Result<(), SolverError> {
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
pub(super) fn problem<const D: usize>(problem: &Problem<D>) -> Result<(), SolverError> {
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

/// Layers whose points rest do so in a frame that moves with the material: other sides have to go along.
pub(super) fn moving_layers<const D: usize>(
    problem: &Problem<D>,
    assigned: &[Assigned],
) -> Result<(), SolverError> {
    let velocity = problem.flow.velocity;
    if velocity == [0.0; D] || !assigned.iter().any(|a| a.layout.rests()) {
        return Ok(());
    }
    for Assigned {
        side,
        method,
        layout,
    } in assigned
    {
        let goes_along = match layout.end {
            End::Free => true,
            End::Roller => velocity[side.axis] == 0.0,
            End::Fixed | End::Inflow => false,
        };
        let bare = layout.outside == 0.0 && layout.inside == 0.0;
        if !(layout.rests() || bare && goes_along) {
            return Err(setup_error(
                format!("boundary.{}.method", side.name()),
                format!(
                    "the layer on another side moves with the material, at {velocity:?} m/s, and {:?} is not known to go along; use \"free\", \"dashpot\", another such layer, or \"roller\" on a side along which it moves",
                    method.method
                ),
            ));
        }
    }
    if problem.drives.is_empty() {
        return Ok(());
    }
    Err(setup_error(
        "load",
        "loads stay where they are, and a layer moves with the material",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boundary::{End, LayerPoints};
    use crate::boundary::{Layout, SideMethod};
    use crate::problem::Side;

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
        assert!(corners(&both).is_ok());
        // the first two agree with the third in turn: the corner at fault is the last one
        let mixed = [
            layer(left, "pml"),
            layer(right, "pml-stretched"),
            layer(bottom, "pml"),
        ];
        assert!(corners(&mixed).is_err());
    }
}
