//! A scene in the making: its own values, over which profile, preset, file, method and `--set` are
//! laid in turn. Every key is checked against the scene's fields and remembers where it came from.

mod receivers;
mod set;
mod sides;

use crate::error::{CaseError, Complaint, Origin, hint, nearest};
use crate::field::{Field, Kind};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml::{Table, Value};
use toml_edit::{Document, Item, TableLike};

/// Where an overlay's text comes from.
#[derive(Clone, Debug)]
pub enum Source {
    /// A snippet of the scene itself.
    BuiltIn(String),
    /// A file.
    File(PathBuf),
}

/// Keys of a file that belong to the program, not to the scene.
pub const HEADER: &[&str] = &["case", "profile", "preset"];

/// A scene in the making.
#[derive(Clone, Debug)]
pub struct Draft {
    fields: Vec<&'static Field>,
    table: Table,
    origins: BTreeMap<String, Origin>,
    complaints: Vec<Complaint>,
    unused: Vec<String>,
}

impl Draft {
    /// The scene's own values with its fields.
    pub fn new(defaults: Table, fields: Vec<&'static Field>) -> Self {
        Draft {
            fields,
            table: defaults,
            origins: BTreeMap::new(),
            complaints: Vec::new(),
            unused: Vec::new(),
        }
    }

    /// Lays a TOML text over what stands.
    ///
    /// # Errors
    /// [`CaseError::Syntax`] when it is not TOML. Unknown fields and wrong types are collected, see
    /// [`Draft::finish`].
    pub fn overlay(&mut self, text: &str, source: &Source) -> Result<(), CaseError> {
        let document = parse(text, source)?;
        let origin = |offset: usize| match source {
            Source::BuiltIn(name) => Origin::BuiltIn(name.clone()),
            Source::File(path) => Origin::File {
                path: path.clone(),
                line: line_column(text, offset).0,
            },
        };
        self.lay(document.as_table(), "", &origin);
        Ok(())
    }

    /// Lays one level of tables over what stands.
    fn lay(&mut self, table: &dyn TableLike, prefix: &str, origin: &dyn Fn(usize) -> Origin) {
        for (key, item) in table.iter() {
            if prefix.is_empty() && HEADER.contains(&key) {
                continue;
            }
            let path = join(prefix, key);
            let at = table
                .get_key_value(key)
                .and_then(|(key, item)| key.span().or_else(|| item.span()))
                .map_or(0, |span| span.start);
            match self.field(&path).map(|field| field.kind) {
                Some(Kind::Side) => self.lay_side(&path, item, origin(at), origin),
                Some(Kind::Receivers) => self.lay_receivers(&path, item, origin(at), origin),
                Some(kind) => match plain(item) {
                    Some(value) => self.put(&path, kind, value, origin(at)),
                    None => self.wrong_type(&path, kind, "a table", origin(at)),
                },
                None if self.is_group(&path) => match item.as_table_like() {
                    Some(inner) => self.lay(inner, &path, origin),
                    None => self.complain(origin(at), &path, self.group_message(&path)),
                },
                None => self.unknown(&path, origin(at)),
            }
        }
    }

    /// Stores a value after a check of its type.
    fn put(&mut self, path: &str, kind: Kind, value: Value, origin: Origin) {
        match typed(kind, value) {
            Ok(value) => self.store(path, value, origin),
            Err(found) => self.wrong_type(path, kind, &found, origin),
        }
    }

    /// Stores a checked value.
    fn store(&mut self, path: &str, value: Value, origin: Origin) {
        let mut table = &mut self.table;
        let mut parts: Vec<&str> = path.split('.').collect();
        let last = parts.pop().unwrap_or(path);
        for part in parts {
            let inner = table
                .entry(part)
                .or_insert_with(|| Value::Table(Table::new()));
            match inner.as_table_mut() {
                Some(inner) => table = inner,
                None => return,
            }
        }
        table.insert(last.to_owned(), value);
        self.origins.insert(path.to_owned(), origin);
    }

    /// The value at a path.
    fn get(&self, path: &str) -> Option<&Value> {
        let mut parts = path.split('.');
        let first = self.table.get(parts.next()?)?;
        parts.try_fold(first, |value, part| value.get(part))
    }

    /// The scene's table and the origins of its values.
    ///
    /// # Errors
    /// [`CaseError::Scene`] with every unknown field, wrong type and value out of its range.
    pub fn finish(mut self) -> Result<Finished, CaseError> {
        self.check_ranges();
        self.check_sides();
        if self.complaints.is_empty() {
            Ok(Finished {
                table: self.table,
                origins: Origins(self.origins),
                unused: self.unused,
            })
        } else {
            Err(CaseError::Scene(self.complaints))
        }
    }

    fn check_ranges(&mut self) {
        for field in self.fields.clone() {
            let Some(value) = self.get(field.path) else {
                continue;
            };
            let message = match (field.kind, value) {
                (Kind::Number(range) | Kind::OptionalNumber(range, _), Value::Float(x))
                    if !range.holds(*x) =>
                {
                    format!("{x} is out of range; allowed: {range}")
                }
                (Kind::Whole(min, max), Value::Integer(n)) if !(min..=max).contains(n) => {
                    format!("{n} is out of range; allowed: {min} <= value <= {max}")
                }
                (Kind::Word(words), Value::String(word)) if !words.contains(&word.as_str()) => {
                    format!(
                        "unknown word \"{word}\"{}; allowed: {}",
                        hint(&nearest(word, words.iter().copied())),
                        crate::field::quoted(words)
                    )
                }
                _ => continue,
            };
            let origin = self.origin(field.path);
            self.complain(origin, field.path, message);
        }
    }

