//! Bad input and bad luck: each mistake is found before anything is solved and told with its place and
//! what is allowed; what goes wrong later loses nothing that was finished.

use anechoic_tests::program::{anechoic, binary, folder, narrow, read, run_folder, wait_for};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

const CASE: &str = "compression-1d";

/// The program refuses with exit code 2, says `words` on stderr, and leaves nothing behind.
#[track_caller]
fn refused(arguments: &[&str], words: &[&str]) {
    let folder = folder();
    refused_in(folder.path(), arguments, words);
}

#[track_caller]
fn refused_in(folder: &Path, arguments: &[&str], words: &[&str]) {
    let output = anechoic(folder, arguments);
    assert_eq!(output.code, 2, "{arguments:?}: {}", output.err);
    assert!(output.out.is_empty(), "{}", output.out);
    for word in words {
        assert!(
            output.err.contains(word),
            "`{word}` is missing in: {}",
            output.err
        );
    }
    assert!(!folder.join("results").exists());
}

#[test]
fn unknown_names_come_with_the_nearest() {
    refused(&["fly"], &["fly"]);
    refused(
        &["run", "compresion-1d"],
        &["unknown case", "compresion-1d", "`compression-1d`"],
    );
    refused(
        &["run", CASE, "--method", "dashpott"],
        &["unknown method", "`dashpot`"],
    );
    refused(
        &["run", CASE, "--profile", "papr"],
        &["unknown profile", "`paper`"],
    );
    refused(
        &["run", CASE, "--preset", "liner"],
        &["unknown preset", "`linear`"],
    );
    refused(
        &["run", CASE, "--set", "matrial.nu=0.3"],
        &["matrial.nu", "`material.nu`"],
    );
    refused(
        &["compare", CASE, "--set", "pml.thicknes_m=3"],
        &["thicknes_m", "`thickness_m`"],
    );
    refused(
        &["compare", CASE, "--filter", "dashpot/residuum"],
        &["--filter dashpot/residuum", "matches nothing"],
    );
    refused(&["compare", CASE, "--filter", ""], &["--filter"]);
}

#[test]
fn values_out_of_range_come_with_what_is_allowed() {
    for (set, words) in [
        ("grid.h_m=0", &["value > 0"][..]),
        ("grid.h_m=-1", &["value > 0"]),
        ("grid.h_m=60", &["larger than the body's 50 m"]),
        ("body.width_m=-50", &["value > 0"]),
        ("body.height_m=0", &["value > 0"]),
        ("material.E_Pa=0", &["value > 0"]),
        ("material.nu=0.5", &["-1 < value < 0.5"]),
        ("material.nu=0.7", &["-1 < value < 0.5"]),
        ("material.rho_kg_m3=-1", &["value > 0"]),
        ("time.dt_s=0", &["value > 0"]),
        ("time.dt_s=-0.01", &["value > 0"]),
        ("time.dt_s=6", &["longer than the run"]),
        ("time.end_s=nan", &["value > 0"]),
        (
            "time.end_s=0.1",
            &["time.end_s: 0.1 s", "lasts 0.5 s", "value >= 0.5"],
        ),
        ("time.dt_s=0.5", &["time.dt_s: ", "time.dt_s <= 0.125"]),
        (
            "source.frequency_Hz=90",
            &["source.frequency_Hz: ", "do not see"],
        ),
        (
            "boundary.bottom={method=\"pml\",thickness_m=1e9}",
            &["boundary.bottom.thickness_m", "1000000000 m"],
        ),
        ("time.scheme=quasi-static", &["newmark"]),
        (
            "receivers.A.y_m=51",
            &["outside the mesh", "0 <= value <= 50"],
        ),
        (
            "source.frequency_Hz=0.05",
            &["pulse lasts 10 s", "time.end_s = 5 s"],
        ),
    ] {
        refused(&["run", CASE, "--set", set], &[&[set], words].concat());
    }
    refused(
        &[
            "run",
            "point-source",
            "--set",
            "source.x_m=1525",
            "--set",
            "source.y_m=-65",
        ],
        &["receivers[0].x_m", "A1 is at the force"],
    );
    refused(
        &[
            "run",
            CASE,
            "--method",
            "damping-layer",
            "--set",
            "damping-layer.thickness_m=60",
        ],
        &["boundary.bottom.thickness_m", "60 m", "the body (50 m)"],
    );
}

