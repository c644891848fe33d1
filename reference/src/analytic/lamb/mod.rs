//! Lamb's problem: a line force on the surface of an elastic half-space, in plane strain.
//!
//! Sources: Lamb 1904 (Phil. Trans. R. Soc. A 203); the contour is that of Cagniard 1939 and de Hoop
//! 1960 (Appl. Sci. Res. B 8); notation as Aki and Richards, Quantitative Seismology, chapter 6.
//!
//! ```text
//!            F_v, F_h at x = 0
//!   y = 0 ------+-----------------> x      free of stress elsewhere
//!               |\  r
//!               | \
//!         depth |  * receiver (offset x, depth z = -y)
//! ```
//!
//! **Signs**: x to the right, y up; a positive vertical force acts **downward**, a positive horizontal
//! force to the right; displacements are (u_x, u_y).
//!
//! **Solution.** Laplace transform in time (s), Fourier transform along x written with the slowness p:
//!
//! ```text
//! u(x, z, s) = F(s)/(2 pi i) integral dp [ P(p) exp(-s (p x + eta_a z)) + S(p) exp(-s (p x + eta_b z)) ]
//! ```
//!
//! over the imaginary axis; a, b are the slownesses of P and S, eta_q = sqrt(q^2 - p^2). P and S hold
//! no s (spectrum.rs), so bending the path to where the exponent's bracket is a real time t reads the
//! inverse transform off: the response to an impulse is Im(P dp/dt)/pi + Im(S dp/dt)/pi. The response
//! to a force history is its convolution.
//!
//! **Quadrature.** dp/dt is infinite like 1/sqrt(t - t_c) at an arrival t_c; t = t_c cosh(xi) takes
//! that away and leaves dp = i eta dxi. Panels of Gauss points shrink towards every branch point and
//! pole near the path (kernel.rs); at depth 0 the Rayleigh pole is taken as a principal value and half
//! a residue. The kernel is a list of delays and weights: made once, summed for any force and time.

mod kernel;
mod spectrum;
#[cfg(test)]
mod tests;

use super::elastic::Elastic;
use kernel::{Geometry, Node};
use thiserror::Error;

/// What the solution cannot serve.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum LambError {
    /// A parameter out of range.
    #[error("{field} = {value} of Lamb's problem is out of range: use {allowed}")]
    OutOfRange {
        /// Which parameter.
        field: &'static str,
        /// What was given.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// Later than the response was made for.
    #[error(
        "Lamb's response was made for times up to {end_s} s, not for {time_s} s: make it longer"
    )]
    TooLate {
        /// Time asked for (s).
        time_s: f64,
        /// Last time served (s).
        end_s: f64,
    },
}

/// Direction of the line force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Downward.
    Vertical,
    /// To the right.
    Horizontal,
}

/// Response of one receiver to an impulse of the line force, as delays and weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Response {
    /// In the order of their delays.
    nodes: Vec<Node>,
    end: f64,
}

impl Response {
    /// Receiver at `offset` x (m, either sign) and `depth` (m, from 0), for times up to `end` (s).
    ///
    /// `panel` (s) is a time over which the force is smooth, the longest panel of the quadrature. A
    /// quarter of the dominant period serves a Ricker wavelet to its own first jump (1e-8); a force
    /// with kinks wants less (one full sine of 0.5 s at the scene's receivers: 2e-3 of the largest
    /// displacement with panels of 0.05 s, 7e-5 with 0.02 s).
    /// A depth below 1e-6 of the offset counts as 0.
    pub fn new(
        material: &Elastic,
        offset: f64,
        depth: f64,
        end: f64,
        panel: f64,
    ) -> Result<Self, LambError> {
        let check = |field, value: f64, holds: bool, allowed| {
            if value.is_finite() && holds {
                return Ok(value);
            }
            Err(LambError::OutOfRange {
                field,
                value,
                allowed,
            })
        };
        check("offset (m)", offset, true, "a finite number")?;
        check("depth (m)", depth, depth >= 0.0, "0 (surface) or more")?;
        let distance = offset.hypot(depth);
        check("end (s)", end, end > 0.0, "more than 0")?;
        let allowed = "more than 1e-6 of the end";
        check("panel (s)", panel, panel > 1e-6 * end, allowed)?;
        // Late, P and S cancel to (distance/(c_s t))^2 of their own: 1e-10 leaves six digits.
        check(
            "distance to the force (m)",
            distance,
            distance >= 1e-5 * material.s_speed() * end,
            "at least 1e-5 of the way of an S wave until the end",
        )?;
        let geometry = Geometry {
            offset: offset.abs(),
            depth: if depth < 1e-6 * offset.abs() {
                0.0
            } else {
                depth
            },
            end,
            panel,
        };
        let mut nodes = kernel::nodes(material, &geometry);
        if offset < 0.0 {
            for node in &mut nodes {
                node.mirror();
            }
        }
        nodes.sort_by(|one, other| one.delay.total_cmp(&other.delay));
        Ok(Response { nodes, end })
    }

    /// Displacement (u_x, u_y) (m) at `time` (s) under `force` (N/m), a function of time (s) that is
    /// taken as zero before 0 and not called there. A force's rate gives the velocity (m/s).
    pub fn displacement(
        &self,
        direction: Direction,
        force: impl Fn(f64) -> f64,
        time: f64,
    ) -> Result<[f64; 2], LambError> {
        if time.is_nan() || time > self.end {
            return Err(LambError::TooLate {
                time_s: time,
                end_s: self.end,
            });
        }
        let arrived = self.nodes.partition_point(|node| node.delay <= time);
        let mut sum = [0.0; 2];
        for node in &self.nodes[..arrived] {
            let value = force(time - node.delay);
            let weight = node.weight(direction);
            sum[0] += weight[0] * value;
            sum[1] += weight[1] * value;
        }
        Ok(sum)
    }

    /// [`Response::displacement`] at each of `times` (s).
    pub fn series(
        &self,
        direction: Direction,
        force: impl Fn(f64) -> f64,
        times: &[f64],
    ) -> Result<Vec<[f64; 2]>, LambError> {
        times
            .iter()
            .map(|&time| self.displacement(direction, &force, time))
            .collect()
    }
}
