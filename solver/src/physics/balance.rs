//! Energy and momentum of a model. With the mass M and the momentum P' in a frame that moves at V,
//!
//! ```text
//! E = E' + V . P' + M V^2/2,   P = P' + M V
//! ```

use super::model::Model;
use crate::points::{BLOCK, blocks};
use crate::tensor::Vector;

impl<const D: usize> Model<D> {
    /// Elastic energy of the target alone or of everything (J, per metre of thickness in 2D).
    pub fn strain_energy(&self, target_only: bool) -> f64 {
        let regions = self.regions.iter().filter(|r| r.in_target || !target_only);
        regions
            .map(|r| {
                r.kernel
                    .strain_energy(self.disc.as_ref(), &self.points, &self.nodes.u)
            })
            .chain(self.flow.iter().map(|flow| flow.strain_energy(target_only)))
            .sum()
    }

    /// Kinetic energy (J) of the target alone or of everything.
    ///
    /// Where nodes keep the motion a point's share is that of its lumped mass, or that of its own
    /// velocity where masses are consistent.
    pub fn kinetic_energy(&self, target_only: bool) -> f64 {
        let own = self.own_kinetic_energy(target_only);
        if self.frame == [0.0; D] {
            return own;
        }
        let (mass, momentum) = (self.mass(target_only), self.own_momentum(target_only));
        let along = self.frame.iter().zip(momentum);
        own + along.map(|(v, p)| v * p + 0.5 * mass * v * v).sum::<f64>()
    }

    /// Linear momentum of everything (kg m/s).
    pub fn momentum(&self) -> Vector<D> {
        let own = self.own_momentum(false);
        if self.frame == [0.0; D] {
            return own;
        }
        let mass = self.mass(false);
        std::array::from_fn(|i| own[i] + mass * self.frame[i])
    }

    /// Mass (kg) of the target alone or of everything.
    fn mass(&self, target_only: bool) -> f64 {
        let regions = self.regions.iter().filter(|r| r.in_target || !target_only);
        let masses = regions.flat_map(|r| &self.points.mass[r.range.clone()]);
        let flow = self.flow.iter().map(|flow| flow.mass(target_only));
        masses.sum::<f64>() + flow.sum::<f64>()
    }

    /// Kinetic energy in the frame.
    fn own_kinetic_energy(&self, target_only: bool) -> f64 {
        let mut energy = 0.0;
        let mut squares = [[0.0; D]; BLOCK];
        let squared: Vec<Vector<D>> = self.nodes.v.iter().map(|v| v.map(|x| x * x)).collect();
        for region in self.regions.iter().filter(|r| r.in_target || !target_only) {
            for block in blocks(region.range.clone()) {
                let squares = &mut squares[..block.len()];
                match &self.points.motion {
                    Some(motion) if block.end <= motion.v.len() => {
                        for (s, v) in squares.iter_mut().zip(&motion.v[block.clone()]) {
                            *s = v.map(|x| x * x);
                        }
                    }
                    _ if self.consistent.is_some() => {
                        self.disc.gather(block.clone(), &self.nodes.v, squares);
                        for s in squares.iter_mut() {
                            *s = s.map(|x| x * x);
                        }
                    }
                    _ => self.disc.gather(block.clone(), &squared, squares),
                }
                for (s, m) in squares.iter().zip(&self.points.mass[block]) {
                    energy += 0.5 * m * s.iter().sum::<f64>();
                }
            }
        }
        let flow = self.flow.iter().map(|f| f.kinetic_energy(target_only));
        energy + flow.sum::<f64>()
    }

    /// Momentum in the frame.
    fn own_momentum(&self, target_only: bool) -> Vector<D> {
        let mut sum = [0.0; D];
        let mut velocity = [[0.0; D]; BLOCK];
        let regions = self.regions.iter().filter(|r| r.in_target || !target_only);
        for block in regions.flat_map(|r| blocks(r.range.clone())) {
            let velocity = &mut velocity[..block.len()];
            match &self.points.motion {
                Some(motion) if block.end <= motion.v.len() => {
                    velocity.copy_from_slice(&motion.v[block.clone()]);
                }
                _ => self.disc.gather(block.clone(), &self.nodes.v, velocity),
            }
            for (v, m) in velocity.iter().zip(&self.points.mass[block]) {
                for i in 0..D {
                    sum[i] += m * v[i];
                }
            }
        }
        if let Some(flow) = &self.flow {
            let own = flow.momentum(target_only);
            for i in 0..D {
                sum[i] += own[i];
            }
        }
        sum
    }
}
