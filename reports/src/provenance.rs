//! Where a result comes from.

use serde::{Deserialize, Serialize};

/// What it takes to run it again.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// Revision of its source.
    pub revision: String,
    /// Had the source uncommitted changes?
    pub dirty: bool,
    /// Hash of the sources that records depend on; empty for records of versions that had none.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub sources: String,
    /// Compiler that built it.
    pub compiler: String,
    /// Threads of the run.
    pub threads: usize,
    /// Hash of the scene and the method's parameters.
    pub input_hash: String,
}
