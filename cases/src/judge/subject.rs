//! A run beside what is true of it: the numbers of each metric.

use super::series::cut;
use super::{REFERENCE, arrivals};
use crate::posed::{Posed, either};
use crate::scene::{Reference, Window};
use anechoic_reference::claim::Evidence;
use anechoic_reports::judge::{Measurement, measurements};
use anechoic_reports::norms::{
    NormError, Onset, Score, Traces, amplitude_ratio, echo_level_db, echo_ratio, peak_error,
    rel_l2, residual, with_groups, with_groups_db,
};

/// Each receiver's own start of its window.
pub(super) fn onsets(windows: &[Window]) -> Onset {
    let own = windows.iter().filter(|window| window.label.is_empty());
    Onset::Each(own.map(|w| (w.receiver.clone(), w.from_s)).collect())
}

/// A run, what is true of it, and the run that absorbs nothing.
pub(super) struct Subject<'a> {
    pub(super) method: &'a str,
    pub(super) problem: &'a Posed,
    pub(super) reference: &'a Reference,
    pub(super) truth: Result<Traces, NormError>,
    pub(super) run: Result<Traces, NormError>,
    pub(super) standard: Option<Result<Traces, NormError>>,
}

impl Subject<'_> {
    fn against(&self) -> Option<(Evidence, &str)> {
        Some((self.reference.evidence, self.reference.name))
    }

    /// Run and truth, when both are in order.
    pub(super) fn pair(&self) -> Result<(&Traces, &Traces), NormError> {
        match (&self.run, &self.truth) {
            (Ok(run), Ok(truth)) => Ok((run, truth)),
            (Err(error), _) | (_, Err(error)) => Err(error.clone()),
        }
    }

    /// Distance to the reference over the whole run.
    pub(super) fn distances(&self, numbers: &mut Vec<Measurement>) {
        type Norm = fn(&Traces, &Traces) -> Result<Vec<Score>, NormError>;
        let norms: [(&str, Norm); 2] = [("rel_l2", rel_l2), ("peak_error", peak_error)];
        for (metric, norm) in norms {
            let scores = self.pair().and_then(|(run, truth)| norm(run, truth));
            let scores = scores.and_then(|scores| with_groups(&scores));
            self.put(metric, "1", scores, numbers);
        }
    }

    /// How well the solver does what the closed form says of the boundaries as modelled.
    pub(super) fn against_model(&self, numbers: &mut Vec<Measurement>) {
        self.distances(numbers);
        if let (true, Ok((run, truth))) = (self.reference.pulses, self.pair()) {
            numbers.extend(arrivals::measure(
                self.method,
                self.against(),
                run,
                truth,
                &|receiver| {
                    either!(self.problem, problem => arrivals::prescribed_until(problem, receiver))
                },
            ));
        }
    }

    /// How much echo the method leaves.
    pub(super) fn echo(
        &self,
        windows: &[Window],
        amplitude: Option<f64>,
        numbers: &mut Vec<Measurement>,
    ) {
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
    pub(super) fn residuals(
        &self,
        windows: &[Window],
        amplitude: f64,
        numbers: &mut Vec<Measurement>,
    ) {
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
    pub(super) fn floor(&self, windows: &[Window], numbers: &mut Vec<Measurement>) {
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
    pub(super) fn put(
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
