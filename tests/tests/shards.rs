//! Studies that are shared out among processes: merged, they have the bits of one that was not.
#![cfg(unix)]

use anechoic_tests::program::{
    NARROW, Output, anechoic, binary, folder, narrow, read, rows, wait_for,
};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

const CASE: &str = "compression-1d";

/// Fifteen runs, a second of work in all.
const SWEEP: [&str; 6] = ["sweep", CASE, "--over", "grid.h_m=2,1,0.5", "--jobs", "1"];

/// What a machine spends is not a result.
const COSTS: [&str; 3] = ["cpu_s", "wall_s", "us_per_point_step"];

/// Calls the program and insists on an exit code.
#[track_caller]
fn call(root: &Path, arguments: &[&str], code: i32) -> Output {
    let output = anechoic(root, arguments);
    assert_eq!(
        output.code, code,
        "{arguments:?}: {}{}",
        output.err, output.out
    );
    output
}

fn study(root: &Path) -> PathBuf {
    root.join("results").join("compression-1d-sweep")
}

/// The subfolders or files of a folder, in order.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let list = std::fs::read_dir(folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<PathBuf> = list.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
}

/// Everything that must not depend on who solved what: records and rows, without what a machine spends.
fn bits(study: &Path) -> BTreeMap<String, String> {
    let mut bits = BTreeMap::new();
    for method in entries(study).into_iter().filter(|path| path.is_dir()) {
        for run in entries(&method) {
            for name in ["receivers.csv", "energy.csv", "record.json", "scene.toml"] {
                let file = run.join(name);
                let key = file.strip_prefix(study).expect("below it");
                bits.insert(key.display().to_string(), read(&file));
            }
        }
    }
    let summary = rows(&read(&study.join("summary.json")));
    let kept = |row: &&Value| !COSTS.iter().any(|cost| row["metric"] == *cost);
    let rows: Vec<String> = summary.iter().filter(kept).map(Value::to_string).collect();
    assert!(rows.len() > 30, "{}", rows.len());
    bits.insert("summary.json".into(), rows.join("\n"));
    bits
}

#[track_caller]
fn same_bits(a: &Path, b: &Path) {
    let [a, b] = [a, b].map(bits);
    let names = |bits: &BTreeMap<String, String>| bits.keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(&a), names(&b));
    for (name, text) in &a {
        assert!(*text == b[name], "{name} differs");
    }
}

/// The study in one go.
fn serial() -> tempfile::TempDir {
    let whole = folder();
    call(whole.path(), &narrow(&SWEEP), 0);
    whole
}

/// The folders of a shard's runs, in the plan's order.
fn share(root: &Path, shard: &str) -> Vec<PathBuf> {
    let how = ["--shard", shard, "--dry-run", "--format", "json"];
    let output = call(root, &narrow(&[&SWEEP[..], &how].concat()), 0);
    let folder = |run: &Value| root.join(run["folder"].as_str().expect("a path"));
    rows(&output.out).iter().map(folder).collect()
}

#[test]
fn two_workers_of_which_one_is_killed_merge_to_the_serial_study() {
    let whole = serial();
    let shared = folder();
    let root = shared.path();
    let shards = [share(root, "1/2"), share(root, "2/2")];
    assert_eq!(shards.each_ref().map(Vec::len), [8, 7]);
    assert!(shards[0].iter().all(|run| !shards[1].contains(run)));

    let start = |shard: &str, how: &[&str]| {
        Command::new(binary())
            .current_dir(root)
            .args(narrow(&[&SWEEP[..], &["--shard", shard], how].concat()))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("the program starts")
    };
    let mut first = start("1/2", &[]);
    let mut second = start("2/2", &[]);
    wait_for(&shards[1][2], &mut second);
    second.kill().expect("it is killed");
    second.wait().expect("it is gone");
    assert!(!shards[1][6].exists(), "it was killed after its last run");
    // What a kill within a write leaves.
    let method = shards[1][6].parent().expect("a method's folder");
    let left = method.join(".unfinished-killed");
    std::fs::create_dir_all(&left).expect("a folder");
    std::fs::write(left.join("scene.toml"), "case = ").expect("written");

    // While the other one may still be at work.
    let how = ["--shard", "2/2", "--resume"];
    let gone_on = call(root, &narrow(&[&SWEEP[..], &how].concat()), 0);
    assert!(left.exists(), "it may be another worker's");
    assert!(first.wait().expect("it ends").success());
    let there: usize = number_before(&gone_on.out, "were there");
    let solved: usize = number_before(&gone_on.out, "solved");
    assert!(there >= 3 && solved >= 1, "{}", gone_on.out);
    assert_eq!(there + solved, 7, "{}", gone_on.out);
    assert!(gone_on.out.contains("--resume\n"), "{}", gone_on.out);
    assert!(!gone_on.out.contains("--shard"), "{}", gone_on.out);
    let files: Vec<PathBuf> = entries(&study(root));
    assert!(files.iter().all(|path| path.is_dir()), "{files:?}");

    let merge = narrow(&[&SWEEP[..], &["--resume"]].concat());
    let plan = call(root, &[&merge[..], &["--dry-run"]].concat(), 0);
    assert!(
        plan.out.contains("would solve 0 runs, take 15"),
        "{}",
        plan.out
    );
    call(root, &merge, 0);
    assert!(!left.exists());
    same_bits(&study(whole.path()), &study(root));
    let announced = |root: &Path| read(&study(root).join("study.json"));
    assert_eq!(announced(whole.path()), announced(root));
}

