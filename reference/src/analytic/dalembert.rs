//! D'Alembert's solution for an elastic column struck at its top.
//!
//! Source: S21 (Shan et al. 2021, doi 10.1631/jzus.A2000399), section 3.1; the images are those of
//! any text on the wave equation (e.g. Achenbach 1973, chapter 1).
//!
//! ```text
//!   y = H  ====  v = f(t) while the pulse lasts, then stress free (or held)
//!          |  |      down-going  f(t - n T - (H - y)/c)   weight (R r)^n
//!          |  |      up-going    f(t - n T - (H + y)/c)   weight (R r)^n R
//!   y = 0  ====  reflects velocity with R
//! ```
//!
//! With T = 2 H/c and r the reflection of the top (free +1, held -1), the velocity at height y is
//! the sum over n >= 0 of both lines; at y = H with a free top it is f(t) + 2 sum_{n>=1} R^n f(t - nT).
//! Displacement is the same sum over the antiderivative of f.
//!
//! **Sign**: velocity and displacement count along the pulse, **positive downward**.
//!
//! **Assumption**: a top that turns free reflects with +1 only if the pulse is over before the first
//! echo is back, pulse <= T; otherwise the end would have to be driven and free at once. Checked by
//! [`Dalembert::new`]. A top held after the pulse is driven throughout and needs no such bound.

use thiserror::Error;

/// What the closed form cannot serve.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum DalembertError {
    /// The echo returns while the top is still driven.
    #[error(
        "the pulse lasts {pulse_s} s but its echo is back at the free top after {round_trip_s} s: d'Alembert's images hold for pulses that are over by then; shorten the pulse, raise the column, or hold the top"
    )]
    PulseTooLong {
        /// Length of the pulse (s).
        pulse_s: f64,
        /// Time down and up, 2 H/c (s).
        round_trip_s: f64,
    },
    /// A parameter out of range.
    #[error("{field} = {value} is out of range: use {allowed}")]
    OutOfRange {
        /// Which parameter.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
}

/// What the base does with a velocity wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Base {
    /// No vertical motion: R = -1.
    Roller,
    /// Nothing returns: R = 0.
    Absorbing,
    /// A dashpot of impedance ratio a = (its coefficient)/(rho c): R = (1 - a)/(1 + a).
    Dashpot {
        /// a, from 0 (free end) on.
        impedance_ratio: f64,
    },
}

impl Base {
    /// Reflection coefficient R of velocity.
    pub fn reflection(&self) -> f64 {
        match *self {
            Base::Roller => -1.0,
            Base::Absorbing => 0.0,
            Base::Dashpot { impedance_ratio: a } => (1.0 - a) / (1.0 + a),
        }
    }
}

/// What the top does after the pulse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Top {
    /// Stress free.
    Free,
    /// Held at zero velocity.
    Held,
}

/// A column and the length of its pulse, checked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dalembert {
    height: f64,
    speed: f64,
    base: Base,
    top: Top,
    pulse_end: f64,
}

impl Dalembert {
    /// Column of `height` (m) with wave `speed` (m/s), driven at its top over 0..`pulse_end` (s).
    pub fn new(
        height: f64,
        speed: f64,
        base: Base,
        top: Top,
        pulse_end: f64,
    ) -> Result<Self, DalembertError> {
        for (field, value) in [
            ("height (m)", height),
            ("wave speed (m/s)", speed),
            ("end of the pulse (s)", pulse_end),
        ] {
            if !(value.is_finite() && value > 0.0) {
                let allowed = "a positive finite number";
                return Err(DalembertError::OutOfRange {
                    field,
                    value,
                    allowed,
                });
            }
        }
        if let Base::Dashpot { impedance_ratio } = base
            && !(impedance_ratio.is_finite() && impedance_ratio >= 0.0)
        {
            return Err(DalembertError::OutOfRange {
                field: "impedance ratio of the dashpot",
                value: impedance_ratio,
                allowed: "a finite number from 0 on",
            });
        }
        let column = Dalembert {
            height,
            speed,
            base,
            top,
            pulse_end,
        };
        let round_trip_s = column.round_trip();
        if top == Top::Free && pulse_end > round_trip_s {
            return Err(DalembertError::PulseTooLong {
                pulse_s: pulse_end,
                round_trip_s,
            });
        }
        Ok(column)
    }

    /// T = 2 H/c (s).
    pub fn round_trip(&self) -> f64 {
        2.0 * self.height / self.speed
    }

    /// Velocity (unit of `pulse`, positive downward) at `height` y above the base (m), `time` (s).
    ///
    /// `pulse` is the velocity of the top; outside 0..pulse_end it counts as zero and is not called.
    pub fn velocity(
        &self,
        pulse: impl Fn(f64) -> f64,
        height: f64,
        time: f64,
    ) -> Result<f64, DalembertError> {
        self.images(height, time, |t| {
            if t <= self.pulse_end { pulse(t) } else { 0.0 }
        })
    }

