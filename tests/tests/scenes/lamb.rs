//! What is promised of the scene `lamb`: the solver against a closed form that shares nothing with it.
//! The gate's scene under both directions of the force; what is wrong by 2 % fails; a scene of the
//! user's own, with everything changed, is solved and judged.

use anechoic::commands::{Finished, Options, compare, converge, plan_run, run};
use anechoic::error::exit;
use anechoic::judge::judge_runs;
use anechoic::judge::references::References;
use anechoic::over::Over;
use anechoic::prepare::Request;
use anechoic::scene::Role;
use anechoic_reports::row::{Row, Verdict};
use anechoic_solver::problem::Problem;
use anechoic_tests::study::{altered, claims, failing, print_claims, value};
use tempfile::TempDir;

const CASE: &str = "lamb";

fn folder() -> TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

fn gate(out: &TempDir) -> Options {
    Options::new(CASE, out.path()).profile("gate")
}

/// Solves and insists that every claim was judged and holds.
#[track_caller]
fn all_pass(finished: &Finished, claimed: usize) {
    print_claims(&finished.rows);
    assert_eq!(claims(&finished.rows).count(), claimed);
    assert_eq!(failing(&finished.rows), [""; 0]);
    assert_eq!(finished.exit_code(), exit::PASS);
    for row in claims(&finished.rows) {
        assert_eq!(row.verdict, Some(Verdict::Pass), "{}", row.why);
        assert_eq!(
            (row.evidence.as_str(), row.reference.as_str()),
            ("analytic", CASE)
        );
    }
}

#[test]
fn a_vertical_force_moves_the_half_space_as_lamb_says() {
    let out = folder();
    let finished = run(&gate(&out)).unwrap_or_else(|error| panic!("{error}"));
    all_pass(&finished, 3);
    // The run is a half-space until its end, and no longer than that.
    let until = value(&finished.rows, "extended", "serves_until_s", "run");
    assert!((1.6..1.64).contains(&until), "{until}");
    // The bound is of the size of what is measured, or a mistake of that size would pass.
    let worst = value(&finished.rows, "extended", "peak_error", "R:worst");
    assert!(worst > 0.1, "{worst}");
}

#[test]
fn a_horizontal_force_moves_the_half_space_as_lamb_says() {
    let out = folder();
    let mut options = gate(&out);
    options.request.presets = vec!["horizontal".into()];
    let finished = run(&options).unwrap_or_else(|error| panic!("{error}"));
    all_pass(&finished, 3);
}

#[test]
fn smooth_functions_hardly_disperse() {
    let worst = |presets: &[&str]| {
        let out = folder();
        let mut options = gate(&out);
        options.request.presets = presets.iter().map(|p| (*p).to_owned()).collect();
        let finished = run(&options).unwrap_or_else(|error| panic!("{error}"));
        all_pass(&finished, 3);
        value(&finished.rows, "extended", "peak_error", "R:worst")
    };
    let (linear, bspline) = (worst(&[]), worst(&["bspline"]));
    println!("peak error at the worst receiver: linear {linear:.3}, bspline {bspline:.3}");
    assert!(bspline < 0.6 * linear);
}

/// Claims that fail when the record is that of a problem that `change` has altered.
fn failing_when(change: impl Fn(&mut Problem<2>)) -> Vec<String> {
    let request = Request {
        target: CASE.to_owned(),
        profile: Some("gate".to_owned()),
        ..Request::default()
    };
    let run = altered(&request, None, change);
    failing(&judge_runs(&[&run], &References::default()).rows)
}

#[test]
fn material_off_by_two_per_cent_fails() {
    let softer = failing_when(|problem| problem.material.youngs_modulus *= 0.98);
    println!("E off by 2 %: {softer:?}");
    assert!(softer.contains(&"extended/peak_error/R1".to_owned()));
    let heavier = failing_when(|problem| problem.material.density *= 1.02);
    assert!(heavier.contains(&"extended/peak_error/R1".to_owned()));
}

