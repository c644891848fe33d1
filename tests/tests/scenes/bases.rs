//! Gates of the bases and of consistent masses: balances, dispersion, cells' faces, surfaces, layers.
//!
//! Analytic unless said: exact values follow from mechanics or from the functions' own symbols, bounds
//! from rounding or from the next order. The layers' gate is certified (an extended run of the same
//! scheme), the crossing of cells a comparison of bases.

#![allow(
    clippy::unwrap_used,
    reason = "a gate that cannot be set up has failed"
)]
#![allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN must not pass")]

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::linear::Moment;
use anechoic_solver::physics::model::Model;
use anechoic_solver::problem::BasisKind::{self, Bspline, Gimp, Linear};
use anechoic_solver::problem::MassKind::{self, Consistent, Lumped};
use anechoic_solver::problem::{PointMode, Problem, Transfer};
use anechoic_solver::setup;
use anechoic_solver::tensor::Vector;
use anechoic_solver::time::newmark::Newmark;
use anechoic_solver::time::{Integrator, Motion, System};
use anechoic_tests::{KINDS, block, half_space, solved, worst_echo};

const MOMENT: Moment = Moment {
    step: 1,
    time_s: 0.02,
};

fn with(problem: Problem<2>, (basis, mass): (BasisKind, MassKind)) -> Problem<2> {
    Problem {
        basis,
        mass,
        ..problem
    }
}

fn moving(kind: (BasisKind, MassKind)) -> Problem<2> {
    with(block(Transfer::Affine, PointMode::Moving), kind)
}

fn nodal(model: &Model<2>, field: impl Fn(&Vector<2>) -> Vector<2>) -> Vec<Vector<2>> {
    (0..model.grid.node_count())
        .map(|n| field(&model.grid.node_place(n)))
        .collect()
}

/// Out-of-balance force of a state.
fn residual(model: &mut Model<2>, increment: &[Vector<2>], a: &[Vector<2>]) -> Vec<Vector<2>> {
    let rest = vec![[0.0; 2]; increment.len()];
    let mut out = rest.clone();
    let trial = Motion {
        increment,
        v: &rest,
        a,
    };
    model.residual(&trial, &mut out).unwrap();
    out
}

fn energy(model: &Model<2>) -> f64 {
    model.kinetic_energy(false) + model.strain_energy(false)
}

fn advance(model: &mut Model<2>, dt: f64, steps: usize, mut each: impl FnMut(&Model<2>)) {
    let mut newmark = Newmark::new(model.grid.node_count());
    for step in 0..steps {
        let times = [step, step + 1].map(|n| dt * n as f64);
        newmark.step(model, times, MOMENT).unwrap();
        each(model);
    }
}

#[test]
fn constant_stress_is_in_equilibrium_inside() {
    for kind in KINDS {
        let problem = with(block(Transfer::Keep, PointMode::Frozen), kind);
        let mut model = setup::model(&problem).unwrap();
        model.begin_step([0.0, 0.02], MOMENT).unwrap();
        let stretch = nodal(&model, |x| [0.02 * x[0] - 0.03 * x[1], 0.015 * x[0]]);
        let rest = vec![[0.0; 2]; stretch.len()];
        let force = residual(&mut model, &stretch, &rest);
        for (n, f) in force.iter().enumerate() {
            let x = model.grid.node_place(n);
            if x[0] > 0.1 && x[0] < 3.9 && x[1] > 0.1 && x[1] < 2.9 {
                assert!(f[0].hypot(f[1]) < 1e-12, "{kind:?} {x:?} {f:?}");
            }
        }
    }
}

/// Square of the frequency of a plane wave of wave number `k` along x, over that of the material, by
/// the forces on a node inside: `K u / (M u) / (c k)^2`.
fn squared_frequency(kind: (BasisKind, MassKind), k: f64) -> f64 {
    let mut problem = with(block(Transfer::Keep, PointMode::Frozen), kind);
    problem.material.poissons_ratio = 0.0;
    let mut model = setup::model(&problem).unwrap();
    model.begin_step([0.0, 0.02], MOMENT).unwrap();
    // a crest at the middle, where the node is
    let wave = nodal(&model, |x| [(k * (x[0] - 2.0)).cos(), 0.0]);
    let rest = vec![[0.0; 2]; wave.len()];
    let middle = model.grid.node([4, 3]);
    let stiff = residual(&mut model, &wave, &rest)[middle][0];
    let inert = residual(&mut model, &rest, &wave)[middle][0];
    stiff / inert / (problem.material.p_speed() * k).powi(2)
}

