//! How much of a mesh waves have reached: the share of cell-steps that a solver would work on whose
//! cells sleep until then. It is counted, not timed: no such solver is here.

use crate::posed::{Posed, either};
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
pub fn awake_share(posed: &Posed) -> Result<f64, SolverError> {
    either!(posed, problem => share(problem))
}

fn share<const D: usize>(problem: &Problem<D>) -> Result<f64, SolverError> {
    let (all, h) = (
        material_box(problem)?,
        fitted_cell(&problem.target, problem.edges()),
    );
    let counts: [usize; D] =
        std::array::from_fn(|a| ((all.upper[a] - all.lower[a]) / h[a]).round() as usize);
    let ahead = CELLS_AHEAD * h.into_iter().fold(0.0, f64::max);
    let (speed, end) = (problem.stiffest().p_speed(), problem.last_time());
    let cells: usize = counts.iter().product();
    let mut awake = 0.0;
    for cell in 0..cells {
        let mut rest = cell;
        let place = std::array::from_fn(|a| {
            let along = rest % counts[a];
            rest /= counts[a];
            all.lower[a] + (along as f64 + 0.5) * h[a]
        });
        let away = problem
            .drives
            .iter()
            .map(|drive| distance(drive, problem, place));
        let away = (away.fold(f64::INFINITY, f64::min) - ahead).max(0.0);
        awake += (1.0 - away / speed / end).max(0.0);
    }
    Ok(awake / cells as f64)
}

/// From what drives to a place (m).
fn distance<const D: usize>(drive: &Drive<D>, problem: &Problem<D>, place: [f64; D]) -> f64 {
    match drive {
        Drive::PointForce { place: from, .. } => {
            let squares = place.iter().zip(from).map(|(a, b)| (a - b).powi(2));
            squares.sum::<f64>().sqrt()
        }
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
        awake_share(&scene.scene.posed()).unwrap()
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
