//! Soil that meets a rigid body: the pressure of the blow, and when its waves and their echoes arrive.
//!
//! Source: S21 (Shan et al. 2021, doi 10.1631/jzus.A2000399), sections 3.2 and 3.3, for the scenes; the
//! pressure is that of water hammer (Joukowsky 1898), the shock that of any text on finite waves (e.g.
//! Achenbach 1973, chapter 4, for the jump conditions).
//!
//! All is told in the frame of soil at rest into which the body goes at v < c from time 0. What it emits
//! first runs at c in all directions, whatever the body does later:
//!
//! ```text
//! pressure of the blow                          rho c v
//! at a place in the soil, s from the body       t = s/c,  s to the image of the body for an echo
//! echo of what lies ahead at d, at the body     c t = 2 d - v t        t = 2 d/(c + v)
//! echo of what lies beside at d, at the body    (c t)^2 = (2 d)^2 + (v t)^2
//!                                                              t = 2 d/sqrt(c^2 - v^2)
//! ```
//!
//! A slide that runs against a body at rest is the same: an end of it that moves with the slide lies
//! ahead at d = L, its top beside.
//!
//! **Assumptions**: small strain, v << c, and elastic soil. A plane blow on soil whose Kirchhoff stress
//! is M ln s runs ahead as a shock, faster than c by 3 v/(4 c): [`Impact::shock`]. Soil that flows
//! carries all but a precursor at sqrt(K/rho), 1.3 % less than c at nu = 0.49.

use super::elastic::Elastic;
use thiserror::Error;

/// What the closed forms cannot serve.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{field} = {value} of the impact is out of range: use {allowed}")]
pub struct ImpactError {
    /// Which parameter.
    pub field: &'static str,
    /// What was given.
    pub value: f64,
    /// What is allowed.
    pub allowed: &'static str,
}

/// A plane shock in soil at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shock {
    /// Its speed by lengths of the start, U (m/s).
    pub speed: f64,
    /// Pressure behind it (Pa).
    pub pressure: f64,
    /// Stretch behind it, below 1.
    pub stretch: f64,
}

/// Soil and the velocity at which a body goes into it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact {
    density: f64,
    speed: f64,
    velocity: f64,
}

impl Impact {
    /// A body that goes into `soil` at `velocity` v (m/s), from 0 to below the speed of its waves.
    pub fn new(soil: &Elastic, velocity: f64) -> Result<Self, ImpactError> {
        if !(0.0..soil.p_speed()).contains(&velocity) {
            return Err(ImpactError {
                field: "velocity (m/s)",
                value: velocity,
                allowed: "0 to below the speed of compression waves",
            });
        }
        Ok(Impact {
            density: soil.density(),
            speed: soil.p_speed(),
            velocity,
        })
    }

    /// Pressure of the blow (Pa) on a plane face: rho c v.
    pub fn pressure(&self) -> f64 {
        self.density * self.speed * self.velocity
    }

    /// Stagnation scale (Pa): rho v^2.
    pub fn dynamic_pressure(&self) -> f64 {
        self.density * self.velocity * self.velocity
    }

    /// The shock of a plane blow in soil with Kirchhoff stress M ln s, M = rho c^2: mass and momentum
    /// across it give 1 - s = v/U and p = rho U v, the law p = -M (ln s)/s; so
    /// -(ln s) (1 - s)/s = (v/c)^2, which grows from 0 as s falls from 1.
    pub fn shock(&self) -> Shock {
        let wanted = (self.velocity / self.speed).powi(2);
        let (mut low, mut high) = (0.1, 1.0); // v < c is a stretch above 0.4
        for _ in 0..200 {
            let s: f64 = 0.5 * (low + high);
            if -s.ln() * (1.0 - s) / s > wanted {
                low = s;
            } else {
                high = s;
            }
        }
        let stretch = 0.5 * (low + high);
        let pressure = -self.density * self.speed.powi(2) * stretch.ln() / stretch;
        Shock {
            speed: (pressure / (self.density * (1.0 - stretch))).sqrt(),
            pressure,
            stretch,
        }
    }

    /// When (s) a wave has run the `path` (m).
    pub fn arrival(&self, path: f64) -> f64 {
        path / self.speed
    }

    /// When (s) the body meets the echo of what lies `distance` (m) ahead.
    pub fn echo_ahead(&self, distance: f64) -> f64 {
        2.0 * distance / (self.speed + self.velocity)
    }

    /// When (s) the body meets the echo of what lies `distance` (m) beside it, along its way.
    pub fn echo_beside(&self, distance: f64) -> f64 {
        2.0 * distance / (self.speed.powi(2) - self.velocity.powi(2)).sqrt()
    }

