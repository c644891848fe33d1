//! Gates of the solver's core: patch tests, rigid motion, balances, tangent, reflection.
//!
//! Every gate is analytic: the exact value follows from mechanics, the bound from rounding or from
//! the order of the scheme.

#![allow(
    clippy::unwrap_used,
    reason = "a gate that cannot be set up has failed"
)]

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::linear::Moment;
use anechoic_solver::physics::model::Model;
use anechoic_solver::problem::{PointMode, Problem, Scheme, SolverKind, Transfer};
use anechoic_solver::setup;
use anechoic_solver::tensor::Vector;
use anechoic_solver::time::newmark::Newmark;
use anechoic_solver::time::{ForceScale, Integrator, Motion, Rates, System};
use anechoic_tests::{block, column, solved};

const MOMENT: Moment = Moment {
    step: 1,
    time_s: 0.02,
};

/// A field of deformation that bends, stretches and turns.
fn linear_field(x: &Vector<2>) -> Vector<2> {
    [
        0.01 + 0.02 * x[0] - 0.03 * x[1],
        -0.02 + 0.015 * x[0] + 0.01 * x[1],
    ]
}

/// Forces on the nodes for a displacement of the step, without motion.
fn force_at_rest(model: &mut Model<2>, increment: &[Vector<2>]) -> Vec<Vector<2>> {
    let rest = vec![[0.0; 2]; increment.len()];
    let mut force = rest.clone();
    let trial = Motion {
        increment,
        v: &rest,
        a: &rest,
    };
    model.residual(&trial, &mut force).unwrap();
    force
}

fn nodal(model: &Model<2>, field: impl Fn(&Vector<2>) -> Vector<2>) -> Vec<Vector<2>> {
    (0..model.grid.node_count())
        .map(|n| field(&model.grid.node_place(n)))
        .collect()
}

/// Largest out-of-balance force on nodes inside the block, over the largest on its edge, under a
/// linear displacement: zero when constant stress is in equilibrium.
fn patch_residual(problem: &Problem<2>, distort: f64) -> f64 {
    let mut model = setup::model(problem).unwrap();
    for (k, x) in model.points.place.iter_mut().enumerate() {
        x[0] += distort * (1.3 * k as f64).sin();
        x[1] += distort * (2.1 * k as f64).cos();
    }
    let places = model.points.place.clone();
    model.disc.place(&places).unwrap();
    model.begin_step([0.0, 0.02], MOMENT).unwrap();
    let increment = nodal(&model, linear_field);
    let force = force_at_rest(&mut model, &increment);
    let (mut inner, mut edge) = (0.0_f64, 0.0_f64);
    for (n, f) in force.iter().enumerate() {
        let x = model.grid.node_place(n);
        let inside = x[0] > 0.1 && x[0] < 3.9 && x[1] > 0.1 && x[1] < 2.9;
        let size = f[0].abs().max(f[1].abs());
        if inside {
            inner = inner.max(size)
        } else {
            edge = edge.max(size)
        }
    }
    inner / edge
}

#[test]
fn constant_stress_is_in_equilibrium_on_a_regular_cloud() {
    for points_per_cell in [1, 4, 9] {
        let problem = Problem {
            points_per_cell,
            ..block(Transfer::Affine, PointMode::Frozen)
        };
        assert!(patch_residual(&problem, 0.0) < 1e-10);
    }
}

#[test]
fn a_distorted_cloud_shows_its_quadrature_error() {
    let problem = block(Transfer::Affine, PointMode::Frozen);
    let residual = patch_residual(&problem, 0.03);
    println!(
        "patch test on a cloud distorted by 0.06 h: residual {residual:.4} of the edge forces"
    );
    // one-point quadrature with displaced points integrates gradients only to the order of the shift
    assert!(residual > 1e-4 && residual < 0.2);
}

#[test]
fn a_rigid_translation_carries_on_for_ever() {
    for (mode, transfer) in [
        (PointMode::Moving, Transfer::Flip),
        (PointMode::Moving, Transfer::Affine),
        (PointMode::Frozen, Transfer::Affine),
    ] {
        let mut model = setup::model(&block(transfer, mode)).unwrap();
        let motion = model.points.motion.as_mut().unwrap();
        motion.v.fill([0.3, -0.2]);
        let start = model.points.place.clone();
        let mut newmark = Newmark::new(model.grid.node_count());
        for step in 0..50 {
            let times = [0.02 * f64::from(step), 0.02 * f64::from(step + 1)];
            newmark.step(&mut model, times, MOMENT).unwrap();
        }
        assert!(model.strain_energy(false) < 1e-20);
        let moved = if mode == PointMode::Moving {
            [0.3, -0.2]
        } else {
            [0.0, 0.0]
        };
        for (x, x0) in model.points.place.iter().zip(&start) {
            assert!((x[0] - x0[0] - moved[0]).abs() < 1e-10);
            assert!((x[1] - x0[1] - moved[1]).abs() < 1e-10);
        }
    }
}

