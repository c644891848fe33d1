//! Arrivals of separate pulses: when they come, by cross-correlation, and how high they are.

use anechoic_reference::claim::Evidence;
use anechoic_reports::judge::Measurement;
use anechoic_reports::norms::{NormError, Traces, Window, arrival_lag};
use anechoic_solver::geometry::fitted_cell;
use anechoic_solver::problem::{Drive, Problem};
use std::ops::Range;

/// Below this share of its peak the reference counts as silent.
const SILENT: f64 = 1e-6;

/// Peaks below this share of the highest are no arrivals of their own.
const RIPPLE: f64 = 0.1;

/// Lags are looked for up to this share of a pulse's duration.
const REACH: f64 = 0.2;

/// When the prescribed motion of a receiver on a driven side ends (s); `None` elsewhere. Until then
/// the receiver shows what was put in, which no solver can get wrong.
pub fn prescribed_until<const D: usize>(problem: &Problem<D>, receiver: &str) -> Option<f64> {
    let mut places = problem.probes.receivers.iter();
    let place = places.find(|r| r.name == receiver)?.place;
    let cell = fitted_cell(&problem.target, problem.edges());
    let until = problem.drives.iter().filter_map(|drive| {
        let Drive::SideVelocity { side, pulse } = drive else {
            return None;
        };
        let edge = if side.upper {
            problem.target.upper[side.axis]
        } else {
            problem.target.lower[side.axis]
        };
        let near = (place[side.axis] - edge).abs() < 0.5 * cell[side.axis];
        near.then(|| pulse.end())
    });
    until.reduce(f64::max)
}

/// The worst lag and the worst relative deviation of a peak over the arrivals of each receiver.
pub fn measure(
    method: &str,
    against: Option<(Evidence, &str)>,
    run: &Traces,
    truth: &Traces,
    prescribed_until: &dyn Fn(&str) -> Option<f64>,
) -> Vec<Measurement> {
    let mut numbers = Vec::new();
    for (mine, true_trace) in run.receivers().iter().zip(truth.receivers()) {
        // The strongest component carries the pulses.
        let Some(axis) = (0..true_trace.components.len()).max_by(|&a, &b| {
            peak(&true_trace.components[a]).total_cmp(&peak(&true_trace.components[b]))
        }) else {
            continue;
        };
        let (values, reference) = (&mine.components[axis], &true_trace.components[axis]);
        let times = run.times();
        let mut arrivals = arrivals(times, reference);
        if let Some(until) = prescribed_until(&mine.name) {
            arrivals.retain(|window| window.from >= until);
        }
        let worst = |measure: &dyn Fn(&Window) -> Result<f64, NormError>| -> Result<f64, String> {
            let mut worst = None;
            for window in &arrivals {
                let value = measure(window).map_err(|error| error.to_string())?.abs();
                worst = Some(worst.map_or(value, |w: f64| w.max(value)));
            }
            worst.ok_or_else(|| "no pulse arrives in full before the end of the run".into())
        };
        let lag = worst(&|window| {
            let reach = REACH * (window.to - window.from);
            arrival_lag(times, values, reference, *window, reach)
        });
        let height = worst(&|window| {
            let deviations = lobes(times, reference, window)
                .into_iter()
                .filter(|lobe| peak(&reference[lobe.clone()]) > RIPPLE * peak(reference))
                .map(|lobe| peak_deviation(&values[lobe.clone()], &reference[lobe]));
            Ok(deviations.fold(0.0, f64::max))
        });
        for (metric, unit, value) in [("arrival_s", "s", lag), ("peak_deviation", "1", height)] {
            numbers.push(Measurement {
                method: method.to_owned(),
                metric: metric.to_owned(),
                place: mine.name.clone(),
                value,
                unit: unit.to_owned(),
                against: against.map(|(kind, name)| (kind, name.to_owned())),
            });
        }
    }
    numbers
}

/// Samples of a window in which the reference keeps its sign: a pulse and its echo may overlap, and
/// each has a peak of its own.
fn lobes(times: &[f64], reference: &[f64], window: &Window) -> Vec<Range<usize>> {
    let mut lobes: Vec<Range<usize>> = Vec::new();
    for (i, time) in times.iter().enumerate() {
        if *time < window.from || *time > window.to {
            continue;
        }
        let same_sign = |lobe: &Range<usize>| (reference[lobe.start] > 0.0) == (reference[i] > 0.0);
        match lobes.last_mut() {
            Some(lobe) if same_sign(lobe) => lobe.end = i + 1,
            _ => lobes.push(i..i + 1),
        }
    }
    lobes
}

