//! Energy and momentum of a model.

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

    /// Linear momentum of everything (kg m/s).
    pub fn momentum(&self) -> Vector<D> {
        let mut sum = [0.0; D];
        let mut velocity = [[0.0; D]; BLOCK];
        for block in blocks(0..self.points.len()) {
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
            let own = flow.momentum();
            for i in 0..D {
                sum[i] += own[i];
            }
        }
        sum
    }
}
