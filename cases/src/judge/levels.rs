//! The runs of a convergence study: what is measured on each level, the orders with which errors fall,
//! where they no longer do, and the budget of errors.

use super::budget::{BUDGET, ERRORS, budget, reference_shares};
use super::points::at_point;
use super::references::References;
use super::rows::{names_of, rows_of};
use super::{Judged, Measured, growth};
use crate::over::{CELLS, POINTS, cause};
use crate::runner::Run;
use crate::scene::Role;
use crate::sweep::{Grid, Part, Point};
use anechoic_reports::budget::{Budget, SHARE, Share};
use anechoic_reports::convergence::{Convergence, Curve, Level, Refinement};
use anechoic_reports::judge::{Measurement, RUN};
use anechoic_reports::plateau::PLATEAU;
use anechoic_reports::row::Row;

/// Judges runs of one method on the levels of fields, and those of a budget. Claims on single runs are
/// the business of other studies: a level has numbers alone. With the reason why a level is `lost`,
/// orders over the others are shown and not judged.
pub fn judge_levels(
    runs: &[Run],
    grid: &Grid,
    references: &References,
    lost: Option<&str>,
) -> (Judged, Refinement) {
    let mut judged = Judged::default();
    let (budgets, levels): (Vec<&Part>, Vec<&Part>) =
        grid.parts.iter().partition(|part| part.name == BUDGET);
    let own = budgets.first();
    let budget = own.and_then(|part| budget(part, runs, references));
    // What was asked comes first: orders, then shares, then the numbers of single runs.
    let mut singles = Vec::new();
    let mut studies = Vec::new();
    for part in levels {
        let part_lost = lost.filter(|_| part.points.iter().any(|p| p.pick(runs).0.is_empty()));
        let level = Levels::of(part, runs, references);
        let Some(study) = level.study(budget.as_ref(), references) else {
            continue;
        };
        judged
            .rows
            .extend(level.orders(&study, references, part_lost));
        singles.extend(level.singles());
        judged.notes.extend(level.notes());
        studies.push(study);
    }
    if let (Some(part), Some(budget)) = (own, &budget) {
        let level = Levels::of(part, runs, references);
        judged.rows.extend(level.shares(budget));
        singles.extend(level.singles());
        judged.notes.extend(level.notes());
    }
    judged.rows.extend(singles);
    (judged, Refinement { studies, budget })
}

/// The runs of a part that can be read, with what is measured of each.
struct Levels<'a> {
    field: &'a str,
    levels: Vec<(&'a Point, &'a Run, Measured)>,
}

