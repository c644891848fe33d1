//! Which runs of a plan are solved, and which are read back from an earlier command.
//!
//! A run is found by its method and the hash of its input. It is read back when every file of it is
//! what it was when it was written and all its steps were made. `--resume` asks in addition that this
//! program made it (see [`made_by_this_program`]), since only then the study has the bits of one that
//! was never interrupted. `--failed` does not: it is for trying again after a change of the program,
//! and what ran well is kept; the report's provenance tells which run is whose.

use crate::commands::Options;
use crate::error::CaseError;
use crate::frames::Sampling;
use crate::prepare::Prepared;
use crate::provenance::made_by_this_program;
use crate::runner::{Run, Task};
use crate::store::{FIELDS, load};
use crate::study::Kind;
use anechoic_solver::record::Status;
use std::path::{Path, PathBuf};

/// What is taken from earlier commands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reuse {
    /// Nothing: every run is solved.
    #[default]
    Nothing,
    /// Runs that are whole and complete; all others are solved.
    Whole,
    /// Runs that are complete; those that failed, were stopped or are damaged are solved, and those
    /// that were never made are left out.
    AllButFailed,
}

/// What becomes of a run of a plan.
#[derive(Debug)]
pub enum Decision {
    /// It is solved, for a reason.
    Solve(String),
    /// It is read back.
    Take(Box<Run>),
    /// It is left out, for a reason.
    Leave(String),
}

impl Decision {
    /// What becomes of a scene in the study's folder.
    pub fn of(
        scene: &Prepared,
        study: &Path,
        kind: &Kind,
        reuse: Reuse,
        sampling: Sampling,
    ) -> Self {
        let folder = study.join(folder(scene));
        match (reuse, folder.is_dir()) {
            (Reuse::Nothing, _) => return Decision::Solve("every run is solved".into()),
            (Reuse::Whole, false) => return Decision::Solve("it is missing".into()),
            (Reuse::AllButFailed, false) => {
                return Decision::Leave(
                    "it was never made, so that it did not fail; --resume solves it".into(),
                );
            }
            (_, true) => {}
        }
        let run = match load(&folder) {
            Ok(run) => run,
            Err(error) => return Decision::Solve(format!("it is damaged: {error}")),
        };
        match &run.manifest.status {
            Status::Complete => {}
            Status::Cancelled => return Decision::Solve("it was stopped before its end".into()),
            Status::Failed(_) if reuse == Reuse::Whole && kind.failure_is_answer() => {}
            Status::Failed(error) => return Decision::Solve(format!("it failed: {error}")),
        }
        // Rows carry the profile's name; the same values may have been run under another.
        if run.manifest.profile != scene.profile {
            return Decision::Solve(format!("it was run as profile {}", run.manifest.profile));
        }
        if sampling.animation {
            return Decision::Solve(
                "its fields over time are not stored, and are asked for".into(),
            );
        }
        if sampling.fields && !folder.join(FIELDS).is_file() {
            return Decision::Solve("its fields for ParaView are asked for".into());
        }
        match made_by_this_program(&run.manifest.provenance) {
            Err(why) if reuse == Reuse::Whole => Decision::Solve(why),
            _ => Decision::Take(Box::new(run)),
        }
    }

    /// The word for what is done.
    pub fn word(&self) -> &'static str {
        match self {
            Decision::Solve(_) => "solve",
            Decision::Take(_) => "take from disk",
            Decision::Leave(_) => "leave out",
        }
    }

    /// Why, where that is not plain.
    pub fn why(&self) -> &str {
        match self {
            Decision::Solve(why) | Decision::Leave(why) => why,
            Decision::Take(_) => "it is whole and complete",
        }
    }
}

/// Folder of a scene's run below that of its study.
pub fn folder(scene: &Prepared) -> PathBuf {
    Path::new(&scene.method).join(scene.hash())
}

/// What there is to do for a study.
#[derive(Debug, Default)]
pub struct Todo {
    /// Runs to solve and runs that were read back, in their order.
    pub tasks: Vec<Task>,
    /// Scenes that are left out, and why.
    pub left_out: Vec<(Prepared, String)>,
}

