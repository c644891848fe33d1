//! The runs of a convergence study: what is measured on each level, and the orders with which errors
//! fall.

use super::references::References;
use super::rows::{names_of, rows_of};
use super::{Judged, Measured, growth};
use crate::over::{CELLS, level_in};
use crate::runner::Run;
use crate::scene::Role;
use anechoic_reports::convergence::{Convergence, Curve, Level, at_level};
use anechoic_reports::judge::RUN;
use anechoic_reports::row::Row;

/// Errors whose order is measured.
const ERRORS: [&str; 2] = ["rel_l2", "peak_error"];

/// Judges runs of one method, coarse to fine, over `field`. Claims on single runs are the business of
/// other studies: a level has numbers alone. With the reason why a level is `lost`, orders over the
/// others are shown and not judged.
pub fn judge_levels(
    runs: &[Run],
    field: &str,
    references: &References,
    lost: Option<String>,
) -> (Judged, Option<Convergence>) {
    let Some(finest) = runs.last() else {
        return (Judged::default(), None);
    };
    let levels: Vec<Level> = runs.iter().map(|run| level(run, field)).collect();
    let measured: Vec<Measured> = runs
        .iter()
        .map(|run| super::measured(run, &[run], references))
        .collect();
    let convergence = Convergence {
        over: field.to_owned(),
        method: finest.manifest.method.clone(),
        curves: curves(finest, &levels, &measured),
        levels,
    };
    // Orders come first: they are what the study is for.
    let mut rows = orders(finest, &convergence, references, lost);
    for ((run, level), measured) in runs.iter().zip(&convergence.levels).zip(&measured) {
        let numbers = rows_of(run, names_of(run), &measured.numbers, Vec::new(), None);
        rows.extend(numbers.into_iter().map(|row| Row {
            place: at_level(&row.place, field, level.value),
            ..row
        }));
    }
    let mut notes: Vec<String> = Vec::new();
    for ((label, measured), run) in convergence.labels().iter().zip(&measured).zip(runs) {
        let why = measured.obstacle.clone().into_iter();
        let why = why.chain(growth::unstable(run, &mut []));
        notes.extend(why.map(|why| format!("{label}: {why}")));
    }
    let judged = Judged {
        rows,
        reference_missing: None,
        notes,
    };
    (judged, Some(convergence))
}

/// The level of a run; what was never set has no value and no order.
fn level(run: &Run, field: &str) -> Level {
    let value = level_in(&run.prepared.table, field).unwrap_or(f64::NAN);
    Level {
        value,
        size: match field {
            CELLS => run.prepared.scene.cell_m(),
            _ => value,
        },
    }
}

/// Errors at the receivers, level by level.
fn curves(finest: &Run, levels: &[Level], measured: &[Measured]) -> Vec<Curve> {
    let receivers = finest.prepared.scene.posed().receivers();
    let mut curves = Vec::new();
    for metric in ERRORS {
        for (receiver, _) in &receivers {
            let errors = measured.iter().map(|level| error(level, metric, receiver));
            let errors = errors.collect();
            curves.push(Curve::new(metric, receiver, levels, errors));
        }
    }
    curves
}

/// The error at a receiver on one level, or why there is none.
fn error(level: &Measured, metric: &str, receiver: &str) -> Result<f64, String> {
    let of = |place: &str| {
        let mut numbers = level.numbers.iter();
        numbers.find(|number| number.metric == metric && number.place == place)
    };
    // A metric that failed as a whole stands at the run.
    match (of(receiver).or_else(|| of(RUN)), &level.obstacle) {
        (Some(number), _) => number.value.clone(),
        (None, Some(why)) => Err(why.clone()),
        (None, None) => Err(format!("{metric} was not measured")),
    }
}

/// Orders, with the claims that the scene states of them.
fn orders(
    finest: &Run,
    convergence: &Convergence,
    references: &References,
    lost: Option<String>,
) -> Vec<Row> {
    // Errors are those of the boundaries as modelled where a closed form knows them.
    let truths = references.of(finest).unwrap_or_default();
    let truth = truths
        .iter()
        .find(|truth| truth.role == Role::Modelled)
        .or(truths.first());
    let against = truth.map(|truth| (truth.evidence, truth.name));
    let sizes: Vec<f64> = convergence.levels.iter().map(|level| level.size).collect();
    let claims = if convergence.over == CELLS {
        finest.prepared.scene.orders(&sizes)
    } else {
        Vec::new()
    };
    let numbers = convergence.measurements(against);
    rows_of(finest, names_of(finest), &numbers, claims, lost)
}
