//! What points that explicit steps move keep and cost: see [`crate::flow`].

use super::{Clerk, Item};
use crate::material::strength::Strength;
use crate::problem::{BasisKind, PointMode, Transfer};

/// CPU times (ns) of a point in a step, both passes and sorting. `cargo bench -p anechoic-solver --bench
/// flow` on a core of a server of 2023: a million points, two dimensions.
const LINEAR: f64 = 22.0;
const WIDE: f64 = 36.0;
/// More of it for gradients that points carry, for the laws that flow, for the cells' volumes.
const GRADIENTS: f64 = 8.0;
const VON_MISES: f64 = 10.0;
const HERSCHEL_BULKLEY: f64 = 30.0;
const MEAN_VOLUMES: f64 = 27.0;

impl<const D: usize> Clerk<'_, D> {
    /// Does explicit motion carry the body's points?
    pub(super) fn flows(&self) -> bool {
        self.is_explicit() && self.problem.point_mode == PointMode::Moving
    }

    /// Points that flow.
    pub(super) fn flowing_points(&self) -> usize {
        if self.flows() { self.counts.bulk } else { 0 }
    }

    /// Their motion twice, for sorting, their stress once, and two keys.
    pub(super) fn flowing(&self) -> Item {
        let affine = self.problem.transfer == Transfer::Affine;
        let flow = &self.problem.flow;
        let numbers = |matrices: usize| 2 * D + matrices * D * D;
        let symmetric = D * (D + 1) / 2;
        // in plane strain a law that flows keeps the stress across the plane
        let across = usize::from(D == 2 && flow.strength != Strength::Elastic);
        let state = symmetric + across;
        let mut ns = match self.problem.basis {
            BasisKind::Linear => LINEAR,
            BasisKind::Gimp | BasisKind::Bspline => WIDE,
        };
        ns += match flow.strength {
            Strength::Elastic => 0.0,
            Strength::VonMises { .. } => VON_MISES,
            Strength::HerschelBulkley(_) => HERSCHEL_BULKLEY,
        };
        if affine {
            ns += GRADIENTS;
        }
        if flow.mean_volumes {
            ns += MEAN_VOLUMES;
        }
        let name = format!("{:?} transfer, explicit", self.problem.transfer).to_lowercase();
        Item {
            points: self.flowing_points(),
            bytes_per_point: 8 * (2 * numbers(usize::from(affine)) + state) + 16,
            step_s: Self::time(self.flowing_points(), ns),
            ..self.item(
                &name,
                "place, velocity, its gradient where affine, stress; sorted",
            )
        }
    }
}
