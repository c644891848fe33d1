//! A study: runs that are judged and shown together. Everything here is made from records alone, so
//! that `report` makes the same again without solving.
//!
//! - [`stored`]: studies on disk.

pub mod stored;

use crate::certified::library::Library;
use crate::error::CaseError;
use crate::judge::references::References;
use crate::judge::{Judged, PAPER, REFERENCE, judge_runs, rows_unread};
use crate::pictures::{self, Picture, animation};
use crate::runner::Run;
use crate::store::{save_rows, write_file};
use anechoic_reports::export::{junit_xml, summary_csv, summary_json};
use anechoic_reports::html;
use anechoic_reports::plot::PlotError;
use anechoic_reports::provenance::Provenance;
use anechoic_reports::ranking::{Floor, Ranking};
use anechoic_reports::row::Row;
use anechoic_reports::study::{self as reports, Figure, LedgerEntry, RunSummary};
use anechoic_solver::record::Status;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use stored::{Damage, Study};

/// The metric that methods are ranked by.
const RANKED_BY: &str = "echo_ratio";

/// Name of the animation's file.
pub const ANIMATION: &str = "animation.gif";

/// What a study is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Methods side by side, ranked.
    #[default]
    Comparison,
    /// A method taken apart: what each part absorbs.
    Ablation,
}

impl Kind {
    /// Folder of a case's study of this kind.
    pub fn folder(self, case: &str) -> String {
        match self {
            Kind::Comparison => case.to_owned(),
            Kind::Ablation => format!("{case}-ablation"),
        }
    }
}

/// A judged and published study.
#[derive(Debug)]
pub struct Published {
    /// The runs.
    pub runs: Vec<Run>,
    /// Runs that cannot be read.
    pub damaged: Vec<Damage>,
    /// All rows.
    pub rows: Vec<Row>,
    /// Methods by their echo; `None` when no echo ratio was measured.
    pub ranking: Option<Ranking>,
    /// Why claims have no reference, if there are such claims.
    pub reference_missing: Option<String>,
    /// What is missing from the results and why, and what was done to series.
    pub notes: Vec<String>,
    /// The report.
    pub report: PathBuf,
    /// The animation, where it was asked for.
    pub animation: Option<PathBuf>,
}

/// Judges a study's runs and writes summary, JUnit, pictures and report into its folder.
///
/// # Errors
/// [`CaseError::Storage`] and [`CaseError::Report`].
pub fn publish(study: Study) -> Result<Published, CaseError> {
    let folder = study.folder.as_path();
    let results = folder.parent().unwrap_or(folder);
    let references = References::gather(&study.runs, &Library::of_results(results));
    let mut judged = judge_runs(&study.runs, &references);
    take_in_damage(&study, &mut judged);
    for run in &study.runs {
        save_rows(folder, &run.manifest, &judged.rows)?;
    }
    study.announce()?;
    let text = |what: &str, made: Result<String, _>| made.map_err(|e| failed(what, &e));
    for (name, made) in [
        (
            "summary.json",
            text("summary.json", summary_json(&judged.rows))?,
        ),
        (
            "summary.csv",
            text("summary.csv", summary_csv(&judged.rows))?,
        ),
        ("junit.xml", text("junit.xml", junit_xml(&judged.rows))?),
    ] {
        write_file(&folder.join(name), made.as_bytes())?;
    }
    let ranking = rank(&judged.rows);
    let gallery = pictures::draw(&study.runs, study.kind, &ranking, &references);
    let mut notes = judged.notes;
    notes.extend(gallery.notes);
    for run in &study.runs {
        let done = run.manifest.scored.iter().flat_map(|scored| &scored.notes);
        notes.extend(done.map(|note| format!("{}: {note}", run.manifest.method)));
    }
    let mut figures = Vec::new();
    for picture in &gallery.pictures {
        match save_picture(folder, picture) {
            Ok(figure) => figures.push(figure),
            Err(CaseError::Report { reason, .. }) => {
                notes.push(pictures::missing(picture.name, &reason));
            }
            Err(error) => return Err(error),
        }
    }
    let animation = match animation::draw(&study.runs, &ranking) {
        Ok(Some(gif)) => {
            let path = folder.join(ANIMATION);
            write_file(&path, &gif)?;
            Some(path)
        }
        Ok(None) => None,
        Err(reason) => {
            notes.push(pictures::missing("animation", &reason));
            None
        }
    };
    let ranked = ranking.methods.iter().any(|method| method.echo.is_some());
    let ranking = ranked.then_some(ranking);
    let report = folder.join("report.html");
    if let Some(page) = describe(&study, &judged.rows, ranking.clone(), figures, &notes) {
        write_file(&report, html::report(&page).as_bytes())?;
    }
    Ok(Published {
        runs: study.runs,
        damaged: study.damaged,
        rows: judged.rows,
        ranking,
        reference_missing: judged.reference_missing,
        notes,
        report,
        animation,
    })
}

