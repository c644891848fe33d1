//! From runs to rows: every metric that applies, against every reference that the scene gives.

mod arrivals;
mod budget;
mod certified;
mod foreign;
mod goodness;
mod growth;
mod levels;
mod papers;
mod points;
pub mod references;
mod rows;
mod series;
mod settlement;
mod stability;
mod subject;
mod trades;

pub use budget::{BUDGET, CAUSES, ERRORS, budget_label};
pub use certified::CERTIFIER;
pub use levels::judge_levels;
pub use points::judge_points;
pub use rows::rows_unread;
pub use series::{traces, traces_of};
pub use stability::{RATIO_AXIS, STEP_AXIS, judge_stability};
pub use trades::judge_trades;

use crate::certified::Certified;
use crate::runner::Run;
use crate::scene::{Beside, Quantity, Role, Window};
use anechoic_reports::judge::{Measurement, cost_measurements, measurements};
use anechoic_reports::norms::{
    Score, Trace, Traces, echo_ratio, energy_left, growth_rate_per_s, target_energy, with_groups,
};
use anechoic_reports::row::{Row, Verdict};
use anechoic_solver::record::Status;
use references::{References, standard_of};
use rows::{names_of, rows_of};
use subject::{Subject, onsets};

/// The method's name in rows that give the reference's own value.
pub const REFERENCE: &str = "reference";

/// The method's name in rows that give a number printed in a paper.
pub const PAPER: &str = "paper";

/// What judging gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judged {
    /// The rows.
    pub rows: Vec<Row>,
    /// Why claims have no reference, if there are such claims.
    pub reference_missing: Option<String>,
    /// Why runs have no reference, claims or not, and whose energy grows.
    pub notes: Vec<String>,
}

/// Judges runs of one study; ratios are taken over the run of the scene's standard method.
pub fn judge_runs(runs: &[&Run], references: &References) -> Judged {
    let mut judged = Judged::default();
    for &run in runs {
        let measured = measured(run, runs, references);
        let claims = run.prepared.scene.claims();
        let mut rows = rows_of(
            run,
            names_of(run),
            &measured.numbers,
            claims,
            measured.obstacle,
        );
        judged.notes.extend(growth::unstable(run, &mut rows));
        for reason in measured.missing {
            let concerns =
                |row: &Row| row.verdict == Some(Verdict::NotEvaluated) && row.why == reason;
            judged
                .notes
                .push(format!("{}: no reference: {reason}", run.manifest.method));
            // A run that claims nothing misses nothing.
            if judged.reference_missing.is_none() && rows.iter().any(concerns) {
                judged.reference_missing = Some(reason);
            }
        }
        judged.rows.extend(rows);
    }
    judged.rows.extend(papers::rows(runs));
    judged
}

/// What is measured of a run.
struct Measured {
    numbers: Vec<Measurement>,
    /// Why claims cannot be judged: the run did not end, or has no reference.
    obstacle: Option<String>,
    /// References that are missing, and why.
    missing: Vec<String>,
}

/// Everything that is measured of a run of a study.
fn measured(run: &Run, runs: &[&Run], references: &References) -> Measured {
    let mut numbers = match run.manifest.scored {
        // Nobody knows what it cost.
        Some(_) => Vec::new(),
        None => cost_measurements(&run.manifest.method, &run.record.cost),
    };
    let mut missing: Vec<String> = Vec::new();
    let obstacle = match &run.record.status {
        Status::Complete => {
            let extended = certified::certifier(runs);
            missing.extend(certified::measure(run, extended, &mut numbers).err());
            own_norms(run, runs, &mut numbers);
            let first = runs.first().is_some_and(|first| std::ptr::eq(*first, run));
            measure(run, references, standard_of(run, runs), first, &mut numbers)
                .and_then(|()| foreign::recognised(run, &mut numbers))
        }
        Status::Cancelled => Err("the run was stopped before its end".to_owned()),
        Status::Failed(error) => Err(format!("the run failed: {error}")),
    };
    if let Err(reason) = &obstacle
        && run.complete()
    {
        missing.push(reason.clone());
    }
    Measured {
        numbers,
        obstacle: obstacle.err(),
        missing,
    }
}

/// What is measured by the scene's own norms.
fn own_norms<'a>(run: &Run, runs: &[&'a Run], numbers: &mut Vec<Measurement>) {
    let scene = run.prepared.scene.as_ref();
    let record = |run: &'a Run| &run.record;
    let standard = standard_of(run, runs);
    let beside = Beside {
        standard: standard.map(record),
        extended: certified::beside(run, runs).map(record),
        standard_extended: standard
            .and_then(|run| certified::beside(run, runs))
            .map(record),
    };
    let own = scene.measures(&run.record, &beside);
    numbers.extend(own.into_iter().map(|number| Measurement {
        method: run.manifest.method.clone(),
        metric: number.metric.to_owned(),
        place: number.place,
        value: number.value,
        unit: number.unit.to_owned(),
        against: number.against.map(|(kind, name)| (kind, name.to_owned())),
    }));
}