#[test]
fn waves_are_as_slow_as_the_functions_make_them() {
    // (kh)^2 coefficients of the symbols: linear functions sampled at any points have the stiffness
    // (2 - 2 cos kh)/h^2; quadratic B-splines are a box convolved twice more, 1 - (kh)^2/4 each of
    // stiffness and consistent mass, so that only the next order is left
    let kh = 0.4;
    for (kind, expected) in [
        ((Linear, Lumped), -1.0 / 12.0),
        ((Gimp, Lumped), -1.0 / 12.0),
        ((Bspline, Lumped), -1.0 / 4.0),
        ((Bspline, Consistent), 0.0),
    ] {
        let error = squared_frequency(kind, kh / 0.5) - 1.0;
        let coefficient = error / (kh * kh);
        println!("{kind:?}: squared frequency off by {coefficient:.4} (kh)^2");
        assert!((coefficient - expected).abs() < 0.2 * kh * kh, "{kind:?}");
    }
}

/// Gives the block a motion that bends and stretches it, on top of `drift`.
fn ring(model: &mut Model<2>, drift: Vector<2>) {
    let speed = |x: &Vector<2>| {
        [
            drift[0] + 0.01 * (x[1] - 1.5),
            drift[1] + 0.01 * (0.9 * x[0]).sin(),
        ]
    };
    match model.points.motion.as_mut() {
        Some(motion) => {
            let places = model.points.place.iter();
            motion.v = places.clone().map(speed).collect();
            if let Some(l) = motion.gradients.as_mut() {
                let gradient = |x: &Vector<2>| [[0.0, 0.01], [0.009 * (0.9 * x[0]).cos(), 0.0]];
                l.v = places.map(gradient).collect();
            }
        }
        None => model.nodes.v = nodal(model, speed),
    }
}

#[test]
fn frozen_newmark_keeps_the_energy_of_every_basis() {
    for kind in KINDS {
        let problem = with(block(Transfer::Keep, PointMode::Frozen), kind);
        let mut model = setup::model(&problem).unwrap();
        ring(&mut model, [0.0; 2]);
        let first = energy(&model);
        advance(&mut model, problem.dt, 300, |_| {});
        let change = (energy(&model) - first) / first;
        assert!(change.abs() < 1e-10, "{kind:?}: {change:.1e}");
    }
}

#[test]
fn a_rigid_translation_crosses_cells_unharmed() {
    for kind in KINDS {
        let problem = moving(kind);
        let mut model = setup::model(&problem).unwrap();
        let motion = model.points.motion.as_mut().unwrap();
        motion.v.fill([0.3, -0.2]);
        let start = model.points.place.clone();
        advance(&mut model, 0.02, 50, |_| {});
        assert!(model.strain_energy(false) < 1e-20);
        for (x, x0) in model.points.place.iter().zip(&start) {
            let off = (x[0] - x0[0] - 0.3).hypot(x[1] - x0[1] + 0.2);
            assert!(off < 1e-9, "{kind:?}: {off:.1e} m");
        }
    }
}

#[test]
fn a_surface_just_above_a_cells_face_does_no_harm() {
    // The top row of points (linear) or its upper edge (gimp) stands a hair above a face, so that the
    // nodes beyond have next to no mass. Energy may leave by the transfer, not come; the block's motion
    // is that of the block a hair below, whose nodes beyond have none.
    for (kind, row) in [((Linear, Lumped), 0.25), ((Gimp, Lumped), 0.0)] {
        let problem = moving(kind);
        let run = |hair: f64| {
            let mut model = setup::model(&problem).unwrap();
            let lift = (row + hair) * 0.5;
            for x in &mut model.points.place {
                x[1] += lift;
            }
            let places = model.points.place.clone();
            model.disc.place(&places).unwrap();
            ring(&mut model, [0.0; 2]);
            let first = energy(&model);
            let mut most = 0.0_f64;
            advance(&mut model, problem.dt, 100, |m| most = most.max(energy(m)));
            // points' energy breathes by a few hundredths about its course
            assert!(
                most < first * 1.1,
                "{kind:?} {hair:.0e}: {most:.3e} of {first:.3e}"
            );
            model.points.place
        };
        let below = run(-1e-12);
        for hair in [1e-12, 1e-9, 1e-6, 1e-3] {
            let apart = run(hair)
                .iter()
                .zip(&below)
                .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1] - 0.5 * hair))
                .fold(0.0, f64::max);
            println!("{kind:?}: {hair:.0e} of a cell above a face: {apart:.1e} m apart");
            // the block bends by some 10 mm
            assert!(apart < 1e-3, "{kind:?}");
        }
    }
}

