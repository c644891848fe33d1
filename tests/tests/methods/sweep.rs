//! Gates of sweeps, of error against cost, and of the map of stability, on scenes that take seconds.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic::commands::{self, Finished, Options};
use anechoic::error::exit;
use anechoic_reports::row::{Row, Verdict};
use anechoic_reports::stability::{Outcome, Stability};
use anechoic_reports::study::Upshot;
use anechoic_reports::tradeoff::Standing;
use anechoic_tests::study::NARROW;
use std::path::Path;

/// compression-1d in a column two cells wide.
fn column(out: &Path) -> Options {
    let options = Options::new("compression-1d", out).profile("gate");
    NARROW.iter().fold(options, |options, set| options.set(set))
}

/// A force on 400 x 400 m, two receivers, 5 s: enough to see a layer grow.
fn half_space(out: &Path) -> Options {
    [
        "target.x_max_m=1400",
        "target.depth_m=400",
        "receivers=[{name='A1',x_m=1305,y_m=-65},{name='B1',x_m=1125,y_m=-305}]",
        "grid.h_m=40",
        "pml.thickness_m=200",
        "pml-stretched.thickness_m=200",
    ]
    .into_iter()
    .fold(
        Options::new("point-source", out).profile("gate"),
        Options::set,
    )
}

fn value(rows: &[Row], method: &str, metric: &str, place: &str) -> f64 {
    let found = rows
        .iter()
        .find(|row| row.method == method && row.metric == metric && row.place == place);
    let found = found.unwrap_or_else(|| panic!("no row {method}/{metric}/{place}"));
    found.value.unwrap_or_else(|| panic!("{}", found.why))
}

/// A dashpot of a times the impedance reflects (1 - a)/(1 + a) head-on (analytic; Lysmer and Kuhlemeyer
/// 1969): a third at one half and, with the other sign, at two. A mesh of 2 m adds two per cent.
#[test]
fn a_sweep_of_impedance_finds_the_reflection_of_theory() {
    let out = tempfile::tempdir().unwrap();
    let over = ["dashpot.impedance=0.5,1,2".to_owned()];
    let options = column(out.path());
    let plan = commands::plan_sweep(&options, &over).unwrap();
    let finished = commands::execute(plan, &options).unwrap();
    for (a, low, high) in [("0.5", 0.30, 0.36), ("1", 0.0, 0.03), ("2", 0.30, 0.36)] {
        let place = format!("A@dashpot.impedance={a}");
        let echo = value(&finished.rows, "dashpot", "echo_ratio", &place);
        println!("impedance {a}: echo {echo:.4}");
        assert!((low..high).contains(&echo), "{a}: {echo}");
    }
    // Three points share their standard run.
    assert_eq!(finished.study.runs.len(), 4);
    let part = "A@dashpot.impedance";
    let rise = value(&finished.rows, "dashpot", "largest_rise", part);
    assert!(rise > 10.0, "{rise}");
    let again = commands::report(out.path(), None).unwrap();
    assert_eq!(again.studies[0].rows, finished.rows);
    let page = std::fs::read_to_string(&finished.study.report).unwrap();
    assert!(page.contains("dashpot.impedance=0.5") && page.contains("<svg"));
}

#[test]
fn axes_that_vary_nothing_are_refused() {
    let out = tempfile::tempdir().unwrap();
    let refused = |over: &[&str], methods: &[&str]| {
        let options = methods.iter().fold(column(out.path()), |o, m| o.method(m));
        let over: Vec<String> = over.iter().map(|text| (*text).to_owned()).collect();
        let error = commands::plan_sweep(&options, &over).unwrap_err();
        assert_eq!(error.exit_code(), exit::USAGE);
        error.to_string()
    };
    for (over, methods, part) in [
        (
            &["pml.thickness_m=5,10"][..],
            &["dashpot"][..],
            "no side uses that method",
        ),
        (&["pml.thicknes_m=5,10"], &["pml"], "thickness_m"),
        (&["grid.h_m=4..2:1"], &["pml"], "does not go up"),
        (&[], &["pml"], "needs --over"),
    ] {
        let error = refused(over, methods);
        assert!(error.contains(part), "{error}");
    }
}

/// The appendix has 72 runs at `quick`: shared points are solved once.
#[test]
fn the_appendix_is_planned_without_repeats() {
    let out = tempfile::tempdir().unwrap();
    let plan = commands::plan_sweep(&Options::new("appendix-a", out.path()), &[]).unwrap();
    let mut hashes: Vec<String> = plan
        .scenes
        .iter()
        .map(|scene| format!("{} {}", scene.method, scene.hash()))
        .collect();
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), plan.scenes.len());
    assert!(plan.left_out.is_empty(), "{:?}", plan.left_out);
    assert_eq!(plan.scenes.len(), 72);
}

