//! The budget of a run's errors: distances to runs that differ from it in one thing, and to what is
//! true.

use super::references::References;
use super::{traces, traces_of};
use crate::certified::Certified;
use crate::runner::Run;
use crate::scene::{Quantity, Reference, Role};
use crate::sweep::Part;
use anechoic_reference::claim::Evidence;
use anechoic_reports::budget::{Budget, Share};
use anechoic_reports::judge::RUN;
use anechoic_reports::norms::{NormError, Score, Trace, Traces, peak_error, rel_l2};
use anechoic_solver::record::Status;

/// Name of the part of a study that holds a budget's runs.
pub const BUDGET: &str = "budget";

/// The cause that is the boundary.
const BOUNDARY: &str = "boundary";
/// The cause that is the reference.
const REFERENCE: &str = "reference";

/// All causes that may have a share.
pub const CAUSES: [&str; 7] = [
    "total", "space", "time", "points", "transfer", BOUNDARY, REFERENCE,
];

type Norm = fn(&Traces, &Traces) -> Result<Vec<Score>, NormError>;

/// Errors whose order and shares are measured.
const NORMS: [(&str, Norm); 2] = [("rel_l2", rel_l2), ("peak_error", peak_error)];
/// Their names.
pub const ERRORS: [&str; 2] = [NORMS[0].0, NORMS[1].0];

/// Two times are the same if they differ by less than this share of a step.
const SAME_TIME: f64 = 1e-6;

/// Name of the budget's run for a cause.
pub fn budget_label(cause: &str) -> String {
    format!("{BUDGET}:{cause}")
}

/// The shares of the errors of a part's first run, as far as its runs can be read.
pub(super) fn budget(part: &Part, runs: &[Run], references: &References) -> Option<Budget> {
    let at = |point: &crate::sweep::Point| point.pick(runs).0.first().copied();
    let base = part.points.first().and_then(at)?;
    let mut shares = Vec::new();
    let truth = Truth::of(base, references);
    let truth = truth.as_ref().map_err(String::as_str);
    if let Ok(truth) = truth
        && truth.reference.evidence != Evidence::Certified
    {
        let against = (truth.reference.evidence, truth.reference.name.to_owned());
        put("total", against, &mut shares, |norm| {
            truth.total(base, norm)
        });
    }
    for point in part.points.iter().skip(1) {
        let cause = point.label.strip_prefix(BUDGET).unwrap_or(&point.label);
        let cause = cause.trim_start_matches(':');
        let other = at(point).ok_or("its run is lost");
        let against = match (cause, other) {
            (BOUNDARY, _) => (Evidence::Certified, "extended-run".to_owned()),
            (_, Ok(other)) => (Evidence::Refinement, differences(base, other)),
            (_, Err(_)) => (Evidence::Refinement, cause.to_owned()),
        };
        put(cause, against, &mut shares, |norm| {
            let other = other?;
            if cause == BOUNDARY {
                serves(base, other)?;
            }
            truth?.apart(base, other, norm)
        });
    }
    if !part
        .points
        .iter()
        .any(|p| p.label == budget_label(BOUNDARY))
    {
        boundary(base, truth, &mut shares);
    }
    shares.extend(reference_shares(base, references));
    Some(Budget {
        method: base.manifest.method.clone(),
        shares,
    })
}

/// The boundary's share where no run tells it: from a stored reference, or none.
fn boundary(base: &Run, truth: Result<&Truth, &str>, shares: &mut Vec<Share>) {
    let stored = |truth: &&Truth| truth.reference.evidence == Evidence::Certified;
    let name = truth
        .ok()
        .filter(stored)
        .map_or("none", |truth| truth.reference.name);
    put(
        BOUNDARY,
        (Evidence::Certified, name.to_owned()),
        shares,
        |norm| match base.prepared.scene.serves_until_s() {
            Some(_) => Err("the sides are extended: no boundary has a share".to_owned()),
            None => {
                let truth = Some(truth?).filter(stored);
                truth
                    .ok_or("the scene has no extended mesh")?
                    .total(base, norm)
            }
        },
    );
}

