//! A column struck by a wall, in explicit steps of its own: when contact starts, and with what force.
//!
//! Units of the column: density, wave speed and cell edge are 1. Its stress is M ln s, so that the
//! struck part moves with the wall behind a shock of speed U (by the length of the start):
//! p = M (-ln s)/s = U V, 1 - s = V/U.

use super::super::{Contact, point_gap};
use crate::basis::along::Basis;
use crate::basis::gimp::Gimp;

const CELLS: usize = 120;
const PER_CELL: usize = 4;
/// Speed of the wall, the pipe's share of its soil's wave speed.
const SPEED: f64 = 1.0 / 36.0;
/// Way of the wall before it touches.
const GAP: f64 = 1.3;
const STEP: f64 = 0.4;

/// p / (rho c V) behind the shock, by bisection on the stretch.
fn exact() -> f64 {
    let (mut low, mut high) = (0.5_f64, 0.9999);
    for _ in 0..80 {
        let s = 0.5 * (low + high);
        if -s.ln() / s * (1.0 - s) > SPEED * SPEED {
            low = s;
        } else {
            high = s;
        }
    }
    -low.ln() / low / SPEED
}

/// What a run shows: lengths in cells, pressure over rho c V.
#[derive(Debug)]
struct Blow {
    /// Where the wall is before the surface when it first feels a fifth of rho c V.
    early: f64,
    /// Mean pressure once the wall is a cell into the column.
    mean: f64,
    /// Standard deviation over the mean.
    scatter: f64,
    /// How far the outermost point's edge gets past the wall.
    depth: f64,
}

struct Column {
    place: Vec<f64>,
    velocity: Vec<f64>,
    stress: Vec<f64>,
    volume: f64,
    basis: Gimp,
}

impl Column {
    /// From 0 up to `top`, at rest, the grid's first node two cells below.
    fn new(top: f64) -> Self {
        let points = (top * PER_CELL as f64).round() as usize;
        let volume = top / points as f64;
        Column {
            place: (0..points).map(|p| (p as f64 + 0.5) * volume).collect(),
            velocity: vec![0.0; points],
            stress: vec![0.0; points],
            volume,
            basis: Gimp::new(PER_CELL),
        }
    }

    /// Nodes with value and slope of the point `p`.
    fn nodes(&self, p: usize) -> impl Iterator<Item = (usize, f64, f64)> + use<> {
        let along = self.basis.point(self.place[p] + 2.0, CELLS + 5);
        let entry = move |k| {
            let node = (along.first + k as i32) as usize;
            (node, along.values[k], along.slopes[k])
        };
        (0..3).map(entry).filter(|n| n.1 > 0.0)
    }

    /// One step under a wall at `wall`; returns its force.
    fn step(&mut self, wall: f64, contact: &Contact, by_points: bool) -> f64 {
        let nodes = CELLS + 6;
        let (mut mass, mut momentum) = (vec![0.0; nodes], vec![0.0; nodes]);
        let mut force = vec![0.0; nodes];
        let mut least = vec![if by_points { f64::INFINITY } else { 0.0 }; nodes];
        for p in 0..self.place.len() {
            let gap = point_gap(wall - self.place[p], &[0.5 * self.volume], &[-1.0]);
            for (n, value, slope) in self.nodes(p) {
                mass[n] += value * self.volume;
                momentum[n] += value * self.volume * self.velocity[p];
                force[n] -= slope * self.volume * self.stress[p];
                least[n] = f64::min(least[n], gap);
            }
        }
        let (mut before, mut after, mut impulse) = (vec![0.0; nodes], vec![0.0; nodes], 0.0);
        for n in (0..nodes).filter(|&n| mass[n] > 1e-12) {
            let place = n as f64 - 2.0;
            before[n] = momentum[n] / mass[n];
            if place <= 0.0 {
                continue; // the held base
            }
            after[n] = before[n] + STEP * force[n] / mass[n];
            let share = contact.share(wall - place, least[n], 1.0, STEP);
            let trial = [after[n]];
            if let Some(r) = contact.respond(mass[n], &trial, &[-SPEED], &[-1.0], share) {
                after[n] = r.velocity[0];
                impulse -= r.impulse[0];
            }
        }
        for p in 0..self.place.len() {
            let (mut change, mut moved, mut rate) = (0.0, 0.0, 0.0);
            for (n, value, slope) in self.nodes(p) {
                change += value * (after[n] - before[n]);
                moved += value * after[n];
                rate += slope * after[n];
            }
            self.velocity[p] += change;
            self.place[p] += STEP * moved;
            self.stress[p] += STEP * rate / (1.0 + 0.5 * STEP * rate);
        }
        impulse / STEP
    }
}

