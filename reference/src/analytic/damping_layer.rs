//! Reflection of a harmonic plane wave from a viscous layer in one dimension.
//!
//! Source: S21 (Shan et al. 2021, doi 10.1631/jzus.A2000399), Eqs (6)-(7), for the layer; the
//! invariant imbedding of the reflection coefficient is standard (e.g. Brekhovskikh, Waves in Layered
//! Media, 1980, chapter 3).
//!
//! In the layer 0 <= x <= B a velocity is damped at the rate g(x) (1/s):
//!
//! ```text
//! rho v_t + rho g v = s_x,   s_t = rho c^2 v_x
//! ```
//!
//! With v = a + b and s = rho c (b - a), a the wave that runs into the layer and b the one that runs
//! out, and harmonic motion exp(i w t), the ratio r = b/a obeys
//!
//! ```text
//! r' = 2 i (w/c) r + g/(2 c) (1 + r)^2,   r(B) = -1 (fixed) or +1 (free)
//! ```
//!
//! r(0) is the reflection coefficient of velocity: exact within this model. Where g varies slowly
//! (|g'| c << w^2) and g << w nothing reflects inside the layer and the wave only decays on its way
//! in and out: |R| = exp(-1/c integral of g), the WKB value, whatever the end.

use super::quadrature::GaussLegendre;
use num_complex::Complex64;
use thiserror::Error;

/// What the reflection coefficient cannot be computed for.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LayerError {
    /// A parameter out of range.
    #[error("{field} = {value} of the damping layer is out of range: use {allowed}")]
    OutOfRange {
        /// Which parameter.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Step halving did not settle.
    #[error(
        "the reflection coefficient still changes by {change:.1e} at {steps} steps through the damping layer: is its profile smooth and finite?"
    )]
    NotConverged {
        /// Steps in the finest integration.
        steps: usize,
        /// Last change.
        change: f64,
    },
}

/// What lies behind the layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// No motion along the wave (a roller is the same in one dimension).
    Fixed,
    /// No stress.
    Free,
}

/// A viscous layer of thickness B in a medium of wave speed c.
#[derive(Clone, Copy, Debug)]
pub struct DampingLayer<G> {
    thickness: f64,
    speed: f64,
    end: End,
    rate: G,
}

/// Damping rate (1/s) of the layer as S21 prints it, at depth x (m) in the layer: each step of
/// `time_step` (s) takes the share `alpha` x (`alpha` in 1/m) of the velocity, so g = alpha x/dt.
pub fn printed_rate(alpha: f64, time_step: f64) -> impl Fn(f64) -> f64 {
    move |x| alpha * x / time_step
}

impl<G: Fn(f64) -> f64> DampingLayer<G> {
    /// Layer of `thickness` B (m), wave `speed` c (m/s), with damping `rate` g(x) (1/s), x in m from
    /// its inner edge.
    pub fn new(thickness: f64, speed: f64, end: End, rate: G) -> Result<Self, LayerError> {
        Ok(DampingLayer {
            thickness: positive("thickness (m)", thickness)?,
            speed: positive("wave speed (m/s)", speed)?,
            end,
            rate,
        })
    }

    /// Reflection coefficient of velocity at the inner edge for a harmonic wave of `frequency` (Hz).
    ///
    /// Halves the steps until the value settles to 1e-10.
    pub fn reflection(&self, frequency: f64) -> Result<Complex64, LayerError> {
        const TOLERANCE: f64 = 1e-10;
        const MOST_STEPS: usize = 1 << 22;
        let frequency = positive("frequency (Hz)", frequency)?;
        let mut steps = 64;
        let mut coarse = self.integrate(frequency, steps);
        loop {
            steps *= 2;
            let fine = self.integrate(frequency, steps);
            let change = (fine - coarse).norm();
            if change < TOLERANCE {
                return Ok(fine);
            }
            if steps >= MOST_STEPS {
                return Err(LayerError::NotConverged { steps, change });
            }
            coarse = fine;
        }
    }

    /// WKB value of |R|: exp(-1/c integral of g over the layer).
    pub fn wkb(&self) -> f64 {
        const PANELS: usize = 64;
        let rule = GaussLegendre::new(8);
        let width = self.thickness / PANELS as f64;
        let integral: f64 = (0..PANELS)
            .flat_map(|panel| rule.on(panel as f64 * width, (panel + 1) as f64 * width))
            .map(|(x, weight)| weight * (self.rate)(x))
            .sum();
        (-integral / self.speed).exp()
    }

