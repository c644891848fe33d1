//! Pulses in time.

use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// Shape of a pulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Wavelet {
    /// One full sine, sin(2 pi f t) on 0..1/f: no net impulse.
    Sine,
    /// Half a sine, sin(2 pi f t) on 0..1/(2f): a net impulse.
    HalfSine,
    /// sin^2(2 pi f t) on 0..1/(2f): as the half sine, without its kinks.
    SineSquared,
    /// Ricker, (1 - 2 a) exp(-a) with a = (pi f (t - t0))^2; starts at once, lasts until 2 t0.
    Ricker,
}

/// A wavelet with its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pulse {
    /// Shape.
    pub wavelet: Wavelet,
    /// Largest value, in the unit of what is driven.
    pub amplitude: f64,
    /// Frequency f (Hz).
    pub frequency: f64,
    /// Centre of the Ricker wavelet (s); the others start at zero and ignore it.
    pub t0: f64,
}

impl Pulse {
    /// When the pulse is over (s).
    pub fn end(&self) -> f64 {
        match self.wavelet {
            Wavelet::Sine => 1.0 / self.frequency,
            Wavelet::HalfSine | Wavelet::SineSquared => 0.5 / self.frequency,
            Wavelet::Ricker => 2.0 * self.t0,
        }
    }

    /// Value at time `t` (s).
    pub fn value(&self, t: f64) -> f64 {
        let outside = !(0.0..=self.end()).contains(&t);
        let phase = 2.0 * PI * self.frequency * t;
        self.amplitude
            * match self.wavelet {
                Wavelet::Ricker => {
                    let a = (PI * self.frequency * (t - self.t0)).powi(2);
                    (1.0 - 2.0 * a) * (-a).exp()
                }
                _ if outside => 0.0,
                Wavelet::Sine | Wavelet::HalfSine => phase.sin(),
                Wavelet::SineSquared => phase.sin().powi(2),
            }
    }

    /// Integral from 0 to `t` (s).
    pub fn integral(&self, t: f64) -> f64 {
        let w = 2.0 * PI * self.frequency;
        let inside = t.clamp(0.0, self.end());
        self.amplitude
            * match self.wavelet {
                Wavelet::Ricker => {
                    let b = (PI * self.frequency).powi(2);
                    let primitive = |s: f64| s * (-b * s * s).exp();
                    primitive(t - self.t0) - primitive(-self.t0)
                }
                Wavelet::Sine | Wavelet::HalfSine => (1.0 - (w * inside).cos()) / w,
                Wavelet::SineSquared => 0.5 * inside - (2.0 * w * inside).sin() / (4.0 * w),
            }
    }

    /// Derivative at time `t` (1/s).
    pub fn rate(&self, t: f64) -> f64 {
        let outside = !(0.0..=self.end()).contains(&t);
        let w = 2.0 * PI * self.frequency;
        self.amplitude
            * match self.wavelet {
                Wavelet::Ricker => {
                    let b = (PI * self.frequency).powi(2);
                    let s = t - self.t0;
                    (4.0 * b * b * s.powi(3) - 6.0 * b * s) * (-b * s * s).exp()
                }
                _ if outside => 0.0,
                Wavelet::Sine | Wavelet::HalfSine => w * (w * t).cos(),
                Wavelet::SineSquared => w * (2.0 * w * t).sin(),
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rate_value_and_integral_belong_together() {
        let step = 1e-6;
        for wavelet in [
            Wavelet::Sine,
            Wavelet::HalfSine,
            Wavelet::SineSquared,
            Wavelet::Ricker,
        ] {
            let pulse = Pulse {
                wavelet,
                amplitude: 3.0,
                frequency: 2.0,
                t0: 0.5,
            };
            for t in [0.03, 0.11, 0.2, 0.24] {
                let difference = (pulse.value(t + step) - pulse.value(t - step)) / (2.0 * step);
                assert!(
                    (pulse.rate(t) - difference).abs() < 1e-6 * 100.0,
                    "{wavelet:?} at {t}"
                );
            }
        }
    }

    #[test]
    fn shapes_have_their_peaks_and_ends() {
        let pulse = |wavelet| Pulse {
            wavelet,
            amplitude: 2.0,
            frequency: 1.0,
            t0: 0.75,
        };
        assert!((pulse(Wavelet::HalfSine).value(0.25) - 2.0).abs() < 1e-15);
        assert!((pulse(Wavelet::SineSquared).value(0.25) - 2.0).abs() < 1e-15);
        assert!((pulse(Wavelet::Ricker).value(0.75) - 2.0).abs() < 1e-15);
        assert_eq!(pulse(Wavelet::HalfSine).value(0.6), 0.0);
        assert!((pulse(Wavelet::Sine).value(0.75) + 2.0).abs() < 1e-14);
        assert_eq!(pulse(Wavelet::Sine).value(1.1), 0.0);
    }
}