/// Energies of the ringing alone, that of the mean motion taken away, in a block that drifts.
fn ringing(basis: BasisKind, drift: f64) -> Vec<f64> {
    let problem = moving((basis, Lumped));
    let mut model = setup::model(&problem).unwrap();
    ring(&mut model, [drift, 0.0]);
    let mass: f64 = model.points.mass.iter().sum();
    let mut energies = Vec::new();
    advance(&mut model, problem.dt, 150, |m| {
        let p = m.momentum();
        energies.push(energy(m) - 0.5 * (p[0] * p[0] + p[1] * p[1]) / mass);
    });
    energies
}

#[test]
fn smooth_functions_cross_cells_with_less_harm() {
    // A drift changes nothing for an observer who drifts along, so the energy of the ringing is that of
    // the block at rest; here it drifts over a cell and a half.
    let harm = |basis| {
        let (still, drifting) = (ringing(basis, 0.0), ringing(basis, 0.25));
        let apart = still.iter().zip(&drifting).map(|(s, d)| (s - d).abs());
        apart.fold(0.0, f64::max) / still[0]
    };
    let [linear, gimp, bspline] = [Linear, Gimp, Bspline].map(harm);
    println!(
        "energy that crossing cells brings or takes: linear {linear:.4}, gimp {gimp:.4}, bspline {bspline:.4}"
    );
    assert!(gimp < 0.5 * linear && bspline < 0.5 * linear);
}

#[test]
fn ten_cells_of_true_layer_absorb_with_smooth_bases() {
    // the linear basis has its own gate; the bound is the same
    let pml = || {
        SideMethod::new("pml")
            .with("thickness_m", 200.0)
            .with("reflection", 1e-4)
    };
    for (kind, mode, transfer) in [
        ((Gimp, Lumped), PointMode::Moving, Transfer::Affine),
        ((Linear, Consistent), PointMode::Frozen, Transfer::Keep),
        ((Bspline, Consistent), PointMode::Frozen, Transfer::Keep),
        ((Bspline, Consistent), PointMode::Moving, Transfer::Affine),
    ] {
        let run = |side: SideMethod| {
            let mut problem = with(half_space(side, mode, transfer), kind);
            problem.end_time = 1.5;
            solved(&problem)
        };
        let echo = worst_echo(&run(pml()), &run(SideMethod::new("extended")));
        println!("{kind:?}, {mode:?}: echo {:.2} %", 100.0 * echo);
        assert!(echo < 0.02, "{kind:?} {mode:?}");
    }
}

#[test]
fn other_boundaries_work_with_smooth_bases() {
    // a dashpot and a damping layer must beat a fixed edge, and the published layer must run
    let echo_of = |side: SideMethod| {
        let run = |side: SideMethod| {
            let half_space = half_space(side, PointMode::Frozen, Transfer::Keep);
            let mut problem = with(half_space, (Bspline, Consistent));
            problem.end_time = 1.5;
            solved(&problem)
        };
        worst_echo(&run(side), &run(SideMethod::new("extended")))
    };
    let thick = |name: &str| SideMethod::new(name).with("thickness_m", 400.0);
    let fixed = echo_of(SideMethod::new("fixed"));
    for side in [
        SideMethod::new("dashpot"),
        thick("damping-layer"),
        thick("pml-stretched"),
    ] {
        let name = side.method.clone();
        let echo = echo_of(side);
        println!(
            "{name}: echo {:.1} %, fixed {:.1} %",
            100.0 * echo,
            100.0 * fixed
        );
        assert!(echo < 0.7 * fixed, "{name}");
    }
}

#[test]
fn a_wide_basis_wants_two_cells() {
    let mut problem = with(block(Transfer::Keep, PointMode::Frozen), (Bspline, Lumped));
    problem.cell_size = 3.0;
    problem.target.upper[0] = 3.0;
    let refused = setup::model(&problem).map(|_| ()).unwrap_err();
    assert!(refused.to_string().contains("basis"), "{refused}");
}
