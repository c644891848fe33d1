//! Delays and weights of the impulse response: Gauss points along the Cagniard paths.

use super::super::elastic::{Elastic, vertical_slowness};
use super::super::quadrature::GaussLegendre;
use super::Direction;
use super::spectrum::{Green, Spectrum};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Gauss points a panel. Even, so that a panel centred at a pole gives its principal value.
const POINTS: usize = 16;

/// Panels stop shrinking towards a singular point at this share of the path.
const FLOOR: f64 = 1e-13;

/// One receiver and what is asked of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Geometry {
    /// Distance along the surface (m), from 0 on.
    pub(super) offset: f64,
    /// Depth (m).
    pub(super) depth: f64,
    /// Last time (s).
    pub(super) end: f64,
    /// Longest panel (s).
    pub(super) panel: f64,
}

/// A share of the impulse response.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Node {
    /// Delay (s).
    pub(super) delay: f64,
    /// (u_x, u_y) under the vertical force, then under the horizontal one (m per N/m).
    weights: [f64; 4],
}

impl Node {
    pub(super) fn weight(&self, direction: Direction) -> [f64; 2] {
        let [xv, yv, xh, yh] = self.weights;
        match direction {
            Direction::Vertical => [xv, yv],
            Direction::Horizontal => [xh, yh],
        }
    }

    /// To the receiver on the other side of the force.
    pub(super) fn mirror(&mut self) {
        self.weights[0] = -self.weights[0];
        self.weights[3] = -self.weights[3];
    }
}

/// All nodes with delays up to the end, and a few beyond.
pub(super) fn nodes(material: &Elastic, geometry: &Geometry) -> Vec<Node> {
    let paths = Paths {
        spectrum: Spectrum::new(material),
        geometry: *geometry,
        rule: GaussLegendre::new(POINTS),
    };
    if geometry.depth == 0.0 {
        paths.surface()
    } else {
        let mut nodes = paths.p_alone();
        nodes.extend(paths.head_wave());
        nodes.extend(paths.p_and_s());
        nodes
    }
}

struct Paths {
    spectrum: Spectrum,
    geometry: Geometry,
    rule: GaussLegendre,
}

impl Paths {
    fn distance(&self) -> f64 {
        self.geometry.offset.hypot(self.geometry.depth)
    }

    /// p = q sin(theta + i xi) and dp/dxi on the path of the wave of slowness q, theta from the vertical.
    fn hyperbola(&self, q: f64, xi: f64) -> (Complex64, Complex64) {
        let sine = self.geometry.offset / self.distance();
        let cosine = self.geometry.depth / self.distance();
        let p = Complex64::new(sine * xi.cosh(), cosine * xi.sinh());
        let slope = Complex64::new(sine * xi.sinh(), cosine * xi.cosh());
        (q * p, q * slope)
    }

    /// Complex time at which the wave of slowness `q` meets the singular slowness `p`.
    fn meeting(&self, q: f64, p: f64) -> Complex64 {
        let p = Complex64::from(p);
        p * self.geometry.offset + vertical_slowness(p, q) * self.geometry.depth
    }

    /// P from its arrival to that of S; t = t_p cosh xi.
    fn p_alone(&self) -> Vec<Node> {
        let Spectrum { a, b, rayleigh, .. } = self.spectrum;
        let (start, stop) = (a * self.distance(), b * self.distance());
        let stop = stop.min(self.geometry.end);
        if stop <= start {
            return Vec::new();
        }
        let singular = [b, rayleigh].map(|p| (self.meeting(a, p) / start).acosh());
        let time = |xi: f64| start * xi.cosh();
        self.integrate(0.0, (stop / start).acosh(), &singular, time, |xi| {
            let (p, slope) = self.hyperbola(a, xi);
            imaginary(self.spectrum.p_wave(p), slope)
        })
    }

    /// S before its own arrival, beyond the critical angle: along the real axis from p = a on, below
    /// the branch point b; t = t_s cos phi.
    fn head_wave(&self) -> Vec<Node> {
        let Spectrum { a, b, rayleigh, .. } = self.spectrum;
        let arrival = b * self.distance();
        let angle = self.geometry.offset.atan2(self.geometry.depth);
        let widest = angle - (a / b).asin();
        if widest <= 0.0 || self.meeting(b, a).re >= self.geometry.end {
            return Vec::new();
        }
        let singular = [
            Complex64::from(widest),
            (self.meeting(b, rayleigh) / arrival).acos(),
        ];
        let time = |phi: f64| arrival * phi.cos();
        self.integrate(0.0, widest, &singular, time, |phi| {
            // Never below a, where the root eta_a would leave the cut by round-off.
            let p = (b * (angle - phi).sin()).max(a);
            let slope = Complex64::from(b * (angle - phi).cos());
            imaginary(self.spectrum.s_wave(p.into()), slope)
        })
    }

