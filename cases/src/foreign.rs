//! Receivers' series of other programs: read with every mistake named, and taken to a scene's times.
//!
//! The file is as our `receivers.csv`: `t_s`, then `NAME_ux_m`, `NAME_uy_m` of every receiver of the
//! scene, and `NAME_vx_m_s`, `NAME_vy_m_s` of all or none; columns in any order.

use crate::error::{CaseError, hint, nearest};
use anechoic_solver::record::{Column, SeriesTable};
use std::path::{Path, PathBuf};

/// Times may differ by this share of a step, which is rounding.
const SAME_TIME: f64 = 1e-6;

/// Larger numbers (m, m/s, s) overflow when they are squared and summed, and are no motion anyway.
const LARGEST: f64 = 1e100;

/// Displacements, and velocities where the file has them.
const DISPLACEMENTS: [(&str, &str); 2] = [("ux", "m"), ("uy", "m")];
const VELOCITIES: [(&str, &str); 2] = [("vx", "m/s"), ("vy", "m/s")];

/// Series of another program, whole and finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Foreign {
    path: PathBuf,
    table: SeriesTable,
    /// Velocities were not in the file: they are central differences of the displacements.
    derived: bool,
}

/// A column that a file may have: name and unit of a quantity of a receiver.
#[derive(Clone, Debug, PartialEq)]
struct Known {
    name: String,
    unit: &'static str,
}

impl Known {
    /// As headers spell it.
    fn header(&self) -> String {
        format!("{}_{}", self.name, self.unit.replace('/', "_"))
    }
}

impl Foreign {
    /// Reads the series of all `receivers`.
    ///
    /// # Errors
    /// [`CaseError::Read`] and [`CaseError::Series`].
    pub fn read(path: &Path, receivers: &[String]) -> Result<Self, CaseError> {
        let file = std::fs::File::open(path).map_err(|source| CaseError::Read {
            path: path.to_owned(),
            source,
        })?;
        let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(file);
        let wrong = |line: u64, message: String| CaseError::Series {
            path: path.to_owned(),
            line,
            message,
        };
        let unreadable = |error: csv::Error| {
            let line = error.position().map_or(1, csv::Position::line);
            wrong(line, error.to_string())
        };
        let header: Vec<String> = {
            let found = reader.headers().map_err(unreadable)?;
            found.iter().map(|name| name.trim().to_owned()).collect()
        };
        let known = |quantities: [(&'static str, &'static str); 2]| -> Vec<Known> {
            let of = |receiver: &String| {
                quantities.map(|(q, unit)| Known {
                    name: format!("{receiver}_{q}"),
                    unit,
                })
            };
            receivers.iter().flat_map(of).collect()
        };
        let displacements = known(DISPLACEMENTS);
        let velocities = known(VELOCITIES);
        let derived = !velocities
            .iter()
            .any(|column| header.contains(&column.header()));
        let wanted: Vec<Known> = if derived {
            displacements
        } else {
            displacements.into_iter().chain(velocities).collect()
        };
        check_header(&header, &wanted).map_err(|message| wrong(1, message))?;
        let mut columns: Vec<Vec<f64>> = vec![Vec::new(); header.len()];
        for record in reader.records() {
            let record = record.map_err(unreadable)?;
            let line = record.position().map_or(0, csv::Position::line);
            if record.len() != header.len() {
                let message = format!("{} fields, the header has {}", record.len(), header.len());
                return Err(wrong(line, message));
            }
            for ((text, name), values) in record.iter().zip(&header).zip(&mut columns) {
                let number = text.trim().parse().ok().filter(|x: &f64| x.is_finite());
                let number = number.ok_or_else(|| {
                    wrong(
                        line,
                        format!("column {name}: `{text}` is not a finite number"),
                    )
                })?;
                if number.abs() > LARGEST {
                    let message = format!(
                        "column {name}: {number:e} is no motion; allowed: at most {LARGEST:e}"
                    );
                    return Err(wrong(line, message));
                }
                let is_time = name == TIME;
                if let (true, Some(before)) = (is_time, values.last().filter(|t| **t >= number)) {
                    let message =
                        format!("column {TIME}: {number} s does not come after {before} s");
                    return Err(wrong(line, message));
                }
                values.push(number);
            }
        }
        let mut take = |name: &str| {
            let at = header.iter().position(|known| known == name);
            at.map(|at| std::mem::take(&mut columns[at]))
                .unwrap_or_default()
        };
        let times = take(TIME);
        if times.len() < 2 {
            return Err(wrong(
                2,
                format!(
                    "a series needs two times at least, here are {}",
                    times.len()
                ),
            ));
        }
        let taken = wanted.into_iter().map(|column| Column {
            values: take(&column.header()),
            name: column.name,
            unit: column.unit.to_owned(),
        });
        let mut table = SeriesTable {
            columns: taken.collect(),
            times,
        };
        if derived {
            add_velocities(&mut table);
        }
        Ok(Foreign {
            path: path.to_owned(),
            table,
            derived,
        })
    }

