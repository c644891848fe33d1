//! How many points there are of each kind.

use crate::boundary::LayerPoints;
use crate::geometry::{Geometry, Owner};
use crate::problem::Problem;

/// Points by who handles them.
pub(super) struct Counts {
    /// The material's own kernel.
    pub(super) bulk: usize,
    /// Those of them in the body.
    pub(super) target: usize,
    /// Method, how its points behave, their number.
    layers: Vec<(&'static str, LayerPoints, usize)>,
    /// Points in the layers of several sides.
    pub(super) overlap: usize,
}

impl Counts {
    /// Those of a problem, laid out.
    pub(super) fn of<const D: usize>(problem: &Problem<D>, geometry: &Geometry<D>) -> Self {
        let mut counts = Counts {
            bulk: 0,
            target: 0,
            layers: Vec::new(),
            overlap: 0,
        };
        let along = geometry.material_cells_along();
        for cell in 0..along.iter().product() {
            let centre = geometry.cell_centre(cell);
            if geometry.layers_at(&problem.target, &centre) > 1 {
                counts.overlap += problem.points_per_cell;
            }
            match geometry.owner(problem, &centre) {
                Owner::Target | Owner::Inclusion => counts.target += problem.points_per_cell,
                Owner::Outside => counts.bulk += problem.points_per_cell,
                Owner::Layer(name, kind) => {
                    let mut layers = counts.layers.iter_mut();
                    match layers.find(|(n, k, _)| (*n, *k) == (name, kind)) {
                        Some((.., points)) => *points += problem.points_per_cell,
                        None => counts.layers.push((name, kind, problem.points_per_cell)),
                    }
                }
            }
        }
        counts.bulk += counts.target;
        counts
    }

    /// Points of a method's own layer.
    pub(super) fn layer(&self, method: &str) -> usize {
        let own = self.layers.iter().filter(|(name, ..)| *name == method);
        own.map(|(.., points)| points).sum()
    }

    /// Points that carry the motion, when any do.
    pub(super) fn carrying(&self) -> usize {
        let carried = |(_, kind, _): &&(_, LayerPoints, _)| *kind == LayerPoints::Carried;
        let layers = self.layers.iter().filter(carried);
        self.bulk + layers.map(|(.., points)| points).sum::<usize>()
    }

    /// All points.
    pub(super) fn all(&self) -> usize {
        self.bulk + self.layers.iter().map(|(.., points)| points).sum::<usize>()
    }
}
