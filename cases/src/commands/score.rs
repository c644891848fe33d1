//! `score`: another program's series, judged by the rows of ours and put beside them.

use super::{Finished, Options, Plan, execute_tasks};
use crate::error::CaseError;
use crate::filter::Filter;
use crate::foreign::Foreign;
use crate::frames::{Frames, Sampling};
use crate::judge::{PAPER, REFERENCE};
use crate::prepare::{Prepared, Target};
use crate::resume::{Decision, Reuse};
use crate::runner::{Run, Task};
use crate::store::{Manifest, Scored, Store, sha256};
use crate::study::Kind;
use crate::study::stored::read_study;
use anechoic_reports::provenance::Provenance;
use anechoic_solver::record::{Cost, Record, SeriesTable, Status};
use std::path::{Path, PathBuf};

/// What `score` is asked beside the options of a comparison.
#[derive(Clone, Debug)]
pub struct ScoreOptions {
    /// Scene, results folder, rows; at most one method: the one of ours that the other program's
    /// boundary is a model of, whose claims then judge it.
    pub common: Options,
    /// The series.
    pub series: PathBuf,
    /// Name in rows; the file's stem without.
    pub name: Option<String>,
}

/// Judges the series beside the stored runs of the scene; solves the standard run where it is not
/// stored.
///
/// # Errors
/// Whatever is wrong with the request or the series, found before anything is solved.
pub fn score(options: &ScoreOptions) -> Result<Finished, CaseError> {
    let common = &options.common;
    let target = Target::find(&common.request)?;
    let model = match common.methods.as_slice() {
        [] => None,
        [one] => Some(one.as_str()),
        _ => return Err(CaseError::Usage("score takes one --method at most".into())),
    };
    let scene = target.prepare(model)?;
    super::plan::refuse_unused(&scene.unused)?;
    let name = name_of(options, &target)?;
    let (record, scored) = read(&options.series, &scene, model)?;
    let plan = Plan::compare(&Options {
        methods: Vec::new(),
        filter: None,
        ..common.clone()
    })?;
    let folder = plan.folder();
    let filter = common.filter.clone().map(Filter);
    let store = Store::open(&common.out, &folder)?;
    let hash = scene.hash();
    let run = Run {
        manifest: Manifest {
            case: scene.info.name.to_owned(),
            profile: scene.profile.clone(),
            method: name.clone(),
            status: Status::Complete,
            cost: Cost::default(),
            provenance: Provenance {
                version: "another program".to_owned(),
                revision: scored.sha256.clone(),
                input_hash: hash.clone(),
                ..Provenance::default()
            },
            hash,
            scored: Some(scored),
        },
        prepared: scene,
        record,
        frames: Frames::default(),
    };
    store.save(&run)?;
    let earlier = earlier(store.folder(), &run);
    let (mut tasks, absent) = ours(plan, store.folder(), target.info.standard);
    let others = earlier.into_iter().chain([run]);
    tasks.extend(others.map(|run| Task::Take(Box::new(run))));
    let mut finished = execute_tasks(tasks, &store, filter.as_ref(), Kind::Comparison, common)?;
    if !absent.is_empty() {
        finished.study.notes.push(format!(
            "not beside {name}: {}; `anechoic compare` with the same scene solves them, then score again",
            absent.join(", ")
        ));
    }
    Ok(finished)
}

/// The stored runs of our methods, the standard run in any case; and the names of the others.
fn ours(plan: Plan, study: &Path, standard: &str) -> (Vec<Task>, Vec<String>) {
    let (mut tasks, mut absent) = (Vec::new(), Vec::new());
    for scene in plan.scenes {
        match Decision::of(
            &scene,
            study,
            &Kind::Comparison,
            Reuse::AllButFailed,
            Sampling::default(),
        ) {
            Decision::Take(run) => tasks.push(Task::Take(Box::new(Run {
                prepared: scene,
                ..*run
            }))),
            _ if scene.method == standard => tasks.push(Task::Solve(Box::new(scene))),
            Decision::Leave(_) => absent.push(scene.method),
            Decision::Solve(why) => absent.push(format!("{} ({why})", scene.method)),
        }
    }
    (tasks, absent)
}

/// Series of other programs that were scored before on the same scene, its sides apart.
fn earlier(study: &Path, run: &Run) -> Vec<Run> {
    let without_sides = |scene: &Prepared| {
        let mut table = scene.table.clone();
        table.remove("boundary");
        table
    };
    // A study that cannot be read has none.
    let runs = read_study(study).map_or_else(|_| Vec::new(), |study| study.runs);
    let mut runs: Vec<Run> = runs
        .into_iter()
        .filter(|other| {
            other.manifest.scored.is_some()
                && other.manifest.method != run.manifest.method
                && other.manifest.profile == run.manifest.profile
                && without_sides(&other.prepared) == without_sides(&run.prepared)
        })
        .collect();
    runs.sort_by(|a, b| a.manifest.method.cmp(&b.manifest.method));
    runs
}

/// The record of the series at the scene's times.
fn read(path: &Path, scene: &Prepared, model: Option<&str>) -> Result<(Record, Scored), CaseError> {
    let Some(problem) = scene.scene.posed().plane() else {
        return Err(CaseError::Usage(format!(
            "score: {} is three-dimensional, and series are read of plane scenes alone",
            scene.info.name
        )));
    };
    let receivers = problem.probes.receivers.iter();
    let receivers: Vec<String> = receivers.map(|r| r.name.clone()).collect();
    let series = Foreign::read(path, &receivers)?;
    let steps = scene.bill.steps;
    let times: Vec<f64> = (0..=steps).map(|step| step as f64 * problem.dt).collect();
    series.covers(steps as f64 * problem.dt, problem.dt)?;
    let (receivers, mut notes) = series.at(&times);
    if scene.scene.extended().is_some() {
        notes.push("the certified reference is of our scheme on our mesh: what departs from it is the other discretisation as well as echo".to_owned());
    }
    let content = std::fs::read(path).map_err(|source| CaseError::Read {
        path: path.to_owned(),
        source,
    })?;
    let record = Record {
        status: Status::Complete,
        receivers,
        energy: SeriesTable::default(),
        bodies: SeriesTable::default(),
        lines: Vec::new(),
        snapshots: Vec::new(),
        cost: Cost::default(),
    };
    let scored = Scored {
        file: path.display().to_string(),
        sha256: sha256(&content),
        models: model.map(str::to_owned),
        notes,
    };
    Ok((record, scored))
}

/// The name in rows: letters, digits, `.`, `_`, `-`, and none of ours.
fn name_of(options: &ScoreOptions, target: &Target) -> Result<String, CaseError> {
    let stem = options
        .series
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy();
    let name = options.name.clone().unwrap_or_else(|| stem.into_owned());
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-".contains(c);
    if name.is_empty() || name.starts_with('.') || !name.chars().all(plain) {
        return Err(CaseError::Usage(format!(
            "--name `{name}`: allowed are letters, digits, `.` (not first), `_` and `-`"
        )));
    }
    if target.info.method(&name).is_some() || [PAPER, REFERENCE].contains(&name.as_str()) {
        return Err(CaseError::Usage(format!(
            "--name `{name}`: that is a name of ours; choose another"
        )));
    }
    Ok(name)
}
