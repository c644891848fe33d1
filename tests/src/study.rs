//! Comparisons through the library, and their rows.

use crate::solved;
use anechoic::commands::{Finished, Options, compare, show};
use anechoic::judge::judge_runs;
use anechoic::judge::references::References;
use anechoic::prepare::Request;
use anechoic::runner::Run;
use anechoic::store::Manifest;
use anechoic_reports::row::{Row, Verdict};
use anechoic_solver::problem::Problem;
use std::path::Path;

/// Assignments that make a column two cells wide: the wave is the same, the cost is not.
pub const NARROW: [&str; 3] = ["body.width_m=2", "receivers.A.x_m=1", "receivers.B.x_m=1"];

/// compression-1d at profile `gate` on a narrow column; results go to `out`.
pub fn narrow_column(out: &Path) -> Options {
    let options = Options::new("compression-1d", out).profile("gate");
    NARROW.iter().fold(options, |options, set| options.set(set))
}

/// Solves with all methods that apply and insists that every run ends.
///
/// # Panics
/// When the request is refused or a run fails.
pub fn compared(options: &Options) -> Finished {
    let finished = compare(options).unwrap_or_else(|error| panic!("{error}"));
    for run in &finished.study.runs {
        assert!(
            run.complete(),
            "{}: {:?}",
            run.manifest.method,
            run.record.status
        );
    }
    finished
}

/// Rows with a verdict.
pub fn claims(rows: &[Row]) -> impl Iterator<Item = &Row> {
    rows.iter().filter(|row| row.verdict.is_some())
}

/// Prints each claim with its number, as the record of what was asked and what was measured.
pub fn print_claims(rows: &[Row]) {
    for row in claims(rows) {
        println!("{}", in_words(row));
    }
}

/// `fixed arrival_s at A: 0.0054 s, accepted at most 0.02 (analytic, dalembert): pass`.
fn in_words(row: &Row) -> String {
    let value = row.value.map_or("no number".to_owned(), |value| {
        format!("{value:.5} {}", row.unit)
    });
    format!(
        "{} {} at {}: {value}, accepted {:?} ({}, {}): {:?}",
        row.method, row.metric, row.place, row.accept, row.evidence, row.reference, row.verdict
    )
}

/// The number of a row.
///
/// # Panics
/// When there is no such row or it has no number.
pub fn value(rows: &[Row], method: &str, metric: &str, place: &str) -> f64 {
    let row = rows
        .iter()
        .find(|r| r.method == method && r.metric == metric && r.place == place)
        .unwrap_or_else(|| panic!("no row {method}/{metric}/{place}"));
    row.value
        .unwrap_or_else(|| panic!("{method}/{metric}/{place}: {}", row.why))
}

/// Claims that fail, as METHOD/METRIC/WHERE.
pub fn failing(rows: &[Row]) -> Vec<String> {
    claims(rows)
        .filter(|row| row.verdict == Some(Verdict::Fail))
        .map(|row| format!("{}/{}/{}", row.method, row.metric, row.place))
        .collect()
}

/// Solves compression-1d on a narrow column with each of `methods`, after `change` has had its way with
/// the problem (method, problem), and judges the records as if nothing had happened.
///
/// # Panics
/// When the scene is refused or a problem cannot be set up.
pub fn judged(methods: &[&str], change: impl Fn(&str, &mut Problem<2>)) -> Vec<Row> {
    let request = Request {
        target: "compression-1d".to_owned(),
        profile: Some("gate".to_owned()),
        sets: NARROW.map(str::to_owned).to_vec(),
        ..Request::default()
    };
    let run = |method: &&str| altered(&request, Some(method), |problem| change(method, problem));
    let runs: Vec<Run> = methods.iter().map(run).collect();
    // The column's references are closed forms and its own runs.
    let runs: Vec<&Run> = runs.iter().collect();
    judge_runs(&runs, &References::default()).rows
}

/// Solves a scene after `change` has had its way with the problem, as a run that knows nothing of it.
///
/// # Panics
/// When the scene is refused or the problem cannot be set up.
pub fn altered(request: &Request, method: Option<&str>, change: impl Fn(&mut Problem<2>)) -> Run {
    let prepared = show(request, method).unwrap_or_else(|error| panic!("{error}"));
    let posed = prepared.scene.posed().plane();
    let mut problem = posed.expect("altered scenes are plane");
    change(&mut problem);
    let record = solved(&problem);
    Run {
        frames: Default::default(),
        manifest: Manifest::of(&prepared, &record),
        prepared,
        record,
    }
}
