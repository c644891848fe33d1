//! A study: runs that are judged and shown together. Everything here is made from records alone, so
//! that `report` makes the same again without solving.
//!
//! - [`kind`]: what studies are for; [`stored`]: studies on disk.

pub mod kind;
pub mod stored;

use crate::certified::library::Library;
use crate::error::CaseError;
use crate::judge::references::References;
use crate::judge::{
    Judged, PAPER, REFERENCE, judge_levels, judge_points, judge_runs, judge_stability,
    judge_trades, rows_unread,
};
use crate::pictures::{self, Picture, animation};
use crate::runner::Run;
use crate::spectrum;
use crate::store::{save_rows, write_file};
use crate::sweep::named;
use crate::timing;
use anechoic_reports::export::{junit_xml, summary_csv, summary_json};
use anechoic_reports::html;
use anechoic_reports::plot::PlotError;
use anechoic_reports::provenance::Provenance;
use anechoic_reports::ranking::{Floor, Ranking};
use anechoic_reports::row::Row;
use anechoic_reports::study::{self as reports, Figure, Finding, LedgerEntry, RunSummary, Upshot};
use anechoic_solver::record::Status;
pub use kind::Kind;
use std::path::{Path, PathBuf};
use stored::{Damage, Study};

/// The metric that methods are ranked by.
const RANKED_BY: &str = "echo_ratio";

/// Name of the animation's file.
pub const ANIMATION: &str = "animation.gif";

