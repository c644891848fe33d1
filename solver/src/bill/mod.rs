//! What a problem uses and what that costs, known before it is solved: one line a feature.
//!
//! Memory is counted from the columns that a feature names, time from the passes over points and nodes
//! that it makes in a step, at measured [`prices`].

mod counts;
mod flowing;
mod prices;

use crate::basis::{Discretisation, on_grid};
use crate::boundary;
use crate::boundary::params::Upkeep;
use crate::error::SolverError;
use crate::geometry::Geometry;
use crate::grid::Grid;
use crate::points::Points;
use crate::problem::{MassKind, PointMode, Problem, Scheme, Transfer};
use crate::tensor::{Matrix, Vector};
use counts::Counts;
use prices::{BALANCE, PLACE, Prices, STEP, solve_in_iterations};

/// One feature in use.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// Its name, for example `bspline basis` or `pml of 200 m: left, right, bottom`.
    pub feature: String,
    /// What it keeps.
    pub holds: String,
    /// Points that carry it.
    pub points: usize,
    /// Bytes of each of them.
    pub bytes_per_point: usize,
    /// Bytes of each node of the background grid.
    pub bytes_per_node: usize,
    /// Bytes of what it records.
    pub record_bytes: usize,
    /// CPU time in a step, about (s).
    pub step_s: f64,
}

/// What a problem uses and what that costs.
#[derive(Clone, Debug, PartialEq)]
pub struct Bill {
    /// Cells, basis, scheme, transfer, masses and the sides' methods in words.
    pub features: Vec<String>,
    /// What each feature costs.
    pub items: Vec<Item>,
    /// Material points.
    pub points: usize,
    /// Nodes of the background grid.
    pub nodes: usize,
    /// Unknowns of the linear system.
    pub unknowns: usize,
    /// Time steps.
    pub steps: usize,
}

impl Bill {
    /// Memory of all points (B).
    pub fn point_bytes(&self) -> usize {
        let of = |item: &Item| item.points * item.bytes_per_point;
        self.items.iter().map(of).sum()
    }

    /// Memory of a node (B), without the factor of a direct solver.
    pub fn bytes_per_node(&self) -> usize {
        self.items.iter().map(|item| item.bytes_per_node).sum()
    }

    /// Memory of everything (B), without the factor of a direct solver.
    pub fn bytes(&self) -> usize {
        let record: usize = self.items.iter().map(|item| item.record_bytes).sum();
        self.point_bytes() + self.nodes * self.bytes_per_node() + record
    }

    /// CPU time of the run, about (s).
    pub fn seconds(&self) -> f64 {
        let step: f64 = self.items.iter().map(|item| item.step_s).sum();
        step * self.steps as f64
    }
}

/// The bill, from the geometry alone.
pub(crate) fn bill<const D: usize>(problem: &Problem<D>) -> Result<Bill, SolverError> {
    let geometry = Geometry::new(problem)?;
    let few_cells = Grid {
        cells: [2; D],
        ..geometry.grid.clone()
    };
    let disc = on_grid(problem.basis, &few_cells, geometry.per_axis);
    let clerk = Clerk {
        counts: Counts::of(problem, &geometry),
        prices: Prices::of(problem.basis),
        nodes: geometry.grid.node_count(),
        disc: disc.as_ref(),
        problem,
        geometry: &geometry,
    };
    let mut items = vec![clerk.points(), clerk.basis(), clerk.nodes()];
    match clerk.flows() {
        true => items.push(clerk.flowing()),
        false => {
            items.extend(clerk.transfer());
            items.extend(clerk.moving());
        }
    }
    items.extend(clerk.consistent());
    items.extend(clerk.sides());
    items.extend(clerk.probes());
    Ok(Bill {
        features: features(problem, &geometry, disc.name()),
        items,
        points: clerk.counts.all(),
        nodes: clerk.nodes,
        unknowns: clerk.nodes * D,
        steps: problem.steps(),
    })
}

fn features<const D: usize>(
    problem: &Problem<D>,
    geometry: &Geometry<D>,
    basis: &str,
) -> Vec<String> {
    let scheme = format!(
        "{:?}, {:?} points, transfer {:?}",
        problem.scheme, problem.point_mode, problem.transfer
    );
    let cell = geometry.grid.h.map(|h| format!("{h:.6}")).join(" x ");
    let basis = format!("{basis} basis on cells of {cell} m");
    let mut features = vec![basis, scheme.to_lowercase()];
    if problem.mass == MassKind::Consistent {
        features.push("consistent masses".to_owned());
    }
    features.extend(
        geometry
            .assigned
            .iter()
            .map(|a| match a.layout.outside + a.layout.inside {
                0.0 => format!("{}: {}", a.side.name(), a.method.method),
                t => format!("{}: {} of {t} m", a.side.name(), a.method.method),
            }),
    );
    features
}

/// Writes the items of a problem.
struct Clerk<'a, const D: usize> {
    problem: &'a Problem<D>,
    geometry: &'a Geometry<D>,
    disc: &'a dyn Discretisation<D>,
    prices: Prices,
    counts: Counts,
    nodes: usize,
}