    /// How far (m) the body has gone when it meets the echo of what lies `distance` (m) ahead.
    pub fn way_to_echo(&self, distance: f64) -> f64 {
        self.velocity * self.echo_ahead(distance)
    }
}

/// A slide on a smooth base against a low step, like the mudmat: places by their way upstream of the
/// step (m) at time 0 and their height (m); they move with the slide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slide {
    impact: Impact,
    length: f64,
    height: f64,
    exposed: f64,
}

impl Slide {
    /// A slide of `length` and `height` (m) whose step is `exposed` (m) above the base.
    pub fn new(
        impact: Impact,
        length: f64,
        height: f64,
        exposed: f64,
    ) -> Result<Self, ImpactError> {
        for (field, value) in [("length (m)", length), ("height (m)", height)] {
            if !(value.is_finite() && value > 0.0) {
                let allowed = "a positive finite number";
                return Err(ImpactError {
                    field,
                    value,
                    allowed,
                });
            }
        }
        if !(0.0..height).contains(&exposed) {
            return Err(ImpactError {
                field: "exposed height (m)",
                value: exposed,
                allowed: "0 to below the height of the slide",
            });
        }
        Ok(Slide {
            impact,
            length,
            height,
            exposed,
        })
    }

    /// The first wave at a place (s): from the nearest place of the step's face.
    pub fn direct(&self, upstream: f64, height: f64) -> f64 {
        let above = (height - self.exposed).max(0.0);
        self.impact.arrival(upstream.hypot(above))
    }

    /// Its echo from the free top at a place (s).
    pub fn top_echo(&self, upstream: f64, height: f64) -> f64 {
        let way = 2.0 * self.height - self.exposed - height;
        self.impact.arrival(upstream.hypot(way))
    }

    /// Its echo from the far end, which moves with the slide, at a place (s).
    pub fn far_echo(&self, upstream: f64, height: f64) -> f64 {
        let above = (height - self.exposed).max(0.0);
        self.impact
            .arrival((2.0 * self.length - upstream).hypot(above))
    }

    /// The echo from the top at the step's upper edge (s).
    pub fn top_echo_at_step(&self) -> f64 {
        self.impact.echo_beside(self.height - self.exposed)
    }