    /// Can the series be taken to times from 0 to `end` in steps of `dt` (s)? They must reach as far,
    /// and be as fine.
    ///
    /// # Errors
    /// [`CaseError::Series`] with the line.
    pub fn covers(&self, end: f64, dt: f64) -> Result<(), CaseError> {
        let times = &self.table.times;
        let slack = SAME_TIME * dt;
        let wrong = |index: usize, message: String| CaseError::Series {
            path: self.path.clone(),
            line: index as u64 + 2,
            message: format!("column {TIME}: {message}"),
        };
        if times[0] > slack {
            return Err(wrong(
                0,
                format!("the series starts at {} s, the scene at 0", times[0]),
            ));
        }
        let last = times.len() - 1;
        if times[last] < end - slack {
            let message = format!("the series ends at {} s, the scene at {end} s", times[last]);
            return Err(wrong(last, message));
        }
        let within = times.windows(2).take_while(|pair| pair[0] < end - slack);
        let coarse = within
            .enumerate()
            .find(|(_, pair)| pair[1] - pair[0] > dt + slack);
        if let Some((index, pair)) = coarse {
            let step = pair[1] - pair[0];
            let message = format!(
                "a step of {step:.6} s is longer than the scene's {dt} s; series must be as fine at least, since they are interpolated linearly"
            );
            return Err(wrong(index + 1, message));
        }
        Ok(())
    }

    /// The series at other times, and what was done to them.
    pub fn at(&self, times: &[f64]) -> (SeriesTable, Vec<String>) {
        let own = &self.table.times;
        let places: Vec<(usize, f64)> = times.iter().map(|t| place(own, *t)).collect();
        let value = |values: &[f64], (i, share): (usize, f64)| match share {
            0.0 => values[i],
            _ => values[i] + share * (values[i + 1] - values[i]),
        };
        let columns = self.table.columns.iter().map(|column| Column {
            name: column.name.clone(),
            unit: column.unit.clone(),
            values: places.iter().map(|at| value(&column.values, *at)).collect(),
        });
        let mut notes = Vec::new();
        if places.iter().any(|(_, share)| *share != 0.0) {
            notes.push(format!(
                "its {} times are not those of the scene: its series are interpolated linearly",
                own.len()
            ));
        }
        if self.derived {
            notes.push("its velocities are central differences of its displacements".to_owned());
        }
        let table = SeriesTable {
            times: times.to_vec(),
            columns: columns.collect(),
        };
        (table, notes)
    }
}

/// The column of times.
const TIME: &str = "t_s";

