//! Studies on disk: which runs belong together, and which of them can no longer be read.

use super::Kind;
use crate::error::CaseError;
use crate::runner::Run;
use crate::store::{MANIFEST, json, load, read_json, write_file};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Name of the study's file.
const STUDY: &str = "study.json";

/// Which runs make a study; stored beside its report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct StudyFile {
    /// What it is for.
    #[serde(default)]
    kind: Kind,
    /// The command that made it.
    command: String,
    /// Folders of the runs, below the case's folder, in the order of the comparison.
    runs: Vec<PathBuf>,
}

/// A run that belongs to a study and cannot be read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Damage {
    /// Its folder, below that of the study.
    pub folder: PathBuf,
    /// The file and what is wrong with it.
    pub reason: String,
}

impl Damage {
    /// The run's method: its folder is `METHOD/HASH`.
    pub fn method(&self) -> String {
        let method = self.folder.parent().unwrap_or(&self.folder);
        method.display().to_string()
    }
}

/// A study: what was solved, or read back.
#[derive(Debug)]
pub struct Study {
    /// The case's folder.
    pub folder: PathBuf,
    /// What it is for.
    pub kind: Kind,
    /// The command that made it.
    pub command: String,
    /// Folders of all its runs, in the order of the comparison.
    pub order: Vec<PathBuf>,
    /// Its runs.
    pub runs: Vec<Run>,
    /// Those that cannot be read.
    pub damaged: Vec<Damage>,
}

impl Study {
    /// Writes down which runs belong to it, so that what is finished can be shown whatever happens
    /// to the rest.
    ///
    /// # Errors
    /// [`CaseError::Storage`].
    pub fn announce(&self) -> Result<(), CaseError> {
        let file = StudyFile {
            kind: self.kind.clone(),
            command: self.command.clone(),
            runs: self.order.clone(),
        };
        write_file(&self.folder.join(STUDY), &json(&file)?)
    }
}

/// Studies below a folder, and those of which nothing can be read.
#[derive(Debug, Default)]
pub struct Found {
    /// The studies; each has a run at least.
    pub studies: Vec<Study>,
    /// What is wrong with the others.
    pub unreadable: Vec<CaseError>,
}

/// The studies below a folder: it is a case's folder, or holds some.
///
/// # Errors
/// [`CaseError::Read`] and [`CaseError::NoRecords`] for a folder without studies.
pub fn find_studies(folder: &Path) -> Result<Found, CaseError> {
    let mut folders = vec![folder.to_owned()];
    let listing = std::fs::read_dir(folder).map_err(|source| CaseError::Read {
        path: folder.to_owned(),
        source,
    })?;
    let mut below: Vec<PathBuf> = listing.flatten().map(|entry| entry.path()).collect();
    below.sort();
    folders.extend(below);
    let mut found = Found::default();
    for folder in folders.iter().filter(|f| f.join(STUDY).is_file()) {
        match read_study(folder) {
            Ok(study) => found.studies.push(study),
            Err(error) => found.unreadable.push(error),
        }
    }
    if found.studies.is_empty() && found.unreadable.is_empty() {
        // CASE/METHOD/HASH
        return Err(match holds_run(folder, 3) {
            Some(study) => CaseError::NoStudy(study),
            None => CaseError::NoRecords(folder.to_owned()),
        });
    }
    Ok(found)
}

/// The first folder of a run at most so many levels below `folder`, as the folder of its study.
fn holds_run(folder: &Path, levels: usize) -> Option<PathBuf> {
    if folder.join(MANIFEST).is_file() {
        return Some(folder.ancestors().nth(2).unwrap_or(folder).to_owned());
    }
    let mut below: Vec<PathBuf> = std::fs::read_dir(folder)
        .ok()?
        .flatten()
        .map(|entry| entry.path())
        .collect();
    below.sort();
    let levels = levels.checked_sub(1)?;
    below.iter().find_map(|folder| holds_run(folder, levels))
}

/// The study of a folder with the runs that can be read.
///
/// # Errors
/// What is wrong with its file; [`CaseError::NothingWhole`].
pub fn read_study(folder: &Path) -> Result<Study, CaseError> {
    let file: StudyFile = read_json(&folder.join(STUDY))?;
    let (mut runs, mut damaged) = (Vec::new(), Vec::new());
    for run in &file.runs {
        match load(&folder.join(run)) {
            Ok(run) => runs.push(run),
            Err(error) => damaged.push(Damage {
                folder: run.clone(),
                reason: error.to_string(),
            }),
        }
    }
    if runs.is_empty() {
        let first = damaged.first();
        return Err(CaseError::NothingWhole {
            path: folder.to_owned(),
            reason: first.map_or("it has none".to_owned(), |damage| damage.reason.clone()),
        });
    }
    Ok(Study {
        folder: folder.to_owned(),
        kind: file.kind,
        command: file.command,
        order: file.runs,
        runs,
        damaged,
    })
}
