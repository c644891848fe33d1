//! Peaks in a window, and the relative difference to the standard run.

use super::{NormError, Traces, Window, max_abs};

/// The sample of largest absolute value in a window.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peak {
    /// When it occurs (s).
    pub time_s: f64,
    /// Its value with sign, in the unit of the series.
    pub value: f64,
}

/// The first sample of largest absolute value in `window`.
pub fn peak(times: &[f64], values: &[f64], window: Window) -> Result<Peak, NormError> {
    let range = window.samples(times, values)?;
    let mut best = range.start;
    for i in range {
        if values[i].abs() > values[best].abs() {
            best = i;
        }
    }
    Ok(Peak {
        time_s: times[best],
        value: values[best],
    })
}

/// Relative deviation of the peak in `window` from that of the reference, sign included:
/// abs(peak - peak_ref) / abs(peak_ref).
pub fn peak_deviation(
    times: &[f64],
    values: &[f64],
    reference: &[f64],
    window: Window,
) -> Result<f64, NormError> {
    let mine = peak(times, values, window)?.value;
    let truth = peak(times, reference, window)?.value;
    if truth == 0.0 {
        return Err(zero("the peak of the reference"));
    }
    Ok((mine - truth).abs() / truth.abs())
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
    fn peak_keeps_its_sign_and_its_window() {
        let values = [9.0, 1.0, -3.0, 3.0, 0.0];
        let window = Window { from: 1.0, to: 4.0 };
        let p = peak(&TIMES, &values, window).expect("defined");
        assert_eq!((p.time_s, p.value), (2.0, -3.0));
        let reference = [0.0, 0.0, -4.0, 0.0, 0.0];
        let deviation = peak_deviation(&TIMES, &values, &reference, window).expect("defined");
        assert_eq!(deviation, 0.25);
        assert!(peak_deviation(&TIMES, &values, &[0.0; 5], window).is_err());
    }

    #[test]
    fn a_reversed_peak_deviates_by_two() {
        let window = Window { from: 0.0, to: 4.0 };
        let deviation = peak_deviation(
            &TIMES,
            &[0.0, -1.0, 0.0, 0.0, 0.0],
            &[0.0, 1.0, 0.0, 0.0, 0.0],
            window,
        );
        assert_eq!(deviation, Ok(2.0));
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
