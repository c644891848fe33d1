//! What a boundary method says of itself, and how a side names a method with its parameters.

use crate::problem::Transfer;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Value of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// A number in the parameter's unit.
    Number(f64),
    /// One of the parameter's choices.
    Text(String),
}

/// What values a parameter takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ParamKind {
    /// A number between `min` and `max`, both included, in `unit`; `default` in SI.
    Number {
        /// Unit as written.
        unit: &'static str,
        /// Used when the side does not name it; `None`: derived from the scene as the doc says.
        default: Option<f64>,
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
    },
    /// One of several words; the first is the default.
    Choice(&'static [&'static str]),
}

/// Values of a parameter that tell accuracy from cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ladder {
    /// The parameter.
    pub param: &'static str,
    /// Its values.
    pub rungs: Rungs,
}

/// Values on a ladder.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rungs {
    /// Lengths, in cells.
    Cells(&'static [f64]),
    /// Numbers in the parameter's unit.
    Numbers(&'static [f64]),
}

/// A parameter of a boundary method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Param {
    /// Key, for example `thickness_m`.
    pub name: &'static str,
    /// What it does, in a line.
    pub doc: &'static str,
    /// What it may be.
    pub kind: ParamKind,
}

/// The method of one side, with the parameters that differ from the defaults.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SideMethod {
    /// Name of the method, see [`super::METHODS`].
    pub method: String,
    /// Parameters by key.
    #[serde(flatten)]
    pub params: BTreeMap<String, Value>,
}

impl SideMethod {
    /// The method `name` with its default parameters.
    pub fn new(name: &str) -> Self {
        SideMethod {
            method: name.to_owned(),
            params: BTreeMap::new(),
        }
    }

    /// The same with the number `value` for `key`.
    pub fn with(mut self, key: &str, value: f64) -> Self {
        self.params.insert(key.to_owned(), Value::Number(value));
        self
    }

    /// The same with the choice `value` for `key`.
    pub fn with_choice(mut self, key: &str, value: &str) -> Self {
        self.params
            .insert(key.to_owned(), Value::Text(value.to_owned()));
        self
    }

    /// The number given for `key`, if any.
    pub fn given_number(&self, key: &str) -> Option<f64> {
        match self.params.get(key) {
            Some(Value::Number(x)) => Some(*x),
            _ => None,
        }
    }

    /// The number for `key`, or the default that `info` gives it.
    ///
    /// # Panics
    /// When `info` has no such number with a default: a bug of the method's file.
    pub(crate) fn number(&self, info: &MethodInfo, key: &str) -> f64 {
        self.given_number(key)
            .unwrap_or_else(|| match info.param(key).map(|p| p.kind) {
                Some(ParamKind::Number {
                    default: Some(x), ..
                }) => x,
                _ => unreachable!("{}.{key} has no default", info.name),
            })
    }

    /// The choice for `key`, or the first that `info` offers.
    ///
    /// # Panics
    /// When `info` has no such choice: a bug of the method's file.
    pub(crate) fn choice<'a>(&'a self, info: &MethodInfo, key: &str) -> &'a str {
        match (self.params.get(key), info.param(key).map(|p| p.kind)) {
            (Some(Value::Text(x)), _) => x,
            (_, Some(ParamKind::Choice(words))) => words[0],
            _ => unreachable!("{}.{key} is not a choice", info.name),
        }
    }
}

/// A boundary method as its file exports it.
#[derive(Debug)]
pub struct MethodInfo {
    /// Name in rows and flags.
    pub name: &'static str,
    /// What it is, in a line.
    pub summary: &'static str,
    /// Its parameters.
    pub params: &'static [Param],
    /// What a study of accuracy against cost tries, every combination; empty: the method as it is.
    pub ladder: &'static [Ladder],
    /// Values at which a study of stability looks, one parameter at a time.
    pub extremes: &'static [Ladder],
    /// Can it only take energy away, whatever the motion and its parameters?
    pub passive: bool,
    /// What it costs on a side, for the bill.
    pub upkeep: fn(&SideMethod, Transfer) -> Upkeep,
}

/// What a method on a side adds to a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Upkeep {
    /// What it keeps, in words.
    pub holds: &'static str,
    /// Vectors on each point of its own layer.
    pub point_vectors: usize,
    /// Matrices on each of them.
    pub point_matrices: usize,
    /// Matrices more on those of them that lie in the layers of several sides, in three dimensions.
    pub overlap_matrices: usize,
    /// Vectors on each node.
    pub node_vectors: usize,
    /// Work on each point of its own layer in a step, over that of a small-strain force.
    pub forces: f64,
    /// Passes of a vector between all points and nodes in a step.
    pub passes: f64,
}

impl Upkeep {
    /// That of a method that only holds or frees nodes.
    pub fn none(_: &SideMethod, _: Transfer) -> Self {
        Upkeep::default()
    }
}

impl MethodInfo {
    /// The parameter called `key`.
    pub fn param(&self, key: &str) -> Option<&'static Param> {
        self.params.iter().find(|p| p.name == key)
    }
}
