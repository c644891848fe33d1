//! Gates of the layers' operators: echo, second implementation, symmetry, spectrum, stability,
//! mutations.
//!
//! The echo gates are certified: the same scheme on the same mesh, extended so that nothing comes back
//! before the end. Their scene is small (800 x 600 m, 3 s) and its metric is stricter than the
//! scene's: the difference over the whole run, the worst receiver.

use anechoic_reports::norms::growth_rate_per_s;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::linear::Moment;
use anechoic_solver::physics::model::Model;
use anechoic_solver::problem::{PointMode, Problem, Transfer};
use anechoic_solver::record::Record;
use anechoic_solver::setup;
use anechoic_solver::tensor::Vector;
use anechoic_solver::time::{Motion, System};
use anechoic_tests::twin::{Broken, Twin};
use anechoic_tests::{half_space, solved, worst_echo};
use faer::Mat;

const DEPTH: f64 = 200.0;
const REFLECTION: f64 = 1e-4;

fn pml() -> SideMethod {
    SideMethod::new("pml")
        .with("thickness_m", DEPTH)
        .with("reflection", REFLECTION)
}

fn frozen(layer: SideMethod) -> Problem<2> {
    half_space(layer, PointMode::Frozen, Transfer::Keep)
}

fn moving(layer: SideMethod) -> Problem<2> {
    half_space(layer, PointMode::Moving, Transfer::Affine)
}

/// Largest echo of ten cells at the worst receiver, over that receiver's largest displacement: the
/// target of the point source is 2 % of a mean over receivers and over a standard run that echoes.
const MOST_ECHO: f64 = 0.02;
/// Two implementations of the same equations differ by rounding and the solver's tolerance alone.
const TWINS_DIFFER: f64 = 1e-8;

/// Solves with the twin in place of the solver's own kernel.
fn twin_run(problem: &Problem<2>, broken: Broken) -> Record {
    let mut model = setup::model(problem).unwrap();
    let geometry = [[0.0, 800.0], [-600.0, 0.0]];
    let own = model.regions.pop().unwrap();
    let layer = (DEPTH, REFLECTION, 20.0);
    let twin = Twin::new(
        &model.points,
        own.range.clone(),
        &problem.material,
        geometry,
        layer,
        broken,
    );
    model.add_layer(Box::new(twin), own.range);
    anechoic_solver::run_model(problem, model, &anechoic_tests::Unwatched).record
}

#[test]
fn ten_cells_leave_little_echo_in_frozen_and_moving_points() {
    let reference = solved(&frozen(SideMethod::new("extended")));
    let echo = worst_echo(&solved(&frozen(pml())), &reference);
    println!(
        "frozen, 10 cells: {:.2} % at the worst receiver",
        100.0 * echo
    );
    assert!(echo < 0.015);
    let reference = solved(&moving(SideMethod::new("extended")));
    let echo = worst_echo(&solved(&moving(pml())), &reference);
    println!(
        "moving (affine, layer at rest), 10 cells: {:.2} %",
        100.0 * echo
    );
    assert!(echo < MOST_ECHO);
}

#[test]
fn thicker_layers_leave_less() {
    let reference = solved(&frozen(SideMethod::new("extended")));
    let layer = |cells: f64| SideMethod::new("pml").with("thickness_m", 20.0 * cells);
    let echoes =
        [5.0, 10.0, 20.0].map(|cells| worst_echo(&solved(&frozen(layer(cells))), &reference));
    println!("worst echo of 5, 10, 20 cells: {echoes:.4?}");
    assert!(echoes[1] < 0.5 * echoes[0] && echoes[2] < 0.5 * echoes[1]);
}

#[test]
fn a_second_implementation_agrees() {
    let problem = frozen(pml());
    let difference = worst_echo(&twin_run(&problem, Broken::Nothing), &solved(&problem));
    println!("solver's layer against the twin: {difference:.1e}");
    assert!(difference < TWINS_DIFFER);
}

#[test]
fn every_break_of_the_layer_fails_a_gate() {
    let reference = solved(&frozen(SideMethod::new("extended")));
    let healthy = solved(&frozen(pml()));
    for (broken, echoes) in [
        (Broken::SignOfMemory, true),
        (Broken::LaggedMemory, true),
        (Broken::NoCornerTerm, true),
        // too small a jump for the echo to tell; the second implementation does
        (Broken::ShiftedProfile, false),
    ] {
        let record = twin_run(&frozen(pml()), broken);
        let echo = worst_echo(&record, &reference);
        let difference = worst_echo(&record, &healthy);
        println!(
            "{broken:?}: echo {:.3e}, difference to the healthy layer {difference:.1e}",
            echo
        );
        if echoes {
            assert!(
                !(echo < MOST_ECHO),
                "{broken:?} passes with an echo of {echo}"
            );
        }
        assert!(
            !(difference < 1e4 * TWINS_DIFFER),
            "{broken:?} passes with {difference}"
        );
    }
    let mut one_side_gone = frozen(pml());
    one_side_gone.sides[0][0] = SideMethod::new("fixed");
    let echo = worst_echo(&solved(&one_side_gone), &reference);
    assert!(echo > 0.1, "one side removed passes with {echo}");
}

