//! The program as it is typed: exit codes, output that can be parsed, what lies in the results folder.

use assert_cmd::Command;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A column two cells wide: the wave is the same, the cost is not.
const NARROW: [&str; 6] = [
    "--set",
    "body.width_m=2",
    "--set",
    "receivers.A.x_m=1",
    "--set",
    "receivers.B.x_m=1",
];

fn anechoic(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_anechoic"))
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code().expect("an exit code"),
        text(&output.stdout),
        text(&output.stderr),
    )
}

fn narrow<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    [arguments, &["--profile", "gate"], &NARROW].concat()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// The only folder of a method's runs.
fn run_folder(root: &Path, method: &str) -> PathBuf {
    let mut folders: Vec<PathBuf> =
        std::fs::read_dir(root.join("results/compression-1d").join(method))
            .expect("the method's folder")
            .map(|entry| entry.expect("an entry").path())
            .collect();
    assert_eq!(folders.len(), 1, "{folders:?}");
    folders.remove(0)
}

fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn rows(json: &str) -> Vec<Value> {
    serde_json::from_str(json).expect("rows as JSON")
}

#[test]
fn without_arguments_it_says_what_it_is() {
    let folder = folder();
    let (code, out, _) = anechoic(folder.path(), &[]);
    assert_eq!(code, 0);
    assert!(out.contains("anechoic compare compression-1d"));
    let (code, out, _) = anechoic(folder.path(), &["--help"]);
    assert_eq!(code, 0);
    assert!(out.contains("Examples:") && out.contains("Exit codes:"));
    let (code, out, _) = anechoic(folder.path(), &["list", "--format", "json"]);
    assert_eq!(
        (code, rows(&out)[0]["case"].as_str()),
        (0, Some("compression-1d"))
    );
}

#[test]
fn usage_and_input_end_with_two() {
    let folder = folder();
    for arguments in [
        &["fly"][..],
        &["run", "compresion-1d"],
        &["run", "compression-1d", "--set", "grid.h_m=-1"],
        &["run", "compression-1d", "--jobs", "0"],
        &["compare", "compression-1d", "--filter", "nothing-like-it"],
        &["report", "absent"],
        &["report", "."],
    ] {
        let (code, out, err) = anechoic(folder.path(), arguments);
        assert_eq!(code, 2, "{arguments:?}: {err}");
        assert!(out.is_empty() && !err.is_empty());
    }
    assert!(!folder.path().join("results").exists());
}

#[test]
fn a_folder_that_cannot_be_written_is_found_before_the_solve() {
    let folder = folder();
    std::fs::write(folder.path().join("taken"), "a file").expect("a file");
    let arguments = narrow(&["run", "compression-1d", "--out", "taken"]);
    let (code, _, err) = anechoic(folder.path(), &arguments);
    assert_eq!(code, 2);
    assert!(err.contains("taken") && err.contains("--out"), "{err}");
}

#[test]
fn a_dry_run_writes_nothing() {
    let folder = folder();
    let arguments = ["compare", "compression-1d", "--dry-run", "--format", "json"];
    let (code, out, _) = anechoic(folder.path(), &arguments);
    assert_eq!((code, rows(&out).len()), (0, 4));
    assert!(!folder.path().join("results").exists());
}

#[test]
fn a_run_leaves_its_record_and_its_report() {
    let folder = folder();
    let arguments = narrow(&[
        "run",
        "compression-1d",
        "--method",
        "dashpot",
        "--format",
        "json",
    ]);
    let (code, out, err) = anechoic(folder.path(), &arguments);
    assert_eq!(code, 0, "{err}");
    let printed = rows(&out);
    let keys: Vec<&String> = printed[0].as_object().expect("a row").keys().collect();
    for key in [
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
    ] {
        assert!(
            keys.iter().any(|k| *k == key),
            "{key} is missing in {keys:?}"
        );
    }
    let case = folder.path().join("results/compression-1d");
    assert_eq!(rows(&read(&case.join("summary.json"))), printed);
    let run = run_folder(folder.path(), "dashpot");
    let header = read(&run.join("receivers.csv"));
    assert!(
        header.starts_with("t_s,A_ux_m,A_uy_m,A_vx_m_s,A_vy_m_s,B_ux_m"),
        "{header:.80}"
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
        "junit.xml",
        "report.html",
        "receivers.svg",
        "receivers.png",
    ] {
        assert!(case.join(name).is_file(), "{name}");
    }
    // The stored scene is a file to run: same input, same folder, same series.
    let again = ["run", &run.join("scene.toml").display().to_string()].map(str::to_owned);
    let again: Vec<&str> = again.iter().map(String::as_str).collect();
    assert_eq!(anechoic(folder.path(), &again).0, 0);
    assert_eq!(run_folder(folder.path(), "dashpot"), run);
    assert_eq!(read(&run.join("receivers.csv")), header);
}

