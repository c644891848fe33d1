//! Extremes in a window, and the relative difference to the standard run.

use super::{NormError, Traces, Window, max_abs};

/// Deviation of the highest and of the lowest value in `window` from those of the reference, the
/// larger of the two, over the largest absolute value of the reference.
///
/// Both ends count, since a pulse and its echo can be equally large with opposite signs.
pub fn peak_deviation(
    times: &[f64],
    values: &[f64],
    reference: &[f64],
    window: Window,
) -> Result<f64, NormError> {
    let (low, high) = extremes(times, values, window)?;
    let (true_low, true_high) = extremes(times, reference, window)?;
    let size = true_low.abs().max(true_high.abs());
    if size == 0.0 {
        return Err(zero("the peak of the reference"));
    }
    Ok((low - true_low).abs().max((high - true_high).abs()) / size)
}

/// Lowest and highest value in `window`.
fn extremes(times: &[f64], values: &[f64], window: Window) -> Result<(f64, f64), NormError> {
    let range = window.samples(times, values)?;
    let fold =
        |best: fn(f64, f64) -> f64, start| values[range.clone()].iter().copied().fold(start, best);
    Ok((
        fold(f64::min, f64::INFINITY),
        fold(f64::max, f64::NEG_INFINITY),
    ))
}

/// Relative difference (K25 Eq 44): (standard - method) / standard.
pub fn rd(standard: f64, method: f64) -> Result<f64, NormError> {
    super::check_finite("the pair of rd", &[standard, method])?;
    if standard == 0.0 {
        return Err(zero("the value of the standard run"));
    }
    Ok((standard - method) / standard)
}

/// [`rd`] of the largest magnitude over the whole run at `receiver`.
pub fn rd_of_maximum(standard: &Traces, method: &Traces, receiver: &str) -> Result<f64, NormError> {
    let (mine, theirs) = magnitudes(standard, method, receiver)?;
    rd(max_abs(&theirs), max_abs(&mine))
}

/// [`rd`] of the magnitudes at `receiver` at the time `time_s`, linear between samples.
pub fn rd_at(
    standard: &Traces,
    method: &Traces,
    receiver: &str,
    time_s: f64,
) -> Result<f64, NormError> {
    let (mine, theirs) = magnitudes(standard, method, receiver)?;
    let times = method.times();
    rd(
        interpolate(times, &theirs, time_s)?,
        interpolate(times, &mine, time_s)?,
    )
}

fn magnitudes(
    standard: &Traces,
    method: &Traces,
    receiver: &str,
) -> Result<(Vec<f64>, Vec<f64>), NormError> {
    method
        .pair(standard, "the standard run")?
        .into_iter()
        .find(|(mine, _)| mine.name == receiver)
        .map(|(mine, theirs)| (mine.magnitude(), theirs.magnitude()))
        .ok_or_else(|| NormError::MissingReceiver {
            receiver: receiver.to_owned(),
            from: "the method's record",
        })
}

fn interpolate(times: &[f64], values: &[f64], time_s: f64) -> Result<f64, NormError> {
    let (start, end) = (times[0], times[times.len() - 1]);
    if !(start..=end).contains(&time_s) {
        return Err(NormError::EmptyWindow {
            from: time_s,
            to: time_s,
            start,
            end,
        });
    }
    let after = times.partition_point(|t| *t < time_s);
    if times[after] == time_s {
        return Ok(values[after]);
    }
    let share = (time_s - times[after - 1]) / (times[after] - times[after - 1]);
    Ok(values[after - 1] + share * (values[after] - values[after - 1]))
}

fn zero(what: &str) -> NormError {
    NormError::ZeroDenominator {
        what: what.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::super::Trace;
    use super::*;

    const TIMES: [f64; 5] = [0.0, 1.0, 2.0, 3.0, 4.0];

    fn traces(values: [f64; 5]) -> Traces {
        let trace = Trace {
            name: "toe".to_owned(),
            components: vec![values.to_vec()],
        };
        Traces::new(TIMES.to_vec(), vec![trace]).expect("valid")
    }

    #[test]
    fn both_extremes_of_the_window_count() {
        let values = [9.0, 1.0, -3.0, 3.0, 0.0];
        let window = Window { from: 1.0, to: 4.0 };
        let against = |reference: [f64; 5]| peak_deviation(&TIMES, &values, &reference, window);
        assert_eq!(against([0.0, 0.0, -4.0, 3.0, 0.0]), Ok(0.25));
        assert_eq!(against([0.0, 0.0, -4.0, 0.0, 0.0]), Ok(0.75));
        assert!(against([0.0; 5]).is_err());
    }

    #[test]
    fn a_pulse_and_its_reversed_echo_of_the_same_size_do_not_confuse() {
        let window = Window { from: 0.0, to: 4.0 };
        let reference = [0.0, 1.0, 0.0, -1.0, 0.0];
        let close = peak_deviation(&TIMES, &[0.0, 0.98, 0.0, -0.99, 0.0], &reference, window);
        assert!((close.expect("defined") - 0.02).abs() < 1e-12);
        let reversed = peak_deviation(&TIMES, &[0.0, -1.0, 0.0, 0.0, 0.0], &reference, window);
        assert_eq!(reversed, Ok(1.0));
    }

    #[test]
    fn rd_is_signed_and_relative_to_the_standard() {
        assert_eq!(rd(4.0, 1.0), Ok(0.75));
        assert_eq!(rd(-4.0, -5.0), Ok(-0.25));
        assert!(rd(0.0, 1.0).is_err());
        assert!(rd(1.0, f64::NAN).is_err());
        let standard = traces([0.0, 2.0, 4.0, 8.0, 0.0]);
        let method = traces([0.0, 1.0, 2.0, 2.0, 0.0]);
        assert_eq!(rd_of_maximum(&standard, &method, "toe"), Ok(0.75));
        // At 2.5 s: standard 6, method 2.
        let at = rd_at(&standard, &method, "toe", 2.5).expect("inside the run");
        assert!((at - 2.0 / 3.0).abs() < 1e-15);
        assert!(rd_at(&standard, &method, "toe", 4.5).is_err());
        assert!(rd_at(&standard, &method, "crest", 1.0).is_err());
    }
}
