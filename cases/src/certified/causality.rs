//! How far away the far boundary must be, and until when nothing can have come back from it.
//!
//! The fastest way from a source by a far boundary back into the body: straight to it and straight
//! back, `d + 2 B` for a source at the distance d from the side and B of added material. It ends
//! anywhere in the body, so that series, energies and fields are all free of echo, and it is cut
//! short by [`CELLS_AHEAD`], since implicit schemes spread a little of everything ahead of the wave.

use crate::posed::{Posed, either};
use anechoic_solver::problem::{Drive, Problem, Side};

/// Cells that the discrete wave may run ahead of the true one: 10 left 1e-5 of the echoes to the far
/// boundary, see the floors of the stored references.
const CELLS_AHEAD: f64 = 25.0;

/// The method of sides that end far away.
pub const EXTENDED: &str = "extended";

/// [`with_buffers`] in either number of dimensions.
pub fn buffered(problem: &Posed, factor: f64) -> Posed {
    either!(problem, problem => with_buffers(problem, factor).into())
}

/// The problem with as much material behind each extended side as its end needs, stretched by
/// `factor`; a side that states its thickness keeps it.
pub fn with_buffers<const D: usize>(problem: &Problem<D>, factor: f64) -> Problem<D> {
    let mut extended = problem.clone();
    for (axis, pair) in extended.sides.iter_mut().enumerate() {
        for (end, method) in pair.iter_mut().enumerate() {
            if method.method == EXTENDED && method.given_number("thickness_m").is_none() {
                let side = Side {
                    axis,
                    upper: end == 1,
                };
                let thickness = factor * needed(problem, side);
                let h = problem.cell_size;
                *method = method
                    .clone()
                    .with("thickness_m", (thickness / h).ceil() * h);
            }
        }
    }
    extended
}

/// Until when (s) nothing can have come back into the body; `None` where no side is extended by a
/// stated thickness.
pub fn serves_until<const D: usize>(problem: &Problem<D>) -> Option<f64> {
    let margin = CELLS_AHEAD * problem.cell_size;
    let path = |side: Side| {
        let method = &problem.sides[side.axis][usize::from(side.upper)];
        let thickness = method.given_number("thickness_m");
        let thickness = thickness.filter(|_| method.method == EXTENDED)?;
        Some(distance(problem, side) + 2.0 * thickness - margin)
    };
    let shortest = sides::<D>().filter_map(path).reduce(f64::min)?;
    Some(shortest / problem.material.p_speed())
}

/// Added material (m) that lets a side serve until the end of the problem.
fn needed<const D: usize>(problem: &Problem<D>, side: Side) -> f64 {
    let reach = problem.material.p_speed() * problem.last_time();
    let margin = CELLS_AHEAD * problem.cell_size;
    // At least the margin, also where the wave hardly gets out of the body.
    (0.5 * (reach + margin - distance(problem, side))).max(margin)
}

/// All sides of a box, axis by axis, the lower end first.
pub(super) fn sides<const D: usize>() -> impl Iterator<Item = Side> {
    (0..2 * D).map(|k| Side {
        axis: k / 2,
        upper: k % 2 == 1,
    })
}

/// Distance (m) of the nearest source from a side of the body; none through an inclusion that is faster
/// than the material around it, which may have shortened the way.
fn distance<const D: usize>(problem: &Problem<D>, side: Side) -> f64 {
    if problem.inclusion.is_some_and(|ratio| ratio > 1.0) {
        return 0.0;
    }
    let target = &problem.target;
    let (lower, upper) = (target.lower[side.axis], target.upper[side.axis]);
    let from = |at: f64| if side.upper { upper - at } else { at - lower };
    let of_drive = |drive: &Drive<D>| match drive {
        Drive::PointForce { place, .. } => from(place[side.axis]),
        Drive::SideVelocity { side: driven, .. } if driven.axis == side.axis => {
            from(if driven.upper { upper } else { lower })
        }
        // A driven side that meets this one at a corner.
        Drive::SideVelocity { .. } => 0.0,
    };
    problem
        .drives
        .iter()
        .map(of_drive)
        .fold(upper - lower, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::scenes::point_source::PointSource;

    fn problem() -> Problem<2> {
        PointSource::default().extended().unwrap().plane().unwrap()
    }

    #[test]
    fn buffers_are_whole_cells_and_serve_to_the_end() {
        let problem = with_buffers(&problem(), 1.0);
        let until = serves_until(&problem).unwrap();
        // Less than two cells' way more than asked for.
        let slack = 2.0 * problem.cell_size / problem.material.p_speed();
        assert!(
            until >= problem.end_time && until < problem.end_time + 1.01 * slack,
            "{until}"
        );
        for method in [
            &problem.sides[0][0],
            &problem.sides[0][1],
            &problem.sides[1][0],
        ] {
            let thickness = method.given_number("thickness_m").unwrap();
            assert_eq!(thickness % problem.cell_size, 0.0);
        }
        // The source is 120 m from the left side and 1880 m from the right one.
        let thickness = |side: usize| problem.sides[0][side].given_number("thickness_m").unwrap();
        assert!(thickness(0) > thickness(1) + 860.0);
    }

    #[test]
    fn a_run_that_goes_past_its_end_is_served_to_its_last_step() {
        let mut problem = problem();
        (problem.dt, problem.end_time) = (0.3, 10.0);
        assert!((problem.last_time() - 10.2).abs() < 1e-12);
        let until = serves_until(&with_buffers(&problem, 1.0)).unwrap();
        assert!(until >= problem.last_time(), "{until}");
    }

    #[test]
    fn the_nearest_far_side_decides() {
        let mut problem = with_buffers(&problem(), 1.0);
        problem.sides[1][0] = problem.sides[1][0].clone().with("thickness_m", 1000.0);
        let until = serves_until(&problem).unwrap();
        let way = 2000.0 + 2.0 * 1000.0 - 25.0 * 20.0;
        assert!((until - way / problem.material.p_speed()).abs() < 1e-12);
    }

    #[test]
    fn without_a_far_side_there_is_no_certificate() {
        assert_eq!(serves_until(&PointSource::default().problem()), None);
        // Without its thickness nobody knows how far away it is.
        assert_eq!(serves_until(&problem()), None);
    }
}
