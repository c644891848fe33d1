//! Series as CSV: `t_s`, then a column a quantity with its unit in the name (`A_vy_m_s`). Numbers
//! are written with as many digits as it takes to read the same bits back.

use crate::error::CaseError;
use anechoic_solver::record::{Column, SeriesTable};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Name and unit of a column.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ColumnHead {
    /// Name.
    pub name: String,
    /// Unit.
    pub unit: String,
}

impl ColumnHead {
    /// As the header of the file spells it.
    fn header(&self) -> String {
        let unit: String = self
            .unit
            .chars()
            .map(|c| if c.is_ascii_alphanumeric() { c } else { '_' })
            .collect();
        format!("{}_{unit}", self.name)
    }
}

/// Names and units of a table.
pub fn heads(table: &SeriesTable) -> Vec<ColumnHead> {
    table
        .columns
        .iter()
        .map(|column| ColumnHead {
            name: column.name.clone(),
            unit: column.unit.clone(),
        })
        .collect()
}

/// The table as CSV.
///
/// # Errors
/// [`CaseError::Report`] when a column is shorter than the times.
pub fn write(table: &SeriesTable) -> Result<Vec<u8>, CaseError> {
    let failed = |reason: String| CaseError::Report {
        what: "a table of series".into(),
        reason,
    };
    if let Some(column) = table
        .columns
        .iter()
        .find(|c| c.values.len() != table.times.len())
    {
        return Err(failed(format!(
            "column {} has {} values at {} times",
            column.name,
            column.values.len(),
            table.times.len()
        )));
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let names = heads(table)
        .iter()
        .map(ColumnHead::header)
        .collect::<Vec<_>>();
    writer
        .write_record(std::iter::once("t_s".to_owned()).chain(names))
        .map_err(|error| failed(error.to_string()))?;
    for (row, time) in table.times.iter().enumerate() {
        let values = table.columns.iter().map(|column| column.values[row]);
        writer
            .write_record(
                std::iter::once(*time)
                    .chain(values)
                    .map(|x| format!("{x:?}")),
            )
            .map_err(|error| failed(error.to_string()))?;
    }
    writer
        .into_inner()
        .map_err(|error| failed(error.to_string()))
}

/// The table out of CSV; its header must be that of `heads`, and its numbers finite if the run that
/// it belongs to is `complete`.
///
/// # Errors
/// [`CaseError::BadRecord`] with line and column.
pub fn read(path: &Path, heads: &[ColumnHead], complete: bool) -> Result<SeriesTable, CaseError> {
    let failed = |reason: String| CaseError::BadRecord {
        path: path.to_owned(),
        reason,
    };
    let mut reader = csv::Reader::from_path(path).map_err(|error| failed(error.to_string()))?;
    let found = reader
        .headers()
        .map_err(|error| failed(error.to_string()))?;
    let wanted: Vec<String> = std::iter::once("t_s".to_owned())
        .chain(heads.iter().map(ColumnHead::header))
        .collect();
    if found.iter().ne(wanted.iter().map(String::as_str)) {
        return Err(failed(format!(
            "its columns are {:?}, record.json names {wanted:?}",
            found.iter().collect::<Vec<_>>()
        )));
    }
    let mut times = Vec::new();
    let mut columns: Vec<Column> = heads
        .iter()
        .map(|head| Column {
            name: head.name.clone(),
            unit: head.unit.clone(),
            values: Vec::new(),
        })
        .collect();
    for (index, record) in reader.records().enumerate() {
        // The csv crate refuses rows of another length; its text names the line.
        let record = record.map_err(|error| failed(error.to_string()))?;
        let mut numbers = Vec::with_capacity(record.len());
        for text in &record {
            let number = text.parse().ok();
            let number = number.filter(|x: &f64| x.is_finite() || !complete);
            numbers.push(number.ok_or_else(|| {
                let column = &wanted[numbers.len()];
                failed(format!(
                    "line {}, column {column}: `{text}` is not a finite number",
                    index + 2
                ))
            })?);
        }
        times.push(numbers[0]);
        for (column, number) in columns.iter_mut().zip(&numbers[1..]) {
            column.values.push(*number);
        }
    }
    Ok(SeriesTable { times, columns })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> SeriesTable {
        let column = |name: &str, unit: &str, values: &[f64]| Column {
            name: name.into(),
            unit: unit.into(),
            values: values.to_vec(),
        };
        SeriesTable {
            times: vec![0.0, 0.1 + 0.2],
            columns: vec![
                column("A_uy", "m", &[1e-300, -0.1]),
                column("A_vy", "m/s", &[1.0 / 3.0, 5e20]),
            ],
        }
    }

    #[test]
    fn series_come_back_bit_by_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("receivers.csv");
        std::fs::write(&path, write(&table()).unwrap()).unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        assert!(text.starts_with("t_s,A_uy_m,A_vy_m_s\n"), "{text}");
        assert_eq!(read(&path, &heads(&table()), true).unwrap(), table());
    }

    #[test]
    fn missing_columns_short_rows_and_words_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("receivers.csv");
        let refused = |text: &str| {
            std::fs::write(&path, text).unwrap();
            read(&path, &heads(&table()), true).unwrap_err().to_string()
        };
        assert!(refused("t_s,A_uy_m\n0,1\n").contains("A_vy_m_s"));
        assert!(refused("t_s,A_uy_m,A_vy_m_s\n0,1,2\n0.1,1\n").contains("line: 3"));
        assert!(refused("t_s,A_uy_m,A_vy_m_s\n0,1,x\n").contains("line 2, column A_vy_m_s"));
        assert!(refused("t_s,A_uy_m,A_vy_m_s\n0,NaN,1\n").contains("line 2, column A_uy_m"));
        let mut short = table();
        short.columns[0].values.pop();
        assert!(write(&short).is_err());
    }
}
