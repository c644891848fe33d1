//! The bill of modelling: naming a feature is what makes it cost, in memory, allocations and work, and
//! what is billed is what a run takes.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use allocation_counter::measure;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::probe::{LineProbe, Probes};
use anechoic_solver::problem::{BasisKind, MassKind, PointMode, Problem, SolverKind, Transfer};
use anechoic_solver::{Bill, bill};
use anechoic_tests::{half_space, solved};
use cpu_time::ThreadTime;

/// A half-space that records nothing, its layers 200 m thick, for `steps` steps.
fn plain(layer: &str, steps: usize) -> Problem<2> {
    let layer = SideMethod::new(layer).with("thickness_m", 200.0);
    let problem = half_space(layer, PointMode::Frozen, Transfer::Keep);
    Problem {
        probes: Probes::default(),
        // a factor is not part of the bill
        solver: SolverKind::Cg,
        end_time: problem.dt * steps as f64,
        ..problem
    }
}

fn moving(layer: &str, transfer: Transfer, steps: usize) -> Problem<2> {
    Problem {
        point_mode: PointMode::Moving,
        transfer,
        ..plain(layer, steps)
    }
}

fn billed(problem: &Problem<2>) -> Bill {
    bill(problem).unwrap()
}

/// A feature by name, and the same problem without and with it.
type Pair = (&'static str, Problem<2>, Problem<2>);

/// Features that points and nodes carry.
fn pairs(steps: usize) -> Vec<Pair> {
    let with_basis = |basis, problem| Problem { basis, ..problem };
    let wide = || with_basis(BasisKind::Bspline, plain("extended", steps));
    let consistent = Problem {
        mass: MassKind::Consistent,
        ..wide()
    };
    let carried = Problem {
        transfer: Transfer::Flip,
        ..plain("extended", steps)
    };
    let flip = || moving("extended", Transfer::Flip, steps);
    vec![
        ("bspline basis", plain("extended", steps), wide()),
        ("gimp basis", flip(), with_basis(BasisKind::Gimp, flip())),
        ("consistent masses", wide(), consistent),
        ("flip transfer", plain("extended", steps), carried.clone()),
        ("moving points", carried, flip()),
        (
            "affine transfer",
            flip(),
            moving("extended", Transfer::Affine, steps),
        ),
        ("pml", plain("extended", steps), plain("pml", steps)),
        (
            "pml-stretched",
            plain("extended", steps),
            plain("pml-stretched", steps),
        ),
        (
            "damping-layer",
            plain("extended", steps),
            plain("damping-layer", steps),
        ),
    ]
}

/// What is recorded.
fn recorders(steps: usize) -> Vec<Pair> {
    let with = |probes| Problem {
        probes,
        ..plain("extended", steps)
    };
    let none = Probes::default;
    let receivers = half_space(SideMethod::new("free"), PointMode::Frozen, Transfer::Keep)
        .probes
        .receivers;
    let line = LineProbe {
        from: [400.0, -600.0],
        to: [400.0, 0.0],
        samples: 64,
        component: 1,
        every: 1,
    };
    let snapshot_times = (0..64).map(|k| 0.05 * f64::from(k)).collect();
    vec![
        (
            "receivers",
            with(none()),
            with(Probes {
                receivers,
                ..none()
            }),
        ),
        (
            "line of",
            with(none()),
            with(Probes {
                lines: vec![line],
                ..none()
            }),
        ),
        (
            "snapshots",
            with(none()),
            with(Probes {
                snapshot_times,
                ..none()
            }),
        ),
        (
            "energy",
            with(none()),
            with(Probes {
                energy_every: Some(1),
                ..none()
            }),
        ),
    ]
}

/// Is a feature named on the bill?
fn names(bill: &Bill, feature: &str) -> bool {
    bill.items.iter().any(|item| item.feature.contains(feature))
}

#[test]
fn a_feature_is_billed_where_it_is_named_and_nowhere_else() {
    for (feature, without, with) in pairs(10).into_iter().chain(recorders(10)) {
        assert!(names(&billed(&with), feature), "{feature}");
        assert!(!names(&billed(&without), feature), "{feature}");
    }
}

#[test]
fn memory_is_what_features_name() {
    for (feature, without, with) in pairs(8).into_iter().chain(recorders(500)) {
        let peak = |problem: &Problem<2>| measure(|| drop(solved(problem))).bytes_max as f64;
        let measured = peak(&with) - peak(&without);
        let billed = billed(&with).bytes() as f64 - billed(&without).bytes() as f64;
        println!("{feature}: {measured} B more, billed {billed} B");
        if feature == "moving points" {
            // they need not the matrix that stays when points rest
            assert!(measured < 0.0 && billed < 0.0);
        }
        assert!(
            (measured / billed - 1.0).abs() < 0.3,
            "{feature}: {measured} B, billed {billed} B"
        );
    }
}

#[test]
fn no_feature_allocates_in_steps_but_what_it_names() {
    for (feature, _, with) in pairs(0).into_iter().chain(recorders(0)) {
        let count = |steps: f64| {
            let problem = Problem {
                end_time: steps * with.dt,
                ..with.clone()
            };
            measure(|| drop(solved(&problem))).count_total
        };
        let (short, long) = (count(30.0), count(60.0));
        println!("{feature}: {short} allocations in 30 steps, {long} in 60");
        assert!(short > 0);
        // what is not known beforehand: a picture, a few columns; energies, squares of velocities
        let allowed = match feature {
            "snapshots" => 6 * 10,
            "energy" => 30 * 2,
            _ => 0,
        };
        assert!(long <= short + allowed, "{feature}");
    }
}

/// CPU time (s) of a run, the lesser of two.
fn cpu(problem: &Problem<2>) -> f64 {
    let once = || {
        let start = ThreadTime::now();
        solved(problem);
        start.elapsed().as_secs_f64()
    };
    once().min(once())
}

#[test]
fn work_is_what_features_name_and_about_what_is_billed() {
    if cfg!(debug_assertions) {
        println!("not evaluated: prices are those of an optimised build");
        return;
    }
    let (mut logs, mut ratios) = (0.0, Vec::new());
    let as_usual = |problem| Problem {
        solver: SolverKind::Auto,
        ..problem
    };
    for (feature, without, with) in pairs(50) {
        let (without, with) = (as_usual(without), as_usual(with));
        let (before, after) = (cpu(&without), cpu(&with));
        let [less, more] = [&without, &with].map(|problem| billed(problem).seconds());
        println!(
            "{feature}: {before:.3} s without, {after:.3} s with; billed {less:.3} s, {more:.3} s"
        );
        // what is a tenth of the work drowns in that of others on the machine
        assert!(
            more < 1.3 * less || after > 1.05 * before,
            "{feature}: {before} s, {after} s"
        );
        ratios.push((feature, more / after));
        logs += (more / after).ln();
    }
    // prices are those of one machine: others differ in speed, but alike for all features
    let speed = (logs / ratios.len() as f64).exp();
    println!("billed {speed:.2} of what it takes on this machine");
    for (feature, ratio) in ratios {
        let ratio = ratio / speed;
        println!("{feature}: {ratio:.2}");
        assert!((1.0 / 3.0..3.0).contains(&ratio), "{feature}: {ratio}");
    }
}
