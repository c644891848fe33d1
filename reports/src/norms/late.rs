//! What a receiver still does late in a run, as K25 (Appendix A) draws it.

use super::{NormError, Traces};
use crate::sweep::Range;

/// Smallest, mean and largest magnitude of a receiver's displacement (m) from `from_s` (s) on.
///
/// # Errors
/// [`NormError::MissingReceiver`], [`NormError::EmptyWindow`].
pub fn late_range(traces: &Traces, receiver: &str, from_s: f64) -> Result<Range, NormError> {
    let trace = traces.receivers().iter().find(|t| t.name == receiver);
    let trace = trace.ok_or_else(|| NormError::MissingReceiver {
        receiver: receiver.to_owned(),
        from: "the record",
    })?;
    let times = traces.times();
    let magnitude = trace.magnitude();
    let late: Vec<f64> = times
        .iter()
        .zip(magnitude)
        .filter(|(t, _)| **t >= from_s)
        .map(|(_, u)| u)
        .collect();
    if late.is_empty() {
        return Err(NormError::EmptyWindow {
            from: from_s,
            to: f64::INFINITY,
            start: times.first().copied().unwrap_or(0.0),
            end: times.last().copied().unwrap_or(0.0),
        });
    }
    Ok(Range {
        min: late.iter().copied().fold(f64::INFINITY, f64::min),
        mean: late.iter().sum::<f64>() / late.len() as f64,
        max: late.iter().copied().fold(0.0, f64::max),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::norms::Trace;

    #[test]
    fn only_what_is_late_counts() {
        let trace = Trace {
            name: "A1".into(),
            components: vec![vec![30.0, 0.0, 3.0], vec![40.0, 1.0, 4.0]],
        };
        let traces = Traces::new(vec![0.0, 1.0, 2.0], vec![trace]).unwrap();
        let late = late_range(&traces, "A1", 1.0).unwrap();
        assert_eq!((late.min, late.mean, late.max), (1.0, 3.0, 5.0));
        assert!(late_range(&traces, "A2", 1.0).is_err());
        assert!(late_range(&traces, "A1", 3.0).is_err());
    }
}