impl<const D: usize> Clerk<'_, D> {
    const VECTOR: usize = size_of::<Vector<D>>();
    const MATRIX: usize = size_of::<Matrix<D>>();

    fn item(&self, feature: &str, holds: &str) -> Item {
        Item {
            feature: feature.to_owned(),
            holds: holds.to_owned(),
            points: 0,
            bytes_per_point: 0,
            bytes_per_node: 0,
            record_bytes: 0,
            step_s: 0.0,
        }
    }

    fn is_moving(&self) -> bool {
        self.problem.point_mode == PointMode::Moving
    }

    fn keeps(&self) -> bool {
        self.problem.transfer == Transfer::Keep
    }

    /// Looks at the balance of forces in a step: a linear step needs no second.
    fn looks(&self) -> f64 {
        if self.is_moving() && !self.is_explicit() {
            2.0
        } else {
            1.0
        }
    }

    /// Explicit steps solve nothing.
    fn is_explicit(&self) -> bool {
        self.problem.scheme == Scheme::Explicit
    }

    /// Time (s) of so many points at a price (ns) each.
    fn time(points: usize, price: f64) -> f64 {
        1e-9 * points as f64 * price
    }

    /// A block of the matrix for each coupling of a node (B).
    fn matrix_bytes(&self) -> usize {
        self.disc.couplings() * Self::MATRIX
    }

    fn points(&self) -> Item {
        Item {
            points: self.counts.all() - self.flowing_points(),
            bytes_per_point: Points::<D>::BYTES,
            ..self.item("points", "place, volume, mass")
        }
    }

    fn basis(&self) -> Item {
        Item {
            points: self.counts.all() - self.flowing_points(),
            bytes_per_point: self.disc.bytes_per_point(),
            ..self.item(
                &format!("{} basis", self.disc.name()),
                "nodes, values and gradients of the shape functions",
            )
        }
    }

    /// The nodes' motion, the matrices and the solver. Nodes that keep the motion apply a matrix to it.
    fn nodes(&self) -> Item {
        let matrices = match (self.is_moving(), self.is_explicit()) {
            (true, false) => 1,
            (false, false) => 2,
            // that of the body, where nodes keep the motion
            (_, true) => usize::from(self.keeps()),
        };
        let pattern = self.disc.couplings() * size_of::<u32>() + size_of::<usize>();
        let product = if self.keeps() {
            self.prices.product
        } else {
            0.0
        };
        let solve = match self.is_explicit() {
            true => 0.0,
            false => solve_in_iterations(self.problem, &self.geometry.grid.h, self.is_moving()),
        };
        let step = STEP + self.looks() * (BALANCE + product) + solve * self.prices.iteration;
        let (vectors, holds) = match self.is_explicit() {
            true => (11, "motion, matrix of the body"),
            false => (18, "motion, trial, solver, matrix"),
        };
        Item {
            bytes_per_node: pattern + matrices * self.matrix_bytes() + vectors * Self::VECTOR,
            step_s: Self::time(self.nodes, step),
            ..self.item("nodes", holds)
        }
    }

    /// What points carry when they and not the nodes hold the motion, stress included.
    fn transfer(&self) -> Option<Item> {
        if self.keeps() || self.problem.scheme == Scheme::QuasiStatic {
            return None;
        }
        let affine = self.problem.transfer == Transfer::Affine;
        let price = &self.prices;
        let (holds, vectors, gradients) = match (affine, self.is_explicit()) {
            (true, false) => ("velocity, acceleration, their gradients, stress", 2, 2),
            (false, false) => ("velocity, acceleration, stress", 2, 0),
            (true, true) => ("velocity, its gradient, stress", 1, 1),
            (false, true) => ("velocity, stress", 1, 0),
        };
        // to the nodes each, back the acceleration
        let to_nodes = if affine { price.affine } else { price.scatter };
        let back = price.gather * if affine { 2.2 } else { 1.0 };
        let force = match self.is_moving() {
            true => self.looks() * price.finite_force,
            // and once more when the step is accepted
            false => 1.6 * price.small_force,
        };
        let name = format!("{:?} transfer", self.problem.transfer).to_lowercase();
        Some(Item {
            points: self.counts.carrying(),
            bytes_per_point: vectors * Self::VECTOR + (gradients + 2) * Self::MATRIX,
            step_s: Self::time(self.counts.carrying(), vectors as f64 * to_nodes + back)
                + Self::time(self.counts.bulk, force),
            ..self.item(&name, holds)
        })
    }

    /// What it takes to move points: masses, nodes and stiffness anew in every step.
    fn moving(&self) -> Option<Item> {
        let price = &self.prices;
        let matrix = match self.is_explicit() {
            true => 0.0,
            false => price.moduli + price.tangent,
        };
        let anew = price.scatter + price.gather + price.find + matrix;
        self.is_moving().then(|| Item {
            points: self.counts.bulk,
            step_s: Self::time(self.counts.bulk, anew),
            ..self.item("moving points", "")
        })
    }

    fn consistent(&self) -> Option<Item> {
        let price = &self.prices;
        let assembly = if self.is_moving() { price.mass } else { 0.0 };
        let work = self.looks() * (price.gather + price.scatter) + assembly;
        (self.problem.mass == MassKind::Consistent).then(|| Item {
            bytes_per_node: Self::VECTOR,
            step_s: Self::time(self.counts.all(), work),
            ..self.item("consistent masses", "what is left on the diagonal")
        })
    }

    /// The sides' methods, those of one name together.
    fn sides(&self) -> Vec<Item> {
        let sides = &self.geometry.assigned;
        let of = |info: &&'static boundary::MethodInfo| {
            let mut own = sides.iter().filter(|a| a.method.method == info.name);
            let first = own.next()?;
            let names = std::iter::once(first).chain(own).map(|a| {
                match a.layout.outside + a.layout.inside {
                    0.0 => a.side.name().to_owned(),
                    thickness => format!("{} {thickness} m", a.side.name()),
                }
            });
            let names: Vec<String> = names.collect();
            let upkeep = (info.upkeep)(&first.method, self.problem.transfer);
            let overlap = self.overlap(info.name, &upkeep);
            let own = self.side(info.name, &names.join(", "), &upkeep);
            Some(std::iter::once(own).chain(overlap))
        };
        boundary::METHODS.iter().filter_map(of).flatten().collect()
    }

    /// What layers keep besides where they meet.
    fn overlap(&self, name: &str, upkeep: &Upkeep) -> Option<Item> {
        let asked = D == 3 && upkeep.overlap_matrices > 0 && self.counts.layer(name) > 0;
        asked.then(|| Item {
            points: self.counts.overlap,
            bytes_per_point: upkeep.overlap_matrices * Self::MATRIX,
            ..self.item(&format!("{name}: edges and corners"), "second memory")
        })
    }

    fn side(&self, name: &str, sides: &str, upkeep: &Upkeep) -> Item {
        let points = self.counts.layer(name);
        let bytes =
            |vectors: usize, matrices: usize| vectors * Self::VECTOR + matrices * Self::MATRIX;
        let mut bytes_per_node = bytes(upkeep.node_vectors, 0);
        if points > 0 && !self.is_explicit() && (self.keeps() || self.is_moving()) {
            // its stiffness depends on the step and so has a matrix of its own
            bytes_per_node += self.matrix_bytes();
        }
        let looks = if self.is_moving() { 1.6 } else { 1.0 };
        Item {
            points,
            bytes_per_point: bytes(upkeep.point_vectors, upkeep.point_matrices),
            bytes_per_node,
            step_s: Self::time(points, looks * upkeep.forces * self.prices.small_force)
                + Self::time(self.counts.all(), upkeep.passes * self.prices.gather),
            ..self.item(&format!("{name}: {sides}"), upkeep.holds)
        }
    }

    fn probes(&self) -> Vec<Item> {
        let (probes, steps) = (&self.problem.probes, self.problem.steps());
        let number = size_of::<f64>();
        let mut items = Vec::new();
        let mut put = |feature: String, holds: &str, samples: usize, numbers: usize, ns: f64| {
            items.push(Item {
                record_bytes: samples * numbers * number,
                step_s: 1e-9 * ns * samples as f64 / steps as f64,
                ..self.item(&feature, holds)
            });
        };
        let n = probes.receivers.len();
        if n > 0 {
            let ns = 4.0 * PLACE * n as f64;
            put(
                format!("{n} receivers"),
                "displacement, velocity",
                steps + 1,
                1 + 2 * D * n,
                ns,
            );
        }
        for line in &probes.lines {
            let (samples, ns) = (steps / line.every + 1, PLACE * line.samples as f64);
            put(
                format!("line of {} places", line.samples),
                "a velocity",
                samples,
                line.samples,
                ns,
            );
        }
        if !probes.snapshot_times.is_empty() {
            let places = self.target_nodes();
            let samples = probes.snapshot_times.len();
            let ns = PLACE * places as f64;
            put(
                format!("{samples} snapshots"),
                "displacement",
                samples,
                D * places,
                ns,
            );
        }
        if let Some(every) = probes.energy_every {
            let price = &self.prices;
            // of the body and of everything: squares, gradients, stresses; and the momentum
            let body = price.gather + 0.7 * price.small_force;
            let ns =
                self.counts.target as f64 * body + self.counts.all() as f64 * (body + price.gather);
            put(
                format!("energy every {every} steps"),
                "energies, momentum",
                steps / every + 1,
                4 + D,
                ns,
            );
        }
        if let (Some(_), Some(energy)) = (probes.energy_every, items.last_mut()) {
            // squares of the nodes' velocities
            energy.bytes_per_node = Self::VECTOR;
        }
        items
    }

    fn target_nodes(&self) -> usize {
        let (target, h) = (&self.problem.target, &self.geometry.grid.h);
        let along = |a: usize| ((target.upper[a] - target.lower[a]) / h[a]).round() as usize + 1;
        (0..D).map(along).product()
    }
}