/// In one dimension a dashpot is exact, so that nothing can be cheaper for 10 %; the extended mesh
/// costs more than it; and what the mesh itself leaves no method can be asked to beat.
#[test]
fn advice_in_a_column_is_the_dashpot() {
    let out = tempfile::tempdir().unwrap();
    let options = column(out.path()).method("dashpot").method("pml");
    let with_repeats = |repeats: usize| {
        let options = Options {
            repeats,
            ..options.clone()
        };
        commands::execute(commands::plan_tradeoff(&options).unwrap(), &options).unwrap()
    };
    let finished = with_repeats(1);
    let Some(Upshot::Tradeoff(study)) = &finished.study.upshot else {
        panic!("error was set against cost");
    };
    let ten = &study.advice[0];
    let of = |method: &str| {
        let found = ten.of_methods.iter().find(|(name, _)| name == method);
        found.and_then(|(_, at)| *at).map(|at| &study.trades[at])
    };
    let (dashpot, plain) = (of("dashpot").unwrap(), &study.trades[study.plain.unwrap()]);
    assert_eq!(dashpot.standing, Standing::Front);
    let relative = study.relative(dashpot).unwrap();
    println!("dashpot: {relative:.2} of the extended mesh's time");
    assert!(relative < 0.9 && plain.cpu_s > dashpot.cpu_s);
    assert!(dashpot.known.timing.is_some());
    assert!(study.advice.last().unwrap().below_floor);
    let hard = finished
        .rows
        .iter()
        .find(|row| row.method == "dashpot" && row.place == "echo<=0.001")
        .unwrap();
    assert!(
        hard.value.is_none() && hard.why.contains("floor"),
        "{}",
        hard.why
    );
    // Thicker layers leave less, until the mesh's own error is left.
    let echo = |cells: f64| {
        let label = format!("thickness_m={cells}");
        let found = study
            .trades
            .iter()
            .find(|t| t.method == "pml" && t.label == label);
        found.and_then(|t| t.echo).unwrap()
    };
    assert!(echo(2.0) > 2.0 * echo(5.0) && echo(5.0) > echo(10.0));
    let untimed = with_repeats(0);
    assert!(
        !untimed
            .rows
            .iter()
            .any(|row| row.metric == "timed_cpu_s" && row.value.is_none())
    );
}

/// The map of a finished study.
fn map(finished: &Finished) -> &Stability {
    match &finished.study.upshot {
        Some(Upshot::Stability(map)) => map,
        _ => panic!("all were driven to extremes"),
    }
}

/// How a method ended at an extreme.
fn outcome<'a>(finished: &'a Finished, method: &str, label: &str) -> &'a Outcome {
    let mut points = map(finished).parts.iter().flat_map(|part| &part.points);
    let point = points.find(|point| point.label == label);
    let point = point.unwrap_or_else(|| panic!("no extreme {label}"));
    point.outcome(method).unwrap()
}

/// Newmark's average acceleration with sides that only take energy away is stable at any step and any
/// material (analytic): no extreme may say otherwise, and all that fails says so with an error.
#[test]
fn what_theory_says_is_stable_is_stable_at_all_extremes() {
    let out = tempfile::tempdir().unwrap();
    let methods = ["fixed", "dashpot", "damping-layer", "pml"];
    let options = methods.iter().fold(column(out.path()), |o, m| o.method(m));
    let finished =
        commands::execute(commands::plan_stability(&options).unwrap(), &options).unwrap();
    let judged = |row: &&Row| row.verdict.is_some();
    let claims: Vec<&Row> = finished.rows.iter().filter(judged).collect();
    assert!(claims.len() > 60, "{} claims", claims.len());
    for row in &claims {
        let at = (&row.method, &row.place, &row.why);
        assert_eq!(row.verdict, Some(Verdict::Pass), "{at:?}");
    }
    for label in [
        "dt = 0.001 h/c_p",
        "dt = 100 h/c_p",
        "nu=0",
        "nu=0.4999",
        "aspect=0.05",
        "aspect=20",
        "frozen, gap=0.000000001",
        "frozen, gap=0.499999999",
        "moving, gap=0.000000001",
    ] {
        for method in ["fixed", "dashpot", "pml"] {
            let ended = outcome(&finished, method, label);
            assert!(
                matches!(ended, Outcome::Stable(_)),
                "{method}, {label}: {ended:?}"
            );
        }
    }
    let strong = outcome(&finished, "pml", "pml.reflection=0.000000000001");
    assert!(matches!(strong, Outcome::Stable(_)), "{strong:?}");
    assert_eq!(finished.exit_code(), exit::PASS);
    for step in &map(&finished).largest_steps {
        assert_eq!(
            (&step.value, step.tried),
            (&Ok(100.0), 100.0),
            "{}",
            step.method
        );
    }
    let spectra = &map(&finished).spectra;
    let of = |label: &str, method: &str| {
        let point = spectra.iter().find(|point| point.label == label).unwrap();
        let found = point.entries.iter().find(|(name, _)| name == method);
        found.map(|(_, opinion)| opinion.clone().unwrap())
    };
    assert_eq!(of("nu=0.25", "dashpot"), None, "it has no layer");
    for (label, grows) in [("nu=0.25", false), ("nu=0.49", false), ("nu=0.499", true)] {
        let opinion = of(label, "pml").unwrap();
        println!("{label}: {opinion:?}");
        assert_eq!(
            opinion.growth > 1e-6 && !opinion.is_rounding(),
            grows,
            "{label}"
        );
    }
    let rows = finished.rows.iter();
    let opinions = rows.filter(|row| row.metric == "largest_real_part" && row.method == "pml");
    assert_eq!(opinions.count(), 14);
}

