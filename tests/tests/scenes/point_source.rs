//! Gates of the point source: its claims on the gate's scene, and its certified reference.
//!
//! The reference is the same scheme on the same mesh, so what is judged is the boundary alone
//! (evidence `certified`); that the reference is causally free is judged here as well.

#![allow(
    clippy::unwrap_used,
    reason = "a gate that cannot be set up has failed"
)]

use anechoic::certified::causality::serves_until;
use anechoic::certified::library::Library;
use anechoic::certified::solve::{compute, difference};
use anechoic::certified::{Certified, key};
use anechoic::commands::{
    Finished, Options, compare, plan_ablation, plan_compare, plan_run, reference,
};
use anechoic::error::exit;
use anechoic::posed::Posed;
use anechoic::prepare::{Prepared, Request, Target};
use anechoic_reference::claim::Evidence;
use anechoic_reports::row::{Row, Verdict};
use anechoic_tests::solved;

const CASE: &str = "point-source";

fn gate(method: &str, sets: &[&str]) -> Prepared {
    let request = Request {
        target: CASE.into(),
        profile: Some("gate".into()),
        sets: sets.iter().map(|set| (*set).to_owned()).collect(),
        ..Request::default()
    };
    let target = Target::find(&request).expect("the case exists");
    target.prepare(Some(method)).expect("the scene is well put")
}

fn extended() -> Posed {
    gate("fixed", &[])
        .scene
        .extended()
        .expect("it has no closed form")
}

fn shipped() -> Certified {
    let found = Library::shipped()
        .find(CASE, &extended())
        .expect("it is whole");
    found.expect("the gate's reference comes with the program")
}

/// The gate's comparison of standard run and `methods`, and whether it computed a reference.
fn compared(methods: &[&str], sets: &[&str]) -> (Finished, bool) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut options = Options::new(CASE, folder.path())
        .profile("gate")
        .method("fixed");
    for method in methods {
        options = options.method(method);
    }
    for set in sets {
        options = options.set(set);
    }
    let finished = compare(&options).expect("the comparison runs");
    (finished, folder.path().join("certified").exists())
}

fn verdicts(finished: &Finished) -> Vec<&Row> {
    finished
        .rows
        .iter()
        .filter(|row| row.verdict.is_some())
        .collect()
}

#[test]
fn the_claims_hold_on_the_gates_scene() {
    let (finished, computed) = compared(&["pml", "pml-20"], &[]);
    let claims = verdicts(&finished);
    assert_eq!(claims.len(), 6);
    for row in claims {
        println!("{} {} {:?}", row.method, row.place, row.value);
        assert_eq!(row.verdict, Some(Verdict::Pass), "{row:?}");
        assert_eq!(row.evidence, Evidence::Certified.name());
    }
    assert!(!computed, "the stored reference was not found by its hash");
    let ranking = finished.study.ranking.as_ref().unwrap();
    let order: Vec<&str> = ranking.methods.iter().map(|m| m.method.as_str()).collect();
    assert_eq!(order, ["pml-20", "pml", "fixed"]);
    // Far below what is ranked.
    assert!(ranking.floor.as_ref().unwrap().value < 1e-5);
}

#[test]
fn a_layer_with_a_side_missing_fails() {
    let (finished, _) = compared(&["pml"], &["boundary.right.method=fixed"]);
    let failed = |row: &&&Row| row.verdict == Some(Verdict::Fail);
    assert_eq!(verdicts(&finished).iter().filter(failed).count(), 3);
    assert_eq!(finished.exit_code(), 1);
}

#[test]
fn a_layer_a_cell_thinner_fails() {
    let (finished, _) = compared(&["pml"], &["pml.thickness_m=180"]);
    let claims = verdicts(&finished);
    for row in &claims {
        println!("9 cells: {} {:?}", row.place, row.value);
    }
    assert!(claims.iter().any(|row| row.verdict == Some(Verdict::Fail)));
}

#[test]
fn the_stored_reference_is_what_is_computed() {
    let (stored, again) = (shipped(), compute(CASE, &extended()).unwrap());
    assert_eq!(stored.about.hash, again.about.hash);
    assert_eq!(stored.about.hash, key::hash(&stored.about.problem));
    let change = difference(&again, &stored).expect("both have the same series");
    println!("recomputed: {change:.1e} of the peaks");
    assert!(change < 1e-8);
}

#[test]
fn a_reference_does_not_serve_after_its_time() {
    let about = shipped().about;
    about.serves(5.0).unwrap();
    let refusal = about.serves(5.2).unwrap_err();
    assert!(refusal.contains("serves until 5.000 s"), "{refusal}");
    // One whose far boundary is too near is refused for that, however long its series are.
    let near = anechoic::certified::About {
        serves_until_s: 4.0,
        ..about
    };
    let refusal = near.serves(5.0).unwrap_err();
    assert!(refusal.contains("far boundary"), "{refusal}");
}