    /// Riccati's equation by `steps` classical Runge-Kutta steps from the end to the inner edge.
    ///
    /// In this direction damping draws r to its local value, so errors of the start die out.
    fn integrate(&self, frequency: f64, steps: usize) -> Complex64 {
        let turn = Complex64::new(0.0, 4.0 * std::f64::consts::PI * frequency / self.speed);
        let slope = |x: f64, r: Complex64| {
            let sum = r + 1.0;
            turn * r + (self.rate)(x) / (2.0 * self.speed) * sum * sum
        };
        let mut r = Complex64::from(match self.end {
            End::Fixed => -1.0,
            End::Free => 1.0,
        });
        let h = self.thickness / steps as f64;
        for step in (0..steps).rev() {
            let (low, middle, high) = (
                step as f64 * h,
                (step as f64 + 0.5) * h,
                (step as f64 + 1.0) * h,
            );
            let k1 = slope(high, r);
            let k2 = slope(middle, r - 0.5 * h * k1);
            let k3 = slope(middle, r - 0.5 * h * k2);
            let k4 = slope(low, r - h * k3);
            r -= h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
        r
    }
}

fn positive(field: &'static str, value: f64) -> Result<f64, LayerError> {
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    let allowed = "a positive finite number";
    Err(LayerError::OutOfRange {
        field,
        value,
        allowed,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stored::Table;
    use std::f64::consts::PI;

    const SPEED: f64 = 62.844;

    fn layer<G: Fn(f64) -> f64>(end: End, rate: G) -> DampingLayer<G> {
        DampingLayer::new(10.0, SPEED, end, rate).unwrap()
    }

    #[test]
    fn without_damping_all_comes_back_with_the_phase_of_the_way() {
        let phase = Complex64::new(0.0, -4.0 * PI * 3.0 / SPEED * 10.0).exp();
        let fixed = layer(End::Fixed, |_| 0.0).reflection(3.0).unwrap();
        let free = layer(End::Free, |_| 0.0).reflection(3.0).unwrap();
        assert!((fixed + phase).norm() < 1e-9);
        assert!((free - phase).norm() < 1e-9);
        assert_eq!(layer(End::Fixed, |_| 0.0).wkb(), 1.0);
    }

    /// Constant g: impedance rho c q and wave number w q/c with q = sqrt(1 - i g/w), line of length B.
    fn constant(rate: f64, frequency: f64, end: End) -> Complex64 {
        let w = 2.0 * PI * frequency;
        let q = Complex64::new(1.0, -rate / w).sqrt();
        let i_tan = Complex64::i() * (q * w / SPEED * 10.0).tan();
        // -s/v over rho c at the inner edge, from v or s = 0 at the end.
        let z = match end {
            End::Fixed => q / i_tan,
            End::Free => q * i_tan,
        };
        (1.0 - z) / (1.0 + z)
    }

    #[test]
    fn constant_damping_is_a_transmission_line() {
        for end in [End::Fixed, End::Free] {
            for (rate, frequency) in [(0.5, 1.0), (15.7, 1.0), (100.0, 2.0), (3.0, 10.0)] {
                let own = layer(end, |_| rate).reflection(frequency).unwrap();
                let exact = constant(rate, frequency, end);
                assert!((own - exact).norm() < 1e-9, "{end:?} {rate} {frequency}");
            }
        }
    }

    #[test]
    fn runge_kutta_is_of_fourth_order() {
        let layer = layer(End::Fixed, |x| 1.57 * x);
        let exact = layer.reflection(2.0).unwrap();
        let error = |steps| (layer.integrate(2.0, steps) - exact).norm();
        let order = (error(16) / error(32)).log2();
        assert!((3.7..4.3).contains(&order), "{order}");
    }

    #[test]
    fn wkb_is_the_limit_of_high_frequency() {
        for end in [End::Fixed, End::Free] {
            let layer = layer(end, printed_rate(0.01, 0.4 / SPEED));
            let deviation = |f| layer.reflection(f).unwrap().norm() - layer.wkb();
            assert!(deviation(1.0).abs() > 0.02);
            assert!(deviation(100.0).abs() < 1e-3);
        }
    }

    #[test]
    fn a_free_end_leaves_less_than_a_fixed_one_at_low_frequency() {
        // A fixed end keeps velocity small where the layer damps most.
        let reflect = |end| layer(end, |x| 1.57 * x).reflection(1.0).unwrap().norm();
        assert!(reflect(End::Free) < 0.5 * reflect(End::Fixed));
    }

    #[test]
    fn agrees_with_the_independent_table() {
        let text = include_str!("../../data/damping_layer_reflection.csv");
        let table = Table::parse("damping_layer_reflection.csv", text).unwrap();
        let column = |name| table.column(name).unwrap();
        assert_eq!(table.rows(), 28);
        for i in 0..table.rows() {
            let (h, dt) = (column("h")[i], column("dt")[i]);
            let (alpha, thickness) = (column("alpha")[i], column("B")[i]);
            let speed = 0.4 * h / dt; // the header: CFL 0.4
            let rate = printed_rate(alpha, dt);
            let layer = DampingLayer::new(thickness, speed, End::Fixed, rate).unwrap();
            let own = layer.reflection(column("f_Hz")[i]).unwrap().norm();
            let stored = column("absR_exact")[i];
            assert!(
                (own - stored).abs() < 2e-5 * (0.1 + stored),
                "row {i}: {own}, {stored}"
            );
            let stored = column("R_wkb")[i];
            // Six digits of dt, in an exponent as large as 250.
            assert!(
                (layer.wkb().ln() / stored.ln() - 1.0).abs() < 1e-5,
                "row {i}"
            );
        }
    }

    #[test]
    fn refuses_what_it_cannot_integrate() {
        assert!(DampingLayer::new(0.0, SPEED, End::Free, |_| 1.0).is_err());
        assert!(layer(End::Free, |_| 1.0).reflection(-1.0).is_err());
        let broken = layer(End::Free, |_| f64::NAN).reflection(1.0);
        assert!(matches!(broken, Err(LayerError::NotConverged { .. })));
    }
}