/// Force on free unknowns for a displacement, at rest: a column of minus the stiffness.
fn column(model: &mut Model<2>, unknown: usize) -> Vec<f64> {
    let n = model.grid.node_count();
    let rest = vec![[0.0; 2]; n];
    let mut unit: Vec<Vector<2>> = rest.clone();
    unit[unknown / 2][unknown % 2] = 1.0;
    let mut force = rest.clone();
    let trial = Motion {
        increment: &unit,
        v: &rest,
        a: &rest,
    };
    model.residual(&trial, &mut force).unwrap();
    force.as_flattened().to_vec()
}

/// A mesh small enough for dense algebra: 60 x 40 m, layers of three cells left, right and below.
fn tiny(layer: SideMethod) -> Problem<2> {
    let mut problem = frozen(layer.with("thickness_m", 60.0));
    problem.target.lower = [0.0, -40.0];
    problem.target.upper = [60.0, 0.0];
    problem.drives.clear();
    problem.probes.receivers.clear();
    problem
}

/// Free unknowns and the stiffness on them, probed column by column from rest.
fn probed(problem: &Problem<2>) -> (Model<2>, Vec<usize>, Mat<f64>) {
    let mut model = setup::model(problem).unwrap();
    model.begin_step(
        [0.0, problem.dt],
        Moment {
            step: 1,
            time_s: problem.dt,
        },
    );
    // what is held has no force at all
    let free: Vec<usize> = (0..2 * model.grid.node_count())
        .filter(|&i| column(&mut model, i)[i] != 0.0)
        .collect();
    let columns: Vec<Vec<f64>> = free.iter().map(|&j| column(&mut model, j)).collect();
    let k = Mat::from_fn(free.len(), free.len(), |i, j| -columns[j][free[i]]);
    (model, free, k)
}

#[test]
fn the_true_layers_tangent_is_symmetric_to_rounding() {
    let (_, _, k) = probed(&tiny(pml()));
    let asymmetry = (&k - k.transpose()).norm_max() / k.norm_max();
    println!("asymmetry of the tangent: {asymmetry:.1e}");
    assert!(asymmetry < 1e-14);
    let (_, _, k) = probed(&tiny(SideMethod::new("pml-stretched")));
    let asymmetry = (&k - k.transpose()).norm_max() / k.norm_max();
    assert!(
        asymmetry > 1e-2,
        "the published layer's is not: {asymmetry}"
    );
}