/// The rows and notes of runs that cannot be read: what is claimed of them is not evaluated.
fn take_in_damage(study: &Study, judged: &mut Judged) {
    for damage in &study.damaged {
        let (method, why) = (damage.method(), damaged(damage));
        // The runs of a study share their scene but for its sides, so that any knows the claims.
        if let Some(like) = study.runs.first() {
            judged.rows.extend(rows_unread(like, &method, &why));
        }
        judged.notes.push(format!(
            "{method}: {why}; what made the study, with --resume, solves it again"
        ));
    }
}

fn damaged(damage: &Damage) -> String {
    format!("its record is damaged: {}", damage.reason)
}

/// The report's content; none without runs.
fn describe(
    study: &Study,
    rows: &[Row],
    ranking: Option<Ranking>,
    figures: Vec<Figure>,
    notes: &[String],
) -> Option<reports::Study> {
    let first = study.runs.first()?;
    let info = first.prepared.info;
    Some(reports::Study {
        case: info.name.to_owned(),
        title: info.title.to_owned(),
        summary: format!("{} {}", info.summary, info.source),
        profile: first.manifest.profile.clone(),
        command: study.command.clone(),
        rows: rows.to_vec(),
        ranking,
        runs: study
            .runs
            .iter()
            .map(summary_of_run)
            .chain(study.damaged.iter().map(summary_of_damage))
            .collect(),
        ledger: info
            .ledger
            .iter()
            .map(|(finding, place, note)| LedgerEntry {
                finding: *finding,
                place: (*place).to_owned(),
                note: (*note).to_owned(),
            })
            .collect(),
        notes: notes.to_vec(),
        figures,
    })
}

fn summary_of_run(run: &Run) -> RunSummary {
    RunSummary {
        method: run.manifest.method.clone(),
        status: run.record.status.clone(),
        cost: match run.manifest.scored {
            Some(_) => None,
            None => Some(run.record.cost.clone()),
        },
        provenance: run.manifest.provenance.clone(),
    }
}

fn summary_of_damage(damage: &Damage) -> RunSummary {
    RunSummary {
        method: damage.method(),
        status: Status::Failed(damaged(damage)),
        cost: None,
        provenance: Provenance::default(),
    }
}

/// Ranks the methods, down to the floor of the reference.
///
/// The floor is the reference's own uncertainty where it was measured, else what an extended domain
/// leaves, which has no boundary to blame.
fn rank(rows: &[Row]) -> Ranking {
    let (own, methods): (Vec<Row>, Vec<Row>) = rows
        .iter()
        .filter(|row| row.method != PAPER)
        .cloned()
        .partition(|row| row.method == REFERENCE);
    let floor_of = |rows: &[Row], name: &str| {
        let unbounded = Ranking::from_rows(rows, RANKED_BY, None);
        let found = unbounded.methods.into_iter().find(|m| m.method == name);
        found.and_then(|method| method.echo)
    };
    let certified = floor_of(&own, REFERENCE).map(|value| Floor {
        value,
        how: "change of the certified reference under a larger buffer and a tenth of the solver's tolerance".into(),
    });
    let floor = certified.or_else(|| {
        floor_of(&methods, "extended").map(|value| Floor {
            value,
            how: "what the extended domain leaves on the same mesh: the discretisation alone"
                .into(),
        })
    });
    Ranking::from_rows(&methods, RANKED_BY, floor)
}

/// Writes a picture as SVG and PNG, and gives it as the report shows it.
fn save_picture(folder: &Path, picture: &Picture) -> Result<Figure, CaseError> {
    let wrong = |e: PlotError| failed(picture.name, &e);
    let path = folder.join(picture.name);
    let svg = picture.drawing.to_svg().map_err(wrong)?;
    let png = picture.drawing.to_png().map_err(wrong)?;
    write_file(&path.with_extension("svg"), svg.as_bytes())?;
    write_file(&path.with_extension("png"), &png)?;
    let figure = if picture.raster {
        Figure::of_field
    } else {
        Figure::of_lines
    };
    figure(picture.title, &picture.caption, &picture.drawing).map_err(wrong)
}

fn failed(what: &str, error: &dyn std::fmt::Display) -> CaseError {
    CaseError::Report {
        what: what.to_owned(),
        reason: error.to_string(),
    }
}