/// Is every column there, once, and no other?
fn check_header(header: &[String], wanted: &[Known]) -> Result<(), String> {
    let mut names: Vec<String> = vec![TIME.to_owned()];
    names.extend(wanted.iter().map(Known::header));
    for (index, name) in header.iter().enumerate() {
        if !names.contains(name) {
            let nearest = nearest(name, names.iter().map(String::as_str));
            return Err(format!(
                "column {} `{name}` is none of the scene's receivers{}; expected: {}",
                index + 1,
                hint(&nearest),
                names.join(", ")
            ));
        }
        if header[..index].contains(name) {
            return Err(format!("column {} `{name}` is there twice", index + 1));
        }
    }
    match names.iter().find(|name| !header.contains(name)) {
        Some(name) => Err(format!(
            "column `{name}` is missing; expected: {}",
            names.join(", ")
        )),
        None => Ok(()),
    }
}

/// Index of the time before or at `t`, and the share of the way to the next one; zero where rounding
/// is all that parts them.
fn place(times: &[f64], t: f64) -> (usize, f64) {
    let last = times.len() - 1;
    let after = times.partition_point(|own| *own <= t).clamp(1, last);
    let (from, to) = (times[after - 1], times[after]);
    let share = (t - from) / (to - from);
    if share < SAME_TIME {
        (after - 1, 0.0)
    } else if share > 1.0 - SAME_TIME {
        (after, 0.0)
    } else {
        (after - 1, share)
    }
}

/// Velocities of all receivers as differences of their displacements.
fn add_velocities(table: &mut SeriesTable) {
    let derived = table.columns.iter().map(|column| {
        // NAME_ux becomes NAME_vx, whatever NAME holds.
        let (receiver, axis) = column.name.split_at(column.name.len() - 2);
        Column {
            name: format!("{receiver}{}", axis.replace('u', "v")),
            unit: "m/s".to_owned(),
            values: slopes(&table.times, &column.values),
        }
    });
    let derived: Vec<Column> = derived.collect();
    table.columns.extend(derived);
}

