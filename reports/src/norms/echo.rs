//! Comparisons of receivers' series with a reference, and with the standard run.
//!
//! Every function gives one [`Score`] a receiver; [`super::with_groups`] adds the groups.

use super::{NormError, Score, Trace, Traces, max_abs};
use std::collections::BTreeMap;

/// From when on a late metric looks (s).
#[derive(Clone, Debug, PartialEq)]
pub enum Onset {
    /// The same time for all receivers.
    Same(f64),
    /// Each receiver its own.
    Each(BTreeMap<String, f64>),
}

impl Onset {
    /// Index of the first sample at or after the onset of `receiver`.
    fn first_sample(&self, receiver: &str, times: &[f64]) -> Result<usize, NormError> {
        let from = match self {
            Onset::Same(t) => *t,
            Onset::Each(by_name) => *by_name.get(receiver).ok_or_else(|| NormError::NoOnset {
                receiver: receiver.to_owned(),
            })?,
        };
        let first = times.partition_point(|t| *t < from);
        if first < times.len() && !from.is_nan() {
            return Ok(first);
        }
        Err(NormError::EmptyWindow {
            from,
            to: f64::INFINITY,
            start: times[0],
            end: times[times.len() - 1],
        })
    }
}

/// Largest late magnitude of the method over the same of the standard run (K25).
pub fn amplitude_ratio(
    method: &Traces,
    standard: &Traces,
    onset: &Onset,
) -> Result<Vec<Score>, NormError> {
    let times = method.times();
    method
        .pair(standard, "the standard run")?
        .into_iter()
        .map(|(mine, standard)| {
            let first = onset.first_sample(&mine.name, times)?;
            let late = |t: &Trace| max_abs(&t.magnitude()[first..]);
            ratio(mine, late(mine), late(standard), LATE_STANDARD)
        })
        .collect()
}

/// Largest late distance to the reference over the largest late magnitude of the standard run:
/// zero is perfect.
pub fn echo_ratio(
    method: &Traces,
    reference: &Traces,
    standard: &Traces,
    onset: &Onset,
) -> Result<Vec<Score>, NormError> {
    let times = method.times();
    let standards = method.pair(standard, "the standard run")?;
    method
        .pair(reference, "the reference")?
        .into_iter()
        .zip(standards)
        .map(|((mine, reference), (_, standard))| {
            let first = onset.first_sample(&mine.name, times)?;
            let echo = max_abs(&mine.distance(reference)[first..]);
            let scale = max_abs(&standard.magnitude()[first..]);
            ratio(mine, echo, scale, LATE_STANDARD)
        })
        .collect()
}

/// The echo over time: distance to the reference over the standard run's largest magnitude of the
/// whole run; one series a receiver, named after it.
pub fn echo_series(
    method: &Traces,
    reference: &Traces,
    standard: &Traces,
) -> Result<Vec<(String, Vec<f64>)>, NormError> {
    let standards = method.pair(standard, "the standard run")?;
    method
        .pair(reference, "the reference")?
        .into_iter()
        .zip(standards)
        .map(|((mine, reference), (_, standard))| {
            let scale = ratio(
                mine,
                1.0,
                max_abs(&standard.magnitude()),
                "the standard run",
            )?;
            let echo = mine.distance(reference);
            let relative = echo.into_iter().map(|d| d * scale.value).collect();
            Ok((mine.name.clone(), relative))
        })
        .collect()
}

/// Largest distance to the reference over the largest magnitude of the reference, in dB.
///
/// Round-off (2.2e-16, -313 dB) bounds it from below, so that a perfect method has a level.
pub fn echo_level_db(method: &Traces, reference: &Traces) -> Result<Vec<Score>, NormError> {
    let mut scores = peak_error(method, reference)?;
    for score in &mut scores {
        score.value = 20.0 * score.value.max(f64::EPSILON).log10();
    }
    Ok(scores)
}

/// Largest distance to the reference from the onset on, over the amplitude of the pulse.
///
/// `pulse_amplitude` in the unit of the series.
pub fn residual(
    method: &Traces,
    reference: &Traces,
    pulse_amplitude: f64,
    onset: &Onset,
) -> Result<Vec<Score>, NormError> {
    let times = method.times();
    method
        .pair(reference, "the reference")?
        .into_iter()
        .map(|(mine, reference)| {
            let first = onset.first_sample(&mine.name, times)?;
            let echo = max_abs(&mine.distance(reference)[first..]);
            ratio(mine, echo, pulse_amplitude.abs(), "the pulse's amplitude")
        })
        .collect()
}

/// Largest distance to the reference over the largest magnitude of the reference.
pub fn peak_error(method: &Traces, reference: &Traces) -> Result<Vec<Score>, NormError> {
    method
        .pair(reference, "the reference")?
        .into_iter()
        .map(|(mine, reference)| {
            let error = max_abs(&mine.distance(reference));
            ratio(
                mine,
                error,
                max_abs(&reference.magnitude()),
                "the reference",
            )
        })
        .collect()
}

/// Euclidean norm over all samples of the difference to the reference, over that of the reference.
pub fn rel_l2(method: &Traces, reference: &Traces) -> Result<Vec<Score>, NormError> {
    method
        .pair(reference, "the reference")?
        .into_iter()
        .map(|(mine, reference)| {
            let error = norm2(&mine.distance(reference));
            ratio(mine, error, norm2(&reference.magnitude()), "the reference")
        })
        .collect()
}