    /// The echo from the far end at the step (s).
    pub fn far_echo_at_step(&self) -> f64 {
        self.impact.echo_ahead(self.length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The mudmat's slide: E = 300 s_u0, s_u0 = 0.5 kPa.
    fn slide_soil() -> Elastic {
        Elastic::new(150e3, 0.49, 1500.0).unwrap()
    }

    /// Soil whose waves run at the 41.2 m/s that S21 prints.
    fn printed_soil() -> Elastic {
        let share = 41.2 / slide_soil().p_speed();
        Elastic::new(150e3 * share * share, 0.49, 1500.0).unwrap()
    }

    fn slide(soil: &Elastic, length: f64) -> Slide {
        Slide::new(Impact::new(soil, 6.0).unwrap(), length, 10.0, 1.0).unwrap()
    }

    /// The pipe's clay: E = 500 s_u, s_u = 2.5 kPa; 2.5 m deep below a pipe of 0.8 m at 5 m/s.
    fn pipe() -> Impact {
        Impact::new(&Elastic::new(1.25e6, 0.49, 650.0).unwrap(), 5.0).unwrap()
    }

    #[test]
    fn pressures_of_the_mudmat() {
        let impact = Impact::new(&slide_soil(), 6.0).unwrap();
        assert!((slide_soil().p_speed() - 41.37).abs() < 0.005);
        assert!((impact.pressure() / 372e3 - 1.0).abs() < 2e-3);
        assert!((impact.dynamic_pressure() - 54e3).abs() < 1e-9);
    }

    #[test]
    fn arrivals_are_those_printed_with_the_printed_speed() {
        let (short, long) = (slide(&printed_soil(), 20.0), slide(&printed_soil(), 50.0));
        let near = |own: f64, printed: f64, digits: f64| {
            assert!((own - printed).abs() < digits, "{own} {printed}");
        };
        // S21: 0.44 and 0.84 s at the step, 2.1 s with L = 50 m; B at 0.11 and 0.34 s, A at 0.18 s.
        near(short.top_echo_at_step(), 0.44, 0.005);
        near(short.far_echo_at_step(), 0.84, 0.01);
        near(long.far_echo_at_step(), 2.1, 0.05);
        near(short.direct(2.5, 5.0), 0.11, 0.005);
        near(short.top_echo(2.5, 5.0), 0.34, 0.006);
        near(short.direct(8.0, 0.1), 0.18, 0.015);
        near(short.far_echo(8.0, 0.1), 0.74, 0.04);
    }

    #[test]
    fn arrivals_of_the_mudmats_soil() {
        let (short, long) = (slide(&slide_soil(), 20.0), slide(&slide_soil(), 50.0));
        for (own, by_hand) in [
            (short.top_echo_at_step(), 0.4398),
            (short.far_echo_at_step(), 0.8444),
            (long.far_echo_at_step(), 2.1111),
            (short.direct(8.0, 0.1), 0.1934),
            (short.far_echo(8.0, 0.1), 0.7735),
            (short.direct(2.5, 5.0), 0.1140),
            (short.top_echo(2.5, 5.0), 0.3438),
        ] {
            assert!((own - by_hand).abs() < 1e-4, "{own} {by_hand}");
        }
    }

    #[test]
    fn the_pipe_meets_the_echo_of_the_base() {
        let depth = pipe().way_to_echo(2.5) / 0.8;
        assert!((depth - 0.1677).abs() < 1e-4, "{depth}");
        // S21 prints 0.172, which leaves out that the pipe comes to meet the echo: 2 H/c.
        let printed = 5.0 * pipe().arrival(2.0 * 2.5) / 0.8;
        assert!((printed - 0.172).abs() < 5e-4, "{printed}");
        // 7.5 m keep the echo away until w/D = 0.5.
        assert!(pipe().way_to_echo(7.5) / 0.8 > 0.5);
    }

    /// The echo's path, from the image of the body at the start to where the body is, is c t.
    #[test]
    fn echoes_are_where_the_body_is() {
        let impact = Impact::new(&slide_soil(), 30.0).unwrap();
        let (c, v, d) = (slide_soil().p_speed(), 30.0, 7.0);
        let ahead = impact.echo_ahead(d);
        assert!((c * ahead - (2.0 * d - v * ahead)).abs() < 1e-12);
        let beside = impact.echo_beside(d);
        assert!((c * beside - (2.0 * d).hypot(v * beside)).abs() < 1e-12);
        let still = Impact::new(&slide_soil(), 0.0).unwrap();
        assert_eq!(still.echo_ahead(d), still.arrival(2.0 * d));
        assert!((still.echo_beside(d) - still.arrival(2.0 * d)).abs() < 1e-15);
    }

    #[test]
    fn at_the_step_a_place_sees_what_the_step_sends() {
        let own = slide(&slide_soil(), 20.0);
        assert_eq!(own.direct(0.0, 0.5), 0.0);
        // At the top the wave and its echo are one.
        assert!((own.direct(3.0, 10.0) - own.top_echo(3.0, 10.0)).abs() < 1e-15);
        assert!((own.direct(20.0, 4.0) - own.far_echo(20.0, 4.0)).abs() < 1e-15);
    }

    #[test]
    fn a_shock_keeps_mass_and_momentum_and_obeys_the_law() {
        for velocity in [0.5, 6.0, 20.0, 41.0] {
            let impact = Impact::new(&slide_soil(), velocity).unwrap();
            let Shock {
                speed,
                pressure,
                stretch,
            } = impact.shock();
            let modulus = 1500.0 * slide_soil().p_speed().powi(2);
            assert!(((1.0 - stretch) * speed / velocity - 1.0).abs() < 1e-9);
            assert!((pressure / (1500.0 * speed * velocity) - 1.0).abs() < 1e-9);
            assert!((pressure * stretch / (-modulus * stretch.ln()) - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn a_weak_shock_is_faster_by_three_quarters_of_the_ratio_of_speeds() {
        let c = slide_soil().p_speed();
        let over = |velocity: f64| {
            let shock = Impact::new(&slide_soil(), velocity).unwrap().shock();
            (shock.speed / c - 1.0) / (velocity / c)
        };
        assert!((over(0.004 * c) - 0.75).abs() < 2e-3, "{}", over(0.004 * c));
        let pressure = Impact::new(&slide_soil(), 0.004 * c).unwrap();
        assert!((pressure.shock().pressure / pressure.pressure() - 1.003).abs() < 1e-4);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        for velocity in [-1.0, 41.4, f64::NAN] {
            assert!(Impact::new(&slide_soil(), velocity).is_err());
        }
        let impact = Impact::new(&slide_soil(), 6.0).unwrap();
        assert_eq!(
            Slide::new(impact, 0.0, 1.0, 0.5).unwrap_err().field,
            "length (m)"
        );
        let error = Slide::new(impact, 20.0, 10.0, 10.0).unwrap_err();
        assert_eq!(error.field, "exposed height (m)");
    }
}
