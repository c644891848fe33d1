//! Gates of a body of two stiffnesses, up to a contrast of a million. Analytic: waves in a column whose
//! middle third has another stiffness, by the coefficients of its two interfaces.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::probe::Receiver;
use anechoic_solver::problem::{Aabb, Problem, Scheme, SolverKind};
use anechoic_tests::{Unwatched, column, solved};

/// Height of the column (m), a third of it above the inclusion.
const HEIGHT: f64 = 48.0;
/// In an inclusion of less impedance than this the pulse's 31 m are shorter than the cells.
const UNRESOLVED: f64 = 0.02;
/// Longest way that is summed, in multiples of the inclusion's own.
const MOST_ECHOES: usize = 100_000;

/// The column on cells of `h` (m), one wide, over a dashpot, with an inclusion `ratio` times as stiff.
fn problem(h: f64, ratio: f64) -> Problem<2> {
    let mut problem = Problem {
        target: Aabb {
            lower: [0.0; 2],
            upper: [h, HEIGHT],
        },
        inclusion: Some(ratio),
        ..column(h, SideMethod::new("dashpot"))
    };
    problem.probes.receivers = vec![Receiver {
        name: "top".into(),
        place: [0.5 * h, HEIGHT],
    }];
    // the echo that the top sends down once more is back after that
    problem.end_time = 0.98 * 4.0 / 3.0 * HEIGHT / problem.material.p_speed();
    problem
}

/// Velocity of the top (m/s): with r = (1 - z)/(1 + z), z = sqrt(ratio), the upper interface returns
/// `r f(t - T)` and what has gone to and fro n times in the inclusion
/// `-(1 - r^2) r^(2n-1) f(t - T - n T2)`; the free top doubles what comes.
fn exact(problem: &Problem<2>, t: f64) -> f64 {
    let z = problem.inclusion.unwrap().sqrt();
    let r = (1.0 - z) / (1.0 + z);
    let mut way = 2.0 / 3.0 * HEIGHT / problem.material.p_speed();
    if z < UNRESOLVED {
        // the half cell of mass at the interface rides along: the column ends so much lower
        way += problem.cell_size / problem.material.p_speed();
    }
    let pulse = match &problem.drives[0] {
        anechoic_solver::problem::Drive::SideVelocity { pulse, .. } => *pulse,
        anechoic_solver::problem::Drive::PointForce { .. } => unreachable!("the top is driven"),
    };
    let f = |t: f64| if t > 0.0 { pulse.value(t) } else { 0.0 };
    let inside = |n: usize| {
        let late = t - way - n as f64 * way / z;
        (late > 0.0).then(|| -(1.0 - r * r) * r.powi(2 * n as i32 - 1) * f(late))
    };
    let echoes: f64 = (1..MOST_ECHOES).map_while(inside).sum();
    f(t) + 2.0 * (r * f(t - way) + echoes)
}

/// Times (s) and the top's velocity (m/s).
fn top(problem: &Problem<2>) -> (Vec<f64>, Vec<f64>) {
    let receivers = solved(problem).receivers;
    let top = receivers.column("top_vy").unwrap().to_vec();
    (receivers.times, top)
}

/// Root mean square of the top's error over that of its motion, once the drive has let go.
fn error(problem: &Problem<2>) -> f64 {
    let (times, top) = top(problem);
    let (mut off, mut all) = (0.0, 0.0);
    for (t, v) in times.iter().zip(&top) {
        if *t > 0.5 {
            let exact = exact(problem, *t);
            off += (v - exact).powi(2);
            all += exact.powi(2);
        }
    }
    (off / all).sqrt()
}

#[test]
fn waves_come_back_from_an_inclusion_as_from_its_two_interfaces() {
    for (ratio, bound) in [
        (1e-6, 0.01),
        (1e-2, 0.02),
        (0.25, 0.01),
        (4.0, 0.01),
        (1e2, 0.01),
        (1e6, 0.01),
    ] {
        let [coarse, fine] = [1.0, 0.5].map(|h| error(&problem(h, ratio)));
        let order = (coarse / fine).log2();
        println!("contrast {ratio:e}: {coarse:.4}, {fine:.4}, order {order:.2}");
        assert!(fine < bound, "contrast {ratio}: {fine}");
        assert!((1.5..2.5).contains(&order), "contrast {ratio}: {order}");
    }
}

/// The linear solvers agree where the matrix is worst: neither answers wrongly.
#[test]
fn a_contrast_of_a_million_has_one_answer() {
    for ratio in [1e-6, 1e6] {
        let by = |solver| {
            let problem = problem(1.0, ratio);
            top(&Problem { solver, ..problem }).1
        };
        let (cg, direct) = (by(SolverKind::Cg), by(SolverKind::Direct));
        let apart = cg.iter().zip(&direct).map(|(a, b)| (a - b).abs());
        let apart = apart.fold(0.0, f64::max) / 1e-3;
        println!("contrast {ratio:e}: the solvers differ by {apart:.1e} of the pulse");
        assert!(apart < 1e-8, "contrast {ratio}: {apart}");
    }
}

#[test]
fn what_knows_one_stiffness_refuses_two() {
    let explicit = Problem {
        scheme: Scheme::Explicit,
        dt: 1e-3,
        ..problem(1.0, 10.0)
    };
    let mut touched = problem(1.0, 10.0);
    touched.target.upper[1] = 2.0;
    touched.probes.receivers.clear();
    let negative = problem(1.0, -1.0);
    for (wrong, says) in [
        (explicit, "explicit steps"),
        (touched, "bottom"),
        (negative, "not positive"),
    ] {
        let error = anechoic_solver::solve(&wrong, &Unwatched).unwrap_err();
        let text = error.to_string();
        assert!(text.contains("material.inclusion"), "{text}");
        assert!(text.contains(says), "{text}");
    }
}
