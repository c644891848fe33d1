//! The program as it is typed: what it prints, what lies in the results folder, that the same input
//! leads to the same place.

use anechoic_tests::program::{NARROW, Output, anechoic, folder, narrow, read, rows, run_folder};
use serde_json::Value;
use std::path::Path;

const CASE: &str = "compression-1d";

/// Calls the program and insists on exit code 0.
#[track_caller]
fn passes(folder: &Path, arguments: &[&str]) -> Output {
    let output = anechoic(folder, arguments);
    assert_eq!(
        output.code, 0,
        "{arguments:?}: {}{}",
        output.err, output.out
    );
    output
}

/// The `scene` of `show --format json`.
fn shown(folder: &Path, arguments: &[&str]) -> Value {
    let arguments = [&["show"], arguments, &["--format", "json"]].concat();
    let output = passes(folder, &arguments);
    serde_json::from_str(&output.out).expect("JSON")
}

#[test]
fn alone_it_says_what_it_is_and_what_to_type_next() {
    let folder = folder();
    let output = passes(folder.path(), &[]);
    assert!(output.out.contains("measures how much echo"));
    assert!(output.out.contains("anechoic compare compression-1d"));
    let output = passes(folder.path(), &["--help"]);
    assert!(output.out.contains("Examples:") && output.out.contains("Exit codes:"));
}

#[test]
fn list_names_cases_and_methods() {
    let folder = folder();
    let text = passes(folder.path(), &["list"]).out;
    for word in [
        CASE,
        "gate",
        "quick",
        "paper",
        "linear",
        "dashpot",
        "damping-layer",
        "pml",
    ] {
        assert!(text.contains(word), "{word} is missing in {text}");
    }
    let list = rows(&passes(folder.path(), &["list", "--format", "json"]).out);
    let case = list
        .iter()
        .find(|case| case["case"] == CASE)
        .expect("listed");
    let methods = case["methods"].as_array().expect("a list");
    let methods: Vec<&str> = methods.iter().filter_map(|m| m["name"].as_str()).collect();
    assert_eq!(
        methods,
        ["fixed", "dashpot", "damping-layer", "pml", "extended"]
    );
}

#[test]
fn show_prints_the_bill_with_the_cell_in_use() {
    let folder = folder();
    let text = passes(folder.path(), &["show", CASE, "--set", "grid.h_m=4"]).out;
    // 13 cells fit into 50 m.
    for word in ["3.846154", "unknowns", "steps", "each"] {
        assert!(text.contains(word), "{word} is missing in {text}");
    }
}

#[test]
fn what_show_writes_can_be_edited_and_run() {
    let folder = folder();
    let toml = passes(
        folder.path(),
        &["show", CASE, "--method", "dashpot", "--toml"],
    )
    .out;
    let my = folder.path().join("my.toml");
    std::fs::write(&my, &toml).expect("a file");
    let asked = shown(folder.path(), &[CASE, "--method", "dashpot"]);
    assert_eq!(shown(folder.path(), &["my.toml"]), asked);

    let edited = toml
        .replace("width_m = 50.0", "width_m = 2.0")
        .replace("x_m = 25.0", "x_m = 1.0");
    assert_ne!(edited, toml);
    std::fs::write(&my, edited).expect("a file");
    assert_eq!(
        shown(folder.path(), &["my.toml"])["scene"]["body"]["width_m"],
        2.0
    );
    let methods = [
        "--method", "fixed", "--method", "dashpot", "--format", "json",
    ];
    let compared = passes(
        folder.path(),
        &[&["compare", "my.toml"], &methods[..]].concat(),
    );
    let solved = rows(&compared.out);
    let ratio = |method: &str| {
        let row = solved.iter().find(|row| {
            row["method"] == method && row["metric"] == "echo_ratio" && row["where"] == "A"
        });
        row.and_then(|row| row["value"].as_f64()).expect("a number")
    };
    assert_eq!(ratio("fixed"), 1.0);
    assert!(ratio("dashpot") < 0.02, "{}", ratio("dashpot"));
}

#[test]
fn assignments_lie_over_file_profile_and_method() {
    let folder = folder();
    let file = "case = \"compression-1d\"\nprofile = \"paper\"\ngrid.h_m = 2.0\n";
    std::fs::write(folder.path().join("my.toml"), file).expect("a file");
    let scene = |sets: &[&str]| {
        let sets: Vec<&str> = sets.iter().flat_map(|set| ["--set", *set]).collect();
        let arguments = [&["my.toml", "--method", "damping-layer"], &sets[..]].concat();
        shown(folder.path(), &arguments)["scene"].clone()
    };
    let plain = scene(&[]);
    assert_eq!(plain["grid"]["h_m"], 2.0);
    assert_eq!(plain["points"]["mode"], "moving");
    assert_eq!(plain["boundary"]["bottom"]["thickness_m"], 10.0);
    // The last one counts; a method's parameter reaches its side; receivers go by name.
    let set = scene(&[
        "grid.h_m=5",
        "grid.h_m=0.5",
        "damping-layer.thickness_m=12",
        "receivers.B.y_m=20",
    ]);
    assert_eq!(set["grid"]["h_m"], 0.5);
    assert_eq!(set["boundary"]["bottom"]["thickness_m"], 12.0);
    assert_eq!(set["receivers"][1]["y_m"], 20.0);
    assert_eq!(set["receivers"][0]["y_m"], 50.0);
}