/// The reference's own share of the errors of a run: what a finer quadrature changes, or its floor.
pub(super) fn reference_shares(run: &Run, references: &References) -> Vec<Share> {
    let mut shares = Vec::new();
    let truth = Truth::of(run, references);
    let truth = truth.as_ref().map_err(String::as_str);
    let evidence = truth.map_or(Evidence::Refinement, |truth| truth.reference.evidence);
    let how = match evidence {
        Evidence::Certified => "its floor: a larger buffer, a tenth of the tolerance",
        _ => "finer quadrature",
    };
    put(REFERENCE, (evidence, how.to_owned()), &mut shares, |norm| {
        let truth = truth?;
        match references.certified(run) {
            Some(certified) if evidence == Evidence::Certified => truth.floor(certified, norm),
            _ => truth.quadrature(run, norm),
        }
    });
    shares
}

/// Adds a cause's shares, error by error.
fn put(
    cause: &str,
    against: (Evidence, String),
    shares: &mut Vec<Share>,
    scores: impl Fn(Norm) -> Result<Vec<Score>, String>,
) {
    for (metric, norm) in NORMS {
        let share = |place: &str, value| Share {
            name: cause.to_owned(),
            place: place.to_owned(),
            metric: metric.to_owned(),
            value,
            against: against.clone(),
        };
        match scores(norm) {
            Ok(scores) => shares.extend(scores.iter().map(|s| share(&s.place, Ok(s.value)))),
            Err(why) => shares.push(share(RUN, Err(why))),
        }
    }
}

/// What distinguishes a run from the base, as assignments.
fn differences(base: &Run, other: &Run) -> String {
    let fields = base.prepared.info.all_fields();
    let value = |run: &Run, path: &str| {
        let mut keys = path.split('.');
        let first = run.prepared.table.get(keys.next()?);
        keys.try_fold(first?, |value, key| value.get(key)).cloned()
    };
    let differ = fields.iter().filter_map(|field| {
        let [own, its] = [base, other].map(|run| value(run, field.path));
        // a step that is now written out and was the same before is no difference
        let same_step = field.path == crate::over::STEP && step(base) == step(other);
        (own != its && !same_step).then(|| {
            format!(
                "{}={}",
                field.path,
                its.map_or("".into(), |v| v.to_string())
            )
        })
    });
    differ.collect::<Vec<_>>().join(", ")
}

fn step(run: &Run) -> f64 {
    run.prepared.scene.posed().dt()
}

/// Does the extended run serve to the end of the base?
fn serves(base: &Run, extended: &Run) -> Result<(), String> {
    let end = base.record.receivers.times.last().copied().unwrap_or(0.0);
    match extended.prepared.scene.serves_until_s() {
        Some(until) if end <= until => Ok(()),
        Some(until) => Err(format!(
            "the extended run serves until {until:.3} s and not until {end:.3} s"
        )),
        None => Err("the extended run has no extended side".to_owned()),
    }
}

/// What is true of a run, to which shares are related.
struct Truth {
    reference: Reference,
    series: Traces,
}

impl Truth {
    /// What a closed form says of the boundaries as modelled, else what there would be without echo.
    fn of(run: &Run, references: &References) -> Result<Self, String> {
        ended(run)?;
        let mut truths = references.of(run)?;
        let modelled = truths.iter().position(|truth| truth.role == Role::Modelled);
        if truths.is_empty() {
            return Err("nothing is known to be true of it".to_owned());
        }
        let reference = truths.swap_remove(modelled.unwrap_or(0));
        let series = traces_of(&reference, &run.record).map_err(|error| error.to_string())?;
        Ok(Truth { reference, series })
    }

    fn quantity(&self) -> Quantity {
        self.reference.quantity
    }

    /// Distance of a run to the truth.
    fn total(&self, run: &Run, norm: Norm) -> Result<Vec<Score>, String> {
        let own = traces(&run.record, self.quantity());
        own.and_then(|own| norm(&own, &self.series))
            .map_err(|error| error.to_string())
    }

