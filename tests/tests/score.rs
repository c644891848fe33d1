//! Other people's programs: a scene as plain files, their series judged by the rows of ours.

use anechoic_reports::judge::COSTS;
use anechoic_tests::program::{Output, anechoic, folder, narrow, read, rows, run_folder};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

const CASE: &str = "compression-1d";

#[track_caller]
fn call(folder: &Path, arguments: &[&str], code: i32) -> Output {
    let output = anechoic(folder, arguments);
    assert_eq!(
        output.code, code,
        "{arguments:?}: {}{}",
        output.err, output.out
    );
    output
}

/// Rows of a method as METRIC, WHERE, value and verdict.
fn of(rows: &[Value], method: &str) -> Vec<[String; 4]> {
    let own = rows.iter().filter(|row| row["method"] == method);
    own.map(|row| ["metric", "where", "value", "verdict"].map(|key| row[key].to_string()))
        .collect()
}

/// What is known of our runs and not of others'.
fn is_ours_alone(row: &[String; 4]) -> bool {
    let metrics = COSTS.iter().chain(&["energy_left", "growth_rate_per_s"]);
    metrics
        .into_iter()
        .any(|metric| row[0] == format!("\"{metric}\""))
}

#[test]
fn our_own_series_score_what_our_run_scored() {
    let folder = folder();
    let root = folder.path();
    let methods = ["--method", "fixed", "--method", "dashpot"];
    call(
        root,
        &narrow(&[&["compare", CASE], &methods[..]].concat()),
        0,
    );
    let run = run_folder(&root.join("results"), "dashpot");
    std::fs::copy(run.join("receivers.csv"), root.join("copy.csv")).expect("copied");
    let score = ["score", CASE, "copy.csv", "--format", "json"];
    let output = call(
        root,
        &narrow(&[&score[..], &["--method", "dashpot"]].concat()),
        0,
    );
    let scored = rows(&output.out);
    let mut ours = of(&scored, "dashpot");
    ours.retain(|row| !is_ours_alone(row));
    assert!(ours.len() > 15);
    assert_eq!(of(&scored, "copy"), ours);
    assert!(
        output.err.contains("pml"),
        "who is not beside it: {}",
        output.err
    );

    // Without a method nothing is claimed, and nobody says what its boundary should do.
    let output = call(
        root,
        &narrow(&[&score[..], &["--name", "plain"]].concat()),
        0,
    );
    let scored = rows(&output.out);
    let plain = of(&scored, "plain");
    assert!(plain.iter().all(|row| row[3] == "null"));
    assert!(plain.iter().any(|row| row[0] == "\"echo_ratio\""));
    assert!(!plain.iter().any(|row| row[0] == "\"arrival_s\""));
    // What was scored before stays in the study; report makes it again.
    assert_eq!(of(&scored, "copy"), ours);
    let study = root.join("results").join(CASE);
    let summary = read(&study.join("summary.json"));
    call(root, &["report", "results"], 0);
    assert_eq!(read(&study.join("summary.json")), summary);
    let page = read(&study.join("report.html"));
    assert!(page.contains("another program") && page.contains("copy"));

    // Its cost is unknown and shown as such: a dash each.
    let output = call(root, &narrow(&["score", CASE, "copy.csv"]), 0);
    let line = output
        .out
        .lines()
        .find(|line| line.contains(" copy "))
        .expect("ranked");
    assert_eq!(line.matches('–').count(), 3, "{line}");

    // No motion at all, or one with the wrong sign, has no echo either: it is not judged, let alone ranked.
    for (name, factor) in [("silent", 0.0), ("upside-down", -1.0)] {
        let text = read(&root.join("copy.csv"));
        let mut lines = text.lines().map(str::to_owned);
        let mut changed = lines.next().expect("a head") + "\n";
        for line in lines {
            let mut numbers = line.split(',').map(|x| x.parse().expect("a number"));
            let time: f64 = numbers.next().expect("a time");
            changed += &time.to_string();
            numbers.for_each(|x: f64| changed += &format!(",{:e}", factor * x));
            changed.push('\n');
        }
        std::fs::write(root.join(format!("{name}.csv")), changed).expect("written");
        let file = format!("{name}.csv");
        let wrong = [
            "score", CASE, &file, "--format", "json", "--method", "dashpot",
        ];
        let output = call(root, &narrow(&wrong), 4);
        let scored = rows(&output.out);
        let judged = of(&scored, name);
        assert!(!judged.iter().any(|row| row[3].contains("pass")));
        assert!(
            output.err.contains("not the scene's motion"),
            "{}",
            output.err
        );
    }
}