    /// P and S together from the arrival of S on; t = t_s cosh xi.
    ///
    /// Both grow late, as their static parts cancel: on common nodes they do so whatever the force.
    fn p_and_s(&self) -> Vec<Node> {
        let Spectrum { a, b, rayleigh, .. } = self.spectrum;
        let Geometry {
            offset, depth, end, ..
        } = self.geometry;
        let distance = self.distance();
        let (p_arrival, s_arrival) = (a * distance, b * distance);
        if end <= s_arrival {
            return Vec::new();
        }
        let singular = [
            Complex64::from(p_arrival),
            self.meeting(a, b),
            self.meeting(a, rayleigh),
            self.meeting(b, a),
            self.meeting(b, rayleigh),
        ]
        .map(|time| (time / s_arrival).acosh());
        let time = |xi: f64| s_arrival * xi.cosh();
        self.integrate(0.0, (end / s_arrival).acosh(), &singular, time, |xi| {
            let (p, slope) = self.hyperbola(b, xi);
            let s_part = imaginary(self.spectrum.s_wave(p), slope);
            let t = time(xi);
            let root = ((t - p_arrival) * (t + p_arrival)).sqrt();
            let p = Complex64::new(offset * t, depth * root) / (distance * distance);
            let slope = Complex64::new(offset, depth * t / root) / (distance * distance);
            let p_part = imaginary(self.spectrum.p_wave(p), slope * s_arrival * xi.sinh());
            std::array::from_fn(|i| s_part[i] + p_part[i])
        })
    }

    /// Depth 0: the paths of both waves fall onto the upper side of the real axis, p = t/x, and the
    /// Rayleigh pole lies on them.
    ///
    /// The limit from above is the principal value, here of a panel centred at the pole, and -i pi
    /// times the residue: the Rayleigh pulse itself.
    fn surface(&self) -> Vec<Node> {
        let Spectrum { a, b, rayleigh, .. } = self.spectrum;
        let Geometry {
            offset, end, panel, ..
        } = self.geometry;
        let last = end / offset;
        let singular = [a, b, rayleigh].map(Complex64::from);
        let half = (0.4 * (rayleigh - b)).min(0.5 * panel / offset);
        let time = |p: f64| p * offset;
        let integrand = |p: f64| imaginary(self.spectrum.surface(p.into()), 1.0.into());
        let mut nodes = Vec::new();
        for (low, high) in [
            (a, b),
            (b, rayleigh - half),
            (rayleigh + half, f64::INFINITY),
        ] {
            let high = high.min(last);
            if low < high {
                nodes.extend(self.integrate(low, high, &singular, time, integrand));
            }
        }
        if rayleigh - half < last {
            self.panel(
                &mut nodes,
                rayleigh - half,
                rayleigh + half,
                &time,
                &integrand,
            );
            nodes.push(Node {
                delay: time(rayleigh),
                weights: self.spectrum.rayleigh_residue().map(|residue| -residue.re),
            });
        }
        nodes
    }

    /// Nodes of the integral of `integrand`/pi over `low`..`high`, with delays `time`.
    ///
    /// Halves panels until each is as far from the `singular` points as it is long, and no longer
    /// than the geometry's panel in time.
    fn integrate(
        &self,
        low: f64,
        high: f64,
        singular: &[Complex64],
        time: impl Fn(f64) -> f64,
        integrand: impl Fn(f64) -> [f64; 4],
    ) -> Vec<Node> {
        let mut nodes = Vec::new();
        let floor = FLOOR * high.abs().max(low.abs());
        let mut waiting = vec![(low, high)];
        while let Some((low, high)) = waiting.pop() {
            let (middle, length) = (0.5 * (low + high), high - low);
            let clear = singular
                .iter()
                .all(|point| (point - middle).norm() >= length);
            let short = (time(high) - time(low)).abs() <= self.geometry.panel;
            if (clear && short) || length <= floor {
                self.panel(&mut nodes, low, high, &time, &integrand);
            } else {
                waiting.push((middle, high));
                waiting.push((low, middle));
            }
        }
        nodes
    }

    fn panel(
        &self,
        nodes: &mut Vec<Node>,
        low: f64,
        high: f64,
        time: &impl Fn(f64) -> f64,
        integrand: &impl Fn(f64) -> [f64; 4],
    ) {
        nodes.extend(self.rule.on(low, high).map(|(place, weight)| Node {
            delay: time(place),
            weights: integrand(place).map(|value| weight * value / PI),
        }));
    }
}

/// Im(G dp/ds), component by component.
fn imaginary(green: Green, slope: Complex64) -> [f64; 4] {
    green.map(|value| (value * slope).im)
}
