//! `atlas`: what the sides of a scene reflect of plane waves.

use super::{Options, plan};
use crate::atlas::measure::measure_all;
use crate::atlas::subject::Subject;
use crate::atlas::{pictures, rows};
use crate::error::{CaseError, exit};
use crate::filter::Filter;
use crate::prepare::{Prepared, Target};
use crate::store::{Store, write_file};
use crate::{provenance, study};
use anechoic_reports::export::{junit_xml, summary_csv, summary_json};
use anechoic_reports::html;
use anechoic_reports::judge::Tally;
use anechoic_reports::row::Row;
use anechoic_reports::study::{RunSummary, Study};
use anechoic_solver::record::Status;
use std::path::PathBuf;

/// A finished atlas.
#[derive(Debug)]
pub struct Atlas {
    /// The rows that the filter chooses; all without one.
    pub rows: Vec<Row>,
    /// What could not be judged, and why.
    pub notes: Vec<String>,
    /// The report.
    pub report: PathBuf,
}

impl Atlas {
    /// The exit code: a claim that failed, or none that could be judged.
    pub fn exit_code(&self) -> u8 {
        match Tally::of(&self.rows) {
            tally if tally.fail > 0 => exit::GATE_FAILED,
            tally if tally.not_evaluated > 0 && tally.pass == 0 => exit::REFERENCE_MISSING,
            _ => exit::PASS,
        }
    }
}

/// Measures the reflection of plane waves from the sides of all methods of a scene that apply (or of
/// those that are named), judges it by closed forms, and writes rows, pictures and report.
///
/// # Errors
/// Whatever is wrong with the request; what cannot be measured; [`CaseError::Storage`].
pub fn atlas(options: &Options) -> Result<Atlas, CaseError> {
    let target = Target::find(&options.request)?;
    let scenes = scenes(&target, options)?;
    let store = Store::open(&options.out, &format!("{}-atlas", target.info.name))?;
    let subjects = scenes.iter().map(Subject::of);
    let subjects = subjects.collect::<Result<Vec<_>, _>>()?;
    let measured = measure_all(subjects, options.jobs)?;
    let (all, notes) = rows::rows(target.info.name, target.profile.name, &measured);
    let folder = store.folder();
    let failed = |what: &str, error: &dyn std::fmt::Display| CaseError::Report {
        what: what.to_owned(),
        reason: error.to_string(),
    };
    for (name, made) in [
        ("summary.json", summary_json(&all)),
        ("summary.csv", summary_csv(&all)),
        ("junit.xml", junit_xml(&all)),
    ] {
        let text = made.map_err(|error| failed(name, &error))?;
        write_file(&folder.join(name), text.as_bytes())?;
    }
    let drawn = pictures::draw(&measured).map_err(|(name, error)| failed(name, &error))?;
    let figures = drawn.iter().map(|p| study::save_picture(folder, p));
    let page = Study {
        case: target.info.name.to_owned(),
        title: format!("{}: reflection of plane waves", target.info.name),
        summary: "What comes back of plane P and S waves of the source's frequency from an endless side with each method, measured on a strip by the solver's own steps in a harmonic state and judged by closed forms of the continuum. Points rest, whatever the scene says.".to_owned(),
        profile: target.profile.name.to_owned(),
        command: options.command.clone(),
        rows: all.clone(),
        ranking: None,
        convergence: None,
        runs: scenes.iter().map(summary_of).collect(),
        ledger: Vec::new(),
        notes: notes.clone(),
        figures: figures.collect::<Result<_, _>>()?,
    };
    let report = folder.join("report.html");
    write_file(&report, html::report(&page).as_bytes())?;
    let filter = options.filter.as_ref().map(|text| Filter(text.clone()));
    Ok(Atlas {
        rows: match filter {
            Some(filter) => filter.choose(&all)?,
            None => all,
        },
        notes,
        report,
    })
}

/// The scene with each method that is asked for.
fn scenes(target: &Target, options: &Options) -> Result<Vec<Prepared>, CaseError> {
    let all = target.info.methods.iter().filter(|m| !m.on_request);
    let names: Vec<&str> = match options.methods.as_slice() {
        [] => all.map(|m| m.name).collect(),
        asked => asked.iter().map(String::as_str).collect(),
    };
    let prepared = names.iter().map(|name| target.prepare(Some(name)));
    let prepared = prepared.collect::<Result<Vec<_>, _>>()?;
    // an assignment is lost if it reached no method
    let lost = |set: &&String| prepared.iter().all(|scene| scene.unused.contains(set));
    let unused = prepared.first().map(|scene| &scene.unused);
    let unused: Vec<String> = unused.into_iter().flatten().filter(lost).cloned().collect();
    plan::refuse_unused(&unused)?;
    Ok(prepared)
}

fn summary_of(scene: &Prepared) -> RunSummary {
    RunSummary {
        method: scene.method.clone(),
        status: Status::Complete,
        cost: None,
        provenance: provenance::of(&scene.hash()),
    }
}
