//! Certified references: the same scheme on the same mesh, extended until nothing comes back.
//!
//! - [`causality`]: how much material that takes, and until when a reference serves.
//! - [`key`]: what it depends on, and the hash by which it is found again.
//! - [`solve`](mod@solve): computing one, and its floor.
//! - [`file`](mod@file): its tables on disk.
//! - [`library`]: where they lie: those that come with the program, those of a results folder.

pub mod causality;
pub mod file;
pub mod key;
pub mod library;
pub mod solve;

use anechoic_reports::provenance::Provenance;
use anechoic_solver::record::{Cost, SeriesTable, Snapshot};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::Table;

/// A certified reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Certified {
    /// What it is and where it comes from.
    pub about: About,
    /// Displacements of the receivers: `NAME_ux`, `NAME_uy` (m), and `NAME_uz` in three dimensions.
    pub receivers: SeriesTable,
    /// Kinetic and strain energy of the target (J per metre of thickness).
    pub energy: SeriesTable,
    /// Displacements of every second node of the target, for pictures; in three dimensions of its back side.
    pub snapshots: Vec<Snapshot>,
}

/// What a reference is and where it comes from; the comment lines of its table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct About {
    /// Case that it was made for.
    pub case: String,
    /// Hash of `problem`.
    pub hash: String,
    /// End of its series (s).
    pub end_s: f64,
    /// Until when nothing can have come back into the target (s).
    pub serves_until_s: f64,
    /// Material added to each extended side (m).
    pub buffer_m: BTreeMap<String, f64>,
    /// Change of each receiver's displacement (m) under a larger buffer and a tenth of the solver's
    /// tolerance, largest over time; absent when it was not measured.
    pub floor_m: Option<BTreeMap<String, f64>>,
    /// What it was made by.
    pub provenance: Provenance,
    /// What it cost.
    pub cost: Cost,
    /// Everything that its series depend on.
    pub problem: Table,
}

impl About {
    /// Does it serve a run that ends at `end_s`? A millionth of a second is rounding.
    ///
    /// # Errors
    /// Why not.
    pub fn serves(&self, end_s: f64) -> Result<(), String> {
        let until = self.serves_until_s.min(self.end_s);
        if end_s <= until + 1e-6 {
            return Ok(());
        }
        let why = if self.serves_until_s < self.end_s {
            "the far boundary's echo may be back then"
        } else {
            "its series end then"
        };
        Err(format!(
            "the certified reference {} serves until {until:.3} s ({why}), the run ends at {end_s} s",
            self.hash
        ))
    }
}
