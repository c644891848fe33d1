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
    /// A force that stays on: rises as sin^2(pi f t) on 0..1/(2f) and stays at its largest value.
    Step,
}

/// What a pulse leaves a body with when it has settled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lasting {
    /// Nothing: force and impulse are zero again.
    Nothing,
    /// A net impulse: the body has been pushed.
    Impulse,
    /// The force itself, which stays on.
    Force,
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
    /// When the pulse no longer changes (s).
    pub fn settled(&self) -> f64 {
        match self.wavelet {
            Wavelet::Sine => 1.0 / self.frequency,
            Wavelet::HalfSine | Wavelet::SineSquared | Wavelet::Step => 0.5 / self.frequency,
            Wavelet::Ricker => 2.0 * self.t0,
        }
    }

    /// When the pulse is over (s): never, if it stays on.
    pub fn end(&self) -> f64 {
        match self.lasting() {
            Lasting::Force => f64::INFINITY,
            Lasting::Nothing | Lasting::Impulse => self.settled(),
        }
    }

    /// What it leaves. The rest of a Ricker wavelet that is cut at its start counts as nothing.
    pub fn lasting(&self) -> Lasting {
        match self.wavelet {
            Wavelet::Sine | Wavelet::Ricker => Lasting::Nothing,
            Wavelet::HalfSine | Wavelet::SineSquared => Lasting::Impulse,
            Wavelet::Step => Lasting::Force,
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
                Wavelet::Step if t < self.settled() => (0.5 * phase).sin().powi(2),
                Wavelet::Step => 1.0,
            }
    }

    /// Integral from 0 to `t` (s).
    pub fn integral(&self, t: f64) -> f64 {
        let w = 2.0 * PI * self.frequency;
        let inside = t.clamp(0.0, self.settled());
        self.amplitude
            * match self.wavelet {
                Wavelet::Ricker => {
                    let b = (PI * self.frequency).powi(2);
                    let primitive = |s: f64| s * (-b * s * s).exp();
                    primitive(t - self.t0) - primitive(-self.t0)
                }
                Wavelet::Sine | Wavelet::HalfSine => (1.0 - (w * inside).cos()) / w,
                Wavelet::SineSquared => 0.5 * inside - (2.0 * w * inside).sin() / (4.0 * w),
                Wavelet::Step => {
                    let risen = (t - self.settled()).max(0.0);
                    0.5 * inside - (w * inside).sin() / (2.0 * w) + risen
                }
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
                Wavelet::Step if t < self.settled() => 0.5 * w * (w * t).sin(),
                Wavelet::Step => 0.0,
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Wavelet; 5] = [
        Wavelet::Sine,
        Wavelet::HalfSine,
        Wavelet::SineSquared,
        Wavelet::Ricker,
        Wavelet::Step,
    ];

    #[test]
    fn rate_value_and_integral_belong_together() {
        let step = 1e-6;
        for wavelet in ALL {
            let pulse = Pulse {
                wavelet,
                amplitude: 3.0,
                frequency: 2.0,
                t0: 0.5,
            };
            for t in [0.03, 0.11, 0.2, 0.24, 0.7, 2.0] {
                let slope = |of: &dyn Fn(f64) -> f64| (of(t + step) - of(t - step)) / (2.0 * step);
                let (rate, value) = (slope(&|t| pulse.value(t)), slope(&|t| pulse.integral(t)));
                assert!((pulse.rate(t) - rate).abs() < 1e-4, "{wavelet:?} at {t}");
                assert!((pulse.value(t) - value).abs() < 1e-4, "{wavelet:?} at {t}");
            }
        }
    }

    #[test]
    fn what_lasts_is_what_force_and_impulse_are_in_the_end() {
        for wavelet in ALL {
            let pulse = Pulse {
                wavelet,
                amplitude: 3.0,
                frequency: 2.0,
                t0: 0.75,
            };
            let late = 5.0;
            let expected = if pulse.value(late).abs() > 1e-6 {
                Lasting::Force
            } else if pulse.integral(late).abs() > 1e-6 {
                Lasting::Impulse
            } else {
                Lasting::Nothing
            };
            assert_eq!(pulse.lasting(), expected, "{wavelet:?}");
            assert_eq!(pulse.end().is_infinite(), expected == Lasting::Force);
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
        // sin^2 of 45 and 90 degrees, and then for good
        assert!((pulse(Wavelet::Step).value(0.25) - 1.0).abs() < 1e-15);
        assert_eq!(pulse(Wavelet::Step).value(0.5), 2.0);
        assert_eq!(pulse(Wavelet::Step).value(50.0), 2.0);
    }
}
