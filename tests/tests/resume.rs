//! Studies that are interrupted and gone on with: the same bits as without the interruption.
#![cfg(unix)]

use anechoic_tests::program::{anechoic, binary, folder, narrow, read, rows, run_folder, wait_for};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

const CASE: &str = "compression-1d";

const METHODS: [&str; 5] = ["fixed", "dashpot", "damping-layer", "pml", "extended"];

/// What a machine spends is not a result.
const COSTS: [&str; 3] = ["cpu_s", "wall_s", "us_per_point_step"];

fn results(folder: &Path) -> PathBuf {
    folder.join("results")
}

fn started(folder: &Path, arguments: &[&str]) -> Child {
    Command::new(binary())
        .current_dir(folder)
        .args(narrow(arguments))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts")
}

/// Everything that must not depend on an interruption: records and rows, without what a machine spends.
fn bits(folder: &Path) -> Vec<(String, String)> {
    let mut bits = Vec::new();
    for method in METHODS {
        let run = run_folder(&results(folder), method);
        for name in ["receivers.csv", "energy.csv", "record.json", "scene.toml"] {
            bits.push((format!("{method}/{name}"), read(&run.join(name))));
        }
    }
    let summary = rows(&read(&results(folder).join(CASE).join("summary.json")));
    let kept = |row: &&Value| !COSTS.iter().any(|cost| row["metric"] == *cost);
    let rows: Vec<String> = summary.iter().filter(kept).map(Value::to_string).collect();
    bits.push(("summary.json".into(), rows.join("\n")));
    bits
}

#[track_caller]
fn same_bits(a: &Path, b: &Path) {
    for ((name, a), (_, b)) in bits(a).iter().zip(&bits(b)) {
        assert!(a == b, "{name} differs");
    }
}

/// What would be done, as METHOD -> ACTION.
fn planned(folder: &Path, how: &str) -> Vec<(String, String)> {
    let arguments = ["compare", CASE, how, "--dry-run", "--format", "json"];
    let output = anechoic(folder, &narrow(&arguments));
    assert_eq!(output.code, 0, "{}", output.err);
    let text = |value: &Value| value.as_str().expect("a word").to_owned();
    rows(&output.out)
        .iter()
        .map(|run| (text(&run["method"]), text(&run["action"])))
        .collect()
}

#[test]
fn a_killed_study_goes_on_to_the_same_bits() {
    let whole = folder();
    let output = anechoic(whole.path(), &narrow(&["compare", CASE, "--jobs", "1"]));
    assert_eq!(output.code, 0, "{}", output.err);

    let interrupted = folder();
    let root = interrupted.path();
    let case = results(root).join(CASE);
    // Before the first run, after each, and while the report is made.
    let places = [
        "study.json",
        "fixed",
        "dashpot",
        "damping-layer",
        "pml",
        "extended",
    ];
    for (done, place) in places.iter().enumerate() {
        let mut child = started(root, &["compare", CASE, "--jobs", "1", "--resume"]);
        wait_for(&case.join(place), &mut child);
        // A folder of a method comes before its record is in it.
        if done > 0 {
            std::thread::sleep(Duration::from_millis(20));
        }
        child.kill().expect("it is killed");
        child.wait().expect("it is gone");
        let taken: Vec<String> = planned(root, "--resume")
            .into_iter()
            .filter_map(|(method, action)| (action == "take from disk").then_some(method))
            .collect();
        // The run that was being written may be whole or not; those before it are.
        let sure = done.saturating_sub(1);
        assert!(taken.len() >= sure, "{place}: {taken:?}");
        assert_eq!(taken, METHODS[..taken.len()], "{place}");
    }
    // What a kill within a write leaves.
    let left = case.join("dashpot/.unfinished-killed");
    std::fs::create_dir(&left).expect("a folder");
    std::fs::write(left.join("scene.toml"), "case = ").expect("written");
    std::fs::write(case.join("summary.json.partial"), "[{").expect("written");
    let manifest = || read(&run_folder(&results(root), "fixed").join("manifest.json"));
    let before = manifest();
    let output = anechoic(root, &narrow(&["compare", CASE, "--jobs", "2", "--resume"]));
    assert_eq!(output.code, 0, "{}", output.err);
    assert_eq!(manifest(), before, "what was whole is not solved again");
    assert!(!left.exists());
    same_bits(root, whole.path());
    // The study is the one of the command without --resume, and its report is made again from it.
    let study = read(&case.join("study.json"));
    assert!(!study.contains("--resume"), "{study}");
    let summary = read(&case.join("summary.json"));
    assert_eq!(anechoic(root, &["report", "results"]).code, 0);
    assert_eq!(read(&case.join("summary.json")), summary);
}

