//! A rigid body: an outline that is moved as prescribed.

use super::shape::{Distance, Shape};
use crate::tensor::Vector;
use std::f64::consts::PI;

/// Translation at a constant velocity, reached along half a cosine:
///
/// ```text
/// v(t) = V (1 - cos(pi t/T))/2   t < T,      x(t) = V (t/2 - T/(2 pi) sin(pi t/T))
///        V                       t >= T,            V (t - T/2)
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// V (m/s).
    pub velocity: Vector<2>,
    /// T (s); 0 for a body that moves from the start.
    pub rise: f64,
}

impl Motion {
    /// Way from the start (m) at `time` (s), from 0.
    pub fn way(&self, time: f64) -> Vector<2> {
        let effective = if time < self.rise {
            0.5 * (time - self.rise / PI * (PI * time / self.rise).sin())
        } else {
            time - 0.5 * self.rise
        };
        self.velocity.map(|v| v * effective)
    }
}

/// A rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidBody {
    /// Outline at time 0.
    pub shape: Shape,
    /// How it moves.
    pub motion: Motion,
}

impl RigidBody {
    /// Distance of the place `x` (m) and normal, at `time` (s).
    #[inline]
    pub fn distance(&self, x: &Vector<2>, time: f64) -> Distance {
        let way = self.motion.way(time);
        self.shape.distance(&[x[0] - way[0], x[1] - way[1]])
    }

    /// Velocity (m/s) that takes the body through the step from `time` over `dt` (s): its way over dt, so
    /// that soil which moves with the body stays beside it.
    pub fn velocity(&self, time: f64, dt: f64) -> Vector<2> {
        let (from, to) = (self.motion.way(time), self.motion.way(time + dt));
        [(to[0] - from[0]) / dt, (to[1] - from[1]) / dt]
    }

    /// How deep the deepest of `points` (m) lies in the body at `time` (s), over the cell's edge `h` (m);
    /// 0 if all are outside.
    pub fn penetration<'a>(
        &self,
        points: impl IntoIterator<Item = &'a Vector<2>>,
        time: f64,
        h: f64,
    ) -> f64 {
        let depth = |x| -self.distance(x, time).gap;
        points.into_iter().map(depth).fold(0.0, f64::max) / h
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIPE: RigidBody = RigidBody {
        shape: Shape::Circle {
            centre: [0.0, 0.4],
            radius: 0.4,
        },
        motion: Motion {
            velocity: [0.0, -5.0],
            rise: 0.01,
        },
    };

    #[test]
    fn the_start_is_smooth_and_half_of_its_time_is_lost() {
        let way = |t: f64| PIPE.motion.way(t)[1];
        assert_eq!(way(0.0), 0.0);
        assert!((way(0.01) + 5.0 * 0.005).abs() < 1e-15);
        assert!((way(0.03) + 5.0 * 0.025).abs() < 1e-15);
        // Half the velocity at half the time; the quotient over a step is the velocity at its middle.
        assert!((PIPE.velocity(0.005 - 5e-6, 1e-5)[1] + 2.5).abs() < 1e-4);
        assert!(PIPE.velocity(0.0, 1e-5)[1].abs() < 1e-4);
        assert!((PIPE.velocity(0.02, 1e-5)[1] + 5.0).abs() < 1e-9);
    }

    #[test]
    fn without_a_rise_it_moves_at_once() {
        let sudden = Motion {
            velocity: [6.0, 0.0],
            rise: 0.0,
        };
        assert_eq!(sudden.way(0.0), [0.0, 0.0]);
        assert_eq!(sudden.way(0.5), [3.0, 0.0]);
    }

    #[test]
    fn the_distance_goes_with_the_body() {
        let (x, time) = ([0.3, -0.5], 0.045);
        // Centre at 0.4 - 5 (0.045 - 0.005) = 0.2: the place is (0.3, -0.7) from it.
        let Distance { gap, normal } = PIPE.distance(&x, time);
        let length = (0.09_f64 + 0.49).sqrt();
        assert!((gap - (length - 0.4)).abs() < 1e-14);
        assert!((normal[0] - 0.3 / length).abs() < 1e-14);
        assert!((normal[1] + 0.7 / length).abs() < 1e-14);
    }

    #[test]
    fn penetration_is_that_of_the_deepest_point() {
        let outside = [[0.0, -0.21], [1.0, 0.0]];
        assert_eq!(PIPE.penetration(&outside, 0.045, 0.01), 0.0);
        let inside = [[0.0, -0.21], [0.0, -0.197], [0.39, 0.2]];
        assert!((PIPE.penetration(&inside, 0.045, 0.01) - 1.0).abs() < 1e-12);
    }
}
