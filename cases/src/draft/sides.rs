//! Sides of the body: a method's name and its parameters, checked against the solver's own table.

use super::{Draft, describe, plain};
use crate::error::{Origin, hint, nearest};
use crate::field::{Kind, Range, quoted};
use anechoic_solver::boundary::{METHODS, Param, ParamKind, find};
use toml::{Table, Value};
use toml_edit::Item;

/// The sides, as fields.
pub(super) const SIDES: [&str; 6] = [
    "boundary.left",
    "boundary.right",
    "boundary.bottom",
    "boundary.top",
    "boundary.back",
    "boundary.front",
];

impl Draft {
    /// Lays `{ method = "...", parameters }` over a side. Naming a method starts the side afresh,
    /// since parameters belong to a method.
    pub(super) fn lay_side(
        &mut self,
        path: &str,
        item: &Item,
        here: Origin,
        origin: &dyn Fn(usize) -> Origin,
    ) {
        let Some(side) = item.as_table_like() else {
            let found = plain(item).map_or("a list".into(), |value| describe(&value));
            return self.wrong_type(path, Kind::Side, &found, here);
        };
        if side.contains_key("method") {
            self.clear_side(path);
        }
        for (key, item) in side.iter() {
            let place = side
                .get_key_value(key)
                .and_then(|(key, _)| key.span())
                .map_or_else(|| here.clone(), |span| origin(span.start));
            match plain(item) {
                Some(value) => self.put_side(path, key, value, place),
                None => {
                    let message = "expected a number or a word, found a table".into();
                    self.complain(place, &format!("{path}.{key}"), message);
                }
            }
        }
    }

    /// Stores one key of a side; types and ranges are checked when the method is known.
    pub(super) fn put_side(&mut self, side: &str, key: &str, value: Value, origin: Origin) {
        let path = format!("{side}.{key}");
        match (key, &value) {
            ("method", Value::String(_)) => self.store(&path, value, origin),
            ("method", other) => {
                let message = format!("expected a method's name, found {}", describe(other));
                self.complain(origin, &path, message);
            }
            (_, Value::Integer(number)) => {
                let number = *number as f64;
                self.store(&path, Value::Float(number), origin);
            }
            _ => self.store(&path, value, origin),
        }
    }

    /// Forgets method and parameters of a side.
    pub(super) fn clear_side(&mut self, path: &str) {
        let prefix = format!("{path}.");
        self.origins.retain(|key, _| !key.starts_with(&prefix));
        if let Some((group, side)) = path.split_once('.')
            && let Some(group) = self.table.get_mut(group).and_then(Value::as_table_mut)
        {
            group.insert(side.to_owned(), Value::Table(Table::new()));
        }
    }

    /// The method's name of a side.
    pub(super) fn method_of(&self, side: &str) -> Option<&str> {
        self.get(&format!("{side}.method")).and_then(Value::as_str)
    }

    /// Checks methods and parameters of all sides.
    pub(super) fn check_sides(&mut self) {
        for side in SIDES {
            let Some(Value::Table(values)) = self.get(side).cloned() else {
                continue;
            };
            let path = format!("{side}.method");
            let origin = self.origin(&path);
            let Some(name) = values.get("method").and_then(Value::as_str) else {
                self.complain(origin, &path, "is missing".into());
                continue;
            };
            let Some(method) = find(name) else {
                let names: Vec<&str> = METHODS.iter().map(|m| m.name).collect();
                let near = nearest(name, names.iter().copied());
                let message = format!(
                    "unknown method \"{name}\"{}; known: {}",
                    hint(&near),
                    names.join(", ")
                );
                self.complain(origin, &path, message);
                continue;
            };
            for (key, value) in values.iter().filter(|(key, _)| *key != "method") {
                let path = format!("{side}.{key}");
                let message = match method.params.iter().find(|p| p.name == key) {
                    Some(param) => wrong_value(param, value),
                    None => Some(unknown_parameter(name, key, method.params)),
                };
                if let Some(message) = message {
                    self.complain(self.origin(&path), &path, message);
                }
            }
        }
    }
}

/// What is wrong with a parameter's value, if anything.
fn wrong_value(param: &Param, value: &Value) -> Option<String> {
    match (param.kind, value) {
        (ParamKind::Number { min, max, unit, .. }, Value::Float(x)) => {
            let range = Range::within(min, max);
            let unit = if unit == "1" {
                String::new()
            } else {
                format!(" {unit}")
            };
            (!range.holds(*x)).then(|| format!("{x}{unit} is out of range; allowed: {range}"))
        }
        (ParamKind::Number { .. }, other) => {
            Some(format!("expected a number, found {}", describe(other)))
        }
        (ParamKind::Choice(words), Value::String(word)) if words.contains(&word.as_str()) => None,
        (ParamKind::Choice(words), Value::String(word)) => Some(format!(
            "unknown word \"{word}\"{}; allowed: {}",
            hint(&nearest(word, words.iter().copied())),
            quoted(words)
        )),
        (ParamKind::Choice(words), other) => Some(format!(
            "expected one of {}, found {}",
            quoted(words),
            describe(other)
        )),
    }
}

/// What to say of a parameter that the method does not have.
pub(super) fn unknown_parameter(method: &str, key: &str, params: &[Param]) -> String {
    let names: Vec<&str> = params.iter().map(|p| p.name).collect();
    let known = if names.is_empty() {
        "it has none".to_owned()
    } else {
        format!("its parameters: {}", names.join(", "))
    };
    format!(
        "{method} has no such parameter{}; {known}",
        hint(&nearest(key, names.iter().copied()))
    )
}