#[test]
fn what_is_finished_of_a_killed_study_can_be_shown() {
    let folder = folder();
    let case = results(folder.path()).join(CASE);
    let long = [
        "compare",
        CASE,
        "--jobs",
        "1",
        "--set",
        "extended.thickness_m=100000",
    ];
    let mut child = started(folder.path(), &long);
    wait_for(&case.join("extended").with_file_name("pml"), &mut child);
    std::thread::sleep(Duration::from_millis(300));
    child.kill().expect("it is killed");
    child.wait().expect("it is gone");
    let output = anechoic(folder.path(), &["report", "results"]);
    assert_eq!(output.code, 3, "{}", output.err);
    assert!(output.err.contains("extended") && output.err.contains("missing"));
    assert!(output.out.contains("dashpot"), "{}", output.out);
    assert!(case.join("report.html").is_file());
}

#[test]
fn damaged_and_missing_runs_are_solved_again_and_no_others() {
    let whole = folder();
    let compare = narrow(&["compare", CASE]);
    assert_eq!(anechoic(whole.path(), &compare).code, 0);
    let root = whole.path();
    let run = |method: &str| run_folder(&results(root), method);
    let series = run("dashpot").join("receivers.csv");
    let text = read(&series);
    std::fs::write(&series, &text[..text.len() / 2]).expect("written");
    std::fs::remove_dir_all(run("pml").parent().expect("a folder")).expect("it was there");
    let action = |plan: &[(String, String)], method: &str| {
        let found = plan.iter().find(|(known, _)| known == method);
        found.expect("planned").1.clone()
    };
    let plan = planned(root, "--resume");
    for (method, expected) in [
        ("fixed", "take from disk"),
        ("dashpot", "solve"),
        ("damping-layer", "take from disk"),
        ("pml", "solve"),
    ] {
        assert_eq!(action(&plan, method), expected, "{method}");
    }
    // --failed: what is damaged is solved, what was never made is left out and named.
    let plan = planned(root, "--failed");
    assert_eq!(action(&plan, "dashpot"), "solve");
    assert_eq!(action(&plan, "pml"), "leave out");
    let output = anechoic(root, &narrow(&["compare", CASE, "--failed"]));
    assert!(output.err.contains("pml is left out"), "{}", output.err);
    assert!(!results(root).join(CASE).join("pml").exists());
    assert_eq!(read(&series), text);
    // --resume brings it back.
    let output = anechoic(root, &narrow(&["compare", CASE, "--resume"]));
    assert_eq!(output.code, 0, "{}", output.err);
    assert!(run("pml").join("receivers.csv").is_file());
}

#[test]
fn only_what_was_stopped_is_solved_again() {
    let folder = folder();
    let root = folder.path();
    // Long enough to be stopped, short enough to be solved.
    let compare = [
        "compare",
        CASE,
        "--jobs",
        "1",
        "--set",
        "extended.thickness_m=1500",
    ];
    let mut child = started(root, &compare);
    wait_for(&results(root).join(CASE).join("pml"), &mut child);
    std::thread::sleep(Duration::from_millis(50));
    let interrupted = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("kill runs");
    assert!(interrupted.success());
    assert_eq!(child.wait().expect("it ends").code(), Some(3));
    let manifest = |method: &str| read(&run_folder(&results(root), method).join("manifest.json"));
    let before: Vec<String> = METHODS.iter().map(|method| manifest(method)).collect();
    assert!(before[4].contains("\"cancelled\""));
    let output = anechoic(root, &narrow(&[&compare[..], &["--failed"]].concat()));
    assert_eq!(output.code, 0, "{}{}", output.err, output.out);
    let after: Vec<String> = METHODS.iter().map(|method| manifest(method)).collect();
    assert_eq!(before[..4], after[..4]);
    assert!(after[4].contains("\"complete\""));
}

#[test]
fn the_two_ways_exclude_each_other_and_failed_needs_something_stored() {
    let folder = folder();
    let output = anechoic(folder.path(), &["run", CASE, "--resume", "--failed"]);
    assert_eq!(output.code, 2, "{}", output.err);
    let output = anechoic(folder.path(), &narrow(&["compare", CASE, "--failed"]));
    assert_eq!(output.code, 2, "{}", output.err);
    assert!(output.err.contains("without --failed"), "{}", output.err);
}

