//! Records on disk: `OUT/STUDY/METHOD/HASH/`, written beside and renamed, so that a folder is whole.
//!
//! | file | holds |
//! |---|---|
//! | `scene.toml` | the scene as run; `anechoic run scene.toml` runs it again |
//! | `manifest.json` | status, cost, provenance |
//! | `metrics.json` | the rows of this run |
//! | `receivers.csv`, `energy.csv` | series |
//! | `record.json` | names and units of the series' columns, fields along lines, snapshots |

mod table;

use crate::error::CaseError;
use crate::prepare::{Request, Target};
use crate::runner::Run;
use crate::scene_text;
use anechoic_reports::provenance::Provenance;
use anechoic_reports::row::Row;
use anechoic_solver::record::{Cost, Record, Snapshot, SpaceTime, Status};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::{Path, PathBuf};
use table::ColumnHead;

/// What is known of a run beside its record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Case.
    pub case: String,
    /// Profile.
    pub profile: String,
    /// Method as in rows.
    pub method: String,
    /// Hash of the scene; the name of its folder.
    pub hash: String,
    /// How it ended.
    pub status: Status,
    /// What it cost.
    pub cost: Cost,
    /// Where it comes from.
    pub provenance: Provenance,
}

impl Manifest {
    /// Folder of the run below that of its case.
    pub fn folder(&self) -> PathBuf {
        Path::new(&self.method).join(&self.hash)
    }
}

/// What `record.json` holds.
#[derive(Debug, Serialize, Deserialize)]
struct Fields {
    receivers: Vec<ColumnHead>,
    energy: Vec<ColumnHead>,
    lines: Vec<SpaceTime>,
    snapshots: Vec<Snapshot>,
}

/// The folder of a study in a results folder.
#[derive(Clone, Debug)]
pub struct Store {
    folder: PathBuf,
}

impl Store {
    /// The folder called `study` in a results folder that can be written: that is made, and a file
    /// is put there and taken away.
    ///
    /// # Errors
    /// [`CaseError::Output`].
    pub fn open(root: &Path, study: &str) -> Result<Self, CaseError> {
        let failed = |source| CaseError::Output {
            path: root.to_owned(),
            source,
        };
        std::fs::create_dir_all(root).map_err(failed)?;
        let mut probe = tempfile::NamedTempFile::new_in(root).map_err(failed)?;
        probe.write_all(b"probe").map_err(failed)?;
        Ok(Store {
            folder: root.join(study),
        })
    }

    /// The study's folder.
    pub fn folder(&self) -> &Path {
        &self.folder
    }

    /// Folder of a run.
    pub fn run_folder(&self, manifest: &Manifest) -> PathBuf {
        self.folder.join(manifest.folder())
    }

    /// Stores a run; an earlier one of the same input is replaced when the new one is whole.
    ///
    /// # Errors
    /// [`CaseError::Storage`].
    pub fn save(&self, run: &Run) -> Result<(), CaseError> {
        let folder = self.run_folder(&run.manifest);
        let parent = folder.parent().unwrap_or(&self.folder);
        let failed = |path: &Path, source| CaseError::Storage {
            path: path.to_owned(),
            source,
        };
        std::fs::create_dir_all(parent).map_err(|e| failed(parent, e))?;
        let new = tempfile::Builder::new()
            .prefix(".unfinished-")
            .tempdir_in(parent)
            .map_err(|e| failed(parent, e))?;
        let record = &run.record;
        let fields = Fields {
            receivers: table::heads(&record.receivers),
            energy: table::heads(&record.energy),
            lines: record.lines.clone(),
            snapshots: record.snapshots.clone(),
        };
        let write = |name: &str, bytes: &[u8]| {
            std::fs::write(new.path().join(name), bytes).map_err(|e| failed(&folder.join(name), e))
        };
        write("scene.toml", scene_text::write(&run.prepared).as_bytes())?;
        write("manifest.json", &json(&run.manifest)?)?;
        write("receivers.csv", &table::write(&record.receivers)?)?;
        write("energy.csv", &table::write(&record.energy)?)?;
        write("record.json", &compact_json(&fields)?)?;
        if folder.exists() {
            std::fs::remove_dir_all(&folder).map_err(|e| failed(&folder, e))?;
        }
        std::fs::rename(new.keep(), &folder).map_err(|e| failed(&folder, e))
    }
}

