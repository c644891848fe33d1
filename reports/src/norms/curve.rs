//! A number along the way of a body, which is rough from step to step: means over windows of the way, and
//! where two such curves part.

use thiserror::Error;

/// Why curves cannot be compared.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum CurveError {
    /// No value where one is asked for.
    #[error("{what} holds no value; the run must reach it")]
    Empty {
        /// Which part of the curve.
        what: String,
    },
    /// Two curves of different lengths.
    #[error("{found} values beside {expected}; both runs need the same steps")]
    Shape {
        /// Needed length.
        expected: usize,
        /// Found length.
        found: usize,
    },
}

/// Mean of the values `y` whose `x`, ascending, lies within `half` of `at`.
///
/// # Errors
/// [`CurveError::Empty`] when there is none.
pub fn mean_around(x: &[f64], y: &[f64], at: f64, half: f64) -> Result<f64, CurveError> {
    let from = x.partition_point(|x| *x < at - half);
    let to = x.partition_point(|x| *x <= at + half);
    let window = y.get(from..to).unwrap_or(&[]);
    if window.is_empty() {
        return Err(CurveError::Empty {
            what: format!("the window of {half} around {at}"),
        });
    }
    Ok(window.iter().sum::<f64>() / window.len() as f64)
}

/// Relative distances of two curves over the same `x`, the second being the truth, at windows that follow
/// each other.
fn departures(
    x: &[f64],
    (own, truth): (&[f64], &[f64]),
    half: f64,
) -> Result<Vec<(f64, f64)>, CurveError> {
    for found in [own.len(), truth.len()] {
        if found != x.len() {
            let expected = x.len();
            return Err(CurveError::Shape { expected, found });
        }
    }
    let last = x.last().copied().unwrap_or(0.0);
    let windows = (last / half - 1.0).floor().max(0.0) as usize;
    let mut out = Vec::with_capacity(windows);
    for k in 1..=windows {
        let at = k as f64 * half;
        let truth = mean_around(x, truth, at, half)?;
        let own = mean_around(x, own, at, half)?;
        out.push((at, (own - truth).abs() / truth.abs()));
    }
    Ok(out)
}

/// Largest relative distance from `from` on.
///
/// # Errors
/// [`CurveError::Empty`] when a window holds no value, or none lies behind `from`.
pub fn largest_departure(
    x: &[f64],
    curves: (&[f64], &[f64]),
    from: f64,
    half: f64,
) -> Result<f64, CurveError> {
    let all = departures(x, curves, half)?;
    let late = all
        .iter()
        .filter(|(at, _)| *at >= from - 1e-12)
        .map(|d| d.1);
    late.reduce(f64::max).ok_or_else(|| CurveError::Empty {
        what: format!("the curve from {from} on"),
    })
}

/// The first `x` at which the relative distance is more than `share`, if it ever is.
///
/// # Errors
/// As for [`largest_departure`].
pub fn first_departure(
    x: &[f64],
    curves: (&[f64], &[f64]),
    half: f64,
    share: f64,
) -> Result<Option<f64>, CurveError> {
    let all = departures(x, curves, half)?;
    Ok(all.iter().find(|(_, d)| *d > share).map(|(at, _)| *at))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp() -> Vec<f64> {
        (0..=1000).map(|k| k as f64 / 1000.0).collect()
    }

    #[test]
    fn means_are_those_of_the_window() {
        let x = ramp();
        let y: Vec<f64> = x.iter().map(|x| 2.0 * x + 1.0).collect();
        assert!((mean_around(&x, &y, 0.5, 0.1).unwrap() - 2.0).abs() < 1e-12);
        assert!(mean_around(&x, &y, 2.0, 0.1).is_err());
    }

    #[test]
    fn a_step_is_found_where_it_is() {
        let x = ramp();
        let truth = vec![2.0; x.len()];
        let own: Vec<f64> = x.iter().map(|x| if *x > 0.4 { 2.5 } else { 2.0 }).collect();
        let first = first_departure(&x, (&own, &truth), 0.01, 0.2)
            .unwrap()
            .unwrap();
        assert!((first - 0.4).abs() < 0.021, "{first}");
        let largest = largest_departure(&x, (&own, &truth), 0.1, 0.01).unwrap();
        assert!((largest - 0.25).abs() < 1e-12, "{largest}");
        assert_eq!(
            largest_departure(&x, (&truth, &truth), 0.1, 0.01).unwrap(),
            0.0
        );
    }
}