#[test]
fn a_file_is_named_with_its_line() {
    for (text, words) in [
        (
            "case = \"compression-1d\"\n\n[grid]\nh_m = \"fine\"\n",
            &["my.toml:4", "grid.h_m", "expected a number", "\"fine\""][..],
        ),
        (
            "case = \"compression-1d\"\n[material]\nnu = 0.7\n",
            &["my.toml:3", "material.nu", "-1 < value < 0.5"],
        ),
        (
            "case = \"compression-1d\"\n[material]\nE_pa = 1.0\n",
            &["my.toml:3", "material.E_pa", "`material.E_Pa`"],
        ),
        (
            "case = \"compression-1d\"\ngrid.h_m = = 1\n",
            &["my.toml:2:12"],
        ),
        ("[grid]\nh_m = 1.0\n", &["my.toml", "case ="]),
        (
            "case = \"compresion-1d\"\n",
            &["unknown case", "`compression-1d`"],
        ),
        (
            "case = \"compression-1d\"\n[boundary.bottom]\nmethod = \"dashpot\"\nimpedence = 2\n",
            &["my.toml:4", "boundary.bottom.impedence", "`impedance`"],
        ),
    ] {
        let folder = folder();
        std::fs::write(folder.path().join("my.toml"), text).expect("a file");
        refused_in(folder.path(), &["run", "my.toml"], words);
    }
    refused(&["run", "absent.toml"], &["absent.toml", "cannot be read"]);
    refused(&["report", "absent"], &["absent"]);
    refused(&["report", "."], &["holds no records", "anechoic compare"]);
    let folder = folder();
    std::fs::create_dir(folder.path().join("folder")).expect("a folder");
    std::fs::write(folder.path().join("file.txt"), "text").expect("a file");
    let place = folder.path();
    refused_in(place, &["run", "./folder"], &["folder", "a file is needed"]);
    refused_in(
        place,
        &["report", "file.txt"],
        &["file.txt", "a folder is needed"],
    );
    refused_in(
        place,
        &["diff", "file.txt", "file.txt"],
        &["file.txt", "summary.json"],
    );
}

#[test]
fn a_folder_that_cannot_be_written_is_found_before_the_solve() {
    let folder = folder();
    std::fs::write(folder.path().join("taken"), "a file").expect("a file");
    // An hour of work, if it were begun.
    let arguments = ["run", CASE, "--set", "grid.h_m=0.05", "--out", "taken"];
    refused_in(
        folder.path(),
        &arguments,
        &["taken", "cannot write", "--out"],
    );
}

#[test]
fn a_result_that_cannot_be_written_midway_leaves_the_others() {
    let folder = folder();
    let results = folder.path().join("results");
    std::fs::create_dir_all(results.join(CASE)).expect("a folder");
    std::fs::write(results.join(CASE).join("dashpot"), "in the way").expect("a file");
    let output = anechoic(folder.path(), &narrow(&["compare", CASE, "--jobs", "1"]));
    assert_eq!(output.code, 3, "{}", output.err);
    assert!(
        output.err.contains("compression-1d/dashpot"),
        "{}",
        output.err
    );
    assert!(
        output.err.contains("could not be written"),
        "{}",
        output.err
    );
    assert!(run_folder(&results, "fixed").join("record.json").is_file());
}

