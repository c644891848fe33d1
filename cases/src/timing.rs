//! Timing runs: a scene solved again, alone, for the time that it takes. Accuracy runs share the
//! machine with others and sample fields; these do not.

use crate::error::CaseError;
use crate::posed::{Posed, either};
use crate::progress::{Progress, stopped};
use crate::runner::Run;
use crate::store::{json, read_json, write_file};
use anechoic_reports::tradeoff::Timing;
use anechoic_solver::record::Status;
use cpu_time::ThreadTime;
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// Name of the file in a study's folder.
const TIMING: &str = "timing.json";

/// Seconds that are spent on the repeats of one run, at most: long runs average over themselves.
const BUDGET_S: f64 = 20.0;

/// Runs shorter than this (s) are warmed up by one that does not count.
const SHORT_S: f64 = 2.0;

/// Times by the run's folder.
pub type Timings = BTreeMap<String, Timing>;

/// The times of a study's folder; none where nothing was timed.
///
/// # Errors
/// [`CaseError::BadRecord`] for a damaged file.
pub fn load(folder: &Path) -> Result<Timings, CaseError> {
    let path = folder.join(TIMING);
    if path.is_file() {
        read_json(&path)
    } else {
        Ok(Timings::new())
    }
}

/// Forgets the times of a study that is made anew.
///
/// # Errors
/// [`CaseError::Storage`].
pub fn forget(folder: &Path) -> Result<(), CaseError> {
    write_file(&folder.join(TIMING), &json(&Timings::new())?)
}

/// Forgets the times of runs that are solved again, by their folders.
///
/// # Errors
/// [`CaseError::Storage`], and what [`load`] says.
pub fn forget_some(folder: &Path, keys: &[String]) -> Result<(), CaseError> {
    let mut timings = load(folder)?;
    let known = timings.len();
    timings.retain(|key, _| !keys.contains(key));
    if timings.len() == known {
        return Ok(());
    }
    write_file(&folder.join(TIMING), &json(&timings)?)
}

/// Takes the times of a study away, whoever else does so at the same time.
///
/// # Errors
/// [`CaseError::Storage`].
pub fn remove(folder: &Path) -> Result<(), CaseError> {
    let path = folder.join(TIMING);
    match std::fs::remove_file(&path) {
        Err(source) if source.kind() != ErrorKind::NotFound => {
            Err(CaseError::Storage { path, source })
        }
        _ => Ok(()),
    }
}

/// Times all complete runs that are not in the study's file, up to `repeats` times each, one after the
/// other, and stores each as it is made.
///
/// # Errors
/// [`CaseError::Storage`], and what [`load`] says.
pub fn measure(runs: &[Run], folder: &Path, repeats: usize) -> Result<(), CaseError> {
    let mut timings = load(folder)?;
    let wanted: Vec<&Run> = runs
        .iter()
        .filter(|run| run.complete() && !timings.contains_key(&key(run)))
        .collect();
    let work = |run: &Run| {
        let bill = &run.prepared.bill;
        (times(run, repeats) * bill.points * bill.steps) as u64
    };
    let progress = Progress::new(wanted.iter().map(|run| work(run)).sum());
    for run in wanted {
        let problem = bare(run);
        if run.record.cost.cpu_s < SHORT_S && once(&problem, run, &progress).is_none() {
            continue;
        }
        let measured = (0..times(run, repeats)).map_while(|_| once(&problem, run, &progress));
        if let Some(timing) = Timing::of(measured.collect()) {
            timings.insert(key(run), timing);
            write_file(&folder.join(TIMING), &json(&timings)?)?;
        }
        if stopped() {
            break;
        }
    }
    progress.finish();
    Ok(())
}

/// The run's folder, by which its time is found.
pub fn key(run: &Run) -> String {
    run.manifest.folder().display().to_string()
}

/// How often a run is repeated.
fn times(run: &Run, repeats: usize) -> usize {
    repeated(run.record.cost.cpu_s, repeats)
}

/// How often a run of so many seconds is repeated.
fn repeated(cpu_s: f64, repeats: usize) -> usize {
    let fit = BUDGET_S / cpu_s.max(1e-3);
    (fit as usize).clamp(1, repeats.max(1))
}

/// What timing a run of so many seconds takes (s), with the one that warms up.
pub fn seconds(cpu_s: f64, repeats: usize) -> f64 {
    let warm = if cpu_s < SHORT_S { cpu_s } else { 0.0 };
    warm + cpu_s * repeated(cpu_s, repeats) as f64
}

/// The problem without what is sampled for pictures.
fn bare(run: &Run) -> Posed {
    let mut posed = run.prepared.scene.posed();
    either!(&mut posed, problem => {
        problem.probes.lines.clear();
        problem.probes.snapshot_times.clear();
    });
    posed
}

/// CPU time (s) of one solve; none if it failed or was stopped.
fn once(problem: &Posed, run: &Run, progress: &Progress) -> Option<f64> {
    let monitor = progress.monitor(run.prepared.bill.points);
    let start = ThreadTime::now();
    let outcome = problem.solve(&monitor).ok()?;
    let time = start.elapsed().as_secs_f64();
    (outcome.record.status == Status::Complete).then_some(time)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_times_of_runs_that_are_solved_again_are_forgotten() {
        let folder = tempfile::tempdir().unwrap();
        let names = ["pml/a", "pml/b"].map(str::to_owned);
        let timing = Timing::of(vec![1.0]).unwrap();
        let known: Timings = names.iter().map(|name| (name.clone(), timing)).collect();
        write_file(&folder.path().join(TIMING), &json(&known).unwrap()).unwrap();
        forget_some(folder.path(), &[names[1].clone(), "pml/c".to_owned()]).unwrap();
        let left: Vec<String> = load(folder.path()).unwrap().into_keys().collect();
        assert_eq!(left, names[..1]);
    }
}