#[test]
fn displacements_alone_and_finer_times_do() {
    let folder = folder();
    let root = folder.path();
    call(root, &narrow(&["run", CASE, "--method", "dashpot"]), 0);
    let series = read(&run_folder(&root.join("results"), "dashpot").join("receivers.csv"));
    let lines: Vec<Vec<&str>> = series
        .lines()
        .map(|line| line.split(',').collect())
        .collect();
    let keep: Vec<usize> = (0..lines[0].len())
        .filter(|i| !lines[0][*i].ends_with("_m_s"))
        .collect();
    let mut text = String::new();
    for (index, line) in lines.iter().enumerate() {
        let cells = |line: &[&str]| keep.iter().map(|i| line[*i].to_owned()).collect::<Vec<_>>();
        text += &(cells(line).join(",") + "\n");
        // Half way to the next line, as a program with half the step would have it.
        if let (1.., Some(next)) = (index, lines.get(index + 1)) {
            let number = |text: &str| text.parse::<f64>().expect("a number");
            let halves = keep
                .iter()
                .map(|i| 0.5 * (number(line[*i]) + number(next[*i])));
            text += &(halves
                .map(|x| format!("{x:?}"))
                .collect::<Vec<_>>()
                .join(",")
                + "\n");
        }
    }
    std::fs::write(root.join("fine.csv"), &text).expect("written");
    let score = [
        "score", CASE, "fine.csv", "--method", "dashpot", "--format", "json",
    ];
    let output = call(root, &narrow(&score), 0);
    assert!(output.err.contains("central differences"), "{}", output.err);
    let value = |method: &str| {
        let scored = rows(&output.out);
        let mut found = scored.iter().filter(|row| {
            row["method"] == method && row["metric"] == "echo_ratio" && row["where"] == "B"
        });
        found
            .next()
            .and_then(|row| row["value"].as_f64())
            .expect("a number")
    };
    let (fine, ours) = (value("fine"), value("dashpot"));
    assert!((fine - ours).abs() < 0.3 * ours, "{fine} {ours}");

    // Every other line is too coarse, and the line is named.
    let coarse: String = series
        .lines()
        .enumerate()
        .filter(|(i, _)| *i == 0 || i % 2 == 1)
        .map(|(_, line)| format!("{line}\n"))
        .collect();
    std::fs::write(root.join("coarse.csv"), coarse).expect("written");
    let output = call(root, &narrow(&["score", CASE, "coarse.csv"]), 2);
    assert!(
        output.err.contains("coarse.csv:3") && output.err.contains("longer"),
        "{}",
        output.err
    );
}