/// What there is to do for some scenes.
///
/// # Errors
/// [`CaseError::Usage`] when nothing is left.
pub fn tasks(
    scenes: Vec<Prepared>,
    study: &Path,
    kind: &Kind,
    options: &Options,
) -> Result<Todo, CaseError> {
    let mut todo = Todo::default();
    for scene in scenes {
        match Decision::of(&scene, study, kind, options.reuse, options.sampling) {
            Decision::Solve(_) => todo.tasks.push(Task::Solve(Box::new(scene))),
            // The scene as asked is the scene as stored: their hashes are the same.
            Decision::Take(run) => todo.tasks.push(Task::Take(Box::new(Run {
                prepared: scene,
                ..*run
            }))),
            Decision::Leave(why) => todo.left_out.push((scene, why)),
        }
    }
    if todo.tasks.is_empty() {
        return Err(CaseError::Usage(format!(
            "{}: none of these runs was made, so that none failed; without --failed they are solved",
            study.display()
        )));
    }
    Ok(todo)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frames::Frames;
    use crate::prepare::{Request, Target};
    use crate::store::{Manifest, Store};
    use crate::sweep::Grid;
    use anechoic_solver::record::{Cost, Record, SeriesTable};

    fn prepared(profile: &str) -> Prepared {
        let request = Request {
            target: "compression-1d".into(),
            profile: Some(profile.into()),
            ..Request::default()
        };
        Target::find(&request)
            .unwrap()
            .prepare(Some("fixed"))
            .unwrap()
    }

    /// Stores a run without series after `change` has had its way with it.
    fn stored(root: &Path, change: impl FnOnce(&mut Manifest)) -> Store {
        let store = Store::open(root, "compression-1d").unwrap();
        let prepared = prepared("gate");
        let mut record = Record {
            status: Status::Complete,
            receivers: SeriesTable::default(),
            energy: SeriesTable::default(),
            bodies: SeriesTable::default(),
            lines: Vec::new(),
            snapshots: Vec::new(),
            cost: Cost::default(),
        };
        let mut manifest = Manifest::of(&prepared, &record);
        change(&mut manifest);
        record.status = manifest.status.clone();
        let run = Run {
            prepared,
            manifest,
            record,
            frames: Frames::default(),
        };
        store.save(&run).unwrap();
        store
    }

    fn decided(reuse: Reuse, change: impl FnOnce(&mut Manifest)) -> (&'static str, String) {
        decided_with(reuse, Sampling::default(), change)
    }

    fn decided_with(
        reuse: Reuse,
        sampling: Sampling,
        change: impl FnOnce(&mut Manifest),
    ) -> (&'static str, String) {
        let root = tempfile::tempdir().unwrap();
        let store = stored(root.path(), change);
        let decision = Decision::of(
            &prepared("gate"),
            store.folder(),
            &Kind::Comparison,
            reuse,
            sampling,
        );
        (decision.word(), decision.why().to_owned())
    }

    #[test]
    fn a_whole_run_of_this_program_is_taken() {
        assert_eq!(decided(Reuse::Whole, |_| ()).0, "take from disk");
        assert_eq!(decided(Reuse::AllButFailed, |_| ()).0, "take from disk");
        assert_eq!(decided(Reuse::Nothing, |_| ()).0, "solve");
    }

    #[test]
    fn a_run_of_another_program_is_solved_by_resume_and_kept_by_failed() {
        let other = |m: &mut Manifest| m.provenance.sources = "0".repeat(16);
        let (word, why) = decided(Reuse::Whole, other);
        assert!(word == "solve" && why.contains("another program"), "{why}");
        assert_eq!(decided(Reuse::AllButFailed, other).0, "take from disk");
    }

    #[test]
    fn fields_that_are_asked_for_and_not_there_have_to_be_solved_for() {
        for (fields, animation) in [(true, false), (false, true)] {
            let sampling = Sampling { fields, animation };
            let (word, why) = decided_with(Reuse::Whole, sampling, |_| ());
            assert!(word == "solve" && why.contains("asked for"), "{why}");
        }
    }

    #[test]
    fn what_failed_or_was_stopped_is_solved_by_both() {
        for reuse in [Reuse::Whole, Reuse::AllButFailed] {
            let (word, why) = decided(reuse, |m| m.status = Status::Failed("det F".into()));
            assert!(word == "solve" && why.contains("det F"), "{why}");
            let (word, why) = decided(reuse, |m| m.status = Status::Cancelled);
            assert!(word == "solve" && why.contains("stopped"), "{why}");
            let (word, why) = decided(reuse, |m| m.profile = "quick".into());
            assert!(word == "solve" && why.contains("profile quick"), "{why}");
        }
    }

    #[test]
    fn at_extremes_a_failure_is_an_answer_that_is_kept() {
        let root = tempfile::tempdir().unwrap();
        let failed = |m: &mut Manifest| m.status = Status::Failed("det F".into());
        let store = stored(root.path(), failed);
        let kind = Kind::Stability(Grid::default());
        let of = |reuse| {
            let scene = prepared("gate");
            let decision = Decision::of(&scene, store.folder(), &kind, reuse, Sampling::default());
            decision.word()
        };
        assert_eq!(of(Reuse::Whole), "take from disk");
        assert_eq!(of(Reuse::AllButFailed), "solve");
    }

    #[test]
    fn what_is_missing_is_solved_by_resume_and_left_out_by_failed() {
        let root = tempfile::tempdir().unwrap();
        let kind = Kind::Comparison;
        let of = |reuse| {
            let scene = prepared("gate");
            Decision::of(&scene, root.path(), &kind, reuse, Sampling::default())
        };
        assert_eq!(of(Reuse::Whole).word(), "solve");
        assert_eq!(of(Reuse::AllButFailed).word(), "leave out");
        let mut options = Options::new("compression-1d", root.path());
        options.reuse = Reuse::AllButFailed;
        let nothing = tasks(vec![prepared("gate")], root.path(), &kind, &options);
        assert!(nothing.unwrap_err().to_string().contains("--failed"));
    }

    #[test]
    fn what_a_killed_program_left_is_swept() {
        let root = tempfile::tempdir().unwrap();
        let store = stored(root.path(), |_| ());
        let run = folder(&prepared("gate"));
        let left = store.folder().join("fixed/.unfinished-abc");
        std::fs::create_dir(&left).unwrap();
        std::fs::write(left.join("scene.toml"), "case = ").unwrap();
        store.sweep(&run).unwrap();
        assert!(!left.exists() && store.folder().join(run).is_dir());
    }
}
