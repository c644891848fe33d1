//! Records on disk: `OUT/STUDY/METHOD/HASH/`, written beside and renamed, so that a folder is whole.
//!
//! | file | holds |
//! |---|---|
//! | `scene.toml` | the scene as run; `anechoic run scene.toml` runs it again |
//! | `manifest.json` | status, cost, provenance |
//! | `metrics.json` | the rows of this run |
//! | `receivers.csv`, `energy.csv`, `bodies.csv` (where there are rigid bodies) | series |
//! | `fields.pvd`, `fields/*.vtu` | fields for ParaView, where they were asked for |
//! | `record.json` | names and units of the series' columns, fields along lines, snapshots |
//! | `SHA256SUMS` | hashes of the files that reports are made from, by which a record that is no longer whole is found |

mod fields;
mod sums;
mod table;

use crate::error::CaseError;
use crate::frames::Frames;
use crate::prepare::{Prepared, Request, Target};
use crate::provenance;
use crate::runner::Run;
use crate::scene_text;
use anechoic_reports::provenance::Provenance;
use anechoic_reports::row::Row;
use anechoic_solver::record::{Cost, Record, SeriesTable, Snapshot, SpaceTime, Status};
pub use fields::LIST as FIELDS;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::{Path, PathBuf};
use sums::SUMS;
pub use sums::sum as sha256;
use table::ColumnHead;
pub use table::write as series_csv;

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
    /// For series of another program: what is known of them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scored: Option<Scored>,
}

/// What is known of another program's series.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Scored {
    /// The file, as it was named.
    pub file: String,
    /// SHA-256 of its content.
    pub sha256: String,
    /// The method of ours whose boundary it models, if it was said.
    pub models: Option<String>,
    /// What was done to the series.
    pub notes: Vec<String>,
}

impl Manifest {
    /// Of a scene's record, made by this program now.
    pub fn of(prepared: &Prepared, record: &Record) -> Self {
        let hash = prepared.hash();
        Manifest {
            case: prepared.info.name.to_owned(),
            profile: prepared.profile.clone(),
            method: prepared.method.clone(),
            status: record.status.clone(),
            cost: record.cost.clone(),
            provenance: provenance::of(&hash),
            hash,
            scored: None,
        }
    }

    /// The method whose claims judge the run; none for another program's series of which nobody said
    /// what they model.
    pub fn judged_as(&self) -> Option<&str> {
        match &self.scored {
            None => Some(&self.method),
            Some(scored) => scored.models.as_deref(),
        }
    }

    /// Folder of the run below that of its case.
    pub fn folder(&self) -> PathBuf {
        Path::new(&self.method).join(&self.hash)
    }
}

/// Name of the file that makes a folder that of a run.
pub const MANIFEST: &str = "manifest.json";

/// Prefix of folders in which a run is being written; nothing reads them.
const UNFINISHED: &str = ".unfinished-";

/// What `record.json` holds.
#[derive(Debug, Serialize, Deserialize)]
struct Fields {
    receivers: Vec<ColumnHead>,
    energy: Vec<ColumnHead>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    bodies: Vec<ColumnHead>,
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

    /// Takes away what a program that was killed has left of a run: folders that were not renamed.
    ///
    /// # Errors
    /// [`CaseError::Storage`].
    pub fn sweep(&self, run: &Path) -> Result<(), CaseError> {
        let parent = self.folder.join(run);
        let entries = parent.parent().map(std::fs::read_dir);
        for entry in entries.into_iter().flatten().flatten().flatten() {
            if entry.file_name().to_string_lossy().starts_with(UNFINISHED) {
                let path = entry.path();
                std::fs::remove_dir_all(&path)
                    .map_err(|source| CaseError::Storage { path, source })?;
            }
        }
        Ok(())
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
            .prefix(UNFINISHED)
            .tempdir_in(parent)
            .map_err(|e| failed(parent, e))?;
        let record = &run.record;
        let fields = Fields {
            receivers: table::heads(&record.receivers),
            energy: table::heads(&record.energy),
            bodies: table::heads(&record.bodies),
            lines: record.lines.clone(),
            snapshots: record.snapshots.clone(),
        };
        let scene = scene_text::write(&run.prepared).into_bytes();
        let mut files = vec![
            ("scene.toml", scene),
            (MANIFEST, json(&run.manifest)?),
            ("receivers.csv", table::write(&record.receivers)?),
            ("energy.csv", table::write(&record.energy)?),
            ("record.json", compact_json(&fields)?),
        ];
        if !record.bodies.columns.is_empty() {
            files.push(("bodies.csv", table::write(&record.bodies)?));
        }
        files.push((SUMS, sums::write(&files).into_bytes()));
        for (name, content) in &files {
            std::fs::write(new.path().join(name), content)
                .map_err(|e| failed(&folder.join(name), e))?;
        }
        fields::write(new.path(), &folder, &run.frames.fields)?;
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

/// Reads a run back, if every file is what it was when it was written.
///
/// # Errors
/// [`CaseError::Read`], [`CaseError::BadRecord`], and what the scene's file says.
pub fn load(folder: &Path) -> Result<Run, CaseError> {
    if !folder.is_dir() {
        return Err(CaseError::BadRecord {
            path: folder.to_owned(),
            reason: "the run's folder is missing".into(),
        });
    }
    let manifest: Manifest = read_json(&folder.join(MANIFEST))?;
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
    let complete = manifest.status == Status::Complete;
    let series = |name: &str, heads| table::read(&folder.join(name), heads, complete);
    let record = Record {
        status: manifest.status.clone(),
        receivers: series("receivers.csv", &fields.receivers)?,
        energy: series("energy.csv", &fields.energy)?,
        bodies: match fields.bodies.is_empty() {
            true => SeriesTable::default(),
            false => series("bodies.csv", &fields.bodies)?,
        },
        lines: fields.lines,
        snapshots: fields.snapshots,
        cost: manifest.cost.clone(),
    };
    // Last, since the errors above say more.
    sums::check(folder)?;
    Ok(Run {
        prepared,
        manifest,
        record,
        frames: Frames::default(),
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
