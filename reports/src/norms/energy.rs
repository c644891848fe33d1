//! What energy stays in the target, and whether it grows.

use super::fit::{Line, Slope};
use super::{NormError, Window, check_finite, check_length, check_times};
use anechoic_solver::record::SeriesTable;

/// Windows that the run is cut into for the growth rate.
const WINDOWS: usize = 20;
/// Windows of the second half, which the growth rate is fitted to.
const FITTED: usize = WINDOWS / 2;
/// Neighbouring windows that are drawn together, because their deviations hang together.
const BLOCK: usize = 2;
/// Resamplings behind the interval.
const RESAMPLES: usize = 2000;

/// Kinetic plus strain energy of the target (J, per metre of thickness in 2D) at the table's times.
pub fn target_energy(table: &SeriesTable) -> Result<Vec<f64>, NormError> {
    let column = |name: &str| {
        table.column(name).ok_or_else(|| NormError::MissingColumn {
            column: name.to_owned(),
        })
    };
    let (kinetic, strain) = (column("kinetic")?, column("strain")?);
    check_length("kinetic", table.times.len(), kinetic.len())?;
    check_length("strain", table.times.len(), strain.len())?;
    Ok(kinetic.iter().zip(strain).map(|(k, s)| k + s).collect())
}

/// Largest energy from `t1` (s) on over the largest of the whole run.
pub fn energy_left(times: &[f64], energy: &[f64], t1: f64) -> Result<f64, NormError> {
    let late = Window {
        from: t1,
        to: f64::INFINITY,
    }
    .samples(times, energy)?;
    let max = |values: &[f64]| values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let whole = max(energy);
    if whole <= 0.0 {
        return Err(NormError::ZeroDenominator {
            what: "the largest energy of the run".to_owned(),
        });
    }
    Ok(max(&energy[late]) / whole)
}

/// Growth rate of the energy (1/s): slope of the logarithm of the maxima of windows of one
/// twentieth of the run, over its second half.
///
/// The 95 % interval comes from a block bootstrap of the residuals with a fixed seed: the same
/// input gives the same bits. A window without a sample or without positive energy is refused.
pub fn growth_rate_per_s(times: &[f64], energy: &[f64]) -> Result<Slope, NormError> {
    check_times(times)?;
    check_length("the energy", times.len(), energy.len())?;
    check_finite("the energy", energy)?;
    let (centres, logs) = log_maxima(times, energy)?;
    let line = Line::fit(&centres, &logs);
    let residuals = line.residuals(&centres, &logs);
    let mut random = SplitMix64(0x5EED);
    let mut slopes: Vec<f64> = (0..RESAMPLES)
        .map(|_| {
            let noise = draw_blocks(&residuals, &mut random);
            let resampled: Vec<f64> = centres
                .iter()
                .zip(noise)
                .map(|(x, r)| line.intercept + line.slope * x + r)
                .collect();
            Line::fit(&centres, &resampled).slope
        })
        .collect();
    slopes.sort_by(f64::total_cmp);
    let quantile = |q: f64| slopes[(q * (RESAMPLES - 1) as f64).round() as usize];
    Ok(Slope {
        value: line.slope,
        interval: Some([quantile(0.025), quantile(0.975)]),
    })
}

/// Centres (s) and logarithms of the maxima of the windows of the second half.
fn log_maxima(times: &[f64], energy: &[f64]) -> Result<(Vec<f64>, Vec<f64>), NormError> {
    let (start, end) = (times[0], times[times.len() - 1]);
    let width = (end - start) / WINDOWS as f64;
    let (mut centres, mut logs) = (Vec::new(), Vec::new());
    for window in WINDOWS - FITTED..WINDOWS {
        let from = start + window as f64 * width;
        let to = if window + 1 == WINDOWS {
            end
        } else {
            from + width
        };
        let range = Window { from, to }.samples(times, energy)?;
        let max = energy[range]
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        if max <= 0.0 {
            return Err(NormError::NotPositive {
                what: format!("the largest energy of {from} s .. {to} s"),
                value: max,
            });
        }
        centres.push(from + 0.5 * width);
        logs.push(max.ln());
    }
    Ok((centres, logs))
}

/// As many residuals as given, drawn as blocks of neighbours with replacement.
fn draw_blocks(residuals: &[f64], random: &mut SplitMix64) -> Vec<f64> {
    let starts = residuals.len() - BLOCK + 1;
    let mut drawn = Vec::with_capacity(residuals.len() + BLOCK);
    while drawn.len() < residuals.len() {
        let start = random.below(starts);
        drawn.extend_from_slice(&residuals[start..start + BLOCK]);
    }
    drawn.truncate(residuals.len());
    drawn
}

/// SplitMix64 (Steele, Lea, Flood 2014, OOPSLA): the smallest generator that serves a bootstrap.
struct SplitMix64(u64);

impl SplitMix64 {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// A number below `bound`; the bias of the remainder is below 1e-17 for the bounds used here.
    fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times() -> Vec<f64> {
        (0..=2000).map(|i| f64::from(i) * 0.005).collect()
    }

    #[test]
    fn energy_left_is_the_late_share() {
        let times = [0.0, 1.0, 2.0, 3.0];
        assert_eq!(energy_left(&times, &[0.0, 8.0, 2.0, 1.0], 1.5), Ok(0.25));
        assert!(energy_left(&times, &[0.0; 4], 1.5).is_err());
        assert!(energy_left(&times, &[0.0, 8.0, 2.0, 1.0], 4.0).is_err());
        assert!(energy_left(&times, &[0.0, f64::NAN, 2.0, 1.0], 1.5).is_err());
    }

    #[test]
    fn an_exponential_has_its_own_rate() {
        let energy: Vec<f64> = times().iter().map(|t| (0.37 * t).exp()).collect();
        let growth = growth_rate_per_s(&times(), &energy).expect("defined");
        assert!((growth.value - 0.37).abs() < 1e-9);
        let [low, high] = growth.interval.expect("always given");
        assert!(high - low < 1e-9);
    }

    #[test]
    fn the_interval_of_a_beating_decay_holds_its_rate() {
        let energy: Vec<f64> = times()
            .iter()
            .map(|t| (-0.2 * t).exp() * (1.5 + (7.3 * t).sin() * (0.61 * t).cos()))
            .collect();
        let growth = growth_rate_per_s(&times(), &energy).expect("defined");
        let [low, high] = growth.interval.expect("always given");
        assert!(low < growth.value && growth.value < high);
        assert!(low < -0.2 && -0.2 < high && high < 0.0);
        assert_eq!(growth_rate_per_s(&times(), &energy), Ok(growth));
    }

    #[test]
    fn a_run_without_energy_or_samples_is_refused() {
        assert!(matches!(
            growth_rate_per_s(&times(), &vec![0.0; 2001]),
            Err(NormError::NotPositive { .. })
        ));
        assert!(matches!(
            growth_rate_per_s(&[0.0, 1.0, 2.0], &[1.0; 3]),
            Err(NormError::EmptyWindow { .. })
        ));
    }

    #[test]
    fn the_generator_is_the_published_one() {
        // First outputs for the seed 1234567, from the reference implementation.
        let mut random = SplitMix64(1_234_567);
        assert_eq!(random.next(), 6_457_827_717_110_365_317);
        assert_eq!(random.next(), 3_203_168_211_198_807_973);
    }
}
