//! What the program does, for callers that are not its command line: nothing here prints.

mod atlas;
mod diff;
mod export;
mod plan;
mod references;
mod score;
mod share;
mod workflow;

use crate::certified::Certified;
use crate::certified::library::Library;
use crate::certified::solve::{compute, difference, measure_floor};
use crate::error::{CaseError, exit};
use crate::filter::Filter;
use crate::frames::Sampling;
use crate::over::Over;
use crate::prepare::{Prepared, Request, Target};
use crate::resume::{Reuse, Todo, folder, tasks};
use crate::runner::{Task, run_all};
use crate::spectrum;
use crate::store::Store;
use crate::study::stored::{Found, Study, find_studies};
use crate::study::{ANIMATION, Kind, Published, publish};
use crate::timing;
use anechoic_reports::judge::Tally;
use anechoic_reports::row::{Row, Verdict};
use anechoic_solver::record::Status;
pub use atlas::{Atlas, atlas};
pub use diff::compare_rows;
pub use export::{Exported, export};
pub use plan::Plan;
pub use score::{ScoreOptions, score};
pub use share::{Share, Solved, share};
use std::path::{Path, PathBuf};
pub use workflow::{Workflow, workflow};

/// What `run` and `compare` are asked.
#[derive(Clone, Debug)]
pub struct Options {
    /// Case or file, profile, presets, assignments.
    pub request: Request,
    /// Methods by name. `run` takes one at most and the scene's sides without; `compare` takes all
    /// that apply without.
    pub methods: Vec<String>,
    /// Rows, and the methods that they need.
    pub filter: Option<String>,
    /// Results folder.
    pub out: PathBuf,
    /// Fields over time.
    pub sampling: Sampling,
    /// Runs at a time.
    pub jobs: usize,
    /// How often runs are timed, at most; 0: not at all.
    pub repeats: usize,
    /// What is taken from earlier commands instead of solved.
    pub reuse: Reuse,
    /// The command as typed, for the report.
    pub command: String,
}

impl Options {
    /// A case with everything else left as it is; results go to `out`.
    pub fn new(case: &str, out: &Path) -> Self {
        Options {
            request: Request {
                target: case.to_owned(),
                ..Request::default()
            },
            methods: Vec::new(),
            filter: None,
            out: out.to_owned(),
            sampling: Sampling::default(),
            jobs: 1,
            repeats: 0,
            reuse: Reuse::Nothing,
            command: format!("anechoic {case}"),
        }
    }

    /// The same under another profile.
    pub fn profile(mut self, name: &str) -> Self {
        self.request.profile = Some(name.to_owned());
        self
    }

    /// The same with an assignment `field=value`.
    pub fn set(mut self, assignment: &str) -> Self {
        self.request.sets.push(assignment.to_owned());
        self
    }

    /// The same with a method; repeatable for `compare`.
    pub fn method(mut self, name: &str) -> Self {
        self.methods.push(name.to_owned());
        self
    }
}

/// A finished command.
#[derive(Debug)]
pub struct Finished {
    /// The study with all its rows.
    pub study: Published,
    /// The rows that the filter chooses; all without one.
    pub rows: Vec<Row>,
}

impl Finished {
    fn new(study: Published, filter: Option<&Filter>) -> Result<Self, CaseError> {
        let rows = match filter {
            Some(filter) => filter.choose(&study.rows)?,
            None => study.rows.clone(),
        };
        Ok(Finished { study, rows })
    }

    /// Were claims made, of which none could be judged?
    pub fn nothing_judged(&self) -> bool {
        let tally = Tally::of(&self.rows);
        tally.not_evaluated > 0 && tally.pass + tally.fail == 0
    }

    /// The exit code: failed, stopped or damaged runs, then failed claims, then claims without a reference or
    /// none of which could be judged.
    pub fn exit_code(&self) -> u8 {
        let failed = |row: &Row| row.verdict == Some(Verdict::Fail);
        let ended = |run: &crate::runner::Run| match run.record.status {
            Status::Complete => true,
            Status::Cancelled => false,
            Status::Failed(_) => self.study.kind.failure_is_answer(),
        };
        if !self.study.damaged.is_empty() || !self.study.runs.iter().all(ended) {
            exit::SOLVER_FAILED
        } else if self.rows.iter().any(failed) {
            exit::GATE_FAILED
        } else if self.study.reference_missing.is_some() || self.nothing_judged() {
            exit::REFERENCE_MISSING
        } else {
            exit::PASS
        }
    }
}

