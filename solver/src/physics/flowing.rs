//! Points that explicit steps move, and what they give to the nodes: masses, momenta, and the forces of
//! stress and weight.
//!
//! Plain material outside the body and the body itself flow alike; each of the two is a part of its
//! own, so that energies of the target can be told from the whole.

use super::kernel::Lumped;
use super::model::Model;
use crate::error::SolverError;
use crate::flow::surface::Surface;
use crate::flow::{Flow, NodeSums};
use crate::grid::Grid;
use crate::problem::StressUpdate;
use crate::tensor::{Vector, trace};

/// Points that explicit steps move.
pub struct Flowing<const D: usize> {
    /// The points, those of the target first.
    parts: Vec<Box<dyn Flow<D>>>,
    sums: NodeSums<D>,
    /// Nodes that wide functions barely reach; `None` for functions that are not wide.
    surface: Option<Surface<D>>,
    /// Weight over mass (m/s2).
    gravity: Vector<D>,
    update: StressUpdate,
    /// Forces that hold layers at rest under the weight and the stress that they start with (N); empty
    /// where there are none.
    resting: Vec<Vector<D>>,
}

impl<const D: usize> Flowing<D> {
    /// The points of the target and those outside it, on so many nodes, of which `surface` knows those
    /// that are barely reached.
    pub fn new(
        parts: Vec<Box<dyn Flow<D>>>,
        nodes: usize,
        surface: Option<Surface<D>>,
        gravity: Vector<D>,
        update: StressUpdate,
        resting: Vec<Vector<D>>,
    ) -> Self {
        Flowing {
            parts,
            sums: NodeSums::new(nodes),
            surface,
            gravity,
            update,
            resting,
        }
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.parts.iter().map(|part| part.len()).sum()
    }

    /// Are there none?
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Places (m) of the target's points.
    pub fn places(&self) -> &[Vector<D>] {
        self.parts.first().map_or(&[], |part| part.places())
    }

    /// The points of the target.
    pub fn target(&self) -> Option<&dyn Flow<D>> {
        self.parts.first().map(AsRef::as_ref)
    }

    /// Adds their masses.
    pub fn lump(&self, out: &mut Lumped<D>) {
        for (out, m) in out.mass.iter_mut().zip(&self.sums.mass) {
            for x in out {
                *x += m;
            }
        }
    }

    /// Adds the forces of stress and weight.
    pub fn add_forces(&self, out: &mut [Vector<D>]) {
        let sums = &self.sums;
        for (out, (f, m)) in out.iter_mut().zip(sums.force.iter().zip(&sums.mass)) {
            for i in 0..D {
                out[i] += f[i] + m * self.gravity[i];
            }
        }
        for (out, f) in out.iter_mut().zip(&self.resting) {
            for i in 0..D {
                out[i] += f[i];
            }
        }
    }

    /// Pressure (Pa, in the plane in 2D) in each cell of the grid, under the number of its lowest node: the mean over
    /// the target's points there, 0 where there is none.
    pub fn pressures(&self, grid: &Grid<D>) -> Vec<f64> {
        let mut sums = vec![[0.0; 2]; grid.node_count()];
        let Some(target) = self.target() else {
            return vec![0.0; sums.len()];
        };
        for (p, x) in target.places().iter().enumerate() {
            if let Some((cell, _)) = grid.locate(x) {
                let [total, number] = &mut sums[grid.node(cell)];
                *total -= trace(&target.stress(p)) / D as f64;
                *number += 1.0;
            }
        }
        let mean = |[total, number]: [f64; 2]| total / number.max(1.0);
        sums.into_iter().map(mean).collect()
    }

    fn of_target(&self, target_only: bool) -> impl Iterator<Item = &dyn Flow<D>> {
        let shown = if target_only { 1 } else { self.parts.len() };
        self.parts[..shown].iter().map(AsRef::as_ref)
    }

    /// Elastic energy (J).
    pub fn strain_energy(&self, target_only: bool) -> f64 {
        self.of_target(target_only).map(Flow::strain_energy).sum()
    }