/// Slopes of second order within, of first order at the ends.
fn slopes(times: &[f64], values: &[f64]) -> Vec<f64> {
    let slope = |i: usize| (values[i + 1] - values[i]) / (times[i + 1] - times[i]);
    let last = times.len() - 1;
    (0..=last)
        .map(|i| match i {
            0 => slope(0),
            _ if i == last => slope(last - 1),
            _ => {
                let (before, after) = (times[i] - times[i - 1], times[i + 1] - times[i]);
                (after * slope(i - 1) + before * slope(i)) / (before + after)
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Foreign, CaseError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("series.csv");
        std::fs::write(&path, text).unwrap();
        Foreign::read(&path, &["A1".to_owned(), "B".to_owned()])
    }

    fn refused(text: &str, words: &[&str]) {
        let error = read(text).unwrap_err();
        assert_eq!(error.exit_code(), crate::error::exit::USAGE);
        let error = error.to_string();
        for word in words.iter().chain(&["series.csv:"]) {
            assert!(error.contains(word), "{word} is missing in {error}");
        }
    }

    const HEAD: &str = "t_s,A1_ux_m,A1_uy_m,B_ux_m,B_uy_m\n";

    #[test]
    fn what_is_wrong_is_named_with_line_and_column() {
        refused(
            "t_s,A1_ux_m,A1_uy_m,B_ux_m\n",
            &[":1:", "`B_uy_m` is missing"],
        );
        refused(
            &HEAD.replace("B_ux_m", "B_u_m"),
            &[":1:", "column 4 `B_u_m`", "did you mean"],
        );
        refused(&HEAD.replace("t_s", "time"), &[":1:", "column 1 `time`"]);
        refused(
            &HEAD.replace("B_ux_m", "A1_ux_m"),
            &[":1:", "column 4", "twice"],
        );
        refused(
            &HEAD.replace('\n', ",B_vx_m_s\n"),
            &[":1:", "`A1_vx_m_s` is missing"],
        );
        refused(&format!("{HEAD}0,0,0,0,0\n"), &["two times"]);
        refused(
            &format!("{HEAD}0,0,0,0,0\n0.1,0,0,1e300,0\n"),
            &[":3:", "1e300 is no motion", "at most 1e100"],
        );
        refused(
            &format!("{HEAD}0,0,0,0,0\n1,0,NaN,0,0\n"),
            &[":3:", "A1_uy_m", "NaN"],
        );
        refused(
            &format!("{HEAD}0,0,0,0,0\n1,0,inf,0,0\n"),
            &[":3:", "A1_uy_m"],
        );
        refused(
            &format!("{HEAD}0,0,0,0,0\n1,0,,0,0\n"),
            &[":3:", "A1_uy_m", "``"],
        );
        refused(
            &format!("{HEAD}0,0,0,0,0\n1,0,0,0\n"),
            &[":3:", "4 fields", "5"],
        );
        refused(
            &format!("{HEAD}0,0,0,0,0\n0,0,0,0,0\n"),
            &[":3:", "t_s", "does not come after"],
        );
    }

    #[test]
    fn series_must_reach_as_far_and_be_as_fine() {
        let series = read(&format!("{HEAD}0,0,0,0,0\n0.1,1,0,0,0\n0.3,2,0,0,0\n")).unwrap();
        let of = |end, dt| series.covers(end, dt).map_err(|error| error.to_string());
        assert_eq!(of(0.3, 0.2), Ok(()));
        assert_eq!(
            of(0.1, 0.1),
            Ok(()),
            "what comes after the end may be coarse"
        );
        assert!(of(0.4, 0.2).unwrap_err().contains(":4:"));
        let coarse = of(0.3, 0.1).unwrap_err();
        assert!(
            coarse.contains(":4:") && coarse.contains("interpolated"),
            "{coarse}"
        );
        let late = read(&format!("{HEAD}0.1,0,0,0,0\n0.2,1,0,0,0\n")).unwrap();
        assert!(
            late.covers(0.2, 0.1)
                .unwrap_err()
                .to_string()
                .contains("starts at")
        );
    }

    #[test]
    fn times_between_are_interpolated_and_the_same_times_are_kept_to_the_bit() {
        let series = read(&format!(
            "{HEAD}0,0.1,0,0,0\n0.1,0.3,0,0,0\n0.2,0.7,0,0,0\n"
        ))
        .unwrap();
        let (table, notes) = series.at(&[0.0, 0.1 + 1e-12, 0.2]);
        assert_eq!(table.column("A1_ux"), Some(&[0.1, 0.3, 0.7][..]));
        assert_eq!(notes.len(), 1, "velocities are derived: {notes:?}");
        let (table, notes) = series.at(&[0.0, 0.15]);
        assert!((table.column("A1_ux").unwrap()[1] - 0.5).abs() < 1e-12);
        assert!(notes[0].contains("interpolated linearly"), "{notes:?}");
    }

    #[test]
    fn velocities_are_second_order_differences() {
        // u = t^2 on uneven times: exact within.
        let times = [0.0, 0.1, 0.3, 0.4];
        let squares: Vec<f64> = times.iter().map(|t| t * t).collect();
        let v = slopes(&times, &squares);
        assert!(
            (v[1] - 0.2).abs() < 1e-12 && (v[2] - 0.6).abs() < 1e-12,
            "{v:?}"
        );
    }

    #[test]
    fn columns_may_stand_in_any_order_and_bring_velocities() {
        let text = "A1_uy_m,t_s,A1_ux_m,B_ux_m,B_uy_m,B_vy_m_s,B_vx_m_s,A1_vx_m_s,A1_vy_m_s\n\
                    1,0,2,3,4,5,6,7,8\n1,1,2,3,4,5,6,7,8\n";
        let (table, notes) = read(text).unwrap().at(&[0.0, 1.0]);
        for (name, value) in [
            ("A1_ux", 2.0),
            ("A1_uy", 1.0),
            ("B_vy", 5.0),
            ("A1_vx", 7.0),
        ] {
            assert_eq!(table.column(name).unwrap()[1], value, "{name}");
        }
        assert!(notes.is_empty());
    }
}
