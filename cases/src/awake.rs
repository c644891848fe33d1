//! How much of a mesh waves have reached: the share of cell-steps that a solver would work on whose
//! cells sleep until then. It is counted, not timed: no such solver is here.

use anechoic_solver::error::SolverError;
use anechoic_solver::geometry::fitted_cell;
use anechoic_solver::material_box;
use anechoic_solver::problem::{Drive, Problem};

/// Implicit schemes spread a little of everything some cells ahead of the wave.
const CELLS_AHEAD: f64 = 10.0;

/// The share of a problem's cell-steps in cells that the fastest wave has reached or is about to.
///
/// # Errors
/// [`SolverError::Setup`] for a problem that cannot be laid out.
pub fn awake_share(problem: &Problem<2>) -> Result<f64, SolverError> {
    let (all, h) = (
        material_box(problem)?,
        fitted_cell(&problem.target, problem.edges()),
    );
    let count = |axis: usize| ((all.upper[axis] - all.lower[axis]) / h[axis]).round() as usize;
    let ahead = CELLS_AHEAD * h[0].max(h[1]);
    let (speed, end) = (problem.material.p_speed(), problem.last_time());
    let (columns, rows) = (count(0), count(1));
    let mut awake = 0.0;
    for row in 0..rows {
        for column in 0..columns {
            let place = [
                all.lower[0] + (column as f64 + 0.5) * h[0],
                all.lower[1] + (row as f64 + 0.5) * h[1],
            ];
            let away = problem
                .drives
                .iter()
                .map(|drive| distance(drive, problem, place));
            let away = (away.fold(f64::INFINITY, f64::min) - ahead).max(0.0);
            awake += (1.0 - away / speed / end).max(0.0);
        }
    }
    Ok(awake / (columns * rows) as f64)
}

/// From what drives to a place (m).
fn distance(drive: &Drive<2>, problem: &Problem<2>, place: [f64; 2]) -> f64 {
    match drive {
        Drive::PointForce { place: from, .. } => (place[0] - from[0]).hypot(place[1] - from[1]),
        Drive::SideVelocity { side, .. } => {
            let target = &problem.target;
            let plane = if side.upper {
                target.upper
            } else {
                target.lower
            };
            (place[side.axis] - plane[side.axis]).abs()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::prepare::{Request, Target};

    fn share(case: &str, sets: &[&str]) -> f64 {
        let request = Request {
            target: case.into(),
            sets: sets.iter().map(|s| (*s).to_owned()).collect(),
            ..Request::default()
        };
        let scene = Target::find(&request)
            .unwrap()
            .prepare(Some("extended"))
            .unwrap();
        awake_share(&scene.scene.problem()).unwrap()
    }

    #[test]
    fn a_short_run_wakes_less_than_a_long_one() {
        let short = share(
            "point-source",
            &["extended.thickness_m=5500", "time.end_s=2", "t1_s=1"],
        );
        let long = share("point-source", &["extended.thickness_m=5500"]);
        assert!(short < 0.5 * long && long < 1.0, "{short}, {long}");
    }
}
