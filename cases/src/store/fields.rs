//! Fields for ParaView in a run's folder: `fields.pvd`, which is what to open, and a file a time.

use crate::error::CaseError;
use anechoic_reports::fields::{pvd, vtu};
use anechoic_solver::record::Snapshot;
use std::path::Path;

/// The list of files.
pub const LIST: &str = "fields.pvd";

/// Writes the fields into a folder that becomes `named`; nothing without fields.
pub(super) fn write(folder: &Path, named: &Path, fields: &[Snapshot]) -> Result<(), CaseError> {
    if fields.is_empty() {
        return Ok(());
    }
    let failed = |name: &str, source| CaseError::Storage {
        path: named.join(name),
        source,
    };
    let write = |name: &str, bytes: &[u8]| {
        std::fs::write(folder.join(name), bytes).map_err(|error| failed(name, error))
    };
    std::fs::create_dir(folder.join("fields")).map_err(|error| failed("fields", error))?;
    let mut files = Vec::new();
    for (number, snapshot) in fields.iter().enumerate() {
        let name = format!("fields/{number:03}.vtu");
        let bytes = vtu(snapshot).map_err(|error| CaseError::Report {
            what: format!("{}: the field at {} s", named.display(), snapshot.time),
            reason: error.to_string(),
        })?;
        write(&name, &bytes)?;
        files.push((snapshot.time, name));
    }
    let list = pvd(files.iter().map(|(time, name)| (*time, name.as_str())));
    write(LIST, list.as_bytes())
}
