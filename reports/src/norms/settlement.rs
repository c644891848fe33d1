//! What a method gets wrong of what stays: the settlement under a force that stays on, and the drift that
//! a net impulse leaves.
//!
//! Both look at the last tenth of the run, when waves have passed, and take the mean distance to the
//! reference there. A settlement error is relative to the reference's own mean magnitude there; a drift
//! dies out (in two dimensions like 1/t), so its error is relative to the reference's largest magnitude.

use super::echo::ratio;
use super::{NormError, Score, Trace, Traces, max_abs};

/// Share of the run that counts as its end.
const END: f64 = 0.1;

/// Mean distance to the reference over the last tenth of the run, over the reference's mean magnitude
/// there.
///
/// # Errors
/// Those of pairs of series; a reference that is at rest there.
pub fn settlement_error(method: &Traces, reference: &Traces) -> Result<Vec<Score>, NormError> {
    at_the_end(method, reference, |truth, end| mean(&truth[end..]))
}

/// Mean distance to the reference over the last tenth of the run, over the reference's largest
/// magnitude.
///
/// # Errors
/// Those of pairs of series; a reference that never moves.
pub fn drift_error(method: &Traces, reference: &Traces) -> Result<Vec<Score>, NormError> {
    at_the_end(method, reference, |truth, _| max_abs(truth))
}

/// Mean distance at the end over a scale of the reference's magnitude, given with the end's first sample.
fn at_the_end(
    method: &Traces,
    reference: &Traces,
    scale: impl Fn(&[f64], usize) -> f64,
) -> Result<Vec<Score>, NormError> {
    let times = method.times();
    let (start, last) = (times[0], times[times.len() - 1]);
    let from = last - END * (last - start);
    let end = times.partition_point(|t| *t < from);
    let score = |(mine, truth): (&Trace, &Trace)| {
        let error = mean(&mine.distance(truth)[end..]);
        ratio(mine, error, scale(&truth.magnitude(), end), "the reference")
    };
    let pairs = method.pair(reference, "the reference")?;
    pairs.into_iter().map(score).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One receiver at 0, 1, ..., 20 s.
    fn traces(u: impl Fn(usize) -> [f64; 2]) -> Traces {
        let samples: Vec<[f64; 2]> = (0..=20).map(u).collect();
        let trace = Trace {
            name: "A1".to_owned(),
            components: (0..2)
                .map(|i| samples.iter().map(|u| u[i]).collect())
                .collect(),
        };
        Traces::new((0..=20).map(f64::from).collect(), vec![trace]).unwrap()
    }

    fn value(scores: Result<Vec<Score>, NormError>) -> f64 {
        let scores = scores.unwrap();
        assert_eq!((scores.len(), scores[0].place.as_str()), (1, "A1"));
        scores[0].value
    }

    #[test]
    fn only_the_last_tenth_counts() {
        // a peak of 10 m at 5 s; in the end 4 m against distances of 0.3, 0.5, 0.4 m from 18 s on
        let truth = traces(|t| if t == 5 { [10.0, 0.0] } else { [0.0, 4.0] });
        let run = traces(|t| match t {
            18 => [0.3, 4.0],
            19 => [0.3, 4.4],
            20 => [0.0, 4.4],
            _ => [7.0, -7.0],
        });
        assert!((value(settlement_error(&run, &truth)) - 0.1).abs() < 1e-12);
        assert!((value(drift_error(&run, &truth)) - 0.04).abs() < 1e-12);
        assert_eq!(value(settlement_error(&truth, &truth)), 0.0);
    }

    #[test]
    fn what_swings_about_the_truth_is_not_right() {
        let truth = traces(|_| [0.0, 4.0]);
        let run = traces(|t| [0.0, if t % 2 == 0 { 3.0 } else { 5.0 }]);
        assert!((value(settlement_error(&run, &truth)) - 0.25).abs() < 1e-12);
    }

    #[test]
    fn a_reference_at_rest_has_no_settlement() {
        let truth = traces(|t| [if t == 5 { 1.0 } else { 0.0 }, 0.0]);
        let settled = settlement_error(&truth, &truth);
        assert!(matches!(settled, Err(NormError::ZeroDenominator { .. })));
        assert_eq!(value(drift_error(&truth, &truth)), 0.0);
    }
}