    /// Mass (kg).
    pub fn mass(&self, target_only: bool) -> f64 {
        let masses = self.of_target(target_only);
        masses
            .map(|part| part.len() as f64 * part.point_mass())
            .sum()
    }

    /// Kinetic energy (J).
    pub fn kinetic_energy(&self, target_only: bool) -> f64 {
        self.of_target(target_only).map(Flow::kinetic_energy).sum()
    }

    /// Momentum (kg m/s).
    pub fn momentum(&self, target_only: bool) -> Vector<D> {
        let mut sum = [0.0; D];
        for part in self.of_target(target_only) {
            let own = part.total_momentum();
            for i in 0..D {
                sum[i] += own[i];
            }
        }
        sum
    }
}

impl<const D: usize> Model<D> {
    /// Points to nodes.
    pub(super) fn collect_flow(&mut self) -> Result<(), SolverError> {
        let Some(flow) = &mut self.flow else {
            return Ok(());
        };
        flow.sums.clear();
        for part in &mut flow.parts {
            let moment = self.moment;
            part.to_nodes(&mut flow.sums).map_err(|f| f.at(moment))?;
        }
        if let Some(surface) = &mut flow.surface {
            surface.fold(&mut flow.sums);
        }
        let nodes = &mut self.nodes;
        for (saved, &n) in self.kept.saved.iter_mut().zip(&self.kept.nodes) {
            saved.0 = nodes.v[n as usize];
        }
        velocities(&flow.sums.momentum, &flow.sums.mass, &mut nodes.v);
        for (saved, &n) in self.kept.saved.iter().zip(&self.kept.nodes) {
            nodes.v[n as usize] = saved.0;
        }
        Ok(())
    }

    /// Nodes to points.
    pub(super) fn move_flow(&mut self) -> Result<(), SolverError> {
        let Some(flow) = &mut self.flow else {
            return Ok(());
        };
        if let Some(surface) = &flow.surface {
            surface.follow(&mut self.nodes.v);
            surface.follow(&mut self.nodes.a);
        }
        let (nodes, moment, dt) = (&self.nodes, self.moment, self.dt);
        if flow.update == StressUpdate::Usl {
            for part in &mut flow.parts {
                let moved = part.to_points(&nodes.v, &nodes.a, dt);
                moved.map_err(|f| f.at(moment))?;
            }
            return Ok(());
        }
        flow.sums.momentum.fill([0.0; D]);
        for part in &mut flow.parts {
            let kicked = part.kick(&nodes.v, &nodes.a, dt);
            kicked.map_err(|f| f.at(moment))?;
            let sent = part.momentum(&mut flow.sums.momentum);
            sent.map_err(|f| f.at(moment))?;
        }
        if let Some(surface) = &flow.surface {
            surface.fold_field(&mut flow.sums.momentum);
        }
        // what is held, driven or kept by a layer stays as the step has found it
        let mut again = std::mem::take(&mut self.work);
        velocities(&flow.sums.momentum, &flow.sums.mass, &mut again);
        for &n in &self.kept.nodes {
            again[n as usize] = nodes.v[n as usize];
        }
        for (n, held) in self.constraints.held.iter().enumerate() {
            for i in 0..D {
                if held[i] {
                    again[n][i] = nodes.v[n][i];
                }
            }
        }
        if let Some(surface) = &flow.surface {
            surface.follow(&mut again);
        }
        for part in &mut flow.parts {
            let drifted = part.drift(&again, dt);
            drifted.map_err(|f| f.at(moment))?;
        }
        self.work = again;
        Ok(())
    }
}

/// Momenta over masses; 0 where there is no mass.
fn velocities<const D: usize>(momentum: &[Vector<D>], mass: &[f64], out: &mut [Vector<D>]) {
    for (v, (p, m)) in out.iter_mut().zip(momentum.iter().zip(mass)) {
        *v = if *m > 0.0 { p.map(|p| p / m) } else { [0.0; D] };
    }
}