impl<'a> Levels<'a> {
    fn of(part: &'a Part, runs: &'a [Run], references: &References) -> Self {
        let level = |point: &'a Point| {
            let run = point.pick(runs).0.first().copied()?;
            Some((point, run, super::measured(run, &[run], references)))
        };
        Levels {
            field: &part.axis,
            levels: part.points.iter().filter_map(level).collect(),
        }
    }

    fn finest(&self) -> Option<&'a Run> {
        self.levels.last().map(|(_, run, _)| *run)
    }

    fn study(&self, budget: Option<&Budget>, references: &References) -> Option<Convergence> {
        let finest = self.finest()?;
        let levels = self.levels.iter();
        let levels: Vec<Level> = levels
            .map(|(point, run, _)| level(run, self.field, point))
            .collect();
        let floors = reference_shares(finest, references);
        let mut curves = Vec::new();
        for metric in ERRORS {
            for (receiver, _) in finest.prepared.scene.posed().receivers() {
                let errors = self.levels.iter();
                let errors = errors.map(|(_, _, level)| error(level, metric, &receiver));
                let curve = Curve::new(metric, &receiver, &levels, errors.collect());
                let mut curve = curve.with_plateau(floor(&floors, metric, &receiver));
                if let Some(budget) = budget {
                    let cause = cause(self.field);
                    let plateau = curve.plateau.take();
                    curve.plateau =
                        plateau.map(|p| p.with_budget(budget, cause, metric, &receiver));
                }
                curves.push(curve);
            }
        }
        Some(Convergence {
            over: self.field.to_owned(),
            method: finest.manifest.method.clone(),
            curves,
            levels,
        })
    }

    /// Orders, with the claims that the scene states of them.
    fn orders(&self, study: &Convergence, references: &References, lost: Option<&str>) -> Vec<Row> {
        let Some(finest) = self.finest() else {
            return Vec::new();
        };
        // Errors are those of the boundaries as modelled where a closed form knows them.
        let truths = references.of(finest).unwrap_or_default();
        let truth = truths
            .iter()
            .find(|truth| truth.role == Role::Modelled)
            .or(truths.first());
        let against = truth.map(|truth| (truth.evidence, truth.name));
        let sizes: Vec<f64> = study.levels.iter().map(|level| level.size).collect();
        let claims = if self.field == CELLS {
            finest.prepared.scene.orders(&sizes)
        } else {
            Vec::new()
        };
        let numbers = study.measurements(against);
        let lost = lost.map(str::to_owned);
        let rows = rows_of(finest, names_of(finest), &numbers, claims, lost);
        labelled(rows, &numbers)
    }

    /// The shares of a budget, which are of the first run.
    fn shares(&self, budget: &Budget) -> Vec<Row> {
        let Some((_, run, _)) = self.levels.first() else {
            return Vec::new();
        };
        let numbers = budget.measurements();
        let rows = rows_of(run, names_of(run), &numbers, Vec::new(), None);
        labelled(rows, &numbers)
    }

    /// The numbers of each run, told apart by its level.
    fn singles(&self) -> Vec<Row> {
        let rows = |(point, run, measured): &(&Point, &Run, Measured)| -> Vec<Row> {
            let rows = rows_of(run, names_of(run), &measured.numbers, Vec::new(), None);
            let at = |row: Row| Row {
                place: at_point(&row.place, point),
                ..row
            };
            rows.into_iter().map(at).collect()
        };
        self.levels.iter().flat_map(rows).collect()
    }

    fn notes(&self) -> Vec<String> {
        let notes = |(point, run, measured): &(&Point, &Run, Measured)| -> Vec<String> {
            let why = measured.obstacle.clone().into_iter();
            let why = why.chain(growth::unstable(run, &mut []));
            why.map(|why| format!("{}: {why}", point.label)).collect()
        };
        self.levels.iter().flat_map(notes).collect()
    }
}

/// Shares and plateaus with their evidence: no claim says it, and they mean nothing without.
fn labelled(mut rows: Vec<Row>, numbers: &[Measurement]) -> Vec<Row> {
    let own = |row: &&mut Row| [SHARE, PLATEAU].contains(&row.metric.as_str());
    for row in rows.iter_mut().filter(own) {
        let alike = |n: &&Measurement| n.metric == row.metric && n.place == row.place;
        let against = numbers.iter().find(alike).and_then(|n| n.against.as_ref());
        if let Some((evidence, name)) = against {
            row.evidence = evidence.name().to_owned();
            row.reference.clone_from(name);
        }
    }
    rows
}

/// The level of a run.
fn level(run: &Run, field: &str, point: &Point) -> Level {
    // every level was checked to have one
    let value = point.value.unwrap_or(f64::NAN);
    Level {
        value,
        size: match field {
            CELLS => run.prepared.scene.cell_m(),
            POINTS => run.prepared.scene.cell_m() / value.sqrt(),
            _ => value,
        },
    }
}

/// What the reference itself is uncertain by; 0 where it has no such number.
fn floor(shares: &[Share], metric: &str, place: &str) -> f64 {
    let mut shares = shares.iter();
    let own = shares.find(|share| share.metric == metric && share.place == place);
    own.and_then(|share| share.value.clone().ok())
        .unwrap_or(0.0)
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
