//! A scene as the TOML file that a user edits: every field with its unit, meaning and range.

use crate::field::{Field, Kind, Range};
use crate::prepare::Prepared;
use anechoic_solver::boundary::{METHODS, ParamKind};
use std::fmt::Write;
use toml::{Table, Value};

/// The file: it names case and profile, and holds every field.
pub fn write(prepared: &Prepared) -> String {
    let mut text = format!(
        "# {}: {}\n# {}\ncase = \"{}\"\nprofile = \"{}\"\n",
        prepared.info.name,
        prepared.info.title,
        prepared.info.source,
        prepared.info.name,
        prepared.profile
    );
    // The step is the only field that a scene derives.
    let dt = prepared.scene.posed().dt();
    let fields = prepared.info.all_fields();
    for field in fields.iter().filter(|f| !f.path.contains('.')) {
        if field.kind != Kind::Receivers {
            line(&mut text, field, field.path, &prepared.table, dt);
        }
    }
    let mut groups: Vec<&str> = Vec::new();
    for group in fields
        .iter()
        .filter_map(|f| Some(f.path.split_once('.')?.0))
    {
        if !groups.contains(&group) {
            groups.push(group);
        }
    }
    for group in groups {
        let _ = write!(text, "\n[{group}]\n");
        for field in &fields {
            if let Some((_, key)) = field.path.split_once('.').filter(|(g, _)| *g == group)
                && let Some(Value::Table(values)) = prepared.table.get(group)
            {
                line(&mut text, field, key, values, dt);
            }
        }
    }
    receivers(&mut text, &prepared.table);
    text.push_str(&methods());
    text
}

/// `key = value  # what it is; what is allowed`, or the same as a comment for what is left out,
/// with the value that it has then.
fn line(text: &mut String, field: &Field, key: &str, values: &Table, derived: f64) {
    let allowed = match field.kind {
        Kind::Number(range) | Kind::OptionalNumber(range, _) => format!("; {range}"),
        Kind::Whole(min, max) => format!("; {min} <= value <= {max}"),
        Kind::Word(words) => format!("; {}", words.join(", ")),
        Kind::Receivers | Kind::Side => String::new(),
    };
    let _ = match (values.get(key), field.kind) {
        (Some(value), _) => {
            let value = inline(value);
            writeln!(text, "{key} = {value}  # {}{allowed}", field.doc)
        }
        (None, Kind::OptionalNumber(_, when_absent)) => {
            writeln!(
                text,
                "# {key} = {derived:?}  # {}{allowed}; {when_absent}",
                field.doc
            )
        }
        (None, _) => Ok(()),
    };
}

/// A value on one line; of a side, the method comes first.
fn inline(value: &Value) -> String {
    match value {
        Value::Table(table) => {
            let mut keys: Vec<&String> = table.keys().collect();
            keys.sort_by_key(|key| *key != "method");
            let parts: Vec<String> = keys
                .into_iter()
                .map(|key| format!("{key} = {}", inline(&table[key])))
                .collect();
            format!("{{ {} }}", parts.join(", "))
        }
        // TOML wants a point or a power in every number that is not whole.
        Value::Float(x) => format!("{x:?}"),
        other => other.to_string(),
    }
}

fn receivers(text: &mut String, table: &Table) {
    for receiver in table
        .get("receivers")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
    {
        text.push_str("\n[[receivers]]\n");
        for key in ["name", "x_m", "y_m", "z_m"] {
            if let Some(value) = receiver.get(key) {
                let _ = writeln!(text, "{key} = {}", inline(value));
            }
        }
    }
}

/// The boundary methods with their parameters, as comments.
fn methods() -> String {
    let mut text = String::from("\n# Methods of a side and their parameters:\n");
    for method in METHODS {
        let _ = writeln!(text, "#   {}: {}", method.name, method.summary);
        for param in method.params {
            let allowed = match param.kind {
                ParamKind::Number {
                    unit,
                    default,
                    min,
                    max,
                } => {
                    let default = default.map_or(String::new(), |d| format!(", {d} by default"));
                    let unit = if unit == "1" { "" } else { unit };
                    format!("{} {unit}{default}", Range::within(min, max)).replace(" ,", ",")
                }
                ParamKind::Choice(words) => format!("{} (first: default)", words.join(", ")),
            };
            let _ = writeln!(text, "#     {}: {}; {allowed}", param.name, param.doc);
        }
    }
    text
}
