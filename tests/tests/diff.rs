//! `anechoic diff`: what changed from one results folder, study or run to another.

use anechoic_tests::program::{Output, anechoic, folder, narrow, read, rows, run_folder};
use std::path::Path;

const CASE: &str = "compression-1d";

/// Solves with fixed and dashpot into a results folder.
fn solved(folder: &Path, out: &str, more: &[&str]) {
    let arguments = [
        "compare", CASE, "--method", "fixed", "--method", "dashpot", "--out", out,
    ];
    let output = anechoic(folder, &narrow(&[&arguments[..], more].concat()));
    assert!(output.code <= 1, "{}", output.err);
}

#[track_caller]
fn diff(folder: &Path, arguments: &[&str], code: i32) -> Output {
    let output = anechoic(folder, &[&["diff"], arguments].concat());
    assert_eq!(output.code, code, "{}{}", output.err, output.out);
    output
}

#[test]
fn the_same_program_gives_the_same_numbers_and_other_costs() {
    let folder = folder();
    solved(folder.path(), "a", &[]);
    solved(folder.path(), "b", &["--jobs", "2"]);
    let output = diff(folder.path(), &["a", "b", "--rel-tol", "0"], 0);
    assert!(output.out.contains("0 moved beyond 0e0"), "{}", output.out);
    assert!(
        output.out.contains("cpu_s"),
        "costs are listed: {}",
        output.out
    );
    // The same through studies, and through files of rows.
    let [a, b] = ["a", "b"].map(|out| format!("{out}/{CASE}"));
    diff(folder.path(), &[&a, &b, "--rel-tol", "0"], 0);
    let files = [&a, &b].map(|study| format!("{study}/summary.json"));
    diff(folder.path(), &[&files[0], &files[1], "--rel-tol", "0"], 0);
}

#[test]
fn a_worse_boundary_moves_numbers_and_verdicts() {
    let folder = folder();
    solved(folder.path(), "a", &[]);
    solved(folder.path(), "b", &["--set", "dashpot.impedance=0.5"]);
    let output = diff(folder.path(), &["a", "b", "--format", "json"], 1);
    let changes = rows(&output.out);
    let of = |kind: &str, method: &str| {
        let found = changes
            .iter()
            .filter(|c| c["change"] == kind && c["method"] == method);
        found.count()
    };
    assert!(of("verdict", "dashpot") >= 2 && of("moved", "dashpot") > 10);
    assert_eq!(of("moved", "fixed") + of("verdict", "fixed"), 0);
    let worse = changes
        .iter()
        .find(|c| c["change"] == "verdict")
        .expect("one");
    assert_eq!(worse["verdict_before"], "pass");
    assert_eq!(worse["verdict_after"], "fail");
    assert_eq!(worse["study"], CASE);
    // A tolerance that takes everything leaves the verdicts.
    let output = diff(folder.path(), &["a", "b", "--rel-tol", "1"], 1);
    assert!(
        output.out.contains("3 verdicts and 0 bounds"),
        "{}",
        output.out
    );
    // Runs: one on each side, whatever their methods are called.
    let run = |out: &str, method| {
        run_folder(&folder.path().join(out), method)
            .display()
            .to_string()
    };
    let output = diff(
        folder.path(),
        &[&run("a", "dashpot"), &run("b", "dashpot")],
        1,
    );
    assert!(output.out.contains("echo_ratio"), "{}", output.out);
    diff(folder.path(), &[&run("a", "fixed"), &run("b", "fixed")], 0);
    let other = diff(
        folder.path(),
        &[&run("a", "fixed"), &run("a", "dashpot")],
        1,
    );
    assert!(other.out.contains("echo_ratio"), "{}", other.out);
}

#[test]
fn rows_that_are_gone_are_told() {
    let folder = folder();
    solved(folder.path(), "a", &[]);
    let fewer = [
        "compare", CASE, "--method", "fixed", "--method", "dashpot", "--method", "extended",
        "--out", "b",
    ];
    assert_eq!(anechoic(folder.path(), &narrow(&fewer)).code, 0);
    let output = diff(folder.path(), &["a", "b"], 1);
    assert!(
        output.out.contains("new") && output.out.contains("extended"),
        "{}",
        output.out
    );
    let output = diff(folder.path(), &["b", "a"], 1);
    assert!(
        output.out.contains("0 new") && output.out.contains("gone"),
        "{}",
        output.out
    );
}

#[test]
fn what_is_not_alike_is_usage_and_what_is_broken_is_named() {
    let folder = folder();
    solved(folder.path(), "a", &[]);
    let study = format!("a/{CASE}");
    diff(folder.path(), &["a", "absent"], 2);
    diff(folder.path(), &["a", &study], 2);
    diff(folder.path(), &["a", "a", "--rel-tol", "-1"], 2);
    std::fs::create_dir(folder.path().join("empty")).expect("a folder");
    diff(folder.path(), &["a", "empty"], 2);
    let other = format!("{study}/study.json");
    let output = diff(folder.path(), &[&other, &other], 2);
    assert!(output.err.contains("holds no rows"), "{}", output.err);
    let summary = folder.path().join(&study).join("summary.json");
    let text = read(&summary);
    std::fs::write(&summary, &text[..text.len() / 2]).expect("written");
    let output = diff(folder.path(), &["a", "a"], 3);
    assert!(
        output.err.contains("summary.json") && output.err.contains("line"),
        "{}",
        output.err
    );
}
