//! From runs to rows: every metric that applies, against every reference that the scene gives.

mod arrivals;
mod certified;

pub use certified::CERTIFIER;

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
use anechoic_solver::record::{Record, Status};

/// The method's name in rows that give the reference's own value.
pub const REFERENCE: &str = "reference";

/// What judging gives.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judged {
    /// The rows.
    pub rows: Vec<Row>,
    /// Why there is no reference, if there is none.
    pub reference_missing: Option<String>,
}

/// Judges runs of one study; ratios are taken over the run of the scene's standard method.
pub fn judge_runs(runs: &[Run]) -> Judged {
    let standard = runs
        .iter()
        .find(|run| run.manifest.method == run.prepared.info.standard && run.complete());
    let extended = certified::certifier(runs);
    let mut judged = Judged::default();
    for (index, run) in runs.iter().enumerate() {
        let mut numbers = cost_measurements(&run.manifest.method, &run.record.cost);
        let obstacle = match &run.record.status {
            Status::Complete => {
                let missing = certified::measure(run, extended, &mut numbers).err();
                judged.reference_missing = judged.reference_missing.or(missing);
                measure(run, standard, index == 0, &mut numbers)
            }
            Status::Cancelled => Err("the run was stopped before its end".to_owned()),
            Status::Failed(error) => Err(format!("the run failed: {error}")),
        };
        if let Err(reason) = &obstacle
            && run.complete()
        {
            judged.reference_missing = Some(reason.clone());
        }
        judged.rows.extend(rows_of(run, &numbers, obstacle.err()));
    }
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
    standard: Option<&Run>,
    first: bool,
    numbers: &mut Vec<Measurement>,
) -> Result<(), String> {
    let scene = run.prepared.scene.as_ref();
    let references = scene.references(&run.record.receivers.times)?;
    let windows = scene.windows();
    for reference in &references {
        let subject = Subject {
            method: &run.manifest.method,
            reference,
            truth: traces_of(reference, &run.record),
            run: traces(&run.record, reference.quantity),
            standard: standard.map(|s| traces(&s.record, reference.quantity)),
        };
        match reference.role {
            Role::Modelled => subject.against_model(numbers),
            Role::NoEcho => {
                subject.residuals(&windows, scene.pulse_amplitude(), numbers);
                subject.echo(&windows, numbers);
                if first {
                    subject.floor(&windows, numbers);
                }
            }
        }
    }
    let last = windows.iter().map(|w| w.from_s).fold(0.0, f64::max);
    let times = &run.record.energy.times;
    let energy = target_energy(&run.record.energy);
    let energy = energy.as_ref().map_err(NormError::clone);
    let left = energy.clone().and_then(|e| energy_left(times, e, last));
    let growth = energy.and_then(|e| Ok(growth_rate_per_s(times, e)?.value));
    for (metric, unit, value) in [
        ("energy_left", "1", left),
        ("growth_rate_per_s", "1/s", growth),
    ] {
        let score = value.map(|value| vec![Score::new("target", value)]);
        numbers.extend(measurements(
            &run.manifest.method,
            metric,
            unit,
            None,
            score,
        ));
    }
    Ok(())
}

/// A run, what is true of it, and the run that absorbs nothing.
struct Subject<'a> {
    method: &'a str,
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

    /// How well the solver does what the closed form says of the boundaries as modelled.
    fn against_model(&self, numbers: &mut Vec<Measurement>) {
        type Norm = fn(&Traces, &Traces) -> Result<Vec<Score>, NormError>;
        let norms: [(&str, Norm); 2] = [("rel_l2", rel_l2), ("peak_error", peak_error)];
        for (metric, norm) in norms {
            let scores = self.pair().and_then(|(run, truth)| norm(run, truth));
            let scores = scores.and_then(|scores| with_groups(&scores));
            numbers.extend(measurements(
                self.method,
                metric,
                "1",
                self.against(),
                scores,
            ));
        }
        if let (true, Ok((run, truth))) = (self.reference.pulses, self.pair()) {
            numbers.extend(arrivals::measure(self.method, self.against(), run, truth));
        }
    }

    /// Largest distance to the reference in each window, over the pulse's amplitude.
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

    /// How much echo the method leaves.
    fn echo(&self, windows: &[Window], numbers: &mut Vec<Measurement>) {
        let level = self
            .pair()
            .and_then(|(run, truth)| with_groups_db(&echo_level_db(run, truth)?));
        numbers.extend(measurements(
            self.method,
            "echo_level_db",
            "dB",
            self.against(),
            level,
        ));
        if self.standard.is_none() {
            return;
        }
        for window in windows.iter().filter(|window| window.label.is_empty()) {
            let onset = Onset::Same(window.from_s);
            let series = self.pair().and_then(|(run, truth)| {
                Ok((
                    cut(run, window)?,
                    cut(truth, window)?,
                    self.standard(window)?,
                ))
            });
            let series = series.as_ref().map_err(NormError::clone);
            let echo = series
                .clone()
                .and_then(|(run, truth, standard)| echo_ratio(run, truth, standard, &onset));
            let ratio =
                series.and_then(|(run, _, standard)| amplitude_ratio(run, standard, &onset));
            for (metric, scores) in [("echo_ratio", echo), ("amplitude_ratio", ratio)] {
                numbers.push(self.at(&window.place(), metric, "1", scores));
            }
        }
    }

    /// What a perfect absorber scores in the amplitude ratio.
    fn floor(&self, windows: &[Window], numbers: &mut Vec<Measurement>) {
        if self.standard.is_none() {
            return;
        }
        for window in windows.iter().filter(|window| window.label.is_empty()) {
            let score = self.pair().and_then(|(_, truth)| {
                let onset = Onset::Same(window.from_s);
                amplitude_ratio(&cut(truth, window)?, &self.standard(window)?, &onset)
            });
            let mut number = self.at(&window.place(), "amplitude_ratio", "1", score);
            number.method = REFERENCE.to_owned();
            numbers.push(number);
        }
    }

    fn standard(&self, window: &Window) -> Result<Traces, NormError> {
        match &self.standard {
            Some(Ok(standard)) => cut(standard, window),
            Some(Err(error)) => Err(error.clone()),
            None => Err(NormError::MissingReceiver {
                receiver: window.receiver.clone(),
                from: "the standard run",
            }),
        }
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
