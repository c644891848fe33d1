//! Records that are no longer whole: `report` names file and method, shows all others, and ends with 3.

use anechoic_tests::program::{Output, anechoic, folder, narrow, read, rows, run_folder};
use std::path::{Path, PathBuf};

const CASE: &str = "compression-1d";

/// A study of three methods.
struct Studied {
    folder: tempfile::TempDir,
    before: String,
}

impl Studied {
    fn new() -> Self {
        let folder = folder();
        let methods = [
            "compare", CASE, "--method", "fixed", "--method", "dashpot", "--method", "extended",
        ];
        let output = anechoic(folder.path(), &narrow(&methods));
        assert_eq!(output.code, 0, "{}", output.err);
        let before = read(
            &folder
                .path()
                .join("results")
                .join(CASE)
                .join("summary.json"),
        );
        Studied { folder, before }
    }

    fn results(&self) -> PathBuf {
        self.folder.path().join("results")
    }

    fn run(&self, method: &str) -> PathBuf {
        run_folder(&self.results(), method)
    }

    fn summary(&self) -> String {
        read(&self.results().join(CASE).join("summary.json"))
    }

    /// Rebuilds the report of a study whose dashpot is damaged, and insists that the damage is told
    /// everywhere and that nothing else is lost. `words` tell the damage.
    #[track_caller]
    fn damaged(&self, words: &[&str]) -> Output {
        let output = anechoic(self.folder.path(), &["report", "results"]);
        assert_eq!(output.code, 3, "{}{}", output.err, output.out);
        let page = read(&self.results().join(CASE).join("report.html"));
        for word in words.iter().chain(&["dashpot", "damaged"]) {
            assert!(
                output.err.contains(word),
                "{word} is missing in {}",
                output.err
            );
            assert!(page.contains(word), "{word} is missing in the report");
        }
        let (before, after) = (rows(&self.before), rows(&self.summary()));
        let of = |method: &str, rows: &[serde_json::Value]| -> Vec<String> {
            let own = rows.iter().filter(|row| row["method"] == method);
            own.map(ToString::to_string).collect()
        };
        for method in ["fixed", "extended"] {
            assert_eq!(of(method, &before), of(method, &after), "{method}");
        }
        // What is claimed of the dashpot is not evaluated, and there are no numbers of it.
        let claims = |rows: &[serde_json::Value]| {
            let own = rows.iter().filter(|row| row["method"] == "dashpot");
            own.filter(|row| !row["verdict"].is_null()).count()
        };
        assert_eq!(claims(&before), claims(&after));
        for row in after.iter().filter(|row| row["method"] == "dashpot") {
            assert_eq!(row["verdict"], "not evaluated");
            assert!(row["value"].is_null());
        }
        output
    }
}

/// A file with one thing replaced.
fn replace(path: &Path, from: &str, to: &str) {
    let text = read(path);
    assert!(text.contains(from));
    std::fs::write(path, text.replacen(from, to, 1)).expect("written");
}

#[test]
fn a_report_of_whole_records_is_that_of_the_study() {
    let studied = Studied::new();
    let output = anechoic(studied.folder.path(), &["report", "results"]);
    assert_eq!(output.code, 0, "{}", output.err);
    assert_eq!(studied.summary(), studied.before);
}

#[test]
fn series_cut_between_lines_and_within_one() {
    let studied = Studied::new();
    let path = studied.run("dashpot").join("receivers.csv");
    let whole = read(&path);
    let line = whole[..whole.len() / 2].rfind('\n').expect("lines") + 1;
    std::fs::write(&path, &whole[..line]).expect("written");
    studied.damaged(&["receivers.csv", "hash"]);
    // In the middle of a number.
    std::fs::write(&path, &whole[..line + 40]).expect("written");
    studied.damaged(&["receivers.csv", "line"]);
    // Put back, it is whole again: the damage was not written anywhere.
    std::fs::write(&path, whole).expect("written");
    let output = anechoic(studied.folder.path(), &["report", "results"]);
    assert_eq!(output.code, 0, "{}", output.err);
    assert_eq!(studied.summary(), studied.before);
}

#[test]
fn a_number_that_is_none() {
    let studied = Studied::new();
    let path = studied.run("dashpot").join("receivers.csv");
    let text = read(&path);
    let line = text.lines().nth(200).expect("many lines");
    let value = line.split(',').nth(2).expect("a column");
    replace(&path, line, &line.replacen(value, "NaN", 1));
    studied.damaged(&["receivers.csv", "line 201", "A_uy_m", "NaN"]);
}

#[test]
fn a_file_or_a_folder_that_is_gone() {
    for name in [
        "record.json",
        "energy.csv",
        "manifest.json",
        "scene.toml",
        "SHA256SUMS",
    ] {
        let studied = Studied::new();
        std::fs::remove_file(studied.run("dashpot").join(name)).expect("it was there");
        studied.damaged(&[name]);
    }
    let studied = Studied::new();
    std::fs::remove_dir_all(studied.run("dashpot")).expect("it was there");
    let output = studied.damaged(&["missing"]);
    // Told once more by the next report: the study does not forget its runs.
    assert!(output.err.contains("--resume"), "{}", output.err);
    studied.damaged(&["missing"]);
}

#[test]
fn a_scene_or_a_number_changed_by_hand() {
    let studied = Studied::new();
    replace(
        &studied.run("dashpot").join("scene.toml"),
        "h_m = 1.0",
        "h_m = 2.0",
    );
    studied.damaged(&["scene.toml", "hash"]);
    let studied = Studied::new();
    replace(
        &studied.run("dashpot").join("energy.csv"),
        "\n0.01,",
        "\n0.011,",
    );
    studied.damaged(&["energy.csv", "hash"]);
}