/// A judged and published study.
#[derive(Debug)]
pub struct Published {
    /// The runs.
    pub runs: Vec<Run>,
    /// Runs that cannot be read.
    pub damaged: Vec<Damage>,
    /// All rows.
    pub rows: Vec<Row>,
    /// What it is for.
    pub kind: Kind,
    /// What the runs make together, where that is more than a ranking.
    pub upshot: Option<Upshot>,
    /// The runs' names, which tell them apart.
    pub names: Vec<String>,
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
    let (mut judged, upshot) = judge_study(&study, &references)?;
    take_in_damage(&study, &mut judged);
    for run in &study.runs {
        let own = judged.rows.iter().filter(|row| study.kind.owns(run, row));
        save_rows(folder, &run.manifest, &own.collect::<Vec<_>>())?;
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
    let gallery = match &upshot {
        Some(upshot) => pictures::draw_upshot(upshot),
        None => pictures::draw(&study.runs, &study.kind, &ranking, &references),
    };
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
                notes.push(pictures::missing(&picture.name, &reason));
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
    // Levels and points are not ranked.
    let ranked = upshot.is_none() && ranking.methods.iter().any(|method| method.echo.is_some());
    let published = Published {
        names: study.runs.iter().map(|run| study.kind.name(run)).collect(),
        report: folder.join("report.html"),
        runs: study.runs,
        damaged: study.damaged,
        rows: judged.rows,
        upshot,
        kind: study.kind,
        ranking: ranked.then_some(ranking),
        reference_missing: judged.reference_missing,
        notes,
        animation,
    };
    if let Some(page) = describe(&published, study.command, figures) {
        write_file(&published.report, html::report(&page).as_bytes())?;
    }
    Ok(published)
}

/// The rows of the runs that can be read, and what they make on levels or at points.
fn judge_study(
    study: &Study,
    references: &References,
) -> Result<(Judged, Option<Upshot>), CaseError> {
    Ok(match &study.kind {
        Kind::Convergence(grid) => {
            let lost = study.damaged.first().map(|damage| {
                let name = study.kind.name_of_damage(damage);
                format!("a level is missing: {name}: {}", damaged(damage))
            });
            let (judged, refinement) = judge_levels(&study.runs, grid, references, lost.as_deref());
            (judged, Some(Upshot::Convergence(refinement)))
        }
        Kind::Sweep(grid) => {
            let (judged, sweep) = judge_points(&study.runs, grid, references);
            (judged, Some(Upshot::Sweep(sweep)))
        }
        Kind::Tradeoff(grid) => {
            let (mut judged, sweep) = judge_points(&study.runs, grid, references);
            let timings = timing::load(&study.folder)?;
            let (tradeoff, rows) = judge_trades(&study.runs, grid, &sweep, references, &timings)?;
            // What was asked comes first.
            judged.rows.splice(0..0, rows);
            (judged, Some(Upshot::Tradeoff(tradeoff)))
        }
        Kind::Stability(grid) => {
            let spectra = spectrum::load(&study.folder)?;
            let (judged, stability) = judge_stability(&study.runs, grid, &spectra);
            (judged, Some(Upshot::Stability(stability)))
        }
        Kind::Comparison | Kind::Ablation => {
            let runs: Vec<&Run> = study.runs.iter().collect();
            (judge_runs(&runs, references), None)
        }
    })
}

/// The rows and notes of runs that cannot be read: what is claimed of them is not evaluated.
fn take_in_damage(study: &Study, judged: &mut Judged) {
    for damage in &study.damaged {
        let (name, why) = (study.kind.name_of_damage(damage), damaged(damage));
        // Methods share their scene but for its sides, so that any knows the claims; levels have none.
        if matches!(study.kind, Kind::Comparison | Kind::Ablation)
            && let Some(like) = study.runs.first()
        {
            judged.rows.extend(rows_unread(like, &name, &why));
        }
        judged.notes.push(format!(
            "{name}: {why}; what made the study, with --resume, solves it again"
        ));
    }
}

fn damaged(damage: &Damage) -> String {
    format!("its record is damaged: {}", damage.reason)
}

/// The report's content; none without runs.
fn describe(
    published: &Published,
    command: String,
    figures: Vec<Figure>,
) -> Option<reports::Study> {
    let first = published.runs.first()?;
    let info = first.prepared.info;
    Some(reports::Study {
        case: info.name.to_owned(),
        title: info.title.to_owned(),
        summary: format!("{} {}", info.summary, info.source),
        profile: first.manifest.profile.clone(),
        command,
        rows: published.rows.clone(),
        upshot: published.upshot.clone(),
        ranking: published.ranking.clone(),
        runs: published
            .runs
            .iter()
            .zip(&published.names)
            .map(|(run, name)| summary_of_run(run, name))
            .chain(
                published
                    .damaged
                    .iter()
                    .map(|damage| summary_of_damage(damage, &published.kind)),
            )
            .collect(),
        ledger: sweep_ledger(&published.kind)
            .iter()
            .chain(info.ledger)
            .map(|(finding, place, note)| LedgerEntry {
                finding: *finding,
                place: (*place).to_owned(),
                note: (*note).to_owned(),
            })
            .collect(),
        notes: published.notes.clone(),
        figures,
    })
}

/// What a named sweep's source says and how it fares.
fn sweep_ledger(kind: &Kind) -> &'static [(Finding, &'static str, &'static str)] {
    let named = kind.grid().and_then(|grid| named::find(&grid.name).ok()?);
    named.map_or(&[], |chosen| chosen.sweep.ledger)
}

fn summary_of_run(run: &Run, name: &str) -> RunSummary {
    RunSummary {
        method: name.to_owned(),
        status: run.record.status.clone(),
        cost: match run.manifest.scored {
            Some(_) => None,
            None => Some(run.record.cost.clone()),
        },
        provenance: run.manifest.provenance.clone(),
    }
}

fn summary_of_damage(damage: &Damage, kind: &Kind) -> RunSummary {
    RunSummary {
        method: kind.name_of_damage(damage),
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
pub(crate) fn save_picture(folder: &Path, picture: &Picture) -> Result<Figure, CaseError> {
    let wrong = |e: PlotError| failed(&picture.name, &e);
    let path = folder.join(&picture.name);
    let svg = picture.drawing.to_svg().map_err(wrong)?;
    let png = picture.drawing.to_png().map_err(wrong)?;
    write_file(&path.with_extension("svg"), svg.as_bytes())?;
    write_file(&path.with_extension("png"), &png)?;
    let figure = if picture.raster {
        Figure::of_field
    } else {
        Figure::of_lines
    };
    figure(&picture.title, &picture.caption, &picture.drawing).map_err(wrong)
}

fn failed(what: &str, error: &dyn std::fmt::Display) -> CaseError {
    CaseError::Report {
        what: what.to_owned(),
        reason: error.to_string(),
    }
}