/// A half-space whose certified reference does not come with the program: seconds of work.
const CHANGED: [&str; 12] = [
    "compare",
    "point-source",
    "--profile",
    "gate",
    "--method",
    "fixed",
    "--method",
    "dashpot",
    "--set",
    "material.nu=0.3",
    "--set",
    "grid.h_m=50",
];

/// The main table of the only certified reference, without the lines that tell what it cost.
fn certified(root: &Path) -> Option<String> {
    let entries = std::fs::read_dir(results(root).join("certified")).ok()?;
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.retain(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        name.ends_with(".csv") && !name.ends_with("-energy.csv") && !name.ends_with("-fields.csv")
    });
    assert!(paths.len() <= 1, "{paths:?}");
    let text = read(paths.first()?);
    let costs = ["# cpu_s", "# wall_s"];
    let kept = text
        .lines()
        .filter(|line| !costs.iter().any(|cost| line.starts_with(cost)));
    Some(kept.collect::<Vec<_>>().join("\n"))
}

#[test]
fn a_kill_while_the_reference_is_computed_leaves_no_half_of_it() {
    let whole = folder();
    let output = anechoic(whole.path(), &CHANGED);
    assert!(output.code != 2 && output.code != 3, "{}", output.err);
    let expected = certified(whole.path()).expect("it was computed");

    let interrupted = folder();
    let root = interrupted.path();
    let mut child = Command::new(binary())
        .current_dir(root)
        .args(CHANGED)
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    wait_for(&results(root), &mut child);
    std::thread::sleep(Duration::from_millis(200));
    child.kill().expect("it is killed");
    child.wait().expect("it is gone");
    assert!(certified(root).is_none_or(|table| table == expected));
    // A kill within the writes: the parts come first, the table that is looked for last.
    let folder = results(root).join("certified");
    std::fs::create_dir_all(&folder).expect("a folder");
    let mut names: Vec<PathBuf> = std::fs::read_dir(results(whole.path()).join("certified"))
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    names.sort();
    for path in &names {
        let name = path
            .file_name()
            .expect("a name")
            .to_string_lossy()
            .into_owned();
        let half = read(path)[..2000].to_owned();
        let part = name.contains("-energy") || name.contains("-fields");
        let left = if part {
            name
        } else {
            format!("{name}.partial")
        };
        std::fs::write(folder.join(left), half).expect("written");
    }
    let output = anechoic(root, &[&CHANGED[..], &["--resume"]].concat());
    assert!(output.code != 2 && output.code != 3, "{}", output.err);
    assert_eq!(certified(root).as_deref(), Some(expected.as_str()));

    // One that was cut short afterwards is not taken for the truth.
    let table = names.iter().find(|path| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        !name.contains("-energy") && !name.contains("-fields")
    });
    let table = folder.join(table.and_then(|path| path.file_name()).expect("a table"));
    let text = read(&table);
    let cut = text[..text.len() * 3 / 4].rfind('\n').expect("lines") + 1;
    std::fs::write(&table, &text[..cut]).expect("written");
    let output = anechoic(root, &[&CHANGED[..], &["--resume"]].concat());
    assert_eq!(output.code, 2, "{}", output.err);
    for word in ["results/certified", "cut short", "without the file"] {
        assert!(
            output.err.contains(word),
            "{word} is missing in {}",
            output.err
        );
    }
    let output = anechoic(root, &["report", "results"]);
    assert!(
        output.err.contains("no reference") && output.err.contains("cut short"),
        "{}",
        output.err
    );
}

#[test]
fn an_ablation_is_gone_on_with_in_its_own_folder() {
    let folder = folder();
    let plan = [
        "ablation",
        "point-source",
        "--profile",
        "gate",
        "--resume",
        "--dry-run",
        "--format",
        "json",
    ];
    let output = anechoic(folder.path(), &plan);
    assert_eq!(output.code, 0, "{}", output.err);
    let runs = rows(&output.out);
    assert!(runs.len() > 5);
    for run in runs {
        assert_eq!(
            (run["action"].as_str(), run["why"].as_str()),
            (Some("solve"), Some("it is missing"))
        );
        let folder = run["folder"].as_str().expect("a path");
        assert!(folder.contains("point-source-ablation"), "{folder}");
    }
}