#[test]
fn a_finite_rotation_strains_nothing() {
    let mut model = setup::model(&block(Transfer::Affine, PointMode::Moving)).unwrap();
    model.begin_step([0.0, 0.02], MOMENT).unwrap();
    let (c, s) = (0.3_f64.cos(), 0.3_f64.sin());
    let increment = nodal(&model, |x| {
        [(c - 1.0) * x[0] - s * x[1], s * x[0] + (c - 1.0) * x[1]]
    });
    let force = force_at_rest(&mut model, &increment);
    let largest = force
        .as_flattened()
        .iter()
        .fold(0.0_f64, |m, f| m.max(f.abs()));
    assert!(largest < 1e-12, "{largest}");
}

#[test]
fn the_tangent_is_the_derivative_of_the_residual() {
    // inertia, stress from an earlier step and a dashpot, so that every part of the tangent counts
    let mut problem = block(Transfer::Affine, PointMode::Moving);
    problem.sides[0][0] = SideMethod::new("dashpot");
    problem.sides[1][0] = SideMethod::new("damping-layer")
        .with("thickness_m", 1.0)
        .with_choice("placement", "inside")
        .with_choice("end", "free");
    let mut model = setup::model(&problem).unwrap();
    let rates = Rates {
        mass: 1e4,
        viscous: 1e2,
    };
    model.begin_step([0.0, 0.02], MOMENT).unwrap();
    let first = nodal(&model, |x| [1e-3 * x[1], 2e-3 * (x[0] - x[1])]);
    let rest = vec![[0.0; 2]; first.len()];
    let accepted = Motion {
        increment: &first,
        v: &rest,
        a: &rest,
    };
    model.residual(&accepted, &mut rest.clone()).unwrap();
    model.commit(&accepted).unwrap();
    model.begin_step([0.02, 0.04], MOMENT).unwrap();
    let n = rest.len();
    let base = nodal(&model, |x| [1e-3 * x[0].sin(), 1e-3 * x[1].cos()]);
    let mut force_of = |increment: &[Vector<2>]| {
        let v: Vec<Vector<2>> = increment
            .iter()
            .map(|d| d.map(|d| rates.viscous * d))
            .collect();
        let a: Vec<Vector<2>> = increment
            .iter()
            .map(|d| d.map(|d| rates.mass * d))
            .collect();
        let mut out = vec![[0.0; 2]; n];
        model
            .residual(
                &Motion {
                    increment,
                    v: &v,
                    a: &a,
                },
                &mut out,
            )
            .unwrap();
        out
    };
    let direction: Vec<Vector<2>> = (0..n)
        .map(|k| [(0.7 * k as f64).sin(), (1.1 * k as f64).cos()])
        .collect();
    let shifted = |s: f64| -> Vec<Vector<2>> {
        base.iter()
            .zip(&direction)
            .map(|(b, d)| [b[0] + s * d[0], b[1] + s * d[1]])
            .collect()
    };
    let step = 1e-7;
    let (up, down) = (force_of(&shifted(step)), force_of(&shifted(-step)));
    // K d = r solved for r = the differences must give the direction back
    let difference: Vec<Vector<2>> = up
        .iter()
        .zip(&down)
        .map(|(u, d)| [(d[0] - u[0]) / (2.0 * step), (d[1] - u[1]) / (2.0 * step)])
        .collect();
    let mut back = vec![[0.0; 2]; n];
    let scale = difference
        .as_flattened()
        .iter()
        .map(|f| f * f)
        .sum::<f64>()
        .sqrt();
    let scale = ForceScale {
        largest: scale,
        rounding: 0.0,
    };
    model
        .solve(rates, &base, &difference, scale, &mut back)
        .unwrap();
    for ((b, d), active) in back.iter().zip(&direction).zip(&model.nodes.active) {
        if *active {
            assert!(
                (b[0] - d[0]).abs() < 1e-6 && (b[1] - d[1]).abs() < 1e-6,
                "{b:?} {d:?}"
            );
        }
    }
}

/// A ringing block without walls: initial velocities that bend and stretch it.
fn ringing(problem: &Problem<2>, steps: usize) -> (Model<2>, f64, f64) {
    let mut model = setup::model(problem).unwrap();
    let speed = |x: &Vector<2>| [0.01 * (x[1] - 1.5), 0.01 * (0.9 * x[0]).sin()];
    match model.points.motion.as_mut() {
        Some(motion) => {
            motion.v = model.points.place.iter().map(speed).collect();
            if let Some(l) = motion.gradients.as_mut() {
                l.v = model
                    .points
                    .place
                    .iter()
                    .map(|x| [[0.0, 0.01], [0.009 * (0.9 * x[0]).cos(), 0.0]])
                    .collect();
            }
        }
        None => model.nodes.v = nodal(&model, speed),
    }
    let energy = |m: &Model<2>| m.kinetic_energy(false) + m.strain_energy(false);
    let first = energy(&model);
    let mut newmark = Newmark::new(model.grid.node_count());
    for step in 0..steps {
        let times = [problem.dt * step as f64, problem.dt * (step + 1) as f64];
        newmark.step(&mut model, times, MOMENT).unwrap();
    }
    let last = energy(&model);
    (model, first, last)
}