#[test]
fn another_poissons_ratio_fails() {
    let failing = failing_when(|problem| problem.material.poissons_ratio = 0.3);
    println!("nu = 0.3: {failing:?}");
    assert_eq!(failing.len(), 3);
}

#[test]
fn a_force_the_other_way_fails() {
    let turn = |direction: [f64; 2]| {
        failing_when(move |problem| {
            for drive in &mut problem.drives {
                if let anechoic_solver::problem::Drive::PointForce { direction: d, .. } = drive {
                    *d = direction;
                }
            }
        })
    };
    assert_eq!(turn([0.0, 1.0]).len(), 3);
    assert_eq!(turn([1.0, 0.0]).len(), 3);
}

#[test]
fn a_mesh_that_ends_early_is_no_half_space() {
    let out = folder();
    let options = gate(&out).set("extended.thickness_m=50");
    let finished = run(&options).unwrap_or_else(|error| panic!("{error}"));
    // Its echo is there, and counts as what it is.
    assert_eq!(failing(&finished.rows).len(), 3);
    let scene = &finished.study.runs[0].prepared.scene;
    let roles = |times: &[f64]| -> Vec<Role> {
        let references = scene.references(times).expect("the top is free");
        references.iter().map(|reference| reference.role).collect()
    };
    assert_eq!(roles(&[0.0, 1.0]), [Role::NoEcho]);
}

#[test]
fn methods_are_judged_against_lamb_itself() {
    let out = folder();
    let finished = compare(&gate(&out)).unwrap_or_else(|error| panic!("{error}"));
    // The layer passes for a half-space as well as the mesh without an end.
    all_pass(&finished, 6);
    let peak = |method| value(&finished.rows, method, "peak_error", "R:worst");
    assert!((peak("pml") / peak("extended") - 1.0).abs() < 0.02);
    assert!(peak("dashpot") > 0.4 && peak("fixed") > 2.0);
    let ranking = finished
        .study
        .ranking
        .as_ref()
        .expect("methods were compared");
    let order: Vec<&str> = ranking.methods.iter().map(|m| m.method.as_str()).collect();
    assert_eq!(
        order,
        ["extended", "pml", "damping-layer", "dashpot", "fixed"]
    );
}

/// Another soil, a force elsewhere and to the right, another wavelet, receivers on both sides of it.
const MY_SCENE: &str = r#"
case = "lamb"
profile = "quick"
t1_s = 0.4
target = { x_min_m = -60.0, x_max_m = 160.0, depth_m = 100.0 }
grid = { h_m = 2.5 }
time.end_s = 0.6
material = { E_Pa = 300e6, nu = 0.35, rho_kg_m3 = 1800.0 }

[source]
x_m = 40.0
direction = "horizontal"
wavelet = "half-sine"
frequency_Hz = 5.0
amplitude_N_m = 2e4

[[receivers]]
name = "left"
x_m = -20.0
y_m = 0.0

[[receivers]]
name = "right"
x_m = 120.0
y_m = -30.0

[[receivers]]
name = "below"
x_m = 40.0
y_m = -70.0
"#;