/// The number before a word.
#[track_caller]
fn number_before(text: &str, word: &str) -> usize {
    let before = text.split(word).next().expect("a text");
    let number = before.split_whitespace().next_back();
    let number = number.and_then(|number| number.parse().ok());
    number.unwrap_or_else(|| panic!("no number before {word} in {text}"))
}

#[test]
fn missing_references_are_shared_out_as_well() {
    // Half-spaces whose certified references do not come with the program.
    let sweep = [
        "sweep",
        "point-source",
        "--profile",
        "gate",
        "--method",
        "dashpot",
        "--set",
        "grid.h_m=100",
        "--over",
        "material.nu=0.3,0.31",
        "--jobs",
        "1",
    ];
    let tables = |root: &Path| {
        let folder = root.join("results/certified");
        let name = |path: PathBuf| path.file_name().expect("a name").to_owned();
        entries(&folder).into_iter().map(name).collect::<Vec<_>>()
    };
    let with = |how: &[&'static str]| [&sweep[..], how].concat();
    let (whole, first, second) = (folder(), folder(), folder());
    let of_sweep = |root: &Path| root.join("results/point-source-sweep");
    let serial = anechoic(whole.path(), &sweep);
    call(first.path(), &with(&["--shard", "1/2"]), 0);
    let told = call(second.path(), &with(&["--shard", "2/2"]), 0);
    assert!(told.out.contains("certified reference"), "{}", told.out);
    let mut both = [tables(first.path()), tables(second.path())].concat();
    both.sort();
    assert_eq!(both, tables(whole.path()), "each is solved for once");
    assert_ne!(tables(first.path()), tables(second.path()));

    call(first.path(), &with(&["--shard", "2/2", "--resume"]), 0);
    let merged = anechoic(first.path(), &with(&["--resume"]));
    assert_eq!(merged.code, serial.code, "{}", merged.err);
    same_bits(&of_sweep(whole.path()), &of_sweep(first.path()));
}

#[test]
fn shares_that_are_none_are_refused_with_what_is_expected() {
    let folder = folder();
    for shard in ["3/2", "0/2", "x", "1/0", "-1/2"] {
        let shard = format!("--shard={shard}");
        let output = call(folder.path(), &[&SWEEP[..], &[&shard]].concat(), 2);
        assert!(output.err.contains("for example 1/4"), "{}", output.err);
    }
    let output = call(folder.path(), &["run", CASE, "--shard", "1/2"], 2);
    assert!(output.err.contains("compare, ablation"), "{}", output.err);
    let animated = ["compare", CASE, "--animate", "--shard", "1/2"];
    call(folder.path(), &animated, 2);
    assert!(!folder.path().join("results").exists());
}

#[test]
fn a_share_without_runs_says_so() {
    let folder = folder();
    let compare = ["compare", CASE, "--method", "dashpot", "--shard", "2/2"];
    let output = call(folder.path(), &narrow(&compare), 0);
    assert!(output.out.contains("nothing to do"), "{}", output.out);
}

#[test]
fn a_run_that_fails_is_stored_and_told() {
    let folder = folder();
    let compare = [
        "compare",
        CASE,
        "--method",
        "fixed",
        "--set",
        "points.mode=moving",
        "--set",
        "points.transfer=affine",
        "--set",
        "source.amplitude_m_s=1e6",
        "--shard",
        "1/1",
    ];
    let output = call(folder.path(), &narrow(&compare), 3);
    assert!(output.out.contains("fixed: failed: "), "{}", output.out);
    assert!(
        !folder
            .path()
            .join("results")
            .join(CASE)
            .join("study.json")
            .exists()
    );
}

/// Writes the sweep down in three shards.
fn planned(root: &Path) {
    let plan = ["plan", "--shards", "3", "--into", "jobs", "--"];
    let output = call(root, &narrow(&[&plan[..], &SWEEP].concat()), 0);
    assert!(output.out.contains("15 runs"), "{}", output.out);
}

#[test]
fn the_slurm_scripts_do_the_serial_study() {
    let whole = serial();
    let shared = folder();
    let root = shared.path();
    planned(root);
    let script = read(&root.join("jobs/slurm.sh"));
    for line in ["#SBATCH --array=1-3", "#SBATCH --output=jobs/log/%a.txt"] {
        assert!(script.contains(line), "{line} is missing in {script}");
    }
    assert!(root.join("jobs/log").is_dir());
    let bash = |script: &str, task: &str| {
        let output = Command::new("bash")
            .current_dir(root)
            .arg(script)
            .env("SLURM_ARRAY_TASK_ID", task)
            .env_remove("ANECHOIC")
            .output()
            .expect("bash starts");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{script} {task}: {text}");
    };
    for task in ["3", "1", "2"] {
        bash("jobs/slurm.sh", task);
        assert!(!study(root).join("study.json").exists());
    }
    bash("jobs/slurm-merge.sh", "");
    same_bits(&study(whole.path()), &study(root));
}

#[test]
fn the_snakemake_workflow_does_the_serial_study() {
    if Command::new("snakemake").arg("--version").output().is_err() {
        eprintln!("not evaluated: there is no snakemake on this machine");
        return;
    }
    let whole = serial();
    let shared = folder();
    let root = shared.path();
    planned(root);
    let snakemake = || {
        let output = Command::new("snakemake")
            .current_dir(root)
            .args(["-s", "jobs/Snakefile", "--cores", "2"])
            .output()
            .expect("snakemake starts");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{text}");
        text
    };
    let text = snakemake();
    assert!(text.contains("4 of 4 steps"), "{text}");
    same_bits(&study(whole.path()), &study(root));
    for log in ["1", "2", "3"] {
        let log = read(&root.join(format!("jobs/log/{log}.txt")));
        assert!(log.contains("5 solved, 0 were there"), "{log}");
    }
    assert!(snakemake().contains("Nothing to be done"));
    // A shard that has to be done again takes its runs from the disk.
    for done in ["2", "merge"] {
        std::fs::remove_file(root.join("jobs/done").join(done)).expect("it was done");
    }
    snakemake();
    let log = read(&root.join("jobs/log/2.txt"));
    assert!(log.contains("nothing to do, 5 were there"), "{log}");
}

#[test]
fn a_plan_has_as_many_shards_as_its_work_asks_for() {
    let folder = folder();
    let root = folder.path();
    let shards = |dir: &str, study: &[&str]| {
        call(root, &[&["plan", "--into", dir, "--"], study].concat(), 0);
        let script = read(&root.join(dir).join("slurm.sh"));
        let after = |key: &str| {
            let after = script.split(key).nth(1).expect("it is there");
            let digits: String = after.chars().take_while(char::is_ascii_digit).collect();
            digits.parse::<u32>().expect("a number")
        };
        [after("--array=1-"), after("--time="), after("--mem=")]
    };
    let small = shards(
        "small",
        &[&SWEEP[..], &["--profile", "gate"], &NARROW].concat(),
    );
    let large = ["sweep", "appendix-a", "--profile", "paper"];
    let [jobs, minutes, megabytes] = shards("large", &large);
    assert_eq!(small[0], 1);
    assert!((5..75).contains(&jobs), "{jobs}");
    assert!(small[1] < minutes && small[2] < megabytes);
    // With several threads a job does more.
    let threads = [&large[..], &["--jobs", "4"]].concat();
    assert!(shards("threads", &threads)[0] < jobs);
    assert!(read(&root.join("threads/slurm.sh")).contains("--cpus-per-task=4"));
    assert!(!root.join("results").exists());
}

#[test]
fn what_cannot_be_planned_is_refused() {
    let folder = folder();
    let plan = ["plan", "--into", "jobs", "--"];
    let sweep = narrow(&SWEEP);
    for (before, command, word) in [
        (&plan[..], &["run", CASE][..], "only a study"),
        (&plan, &["list"], "only a study"),
        (
            &plan,
            &["plan", "--into", "x", "--", "list"],
            "only a study",
        ),
        (&plan, &["sweeep", CASE], "unrecognized subcommand"),
        (&plan, &["compare", CASE, "--animate"], "--animate"),
        (&plan, &["compare", CASE, "--failed"], "--failed"),
        (&plan, &["compare", CASE, "--dry-run"], "--dry-run"),
        (&plan, &["compare", CASE, "--shard", "1/2"], "--shard 1/2"),
        (&["plan", "--into", "a b", "--"], &sweep, "--into a b"),
        (
            &["plan", "--into", "jobs", "--shards", "16", "--"],
            &sweep,
            "15 runs make no more than 15",
        ),
    ] {
        let output = call(folder.path(), &[before, command].concat(), 2);
        assert!(output.err.contains(word), "{word}: {}", output.err);
    }
    assert!(entries(folder.path()).is_empty());
}
