//! The tables of a certified reference: series with what they are in their comment lines, energies,
//! and the fields of the snapshots.
//!
//! | file | holds |
//! |---|---|
//! | `CASE-HASH.csv` | [`About`] as TOML behind `#`, receivers' displacements with 9 digits |
//! | `CASE-HASH-energy.csv` | kinetic and strain energy of the target |
//! | `CASE-HASH-fields.csv` | displacements of every second node at the snapshots' times, 4 digits |

use super::{About, Certified, key};
use crate::error::CaseError;
use anechoic_reference::stored::{StoredError, Table};
use anechoic_solver::record::{Column, SeriesTable, Snapshot};
use std::fmt::Write as _;

/// Every which node of a snapshot is kept along each axis.
const COARSE: usize = 2;

/// Names and texts of the tables.
///
/// # Errors
/// [`CaseError::Report`] when what is to be said is no TOML.
pub fn write(reference: &Certified) -> Result<Vec<(String, String)>, CaseError> {
    let about = toml::to_string(&reference.about).map_err(|error| CaseError::Report {
        what: "the certified reference".into(),
        reason: error.to_string(),
    })?;
    let mut main = String::new();
    for line in about.lines().filter(|line| !line.is_empty()) {
        let _ = writeln!(main, "# {line}");
    }
    let name = |what| name(&reference.about.case, &reference.about.hash, what);
    let (receivers, energy) = (&reference.receivers, &reference.energy);
    let mut files = vec![
        (name(""), main + &series(receivers, 8)),
        (name("-energy"), series(energy, 8)),
    ];
    if !reference.snapshots.is_empty() {
        files.push((name("-fields"), fields(&reference.snapshots)));
    }
    Ok(files)
}

/// Reads a reference from its tables; `text` gives a table's text, if there is one.
///
/// # Errors
/// [`CaseError::BadRecord`] for a table that is not whole or not that of its hash; a missing
/// main table is `None`.
pub fn read(
    case: &str,
    hash: &str,
    text: impl Fn(&str) -> Option<String>,
) -> Result<Option<Certified>, CaseError> {
    let main = name(case, hash, "");
    let Some(content) = text(&main) else {
        return Ok(None);
    };
    let bad = |file: &str, reason: String| CaseError::BadRecord {
        path: file.into(),
        reason,
    };
    let of = |file: &str, error: StoredError| bad(file, error.to_string());
    let table = Table::parse(&main, &content).map_err(|e| of(&main, e))?;
    let about: About =
        toml::from_str(&table.comments.join("\n")).map_err(|e| bad(&main, e.to_string()))?;
    if about.hash != hash || key::hash(&about.problem) != hash {
        let reason = "its hash is not that of what it says it was made from".to_owned();
        return Err(bad(&main, reason));
    }
    let part = |what: &str| {
        let file = name(case, hash, what);
        let parsed = text(&file).map(|text| Table::parse(&file, &text));
        parsed.transpose().map_err(|e| of(&file, e))
    };
    let last = table.column("t").ok().and_then(|times| times.last());
    if last != Some(&about.end_s) {
        let reason = format!(
            "it was cut short: its series end at {} s and not at end_s = {} s",
            last.copied().unwrap_or_default(),
            about.end_s
        );
        return Err(bad(&main, reason));
    }
    let energy = part("-energy")?.map(|table| to_series(&table));
    let snapshots = part("-fields")?.map(|table| snapshots(&table));
    Ok(Some(Certified {
        receivers: to_series(&table).map_err(|e| of(&main, e))?,
        energy: energy
            .transpose()
            .map_err(|e| of(&main, e))?
            .unwrap_or_default(),
        snapshots: snapshots
            .transpose()
            .map_err(|e| of(&main, e))?
            .unwrap_or_default(),
        about,
    }))
}

fn name(case: &str, hash: &str, what: &str) -> String {
    format!("{case}-{hash}{what}.csv")
}

/// A table of series with so many digits behind the point of a power of ten.
fn series(table: &SeriesTable, digits: usize) -> String {
    let mut text = String::from("# t [s]");
    for column in &table.columns {
        let _ = write!(text, ",{} [{}]", column.name, column.unit);
    }
    text.push('\n');
    for (row, t) in table.times.iter().enumerate() {
        let _ = write!(text, "{t}");
        for column in &table.columns {
            let _ = write!(text, ",{:.*e}", digits, column.values[row]);
        }
        text.push('\n');
    }
    text
}

fn to_series(table: &Table) -> Result<SeriesTable, StoredError> {
    let columns = table.columns.iter().filter(|column| column.name != "t");
    Ok(SeriesTable {
        times: table.column("t")?.to_vec(),
        columns: columns
            .map(|column| {
                Ok(Column {
                    name: column.name.clone(),
                    unit: column.unit.clone().unwrap_or_default(),
                    values: table.column(&column.name)?.to_vec(),
                })
            })
            .collect::<Result<_, StoredError>>()?,
    })
}