#[test]
fn rows_have_the_keys_of_the_contract_and_no_other() {
    let folder = folder();
    let arguments = ["run", CASE, "--method", "dashpot", "--format", "json"];
    let output = passes(folder.path(), &narrow(&arguments));
    let printed = rows(&output.out);
    assert!(printed.len() > 10);
    for row in &printed {
        let keys: Vec<&str> = row
            .as_object()
            .expect("a row")
            .keys()
            .map(String::as_str)
            .collect();
        let mut contract = [
            "case",
            "profile",
            "method",
            "metric",
            "where",
            "value",
            "unit",
            "evidence",
            "reference",
            "accept",
            "verdict",
        ];
        contract.sort_unstable();
        assert_eq!(keys, contract);
    }
    let summary = read(&folder.path().join("results/compression-1d/summary.json"));
    assert_eq!(rows(&summary), printed);
}

#[test]
fn a_dry_run_writes_nothing() {
    let folder = folder();
    let arguments = ["compare", CASE, "--dry-run", "--format", "json"];
    let output = passes(folder.path(), &arguments);
    assert_eq!(rows(&output.out).len(), 5);
    assert!(!folder.path().join("results").exists());
}

#[test]
fn a_run_leaves_its_record_and_its_report() {
    let folder = folder();
    passes(
        folder.path(),
        &narrow(&["run", CASE, "--method", "dashpot"]),
    );
    let results = folder.path().join("results");
    let run = run_folder(&results, "dashpot");
    let series = read(&run.join("receivers.csv"));
    assert!(
        series.starts_with("t_s,A_ux_m,A_uy_m,A_vx_m_s,A_vy_m_s,B_ux_m"),
        "{series:.80}"
    );
    let manifest: Value = serde_json::from_str(&read(&run.join("manifest.json"))).expect("JSON");
    assert_eq!(manifest["status"], "complete");
    assert!(manifest["cost"]["peak_bytes"].as_u64() > Some(0));
    assert_eq!(
        run.file_name().and_then(|name| name.to_str()),
        manifest["provenance"]["input_hash"].as_str()
    );
    for name in ["energy.csv", "record.json", "metrics.json", "scene.toml"] {
        assert!(run.join(name).is_file(), "{name}");
    }
    for name in [
        "summary.csv",
        "summary.json",
        "junit.xml",
        "report.html",
        "receivers.svg",
        "receivers.png",
    ] {
        assert!(results.join(CASE).join(name).is_file(), "{name}");
    }
    // The stored scene is a file to run: same input, same folder, same series.
    let scene = run.join("scene.toml").display().to_string();
    passes(folder.path(), &["run", &scene]);
    assert_eq!(run_folder(&results, "dashpot"), run);
    assert_eq!(read(&run.join("receivers.csv")), series);
}

#[test]
fn a_report_is_made_again_from_records_alone() {
    let folder = folder();
    let methods = ["--method", "fixed", "--method", "dashpot"];
    passes(
        folder.path(),
        &narrow(&[&["compare", CASE], &methods[..]].concat()),
    );
    let case = folder.path().join("results").join(CASE);
    let names = [
        "summary.json",
        "summary.csv",
        "junit.xml",
        "report.html",
        "space-time.svg",
    ];
    let before: Vec<String> = names.iter().map(|name| read(&case.join(name))).collect();
    for name in names {
        std::fs::remove_file(case.join(name)).expect("the file was there");
    }
    passes(folder.path(), &["report", "results"]);
    let after: Vec<String> = names.iter().map(|name| read(&case.join(name))).collect();
    assert!(before == after);
}

#[test]
fn a_boundary_that_echoes_ends_with_one() {
    let folder = folder();
    let compare = |impedance: &str| {
        let arguments = [
            &[
                "compare",
                CASE,
                "--profile",
                "gate",
                "--method",
                "fixed",
                "--method",
                "dashpot",
            ],
            &NARROW[..],
            &[
                "--filter",
                "dashpot/residual",
                "--format",
                "json",
                "--set",
                impedance,
            ],
        ];
        let output = anechoic(folder.path(), &arguments.concat());
        let verdicts: Vec<Value> = rows(&output.out)
            .iter()
            .map(|row| row["verdict"].clone())
            .collect();
        assert!(!verdicts.is_empty(), "{}", output.err);
        (output.code, verdicts)
    };
    let (code, verdicts) = compare("dashpot.impedance=1");
    assert_eq!(code, 0);
    assert!(verdicts.iter().all(|verdict| verdict == "pass"));
    let (code, verdicts) = compare("dashpot.impedance=0.5");
    assert_eq!(code, 1);
    assert!(verdicts.iter().any(|verdict| verdict == "fail"));
}

