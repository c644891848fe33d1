//! How runs at extremes end.

use super::growth::unloaded;
use super::{Judged, energies, rows::rows_of};
use crate::posed::either;
use crate::runner::Run;
use crate::spectrum::Spectra;
use crate::sweep::{Grid, Part, Point};
use crate::timing;
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::judge::{Measurement, RUN, cost_measurements, judge};
use anechoic_reports::norms::Unloaded;
use anechoic_reports::row::Row;
use anechoic_reports::stability::{
    LARGEST_REAL_PART, LARGEST_STEP, LargestStep, Opinion, Outcome, STABLE, SpectrumPoint,
    Stability, StabilityPart, StabilityPoint, rate,
};
use anechoic_solver::boundary::find;
use anechoic_solver::problem::{PointMode, Problem, Scheme, Transfer};
use anechoic_solver::record::Status;

/// The part whose points are steps over h/c_p.
pub const STEP_AXIS: &str = "time step over h/c_p";
/// The part whose points are Poisson's ratios, at which spectra are asked for.
pub const RATIO_AXIS: &str = "Poisson's ratio";

/// Outcomes of all runs, and their rows: largest steps, spectra, rates, costs, and what theory claims.
pub fn judge_stability(runs: &[Run], grid: &Grid, spectra: &Spectra) -> (Judged, Stability) {
    let (mut stability, mut rows) = (Stability::default(), Vec::new());
    for part in &grid.parts {
        let points = part.points.iter().map(|point| at(point, runs, &mut rows));
        let shown = StabilityPart {
            title: part.title.clone(),
            points: points.collect(),
        };
        if part.axis == STEP_AXIS {
            stability.largest_steps = largest_steps(part, &shown);
        }
        if part.axis == RATIO_AXIS {
            stability.spectra = part
                .points
                .iter()
                .map(|p| opinions(p, runs, spectra))
                .collect();
        }
        stability.parts.push(shown);
    }
    if let Some(first) = runs.first() {
        let (case, profile) = (&first.manifest.case, &first.manifest.profile);
        rows.splice(
            0..0,
            judge(case, profile, &second_opinions(&stability), &[]),
        );
    }
    let judged = Judged {
        rows,
        ..Judged::default()
    };
    (judged, stability)
}

/// The largest step of each method up to which all of its runs are stable.
fn largest_steps(part: &Part, shown: &StabilityPart) -> Vec<LargestStep> {
    let steps = || part.points.iter().filter_map(|point| point.value);
    let tried = steps().fold(0.0, f64::max);
    let mut methods: Vec<&String> = Vec::new();
    for (method, _) in shown.points.iter().flat_map(|point| &point.outcomes) {
        if !methods.contains(&method) {
            methods.push(method);
        }
    }
    let largest = |method: &String| {
        let stable =
            |point: &&StabilityPoint| matches!(point.outcome(method), Some(Outcome::Stable(_)));
        let count = shown.points.iter().take_while(stable).count();
        let value = steps().take(count).last();
        LargestStep {
            method: method.clone(),
            value: value.ok_or_else(|| "not stable at the smallest that was tried".to_owned()),
            tried,
        }
    };
    methods.into_iter().map(largest).collect()
}

/// What the spectra of the runs at a point say.
fn opinions(point: &Point, runs: &[Run], spectra: &Spectra) -> SpectrumPoint {
    let own = point.pick(runs).0.into_iter();
    let entry = |run: &Run| {
        let found = spectra.get(&timing::key(run))?.clone();
        let opinion = found.map(|spectrum| Opinion {
            growth: spectrum.growth,
            rounding: spectrum.rounding,
        });
        Some((run.manifest.method.clone(), opinion))
    };
    SpectrumPoint {
        label: point.label.clone(),
        entries: own.filter_map(entry).collect(),
    }
}

/// Largest steps and spectra as numbers.
fn second_opinions(stability: &Stability) -> Vec<Measurement> {
    let number = |method: &str, metric: &str, place: String, value, unit: &str| Measurement {
        method: method.to_owned(),
        metric: metric.to_owned(),
        place,
        value,
        unit: unit.to_owned(),
        against: None,
    };
    let mut all: Vec<Measurement> = Vec::new();
    for step in &stability.largest_steps {
        let value = step.value.clone();
        all.push(number(
            &step.method,
            LARGEST_STEP,
            RUN.to_owned(),
            value,
            "h/c_p",
        ));
    }
    for point in &stability.spectra {
        for (method, opinion) in &point.entries {
            let numbers = match opinion {
                Ok(opinion) => [Ok(opinion.growth), Ok(opinion.rounding)],
                Err(why) => [Err(why.clone()), Err(why.clone())],
            };
            for (name, value) in ["", ":rounding"].into_iter().zip(numbers) {
                let place = format!("{RUN}{name}@{}", point.label);
                all.push(number(method, LARGEST_REAL_PART, place, value, "c_p/h"));
            }
        }
    }
    all
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
