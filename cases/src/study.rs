//! A study: runs that are judged and shown together. Everything here is made from records alone, so
//! that `report` makes the same again without solving.

use crate::certified::library::Library;
use crate::error::CaseError;
use crate::judge::references::References;
use crate::judge::{PAPER, REFERENCE, judge_levels, judge_runs};
use crate::over::level_in;
use crate::pictures::{self, Picture};
use crate::runner::Run;
use crate::store::{json, load, read_json, save_rows, write_file};
use anechoic_reports::convergence::{Convergence, at_level, label};
use anechoic_reports::export::{junit_xml, summary_csv, summary_json};
use anechoic_reports::html;
use anechoic_reports::plot::PlotError;
use anechoic_reports::ranking::{Floor, Ranking};
use anechoic_reports::row::Row;
use anechoic_reports::study::{self as reports, Figure, LedgerEntry, RunSummary};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// The metric that methods are ranked by.
const RANKED_BY: &str = "echo_ratio";

/// What a study is for.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Methods side by side, ranked.
    #[default]
    Comparison,
    /// A method taken apart: what each part absorbs.
    Ablation,
    /// A scene on finer and finer levels, coarse first: with which order errors fall.
    Convergence {
        /// The field that is refined.
        over: String,
    },
}

impl Kind {
    /// Folder of a case's study of this kind.
    pub fn folder(&self, case: &str) -> String {
        match self {
            Kind::Comparison => case.to_owned(),
            Kind::Ablation => format!("{case}-ablation"),
            Kind::Convergence { .. } => format!("{case}-converge"),
        }
    }

    /// What tells a run from the others of its study, for people.
    pub fn name(&self, run: &Run) -> String {
        let method = run.manifest.method.as_str();
        match self.level(run) {
            Some((over, value)) => format!("{method}, {}", label(over, value)),
            None => method.to_owned(),
        }
    }

    /// Is a row one of this run's?
    fn owns(&self, run: &Run, row: &Row) -> bool {
        let place = self
            .level(run)
            .map(|(over, value)| at_level("", over, value));
        row.method == run.manifest.method && place.is_none_or(|end| row.place.ends_with(&end))
    }

    /// The field that is refined, and a run's value of it.
    fn level(&self, run: &Run) -> Option<(&str, f64)> {
        match self {
            Kind::Convergence { over } => Some((over, level_in(&run.prepared.table, over)?)),
            Kind::Comparison | Kind::Ablation => None,
        }
    }
}

/// Which runs make a study; stored beside its report.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudyFile {
    /// What it is for.
    #[serde(default)]
    pub kind: Kind,
    /// The command that made it.
    pub command: String,
    /// Folders of the runs, below the case's folder, in the order of the comparison.
    pub runs: Vec<PathBuf>,
}

/// A study read back.
#[derive(Debug)]
pub struct Study {
    /// The case's folder.
    pub folder: PathBuf,
    /// What it is for.
    pub kind: Kind,
    /// The command that made it.
    pub command: String,
    /// Its runs.
    pub runs: Vec<Run>,
}

/// A judged and published study.
#[derive(Debug)]
pub struct Published {
    /// The runs.
    pub runs: Vec<Run>,
    /// All rows.
    pub rows: Vec<Row>,
    /// Errors on several levels, where a scene was refined.
    pub convergence: Option<Convergence>,
    /// The runs' names, which tell them apart.
    pub names: Vec<String>,
    /// Methods by their echo; `None` when no echo ratio was measured.
    pub ranking: Option<Ranking>,
    /// Why claims have no reference, if there are such claims.
    pub reference_missing: Option<String>,
    /// What is missing from the results, and why.
    pub notes: Vec<String>,
    /// The report.
    pub report: PathBuf,
}

/// Name of the study's file.
const STUDY: &str = "study.json";

