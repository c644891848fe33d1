//! Gates of loads that stay on: the true layer under a frequency shift, and what settles.
//!
//! Analytic: the tangent, the layer at rest. Certified: settlement and echo against an extended domain.
//! The rest compares with a second implementation, which breaks on purpose.

#![allow(
    clippy::unwrap_used,
    reason = "a gate that cannot be set up has failed"
)]
#![allow(clippy::neg_cmp_op_on_partial_ord, reason = "NaN must not pass")]

use anechoic::commands::{Options, compare};
use anechoic_reports::row::{Row, Verdict};
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::linear::Moment;
use anechoic_solver::physics::model::Model;
use anechoic_solver::problem::{BasisKind, Drive, MassKind, PointMode, Problem, Transfer};
use anechoic_solver::record::Record;
use anechoic_solver::setup;
use anechoic_solver::tensor::Vector;
use anechoic_solver::time::{ForceScale, Motion, Rates, System};
use anechoic_solver::wavelet::Wavelet;
use anechoic_tests::twin::{Broken, Twin};
use anechoic_tests::{DEPTH, KINDS, REFLECTION, half_space, solved, ten_cells, worst_echo};

fn following() -> SideMethod {
    ten_cells().with_choice("static_load", "follow")
}

fn frozen(layer: SideMethod, wavelet: Wavelet) -> Problem<2> {
    with(
        half_space(layer, PointMode::Frozen, Transfer::Keep),
        wavelet,
    )
}

fn with(mut problem: Problem<2>, wavelet: Wavelet) -> Problem<2> {
    for drive in &mut problem.drives {
        if let Drive::PointForce { pulse, .. } = drive {
            (pulse.wavelet, pulse.t0) = (wavelet, 0.5);
        }
    }
    problem
}

/// A mesh of a few cells, all three layers, with a shift of 2/s.
fn tiny((basis, mass): (BasisKind, MassKind)) -> Problem<2> {
    let layer = ten_cells()
        .with("thickness_m", 60.0)
        .with("alpha_per_s", 2.0);
    let mut problem = half_space(layer, PointMode::Frozen, Transfer::Keep);
    (problem.target.lower, problem.target.upper) = ([0.0, -60.0], [80.0, 0.0]);
    (problem.basis, problem.mass) = (basis, mass);
    problem.drives.clear();
    problem.probes.receivers.clear();
    problem
}

fn begin(model: &mut Model<2>, dt: f64, step: usize) {
    let moment = Moment {
        step,
        time_s: dt * step as f64,
    };
    model
        .begin_step([dt * (step - 1) as f64, dt * step as f64], moment)
        .unwrap();
}

/// Values that follow no pattern of the mesh, zero where nodes are held.
fn rough(model: &Model<2>) -> Vec<Vector<2>> {
    let mut values: Vec<Vector<2>> = (0..model.grid.node_count())
        .map(|n| [(0.7 * n as f64).sin(), (1.1 * n as f64).cos()])
        .collect();
    model.impose(&mut values);
    for (value, active) in values.iter_mut().zip(&model.nodes.active) {
        if !active {
            *value = [0.0; 2];
        }
    }
    values
}

#[test]
fn the_tangent_is_the_derivative_of_the_residual() {
    for kind in KINDS {
        let problem = tiny(kind);
        let mut model = setup::model(&problem).unwrap();
        let rates = Rates {
            mass: 4.0 / problem.dt.powi(2),
            viscous: 2.0 / problem.dt,
        };
        begin(&mut model, problem.dt, 1);
        let direction = rough(&model);
        let of = |rate: f64| -> Vec<Vector<2>> {
            direction.iter().map(|d| d.map(|x| rate * x)).collect()
        };
        let (v, a) = (of(rates.viscous), of(rates.mass));
        let mut force = of(0.0);
        let trial = Motion {
            increment: &direction,
            v: &v,
            a: &a,
        };
        model.residual(&trial, &mut force).unwrap();
        // linear: minus the force of a direction, solved for, is the direction
        let minus: Vec<Vector<2>> = force.iter().map(|f| f.map(|x| -x)).collect();
        let scale = ForceScale {
            largest: 1e-12,
            rounding: 0.0,
        };
        let mut back = of(0.0);
        model
            .solve(rates, &direction, &minus, scale, &mut back)
            .unwrap();
        let off = distance(&back, &direction);
        println!("{kind:?}: {off:.1e}");
        assert!(off < 1e-8, "{kind:?}: {off}");
    }
}

/// Largest difference over the largest value of the second.
fn distance(a: &[Vector<2>], b: &[Vector<2>]) -> f64 {
    let largest = |of: &dyn Fn(usize) -> f64| (0..a.len()).map(of).fold(0.0, f64::max);
    let apart = largest(&|n| (a[n][0] - b[n][0]).hypot(a[n][1] - b[n][1]));
    apart / largest(&|n| b[n][0].hypot(b[n][1]))
}

