//! Loader of stored tables: numbers only, separated by commas, with `#` comments, the last of which names the columns.
//!
//! ```text
//! # what it is, where it comes from
//! # t [s],A_roller [1],B_roller [1]
//! 0,0,0
//! 0.01,0.0627,0
//! ```
//!
//! A table is refused whole: a short row, a word, NaN or infinity is an error with file and line.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a stored table cannot be used.
#[derive(Debug, Error)]
pub enum StoredError {
    /// There is no such file; the program ends with exit code 4.
    #[error("the reference {} is missing: compute it again or restore the file", path.display())]
    Missing {
        /// Where it should be.
        path: PathBuf,
    },
    /// The file is there but cannot be read.
    #[error("cannot read the reference {}: {source}", path.display())]
    Unreadable {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// No comment line before the first row names the columns.
    #[error(
        "{file}: no comment line names the columns; write `# t [s],name [unit],...` above the first row"
    )]
    NoHeader {
        /// Which file.
        file: String,
    },
    /// Two columns of one name.
    #[error("{file}: two columns are named {column:?}; rename one")]
    DuplicateColumn {
        /// Which file.
        file: String,
        /// The name.
        column: String,
    },
    /// A header and no rows.
    #[error("{file}: the table has no rows")]
    Empty {
        /// Which file.
        file: String,
    },
    /// A row with too few or too many fields.
    #[error("{file}:{line}: {found} fields, the header names {expected} columns")]
    RowLength {
        /// Which file.
        file: String,
        /// Line, from 1.
        line: u64,
        /// Fields in the row.
        found: usize,
        /// Columns in the header.
        expected: usize,
    },
    /// A field that is no finite number.
    #[error("{file}:{line}: {text:?} in column {column:?} is no finite number")]
    NotANumber {
        /// Which file.
        file: String,
        /// Line, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        text: String,
    },
    /// A column that the table does not have.
    #[error("{file} has no column {wanted:?}; it has {known}")]
    NoColumn {
        /// Which file.
        file: String,
        /// What was asked for.
        wanted: String,
        /// The columns it has.
        known: String,
    },
}

/// Name and unit of a column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name.
    pub name: String,
    /// Unit, if the header gives one in brackets.
    pub unit: Option<String>,
}

/// A stored table.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    file: String,
    /// Comment lines above the column names, without `#`.
    pub comments: Vec<String>,
    /// The columns in order.
    pub columns: Vec<Column>,
    /// One vector a column, in the order of `columns`, all equally long.
    values: Vec<Vec<f64>>,
}

impl Table {
    /// Reads the file at `path`.
    pub fn read(path: &Path) -> Result<Table, StoredError> {
        let text = fs::read_to_string(path).map_err(|source| {
            let path = path.to_path_buf();
            match source.kind() {
                io::ErrorKind::NotFound => StoredError::Missing { path },
                _ => StoredError::Unreadable { path, source },
            }
        })?;
        Table::parse(&path.display().to_string(), &text)
    }

    /// Parses `text`; `file` names it in errors.
    pub fn parse(file: &str, text: &str) -> Result<Table, StoredError> {
        let (comments, columns) = header(file, text)?;
        let mut values = vec![Vec::new(); columns.len()];
        let rows = (1u64..).zip(text.lines().map(str::trim));
        for (line, row) in rows.filter(|(_, row)| !row.is_empty() && !row.starts_with('#')) {
            let fields: Vec<&str> = row.split(',').map(str::trim).collect();
            if fields.len() != columns.len() {
                return Err(StoredError::RowLength {
                    file: file.into(),
                    line,
                    found: fields.len(),
                    expected: columns.len(),
                });
            }
            for ((field, column), values) in fields.iter().zip(&columns).zip(&mut values) {
                match field.parse::<f64>() {
                    Ok(value) if value.is_finite() => values.push(value),
                    _ => {
                        return Err(StoredError::NotANumber {
                            file: file.into(),
                            line,
                            column: column.name.clone(),
                            text: (*field).into(),
                        });
                    }
                }
            }
        }
        if values.iter().all(Vec::is_empty) {
            return Err(StoredError::Empty { file: file.into() });
        }
        Ok(Table {
            file: file.into(),
            comments,
            columns,
            values,
        })
    }

    /// Values of the column called `name`.
    pub fn column(&self, name: &str) -> Result<&[f64], StoredError> {
        let place = self.columns.iter().position(|column| column.name == name);
        place
            .map(|i| self.values[i].as_slice())
            .ok_or_else(|| StoredError::NoColumn {
                file: self.file.clone(),
                wanted: name.into(),
                known: self.names().join(", "),
            })
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.values[0].len() // a header names at least one column
    }

    fn names(&self) -> Vec<&str> {
        self.columns.iter().map(|c| c.name.as_str()).collect()
    }
}