/// Largest real part of the spectrum of the true layer's semi-discrete operator, over c_p/h.
///
/// State (u, v, phi): du = v, M dv = -C v - Kd u - sum V B' P(B u, phi), dphi_kl = (B u)_kl - b_l phi_kl.
fn growth_of_the_true_layer(nu: f64) -> f64 {
    let mut problem = tiny(pml());
    problem.material.poissons_ratio = nu;
    let (model, free, _) = probed(&problem);
    let own = model.regions.last().unwrap().range.clone();
    let geometry = [[0.0, 60.0], [-40.0, 0.0]];
    let layer = (60.0, REFLECTION, 20.0);
    let material = &problem.material;
    let twin = Twin::new(
        &model.points,
        own.clone(),
        material,
        geometry,
        layer,
        Broken::Nothing,
    );
    let (n, q) = (free.len(), own.len());
    // without memory: the same mesh with plain elastic stress, and the twin's at phi = 0
    let mut plain = tiny(SideMethod::new("extended"));
    plain.material = *material;
    let (_, plain_free, k) = probed(&plain);
    assert_eq!(plain_free, free);
    let mut a = Mat::zeros(2 * n + 4 * q, 2 * n + 4 * q);
    let lumped = &model.nodes.lumped;
    let at = |values: &[Vector<2>], i: usize| values[free[i] / 2][free[i] % 2];
    for i in 0..n {
        a[(i, n + i)] = 1.0;
        let mass = at(&lumped.mass, i);
        a[(n + i, n + i)] = -at(&lumped.viscous, i) / mass;
        for j in 0..n {
            let spring = if i == j {
                at(&lumped.stiffness, i)
            } else {
                0.0
            };
            a[(n + i, j)] = -(k[(i, j)] + spring) / mass;
        }
    }
    let rest = vec![[0.0; 2]; model.grid.node_count()];
    for point in 0..q {
        let p = own.start + point;
        for (component, (kk, l)) in [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().enumerate() {
            let row = 2 * n + 4 * point + component;
            a[(row, row)] = -twin.beta[point][l];
            // memory onto forces
            let mut phi = [[0.0; 2]; 2];
            phi[kk][l] = 1.0;
            let stress = twin.stress(point, &[[0.0; 2]; 2], &phi);
            let mut force = rest.clone();
            let volume = &model.points.volume[p..p + 1];
            model
                .disc
                .scatter_stress(p..p + 1, volume, &[stress], &mut force);
            for i in 0..n {
                a[(n + i, row)] -= at(&force, i) / at(&lumped.mass, i);
            }
        }
        for j in 0..n {
            let mut unit = rest.clone();
            unit[free[j] / 2][free[j] % 2] = 1.0;
            let mut g = [[[0.0; 2]; 2]];
            model.disc.gradient(p..p + 1, &unit, &mut g);
            for (component, value) in g.as_flattened().as_flattened().iter().enumerate() {
                a[(2 * n + 4 * point + component, j)] = *value;
            }
        }
    }
    largest_real_part(a) / (problem.material.p_speed() / 20.0)
}

fn largest_real_part(mut a: Mat<f64>) -> f64 {
    // entries span ten orders of magnitude (stiffness over mass against rates): diagonal scaling by
    // powers of two makes the eigenvalues as accurate as the rest
    balance(&mut a);
    let eigenvalues = a
        .eigenvalues()
        .expect("a dense eigenproblem of finite numbers");
    eigenvalues
        .iter()
        .map(|z| z.re)
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Osborne's balancing: similar rows and columns, eigenvalues unchanged to the last bit.
fn balance(a: &mut Mat<f64>) {
    let n = a.nrows();
    for _ in 0..20 {
        let mut quiet = true;
        for i in 0..n {
            let others = || (0..n).filter(|j| *j != i);
            let column: f64 = others().map(|j| a[(j, i)].abs()).sum();
            let row: f64 = others().map(|j| a[(i, j)].abs()).sum();
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let factor = 2.0_f64.powf((0.5 * (row / column).log2()).round());
            if factor != 1.0 {
                quiet = false;
                for j in 0..n {
                    a[(i, j)] /= factor;
                    a[(j, i)] *= factor;
                }
            }
        }
        if quiet {
            return;
        }
    }
}

#[test]
fn the_true_layers_spectrum_does_not_grow() {
    for nu in [0.0, 0.25, 0.4] {
        let growth = growth_of_the_true_layer(nu);
        println!("nu = {nu}: largest real part {growth:.1e} c_p/h");
        assert!(growth < 1e-10);
    }
}

/// Largest real part (1/s) of the published layer's spectrum without memory: M a + C v + K u = 0.
fn growth_of_the_published_layer(rayleigh: f64) -> f64 {
    let layer = SideMethod::new("pml-stretched")
        .with("rayleigh_per_s", rayleigh)
        .with("relaxed_modulus_ratio", 1.0);
    let (model, free, k) = probed(&tiny(layer));
    let n = free.len();
    let lumped = &model.nodes.lumped;
    let at =
        |values: &[Vector<2>], i: usize| values.get(free[i] / 2).map_or(0.0, |v| v[free[i] % 2]);
    let mut a = Mat::zeros(2 * n, 2 * n);
    for i in 0..n {
        a[(i, n + i)] = 1.0;
        a[(n + i, n + i)] = -at(&lumped.viscous, i) / at(&lumped.mass, i);
        for j in 0..n {
            a[(n + i, j)] = -k[(i, j)] / at(&lumped.mass, i);
        }
    }
    largest_real_part(a)
}

#[test]
fn the_published_layer_grows_without_damping_and_rests_with_it() {
    let (bare, damped) = (
        growth_of_the_published_layer(0.0),
        growth_of_the_published_layer(1.0),
    );
    println!("published layer, largest real part: bare {bare:.3} /s, alpha_M = 1/s {damped:.3} /s");
    assert!(bare > 1e-3);
    assert!(damped < bare);
}

fn growth(record: &Record) -> [f64; 2] {
    let energy = record.energy.column("total").unwrap();
    let slope = growth_rate_per_s(&record.energy.times, energy).unwrap();
    println!(
        "growth of the energy {:.4} /s, 95 % interval {:?}",
        slope.value, slope.interval
    );
    slope.interval.expect("windows enough for an interval")
}

#[test]
fn a_hundred_seconds_do_not_make_the_true_layer_grow() {
    let mut problem = frozen(pml());
    problem.end_time = 100.0;
    problem.probes.energy_every = Some(20);
    let record = solved(&problem);
    let [low, _] = growth(&record);
    let energy = record.energy.column("total").unwrap();
    let largest = energy.iter().copied().fold(0.0, f64::max);
    assert!(low <= 0.0);
    assert!(energy[energy.len() - 1] < 1e-3 * largest);
}

#[test]
fn flip_makes_the_true_layer_grow() {
    // a regression of a finding: the motion's filter acts as more mass, which the damping lacks
    let layer = pml().with_choice("with_flip", "force");
    let mut problem = half_space(layer, PointMode::Moving, Transfer::Flip);
    problem.end_time = 6.0;
    let outcome = anechoic_solver::solve(&problem, &anechoic_tests::Unwatched).unwrap();
    let diverged = outcome.error.is_some();
    println!("diverged: {diverged}");
    assert!(diverged || growth(&outcome.record)[0] > 0.0);
    assert!(setup::model(&half_space(pml(), PointMode::Moving, Transfer::Flip)).is_err());
}
