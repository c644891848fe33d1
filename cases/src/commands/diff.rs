//! `diff`: what changed from one results folder, study or run to another.

use crate::error::CaseError;
use crate::store::read_json;
use anechoic_reports::diff::{Diff, Filed, diff};
use anechoic_reports::row::Row;
use std::path::{Path, PathBuf};

/// Rows of a study, and of a run.
const SUMMARY: &str = "summary.json";
const METRICS: &str = "metrics.json";

/// What a path holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Holds {
    /// Several studies.
    Results,
    /// One study, or a file of rows.
    Study,
    /// One run.
    Run,
}

impl Holds {
    fn name(self) -> &'static str {
        match self {
            Holds::Results => "a results folder",
            Holds::Study => "a study",
            Holds::Run => "a run",
        }
    }
}

/// Compares the rows of two results folders, two studies, or two runs; of runs, method and profile
/// may differ, since there is one on each side only.
///
/// # Errors
/// [`CaseError::Usage`] for two things that are not alike, [`CaseError::NoRecords`],
/// [`CaseError::Unreadable`].
pub fn compare_rows(before: &Path, after: &Path, rel_tol: f64) -> Result<Diff, CaseError> {
    let (old, new) = (read(before)?, read(after)?);
    if old.0 != new.0 {
        return Err(CaseError::Usage(format!(
            "{} is {}, {} is {}: both must be of one kind",
            before.display(),
            old.0.name(),
            after.display(),
            new.0.name()
        )));
    }
    Ok(diff(&old.1, &new.1, rel_tol))
}

fn read(path: &Path) -> Result<(Holds, Vec<Filed>), CaseError> {
    let file = |name: &str| Some(path.join(name)).filter(|file| file.is_file());
    if path.is_file() {
        if path.extension().is_none_or(|ending| ending != "json") {
            return Err(CaseError::Usage(format!(
                "{}: not a file of rows; {SUMMARY} of a study or {METRICS} of a run is, or its folder",
                path.display()
            )));
        }
        return Ok((Holds::Study, rows_of_file(path)?));
    }
    if let Some(summary) = file(SUMMARY) {
        return Ok((Holds::Study, rows(&summary, "")?));
    }
    if let Some(metrics) = file(METRICS) {
        let mut rows = rows(&metrics, "")?;
        for filed in &mut rows {
            filed.row.method.clear();
            filed.row.profile.clear();
        }
        return Ok((Holds::Run, rows));
    }
    let listing = std::fs::read_dir(path).map_err(|source| CaseError::Read {
        path: path.to_owned(),
        source,
    })?;
    let mut studies: Vec<PathBuf> = listing.flatten().map(|entry| entry.path()).collect();
    studies.retain(|study| study.join(SUMMARY).is_file());
    studies.sort();
    if studies.is_empty() {
        return Err(CaseError::NoRecords(path.to_owned()));
    }
    let mut all = Vec::new();
    for study in studies {
        let name = study.file_name().unwrap_or_default().to_string_lossy();
        all.extend(rows(&study.join(SUMMARY), &name)?);
    }
    Ok((Holds::Results, all))
}

/// The rows of a file that was named itself: one that holds other JSON is the wrong file.
fn rows_of_file(path: &Path) -> Result<Vec<Filed>, CaseError> {
    let text = std::fs::read_to_string(path).map_err(|source| CaseError::Read {
        path: path.to_owned(),
        source,
    })?;
    let is_json = serde_json::from_str::<serde_json::Value>(&text);
    let has_rows = |value: &serde_json::Value| {
        let list = value.as_array();
        list.is_some_and(|list| list.iter().all(|row| row.get("metric").is_some()))
    };
    match is_json {
        Ok(value) if !has_rows(&value) => Err(CaseError::Usage(format!(
            "{}: holds no rows; {SUMMARY} of a study or {METRICS} of a run does",
            path.display()
        ))),
        _ => rows(path, ""),
    }
}

fn rows(file: &Path, study: &str) -> Result<Vec<Filed>, CaseError> {
    let rows: Vec<Row> = read_json(file).map_err(|error| CaseError::Unreadable {
        path: file.to_owned(),
        reason: match error {
            CaseError::BadRecord { reason, .. } => reason,
            other => other.to_string(),
        },
    })?;
    let filed = |row| Filed {
        study: study.to_owned(),
        row,
    };
    Ok(rows.into_iter().map(filed).collect())
}