/// The scene that `show` shows: the case's or file's, with a method if one is named.
///
/// # Errors
/// Whatever is wrong with the request.
pub fn show(request: &Request, method: Option<&str>) -> Result<Prepared, CaseError> {
    let prepared = Target::find(request)?.prepare(method)?;
    plan::refuse_unused(&prepared.unused)?;
    Ok(prepared)
}

/// What `run` would do.
///
/// # Errors
/// Whatever is wrong with the request.
pub fn plan_run(options: &Options) -> Result<Plan, CaseError> {
    Plan::run(options)
}

/// What `compare` would do.
///
/// # Errors
/// Whatever is wrong with the request.
pub fn plan_compare(options: &Options) -> Result<Plan, CaseError> {
    Plan::compare(options)
}

/// Solves one scene with one method and judges it.
///
/// # Errors
/// Whatever is wrong with the request, found before the solve; [`CaseError::Storage`] after it.
pub fn run(options: &Options) -> Result<Finished, CaseError> {
    execute(Plan::run(options)?, options)
}

/// Solves one scene with all methods that apply, judges and ranks them.
///
/// # Errors
/// As [`run`]. A method whose solver fails is no error: it is a run that failed.
pub fn compare(options: &Options) -> Result<Finished, CaseError> {
    execute(Plan::compare(options)?, options)
}

/// What `ablation` would do.
///
/// # Errors
/// Whatever is wrong with the request.
pub fn plan_ablation(options: &Options) -> Result<Plan, CaseError> {
    Plan::ablation(options)
}

/// Takes a scene's method apart: solves its variants and judges what each part absorbs.
///
/// # Errors
/// As [`run`].
pub fn ablation(options: &Options) -> Result<Finished, CaseError> {
    execute(Plan::ablation(options)?, options)
}

/// What `converge` would do.
///
/// # Errors
/// Whatever is wrong with the request.
pub fn plan_converge(options: &Options, over: &[Over], budget: bool) -> Result<Plan, CaseError> {
    Plan::converge(options, over, budget)
}

/// Solves one scene with one method on all levels of refinements, and judges the orders with which
/// its errors fall; with a `budget`, once more for each cause of its errors.
///
/// # Errors
/// As [`run`].
pub fn converge(options: &Options, over: &[Over], budget: bool) -> Result<Finished, CaseError> {
    execute(Plan::converge(options, over, budget)?, options)
}

/// What `sweep` would do.
///
/// # Errors
/// Whatever is wrong with the request.
pub fn plan_sweep(options: &Options, over: &[String]) -> Result<Plan, CaseError> {
    Plan::sweep(options, over)
}

/// Solves one scene at the points of a sweep, with several methods: a named sweep, or what `over` says.
///
/// # Errors
/// As [`run`].
pub fn sweep(options: &Options, over: &[String]) -> Result<Finished, CaseError> {
    execute(Plan::sweep(options, over)?, options)
}

/// What `tradeoff` would do.
///
/// # Errors
/// Whatever is wrong with the request.
pub fn plan_tradeoff(options: &Options) -> Result<Plan, CaseError> {
    Plan::tradeoff(options)
}

/// Solves one scene with each method on its ladder, times the runs up to `repeats` times each, and
/// sets error against cost.
///
/// # Errors
/// As [`run`].
pub fn tradeoff(options: &Options, repeats: usize) -> Result<Finished, CaseError> {
    let options = Options {
        repeats,
        ..options.clone()
    };
    execute(Plan::tradeoff(&options)?, &options)
}

/// What `stability` would do.
///
/// # Errors
/// Whatever is wrong with the request.
pub fn plan_stability(options: &Options) -> Result<Plan, CaseError> {
    Plan::stability(options)
}

/// Solves one scene with all methods at extremes, and says which stay stable.
///
/// # Errors
/// As [`run`].
pub fn stability(options: &Options) -> Result<Finished, CaseError> {
    execute(Plan::stability(options)?, options)
}

/// A certified reference that was computed.
#[derive(Debug)]
pub struct Recomputed {
    /// The reference, with its floor.
    pub reference: Certified,
    /// Its tables.
    pub files: Vec<PathBuf>,
    /// Largest difference from the one that was stored before, over each receiver's peak.
    pub change: Option<f64>,
}