/// A column that ends `offset` into a cell, struck while the wave runs down and most of the way up.
fn blow(offset: f64, reach: f64, by_points: bool) -> Blow {
    let contact = Contact {
        friction: 0.0,
        reach,
    };
    let top = CELLS as f64 + offset;
    let mut column = Column::new(top);
    let (mut early, mut depth) = (None, f64::NEG_INFINITY);
    let mut pressures = Vec::new();
    let steps = ((GAP / SPEED + 1.8 * CELLS as f64) / STEP) as usize;
    for step in 0..steps {
        let wall = |step: usize| top + GAP - SPEED * STEP * step as f64;
        let pressure = column.step(wall(step), &contact, by_points) / SPEED;
        let way_left = wall(step) - top;
        if pressure > 0.2 && early.is_none() {
            early = Some(way_left);
        }
        if way_left < -1.0 {
            pressures.push(pressure);
            let edge = |x: f64| x + 0.5 * column.volume - wall(step + 1);
            depth = column.place.iter().copied().map(edge).fold(depth, f64::max);
        }
    }
    let count = pressures.len() as f64;
    let mean = pressures.iter().sum::<f64>() / count;
    let variance = pressures.iter().map(|p| (p - mean).powi(2)).sum::<f64>() / count;
    Blow {
        early: early.expect("the column touches"),
        mean,
        scatter: variance.sqrt() / mean,
        depth,
    }
}

const OFFSETS: [f64; 4] = [0.0, 0.25, 0.5, 0.75];

/// The widest reach that keeps a body's outline within a quarter of a cell.
const REACH: f64 = 0.75;

#[test]
fn with_points_that_touch_the_blow_comes_in_time_and_with_its_force() {
    for offset in OFFSETS {
        let own = blow(offset, REACH, true);
        assert!(own.early.abs() < 0.03, "{own:?}");
        assert!((own.mean - exact()).abs() < 0.01, "{own:?} {}", exact());
        assert!(own.scatter < 0.05, "{own:?}");
        assert!((0.0..0.1).contains(&own.depth), "{own:?}");
    }
}

#[test]
fn a_wider_reach_is_smoother_and_none_lets_points_in() {
    for offset in OFFSETS {
        let [none, own, wide] = [0.0, REACH, 1.5].map(|reach| blow(offset, reach, true));
        for blow in [&none, &wide] {
            assert!(blow.early.abs() < 0.05, "{blow:?}");
            assert!((blow.mean - exact()).abs() < 0.02, "{blow:?}");
        }
        assert!(none.scatter > 1.5 * own.scatter, "{none:?} {own:?}");
        assert!(own.scatter > 1.2 * wide.scatter, "{own:?} {wide:?}");
        assert!(none.depth > 1.5 * own.depth && own.depth > wide.depth);
        assert!((0.1..0.25).contains(&none.depth), "{none:?}");
    }
}

/// What the points' gap is for: by nodes alone the wall strikes before it is there.
#[test]
fn by_nodes_alone_contact_comes_early() {
    for reach in [0.0, REACH] {
        let early = OFFSETS.map(|offset| blow(offset, reach, false).early);
        assert!(early.iter().any(|&early| early > 0.6), "{early:?}");
    }
}