/// Holding a displacement until all memory has faded leaves elastic material, stretched by 1 + beta/alpha:
/// nothing of the springs is left.
#[test]
fn at_rest_the_layer_is_stretched_elastic_material() {
    let alpha = 2.0;
    for kind in KINDS {
        let problem = tiny(kind);
        let mut model = setup::model(&problem).unwrap();
        let dt = 0.05;
        begin(&mut model, dt, 1);
        let mut increment = rough(&model);
        let displacement = increment.clone();
        let rest = vec![[0.0; 2]; increment.len()];
        let mut force = rest.clone();
        for step in 1..=400 {
            begin(&mut model, dt, step);
            let held = Motion {
                increment: &increment,
                v: &rest,
                a: &rest,
            };
            model.residual(&held, &mut force).unwrap();
            model.commit(&held).unwrap();
            increment.clone_from(&rest);
        }
        let expected = stretched(&model, &problem, &displacement, alpha);
        let off = distance(&force, &expected);
        println!("{kind:?}: {off:.1e}");
        assert!(off < 1e-9, "{kind:?}: {off}");
    }
}

/// Minus the force of the layer stretched by s_j = 1 + beta_j/alpha, and of the body, on free nodes.
fn stretched(
    model: &Model<2>,
    problem: &Problem<2>,
    u: &[Vector<2>],
    alpha: f64,
) -> Vec<Vector<2>> {
    let (lambda, shear) = (problem.material.lambda(), problem.material.shear_modulus());
    let layer = model.regions.last().unwrap().range.clone();
    let b0 = 1.5 * problem.material.p_speed() * (1.0 / REFLECTION).ln() / 60.0;
    let mut force = vec![[0.0; 2]; u.len()];
    for p in 0..model.points.len() {
        let mut g = [[[0.0; 2]; 2]];
        model.disc.gradient(p..p + 1, u, &mut g);
        let [[[xx, xy], [yx, yy]]] = g;
        let [x, y] = model.points.place[p];
        let stretch = |inwards: f64| 1.0 + b0 / alpha * (inwards.max(0.0) / 60.0).powi(2);
        let (s1, s2) = match layer.contains(&p) {
            true => (stretch((-x).max(x - 80.0)), stretch(-60.0 - y)),
            false => (1.0, 1.0),
        };
        let (first, second) = (s2 / s1, s1 / s2);
        let normal = lambda + 2.0 * shear;
        let stress = [
            [
                normal * first * xx + lambda * yy,
                shear * (second * xy + yx),
            ],
            [
                shear * (first * yx + xy),
                normal * second * yy + lambda * xx,
            ],
        ];
        let volume = &model.points.volume[p..p + 1];
        model
            .disc
            .scatter_stress(p..p + 1, volume, &[stress], &mut force);
    }
    let mut minus: Vec<Vector<2>> = force.iter().map(|f| f.map(|x| -x)).collect();
    model.impose(&mut minus);
    minus
}

/// Solves with the twin in place of the solver's own kernel; alpha as static_load = "follow" has it.
fn twin_run(problem: &Problem<2>, broken: Broken) -> Record {
    let mut model = setup::model(problem).unwrap();
    let own = model.regions.pop().unwrap();
    let alpha = (1.0 / REFLECTION).ln() / (2.0 * problem.end_time);
    let twin = Twin::new(
        &model.points,
        own.range.clone(),
        &problem.material,
        [[0.0, 800.0], [-600.0, 0.0]],
        (DEPTH, REFLECTION, 20.0),
        broken,
    );
    model.add_layer(Box::new(twin.shifted(alpha)), own.range);
    anechoic_solver::run_model(problem, model, &anechoic_tests::Unwatched).record
}

#[test]
fn a_second_implementation_agrees_and_each_break_of_it_fails() {
    let problem = frozen(following(), Wavelet::Step);
    let healthy = solved(&problem);
    let reference = solved(&frozen(SideMethod::new("extended"), Wavelet::Step));
    let own = worst_echo(&healthy, &reference);
    println!("error under a step, worst receiver: {own:.4}");
    assert!(own < MOST_ERROR);
    let agreeing = worst_echo(&twin_run(&problem, Broken::Nothing), &healthy);
    println!("solver's layer against the twin: {agreeing:.1e}");
    assert!(agreeing < 1e-7);
    for broken in [
        Broken::NoFirstMemory,
        Broken::SignOfShiftedSprings,
        Broken::UnshiftedMemory,
    ] {
        let record = twin_run(&problem, broken);
        let (error, apart) = (
            worst_echo(&record, &reference),
            worst_echo(&record, &healthy),
        );
        println!("{broken:?}: error {error:.3e}, to the healthy layer {apart:.1e}");
        assert!(!(error < MOST_ERROR), "{broken:?} passes with {error}");
        assert!(!(apart < 1e-3), "{broken:?} passes with {apart}");
    }
}

