//! What the program does, for callers that are not its command line: nothing here prints.

mod plan;

use crate::certified::Certified;
use crate::certified::library::Library;
use crate::certified::solve::{compute, difference, measure_floor};
use crate::error::{CaseError, exit};
use crate::filter::Filter;
use crate::over::Over;
use crate::prepare::{Prepared, Request, Target};
use crate::runner::run_all;
use crate::store::Store;
use crate::study::{Published, find_studies, publish};
use anechoic_reports::judge::Tally;
use anechoic_reports::row::{Row, Verdict};
use anechoic_solver::record::Status;
pub use plan::Plan;
use std::path::{Path, PathBuf};

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
    /// Runs at a time.
    pub jobs: usize,
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
            jobs: 1,
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

    /// The exit code: failed or stopped runs, then failed claims, then claims without a reference or
    /// none of which could be judged.
    pub fn exit_code(&self) -> u8 {
        let ended = |run: &crate::runner::Run| run.record.status == Status::Complete;
        let failed = |row: &Row| row.verdict == Some(Verdict::Fail);
        if !self.study.runs.iter().all(ended) {
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
pub fn plan_converge(options: &Options, over: &Over) -> Result<Plan, CaseError> {
    Plan::converge(options, over)
}

/// Solves one scene with one method on all levels of a refinement, and judges the orders with which
/// its errors fall.
///
/// # Errors
/// As [`run`].
pub fn converge(options: &Options, over: &Over) -> Result<Finished, CaseError> {
    execute(Plan::converge(options, over)?, options)
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

/// Judges and shows stored studies again, without solving.
///
/// # Errors
/// [`CaseError::NoRecords`], and what is wrong with a record.
pub fn report(folder: &Path, filter: Option<&str>) -> Result<Vec<Finished>, CaseError> {
    let filter = filter.map(|text| Filter(text.to_owned()));
    find_studies(folder)?
        .into_iter()
        .map(|study| {
            let published = publish(&study.folder, study.runs, study.kind, &study.command)?;
            Finished::new(published, filter.as_ref())
        })
        .collect()
}

fn execute(plan: Plan, options: &Options) -> Result<Finished, CaseError> {
    let store = Store::open(&options.out, &plan.folder())?;
    provide_references(&plan, &Library::of_results(&options.out))?;
    let runs = run_all(plan.scenes, options.jobs, &store)?;
    Finished::new(
        publish(store.folder(), runs, plan.kind, &options.command)?,
        plan.filter.as_ref(),
    )
}

/// Solves for the certified references that the scenes need and that nobody has stored.
///
/// One that cannot be computed is no error here: the runs go on, and their claims say why they were
/// not evaluated.
fn provide_references(plan: &Plan, library: &Library) -> Result<(), CaseError> {
    for scene in &plan.scenes {
        let Some(problem) = scene.scene.extended() else {
            continue;
        };
        match library.obtain(scene.info.name, &problem) {
            Ok(_) | Err(CaseError::Solver(_) | CaseError::Stopped(_)) => {}
            Err(error) => return Err(error),
        }
    }
    Ok(())
}
