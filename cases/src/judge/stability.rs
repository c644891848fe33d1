//! How runs at extremes end.

use super::growth::unloaded;
use super::{Judged, energies, rows::rows_of};
use crate::posed::either;
use crate::runner::Run;
use crate::sweep::{Grid, Point};
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::judge::{Measurement, RUN, cost_measurements, judge};
use anechoic_reports::norms::Unloaded;
use anechoic_reports::row::Row;
use anechoic_reports::stability::{
    Outcome, STABLE, Stability, StabilityPart, StabilityPoint, rate,
};
use anechoic_solver::boundary::find;
use anechoic_solver::problem::{PointMode, Problem, Scheme, Transfer};
use anechoic_solver::record::Status;

/// Outcomes of all runs, and their rows: rates, costs, and what theory claims.
pub fn judge_stability(runs: &[Run], grid: &Grid) -> (Judged, Stability) {
    let (mut stability, mut rows) = (Stability::default(), Vec::new());
    for part in &grid.parts {
        let points = part.points.iter().map(|point| at(point, runs, &mut rows));
        stability.parts.push(StabilityPart {
            title: part.title.clone(),
            points: points.collect(),
        });
    }
    let judged = Judged {
        rows,
        ..Judged::default()
    };
    (judged, stability)
}

fn at(point: &Point, runs: &[Run], rows: &mut Vec<Row>) -> StabilityPoint {
    let mut outcomes = Vec::new();
    for run in point.pick(runs).0 {
        let method = &run.manifest.method;
        let outcome = outcome(run);
        let place = format!("{RUN}@{}", point.label);
        let stable = Measurement {
            method: method.clone(),
            metric: STABLE.to_owned(),
            place: place.clone(),
            value: outcome.number(),
            unit: "1".to_owned(),
            against: None,
        };
        let problem = run.prepared.scene.posed();
        let by_theory = either!(&problem, problem => is_stable_by_theory(problem));
        let claims: Vec<Claim> = by_theory
            .then(|| Claim {
                method: method.clone(),
                metric: STABLE.to_owned(),
                place,
                accept: Accept::at_least(1.0),
                evidence: Evidence::Analytic,
                why: "nodes keep their motion, Newmark's average acceleration keeps energy, and all that is on the sides takes energy away: stable at any step (Hughes 1987, section 9.1)".to_owned(),
            })
            .into_iter()
            .collect();
        let (case, profile) = (&run.manifest.case, &run.manifest.profile);
        rows.extend(judge(case, profile, &[stable], &claims));
        let mut numbers = cost_measurements(method, &run.record.cost);
        if run.complete() {
            energies(run, &run.prepared.scene.windows(), &mut numbers);
        }
        let names = super::rows::names_of(run);
        let own = rows_of(run, names, &numbers, Vec::new(), None);
        rows.extend(own.into_iter().map(|row| Row {
            place: super::points::at_point(&row.place, point),
            ..row
        }));
        outcomes.push((method.clone(), outcome));
    }
    let refused = point.refused.iter();
    outcomes.extend(refused.map(|(method, why)| (method.clone(), Outcome::Refused(why.clone()))));
    StabilityPoint {
        label: point.label.clone(),
        outcomes,
    }
}

/// How a run ended.
pub(super) fn outcome(run: &Run) -> Outcome {
    match &run.record.status {
        Status::Cancelled => Outcome::Open("stopped before its end".to_owned()),
        Status::Failed(why) if why.contains("did not converge") => {
            Outcome::NotConverged(why.clone())
        }
        Status::Failed(why) => Outcome::Diverged(why.clone()),
        Status::Complete => match unloaded(run, &run.prepared.scene.posed()) {
            None => overflown(run),
            Some(energy) => of_energy(&energy),
        },
    }
}

/// A run whose fields are finite and whose energy is not.
fn overflown(run: &Run) -> Outcome {
    let energy = &run.record.energy;
    let total = energy.column("total").unwrap_or_default();
    match total.iter().position(|value| !value.is_finite()) {
        Some(i) => Outcome::Diverged(format!(
            "its energy is too large for a number from t = {} s on",
            energy.times[i]
        )),
        None => Outcome::Open("its energy tells nothing".to_owned()),
    }
}

fn of_energy(energy: &Unloaded) -> Outcome {
    let rate = energy.rate.as_ref().map(rate);
    if energy.grows() || energy.runs_away() {
        Outcome::Grows(rate)
    } else {
        Outcome::Stable(rate)
    }
}

/// Does a theorem say that energy cannot grow?
fn is_stable_by_theory<const D: usize>(problem: &Problem<D>) -> bool {
    let kept = problem.point_mode == PointMode::Frozen && problem.transfer == Transfer::Keep;
    let passive = |method: &str| find(method).is_some_and(|info| info.passive);
    let sides = problem.sides.iter().flatten();
    kept && problem.scheme == Scheme::Newmark && sides.into_iter().all(|side| passive(&side.method))
}