/// What ten cells may get wrong of a step's motion at the worst receiver within 3 s.
const MOST_ERROR: f64 = 0.04;

#[test]
fn the_echo_of_a_ricker_wavelet_is_unchanged() {
    let run = |layer| solved(&frozen(layer, Wavelet::Ricker));
    let reference = run(SideMethod::new("extended"));
    let (plain, shifted) = (run(ten_cells()), run(of_a_long_run()));
    let change = worst_echo(&shifted, &plain);
    let [plain, shifted] = [plain, shifted].map(|record| worst_echo(&record, &reference));
    println!("echo {plain:.5}, with a shift {shifted:.5}; series differ by {change:.5}");
    assert!(shifted < 1.1 * plain && shifted > 0.7 * plain);
    assert!(change < 0.2 * plain);
}

/// With the shift of a run of 20 s.
fn of_a_long_run() -> SideMethod {
    ten_cells().with("alpha_per_s", 0.23)
}

#[test]
fn moving_points_see_the_same_shift() {
    // what it changes in a force that stays on, beside frozen and beside moving points
    let change = |mode, transfer| {
        let run = |layer| {
            let mut problem = with(half_space(layer, mode, transfer), Wavelet::Step);
            problem.end_time = 2.0;
            solved(&problem)
        };
        worst_echo(&run(following()), &run(ten_cells()))
    };
    let frozen = change(PointMode::Frozen, Transfer::Keep);
    let moving = change(PointMode::Moving, Transfer::Affine);
    println!("change by the shift: frozen {frozen:.5}, moving {moving:.5}");
    assert!((moving / frozen - 1.0).abs() < 0.1 && frozen > 1e-3);
}

#[test]
fn without_a_shift_nothing_changes() {
    let run = |layer| solved(&frozen(layer, Wavelet::Sine)).receivers;
    let plain = run(ten_cells());
    assert_eq!(run(ten_cells().with("alpha_per_s", 0.0)), plain);
    assert_eq!(run(following().with("alpha_per_s", 0.0)), plain);
    assert_ne!(run(following()), plain);
}

#[test]
fn a_layer_has_one_shift_on_all_its_sides() {
    for (other, field) in [
        (ten_cells().with("alpha_per_s", 0.1), "alpha_per_s"),
        (following(), "static_load"),
    ] {
        let mut problem = frozen(ten_cells(), Wavelet::Sine);
        problem.sides[1][0] = other;
        let error = setup::model(&problem).map(|_| ()).unwrap_err().to_string();
        assert!(
            error.contains(field) && error.contains("one frequency shift"),
            "{error}"
        );
    }
    // thin and thick sides follow together
    let mut problem = frozen(following(), Wavelet::Sine);
    problem.sides[1][0] = following().with("thickness_m", 100.0);
    assert!(setup::model(&problem).is_ok());
}

/// The settlement of the point source's gate.
fn settled(methods: &[&str], sets: &[&str]) -> Vec<Row> {
    let folder = tempfile::tempdir().unwrap();
    let mut options = Options::new("point-source", folder.path()).profile("gate");
    options.request.presets = vec!["step".to_owned()];
    for set in sets {
        options = options.set(set);
    }
    for method in methods {
        options = options.method(method);
    }
    let finished = compare(&options).unwrap();
    assert!(
        !folder.path().join("certified").exists(),
        "the reference was not found"
    );
    let rows = finished.rows.into_iter();
    rows.filter(|row| row.metric == "settlement_error" && row.place.len() == 1)
        .collect()
}

#[test]
fn the_ground_settles_as_claimed() {
    let rows = settled(&["pml", "pml-static", "pml-20-static"], &[]);
    assert_eq!(rows.len(), 9);
    for row in rows {
        println!("{} {} {:?}", row.method, row.place, row.value);
        assert_eq!(row.verdict, Some(Verdict::Pass), "{row:?}");
    }
}

#[test]
fn dashpots_and_too_large_a_shift_ruin_the_offset() {
    let worst = |rows: Vec<Row>| rows.iter().filter_map(|row| row.value).fold(0.0, f64::max);
    let dashpot = worst(settled(&["dashpot"], &[]));
    let large = settled(&["pml"], &["pml.alpha_per_s=1.3"]);
    assert!(large.iter().all(|row| row.verdict == Some(Verdict::Fail)));
    let large = worst(large);
    println!("dashpot {dashpot:.2}, alpha = 1.3/s {large:.2}");
    // nothing holds the body; a layer of little stretch is a near, fixed edge
    assert!(dashpot > 0.5 && large > 0.2);
}
