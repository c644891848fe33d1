//! Gates of boundary methods in explicit steps: how long a step they bear, what they reflect, and that
//! they are the methods that implicit steps know.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic_reference::analytic::dalembert::Base;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::problem::{Aabb, Drive, PointMode, Problem, Scheme, Transfer};
use anechoic_solver::record::Record;
use anechoic_tests::explicit::{FLOWS, flowing, leapfrog, longest_step};
use anechoic_tests::{DEPTH, Unwatched, column, half_space, solved, ten_cells, worst_echo};

/// A small target with layers of ten cells, `nu` as given, in steps of `share` of the longest.
fn layered(layer: &str, nu: f64, share: f64) -> Problem<2> {
    let layer = SideMethod::new(layer).with("thickness_m", DEPTH);
    let mut problem = half_space(layer, PointMode::Frozen, Transfer::Keep);
    problem.target = Aabb {
        lower: [0.0, -200.0],
        upper: [300.0, 0.0],
    };
    problem.probes.receivers.clear();
    problem.material.poissons_ratio = nu;
    let mut problem = leapfrog(problem, 0.4);
    // the elastic mesh of the same size says what a step may be
    let mut elastic = problem.clone();
    let plain = SideMethod::new("extended").with("thickness_m", DEPTH);
    elastic.sides = [
        [plain.clone(), plain.clone()],
        [plain, SideMethod::new("free")],
    ];
    problem.dt = share * longest_step(&elastic);
    problem
}

/// Means of the energy over `count` windows from `from` (s) to the end.
fn windows(record: &Record, from: f64, count: usize) -> Vec<f64> {
    let energy = record.energy.column("total").unwrap();
    let first = record.energy.times.partition_point(|t| *t < from);
    let length = (energy.len() - first) / count;
    let means = energy[first..].chunks_exact(length).take(count);
    means
        .map(|w| w.iter().sum::<f64>() / w.len() as f64)
        .collect()
}

/// Rounding of the energy of displacements: what is below is no longer a wave.
const ROUNDING: f64 = 1e-24;

/// Does each window hold less than the one before?
fn decays(windows: &[f64]) -> bool {
    let floor = ROUNDING * windows[0];
    windows.windows(2).all(|w| w[1] < w[0] || w[1] < floor)
}

/// Analytic: leapfrog is stable as long as w dt < 2 for all w of the mesh (Courant, Friedrichs & Lewy
/// 1928); the true layer's semi-implicit damping and trapezoidal memory take nothing from that. Old
/// gradients in the memory, Euler's rules or springs at the old time would (by factors of 0.25..0.9).
#[test]
fn the_true_layer_bears_the_step_of_the_elastic_mesh_and_no_longer_one() {
    for nu in [0.25, 0.4] {
        for layer in ["extended", "pml"] {
            let run = |share: f64| {
                let mut problem = layered(layer, nu, share);
                problem.end_time = 3000.0 * problem.dt;
                anechoic_solver::solve(&problem, &Unwatched).unwrap()
            };
            let below = run(0.99);
            assert_eq!(below.error, None, "{layer}");
            let kept = windows(&below.record, 1.0, 8);
            let last = kept[kept.len() - 1] / kept[0];
            let above = run(1.01);
            let grown = match &above.error {
                Some(_) => f64::INFINITY,
                None => {
                    let all = windows(&above.record, 1.0, 8);
                    all[all.len() - 1] / all[0]
                }
            };
            println!("{layer}, nu = {nu}: energy by {last:.1e} at 0.99, by {grown:.1e} at 1.01");
            match layer {
                "pml" => assert!(decays(&kept), "{kept:?}"),
                // nothing takes energy; modes near the limit make it breathe
                _ => assert!((last - 1.0).abs() < 0.05, "{kept:?}"),
            }
            assert!(grown > 1e6, "{layer}: {grown}");
        }
    }
}

/// 20,000 steps, in nearly incompressible material as well: no slow growth hides behind the decay. Energy
/// of body and layer is no norm of the layer's memory: near nu = 0.5 it beats over some 1000 steps, which
/// windows of 2000 leave out.
#[test]
fn twenty_thousand_steps_only_decay() {
    for nu in [0.25, 0.49] {
        let mut problem = layered("pml", nu, 0.9);
        problem.target.upper[0] = 200.0;
        problem.target.lower[1] = -100.0;
        problem.end_time = 20_000.0 * problem.dt;
        let record = solved(&problem);
        assert_eq!(record.cost.steps, 20_000);
        let all = windows(&record, 1.0, 10);
        println!("nu = {nu}: energy {:.1e} .. {:.1e} J", all[0], all[9]);
        assert!(decays(&all), "{all:?}");
        assert!(all[9] < 1e-5 * all[0]);
    }
}