#[test]
fn frozen_newmark_keeps_the_energy() {
    let (_, first, last) = ringing(&block(Transfer::Keep, PointMode::Frozen), 500);
    assert!(((last - first) / first).abs() < 1e-10, "{first} {last}");
}

#[test]
fn momentum_is_kept_by_every_transfer() {
    for (mode, transfer) in [
        (PointMode::Frozen, Transfer::Keep),
        (PointMode::Moving, Transfer::Flip),
        (PointMode::Moving, Transfer::Affine),
        (PointMode::Moving, Transfer::Pic),
    ] {
        let problem = block(transfer, mode);
        let (start, ..) = ringing(&problem, 0);
        let (end, ..) = ringing(&problem, 100);
        let (before, after) = (start.momentum(), end.momentum());
        let scale = 24.0 * 0.01;
        for i in 0..2 {
            assert!(
                (before[i] - after[i]).abs() < 1e-9 * scale,
                "{transfer:?} {before:?} {after:?}"
            );
        }
    }
}

#[test]
fn no_transfer_feeds_energy_into_a_closed_block() {
    // pic is the most dissipative by far: its loss must show
    let loss = |transfer| {
        let (_, first, last) = ringing(&block(transfer, PointMode::Moving), 200);
        (first - last) / first
    };
    let (affine, flip, pic) = (
        loss(Transfer::Affine),
        loss(Transfer::Flip),
        loss(Transfer::Pic),
    );
    println!("energy lost over 4 s: affine {affine:.2e}, flip {flip:.2e}, pic {pic:.2e}");
    assert!(affine > -1e-6 && affine < 0.05);
    assert!(flip > -1e-6 && flip < 0.5);
    assert!(pic > 2.0 * affine.max(flip));
}

#[test]
fn a_dashpot_reflects_by_the_ratio_of_impedances() {
    // analytic: R = (1 - a)/(1 + a); the echo at the free top is doubled. 1 % of the pulse is what
    // the mesh itself disperses at h = 1 m.
    for share in [0.0, 0.5, 1.0, 2.0] {
        let record = solved(&column(
            1.0,
            SideMethod::new("dashpot").with("impedance", share),
        ));
        let v = record.receivers.column("A_vy").unwrap();
        let after = record
            .receivers
            .times
            .iter()
            .position(|t| *t > 1.6)
            .unwrap();
        let echo = v[after..]
            .iter()
            .fold(0.0_f64, |m, x| if x.abs() > m.abs() { *x } else { m });
        let measured = echo / (2.0 * -1e-3);
        let exact = (1.0 - share) / (1.0 + share);
        println!("impedance ratio {share}: reflection {measured:.4}, exact {exact:.4}");
        assert!((measured - exact).abs() < 0.01);
    }
}

#[test]
fn quasi_static_compression_is_uniform() {
    let mut problem = column(1.0, SideMethod::new("roller"));
    problem.scheme = Scheme::QuasiStatic;
    problem.end_time = 0.25;
    let record = solved(&problem);
    let u = record.receivers.column("A_uy").unwrap();
    // half of the pulse's area: 1e-3 * 0.25 / 2, trapezoidal rule of the steps
    assert!((u.last().unwrap() + 1.25e-4).abs() < 1e-8);
    let modulus = problem.material.density * problem.material.p_speed().powi(2);
    let strain: f64 = u.last().unwrap() / 50.0;
    let energy = 0.5 * modulus * strain * strain * 4.0 * 50.0;
    let strained = record.energy.column("strain").unwrap();
    assert!((strained.last().unwrap() / energy - 1.0).abs() < 1e-8);
}

#[test]
fn direct_and_iterative_solvers_agree() {
    let with = |solver| {
        let mut problem = column(1.0, SideMethod::new("dashpot"));
        (problem.solver, problem.rel_tol, problem.end_time) = (solver, 1e-13, 1.0);
        solved(&problem).receivers
    };
    let (cg, direct) = (with(SolverKind::Cg), with(SolverKind::Direct));
    for (a, b) in cg
        .column("A_vy")
        .unwrap()
        .iter()
        .zip(direct.column("A_vy").unwrap())
    {
        assert!((a - b).abs() < 1e-12);
    }
}

#[test]
fn a_large_step_changes_over_to_the_factorisation() {
    let mut problem = column(0.5, SideMethod::new("roller"));
    (problem.dt, problem.end_time) = (0.5, 5.0);
    let record = solved(&problem);
    assert!(
        record.cost.linear_solver.starts_with("Cholesky"),
        "{}",
        record.cost.linear_solver
    );
}
