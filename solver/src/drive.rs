//! What sets the body in motion: driven sides and point forces.

use crate::basis::{Discretisation, Sample};
use crate::grid::Grid;
use crate::physics::kernel::{Constraints, Driven, NodeTerm};
use crate::problem::Side;
use crate::tensor::Vector;
use crate::wavelet::Pulse;

/// The normal velocity of a side follows a pulse while it lasts; the side is free afterwards.
///
/// All nodes at or beyond the moving surface are driven, so that the drive keeps hold of the body
/// when the surface leaves its first row of nodes.
pub(crate) struct SideDrive<const D: usize> {
    side: Side,
    pulse: Pulse,
    /// Nodes with their distance inwards from where the surface starts (m), along the axis.
    nodes: Vec<(u32, f64)>,
    moving: bool,
    tolerance: f64,
}

impl<const D: usize> SideDrive<D> {
    pub(crate) fn new(grid: &Grid<D>, side: Side, plane: f64, pulse: Pulse, moving: bool) -> Self {
        let h = grid.h[side.axis];
        let nodes = (0..grid.node_count())
            .map(|n| (n as u32, grid.node_place(n)[side.axis] - plane))
            .filter(|(_, x)| {
                if moving {
                    x.abs() < 4.0 * h
                } else {
                    x.abs() < 1e-6 * h
                }
            })
            .collect();
        SideDrive {
            side,
            pulse,
            nodes,
            moving,
            tolerance: 1e-6 * h,
        }
    }
}

impl<const D: usize> NodeTerm<D> for SideDrive<D> {
    fn constrain(&self, times: [f64; 2], out: &mut Constraints<D>) {
        // a step that ends a rounding error after the pulse still belongs to it
        let slack = 1e-9 * self.pulse.end();
        if times[1] > self.pulse.end() + slack {
            return;
        }
        let at = times.map(|t| t.min(self.pulse.end()));
        let driven = Driven {
            velocity: at.map(|t| self.pulse.value(t)),
            acceleration: at.map(|t| self.pulse.rate(t)),
        };
        let surface = if self.moving {
            self.pulse.integral(at[0])
        } else {
            0.0
        };
        // a surface that is pulled outwards leaves the nodes that it started with behind
        let outwards = if self.side.upper { surface } else { -surface };
        let reach = self.tolerance + outwards.max(0.0);
        for &(node, x) in &self.nodes {
            let beyond = if self.side.upper {
                x - surface
            } else {
                surface - x
            };
            if beyond >= -reach {
                out.held[node as usize][self.side.axis] = true;
                out.driven.push((node, self.side.axis as u8, driven));
            }
        }
    }
}

/// A force on a point of the material.
pub(crate) struct PointForce<const D: usize> {
    place: Vector<D>,
    direction: Vector<D>,
    pulse: Pulse,
    sample: Sample,
    moving: bool,
}

impl<const D: usize> PointForce<D> {
    pub(crate) fn new(place: Vector<D>, direction: Vector<D>, pulse: Pulse, moving: bool) -> Self {
        PointForce {
            place,
            direction,
            pulse,
            sample: Sample::default(),
            moving,
        }
    }
}

impl<const D: usize> NodeTerm<D> for PointForce<D> {
    fn attach(&mut self, disc: &dyn Discretisation<D>) -> Result<(), Vector<D>> {
        disc.sample_into(&self.place, &mut self.sample);
        if self.sample.nodes.is_empty() {
            Err(self.place)
        } else {
            Ok(())
        }
    }

    fn force(&self, t: f64, _v: &[Vector<D>], active: &[bool], out: &mut [Vector<D>]) {
        let force = self.pulse.value(t);
        let total = self.sample.active_weight(active);
        for (&node, w) in self.sample.nodes.iter().zip(&self.sample.weights) {
            if active[node as usize] {
                for i in 0..D {
                    out[node as usize][i] += w / total * force * self.direction[i];
                }
            }
        }
    }

    fn advance(
        &mut self,
        disc: &dyn Discretisation<D>,
        increment: &[Vector<D>],
        active: &[bool],
    ) -> Result<(), Vector<D>> {
        if !self.moving {
            return Ok(());
        }
        let step = self.sample.interpolate(increment, active);
        for i in 0..D {
            self.place[i] += step[i];
        }
        self.attach(disc)
    }
}