#[test]
fn nothing_comes_back_before_the_certificate_says() {
    // The standard run is an extended domain of 1000 m: equal to the reference until it is not.
    let problem = gate("fixed", &[]).scene.posed().plane().unwrap();
    let until = serves_until(&problem).unwrap();
    let mut short = problem.clone();
    short.end_time = until + 1.5;
    let record = solved(&short);
    let reference = shipped();
    let (mut before, mut after, mut peak) = (0.0_f64, 0.0_f64, 0.0_f64);
    for column in &reference.receivers.columns {
        let mine = record.receivers.column(&column.name).unwrap();
        for ((t, x), y) in record.receivers.times.iter().zip(mine).zip(&column.values) {
            let share = if *t <= until { &mut before } else { &mut after };
            *share = share.max((x - y).abs());
            peak = peak.max(y.abs());
        }
    }
    println!(
        "until {until:.2} s {:.1e}, after it {:.1e} of the peak",
        before / peak,
        after / peak
    );
    // The stored series have nine digits.
    assert!(before < 1e-8 * peak, "{:e}", before / peak);
    assert!(after > 1e-3 * peak, "{:e}", after / peak);
}

fn planned(methods: &[&str], presets: &[&str], sets: &[&str]) -> Options {
    let mut options = Options::new(CASE, std::path::Path::new("unused"));
    options.request.presets = presets.iter().map(|name| (*name).to_owned()).collect();
    options.request.sets = sets.iter().map(|set| (*set).to_owned()).collect();
    options.methods = methods.iter().map(|name| (*name).to_owned()).collect();
    options
}

#[test]
fn a_comparison_leaves_out_what_is_dear_or_does_not_apply() {
    let names = |options: &Options| {
        let plan = plan_compare(options).unwrap();
        let names: Vec<String> = plan.scenes.iter().map(|s| s.method.clone()).collect();
        (names, plan.left_out.len())
    };
    let usual = [
        "fixed",
        "dashpot",
        "damping-layer",
        "pml-stretched",
        "pml",
        "pml-20",
        "pml-50",
    ];
    assert_eq!(
        names(&planned(&[], &[], &[])),
        (usual.map(String::from).to_vec(), 0)
    );
    // Plain flip is refused by the true layers; asked for by name, that is an error.
    let flip = planned(&[], &["paper-transfer"], &[]);
    assert_eq!(
        names(&flip),
        (usual[..4].iter().map(|n| (*n).to_owned()).collect(), 3)
    );
    let named = plan_compare(&planned(&["pml"], &["paper-transfer"], &[])).unwrap_err();
    assert!(named.to_string().contains("with_flip"), "{named}");
}

#[test]
fn sides_are_named_by_their_parameters() {
    let name = |sets: &[&str]| {
        plan_run(&planned(&[], &[], sets)).unwrap().scenes[0]
            .method
            .clone()
    };
    assert_eq!(name(&[]), "pml");
    assert_eq!(name(&["pml.thickness_m=400"]), "pml-20");
    // No preset is that thick; the method's own name is left.
    assert_eq!(name(&["pml.thickness_m=300"]), "pml");
    let plan = plan_run(&planned(&["fixed"], &[], &[])).unwrap();
    assert_eq!(plan.scenes[0].scene.boundary().left.method, "extended");
}

#[test]
fn fields_at_fault_are_named() {
    for (set, part) in [
        (
            "source.x_m=5000",
            "source.x_m: the source at 5000 m lies outside the mesh",
        ),
        ("t1_s=10", "t1_s: no time is left for echoes"),
        (
            "target.x_max_m=900",
            "target.x_max_m: 900 m is not right of",
        ),
        ("receivers.C3.y_m=20", "receiver C3 at 20 m lies outside"),
        (
            "source.direction=down",
            "allowed: \"vertical\", \"horizontal\"",
        ),
    ] {
        let error = plan_run(&planned(&[], &[], &[set])).unwrap_err();
        assert_eq!(error.exit_code(), exit::USAGE);
        assert!(error.to_string().contains(part), "{error}");
    }
}

#[test]
fn closed_forms_need_neither_ablation_nor_reference() {
    let mut options = planned(&[], &[], &[]);
    options.request.target = "compression-1d".into();
    let error = plan_ablation(&options).unwrap_err();
    assert!(error.to_string().contains(CASE), "{error}");
    let folder = tempfile::tempdir().unwrap();
    let error = reference(&options.request, folder.path()).unwrap_err();
    assert_eq!(error.exit_code(), exit::USAGE);
}