    fn field(&self, path: &str) -> Option<&'static Field> {
        self.fields.iter().copied().find(|f| f.path == path)
    }

    fn is_group(&self, path: &str) -> bool {
        let prefix = format!("{path}.");
        self.fields.iter().any(|f| f.path.starts_with(&prefix))
    }

    fn group_message(&self, path: &str) -> String {
        let prefix = format!("{path}.");
        let members: Vec<&str> = self
            .fields
            .iter()
            .filter(|f| f.path.starts_with(&prefix))
            .map(|f| f.path)
            .collect();
        format!(
            "is a group, not a value; its fields: {}",
            members.join(", ")
        )
    }

    fn origin(&self, path: &str) -> Origin {
        self.origins.get(path).cloned().unwrap_or(Origin::Default)
    }

    fn complain(&mut self, origin: Origin, field: &str, message: String) {
        self.complaints.push(Complaint {
            origin,
            field: field.to_owned(),
            message,
        });
    }

    fn wrong_type(&mut self, path: &str, kind: Kind, found: &str, origin: Origin) {
        let message = format!("expected {}, found {found}", kind.expected());
        self.complain(origin, path, message);
    }

    fn unknown(&mut self, path: &str, origin: Origin) {
        let fields = self.fields.iter().map(|f| f.path);
        let near = nearest(path, fields.chain(HEADER.iter().copied()));
        let message = format!(
            "unknown field{}; `anechoic show CASE --toml` lists all",
            hint(&near)
        );
        self.complain(origin, path, message);
    }
}

/// A scene whose keys, types and ranges are in order.
#[derive(Debug)]
pub struct Finished {
    /// The values.
    pub table: Table,
    /// Where they come from.
    pub origins: Origins,
    /// `--set METHOD.field=value` of methods that no side uses.
    pub unused: Vec<String>,
}

/// Where values come from, by path.
#[derive(Clone, Debug, Default)]
pub struct Origins(BTreeMap<String, Origin>);

impl Origins {
    /// Origin of the value at `path`, or of the group it stands in.
    pub fn of(&self, path: &str) -> Origin {
        let mut path = path;
        loop {
            if let Some(origin) = self.0.get(path) {
                return origin.clone();
            }
            match path.rfind(['.', '[']) {
                Some(at) => path = &path[..at],
                None => return Origin::Default,
            }
        }
    }

    /// Has anything below `group` been named by a file?
    pub fn from_file(&self, group: &str) -> bool {
        self.0
            .iter()
            .any(|(path, origin)| path.starts_with(group) && matches!(origin, Origin::File { .. }))
    }
}

/// Parses a text, with the place of a mistake.
///
/// # Errors
/// [`CaseError::Syntax`].
pub fn parse(text: &str, source: &Source) -> Result<Document<String>, CaseError> {
    Document::parse(text.to_owned()).map_err(|error| {
        let (line, column) = line_column(text, error.span().map_or(0, |span| span.start));
        CaseError::Syntax {
            path: match source {
                Source::File(path) => path.clone(),
                Source::BuiltIn(name) => Path::new(name).to_owned(),
            },
            line,
            column,
            message: error.message().trim().replace('\n', "; "),
        }
    })
}

/// Line and column of a byte, both from 1.
pub fn line_column(text: &str, offset: usize) -> (usize, usize) {
    let before = &text.as_bytes()[..offset.min(text.len())];
    let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
    let start = before
        .iter()
        .rposition(|&byte| byte == b'\n')
        .map_or(0, |at| at + 1);
    (line, before.len() - start + 1)
}

fn join(prefix: &str, key: &str) -> String {
    if prefix.is_empty() {
        key.to_owned()
    } else {
        format!("{prefix}.{key}")
    }
}

/// The value of an item that is not a table.
fn plain(item: &Item) -> Option<Value> {
    item.as_value().and_then(convert)
}

/// A value out of the editor's types; `None` for inline tables.
fn convert(value: &toml_edit::Value) -> Option<Value> {
    Some(match value {
        toml_edit::Value::String(text) => Value::String(text.value().clone()),
        toml_edit::Value::Integer(number) => Value::Integer(*number.value()),
        toml_edit::Value::Float(number) => Value::Float(*number.value()),
        toml_edit::Value::Boolean(yes) => Value::Boolean(*yes.value()),
        toml_edit::Value::Datetime(date) => Value::String(date.value().to_string()),
        toml_edit::Value::Array(list) => Value::Array(list.iter().filter_map(convert).collect()),
        toml_edit::Value::InlineTable(_) => return None,
    })
}

/// The value as the kind wants it (whole numbers serve as numbers), or what was found instead.
fn typed(kind: Kind, value: Value) -> Result<Value, String> {
    match (kind, value) {
        (Kind::Number(_) | Kind::OptionalNumber(..), Value::Integer(n)) => {
            Ok(Value::Float(n as f64))
        }
        (Kind::Number(_) | Kind::OptionalNumber(..), value @ Value::Float(_))
        | (Kind::Whole(..), value @ Value::Integer(_))
        | (Kind::Word(_), value @ Value::String(_)) => Ok(value),
        (_, value) => Err(describe(&value)),
    }
}

/// A value in words.
fn describe(value: &Value) -> String {
    match value {
        Value::String(text) => format!("the text \"{text}\""),
        Value::Integer(number) => format!("the whole number {number}"),
        Value::Float(number) => format!("the number {number}"),
        Value::Boolean(yes) => format!("{yes}"),
        Value::Datetime(date) => format!("the date {date}"),
        Value::Array(_) => "a list".into(),
        Value::Table(_) => "a table".into(),
    }
}