/// Relative deviation of the peak of one lobe, in the direction of the reference.
fn peak_deviation(values: &[f64], reference: &[f64]) -> f64 {
    let direction = if reference.iter().sum::<f64>() < 0.0 {
        -1.0
    } else {
        1.0
    };
    let top = |series: &[f64]| {
        let along = series.iter().map(|v| direction * v);
        along.fold(f64::NEG_INFINITY, f64::max)
    };
    (top(values) / top(reference) - 1.0).abs()
}

/// Largest absolute value.
fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// Stretches in which the reference is not silent, and after which the record goes on long enough
/// to look for a late arrival.
fn arrivals(times: &[f64], reference: &[f64]) -> Vec<Window> {
    let threshold = SILENT * peak(reference);
    let loud: Vec<usize> = (0..times.len())
        .filter(|&i| reference[i].abs() > threshold)
        .collect();
    let mut windows: Vec<(usize, usize)> = Vec::new();
    for i in loud {
        match windows.last_mut() {
            // A zero crossing may hit a sample or two.
            Some((_, end)) if i - *end <= 3 => *end = i,
            _ => windows.push((i, i)),
        }
    }
    let last = times.last().copied().unwrap_or(0.0);
    windows
        .into_iter()
        .map(|(from, to)| Window {
            from: times[from],
            to: times[to],
        })
        .filter(|w| w.to > w.from && w.to + REACH * (w.to - w.from) < last)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use anechoic_reports::norms::Trace;
    use std::f64::consts::PI;

    /// Pulses of half a second at 0.2 s and 2 s, the second late by `lag` and `gain` times as high.
    fn traces(lag: f64, gain: f64) -> Traces {
        let times: Vec<f64> = (0..=600).map(|i| 0.005 * i as f64).collect();
        let pulse = |t: f64| {
            if (0.0..=0.5).contains(&t) {
                (2.0 * PI * t).sin()
            } else {
                0.0
            }
        };
        let values = times
            .iter()
            .map(|t| pulse(t - 0.2) + gain * pulse(t - 2.0 - lag))
            .collect();
        let silence = vec![0.0; times.len()];
        let trace = Trace {
            name: "A".into(),
            components: vec![silence, values],
        };
        Traces::new(times, vec![trace]).unwrap()
    }

    #[test]
    fn the_worst_arrival_counts() {
        let numbers = measure(
            "fixed",
            None,
            &traces(0.03, 0.9),
            &traces(0.0, 1.0),
            &|_| None,
        );
        let value = |metric: &str| {
            let number = numbers.iter().find(|n| n.metric == metric).unwrap();
            number.value.clone().unwrap()
        };
        assert!((value("arrival_s") - 0.03).abs() < 1e-3);
        assert!((value("peak_deviation") - 0.1).abs() < 1e-6);
    }

    #[test]
    fn what_was_prescribed_is_no_arrival() {
        let (run, truth) = (traces(0.0, 0.9), traces(0.0, 1.0));
        let measured = |until| {
            let numbers = measure("fixed", None, &run, &truth, &|_| Some(until));
            numbers.into_iter().map(|n| n.value).collect::<Vec<_>>()
        };
        assert!(measured(1.0).iter().all(Result::is_ok));
        let none = measured(2.8);
        assert!(none.iter().all(|v| {
            v.as_ref()
                .is_err_and(|why| why.contains("no pulse arrives"))
        }));
    }

    #[test]
    fn overlapping_pulses_of_opposite_sign_have_two_peaks() {
        let times: Vec<f64> = (0..=100).map(|i| 0.01 * i as f64).collect();
        let values: Vec<f64> = times.iter().map(|t| (2.0 * PI * t).sin()).collect();
        let window = Window { from: 0.1, to: 0.9 };
        assert_eq!(lobes(&times, &values, &window), [10..51, 51..91]);
        // The second peak alone is too low, and the first one does not hide it.
        let low: Vec<f64> = values.iter().map(|v| v.max(-0.9)).collect();
        let deviation = |lobe: Range<usize>| peak_deviation(&low[lobe.clone()], &values[lobe]);
        assert!(deviation(10..51) < 1e-12);
        assert!((deviation(51..91) - 0.1).abs() < 1e-12);
    }

    #[test]
    fn a_pulse_cut_off_by_the_end_is_no_arrival() {
        let truth = traces(0.0, 1.0);
        let times = truth.times();
        let values = &truth.receivers()[0].components[1];
        assert_eq!(arrivals(times, values).len(), 2);
        assert_eq!(arrivals(&times[..480], &values[..480]).len(), 1);
    }
}