/// Reflection of the base as the top sees it: the share of twice the pulse in what comes T = 2 H/c later,
/// and how much of another form comes with it.
fn reflection(problem: &Problem<2>) -> [f64; 2] {
    let record = solved(problem);
    let Drive::SideVelocity { pulse, .. } = &problem.drives[0] else {
        panic!("the column is driven at its top");
    };
    let back = 2.0 * problem.target.upper[1] / problem.material.p_speed();
    let values = record.receivers.column("A_vy").unwrap();
    let seen: Vec<[f64; 2]> = record
        .receivers
        .times
        .iter()
        .zip(values)
        .filter(|(t, _)| (back..back + pulse.end()).contains(t))
        .map(|(t, v)| [2.0 * pulse.value(t - back), *v])
        .collect();
    let own: f64 = seen.iter().map(|[echo, _]| echo * echo).sum();
    let share = seen.iter().map(|[echo, v]| echo * v).sum::<f64>() / own;
    let rest: f64 = seen
        .iter()
        .map(|[echo, v]| (v - share * echo).powi(2))
        .sum();
    [share, (rest / own).sqrt()]
}

/// Analytic: (1 - a)/(1 + a) head-on (Lysmer & Kuhlemeyer 1969), in frozen and in moving points of all
/// bases, 31 cells a pulse. Half the mass, which is a = 1/2, would return a third. A traction by the velocity
/// before the step returns a wave of another form, the pulse's rate: 1.2 % of frozen points, seen at a = 1,
/// where nothing else comes back. Centred, 0.1 % is left of all but B-splines, which the side cuts off.
#[test]
fn dashpots_reflect_by_their_impedance() {
    for a in [0.5, 1.0, 2.0] {
        let exact = Base::Dashpot { impedance_ratio: a }.reflection();
        let base = || SideMethod::new("dashpot").with("impedance", a);
        let frozen = leapfrog(column(1.0, base()), 0.4);
        let moving = FLOWS.map(|kind| {
            let problem = flowing(column(1.0, base()), 0.4, kind, Transfer::Affine);
            (format!("{kind:?}"), problem)
        });
        for (name, problem) in [("frozen".to_owned(), frozen)].into_iter().chain(moving) {
            let [own, rest] = reflection(&problem);
            println!("{name}, a = {a}: R = {own:.4} for {exact:.4}, rest {rest:.4}");
            assert!((own - exact).abs() < 0.01, "{name}: {own} {exact}");
            let most = if name.contains("Bspline") {
                0.01
            } else {
                0.003
            };
            assert!(a != 1.0 || rest < most, "{name}: {rest}");
        }
    }
}

/// Implicit and explicit steps are two discretisations of one problem: with steps so short that neither
/// disperses they agree, with every method on three sides and waves at all angles. Newmark's error of the
/// phase w t is (w dt)^2/12 and leapfrog's half of it, 1e-4 each in 2 s at 2 Hz, and more at the pulse's
/// higher frequencies; what is summed to the nodes of a dashpot's side has another impedance than what is
/// consistent, by (k h)^2/6 or 2.6 % of waves along the side.
#[test]
fn explicit_steps_solve_the_implicit_steps_problem() {
    for (layer, most) in [
        (SideMethod::new("fixed"), 0.01),
        (SideMethod::new("dashpot"), 0.02),
        (
            SideMethod::new("damping-layer").with("thickness_m", DEPTH),
            0.01,
        ),
        (ten_cells(), 0.01),
        (ten_cells().with("alpha_per_s", 0.5), 0.01),
    ] {
        let run = |scheme| {
            let mut problem = half_space(layer.clone(), PointMode::Frozen, Transfer::Keep);
            (problem.scheme, problem.dt, problem.end_time) = (scheme, 0.002, 2.0);
            solved(&problem)
        };
        let implicit = run(Scheme::Newmark);
        let difference = worst_echo(&run(Scheme::Explicit), &implicit);
        println!("{layer:?}: {difference:.1e}");
        assert!(difference < most, "{layer:?}: {difference}");
    }
}