/// Every second node: places, then `NAME@TIME` for each snapshot.
fn fields(snapshots: &[Snapshot]) -> String {
    let mut text = String::from("# x [m],y [m]");
    for snapshot in snapshots {
        for column in &snapshot.columns {
            let _ = write!(text, ",{}@{} [{}]", column.name, snapshot.time, column.unit);
        }
    }
    text.push('\n');
    let lattice = &snapshots[0];
    let [nx, ny, _] = lattice.counts;
    for iy in (0..ny).step_by(COARSE) {
        for ix in (0..nx).step_by(COARSE) {
            let place =
                |axis: usize, i: usize| lattice.origin[axis] + i as f64 * lattice.spacing[axis];
            let _ = write!(text, "{},{}", place(0, ix), place(1, iy));
            for column in snapshots.iter().flat_map(|snapshot| &snapshot.columns) {
                let _ = write!(text, ",{:.3e}", column.values[iy * nx + ix]);
            }
            text.push('\n');
        }
    }
    text
}

fn snapshots(table: &Table) -> Result<Vec<Snapshot>, StoredError> {
    let (x, y) = (table.column("x")?, table.column("y")?);
    let nx = y.iter().take_while(|value| **value == y[0]).count();
    let ny = y.len() / nx;
    let spacing = |values: &[f64], step: usize| values.get(step).map_or(0.0, |v| v - values[0]);
    let mut snapshots: Vec<Snapshot> = Vec::new();
    for column in &table.columns {
        let Some((name, time)) = column.name.split_once('@') else {
            continue;
        };
        let Ok(time) = time.parse() else { continue };
        if snapshots.last().is_none_or(|last| last.time != time) {
            snapshots.push(Snapshot {
                time,
                counts: [nx, ny, 1],
                origin: [x[0], y[0], 0.0],
                spacing: [spacing(x, 1), spacing(y, nx), 0.0],
                columns: Vec::new(),
            });
        }
        let column = Column {
            name: name.to_owned(),
            unit: column.unit.clone().unwrap_or_default(),
            values: table.column(&column.name)?.to_vec(),
        };
        if let Some(last) = snapshots.last_mut() {
            last.columns.push(column);
        }
    }
    Ok(snapshots)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::scene::Scene;
    use crate::scenes::point_source::PointSource;
    use anechoic_reports::provenance::Provenance;
    use anechoic_solver::record::Cost;
    use std::collections::BTreeMap;

    /// A reference of three times.
    pub fn example() -> Certified {
        let problem = key::table(&PointSource::default().extended().unwrap());
        let column = |name: &str, unit: &str, values: &[f64]| Column {
            name: name.into(),
            unit: unit.into(),
            values: values.to_vec(),
        };
        Certified {
            about: About {
                case: "point-source".into(),
                hash: key::hash(&problem),
                end_s: 0.02,
                serves_until_s: 0.03,
                buffer_m: BTreeMap::from([("left".into(), 220.0)]),
                floor_m: Some(BTreeMap::from([("A1".into(), 1.5e-12)])),
                provenance: Provenance::default(),
                cost: Cost::default(),
                problem,
            },
            receivers: SeriesTable {
                times: vec![0.0, 0.01, 0.02],
                columns: vec![column("A1_ux", "m", &[0.0, 1.23456789e-7, -2.5])],
            },
            energy: SeriesTable {
                times: vec![0.0, 0.02],
                columns: vec![column("kinetic", "J", &[0.0, 3.25])],
            },
            snapshots: vec![Snapshot {
                time: 0.02,
                counts: [3, 5, 1],
                origin: [1000.0, -80.0, 0.0],
                spacing: [20.0, 20.0, 0.0],
                columns: vec![column(
                    "ux",
                    "m",
                    &(0..15).map(f64::from).collect::<Vec<_>>(),
                )],
            }],
        }
    }

    fn again(files: &[(String, String)]) -> Result<Option<Certified>, CaseError> {
        let text = |name: &str| {
            let found = files.iter().find(|(known, _)| known == name);
            found.map(|(_, text)| text.clone())
        };
        read("point-source", &example().about.hash, text)
    }

    #[test]
    fn what_is_written_is_read_again() {
        let read = again(&write(&example()).unwrap()).unwrap().unwrap();
        let mut expected = example();
        let lattice = &mut expected.snapshots[0];
        lattice.counts = [2, 3, 1];
        lattice.spacing = [40.0, 40.0, 0.0];
        lattice.columns[0].values = vec![0.0, 2.0, 6.0, 8.0, 12.0, 14.0];
        assert_eq!(read, expected);
    }

    #[test]
    fn a_reference_made_from_something_else_is_refused() {
        let mut files = write(&example()).unwrap();
        files[0].1 = files[0].1.replace("nu = 0.25", "nu = 0.3");
        assert!(again(&files).unwrap_err().to_string().contains("hash"));
        files[0].1 = files[0].1.replace("-2.5", "NaN");
        assert!(again(&files).is_err());
        assert_eq!(again(&[]).unwrap(), None);
        let mut files = write(&example()).unwrap();
        let cut = files[0].1.trim_end().rfind('\n').unwrap();
        files[0].1.truncate(cut + 1);
        let error = again(&files).unwrap_err().to_string();
        assert!(error.contains("cut short"), "{error}");
    }
}