#[test]
fn what_does_not_fit_is_refused_before_anything_is_solved() {
    let folder = folder();
    let root = folder.path();
    let write = |text: &str| std::fs::write(root.join("s.csv"), text).expect("written");
    let refused = |words: &[&str], more: &[&str]| {
        let output = call(
            root,
            &narrow(&[&["score", CASE, "s.csv"], more].concat()),
            2,
        );
        for word in words {
            assert!(
                output.err.contains(word),
                "{word} is missing in {}",
                output.err
            );
        }
    };
    write("t_s,A_ux_m,A_uy_m,B_ux_m\n0,0,0,0\n");
    refused(&["s.csv:1", "`B_uy_m` is missing"], &[]);
    write("t_s,A_ux_m,A_uy_m,B_ux_m,B_uy_m,C_ux_m\n0,0,0,0,0,0\n");
    refused(&["s.csv:1", "column 6 `C_ux_m`", "did you mean"], &[]);
    write("t_s,A_ux_m,A_uy_m,B_ux_m,B_uy_m\n0,0,0,0,0\n0.001,0,NaN,0,0\n");
    refused(&["s.csv:3", "A_uy_m", "NaN"], &[]);
    write("t_s,A_ux_m,A_uy_m,B_ux_m,B_uy_m\n0,0,0,0,0\n0.001,0,0,0,0\n");
    refused(&["s.csv:3", "ends at 0.001 s"], &[]);
    refused(&["--name", "ours"], &["--name", "dashpot"]);
    refused(&["--name", "letters"], &["--name", "../x"]);
    refused(&["unknown method"], &["--method", "dashpott"]);
    let absent = call(root, &["score", CASE, "absent.csv"], 2);
    assert!(absent.err.contains("absent.csv"), "{}", absent.err);
    assert!(!root.join("results").exists());
}