/// Judges the runs and writes summary, JUnit, pictures and report into the case's `folder`.
///
/// # Errors
/// [`CaseError::Storage`] and [`CaseError::Report`].
pub fn publish(
    folder: &Path,
    runs: Vec<Run>,
    kind: Kind,
    command: &str,
) -> Result<Published, CaseError> {
    let results = folder.parent().unwrap_or(folder);
    let references = References::gather(&runs, &Library::of_results(results));
    let (judged, convergence) = match &kind {
        Kind::Convergence { over } => judge_levels(&runs, over, &references),
        Kind::Comparison | Kind::Ablation => (judge_runs(&runs, &references), None),
    };
    for run in &runs {
        let own = judged.rows.iter().filter(|row| kind.owns(run, row));
        save_rows(folder, &run.manifest, &own.collect::<Vec<_>>())?;
    }
    let names: Vec<String> = runs.iter().map(|run| kind.name(run)).collect();
    let file = StudyFile {
        kind: kind.clone(),
        command: command.to_owned(),
        runs: runs.iter().map(|run| run.manifest.folder()).collect(),
    };
    write_file(&folder.join(STUDY), &json(&file)?)?;
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
    let gallery = match &convergence {
        Some(convergence) => pictures::draw_convergence(convergence),
        None => pictures::draw(&runs, &kind, &ranking, &references),
    };
    let mut notes = judged.notes;
    notes.extend(gallery.notes);
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
    // Levels of one method are not ranked.
    let ranked =
        convergence.is_none() && ranking.methods.iter().any(|method| method.echo.is_some());
    let ranking = ranked.then_some(ranking);
    let published = Published {
        runs,
        rows: judged.rows,
        convergence,
        names,
        ranking,
        reference_missing: judged.reference_missing,
        notes,
        report: folder.join("report.html"),
    };
    if let Some(study) = describe(&published, figures, command) {
        write_file(&published.report, html::report(&study).as_bytes())?;
    }
    Ok(published)
}

/// The report's content; none without runs.
fn describe(published: &Published, figures: Vec<Figure>, command: &str) -> Option<reports::Study> {
    let first = published.runs.first()?;
    let info = first.prepared.info;
    Some(reports::Study {
        case: info.name.to_owned(),
        title: info.title.to_owned(),
        summary: format!("{} {}", info.summary, info.source),
        profile: first.manifest.profile.clone(),
        command: command.to_owned(),
        rows: published.rows.clone(),
        convergence: published.convergence.clone(),
        ranking: published.ranking.clone(),
        runs: published
            .runs
            .iter()
            .zip(&published.names)
            .map(|(run, name)| RunSummary {
                method: name.clone(),
                status: run.record.status.clone(),
                cost: run.record.cost.clone(),
                provenance: run.manifest.provenance.clone(),
            })
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
        notes: published.notes.clone(),
        figures,
    })
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

/// The studies below a folder: it is a case's folder, or holds some.
///
/// # Errors
/// [`CaseError::NoRecords`], and what is wrong with a record.
pub fn find_studies(folder: &Path) -> Result<Vec<Study>, CaseError> {
    let mut folders = vec![folder.to_owned()];
    let listing = std::fs::read_dir(folder).map_err(|source| CaseError::Read {
        path: folder.to_owned(),
        source,
    })?;
    let mut below: Vec<PathBuf> = listing.flatten().map(|entry| entry.path()).collect();
    below.sort();
    folders.extend(below);
    let mut studies = Vec::new();
    for folder in folders.iter().filter(|f| f.join(STUDY).is_file()) {
        let file: StudyFile = read_json(&folder.join(STUDY))?;
        let runs = file
            .runs
            .iter()
            .map(|run| load(&folder.join(run)))
            .collect::<Result<_, _>>()?;
        studies.push(Study {
            folder: folder.clone(),
            kind: file.kind,
            command: file.command,
            runs,
        });
    }
    if studies.is_empty() {
        return Err(CaseError::NoRecords(folder.to_owned()));
    }
    Ok(studies)
}

fn failed(what: &str, error: &dyn std::fmt::Display) -> CaseError {
    CaseError::Report {
        what: what.to_owned(),
        reason: error.to_string(),
    }
}