    /// Distance of two runs over the truth, at the times of the first.
    fn apart(&self, run: &Run, other: &Run, norm: Norm) -> Result<Vec<Score>, String> {
        ended(other)?;
        let read = |run: &Run| traces(&run.record, self.quantity()).map_err(|e| e.to_string());
        let (own, its) = (read(run)?, read(other)?);
        let its = at_times(&its, own.times())?;
        self.distance(&own, &its, norm)
    }

    /// Distance of two series over the truth: the norm of the truth displaced by their difference.
    fn distance(&self, own: &Traces, its: &Traces, norm: Norm) -> Result<Vec<Score>, String> {
        let displaced = |((truth, own), its): ((&Trace, &Trace), &Trace)| Trace {
            name: truth.name.clone(),
            components: (0..truth.components.len())
                .map(|axis| {
                    let pairs = own.components[axis].iter().zip(&its.components[axis]);
                    let values = truth.components[axis].iter().zip(pairs);
                    values.map(|(t, (a, b))| t + (a - b)).collect()
                })
                .collect(),
        };
        let receivers = self.series.receivers().iter();
        let receivers = receivers.zip(own.receivers()).zip(its.receivers());
        Traces::new(
            self.series.times().to_vec(),
            receivers.map(displaced).collect(),
        )
        .and_then(|displaced| norm(&displaced, &self.series))
        .map_err(|error| error.to_string())
    }

    /// Distance to the same closed form by a finer quadrature.
    fn quadrature(&self, run: &Run, norm: Norm) -> Result<Vec<Score>, String> {
        let finer = run.prepared.scene.finer_references(self.series.times())?;
        let finer = finer.ok_or("a closed form without quadrature")?;
        let alike = finer.iter().find(|finer| finer.role == self.reference.role);
        let alike = alike.ok_or("a closed form without quadrature")?;
        let finer = traces_of(alike, &run.record).map_err(|error| error.to_string())?;
        self.distance(&self.series, &finer, norm)
    }

    /// A departure from silence by the floor of a certified reference, receiver by receiver.
    fn floor(&self, certified: &Certified, norm: Norm) -> Result<Vec<Score>, String> {
        let floors = certified
            .about
            .floor_m
            .as_ref()
            .ok_or("its floor was not measured")?;
        let constant = |floor: f64, trace: &Trace| Trace {
            name: trace.name.clone(),
            components: vec![
                vec![floor; self.series.times().len()],
                vec![0.0; self.series.times().len()],
            ],
        };
        let of = |value: &dyn Fn(&str) -> f64| {
            let receivers = self.series.receivers().iter();
            let receivers = receivers.map(|trace| constant(value(&trace.name), trace));
            Traces::new(self.series.times().to_vec(), receivers.collect())
                .map_err(|e| e.to_string())
        };
        let floor = of(&|name| floors.get(name).copied().unwrap_or(0.0))?;
        self.distance(&floor, &of(&|_| 0.0)?, norm)
    }
}

fn ended(run: &Run) -> Result<(), String> {
    match &run.record.status {
        Status::Complete => Ok(()),
        Status::Cancelled => Err("the run was stopped before its end".to_owned()),
        Status::Failed(error) => Err(format!("the run failed: {error}")),
    }
}

/// Series at some of their times (s).
fn at_times(series: &Traces, times: &[f64]) -> Result<Traces, String> {
    let step = times.last().copied().unwrap_or(0.0) / times.len().max(2) as f64;
    let find = |time: &f64| {
        let near = series
            .times()
            .partition_point(|t| *t < time - SAME_TIME * step);
        let found = series.times().get(near)?;
        ((found - time).abs() <= SAME_TIME * step).then_some(near)
    };
    let places: Option<Vec<usize>> = times.iter().map(find).collect();
    let places = places.ok_or("the runs are not sampled at the same times: choose a time.end_s that is a multiple of the step")?;
    let receivers = series.receivers().iter().map(|trace| Trace {
        name: trace.name.clone(),
        components: trace
            .components
            .iter()
            .map(|values| places.iter().map(|&i| values[i]).collect())
            .collect(),
    });
    Traces::new(times.to_vec(), receivers.collect()).map_err(|error| error.to_string())
}