#[test]
fn a_reference_that_does_not_exist_ends_with_four() {
    let folder = folder();
    let arguments = narrow(&["run", CASE, "--set", "source.frequency_Hz=0.3"]);
    let output = anechoic(folder.path(), &arguments);
    assert_eq!(output.code, 4, "{}", output.err);
    assert!(
        output.out.contains("not evaluated") && output.out.contains("the pulse lasts"),
        "{}",
        output.out
    );
}

#[test]
fn a_refinement_leaves_orders_pictures_and_rows_that_tell_levels_apart() {
    let folder = folder();
    let arguments = [
        "converge",
        CASE,
        "--over",
        "grid.h_m=0.5,2,1",
        "--method",
        "dashpot",
    ];
    let smooth = ["--set", "source.wavelet=sine-squared"];
    let output = passes(folder.path(), &narrow(&[&arguments[..], &smooth].concat()));
    // Coarse to fine, whatever was typed.
    let head = output
        .out
        .lines()
        .find(|line| line.contains("grid.h_m=2   "));
    assert!(head.is_some_and(|head| head.contains("grid.h_m=2   grid.h_m=1   grid.h_m=0.5")));
    let study = folder.path().join("results/compression-1d-converge");
    for name in [
        "report.html",
        "convergence.svg",
        "convergence-peak.png",
        "junit.xml",
    ] {
        assert!(study.join(name).is_file(), "{name}");
    }
    let summary = rows(&read(&study.join("summary.json")));
    let of = |metric: &str, place: &str| {
        let mut found = summary
            .iter()
            .filter(|row| row["metric"] == metric && row["where"] == place);
        let row = found
            .next()
            .unwrap_or_else(|| panic!("no {metric} at {place}"));
        assert!(
            found.next().is_none(),
            "{metric} at {place} stands there twice"
        );
        row.clone()
    };
    for place in [
        "A:rel_l2",
        "A:rel_l2:low",
        "A:rel_l2@grid.h_m=2..1",
        "B:peak_error",
    ] {
        assert!(of("order", place)["value"].is_f64(), "{place}");
    }
    assert!(
        of("rel_l2", "A@grid.h_m=2")["value"].as_f64()
            > of("rel_l2", "A@grid.h_m=0.5")["value"].as_f64()
    );
    // Each run keeps its own level's rows.
    let runs = std::fs::read_dir(study.join("dashpot")).expect("runs");
    for run in runs {
        let own = rows(&read(&run.expect("an entry").path().join("metrics.json")));
        let places: Vec<&str> = own.iter().filter_map(|row| row["where"].as_str()).collect();
        let level = places[0].split('@').nth(1).expect("a level");
        assert!(
            places.iter().all(|place| place.ends_with(level)),
            "{places:?}"
        );
    }
}

#[test]
fn an_order_out_of_its_bounds_ends_with_one_and_none_at_all_with_four() {
    let folder = folder();
    let code = |sets: &[&str]| {
        let arguments = ["converge", CASE, "--over", "grid.h_m=2,1,0.5"];
        anechoic(folder.path(), &narrow(&[&arguments[..], sets].concat())).code
    };
    // With a step of its own the error in time stays where it is.
    let smooth = "source.wavelet=sine-squared";
    assert_eq!(code(&["--set", smooth, "--set", "time.dt_s=0.04"]), 1);
    assert_eq!(code(&[]), 4);
}

#[test]
fn what_is_no_refinement_is_told_before_anything_is_solved() {
    let folder = folder();
    for (over, part) in [
        ("grid.h_m=4", "two values at least"),
        ("grid.h_m=4,two", "`two` is no positive number"),
        ("grid.hm=4,2", "did you mean `grid.h_m`"),
        ("receivers.A.x_m=1,0.5", "refines nothing"),
        ("material.E_Pa=1e6,2e6", "refines nothing"),
        ("points.per_cell=4,5", "--over points.per_cell=5: "),
        ("grid.h_m=30,26", "the same cells of 25 m"),
        ("pml.thickness_m=10,20", "refines nothing"),
    ] {
        let output = anechoic(folder.path(), &["converge", CASE, "--over", over]);
        assert_eq!(output.code, 2, "{over}: {}", output.out);
        assert!(output.err.contains(part), "{over}: {}", output.err);
    }
    assert!(!folder.path().join("results").exists());
}