/// Stores a run's own rows beside its record; `case_folder` is that of the case.
///
/// # Errors
/// [`CaseError::Storage`].
pub fn save_rows(case_folder: &Path, manifest: &Manifest, own: &[&Row]) -> Result<(), CaseError> {
    let path = case_folder.join(manifest.folder()).join("metrics.json");
    write_file(&path, &json(&own)?)
}

/// Reads a run back.
///
/// # Errors
/// [`CaseError::Read`], [`CaseError::BadRecord`], and what the scene's file says.
pub fn load(folder: &Path) -> Result<Run, CaseError> {
    let manifest: Manifest = read_json(&folder.join("manifest.json"))?;
    let fields: Fields = read_json(&folder.join("record.json"))?;
    let scene = folder.join("scene.toml");
    let mut prepared = Target::find(&Request {
        target: scene.display().to_string(),
        ..Request::default()
    })?
    .prepare(None)?;
    prepared.method.clone_from(&manifest.method);
    if prepared.hash() != manifest.hash {
        return Err(CaseError::BadRecord {
            path: scene,
            reason: format!(
                "its hash is {}, the manifest says {}; it was changed after the run",
                prepared.hash(),
                manifest.hash
            ),
        });
    }
    let record = Record {
        status: manifest.status.clone(),
        receivers: table::read(&folder.join("receivers.csv"), &fields.receivers)?,
        energy: table::read(&folder.join("energy.csv"), &fields.energy)?,
        lines: fields.lines,
        snapshots: fields.snapshots,
        cost: manifest.cost.clone(),
    };
    Ok(Run {
        prepared,
        manifest,
        record,
    })
}

/// Writes a file beside its place and renames it, so that it is whole or not there.
///
/// # Errors
/// [`CaseError::Storage`].
pub fn write_file(path: &Path, bytes: &[u8]) -> Result<(), CaseError> {
    let mut partial = path.as_os_str().to_owned();
    partial.push(".partial");
    let partial = Path::new(&partial);
    let write = || {
        let folder = path.parent().unwrap_or(Path::new("."));
        std::fs::create_dir_all(folder)?;
        let mut file = std::fs::File::create(partial)?;
        file.write_all(bytes)?;
        file.sync_data()?;
        std::fs::rename(partial, path)
    };
    write().map_err(|source| {
        // What is half written serves nobody; that it cannot be removed either adds nothing.
        let _ = std::fs::remove_file(partial);
        CaseError::Storage {
            path: path.to_owned(),
            source,
        }
    })
}

/// Reads a JSON file.
///
/// # Errors
/// [`CaseError::Read`] and [`CaseError::BadRecord`].
pub fn read_json<T: DeserializeOwned>(path: &Path) -> Result<T, CaseError> {
    let text = std::fs::read_to_string(path).map_err(|source| CaseError::Read {
        path: path.to_owned(),
        source,
    })?;
    serde_json::from_str(&text).map_err(|error| CaseError::BadRecord {
        path: path.to_owned(),
        reason: error.to_string(),
    })
}

/// JSON that people read.
///
/// # Errors
/// [`CaseError::Report`] for a value that is no JSON.
pub fn json<T: Serialize>(value: &T) -> Result<Vec<u8>, CaseError> {
    let mut bytes = serde_json::to_vec_pretty(value).map_err(no_json)?;
    bytes.push(b'\n');
    Ok(bytes)
}

fn compact_json<T: Serialize>(value: &T) -> Result<Vec<u8>, CaseError> {
    serde_json::to_vec(value).map_err(no_json)
}

fn no_json(error: serde_json::Error) -> CaseError {
    CaseError::Report {
        what: "a JSON file".into(),
        reason: error.to_string(),
    }
}
