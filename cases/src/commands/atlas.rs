//! `atlas`: what the sides of a scene reflect of plane waves.

use super::{Options, plan};
use crate::atlas::measure::measure_all;
use crate::atlas::subject::Subject;
use crate::atlas::{pictures, rows, surface};
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
/// those that are named), and of Rayleigh waves if `rayleigh` asks for it; judges it by closed forms, and
/// writes rows, pictures and report.
///
/// # Errors
/// Whatever is wrong with the request; what cannot be measured; [`CaseError::Storage`].
pub fn atlas(options: &Options, rayleigh: bool) -> Result<Atlas, CaseError> {
    let target = Target::find(&options.request)?;
    let (scenes, mut notes) = scenes(&target, options)?;
    let store = Store::open(&options.out, &format!("{}-atlas", target.info.name))?;
    let subjects = scenes.iter().map(Subject::of);
    let subjects = subjects.collect::<Result<Vec<_>, _>>()?;
    let returned = if rayleigh {
        surface::measure(&subjects, options.jobs)?
    } else {
        Vec::new()
    };
    let mut measured = measure_all(subjects, options.jobs)?;
    for (method, value) in measured.iter_mut().zip(returned) {
        method.surface = Some(value);
    }
    let (all, unjudged) = rows::rows(target.info.name, target.profile.name, &measured);
    notes.extend(unjudged);
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
        upshot: None,
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

/// The scene with each method that is asked for, and why others are left out: methods that nobody
/// named and that the scene refuses.
fn scenes(target: &Target, options: &Options) -> Result<(Vec<Prepared>, Vec<String>), CaseError> {
    let (mut scenes, mut left_out) = (Vec::new(), Vec::new());
    if options.methods.is_empty() {
        for method in target.info.methods.iter().filter(|m| !m.on_request) {
            match target.prepare(Some(method.name)) {
                Ok(scene) => scenes.push(scene),
                Err(error) => left_out.push((method.name, error)),
            }
        }
        if target.names_sides() {
            let described = target.prepare(None)?;
            scenes.retain(|scene| scene.method != described.method);
            scenes.push(described);
        }
    }
    for name in &options.methods {
        scenes.push(target.prepare(Some(name))?);
    }
    // what no method can be prepared with is wrong with the scene
    if scenes.is_empty()
        && let Some((_, error)) = left_out.pop()
    {
        return Err(error);
    }
    // an assignment is lost if it reached no method
    let lost = |set: &&String| scenes.iter().all(|scene| scene.unused.contains(set));
    let unused = scenes.first().map(|scene| &scene.unused);
    let unused: Vec<String> = unused.into_iter().flatten().filter(lost).cloned().collect();
    plan::refuse_unused(&unused)?;
    let notes = left_out.into_iter();
    let notes = notes.map(|(name, why)| format!("{name} is left out: {why}"));
    Ok((scenes, notes.collect()))
}

fn summary_of(scene: &Prepared) -> RunSummary {
    RunSummary {
        method: scene.method.clone(),
        status: Status::Complete,
        cost: None,
        provenance: provenance::of(&scene.hash()),
    }
}