#[test]
fn a_report_is_made_again_from_records_alone() {
    let folder = folder();
    let arguments = narrow(&[
        "compare",
        "compression-1d",
        "--method",
        "fixed",
        "--method",
        "dashpot",
    ]);
    anechoic(folder.path(), &arguments);
    let case = folder.path().join("results/compression-1d");
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
    anechoic(folder.path(), &["report", "results"]);
    let after: Vec<String> = names.iter().map(|name| read(&case.join(name))).collect();
    assert!(before == after);

    // A record that was changed by hand is refused.
    let scene = run_folder(folder.path(), "dashpot").join("scene.toml");
    std::fs::write(&scene, read(&scene).replace("h_m = 1.0", "h_m = 2.0")).expect("written");
    let (code, _, err) = anechoic(folder.path(), &["report", "results"]);
    assert_eq!(code, 2);
    assert!(err.contains("scene.toml") && err.contains("hash"), "{err}");
}

#[test]
fn a_boundary_that_echoes_fails_its_claim() {
    let folder = folder();
    let compare = |set: &str| {
        let arguments = narrow(&[
            "compare",
            "compression-1d",
            "--method",
            "fixed",
            "--method",
            "dashpot",
            "--filter",
            "dashpot/residual",
            "--format",
            "json",
            "--set",
            set,
        ]);
        let (code, out, err) = anechoic(folder.path(), &arguments);
        let verdicts: Vec<Value> = rows(&out)
            .iter()
            .map(|row| row["verdict"].clone())
            .collect();
        assert!(!verdicts.is_empty(), "{err}");
        (code, verdicts)
    };
    let (code, verdicts) = compare("dashpot.impedance=1");
    assert_eq!(code, 0);
    assert!(verdicts.iter().all(|verdict| verdict == "pass"));
    let (code, verdicts) = compare("dashpot.impedance=0.5");
    assert_eq!(code, 1);
    assert!(verdicts.iter().any(|verdict| verdict == "fail"));
}

#[test]
fn a_run_that_diverges_is_stored_and_the_others_go_on() {
    let folder = folder();
    let arguments = narrow(&[
        "compare",
        "compression-1d",
        "--set",
        "source.amplitude_m_s=1e308",
        "--jobs",
        "2",
    ]);
    let (code, out, err) = anechoic(folder.path(), &arguments);
    assert_eq!(code, 3, "{err}");
    assert!(out.contains("not evaluated"), "{out}");
    for method in ["fixed", "dashpot", "damping-layer", "extended"] {
        assert!(err.contains(&format!("{method}: failed")), "{err}");
        let manifest = read(&run_folder(folder.path(), method).join("manifest.json"));
        assert!(manifest.contains("not finite"), "{manifest}");
    }
    assert!(
        folder
            .path()
            .join("results/compression-1d/report.html")
            .is_file()
    );
}

#[test]
fn a_result_that_cannot_be_written_midway_leaves_the_others() {
    let folder = folder();
    let case = folder.path().join("results/compression-1d");
    std::fs::create_dir_all(&case).expect("a folder");
    std::fs::write(case.join("dashpot"), "in the way").expect("a file");
    let arguments = narrow(&["compare", "compression-1d", "--jobs", "1"]);
    let (code, _, err) = anechoic(folder.path(), &arguments);
    assert_eq!(code, 3, "{err}");
    assert!(err.contains("compression-1d/dashpot") && err.contains("could not be written"));
    assert!(
        run_folder(folder.path(), "fixed")
            .join("record.json")
            .is_file()
    );
}

#[test]
fn a_reference_that_does_not_exist_ends_with_four() {
    let folder = folder();
    let arguments = narrow(&["run", "compression-1d", "--set", "source.frequency_Hz=0.3"]);
    let (code, out, err) = anechoic(folder.path(), &arguments);
    assert_eq!(code, 4, "{err}");
    assert!(
        out.contains("not evaluated") && out.contains("the pulse lasts"),
        "{out}"
    );
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_what_stands() {
    let folder = folder();
    let arguments = [
        "run",
        "compression-1d",
        "--set",
        "time.end_s=500",
        "--set",
        "points.mode=moving",
        "--set",
        "points.transfer=affine",
    ];
    let mut child = std::process::Command::new(env!("CARGO_BIN_EXE_anechoic"))
        .current_dir(folder.path())
        .args(arguments)
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .expect("the program starts");
    // The output folder is opened just before the solve.
    let results = folder.path().join("results");
    for _ in 0..600 {
        if results.is_dir() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(100));
    }
    std::thread::sleep(std::time::Duration::from_millis(500));
    let interrupted = std::process::Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("kill runs");
    assert!(interrupted.success());
    let code = child.wait().expect("it ends").code();
    assert_eq!(code, Some(3));
    let manifest = read(&run_folder(folder.path(), "fixed").join("manifest.json"));
    assert!(manifest.contains("cancelled"), "{manifest}");
    assert!(results.join("compression-1d/report.html").is_file());
}
