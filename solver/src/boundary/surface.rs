//! Quadrature points on a side of the body, attached to the material.

use super::Context;
use crate::basis::{Discretisation, Sample};
use crate::problem::Side;
use crate::tensor::Vector;

/// Massless points on a side, two Gauss points a cell edge (exact for products of linear shape
/// functions), each with its share of the area.
#[derive(Clone, Debug)]
pub struct Surface<const D: usize> {
    /// Places (m).
    pub places: Vec<Vector<D>>,
    /// Area of each (m2, per metre of thickness in 2D).
    pub area: f64,
    /// Nodes and weights of each.
    pub samples: Vec<Sample>,
}

impl<const D: usize> Surface<D> {
    /// Points on `side` of the body; their nodes are found by [`Surface::attach`].
    pub fn new(context: &Context<'_, D>, side: Side) -> Self {
        let h = context.grid.h;
        let mut area = 1.0;
        let gauss = 0.5 / 3.0_f64.sqrt();
        let offsets = [0.5 - gauss, 0.5 + gauss];
        let mut origin = context.target.lower;
        origin[side.axis] = context.plane(side);
        let mut places = vec![origin];
        for axis in (0..D).filter(|&a| a != side.axis) {
            let length = context.target.upper[axis] - context.target.lower[axis];
            let cells = (length / h[axis]).round() as usize;
            area *= 0.5 * h[axis];
            places = places
                .iter()
                .flat_map(|x| {
                    (0..cells).flat_map(move |c| {
                        offsets.map(|o| {
                            let mut x = *x;
                            x[axis] += h[axis] * (c as f64 + o);
                            x
                        })
                    })
                })
                .collect();
        }
        Surface {
            places,
            area,
            samples: Vec::new(),
        }
    }

    /// Finds the nodes of the points.
    pub fn attach(&mut self, disc: &dyn Discretisation<D>) -> Result<(), Vector<D>> {
        self.samples.clear();
        for x in &self.places {
            let sample = disc.sample(x);
            if sample.nodes.is_empty() {
                return Err(*x);
            }
            self.samples.push(sample);
        }
        Ok(())
    }

    /// Moves the points with the material.
    pub fn advance(
        &mut self,
        disc: &dyn Discretisation<D>,
        increment: &[Vector<D>],
        active: &[bool],
    ) -> Result<(), Vector<D>> {
        for (x, sample) in self.places.iter_mut().zip(&self.samples) {
            let step = sample.interpolate(increment, active);
            for i in 0..D {
                x[i] += step[i];
            }
        }
        self.attach(disc)
    }
}