#[test]
fn a_case_judged_by_displacements_solves_its_standard_run() {
    let folder = folder();
    let root = folder.path();
    // A small half-space, so that its reference is quickly computed as well.
    let small = [
        "--profile",
        "gate",
        "--set",
        "grid.h_m=50",
        "--set",
        "time.end_s=5",
    ];
    let with = |arguments: &[&'static str]| [arguments, &small].concat();
    let run = anechoic(
        root,
        &with(&["run", "point-source", "--method", "dashpot", "--out", "a"]),
    );
    assert!(
        run.code == 0 || run.code == 4 || run.code == 1,
        "{}",
        run.err
    );
    let runs = root.join("a/point-source/dashpot");
    let hash = std::fs::read_dir(runs)
        .expect("runs")
        .next()
        .expect("one")
        .expect("an entry");
    std::fs::copy(hash.path().join("receivers.csv"), root.join("mine.csv")).expect("copied");
    // The reference that the first command computed is found again.
    std::fs::create_dir(root.join("b")).expect("a folder");
    std::fs::rename(root.join("a/certified"), root.join("b/certified")).expect("moved");
    let score = [
        "score",
        "point-source",
        "mine.csv",
        "--out",
        "b",
        "--format",
        "json",
    ];
    let output = anechoic(root, &with(&score));
    assert!(output.code != 2 && output.code != 3, "{}", output.err);
    let scored = rows(&output.out);
    let echo = scored
        .iter()
        .find(|row| row["method"] == "mine" && row["metric"] == "echo_ratio");
    let echo = echo
        .and_then(|row| row["value"].as_f64())
        .expect("a ratio over the standard run");
    assert!(echo > 0.01 && echo < 1.0, "{echo}");
    assert!(root.join("b/point-source/fixed").is_dir());
    assert!(
        output.err.contains("other discretisation"),
        "{}",
        output.err
    );
}

#[test]
fn an_export_says_everything_in_plain_files() {
    let folder = folder();
    let root = folder.path();
    let output = call(root, &narrow(&["show", CASE, "--export", "scene"]), 0);
    assert!(output.out.contains("dalembert"), "{}", output.out);
    let file = |name: &str| read(&root.join("scene").join(name));
    let lines = |name: &str| file(name).lines().count();
    assert_eq!(lines("mesh.csv"), 1 + 2 * 50);
    assert!(file("mesh.csv").contains("99,1.0,2.0,49.0,50.0"));
    assert_eq!(lines("receivers_places.csv"), 3);
    assert_eq!(lines("load.csv"), lines("reference.csv"));
    assert!(file("load.csv").starts_with("t_s,top_vy_m_s,top_prescribed_1\n0.0,"));
    assert!(file("reference.csv").starts_with("t_s,A_vx_m_s,A_vy_m_s,B_vx_m_s,B_vy_m_s\n"));
    for word in [
        "series.csv",
        "t_s,A_ux_m,A_uy_m,B_ux_m,B_uy_m",
        "anechoic score",
        "HalfSine",
    ] {
        assert!(file("README.txt").contains(word), "{word} is missing");
    }
    // The scene is the same scene.
    let hash = |arguments: &[&str]| {
        let arguments = [&["show"], arguments, &["--format", "json"]].concat();
        let shown: Value = serde_json::from_str(&call(root, &arguments, 0).out).expect("JSON");
        shown["hash"].clone()
    };
    assert_eq!(hash(&["scene/scene.toml"]), hash(&narrow(&[CASE])));

    // A case with a certified reference: that which comes with the program, or none, which is said.
    let output = call(
        root,
        &[
            "show",
            "point-source",
            "--profile",
            "gate",
            "--export",
            "scene",
        ],
        0,
    );
    assert!(output.out.contains("extended-domain"), "{}", output.out);
    assert!(file("reference.csv").starts_with("t_s,A1_ux_m,A1_uy_m,"));
    assert!(file("load.csv").starts_with("t_s,F1_x_m,F1_y_m,F1_fx_N_m,F1_fy_N_m\n"));
    let other = [
        "--profile",
        "gate",
        "--set",
        "material.nu=0.3",
        "--export",
        "scene",
    ];
    let output = call(root, &[&["show", "point-source"], &other[..]].concat(), 0);
    assert!(
        output.out.contains("there is no reference"),
        "{}",
        output.out
    );
    assert!(
        !root.join("scene/reference.csv").exists(),
        "that of the scene before"
    );
    assert!(file("README.txt").contains("There is no reference.csv"));
}

/// The worked example: exported, solved by a program that is not ours, scored; and with an echo put
/// into it, found out.
#[test]
fn the_finite_difference_example_is_judged() {
    if Command::new("python3").arg("--version").output().is_err() {
        println!("skipped: there is no python3 on this machine");
        return;
    }
    let folder = folder();
    let root = folder.path();
    let script =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/finite_difference/column.py");
    let program = read(&script);
    call(root, &narrow(&["show", CASE, "--export", "column"]), 0);
    let scored = |program: &str, code: i32| {
        std::fs::write(root.join("column.py"), program).expect("written");
        let solved = Command::new("python3")
            .current_dir(root)
            .args(["column.py", "column", "series.csv"])
            .output()
            .expect("python3 starts");
        assert!(
            solved.status.success(),
            "{}",
            String::from_utf8_lossy(&solved.stderr)
        );
        let score = [
            "score",
            "column/scene.toml",
            "series.csv",
            "--name",
            "finite-difference",
            "--method",
            "dashpot",
            "--format",
            "json",
        ];
        let rows = rows(&call(root, &score, code).out);
        rows.into_iter()
            .filter(|row| row["method"] == "finite-difference")
            .collect::<Vec<_>>()
    };
    let verdicts =
        |rows: &[Value], verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    let good = scored(&program, 0);
    assert_eq!((verdicts(&good, "pass"), verdicts(&good, "fail")), (4, 0));
    let residual = |rows: &[Value], place: &str| {
        let row = rows
            .iter()
            .find(|r| r["metric"] == "residual" && r["where"] == place);
        row.and_then(|row| row["value"].as_f64()).expect("a number")
    };
    println!(
        "residual {:e} at A, {:e} at B",
        residual(&good, "A"),
        residual(&good, "B")
    );
    // Half of the impedance sends a third back.
    let absorbs = "((1 - courant) * v[0] + 2 * dt * s[0] / (rho * dx)) / (1 + courant)";
    assert!(program.contains(absorbs));
    let echoing = absorbs.replace("courant", "0.5 * courant");
    let bad = scored(&program.replace(absorbs, &echoing), 1);
    assert!(verdicts(&bad, "fail") >= 2);
    assert!(
        (residual(&bad, "A") - 2.0 / 3.0).abs() < 0.05,
        "{}",
        residual(&bad, "A")
    );
}