/// What is known to grow is found: the true layer forced under flip, whose points filter what its
/// damping does not, and the published layer in nearly incompressible material, where its equations
/// are ill-posed beyond nu = 0.396; and the true layer itself beyond nu = 0.49, where its spectrum on a
/// mesh has growing modes as well (`operator.rs`). Neither grows where it must not.
#[test]
fn what_grows_is_found_and_what_is_refused_is_named() {
    let out = tempfile::tempdir().unwrap();
    let options = half_space(out.path()).method("pml").method("pml-stretched");
    let finished =
        commands::execute(commands::plan_stability(&options).unwrap(), &options).unwrap();
    for (method, label, grows) in [
        ("pml", "moving, flip (pml forced)", true),
        ("pml", "moving, affine", false),
        ("pml", "frozen, keep", false),
        ("pml", "nu=0.49", false),
        ("pml", "nu=0.4999", true),
        ("pml", "dt = 100 h/c_p", false),
        ("pml", "pml.thickness_m=40", false),
        ("pml", "16 a cell", false),
        ("pml", "bspline, consistent", false),
        ("pml-stretched", "nu=0.25", false),
        ("pml-stretched", "nu=0.49", true),
    ] {
        let ended = outcome(&finished, method, label);
        println!("{method}, {label}: {}", ended.long());
        match grows {
            true => assert!(
                matches!(ended, Outcome::Grows(_) | Outcome::Diverged(_)),
                "{method}, {label}: {ended:?}"
            ),
            false => assert!(
                matches!(ended, Outcome::Stable(_)),
                "{method}, {label}: {ended:?}"
            ),
        }
    }
    let all = map(&finished).parts.iter().flat_map(|part| &part.points);
    for (method, ended) in all.flat_map(|point| &point.outcomes) {
        assert!(!matches!(ended, Outcome::Open(_)), "{method}: {ended:?}");
        if let Outcome::Diverged(why) | Outcome::NotConverged(why) | Outcome::Refused(why) = ended {
            println!("{method}: {}", ended.long());
            let place = ["step", "t = ", ": "];
            assert!(place.iter().any(|word| why.contains(word)), "{why}");
        }
    }
}

/// S21's layer damps by the step: of its echoes at four steps the least is at the step that it was made for,
/// and shorter ones leave half as much again; as a rate it leaves the same at all (closed forms of both are
/// in `damping_form`).
#[test]
fn the_printed_layers_echo_depends_on_the_step_and_the_rates_does_not() {
    let out = tempfile::tempdir().unwrap();
    let options = Options::new("s21-layer/step", out.path()).profile("gate");
    let options = NARROW.iter().fold(options, |options, set| options.set(set));
    let plan = commands::plan_sweep(&options, &[]).unwrap();
    let rows = commands::execute(plan, &options).unwrap().rows;
    let echoes = |form: &str| {
        ["0.0127", "0.00636", "0.00318", "0.00159"].map(|dt| {
            let place = format!("A@damping-layer.form={form},time.dt_s={dt}");
            value(&rows, "damping-layer", "echo_ratio", &place)
        })
    };
    let (printed, rate) = (echoes("printed"), echoes("rate"));
    println!("printed {printed:.3?}, rate {rate:.3?}");
    assert!(printed[3] > 1.5 * printed[1]);
    assert!(rate.iter().all(|r| (r / rate[1] - 1.0).abs() < 0.05));
}
