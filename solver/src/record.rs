//! What a run leaves behind: series, space-time fields, cost. The only data that leaves the crate.
//!
//! A [`Record`] has no type parameters, so that every dimension, discretisation and physics fills
//! the same one. It knows no case and no file format; the case runner wraps it with provenance.

use serde::{Deserialize, Serialize};

/// A named column of numbers with its unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Column {
    /// What is recorded, for example `A_vy`.
    pub name: String,
    /// Unit as it is written, for example `m/s`.
    pub unit: String,
    /// One value a sample.
    pub values: Vec<f64>,
}

/// Several columns over the same sampling times (s).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SeriesTable {
    /// Sampling times in seconds, strictly increasing.
    pub times: Vec<f64>,
    /// The columns, each as long as `times`.
    pub columns: Vec<Column>,
}

impl SeriesTable {
    /// Are the values of the last sample finite, or is there none?
    pub fn ends_finite(&self) -> bool {
        let mut last = self.columns.iter().filter_map(|c| c.values.last());
        last.all(|value| value.is_finite())
    }

    /// Keeps the first `samples` samples.
    pub fn truncate(&mut self, samples: usize) {
        self.times.truncate(samples);
        for column in &mut self.columns {
            column.values.truncate(samples);
        }
    }

    /// The values of the column called `name`.
    pub fn column(&self, name: &str) -> Option<&[f64]> {
        self.columns
            .iter()
            .find(|c| c.name == name)
            .map(|c| c.values.as_slice())
    }
}

/// A field sampled along a line at several times: `values[it * positions.len() + ix]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpaceTime {
    /// What is recorded, for example `vy`.
    pub name: String,
    /// Unit of the values.
    pub unit: String,
    /// Coordinate along the line in metres.
    pub positions: Vec<f64>,
    /// Axis label of the coordinate, for example `height y`.
    pub axis: String,
    /// Sampling times in seconds.
    pub times: Vec<f64>,
    /// Values, time-major.
    pub values: Vec<f64>,
}

/// A field on a regular sampling lattice at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// Time in seconds.
    pub time: f64,
    /// Number of samples along each axis (1 for an absent axis), first axis fastest.
    pub counts: [usize; 3],
    /// Position of the first sample (m).
    pub origin: [f64; 3],
    /// Distance between samples (m).
    pub spacing: [f64; 3],
    /// The sampled fields.
    pub columns: Vec<Column>,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Status {
    /// All steps were made.
    Complete,
    /// It was asked to stop; what stands was computed before.
    Cancelled,
    /// It failed; the text is the solver's error.
    Failed(String),
}

/// What a run cost.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Time steps made.
    pub steps: usize,
    /// Newton iterations over all steps.
    pub newton_iterations: usize,
    /// Iterations of the linear solver over all steps (0 for a direct one).
    pub iterations: usize,
    /// Unknowns of the linear system.
    pub unknowns: usize,
    /// Material points.
    pub points: usize,
    /// CPU time of the run in seconds.
    pub cpu_s: f64,
    /// Wall time of the run in seconds.
    pub wall_s: f64,
    /// Largest memory allocated at once by the run in bytes.
    pub peak_bytes: u64,
    /// Which linear solver was chosen, and why.
    pub linear_solver: String,
}

/// The record of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// How the run ended.
    pub status: Status,
    /// Receivers' series: columns `NAME_ux`, `NAME_uy` (m), `NAME_vx`, `NAME_vy` (m/s).
    pub receivers: SeriesTable,
    /// Energies (J per metre of thickness in 2D): columns `kinetic`, `strain` of the target,
    /// `total` of everything; and `momentum_x`, `momentum_y` (kg m/s per metre) of everything.
    pub energy: SeriesTable,
    /// Rigid bodies, after every step: columns `NAME_fx`, `NAME_fy` (N, per metre of thickness in 2D), the
    /// force of the soil; `NAME_wx`, `NAME_wy` (m), the way from the start; `NAME_in` (m), the depth of the
    /// deepest point inside. Empty where there are none.
    pub bodies: SeriesTable,
    /// Fields along lines.
    pub lines: Vec<SpaceTime>,
    /// Fields on lattices: displacement `ux`, `uy`, `uz` (m); of material that flows velocity `vx`, `vy`, `vz`
    /// (m/s), and `p` (Pa), the pressure of the cell that goes up from the sample along every axis.
    pub snapshots: Vec<Snapshot>,
    /// What it cost.
    pub cost: Cost,
}
