//! A shard's work: its share of a plan's runs and references, stored and not judged.
//!
//! Shards of one study may be at work at the same time, so that a shard writes nothing that another
//! one writes: neither the study's file nor rows nor pictures, and what a killed process has left is
//! swept by the merge alone.

use super::references::{Wanted, provide, wanted};
use super::{Options, Plan};
use crate::certified::library::Library;
use crate::error::{CaseError, exit};
use crate::prepare::Prepared;
use crate::progress::stopped;
use crate::resume::{Decision, folder};
use crate::runner::{Run, Task, run_all};
use crate::shard::Shard;
use crate::store::Store;
use crate::timing;
use anechoic_solver::record::Status;
use std::collections::BTreeSet;
use std::path::PathBuf;

/// A run that a shard has solved.
#[derive(Clone, Debug)]
pub struct Solved {
    /// What tells it from the others of its study.
    pub name: String,
    /// Its folder.
    pub folder: PathBuf,
    /// How it ended.
    pub status: Status,
}

/// What a shard did.
#[derive(Debug)]
pub struct Share {
    /// Which.
    pub shard: Shard,
    /// Distinct runs of the whole plan.
    pub runs: usize,
    /// The runs that it solved.
    pub solved: Vec<Solved>,
    /// Runs of its share that were there.
    pub taken: usize,
    /// Runs of its share that are left out, and why.
    pub left_out: Vec<(String, String)>,
    /// Hashes of the certified references that it solved for.
    pub references: Vec<String>,
    /// Hashes of those that could not be computed: the merge tries again and says why.
    pub without: Vec<String>,
    /// The command that merges, as typed but for the shard.
    pub merge: String,
    failure_is_answer: bool,
    stopped: bool,
}

impl Share {
    /// The exit code: that of runs that failed or were stopped, where failing is no answer.
    pub fn exit_code(&self) -> u8 {
        let failed =
            |run: &Solved| matches!(run.status, Status::Failed(_)) && !self.failure_is_answer;
        if self.stopped || self.solved.iter().any(failed) {
            exit::SOLVER_FAILED
        } else {
            exit::PASS
        }
    }
}

impl Plan {
    /// Keeps the share of the runs that a shard solves, each once.
    pub fn keep(&mut self, shard: Shard) {
        self.keep_distinct();
        let mut place = 0..;
        self.scenes
            .retain(|_| place.next().is_some_and(|place| shard.has(place)));
    }

    /// Each run once: two processes must not write the same folder.
    pub(super) fn keep_distinct(&mut self) {
        let mut known = BTreeSet::new();
        self.scenes.retain(|scene| known.insert(folder(scene)));
    }
}

/// Solves a shard's share of a plan.
///
/// # Errors
/// As [`run`](super::run). A method whose solver fails is no error: it is a run that failed.
pub fn share(mut plan: Plan, options: &Options, shard: Shard) -> Result<Share, CaseError> {
    let store = Store::open(&options.out, &plan.folder())?;
    plan.keep_distinct();
    let (kind, runs) = (plan.kind.clone(), plan.scenes.len());
    let [references, without] = if kind.has_echoes() {
        provide_share(&plan.scenes, options, shard)?
    } else {
        Default::default()
    };
    plan.keep(shard);
    let (mut tasks, mut taken, mut left_out) = (Vec::new(), 0, Vec::new());
    for scene in plan.scenes {
        match Decision::of(
            &scene,
            store.folder(),
            &kind,
            options.reuse,
            options.sampling,
        ) {
            Decision::Solve(_) => tasks.push(Task::Solve(Box::new(scene))),
            Decision::Take(_) => taken += 1,
            Decision::Leave(why) => left_out.push((kind.name_of_scene(&scene), why)),
        }
    }
    if !tasks.is_empty() {
        // Whatever was timed before is no time of these.
        timing::remove(store.folder())?;
    }
    let of = |run: Run| Solved {
        name: kind.name(&run),
        folder: store.run_folder(&run.manifest),
        status: run.record.status,
    };
    let solved = run_all(tasks, options.sampling, options.jobs, &store)?;
    Ok(Share {
        shard,
        runs,
        solved: solved.into_iter().map(of).collect(),
        taken,
        left_out,
        references,
        without,
        merge: format!("{} --resume", options.command),
        failure_is_answer: kind.failure_is_answer(),
        stopped: stopped(),
    })
}

/// Solves for the shard's share of the plan's references that are missing; those that are there now,
/// and those that are not.
fn provide_share(
    scenes: &[Prepared],
    options: &Options,
    shard: Shard,
) -> Result<[Vec<String>; 2], CaseError> {
    let library = Library::of_results(&options.out);
    let missing = |all: Vec<Wanted>| -> Result<Vec<Wanted>, CaseError> {
        let mut missing = Vec::new();
        for one in all {
            if one.is_missing(&library)? {
                missing.push(one);
            }
        }
        Ok(missing)
    };
    let own = missing(shard.of(wanted(scenes)))?;
    provide(&own, &library, options.jobs)?;
    let all: Vec<String> = own.iter().map(|one| one.hash.clone()).collect();
    let failed: Vec<String> = missing(own)?.into_iter().map(|one| one.hash).collect();
    let solved = all.into_iter().filter(|hash| !failed.contains(hash));
    Ok([solved.collect(), failed])
}