/// Computes the certified reference of a scene with its floor, compares it with the stored one, and
/// stores it in `folder`.
///
/// # Errors
/// Whatever is wrong with the request; [`CaseError::Usage`] for a scene with a closed form.
pub fn reference(request: &Request, folder: &Path) -> Result<Recomputed, CaseError> {
    let target = Target::find(request)?;
    // Any method that applies will do, since its sides are extended: the standard one always does.
    let prepared = target.prepare(Some(target.info.standard))?;
    let case = prepared.info.name;
    let Some(problem) = prepared.scene.extended() else {
        return Err(CaseError::Usage(format!(
            "{case} has a closed form: its reference needs no computation"
        )));
    };
    let library = Library::of_folder(folder);
    let before = library.find(case, &problem)?;
    let mut reference = compute(case, &problem)?;
    measure_floor(&mut reference, &problem)?;
    Ok(Recomputed {
        change: before.and_then(|before| difference(&reference, &before)),
        files: library.save(&reference)?,
        reference,
    })
}

/// Studies that were judged again from their records.
#[derive(Debug)]
pub struct Rebuilt {
    /// The studies; what is damaged in them is in their notes.
    pub studies: Vec<Finished>,
    /// What is wrong with studies of which nothing can be read.
    pub unreadable: Vec<CaseError>,
}

impl Rebuilt {
    /// The exit code: that of the worst study.
    pub fn exit_code(&self) -> u8 {
        if !self.unreadable.is_empty() {
            return exit::SOLVER_FAILED;
        }
        let codes: Vec<u8> = self.studies.iter().map(Finished::exit_code).collect();
        let has = |code: &u8| codes.contains(code);
        let worst = [
            exit::SOLVER_FAILED,
            exit::GATE_FAILED,
            exit::REFERENCE_MISSING,
        ];
        worst.into_iter().find(has).unwrap_or(exit::PASS)
    }
}

/// Judges and shows stored studies again, without solving. Runs whose records are damaged are named
/// and the others shown.
///
/// # Errors
/// [`CaseError::NoRecords`], and when the report cannot be written.
pub fn report(folder: &Path, filter: Option<&str>) -> Result<Rebuilt, CaseError> {
    let filter = filter.map(|text| Filter(text.to_owned()));
    let Found {
        studies,
        unreadable,
    } = find_studies(folder)?;
    let studies = studies
        .into_iter()
        .map(|study| Finished::new(publish(study)?, filter.as_ref()))
        .collect::<Result<_, CaseError>>()?;
    Ok(Rebuilt {
        studies,
        unreadable,
    })
}

/// Solves what a plan says, judges and publishes it.
///
/// # Errors
/// As [`run`].
pub fn execute(plan: Plan, options: &Options) -> Result<Finished, CaseError> {
    let store = Store::open(&options.out, &plan.folder())?;
    if options.reuse != Reuse::Nothing {
        // What is half written there is of a command that was killed.
        for scene in &plan.scenes {
            store.sweep(&folder(scene))?;
        }
    }
    let Todo { tasks, left_out } = tasks(plan.scenes, store.folder(), &plan.kind, options)?;
    let left_out = left_out.into_iter();
    let notes: Vec<String> = left_out
        .map(|(scene, why)| format!("{} is left out: {why}", plan.kind.name_of_scene(&scene)))
        .collect();
    let mut finished = execute_tasks(tasks, &store, plan.filter.as_ref(), plan.kind, options)?;
    finished.study.notes.extend(notes);
    Ok(finished)
}

/// Does what there is to do for a study and publishes it.
fn execute_tasks(
    tasks: Vec<Task>,
    store: &Store,
    filter: Option<&Filter>,
    kind: Kind,
    options: &Options,
) -> Result<Finished, CaseError> {
    let study = Study {
        folder: store.folder().to_owned(),
        kind,
        command: options.command.clone(),
        order: tasks.iter().map(|task| task.folder()).collect(),
        runs: Vec::new(),
        damaged: Vec::new(),
    };
    if study.kind.has_echoes() {
        let wanted = references::wanted(tasks.iter().map(Task::scene));
        references::provide(&wanted, &Library::of_results(&options.out), options.jobs)?;
    }
    study.announce()?;
    // One of earlier runs would not show these; that there is none is no failure.
    let _ = std::fs::remove_file(store.folder().join(ANIMATION));
    // whatever was timed before is no time of what is solved again
    let again = tasks.iter().filter(|task| matches!(task, Task::Solve(_)));
    let again: Vec<String> = again
        .map(|task| task.folder().display().to_string())
        .collect();
    timing::forget_some(store.folder(), &again)?;
    let runs = run_all(tasks, options.sampling, options.jobs, store)?;
    if options.repeats > 0 {
        if options.reuse == Reuse::Nothing {
            timing::forget(store.folder())?;
        }
        timing::measure(&runs, store.folder(), options.repeats)?;
    }
    if let Kind::Stability(grid) = &study.kind {
        spectrum::measure(&runs, grid, store.folder(), options.jobs)?;
    }
    Finished::new(publish(Study { runs, ..study })?, filter)
}
