//! Accuracy against cost: what a sweep of ladders says of its methods.

use super::references::References;
use super::series::axes_of;
use crate::awake::awake_share;
use crate::error::CaseError;
use crate::over::level_in;
use crate::runner::Run;
use crate::sweep::Grid;
use crate::timing::{self, Timings};
use anechoic_reports::judge::judge;
use anechoic_reports::norms::Traces;
use anechoic_reports::row::Row;
use anechoic_reports::sweep::Sweep;
use anechoic_reports::tradeoff::{Known, Tradeoff};
use anechoic_solver::record::Status;

/// The study with its rows, which carry the claims of the scene.
///
/// # Errors
/// [`CaseError::Solver`] for a scene that cannot be laid out, which no run then could.
pub fn judge_trades(
    runs: &[Run],
    grid: &Grid,
    sweep: &Sweep,
    references: &References,
    timings: &Timings,
) -> Result<(Tradeoff, Vec<Row>), CaseError> {
    let mut known = Vec::new();
    let mut at_end = Vec::new();
    for point in grid.parts.iter().flat_map(|part| &part.points) {
        for run in point.pick(runs).0 {
            known.push(about(run, timings));
            at_end.push((run, point.label == "no-echo"));
        }
    }
    let Some((first, _)) = at_end.first() else {
        return Ok((Tradeoff::new(sweep, &known, None, [1.0; 2]), Vec::new()));
    };
    let plain = at_end.iter().position(|(_, plain)| *plain);
    // Where no floor was measured, what the extended mesh leaves is the discretisation's own.
    let left = || {
        let entries = sweep.parts.iter().flat_map(|part| &part.points);
        let entry = entries.flat_map(|point| &point.entries).nth(plain?)?;
        entry.mean()
    };
    let floor = floor(first, references).or_else(left);
    let mut tradeoff = Tradeoff::new(sweep, &known, floor, wavelengths(first));
    tradeoff.plain = plain;
    if let Some(at) = tradeoff.plain {
        tradeoff.awake_share = Some(awake_share(&at_end[at].0.prepared.scene.posed())?);
    }
    let claims = first.prepared.scene.trades();
    let (case, profile) = (&first.manifest.case, &first.manifest.profile);
    let rows = judge(case, profile, &tradeoff.measurements(), &claims);
    Ok((tradeoff, rows))
}

fn about(run: &Run, timings: &Timings) -> Known {
    let sides = run.prepared.scene.boundary().named();
    let thickness = sides.into_iter().find_map(|(_, side)| {
        level_in(&run.prepared.table, &format!("{}.thickness_m", side.method))
    });
    Known {
        thickness_m: thickness,
        timing: timings.get(&timing::key(run)).copied(),
        failed: match &run.record.status {
            Status::Complete => None,
            Status::Cancelled => Some("stopped before its end".to_owned()),
            Status::Failed(error) => Some(error.clone()),
        },
    }
}

/// The mean over receivers of the reference's floor over the peak of its own motion; `None` where it
/// was not measured.
fn floor(run: &Run, references: &References) -> Option<f64> {
    let certified = references.certified(run)?;
    let floors = certified.about.floor_m.as_ref()?;
    let mut ratios = Vec::new();
    for (receiver, floor) in floors {
        let axes = axes_of(&certified.receivers, 'u');
        let suffixes: Vec<&str> = axes.iter().map(String::as_str).collect();
        let traces = Traces::from_table(&certified.receivers, &suffixes).ok()?;
        let mut traces = traces.receivers().iter();
        let motion = traces.find(|trace| trace.name == *receiver)?.magnitude();
        let peak = motion.into_iter().fold(0.0, f64::max);
        ratios.push(floor / peak);
    }
    let count = ratios.len() as f64;
    (count > 0.0).then(|| ratios.iter().sum::<f64>() / count)
}

/// Lengths (m) of compressional and shear waves at the frequency of the first source.
fn wavelengths(run: &Run) -> [f64; 2] {
    let problem = run.prepared.scene.posed();
    let frequency = problem
        .pulses()
        .first()
        .map_or(1.0, |pulse| pulse.frequency);
    let material = problem.material();
    [material.p_speed(), material.s_speed()].map(|speed| speed / frequency)
}