/// All metrics of a complete run.
fn measure(
    run: &Run,
    references: &References,
    standard: Option<&Run>,
    first: bool,
    numbers: &mut Vec<Measurement>,
) -> Result<(), String> {
    let scene = run.prepared.scene.as_ref();
    let windows = scene.windows();
    if run.manifest.scored.is_none() {
        energies(run, &windows, numbers);
    }
    let problem = scene.posed();
    let mut truths = references.of(run)?;
    if run.manifest.judged_as().is_none() {
        // Of another program nobody said what its boundary is a model of.
        truths.retain(|truth| truth.role != Role::Modelled);
    }
    let modelled = |evidence| {
        let mut others = truths.iter();
        others.any(|r| r.role == Role::Modelled && r.evidence == evidence)
    };
    for reference in &truths {
        let subject = Subject {
            problem: &problem,
            method: &run.manifest.method,
            reference,
            truth: traces_of(reference, &run.record),
            run: traces(&run.record, reference.quantity),
            standard: standard.map(|s| traces(&s.record, reference.quantity)),
        };
        // Without echo is all that is known of some runs; where the same evidence knows the boundaries
        // as modelled, that is compared.
        if reference.role == Role::Modelled || !modelled(reference.evidence) {
            goodness::measure(&subject, numbers);
        }
        match reference.role {
            Role::Modelled => subject.against_model(numbers),
            Role::NoEcho => {
                // Where no closed form knows the boundaries as modelled, all distance is the method's.
                if !modelled(reference.evidence) {
                    subject.distances(numbers);
                }
                subject.echo(&windows, scene.pulse_amplitude(), numbers);
                settlement::measure(&subject, numbers);
                if first {
                    subject.floor(&windows, numbers);
                }
            }
        }
    }
    if first && let Some(certified) = references.certified(run) {
        reference_floor(run, certified, &windows, standard, numbers);
    }
    Ok(())
}

/// What energy is left, and whether it grows.
fn energies(run: &Run, windows: &[Window], numbers: &mut Vec<Measurement>) {
    let (method, table) = (&run.manifest.method, &run.record.energy);
    let last = windows.iter().map(|w| w.from_s).fold(0.0, f64::max);
    let left = target_energy(table)
        .and_then(|energy| energy_left(&table.times, &energy, last))
        .map(|value| vec![Score::new("target", value)]);
    numbers.extend(measurements(method, "energy_left", "1", None, left));
    let Some(total) = table.column("total") else {
        return;
    };
    let growth = growth_rate_per_s(&table.times, total).map(|slope| {
        let mut scores = vec![Score::new("total", slope.value)];
        if let Some([low, high]) = slope.interval {
            scores.push(Score::new("total:low", low));
            scores.push(Score::new("total:high", high));
        }
        scores
    });
    numbers.extend(measurements(
        method,
        "growth_rate_per_s",
        "1/s",
        None,
        growth,
    ));
}

/// The echo ratio that a certified reference itself is uncertain by.
fn reference_floor(
    run: &Run,
    certified: &Certified,
    windows: &[Window],
    standard: Option<&Run>,
    numbers: &mut Vec<Measurement>,
) {
    let (Some(floor), Some(standard)) = (&certified.about.floor_m, standard) else {
        return;
    };
    let scores = traces(&standard.record, Quantity::Displacement).and_then(|standard| {
        // A run that departs from silence by the floor, receiver by receiver.
        let times = run.record.receivers.times.clone();
        let constant = |trace: &Trace, value: f64| {
            let mut components = vec![vec![0.0; times.len()]; trace.components.len()];
            components[0].fill(value);
            Trace {
                name: trace.name.clone(),
                components,
            }
        };
        let of = |value: &dyn Fn(&str) -> f64| {
            let made = standard
                .receivers()
                .iter()
                .map(|t| constant(t, value(&t.name)));
            Traces::new(times.clone(), made.collect())
        };
        let floor = of(&|name| floor.get(name).copied().unwrap_or(0.0))?;
        let scores = echo_ratio(&floor, &of(&|_| 0.0)?, &standard, &onsets(windows))?;
        with_groups(&scores)
    });
    numbers.extend(measurements(REFERENCE, "echo_ratio", "1", None, scores));
}
