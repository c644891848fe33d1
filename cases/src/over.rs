//! `--over FIELD=VALUE,VALUE,...`: the levels of a convergence study.

use crate::error::{CaseError, hint, nearest};
use anechoic_reports::convergence::label;
use toml::{Table, Value};

/// A field that is refined, and its values, coarse to fine.
#[derive(Clone, Debug, PartialEq)]
pub struct Over {
    /// One of [`REFINING`].
    pub field: String,
    /// At least two different positive values.
    pub values: Vec<f64>,
}

/// Field of the cells' size.
pub const CELLS: &str = "grid.h_m";
/// Field of the time step.
pub const STEP: &str = "time.dt_s";
/// Field of the points in a cell.
pub const POINTS: &str = "points.per_cell";

/// Fields that refine a scene, with the cause whose errors they bound: all else makes it another scene.
pub const REFINING: [(&str, &str); 3] = [(CELLS, "space"), (STEP, "time"), (POINTS, "points")];

/// The cause whose errors a field bounds, for people and in rows.
pub fn cause(field: &str) -> &'static str {
    let found = REFINING.iter().find(|(own, _)| *own == field);
    found.map_or("", |(_, cause)| cause)
}

impl Over {
    /// Reads `FIELD=VALUE,VALUE,...`.
    ///
    /// # Errors
    /// [`CaseError::Refinement`] with what is expected.
    pub fn parse(text: &str) -> Result<Self, CaseError> {
        let wrong = |what: &str| CaseError::Refinement {
            given: text.to_owned(),
            reason: format!(
                "{what}; expected a field and its values, for example --over {CELLS}=20,10,5"
            ),
        };
        let (field, list) = text
            .split_once('=')
            .ok_or_else(|| wrong("there is no `=`"))?;
        let field = field.trim();
        if cause(field).is_empty() {
            let known = REFINING.map(|(own, _)| own);
            let hint = hint(&nearest(field, known));
            return Err(CaseError::Refinement {
                given: field.to_owned(),
                reason: format!(
                    "refines nothing that errors could fall with; {} do, and `sweep` varies anything{hint}",
                    known.join(", ")
                ),
            });
        }
        let mut values = list
            .split(',')
            .map(|word| {
                let number = word.trim().parse::<f64>().ok();
                number
                    .filter(|x| x.is_finite() && *x > 0.0)
                    .ok_or_else(|| wrong(&format!("`{}` is no positive number", word.trim())))
            })
            .collect::<Result<Vec<f64>, _>>()?;
        values.sort_by(f64::total_cmp);
        if let Some(pair) = values.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(wrong(&format!("{} stands there twice", pair[0])));
        }
        if values.len() < 2 {
            return Err(wrong("an order needs two values at least"));
        }
        // more points are finer, smaller cells and steps are
        if field != POINTS {
            values.reverse();
        }
        Ok(Over {
            field: field.to_owned(),
            values,
        })
    }

    /// The levels' assignments, which are their names in rows as well.
    pub fn assignments(&self) -> Vec<String> {
        let values = self.values.iter();
        values.map(|value| label(&self.field, *value)).collect()
    }
}

/// The number that a scene's table has for `field`: a field of its own, or the parameter of a method
/// on the first side that uses it. So records alone tell their level.
pub fn level_in(table: &Table, field: &str) -> Option<f64> {
    let own = || {
        let mut keys = field.split('.');
        let first = table.get(keys.next()?)?;
        number(keys.try_fold(first, |value, key| value.get(key))?)
    };
    let of_method = || {
        let (method, key) = field.split_once('.')?;
        let sides = table.get("boundary")?.as_table()?;
        let uses = |side: &&Value| side.get("method").and_then(Value::as_str) == Some(method);
        number(sides.values().find(uses)?.get(key)?)
    };
    own().or_else(of_method)
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Float(x) => Some(*x),
        Value::Integer(n) => Some(*n as f64),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_come_coarse_to_fine() {
        let over = Over::parse("grid.h_m = 5, 20,10").unwrap();
        assert_eq!(over.values, [20.0, 10.0, 5.0]);
        assert_eq!(
            over.assignments(),
            ["grid.h_m=20", "grid.h_m=10", "grid.h_m=5"]
        );
        assert_eq!(
            Over::parse("points.per_cell=9,4,16").unwrap().values,
            [4.0, 9.0, 16.0]
        );
    }

    #[test]
    fn what_is_no_refinement_is_refused() {
        for (text, part) in [
            ("grid.h_m", "there is no `=`"),
            ("grid.h_m=10", "two values at least"),
            ("grid.h_m=10,ten", "`ten` is no positive number"),
            ("grid.h_m=10,-5", "`-5` is no positive number"),
            ("grid.h_m=10,10.0", "10 stands there twice"),
            ("grid.hm=10,5", "did you mean `grid.h_m`?"),
            ("material.E_Pa=1e7,1e6", "time.dt_s, points.per_cell do"),
        ] {
            let error = Over::parse(text).unwrap_err().to_string();
            let field = text.split('=').next().unwrap();
            assert!(error.contains(part) && error.contains(field), "{error}");
        }
    }

    #[test]
    fn records_tell_their_level() {
        let table: Table = toml::from_str(
            "grid.h_m = 10.0
            points.per_cell = 4
            basis = 'linear'
            boundary.left = { method = 'roller' }
            boundary.right = { method = 'pml', thickness_m = 40.0 }",
        )
        .unwrap();
        assert_eq!(level_in(&table, "grid.h_m"), Some(10.0));
        assert_eq!(level_in(&table, "points.per_cell"), Some(4.0));
        assert_eq!(level_in(&table, "pml.thickness_m"), Some(40.0));
        assert_eq!(level_in(&table, "boundary.right.thickness_m"), Some(40.0));
        for field in [
            "basis",
            "grid",
            "dashpot.impedance",
            "pml.power",
            "receivers.A.x_m",
        ] {
            assert_eq!(level_in(&table, field), None, "{field}");
        }
    }
}
