//! What the program was built from, as `build.rs` found it.

use anechoic_reports::provenance::Provenance;

/// Provenance of a run with the given input; every run has one thread.
pub fn of(input_hash: &str) -> Provenance {
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        revision: env!("ANECHOIC_REVISION").to_owned(),
        dirty: env!("ANECHOIC_DIRTY") == "true",
        compiler: env!("ANECHOIC_COMPILER").to_owned(),
        threads: 1,
        input_hash: input_hash.to_owned(),
    }
}