/// Files end at 64 KiB, as on a disk that fills: a record is larger.
#[cfg(unix)]
#[test]
fn a_disk_that_fills_midway_leaves_what_was_finished() {
    let folder = folder();
    let results = folder.path().join("results");
    let whole = anechoic(folder.path(), &narrow(&["run", CASE, "--method", "fixed"]));
    assert_eq!(whole.code, 0, "{}", whole.err);
    let series = run_folder(&results, "fixed").join("receivers.csv");
    let before = read(&series);
    assert!(before.len() > 65536);

    // Past the limit a write fails, if the signal that comes with it is ignored.
    let shell = "trap '' XFSZ; ulimit -f 128; exec \"$0\" \"$@\"";
    let output = Command::new("sh")
        .arg("-c")
        .arg(shell)
        .arg(binary())
        .args(narrow(&["run", CASE, "--method", "dashpot"]))
        .current_dir(folder.path())
        .output()
        .expect("a shell");
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{err}");
    assert!(
        err.contains("receivers.csv") && err.contains("could not be written"),
        "{err}"
    );
    assert_eq!(read(&series), before);
    let left = std::fs::read_dir(results.join(CASE).join("dashpot")).expect("a folder");
    assert_eq!(left.count(), 0, "nothing half written stays");
}

#[test]
fn a_solution_that_is_not_finite_is_stored_and_the_others_go_on() {
    let folder = folder();
    let sets = [
        "compare",
        CASE,
        "--jobs",
        "2",
        "--set",
        "source.amplitude_m_s=1e308",
    ];
    let output = anechoic(folder.path(), &narrow(&sets));
    assert_eq!(output.code, 3, "{}", output.err);
    assert!(output.out.contains("not evaluated"), "{}", output.out);
    let results = folder.path().join("results");
    for method in ["fixed", "dashpot", "damping-layer", "pml", "extended"] {
        assert!(
            output.err.contains(&format!("{method}: failed")),
            "{}",
            output.err
        );
        let manifest = read(&run_folder(&results, method).join("manifest.json"));
        for word in ["not finite", "in step ", "(t = ", "] m"] {
            assert!(manifest.contains(word), "{word} is missing in {manifest}");
        }
    }
    assert!(results.join(CASE).join("report.html").is_file());
}

#[test]
fn points_that_are_turned_inside_out_end_the_run_and_leave_the_steps_before() {
    let folder = folder();
    let sets = [
        "run",
        CASE,
        "--set",
        "source.amplitude_m_s=30",
        "--set",
        "points.mode=moving",
        "--set",
        "points.transfer=affine",
    ];
    let output = anechoic(folder.path(), &narrow(&sets));
    assert_eq!(output.code, 3, "{}", output.err);
    for word in ["inverted in step", "t = ", "det F", "time.dt_s"] {
        assert!(
            output.err.contains(word),
            "{word} is missing in {}",
            output.err
        );
    }
    let run = run_folder(&folder.path().join("results"), "fixed");
    let series = read(&run.join("receivers.csv"));
    let steps = series.lines().count();
    assert!(steps > 100 && steps < 800, "{steps}");
    assert!(!series.contains("NaN") && !series.contains("inf"));
}

#[cfg(unix)]
#[test]
fn an_interrupt_keeps_what_is_finished_and_marks_the_rest() {
    let folder = folder();
    let results = folder.path().join("results");
    let sets = [
        "compare", CASE, "--jobs", "1", "--method", "fixed", "--method", "extended",
    ];
    // The extended column is so long that it does not end by itself.
    let long = ["--set", "extended.thickness_m=100000"];
    let mut child = Command::new(binary())
        .current_dir(folder.path())
        .args(narrow(&[&sets[..], &long].concat()))
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .expect("the program starts");
    wait_for(&results.join(CASE).join("fixed"), &mut child);
    std::thread::sleep(Duration::from_millis(500));
    let interrupted = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status()
        .expect("kill runs");
    assert!(interrupted.success());
    assert_eq!(child.wait().expect("it ends").code(), Some(3));
    let status = |method| read(&run_folder(&results, method).join("manifest.json"));
    assert!(status("fixed").contains("\"complete\""));
    assert!(status("extended").contains("\"cancelled\""));
    assert!(results.join(CASE).join("report.html").is_file());
}
