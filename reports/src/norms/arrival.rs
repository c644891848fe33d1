//! Windows in time, and arrival differences by cross-correlation.

use super::{NormError, check_finite, check_length, check_times};
use std::ops::Range;

/// A closed interval of time (s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Window {
    /// Start.
    pub from: f64,
    /// End.
    pub to: f64,
}

impl Window {
    /// The whole record.
    pub const ALL: Window = Window {
        from: f64::NEG_INFINITY,
        to: f64::INFINITY,
    };

    /// Indices of the samples inside, after a check of the series; at least one.
    pub(super) fn samples(self, times: &[f64], values: &[f64]) -> Result<Range<usize>, NormError> {
        check_times(times)?;
        check_length("the series", times.len(), values.len())?;
        check_finite("the series", values)?;
        let range =
            times.partition_point(|t| *t < self.from)..times.partition_point(|t| *t <= self.to);
        if range.is_empty() {
            return Err(NormError::EmptyWindow {
                from: self.from,
                to: self.to,
                start: times[0],
                end: times[times.len() - 1],
            });
        }
        Ok(range)
    }
}

/// By how many seconds `values` come after `reference`, from the cross-correlation.
///
/// `window` cuts a pulse out of the reference, which is then shifted by up to `max_lag_s` either
/// way; before the record the signal is taken to be at rest, and the window must end `max_lag_s`
/// before the record does. The maximum of the normalised correlation is refined by a parabola
/// through its neighbours. Times must be uniform.
pub fn arrival_lag(
    times: &[f64],
    values: &[f64],
    reference: &[f64],
    window: Window,
    max_lag_s: f64,
) -> Result<f64, NormError> {
    let range = window.samples(times, reference)?;
    check_length("the series", times.len(), values.len())?;
    check_finite("the series", values)?;
    let step = uniform_step(times)?;
    let reach = (max_lag_s / step).floor() as i64;
    let last = times.len() as i64 - 1;
    if reach < 1 || range.end as i64 - 1 + reach > last {
        return Err(NormError::EmptyWindow {
            from: window.from - max_lag_s,
            to: times[range.end - 1] + max_lag_s,
            start: times[0],
            end: times[times.len() - 1],
        });
    }
    let correlations = (-reach..=reach)
        .map(|lag| correlation(values, reference, range.clone(), lag))
        .collect::<Vec<f64>>();
    let best = index_of_max(&correlations);
    if correlations[best] <= 0.0 {
        return Err(NormError::ZeroDenominator {
            what: "the correlation in the window".to_owned(),
        });
    }
    let lag = best as i64 - reach;
    if lag.abs() == reach {
        return Err(NormError::LagAtEdge {
            lag_s: lag as f64 * step,
        });
    }
    let (before, at, after) = (
        correlations[best - 1],
        correlations[best],
        correlations[best + 1],
    );
    let curvature = before - 2.0 * at + after;
    let shift = if curvature < 0.0 {
        0.5 * (before - after) / curvature
    } else {
        0.0
    };
    Ok((lag as f64 + shift) * step)
}

/// The step (s) of uniform times.
pub(super) fn uniform_step(times: &[f64]) -> Result<f64, NormError> {
    if times.len() < 3 {
        return Err(NormError::TooFew {
            what: "a uniform series",
            needed: 3,
            found: times.len(),
        });
    }
    let step = (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64;
    let off = |(i, t): (usize, &f64)| (t - times[0] - i as f64 * step).abs() > 1e-6 * step;
    match times.iter().enumerate().position(off) {
        None => Ok(step),
        Some(index) => Err(NormError::NotUniform { index }),
    }
}

/// Cosine between the reference in `range` and the signal `lag` samples later.
fn correlation(values: &[f64], reference: &[f64], range: Range<usize>, lag: i64) -> f64 {
    let (mut cross, mut own, mut other) = (0.0, 0.0, 0.0);
    for i in range {
        let shifted = usize::try_from(i as i64 + lag).map_or(0.0, |j| values[j]);
        cross += reference[i] * shifted;
        own += reference[i] * reference[i];
        other += shifted * shifted;
    }
    let scale = (own * other).sqrt();
    if scale > 0.0 { cross / scale } else { 0.0 }
}

fn index_of_max(values: &[f64]) -> usize {
    let mut best = 0;
    for (i, v) in values.iter().enumerate() {
        if *v > values[best] {
            best = i;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pulse(t: f64, centre: f64) -> f64 {
        (-((t - centre) / 0.1).powi(2)).exp()
    }

    fn sampled(centre: f64, amplitude: f64) -> Vec<f64> {
        times()
            .iter()
            .map(|t| amplitude * pulse(*t, centre))
            .collect()
    }

    fn times() -> Vec<f64> {
        (0..=300).map(|i| f64::from(i) * 0.01).collect()
    }

    const WINDOW: Window = Window { from: 0.5, to: 1.5 };

    #[test]
    fn a_shift_below_a_sample_is_found_whatever_the_amplitude() {
        let lag = arrival_lag(
            &times(),
            &sampled(1.0337, 0.3),
            &sampled(1.0, 1.0),
            WINDOW,
            0.3,
        );
        assert!((lag.expect("found") - 0.0337).abs() < 2e-4);
        let early = arrival_lag(
            &times(),
            &sampled(0.951, 2.0),
            &sampled(1.0, 1.0),
            WINDOW,
            0.3,
        );
        assert!((early.expect("found") + 0.049).abs() < 2e-4);
    }

    #[test]
    fn a_pulse_beyond_the_range_is_refused() {
        let far = arrival_lag(
            &times(),
            &sampled(1.5, 1.0),
            &sampled(1.0, 1.0),
            WINDOW,
            0.1,
        );
        assert!(matches!(far, Err(NormError::LagAtEdge { .. })));
    }

    #[test]
    fn silence_and_short_records_are_refused() {
        let silent = vec![0.0; 301];
        assert!(arrival_lag(&times(), &silent, &sampled(1.0, 1.0), WINDOW, 0.3).is_err());
        let late = Window { from: 1.0, to: 2.9 };
        let cut = arrival_lag(&times(), &sampled(2.0, 1.0), &sampled(2.0, 1.0), late, 0.3);
        assert!(matches!(cut, Err(NormError::EmptyWindow { .. })));
        let mut uneven = times();
        uneven[7] += 0.004;
        let off = arrival_lag(&uneven, &sampled(1.0, 1.0), &sampled(1.0, 1.0), WINDOW, 0.3);
        assert_eq!(off, Err(NormError::NotUniform { index: 7 }));
    }

    #[test]
    fn a_window_without_samples_is_refused() {
        let nowhere = Window { from: 5.0, to: 6.0 };
        assert!(nowhere.samples(&[0.0, 1.0], &[0.0, 1.0]).is_err());
        assert_eq!(Window::ALL.samples(&[0.0, 1.0], &[0.0, 1.0]), Ok(0..2));
    }
}