/// Comments and columns: the run of `#` lines at the top, the last of which names the columns.
fn header(file: &str, text: &str) -> Result<(Vec<String>, Vec<Column>), StoredError> {
    let mut comments: Vec<String> = text
        .lines()
        .map_while(|line| line.trim_start().strip_prefix('#'))
        .map(|line| line.trim().to_owned())
        .collect();
    let names = comments.pop().unwrap_or_default();
    let columns: Vec<Column> = names.split(',').map(column).collect();
    if columns.iter().any(|column| column.name.is_empty()) {
        return Err(StoredError::NoHeader { file: file.into() });
    }
    for (i, column) in columns.iter().enumerate() {
        if columns[..i].iter().any(|other| other.name == column.name) {
            return Err(StoredError::DuplicateColumn {
                file: file.into(),
                column: column.name.clone(),
            });
        }
    }
    Ok((comments, columns))
}

/// `name [unit]` or `name`.
fn column(text: &str) -> Column {
    let text = text.trim();
    let split = text
        .strip_suffix(']')
        .and_then(|text| text.split_once('['))
        .map(|(name, unit)| (name.trim(), unit.trim()));
    match split {
        Some((name, unit)) => Column {
            name: name.into(),
            unit: Some(unit.into()),
        },
        None => Column {
            name: text.into(),
            unit: None,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn reads_comments_columns_units_and_rows() {
        let table = Table::parse("t.csv", "# source\n# t [s], v\n0, 1e-3\n\n0.5,-2\n").unwrap();
        assert_eq!(table.comments, ["source"]);
        assert_eq!(table.columns[0].unit.as_deref(), Some("s"));
        assert_eq!(table.columns[1].unit, None);
        assert_eq!(table.column("t").unwrap(), [0.0, 0.5]);
        assert_eq!(table.column("v").unwrap(), [1e-3, -2.0]);
        assert_eq!(table.rows(), 2);
    }

    fn message(text: &str) -> String {
        Table::parse("t.csv", text).unwrap_err().to_string()
    }

    #[test]
    fn refuses_bad_rows_with_file_and_line() {
        let short = message("# a,b\n1,2\n3\n");
        assert_eq!(short, "t.csv:3: 1 fields, the header names 2 columns");
        let nan = message("# a,b\n1,2\n# a remark\n3,NaN\n");
        assert!(nan.starts_with("t.csv:4: \"NaN\" in column \"b\""), "{nan}");
        assert!(message("# a,b\n1,inf\n").starts_with("t.csv:2:"));
        assert!(message("# a,b\n1,\n").starts_with("t.csv:2:"));
        assert!(message("# a,b\n1,2,3\n").contains("3 fields"));
    }

    #[test]
    fn refuses_tables_without_header_or_rows() {
        assert!(message("1,2\n").contains("no comment line names the columns"));
        assert!(message("# a,\n1,2\n").contains("no comment line names the columns"));
        assert!(message("# a,b\n").contains("no rows"));
        assert!(message("# a,a\n1,2\n").contains("two columns"));
    }

    #[test]
    fn unknown_columns_and_missing_files_say_what_to_do() {
        let table = Table::parse("t.csv", "# a,b\n1,2\n").unwrap();
        let error = table.column("c").unwrap_err().to_string();
        assert_eq!(error, "t.csv has no column \"c\"; it has a, b");
        let folder = tempfile::tempdir().unwrap();
        let missing = Table::read(&folder.path().join("none.csv")).unwrap_err();
        assert!(matches!(missing, StoredError::Missing { .. }));
        let unreadable = Table::read(folder.path()).unwrap_err();
        assert!(matches!(unreadable, StoredError::Unreadable { .. }));
    }

    #[test]
    fn the_index_names_every_stored_file_with_its_provenance() {
        let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
        let mut indexed = BTreeSet::new();
        let mut reader = csv::Reader::from_path(data.join("index.csv")).unwrap();
        let heads = reader.headers().unwrap().clone();
        let expected = [
            "file",
            "content",
            "source",
            "place",
            "uncertainty",
            "licence",
        ];
        assert_eq!(heads, expected.to_vec());
        for row in reader.records() {
            let row = row.unwrap();
            assert!(row.iter().all(|field| !field.trim().is_empty()), "{row:?}");
            indexed.insert(row[0].to_owned());
            Table::read(&data.join(&row[0])).unwrap();
        }
        let stored: BTreeSet<String> = fs::read_dir(&data)
            .unwrap()
            .map(Result::unwrap)
            // Certified references carry their provenance in their own comment lines.
            .filter(|entry| entry.file_type().unwrap().is_file())
            .map(|entry| entry.file_name().into_string().unwrap())
            .filter(|name| name != "index.csv")
            .collect();
        assert_eq!(indexed, stored);
    }
}