/// Solves the file, after `change` has had its way with its text.
fn mine(change: &[(&str, &str)]) -> Result<Finished, String> {
    let out = folder();
    let path = out.path().join("my.toml");
    let mut text = MY_SCENE.to_owned();
    for (from, to) in change {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    std::fs::write(&path, text).expect("a file");
    let options = Options::new(&path.display().to_string(), &out.path().join("results"));
    run(&options).map_err(|error| error.to_string())
}

#[test]
fn a_scene_of_the_users_own_is_solved_and_judged() {
    let finished = mine(&[]).unwrap_or_else(|error| panic!("{error}"));
    all_pass(&finished, 3);
    let left = |finished: &Finished, metric: &str| {
        let mut rows = finished.rows.iter();
        let row = rows.find(|row| row.metric == metric && row.place == "right");
        row.and_then(|row| row.value)
    };
    // A net impulse leaves a drift, and no settlement.
    assert!(left(&finished, "drift_error").is_some_and(|error| error < 0.05));
    assert_eq!(left(&finished, "settlement_error"), None);
    // A force that stays on is Lamb's as well.
    let finished = mine(&[("\"half-sine\"", "\"step\"")]);
    let finished = finished.unwrap_or_else(|error| panic!("{error}"));
    all_pass(&finished, 3);
    println!("settlement {:?}", left(&finished, "settlement_error"));
    assert!(left(&finished, "settlement_error").is_some_and(|error| error < 0.05));
    assert_eq!(left(&finished, "drift_error"), None);
    // Another wavelet and the other direction, without a line of code.
    for (wavelet, direction) in [
        ("\"sine-squared\"", "\"vertical\""),
        ("\"ricker\"\nt0_s = 0.28", "\"horizontal\""),
    ] {
        let finished = mine(&[("\"half-sine\"", wavelet), ("\"horizontal\"", direction)]);
        all_pass(&finished.unwrap_or_else(|error| panic!("{error}")), 3);
    }
}

#[test]
fn what_lamb_does_not_solve_is_refused_by_name() {
    for (from, to, part) in [
        (
            "x_m = 120.0",
            "x_m = 170.0",
            "receiver right at 170 m lies outside the mesh",
        ),
        (
            "x_m = 40.0\ndirection",
            "x_m = 40.0\ny_m = -10.0\ndirection",
            "source.y_m: -10 m is not on the surface",
        ),
        ("y_m = -70.0", "y_m = 0.0", "receiver below is at the force"),
        (
            "\"half-sine\"",
            "\"ricker\"\nt0_s = 0.1",
            "source.t0_s: the wavelet starts with a jump",
        ),
        ("end_s = 0.6", "end_s = 0.05", "the pulse lasts 0.1 s"),
    ] {
        let error = mine(&[(from, to)]).expect_err("refused");
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn what_is_not_claimed_says_why() {
    let why = |sets: &[&str]| {
        let options = sets.iter().fold(
            Options::new(CASE, std::path::Path::new("unused")),
            |o, s| o.set(s),
        );
        let plan = plan_run(&options).unwrap_or_else(|error| panic!("{error}"));
        let claims = plan.scenes[0].scene.claims();
        let reasons: Vec<String> = claims.into_iter().filter_map(|c| c.not_here).collect();
        reasons.first().cloned().unwrap_or_default()
    };
    assert_eq!(why(&[]), "");
    for (sets, part) in [
        (
            &["points.mode=moving", "points.transfer=flip"][..],
            "reported, not judged",
        ),
        (
            &[
                "points.mode=moving",
                "points.transfer=affine",
                "source.amplitude_N_m=1e9",
            ],
            "finite",
        ),
        (&["grid.h_m=40"], "too coarse for a bound"),
        (&["receivers.R1.x_m=30"], "cells from the force"),
    ] {
        assert!(why(sets).contains(part), "{sets:?}: {}", why(sets));
    }
    // Without a free surface there is no such problem.
    let out = folder();
    let finished = run(&gate(&out).set("boundary.top.method=fixed").method("pml"));
    let finished = finished.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(finished.exit_code(), exit::REFERENCE_MISSING);
    let missing = finished.study.reference_missing.expect("there is none");
    assert!(missing.contains("boundary.top = free"), "{missing}");
}

#[test]
fn errors_fall_with_the_second_order() {
    let out = folder();
    let over = Over::parse("grid.h_m=20,10").expect("levels");
    let finished = converge(&gate(&out), &[over], false);
    let finished = finished.unwrap_or_else(|error| panic!("{error}"));
    all_pass(&finished, 3);
    let orders: Vec<&Row> = claims(&finished.rows).collect();
    assert!(orders.iter().all(|row| row.metric == "order"));
    // The step follows the cells, or the error in time would stay.
    let steps = |level: &str| {
        value(
            &finished.rows,
            "extended",
            "steps",
            &format!("run@grid.h_m={level}"),
        )
    };
    assert_eq!((steps("20"), steps("10")), (160.0, 320.0));
}
