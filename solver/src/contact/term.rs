//! A rigid body as a term on nodes: which of them it touches in a step, what that does to their
//! velocities, and what the soil does to it.

use super::{Contact, point_gap, reaction};
use crate::contact::body::RigidBody;
use crate::contact::shape::Distance;
use crate::grid::Grid;
use crate::physics::kernel::{NodeTerm, Reading, Step};
use crate::problem::Intruder;
use crate::tensor::Vector;

/// The body with its work space. In three dimensions it is a prism along z.
pub(crate) struct Touch<const D: usize> {
    name: String,
    body: RigidBody,
    contact: Contact,
    grid: Grid<D>,
    /// Half of a point's edges (m).
    half_extent: Vector<D>,
    /// How far from a point lie the nodes that it reaches (m).
    reach: Vector<D>,
    /// Step in which a point that touches has last reached each node.
    reached: Vec<u32>,
    /// Of the fastest wave (m/s).
    speed: f64,
    /// Velocity (m/s) of the frame that places and velocities are in.
    frame: Vector<D>,
    step: u32,
    impulse: Vector<D>,
    dt: f64,
    end: f64,
    deepest: f64,
}

impl<const D: usize> Touch<D> {
    /// Of `intruder` with material of wave `speed` (m/s) on `grid`, filled with `per_axis` points along
    /// each axis of a cell, each reaching nodes within `reach` cells; all in a frame that moves at
    /// `frame` (m/s).
    pub(crate) fn new(
        intruder: &Intruder,
        grid: &Grid<D>,
        per_axis: usize,
        reach: f64,
        speed: f64,
        frame: Vector<D>,
    ) -> Self {
        Touch {
            name: intruder.name.clone(),
            body: intruder.body,
            contact: intruder.contact,
            half_extent: grid.h.map(|h| 0.5 * h / per_axis as f64),
            reach: grid.h.map(|h| reach * h),
            speed,
            frame,
            reached: vec![0; grid.node_count()],
            grid: grid.clone(),
            step: 0,
            impulse: [0.0; D],
            dt: 1.0,
            end: 0.0,
            deepest: 0.0,
        }
    }

    /// Distance of the place `x` (m) and normal, at `time` (s).
    #[inline]
    fn distance(&self, x: &Vector<D>, time: f64) -> Distance {
        let [x, y] = [0, 1].map(|a| x[a] + self.frame[a] * time);
        self.body.distance(&[x, y], time)
    }

    /// Marks the nodes that touching points reach, and looks for the deepest point.
    fn look(&mut self, places: &[Vector<D>], time: f64) {
        self.step += 1;
        self.deepest = 0.0;
        for x in places {
            let distance = self.distance(x, time);
            self.deepest = self.deepest.max(-distance.gap);
            let normal = in_space(distance.normal);
            if point_gap(distance.gap, &self.half_extent, &normal) <= 0.0 {
                self.mark(x);
            }
        }
    }

    /// Marks the nodes within reach of `x`.
    fn mark(&mut self, x: &Vector<D>) {
        let mut first = [0; D];
        let mut counts = [0; D];
        for a in 0..D {
            let s = (x[a] - self.grid.origin[a]) / self.grid.h[a];
            let r = self.reach[a] / self.grid.h[a];
            let last = ((s + r).floor() as usize).min(self.grid.cells[a]);
            first[a] = (s - r).ceil().max(0.0) as usize;
            counts[a] = (last + 1).saturating_sub(first[a]);
        }
        for k in 0..counts.iter().product() {
            let mut rest = k;
            let index = std::array::from_fn(|a| {
                let i = first[a] + rest % counts[a];
                rest /= counts[a];
                i
            });
            self.reached[self.grid.node(index)] = self.step;
        }
    }
}

/// The plane's vector in D dimensions.
fn in_space<const D: usize>(plane: Vector<2>) -> Vector<D> {
    std::array::from_fn(|a| if a < 2 { plane[a] } else { 0.0 })
}

impl<const D: usize> NodeTerm<D> for Touch<D> {
    fn correct(&mut self, step: &Step<'_, D>, v: &mut [Vector<D>]) {
        let [start, end] = step.times;
        self.look(step.places, start);
        (self.dt, self.end) = (end - start, end);
        self.impulse = [0.0; D];
        let own: Vector<D> = in_space(self.body.velocity(start, self.dt));
        let velocity = std::array::from_fn(|a| own[a] - self.frame[a]);
        let h = self.grid.h[..2].iter().copied().fold(0.0, f64::max);
        let courant = self.speed * self.dt / h;
        for (node, v) in v.iter_mut().enumerate() {
            if self.reached[node] != self.step || step.mass[node][0] <= 0.0 {
                continue;
            }
            let x = self.grid.node_place(node);
            let distance = self.distance(&x, start);
            // a point that touches has reached the node
            let share = self.contact.share(distance.gap, 0.0, h, courant);
            let normal = in_space(distance.normal);
            let mass = step.mass[node][0];
            if let Some(response) = self.contact.respond(mass, v, &velocity, &normal, share) {
                *v = response.velocity;
                for i in 0..D {
                    self.impulse[i] += response.impulse[i];
                }
            }
        }
    }

    fn reading(&self) -> Option<Reading<'_>> {
        let force = reaction([&self.impulse], self.dt);
        Some(Reading {
            name: &self.name,
            force: [force[0], force[1]],
            way: self.body.motion.way(self.end),
            penetration: self.deepest,
        })
    }
}