#[test]
fn runs_without_their_study_are_told_from_no_runs() {
    let studied = Studied::new();
    let study = studied.results().join(CASE).join("study.json");
    std::fs::remove_file(study).expect("the study's file");
    let output = anechoic(studied.folder.path(), &["report", "results"]);
    assert_eq!(output.code, 2, "{}", output.err);
    for word in [CASE, "no study.json", "--resume"] {
        assert!(output.err.contains(word), "{word}: {}", output.err);
    }
}

#[test]
fn without_the_standard_run_ratios_are_missing_and_the_rest_stands() {
    let studied = Studied::new();
    std::fs::remove_file(studied.run("fixed").join("receivers.csv")).expect("it was there");
    let output = anechoic(
        studied.folder.path(),
        &["report", "results", "--format", "json"],
    );
    assert_eq!(output.code, 3, "{}", output.err);
    let rows = rows(&output.out);
    let has = |metric: &str| {
        rows.iter()
            .any(|row| row["method"] == "dashpot" && row["metric"] == metric)
    };
    assert!(has("residual") && !has("echo_ratio"));
}

#[test]
fn a_study_of_which_nothing_can_be_read_is_named_and_others_are_shown() {
    let studied = Studied::new();
    let other = studied.results().join("another");
    std::fs::create_dir(&other).expect("a folder");
    std::fs::write(other.join("study.json"), "{\"kind\": ").expect("written");
    let report = || anechoic(studied.folder.path(), &["report", "results"]);
    let output = report();
    assert_eq!(output.code, 3, "{}", output.err);
    assert!(output.err.contains("another/study.json"), "{}", output.err);
    assert!(output.out.contains("residual"), "{}", output.out);
    for method in ["fixed", "dashpot", "extended"] {
        std::fs::remove_dir_all(studied.results().join(CASE).join(method)).expect("it was there");
    }
    let output = report();
    assert_eq!(output.code, 3, "{}", output.err);
    assert!(output.err.contains("none of its runs"), "{}", output.err);
    assert_eq!(
        studied.summary(),
        studied.before,
        "nothing is left to replace it by"
    );
}

#[test]
fn a_level_of_a_refinement_is_named_its_order_not_judged_and_resume_solves_it_alone() {
    let folder = folder();
    let refine = |how: &[&str]| {
        let arguments = [
            "converge",
            CASE,
            "--over",
            "grid.h_m=2,1,0.5",
            "--method",
            "dashpot",
            "--set",
            "source.wavelet=sine-squared",
        ];
        anechoic(folder.path(), &narrow(&[&arguments[..], how].concat()))
    };
    let study = folder.path().join("results/compression-1d-converge");
    let summary = || {
        let mut rows = rows(&read(&study.join("summary.json")));
        let costs = ["cpu_s", "wall_s", "us_per_point_step"];
        rows.retain(|row| !costs.iter().any(|cost| row["metric"] == *cost));
        rows
    };
    let output = refine(&[]);
    assert_eq!(output.code, 0, "{}{}", output.err, output.out);
    let before = summary();
    let mut levels: Vec<PathBuf> = std::fs::read_dir(study.join("dashpot"))
        .expect("levels")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    levels.sort();
    assert_eq!(levels.len(), 3);
    let manifests = || -> Vec<String> {
        let read = |level: &PathBuf| read(&level.join("manifest.json"));
        levels.iter().map(read).collect()
    };
    let (kept, series) = (manifests(), levels[0].join("receivers.csv"));
    let text = read(&series);
    std::fs::write(&series, &text[..text.len() / 2]).expect("written");

    let output = anechoic(folder.path(), &["report", "results"]);
    assert_eq!(output.code, 3, "{}{}", output.err, output.out);
    let name = levels[0].file_name().expect("a hash").to_string_lossy();
    let page = read(&study.join("report.html"));
    for text in [&output.err, &page] {
        assert!(text.contains(&*name) && text.contains("damaged"), "{text}");
    }
    let after = summary();
    let measured = ["A@grid.h_m=2", "A@grid.h_m=1", "A@grid.h_m=0.5"].map(|place| {
        let is_error = |row: &serde_json::Value| row["metric"] == "rel_l2" && row["where"] == place;
        after.iter().any(is_error)
    });
    assert_eq!(measured.iter().filter(|measured| **measured).count(), 2);
    // The orders are claimed as before, and none is judged over two levels of three.
    let claims = |rows: &[serde_json::Value]| -> Vec<String> {
        let claims = rows.iter().filter(|row| !row["verdict"].is_null());
        claims.map(|row| row["verdict"].to_string()).collect()
    };
    assert_eq!(claims(&before), [r#""pass""#; 2]);
    assert_eq!(claims(&after), [r#""not evaluated""#; 2]);

    let output = refine(&["--resume", "--dry-run"]);
    assert!(
        output.out.contains("would solve 1 runs, take 2 from disk"),
        "{}",
        output.out
    );
    assert!(output.out.contains("dashpot, grid.h_m=1"), "{}", output.out);
    let output = refine(&["--resume"]);
    assert_eq!(output.code, 0, "{}{}", output.err, output.out);
    assert_eq!(summary(), before);
    assert_eq!(
        manifests()[1..],
        kept[1..],
        "what was whole is not solved again"
    );
    assert_eq!(read(&series), text);
}
