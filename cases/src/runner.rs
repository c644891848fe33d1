//! Solves prepared scenes, each on one thread, several at a time, and stores each as it ends.

use crate::error::CaseError;
use crate::frames::{Frames, Sampling};
use crate::posed::{Posed, either};
use crate::prepare::Prepared;
use crate::progress::Progress;
use crate::resume::folder;
use crate::store::{Manifest, Store};
use anechoic_solver::record::{Cost, Record, SeriesTable, Status};
use cpu_time::{ProcessTime, ThreadTime};
use rayon::ThreadPool;
use rayon::prelude::*;
use std::path::PathBuf;
use std::time::Instant;

/// A scene with what it left.
#[derive(Debug)]
pub struct Run {
    /// The scene as run.
    pub prepared: Prepared,
    /// How it ended and where it comes from.
    pub manifest: Manifest,
    /// What was recorded.
    pub record: Record,
    /// Fields over time, where they were asked for; not part of the stored record.
    pub frames: Frames,
}

impl Run {
    /// Were all steps made?
    pub fn complete(&self) -> bool {
        self.record.status == Status::Complete
    }
}

/// What there is to do for one run of a study.
#[derive(Debug)]
pub enum Task {
    /// To solve a scene.
    Solve(Box<Prepared>),
    /// Nothing: the run was read back.
    Take(Box<Run>),
}

impl Task {
    /// The scene.
    pub fn scene(&self) -> &Prepared {
        match self {
            Task::Solve(scene) => scene,
            Task::Take(run) => &run.prepared,
        }
    }

    /// Folder of the run below that of its study.
    pub fn folder(&self) -> PathBuf {
        match self {
            Task::Solve(scene) => folder(scene),
            Task::Take(run) => run.manifest.folder(),
        }
    }

    /// Point-steps to make.
    fn work(&self) -> u64 {
        match self {
            Task::Solve(scene) => scene.bill.points as u64 * scene.bill.steps as u64,
            Task::Take(_) => 0,
        }
    }
}

/// Does all tasks with `jobs` threads and stores each run as it is solved; the order is kept.
///
/// A scene whose solver fails is stored as such and the others go on.
///
/// # Errors
/// [`CaseError::Storage`] when a result cannot be written; what was written before stays.
pub fn run_all(
    tasks: Vec<Task>,
    sampling: Sampling,
    jobs: usize,
    store: &Store,
) -> Result<Vec<Run>, CaseError> {
    let progress = Progress::new(tasks.iter().map(Task::work).sum());
    let solved = tasks.iter().filter(|t| matches!(t, Task::Solve(_)));
    let alone = jobs > 1 && solved.count() == 1;
    let runs = pool(jobs)?.install(|| {
        tasks
            .into_par_iter()
            .with_max_len(1)
            .map(|task| match task {
                Task::Take(run) => Ok(*run),
                Task::Solve(scene) => {
                    let run = run_one(*scene, sampling, &progress, alone);
                    store.save(&run).map(|()| run)
                }
            })
            .collect()
    });
    progress.finish();
    runs
}

/// Threads for `jobs` runs at a time.
///
/// # Errors
/// [`CaseError::Usage`] when the system has none left.
pub fn pool(jobs: usize) -> Result<ThreadPool, CaseError> {
    rayon::ThreadPoolBuilder::new()
        .num_threads(jobs)
        .build()
        .map_err(|error| CaseError::Usage(format!("--jobs {jobs}: {error}")))
}

/// Solves one scene and measures what it costs: on this thread, or on all of the pool where it is alone.
fn run_one(prepared: Prepared, sampling: Sampling, progress: &Progress, alone: bool) -> Run {
    let scene = prepared.scene.posed();
    let problem = either!(&scene, scene => {
        let mut problem = sampling.of(scene);
        problem.flow.shared = alone;
        Posed::from(problem)
    });
    let monitor = progress.monitor(prepared.bill.points);
    let mut outcome = None;
    let (wall, cpu, all) = (Instant::now(), ThreadTime::now(), ProcessTime::now());
    let memory = allocation_counter::measure(|| outcome = Some(problem.solve(&monitor)));
    let cpu = if alone { all.elapsed() } else { cpu.elapsed() };
    let (wall_s, cpu_s) = (wall.elapsed().as_secs_f64(), cpu.as_secs_f64());
    let mut record = match outcome.expect("measure calls its closure once") {
        Ok(outcome) => {
            let mut record = outcome.record;
            if let Some(error) = outcome.error {
                record.status = Status::Failed(error.to_string());
            }
            record
        }
        Err(error) => nothing(error.to_string()),
    };
    let frames = either!(&scene, scene => sampling.part(scene, &mut record));
    record.cost.wall_s = wall_s;
    record.cost.cpu_s = cpu_s;
    record.cost.peak_bytes = memory.bytes_max;
    let manifest = Manifest::of(&prepared, &record);
    Run {
        prepared,
        manifest,
        record,
        frames,
    }
}

/// The record of a run that did not start.
fn nothing(reason: String) -> Record {
    Record {
        status: Status::Failed(reason),
        receivers: SeriesTable::default(),
        energy: SeriesTable::default(),
        bodies: SeriesTable::default(),
        lines: Vec::new(),
        snapshots: Vec::new(),
        cost: Cost::default(),
    }
}