    /// Displacement (m, positive downward) at `height` y above the base (m), `time` (s).
    ///
    /// `antiderivative` is the displacement of the top, the integral of the pulse from 0 to t; it is
    /// called on 0..=pulse_end only and rests at its last value afterwards.
    pub fn displacement(
        &self,
        antiderivative: impl Fn(f64) -> f64,
        height: f64,
        time: f64,
    ) -> Result<f64, DalembertError> {
        self.images(height, time, |t| antiderivative(t.min(self.pulse_end)))
    }

    /// Sum over the images; `wave` is called for times from 0 on.
    fn images(
        &self,
        height: f64,
        time: f64,
        wave: impl Fn(f64) -> f64,
    ) -> Result<f64, DalembertError> {
        if !(0.0..=self.height).contains(&height) {
            return Err(DalembertError::OutOfRange {
                field: "height of the receiver (m)",
                value: height,
                allowed: "0 to the height of the column",
            });
        }
        let causal = |t: f64| if t < 0.0 { 0.0 } else { wave(t) };
        let base = self.base.reflection();
        let top = match self.top {
            Top::Free => 1.0,
            Top::Held => -1.0,
        };
        let down = (self.height - height) / self.speed;
        let up = (self.height + height) / self.speed;
        let (mut sum, mut weight, mut start) = (0.0, 1.0, time);
        // Each pass leaves the top T later; a pass of weight zero ends them all.
        while start >= down && weight != 0.0 {
            sum += weight * (causal(start - down) + base * causal(start - up));
            weight *= base * top;
            start -= self.round_trip();
        }
        Ok(sum)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analytic::elastic::Elastic;
    use crate::stored::Table;
    use std::f64::consts::PI;

    const HEIGHT: f64 = 50.0;
    const END: f64 = 0.5;

    fn speed() -> f64 {
        Elastic::new(150e3, 0.49, 650.0).unwrap().p_speed()
    }

    fn struck(base: Base, top: Top) -> Dalembert {
        Dalembert::new(HEIGHT, speed(), base, top, END).unwrap()
    }

    fn half_sine(t: f64) -> f64 {
        (2.0 * PI * t).sin()
    }

    fn sine_squared(t: f64) -> f64 {
        (2.0 * PI * t).sin().powi(2)
    }

    fn sine_squared_integral(t: f64) -> f64 {
        0.5 * t - (4.0 * PI * t).sin() / (8.0 * PI)
    }

    /// sin^6: four continuous derivatives, so that second differences converge everywhere.
    fn smooth(t: f64) -> f64 {
        (2.0 * PI * t).sin().powi(6)
    }

    const BASES: [Base; 4] = [
        Base::Roller,
        Base::Absorbing,
        Base::Dashpot {
            impedance_ratio: 0.5,
        },
        Base::Dashpot {
            impedance_ratio: 3.0,
        },
    ];

    /// Points of a Halton sequence in the unit square.
    fn halton(i: u32) -> (f64, f64) {
        let radical = |base: u32| {
            let (mut n, mut f, mut r) = (i, 1.0, 0.0);
            while n > 0 {
                f /= base as f64;
                r += f * (n % base) as f64;
                n /= base;
            }
            r
        };
        (radical(2), radical(3))
    }

    #[test]
    fn satisfies_the_wave_equation() {
        let c = speed();
        for base in BASES {
            for top in [Top::Free, Top::Held] {
                let column = struck(base, top);
                let v = |y: f64, t: f64| column.velocity(smooth, y, t).unwrap();
                let (dt, scale) = (1e-3, (2.0 * PI / END).powi(2));
                let dy = 0.6 * c * dt; // not c dt, where differences are exact for any wave
                for i in 1..400 {
                    let (a, b) = halton(i);
                    let (y, t) = (0.5 + a * (HEIGHT - 1.0), 0.01 + 5.0 * b);
                    let tt = (v(y, t + dt) - 2.0 * v(y, t) + v(y, t - dt)) / (dt * dt);
                    let yy = (v(y + dy, t) - 2.0 * v(y, t) + v(y - dy, t)) / (dy * dy);
                    assert!((tt - c * c * yy).abs() < 1e-3 * scale, "y = {y}, t = {t}");
                }
            }
        }
    }

    #[test]
    fn top_follows_the_pulse_then_is_free_of_stress() {
        let h = 1e-4;
        for base in BASES {
            let column = struck(base, Top::Free);
            let held = struck(base, Top::Held);
            for i in 0..500 {
                let t = 0.01 * i as f64;
                if t <= END {
                    let v = column.velocity(smooth, HEIGHT, t).unwrap();
                    assert!((v - smooth(t)).abs() < 1e-14);
                } else {
                    let u = |y| column.displacement(sine_squared_integral, y, t).unwrap();
                    // One-sided second-order difference for the strain at the top.
                    let strain =
                        (3.0 * u(HEIGHT) - 4.0 * u(HEIGHT - h) + u(HEIGHT - 2.0 * h)) / (2.0 * h);
                    assert!(strain.abs() < 1e-5 / speed(), "t = {t}: {strain}");
                    assert!(held.velocity(smooth, HEIGHT, t).unwrap().abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn base_reflects_as_told() {
        let h = 1e-4;
        for base in BASES {
            let column = struck(base, Top::Free);
            for i in 0..500 {
                let t = 0.01 * i as f64;
                let v = column.velocity(sine_squared, 0.0, t).unwrap();
                let u = |y| column.displacement(sine_squared_integral, y, t).unwrap();
                let strain = (-3.0 * u(0.0) + 4.0 * u(h) - u(2.0 * h)) / (2.0 * h);
                match base {
                    Base::Roller => assert!(v.abs() < 1e-14),
                    // Stress of a dashpot a rho c v, over rho c^2: strain = a v/c.
                    Base::Absorbing => assert!((strain - v / speed()).abs() < 1e-5 / speed()),
                    Base::Dashpot { impedance_ratio: a } => {
                        assert!((strain - a * v / speed()).abs() < 1e-5 / speed())
                    }
                }
            }
        }
    }

    #[test]
    fn absorbing_base_lets_one_pass_through() {
        let column = struck(Base::Absorbing, Top::Free);
        for i in 0..=500 {
            let t = 0.01 * i as f64;
            let arrived = t - 45.0 / speed();
            let pulse = if (0.0..=END).contains(&arrived) {
                smooth(arrived)
            } else {
                0.0
            };
            assert!((column.velocity(smooth, 5.0, t).unwrap() - pulse).abs() < 1e-14);
        }
    }

    #[test]
    fn starts_at_rest() {
        for base in BASES {
            let column = struck(base, Top::Free);
            for y in [0.0, 10.0, 49.9] {
                let before = 0.999 * (HEIGHT - y) / speed();
                assert_eq!(column.velocity(half_sine, y, before), Ok(0.0));
                assert_eq!(column.velocity(half_sine, y, -1.0), Ok(0.0));
                let u = column.displacement(sine_squared_integral, y, before);
                assert_eq!(u, Ok(0.0));
            }
        }
    }

    #[test]
    fn displacement_integrates_velocity() {
        let (column, steps) = (struck(BASES[2], Top::Free), 20_000);
        let dt = 4.0 / steps as f64;
        let v = |i: usize| column.velocity(sine_squared, 12.0, i as f64 * dt).unwrap();
        let inner: f64 = (1..steps).map(v).sum();
        let integral = dt * (inner + 0.5 * (v(0) + v(steps)));
        let u = column.displacement(sine_squared_integral, 12.0, 4.0);
        assert!((integral - u.unwrap()).abs() < 1e-8);
    }

    #[test]
    fn agrees_with_the_independent_table() {
        let name = "compression_1d.csv";
        let table = Table::parse(name, include_str!("../../data/compression_1d.csv")).unwrap();
        let half = Base::Dashpot {
            impedance_ratio: 0.5,
        };
        let times = table.column("t").unwrap();
        assert_eq!(times.len(), 501);
        for (suffix, base, top) in [
            ("roller", Base::Roller, Top::Free),
            ("absorb", Base::Absorbing, Top::Free),
            ("roller_topfixed", Base::Roller, Top::Held),
            ("dash_half", half, Top::Free),
        ] {
            for (receiver, y) in [("A", 50.0), ("B", 5.0)] {
                let column_name = format!("{receiver}_{suffix}");
                let stored = table.column(&column_name).unwrap();
                let column = struck(base, top);
                for (&t, &v) in times.iter().zip(stored) {
                    let own = column.velocity(half_sine, y, t).unwrap();
                    assert!((own - v).abs() < 2e-7, "{column_name} at {t} s: {own}, {v}");
                }
            }
        }
    }

    #[test]
    fn refuses_a_pulse_that_meets_its_echo() {
        // The printed nu = 0.3 gives 17.6 m/s and T = 5.7 s: fine; a column of 5 m is too short.
        let slow = Elastic::new(150e3, 0.3, 650.0).unwrap().p_speed();
        assert!(Dalembert::new(50.0, slow, Base::Roller, Top::Free, END).is_ok());
        let short = Dalembert::new(4.0, slow, Base::Roller, Top::Free, END);
        assert!(matches!(short, Err(DalembertError::PulseTooLong { .. })));
        assert!(Dalembert::new(4.0, slow, Base::Roller, Top::Held, END).is_ok());
    }

    #[test]
    fn refuses_what_is_out_of_range() {
        let column = struck(Base::Roller, Top::Free);
        assert!(column.velocity(half_sine, 50.1, 1.0).is_err());
        assert!(column.velocity(half_sine, f64::NAN, 1.0).is_err());
        let dashpot = Base::Dashpot {
            impedance_ratio: -0.1,
        };
        assert!(Dalembert::new(HEIGHT, 60.0, dashpot, Top::Free, END).is_err());
        assert!(Dalembert::new(0.0, 60.0, Base::Roller, Top::Free, END).is_err());
    }
}
