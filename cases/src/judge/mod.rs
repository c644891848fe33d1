//! From runs to rows: every metric that applies, against every reference that the scene gives.

mod arrivals;
mod certified;
mod papers;
pub mod references;

pub use certified::CERTIFIER;

use crate::certified::Certified;
use crate::runner::Run;
use crate::scene::{Quantity, Reference, Role, Window};
use anechoic_reference::claim::{Claim, Evidence};
use anechoic_reports::judge::{Measurement, cost_measurements, judge, measurements};
use anechoic_reports::norms::{
    NormError, Onset, Score, Trace, Traces, amplitude_ratio, echo_level_db, echo_ratio,
    energy_left, growth_rate_per_s, peak_error, rel_l2, residual, target_energy, with_groups,
    with_groups_db,
};
use anechoic_reports::row::{Row, Verdict};
use anechoic_solver::problem::Problem;
use anechoic_solver::record::{Record, Status};
use references::{References, standard_of};

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
    /// Why runs have no reference, claims or not.
    pub notes: Vec<String>,
}

/// Judges runs of one study; ratios are taken over the run of the scene's standard method.
pub fn judge_runs(runs: &[Run], references: &References) -> Judged {
    let extended = certified::certifier(runs);
    let mut judged = Judged::default();
    for (index, run) in runs.iter().enumerate() {
        let mut numbers = cost_measurements(&run.manifest.method, &run.record.cost);
        let mut missing: Vec<String> = Vec::new();
        let obstacle = match &run.record.status {
            Status::Complete => {
                missing.extend(certified::measure(run, extended, &mut numbers).err());
                let standard = standard_of(run, runs);
                measure(run, references, standard, index == 0, &mut numbers)
            }
            Status::Cancelled => Err("the run was stopped before its end".to_owned()),
            Status::Failed(error) => Err(format!("the run failed: {error}")),
        };
        if let Err(reason) = &obstacle
            && run.complete()
        {
            missing.push(reason.clone());
        }
        let rows = rows_of(run, &numbers, obstacle.err());
        for reason in missing {
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

/// The claims on this run's method, judged or with the reason why not, and all other numbers.
fn rows_of(run: &Run, numbers: &[Measurement], obstacle: Option<String>) -> Vec<Row> {
    let (case, profile) = (&run.manifest.case, &run.manifest.profile);
    let mut apply: Vec<Claim> = Vec::new();
    let mut reasons: Vec<(Claim, String)> = Vec::new();
    for claim in run.prepared.scene.claims() {
        if claim.claim.method != run.manifest.method {
            continue;
        }
        match obstacle.clone().or(claim.not_here) {
            None => apply.push(claim.claim),
            Some(reason) => reasons.push((claim.claim, reason)),
        }
    }
    let mut all = apply.clone();
    all.extend(reasons.iter().map(|(claim, _)| claim.clone()));
    let mut rows = judge(case, profile, numbers, &all);
    // Rows of claims come first and in their order.
    for (row, (_, reason)) in rows.iter_mut().skip(apply.len()).zip(&reasons) {
        row.verdict = Some(Verdict::NotEvaluated);
        row.why.clone_from(reason);
    }
    rows
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
    energies(run, &windows, numbers);
    let problem = scene.problem();
    let truths = references.of(run)?;
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
        match reference.role {
            Role::Modelled => subject.against_model(numbers),
            Role::NoEcho => {
                // Where no closed form knows the boundaries as modelled, all distance is the method's.
                if !modelled(reference.evidence) {
                    subject.distances(numbers);
                }
                subject.echo(&windows, scene.pulse_amplitude(), numbers);
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
        let constant = |trace: &Trace, value: f64| Trace {
            name: trace.name.clone(),
            components: vec![vec![value; times.len()], vec![0.0; times.len()]],
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

/// Each receiver's own start of its window.
fn onsets(windows: &[Window]) -> Onset {
    let own = windows.iter().filter(|window| window.label.is_empty());
    Onset::Each(own.map(|w| (w.receiver.clone(), w.from_s)).collect())
}

/// A run, what is true of it, and the run that absorbs nothing.
struct Subject<'a> {
    method: &'a str,
    problem: &'a Problem<2>,
    reference: &'a Reference,
    truth: Result<Traces, NormError>,
    run: Result<Traces, NormError>,
    standard: Option<Result<Traces, NormError>>,
}

impl Subject<'_> {
    fn against(&self) -> Option<(Evidence, &str)> {
        Some((self.reference.evidence, self.reference.name))
    }

    /// Run and truth, when both are in order.
    fn pair(&self) -> Result<(&Traces, &Traces), NormError> {
        match (&self.run, &self.truth) {
            (Ok(run), Ok(truth)) => Ok((run, truth)),
            (Err(error), _) | (_, Err(error)) => Err(error.clone()),
        }
    }

    /// Distance to the reference over the whole run.
    fn distances(&self, numbers: &mut Vec<Measurement>) {
        type Norm = fn(&Traces, &Traces) -> Result<Vec<Score>, NormError>;
        let norms: [(&str, Norm); 2] = [("rel_l2", rel_l2), ("peak_error", peak_error)];
        for (metric, norm) in norms {
            let scores = self.pair().and_then(|(run, truth)| norm(run, truth));
            let scores = scores.and_then(|scores| with_groups(&scores));
            self.put(metric, "1", scores, numbers);
        }
    }

    /// How well the solver does what the closed form says of the boundaries as modelled.
    fn against_model(&self, numbers: &mut Vec<Measurement>) {
        self.distances(numbers);
        if let (true, Ok((run, truth))) = (self.reference.pulses, self.pair()) {
            numbers.extend(arrivals::measure(
                self.method,
                self.against(),
                run,
                truth,
                &|receiver| arrivals::prescribed_until(self.problem, receiver),
            ));
        }
    }

    /// How much echo the method leaves.
    fn echo(&self, windows: &[Window], amplitude: Option<f64>, numbers: &mut Vec<Measurement>) {
        if let Some(amplitude) = amplitude {
            self.residuals(windows, amplitude, numbers);
        }
        let level = self
            .pair()
            .and_then(|(run, truth)| with_groups_db(&echo_level_db(run, truth)?));
        self.put("echo_level_db", "dB", level, numbers);
        let Some(standard) = &self.standard else {
            return;
        };
        let onset = onsets(windows);
        let with_standard = self.pair().and_then(|(run, truth)| {
            let standard = standard.as_ref().map_err(NormError::clone)?;
            Ok((run, truth, standard))
        });
        let echo = with_standard.clone().and_then(|(run, truth, standard)| {
            with_groups(&echo_ratio(run, truth, standard, &onset)?)
        });
        let ratio = with_standard
            .and_then(|(run, _, standard)| with_groups(&amplitude_ratio(run, standard, &onset)?));
        self.put("echo_ratio", "1", echo, numbers);
        self.put("amplitude_ratio", "1", ratio, numbers);
    }

    /// What is left in each window, over the pulse.
    fn residuals(&self, windows: &[Window], amplitude: f64, numbers: &mut Vec<Measurement>) {
        for window in windows {
            let score = self.pair().and_then(|(run, truth)| {
                let (run, truth) = (cut(run, window)?, cut(truth, window)?);
                residual(&run, &truth, amplitude, &Onset::Same(window.from_s))
            });
            let mut number = self.at(&window.place(), "residual", "1", score);
            if let Some((evidence, name)) = window.stated_by {
                number.against = Some((evidence, name.to_owned()));
            }
            numbers.push(number);
        }
    }

    /// What a perfect absorber scores in the amplitude ratio.
    fn floor(&self, windows: &[Window], numbers: &mut Vec<Measurement>) {
        let Some(Ok(standard)) = &self.standard else {
            return;
        };
        let scores = self.pair().and_then(|(_, truth)| {
            with_groups(&amplitude_ratio(truth, standard, &onsets(windows))?)
        });
        let against = self.against();
        numbers.extend(measurements(
            REFERENCE,
            "amplitude_ratio",
            "1",
            against,
            scores,
        ));
    }

    /// Numbers of one metric at all places.
    fn put(
        &self,
        metric: &str,
        unit: &str,
        scores: Result<Vec<Score>, NormError>,
        numbers: &mut Vec<Measurement>,
    ) {
        let against = self.against();
        numbers.extend(measurements(self.method, metric, unit, against, scores));
    }

    /// One number at one place.
    fn at(
        &self,
        place: &str,
        metric: &str,
        unit: &str,
        scores: Result<Vec<Score>, NormError>,
    ) -> Measurement {
        Measurement {
            method: self.method.to_owned(),
            metric: metric.to_owned(),
            place: place.to_owned(),
            value: match scores.as_deref() {
                Ok([score]) => Ok(score.value),
                Ok(_) => Err("not a single receiver".to_owned()),
                Err(error) => Err(error.to_string()),
            },
            unit: unit.to_owned(),
            against: Some((self.reference.evidence, self.reference.name.to_owned())),
        }
    }
}

/// The recorded motion.
pub fn traces(record: &Record, quantity: Quantity) -> Result<Traces, NormError> {
    let letter = quantity.letter();
    let suffixes = [format!("{letter}x"), format!("{letter}y")];
    Traces::from_table(&record.receivers, &[&suffixes[0], &suffixes[1]])
}

/// The true motion at the record's times.
pub fn traces_of(reference: &Reference, record: &Record) -> Result<Traces, NormError> {
    let receivers = reference
        .receivers
        .iter()
        .map(|(name, components)| Trace {
            name: name.clone(),
            components: components.to_vec(),
        })
        .collect();
    Traces::new(record.receivers.times.clone(), receivers)
}

/// The receiver of a window alone, up to the window's end.
fn cut(traces: &Traces, window: &Window) -> Result<Traces, NormError> {
    let end = window.to_s.map_or(traces.times().len(), |to| {
        traces.times().partition_point(|t| *t <= to)
    });
    let receiver = traces
        .receivers()
        .iter()
        .find(|trace| trace.name == window.receiver)
        .ok_or_else(|| NormError::MissingReceiver {
            receiver: window.receiver.clone(),
            from: "the record",
        })?;
    Traces::new(
        traces.times()[..end].to_vec(),
        vec![Trace {
            name: receiver.name.clone(),
            components: receiver
                .components
                .iter()
                .map(|values| values[..end].to_vec())
                .collect(),
        }],
    )
}
