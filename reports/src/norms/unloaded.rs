//! Does the energy of a run grow though nothing drives it any more?

use super::energy::growth_rate_per_s;
use super::fit::Slope;
use super::{NormError, Window};

/// Energies grow by less than this (1/s) through rounding and the solver's tolerance.
pub const ROUNDING_GROWTH: f64 = 1e-6;

/// The energy has to double over the second half of a run to be far above what it was: less is told by
/// its rate alone, and does not spoil series that are smaller than their echo.
const DOUBLED: f64 = 2.0;

/// Four times the energy is twice the amplitude. Nothing that only takes energy away leaves more than the
/// load brought; what energy as recorded has no part in (a layer's stretched masses, its memory) is
/// worth less than this factor in every stable layer that was measured.
const RUNS_AWAY: f64 = 4.0;

/// Share of a run at its end whose largest energy is the last one.
const LAST: f64 = 0.05;

/// What the energy does after the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unloaded {
    /// Growth rate of the second half (1/s), where the load is over by then.
    pub rate: Option<Slope>,
    /// Largest energy of the last twentieth of the run over the largest until the first sample without load.
    pub over_loaded: f64,
    /// The same over the largest of the twentieth before the middle of the run.
    pub over_middle: f64,
}

impl Unloaded {
    /// Of a run whose load ends at `load_end` (s).
    ///
    /// # Errors
    /// [`NormError::EmptyWindow`] when the load lasts into the last twentieth of the run, or energies
    /// are not finite.
    pub fn of(times: &[f64], energy: &[f64], load_end: f64) -> Result<Self, NormError> {
        let (start, end) = match (times.first(), times.last()) {
            (Some(start), Some(end)) => (*start, *end),
            _ => (0.0, 0.0),
        };
        let width = LAST * (end - start);
        let middle = 0.5 * (start + end);
        let largest = |from: f64, to: f64| {
            let range = Window { from, to }.samples(times, energy)?;
            let values = energy[range].iter().copied();
            Ok::<f64, NormError>(values.fold(f64::NEG_INFINITY, f64::max))
        };
        // a long run is sampled so rarely that all of the load may lie between two samples
        let loaded = times.iter().copied().find(|t| *t >= load_end);
        // empty where the load is not over
        let last = largest((end - width).max(load_end), end)?;
        Ok(Unloaded {
            rate: if load_end <= middle {
                Some(growth_rate_per_s(times, energy)?)
            } else {
                None
            },
            over_loaded: last / largest(f64::NEG_INFINITY, loaded.unwrap_or(end))?,
            over_middle: last / largest(middle - width, middle)?,
        })
    }

    /// Does the energy grow, beyond its interval and rounding, to far above what it was?
    pub fn grows(&self) -> bool {
        let sure = |slope: Slope| slope.interval.is_some_and(|[low, _]| low > ROUNDING_GROWTH);
        self.rate.is_some_and(sure) && self.over_middle > DOUBLED
    }

    /// Does it end far above what the load brought?
    pub fn runs_away(&self) -> bool {
        self.over_loaded > RUNS_AWAY
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Energy loaded linearly in the first second, then `after(t - 1)` times as much.
    fn run(end: f64, after: impl Fn(f64) -> f64) -> Unloaded {
        let times: Vec<f64> = (0..=2000).map(|i| f64::from(i) * end / 2000.0).collect();
        let energy: Vec<f64> = times
            .iter()
            .map(|t| if *t < 1.0 { *t } else { after(t - 1.0) })
            .collect();
        Unloaded::of(&times, &energy, 1.0).expect("defined")
    }

    #[test]
    fn decay_rest_and_a_slow_growth_are_quiet() {
        for after in [|t: f64| (-t).exp(), |_| 1.0, |t: f64| (0.02 * t).exp()] {
            let unloaded = run(10.0, after);
            assert!(!unloaded.grows() && !unloaded.runs_away(), "{unloaded:?}");
        }
    }

    #[test]
    fn a_growth_is_told_before_it_runs_away() {
        // falls to a thousandth, then grows out of the noise
        let unloaded = run(10.0, |t| (-4.0 * t).exp() + 1e-6 * t.exp());
        assert!(unloaded.grows() && !unloaded.runs_away(), "{unloaded:?}");
        let unloaded = run(10.0, |t| (7.0 * t).exp());
        assert!(unloaded.grows() && unloaded.runs_away());
        assert!((unloaded.rate.expect("the load is over").value - 7.0).abs() < 1e-6);
    }

    #[test]
    fn a_load_between_two_samples_has_brought_its_energy() {
        let times: Vec<f64> = (0..=200).map(|i| 5.0 * f64::from(i)).collect();
        let run = |after: fn(f64) -> f64| {
            let energy: Vec<f64> = times.iter().map(|t| t.min(1.0) * after(*t)).collect();
            Unloaded::of(&times, &energy, 1.0).expect("defined")
        };
        for after in [|_| 3.0, |t: f64| (-0.002 * t).exp()] {
            let unloaded = run(after);
            assert!(!unloaded.grows() && !unloaded.runs_away(), "{unloaded:?}");
        }
        assert!(run(|t| (0.01 * t).exp()).runs_away());
    }

    #[test]
    fn what_the_load_brings_in_is_no_growth() {
        let times: Vec<f64> = (0..=200).map(|i| f64::from(i) * 0.01).collect();
        assert!(Unloaded::of(&times, &times, 3.0).is_err());
        // over after the middle: no rate, but an end
        let late = Unloaded::of(&times, &times, 1.5).expect("defined");
        assert!(late.rate.is_none() && !late.grows() && !late.runs_away());
    }
}
