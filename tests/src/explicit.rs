//! Problems in explicit steps.

use anechoic_solver::contact::Contact;
use anechoic_solver::contact::body::{Motion, RigidBody};
use anechoic_solver::contact::shape::Shape;
use anechoic_solver::linear::Moment;
use anechoic_solver::problem::{
    BasisKind, Intruder, PointMode, Problem, Scheme, StressUpdate, Transfer,
};
use anechoic_solver::setup;
use anechoic_solver::tensor::Vector;
use anechoic_solver::time::System;

/// Bases and stress updates of flowing points.
pub const FLOWS: [(BasisKind, StressUpdate); 6] = [
    (BasisKind::Linear, StressUpdate::Usl),
    (BasisKind::Linear, StressUpdate::Musl),
    (BasisKind::Gimp, StressUpdate::Usl),
    (BasisKind::Gimp, StressUpdate::Musl),
    (BasisKind::Bspline, StressUpdate::Usl),
    (BasisKind::Bspline, StressUpdate::Musl),
];

/// The problem in leapfrog steps of `courant` times the time (s) of the fastest wave through a cell.
pub fn leapfrog(problem: Problem<2>, courant: f64) -> Problem<2> {
    Problem {
        scheme: Scheme::Explicit,
        dt: courant * problem.cell_size / problem.material.p_speed(),
        ..problem
    }
}

/// The problem in leapfrog steps with points that move.
pub fn flowing(
    problem: Problem<2>,
    courant: f64,
    (basis, update): (BasisKind, StressUpdate),
    transfer: Transfer,
) -> Problem<2> {
    let mut problem = leapfrog(problem, courant);
    problem.basis = basis;
    problem.point_mode = PointMode::Moving;
    problem.transfer = transfer;
    problem.flow.update = update;
    problem
}

/// A `plate` over a column, its face at `height` (m), that moves along y at `velocity` (m/s) and touches nodes
/// within `reach` cells.
pub fn plate(height: f64, velocity: f64, reach: f64) -> Intruder {
    Intruder {
        name: "plate".to_owned(),
        body: RigidBody {
            shape: Shape::HalfPlane {
                place: [0.0, height],
                normal: [0.0, -1.0],
            },
            motion: Motion {
                velocity: [0.0, velocity],
                rise: 0.0,
            },
        },
        contact: Contact {
            friction: 0.0,
            reach,
        },
    }
}

/// The longest stable step (s) of leapfrog on an elastic problem with nodes that keep the motion: 2/w,
/// w the largest frequency of the mesh (Courant, Friedrichs & Lewy 1928), by power iteration.
///
/// # Panics
/// When the problem cannot be set up.
pub fn longest_step(problem: &Problem<2>) -> f64 {
    let mut model = setup::model(problem).expect("the problem is well put");
    let moment = Moment {
        step: 1,
        time_s: problem.dt,
    };
    let begun = model.begin_step([0.0, problem.dt], moment);
    begun.expect("points lie on the grid");
    // follows no pattern of the mesh, so that no mode is left out
    let mut mode: Vec<Vector<2>> = (0..model.grid.node_count())
        .map(|n| [(1.7 * n as f64).sin(), (2.3 * n as f64).cos()])
        .collect();
    model.impose(&mut mode);
    let mass = model.nodes.lumped.mass.clone();
    let product = |a: &[Vector<2>], b: &[Vector<2>]| -> f64 {
        let pairs = a.iter().zip(b).zip(&mass);
        pairs
            .map(|((a, b), m)| m[0] * a[0] * b[0] + m[1] * a[1] * b[1])
            .sum()
    };
    let mut square = 0.0;
    for _ in 0..4000 {
        let size = product(&mode, &mode).sqrt();
        for (u, x) in model.nodes.u.iter_mut().zip(&mode) {
            *u = x.map(|x| x / size);
        }
        model.accelerate().expect("accelerations are finite");
        for (x, a) in mode.iter_mut().zip(model.motion().a) {
            *x = a.map(|a| -a);
        }
        square = product(&model.nodes.u, &mode);
    }
    2.0 / square.sqrt()
}
