//! `--set field=value` and `--set METHOD.parameter=value`.

use super::sides::{SIDES, unknown_parameter};
use super::{Draft, plain};
use crate::error::{CaseError, Origin};
use crate::field::Kind;
use anechoic_solver::boundary::find;
use toml::Value;
use toml_edit::Item;

impl Draft {
    /// Lays one assignment over what stands.
    ///
    /// # Errors
    /// [`CaseError::Usage`] when it is no assignment. Unknown fields and wrong types are collected.
    pub fn set(&mut self, assignment: &str) -> Result<(), CaseError> {
        let Some((path, text)) = assignment.split_once('=') else {
            return Err(CaseError::Usage(format!(
                "--set {assignment}: expected field=value, for example --set grid.h_m=0.5"
            )));
        };
        let (path, text) = (path.trim(), text.trim());
        if path.is_empty() || text.is_empty() {
            return Err(CaseError::Usage(format!(
                "--set {assignment}: field and value must not be empty"
            )));
        }
        let origin = Origin::Set(assignment.to_owned());
        let item = &value_item(text);
        match self.field(path).map(|field| field.kind) {
            Some(Kind::Side) => self.lay_side(path, item, origin.clone(), &|_| origin.clone()),
            Some(Kind::Receivers) => {
                self.lay_receivers(path, item, origin.clone(), &|_| origin.clone());
            }
            Some(kind) => match plain(item) {
                Some(value) => self.put(path, kind, value, origin),
                None => self.wrong_type(path, kind, "a table", origin),
            },
            None => self.set_inside(path, item, origin),
        }
        Ok(())
    }

    /// Assignments to what lies below a field: a side's parameter, a receiver's place, a method.
    fn set_inside(&mut self, path: &str, item: &Item, origin: Origin) {
        let (head, key) = path.rsplit_once('.').unwrap_or((path, ""));
        let Some(value) = plain(item) else {
            return self.unknown(path, origin);
        };
        if SIDES.contains(&head) && self.field(head).is_some() {
            if key == "method" && value.as_str() != self.method_of(head) {
                self.clear_side(head);
            }
            self.put_side(head, key, value, origin);
        } else if let Some(name) = head.strip_prefix("receivers.") {
            self.set_receiver(name, key, value, origin);
        } else if find(head).is_some() && !key.is_empty() {
            self.set_method(head, key, value, origin);
        } else if self.is_group(path) {
            let message = self.group_message(path);
            self.complain(origin, path, message);
        } else {
            self.unknown(path, origin);
        }
    }

    /// Sets a parameter on every side that uses the method.
    fn set_method(&mut self, method: &str, key: &str, value: Value, origin: Origin) {
        let params = find(method).map_or(&[][..], |info| info.params);
        if !params.iter().any(|p| p.name == key) {
            let message = unknown_parameter(method, key, params);
            return self.complain(origin, &format!("{method}.{key}"), message);
        }
        let sides: Vec<&str> = SIDES
            .into_iter()
            .filter(|side| self.method_of(side) == Some(method))
            .collect();
        if sides.is_empty() {
            self.unused.push(origin.to_string());
        }
        for side in sides {
            self.put_side(side, key, value.clone(), origin.clone());
        }
    }
}

/// The text as a TOML value, or as the bare word that it is.
fn value_item(text: &str) -> Item {
    text.parse::<toml_edit::Value>()
        .unwrap_or_else(|_| toml_edit::Value::from(text))
        .into()
}
