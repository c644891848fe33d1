//! The list of receivers: replaced as a whole by a file, changed by name by `--set receivers.A.y_m=40`.

use super::{Draft, describe, plain, typed};
use crate::error::Origin;
use crate::field::{Kind, Range};
use toml::{Table, Value};
use toml_edit::{Item, TableLike};

/// Keys of a receiver beside its name; the last has a meaning in three dimensions alone.
const PLACE: [&str; 3] = ["x_m", "y_m", "z_m"];

impl Draft {
    /// Replaces the list.
    pub(super) fn lay_receivers(
        &mut self,
        path: &str,
        item: &Item,
        here: Origin,
        origin: &dyn Fn(usize) -> Origin,
    ) {
        let tables: Vec<&dyn TableLike> = match item {
            Item::ArrayOfTables(list) => list.iter().map(|t| t as &dyn TableLike).collect(),
            Item::Value(toml_edit::Value::Array(list))
                if list.iter().all(toml_edit::Value::is_inline_table) =>
            {
                list.iter()
                    .filter_map(|v| v.as_inline_table().map(|t| t as &dyn TableLike))
                    .collect()
            }
            other => {
                let found = plain(other).map_or("a table".into(), |value| describe(&value));
                return self.wrong_type(path, Kind::Receivers, &found, here);
            }
        };
        let mut list = Vec::new();
        for (index, table) in tables.iter().enumerate() {
            let mut receiver = Table::new();
            for (key, item) in table.iter() {
                let key_path = format!("{path}[{index}].{key}");
                let place = table
                    .get_key_value(key)
                    .and_then(|(key, _)| key.span())
                    .map_or_else(|| here.clone(), |span| origin(span.start));
                self.origins.insert(key_path.clone(), place.clone());
                match receiver_value(key, plain(item)) {
                    Ok(value) => {
                        receiver.insert(key.to_owned(), value);
                    }
                    Err(message) => self.complain(place, &key_path, message),
                }
            }
            for key in ["name", "x_m", "y_m"] {
                if !table.contains_key(key) {
                    self.complain(
                        here.clone(),
                        &format!("{path}[{index}]"),
                        format!("has no {key}"),
                    );
                }
            }
            list.push(Value::Table(receiver));
        }
        self.store(path, Value::Array(list), here);
    }

    /// Changes one coordinate of the receiver called `name`.
    pub(super) fn set_receiver(&mut self, name: &str, key: &str, value: Value, origin: Origin) {
        let path = format!("receivers.{name}.{key}");
        let value = match receiver_value(key, Some(value)) {
            Ok(value) => value,
            Err(message) => return self.complain(origin, &path, message),
        };
        let list = self
            .table
            .get_mut("receivers")
            .and_then(Value::as_array_mut);
        let found = list.and_then(|list| {
            list.iter_mut()
                .enumerate()
                .find(|(_, r)| r.get("name").and_then(Value::as_str) == Some(name))
        });
        match found.and_then(|(index, r)| Some((index, r.as_table_mut()?))) {
            Some((index, receiver)) => {
                receiver.insert(key.to_owned(), value);
                self.origins
                    .insert(format!("receivers[{index}].{key}"), origin);
            }
            None => self.complain(origin, &path, format!("no receiver is called {name}")),
        }
    }
}

/// A checked value of a receiver's key.
fn receiver_value(key: &str, value: Option<Value>) -> Result<Value, String> {
    match (key, value) {
        ("name", Some(Value::String(name))) if is_name(&name) => Ok(Value::String(name)),
        ("name", Some(Value::String(name))) => Err(format!(
            "\"{name}\" is not a name: a letter, then letters and digits"
        )),
        ("name", Some(other)) => Err(format!("expected a name, found {}", describe(&other))),
        (key, Some(value)) if PLACE.contains(&key) => typed(Kind::Number(Range::ANY), value)
            .map_err(|found| format!("expected a number (m), found {found}")),
        (key, None) if PLACE.contains(&key) || key == "name" => Err("found a table".into()),
        _ => Err("unknown field; a receiver has name, x_m, y_m".into()),
    }
}

/// Names become column names, so they are plain words.
fn is_name(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic())
        && name.chars().all(|c| c.is_ascii_alphanumeric())
}
