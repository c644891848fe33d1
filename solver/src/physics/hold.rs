//! Held, driven and released unknowns of a model.

use super::model::Model;
use crate::problem::Transfer;
use crate::time::{Motion, System};

impl<const D: usize> Model<D> {
    /// Holds unknowns for the step and puts the driven ones on their motion.
    pub(super) fn constrain(&mut self) {
        let before = std::mem::take(&mut self.constraints.driven);
        self.constraints.clear();
        for (held, active) in self.constraints.held.iter_mut().zip(&self.nodes.active) {
            *held = [!active; D];
        }
        for term in &self.terms {
            term.constrain(self.times, &mut self.constraints);
        }
        let (nodes, constraints) = (&mut self.nodes, &self.constraints);
        for ((held, v), a) in constraints.held.iter().zip(&mut nodes.v).zip(&mut nodes.a) {
            for i in 0..D {
                if held[i] {
                    (v[i], a[i]) = (0.0, 0.0);
                }
            }
        }
        for &(node, i, motion) in &constraints.driven {
            nodes.v[node as usize][i as usize] = motion.velocity[0];
            nodes.a[node as usize][i as usize] = motion.acceleration[0];
        }
        if self.explicit {
            // between steps a velocity is all that an unknown has
            return;
        }
        let released: Vec<(usize, usize)> = before
            .iter()
            .map(|&(node, i, _)| (node as usize, i as usize))
            .filter(|&(node, i)| !constraints.held[node][i])
            .collect();
        if self.transfer == Transfer::Keep && !released.is_empty() {
            self.release(&released);
        }
    }

    /// An unknown that is let go takes the acceleration that balances the forces on it.
    fn release(&mut self, released: &[(usize, usize)]) {
        let rest = vec![[0.0; D]; self.nodes.v.len()];
        let v = self.nodes.v.clone();
        let mut residual = rest.clone();
        let end = self.times[1];
        self.times[1] = self.times[0];
        let motion = Motion {
            increment: &rest,
            v: &v,
            a: &rest,
        };
        let balanced = System::residual(self, &motion, &mut residual);
        self.times[1] = end;
        if balanced.is_ok() {
            for &(node, i) in released {
                self.nodes.a[node][i] = residual[node][i] / self.nodes.lumped.mass[node][i];
            }
        }
    }
}