const LATE_STANDARD: &str = "the standard run after the onset";

fn norm2(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>().sqrt()
}

pub(super) fn ratio(trace: &Trace, above: f64, below: f64, what: &str) -> Result<Score, NormError> {
    if below > 0.0 && below.is_finite() {
        return Ok(Score::new(&trace.name, above / below));
    }
    Err(NormError::ZeroDenominator {
        what: format!("{what} at receiver {}", trace.name),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const ONSET: Onset = Onset::Same(2.0);

    /// One receiver `A1` with two components at t = 0, 1, 2, 3 s.
    fn traces(x: [f64; 4], y: [f64; 4]) -> Traces {
        let trace = Trace {
            name: "A1".to_owned(),
            components: vec![x.to_vec(), y.to_vec()],
        };
        Traces::new(vec![0.0, 1.0, 2.0, 3.0], vec![trace]).expect("valid")
    }

    fn value(scores: Result<Vec<Score>, NormError>) -> f64 {
        let scores = scores.expect("the metric is defined");
        assert_eq!(scores.len(), 1);
        assert_eq!(scores[0].place, "A1");
        scores[0].value
    }

    fn example() -> (Traces, Traces, Traces) {
        let reference = traces([0.0, 4.0, 1.0, 0.0], [0.0; 4]);
        let method = traces([0.0, 4.0, 1.3, 0.0], [0.0, 0.0, 0.4, 0.0]);
        let standard = traces([0.0, 8.0, 3.0, 0.0], [0.0, 0.0, 4.0, -2.0]);
        (method, reference, standard)
    }

    #[test]
    fn ratios_look_at_the_late_part_only() {
        let (method, reference, standard) = example();
        // Late magnitudes: method hypot(1.3, 0.4), standard hypot(3, 4) = 5, difference 0.5.
        let amplitude = value(amplitude_ratio(&method, &standard, &ONSET));
        assert!((amplitude - 1.3f64.hypot(0.4) / 5.0).abs() < 1e-15);
        let echo = value(echo_ratio(&method, &reference, &standard, &ONSET));
        assert!((echo - 0.1).abs() < 1e-15);
        let perfect = value(echo_ratio(&reference, &reference, &standard, &ONSET));
        assert_eq!(perfect, 0.0);
    }

    #[test]
    fn whole_run_metrics() {
        let (method, reference, standard) = example();
        assert!((value(peak_error(&method, &reference)) - 0.125).abs() < 1e-15);
        let level = value(echo_level_db(&method, &reference));
        assert!((level - 20.0 * 0.125f64.log10()).abs() < 1e-12);
        let l2 = value(rel_l2(&method, &reference));
        assert!((l2 - 0.5 / 17f64.sqrt()).abs() < 1e-15);
        let series = echo_series(&method, &reference, &standard).expect("defined");
        assert_eq!(series[0].0, "A1");
        assert!((series[0].1[2] - 0.0625).abs() < 1e-15);
        assert_eq!(series[0].1[1], 0.0);
    }

    #[test]
    fn no_difference_at_all_still_has_a_level() {
        let (_, reference, _) = example();
        let level = value(echo_level_db(&reference, &reference));
        assert!((level + 313.07).abs() < 0.01);
    }

    #[test]
    fn residual_takes_each_receivers_own_onset() {
        let (method, reference, _) = example();
        let own = |t: f64| Onset::Each(BTreeMap::from([("A1".to_owned(), t)]));
        assert!((value(residual(&method, &reference, -2.0, &own(2.0))) - 0.25).abs() < 1e-15);
        assert_eq!(value(residual(&method, &reference, 2.0, &own(2.5))), 0.0);
        let nobody = Onset::Each(BTreeMap::new());
        assert!(matches!(
            residual(&method, &reference, 2.0, &nobody),
            Err(NormError::NoOnset { .. })
        ));
    }

    #[test]
    fn an_onset_after_the_end_is_refused() {
        let (method, reference, standard) = example();
        let late = Onset::Same(3.5);
        assert!(matches!(
            echo_ratio(&method, &reference, &standard, &late),
            Err(NormError::EmptyWindow { .. })
        ));
        assert!(residual(&method, &reference, 1.0, &Onset::Same(f64::NAN)).is_err());
    }

    #[test]
    fn a_silent_standard_is_refused() {
        let (method, reference, _) = example();
        let silent = traces([0.0, 1.0, 0.0, 0.0], [0.0; 4]);
        assert!(matches!(
            echo_ratio(&method, &reference, &silent, &ONSET),
            Err(NormError::ZeroDenominator { .. })
        ));
        assert!(rel_l2(&method, &traces([0.0; 4], [0.0; 4])).is_err());
        assert!(residual(&method, &reference, 0.0, &ONSET).is_err());
    }

    #[test]
    fn reshaped_references_are_refused() {
        let (method, reference, standard) = example();
        let scalar = Trace {
            name: "A1".to_owned(),
            components: vec![vec![0.0; 4]],
        };
        let scalar = Traces::new(vec![0.0, 1.0, 2.0, 3.0], vec![scalar]).expect("valid");
        assert!(matches!(
            rel_l2(&method, &scalar),
            Err(NormError::Shape { .. })
        ));
        assert!(echo_ratio(&method, &reference, &scalar, &ONSET).is_err());
        assert!(amplitude_ratio(&scalar, &standard, &ONSET).is_err());
    }
}
