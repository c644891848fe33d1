//! Errors of one scene on several levels of refinement, and the orders they fall with.
//!
//! Rows are named so that programs can tell them apart: an error on a level has the place
//! `PLACE@FIELD=VALUE` (`R1@grid.h_m=10`); an `order` has `PLACE:METRIC` (`R1:rel_l2`), the ends of its
//! 95 % interval `PLACE:METRIC:low` and `:high`, and the order between neighbours
//! `PLACE:METRIC@FIELD=COARSE..FINE`. The last kind of place has a row `plateau` as well where the error
//! no longer falls from COARSE to the finest level.

use crate::budget::Budget;
use crate::judge::Measurement;
use crate::norms::{Order, order};
use crate::plateau::{PLATEAU, Plateau};
use anechoic_reference::claim::Evidence;
use serde::{Deserialize, Serialize};

/// The metric of orders.
pub const ORDER: &str = "order";

/// One level of refinement.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// The field's value as asked for.
    pub value: f64,
    /// What errors are set against: the edge (m) of the cells in use where cells are refined, the
    /// distance (m) of points where they are, else the value.
    pub size: f64,
}

/// One error at one place on all levels.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Metric id of the error.
    pub metric: String,
    /// The receiver.
    pub place: String,
    /// The errors, or why there is none.
    pub errors: Vec<Result<f64, String>>,
    /// The order over all levels, or why there is none.
    pub order: Result<Order, String>,
    /// Where the error no longer falls.
    #[serde(default)]
    pub plateau: Option<Plateau>,
}

/// Convergence studies of one method, one a field, and the budget of its errors.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Refinement {
    /// The studies, in the order in which they were asked for.
    pub studies: Vec<Convergence>,
    /// What each cause contributes to the errors of the scene as it stands, where that was asked.
    pub budget: Option<Budget>,
}

/// A convergence study of one method over one field.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// The field that was refined, for example `grid.h_m`.
    pub over: String,
    /// Boundary method as in `--method`.
    pub method: String,
    /// Levels, coarse to fine.
    pub levels: Vec<Level>,
    /// Errors, receiver by receiver.
    pub curves: Vec<Curve>,
}

impl Curve {
    /// The order of `errors` at the sizes of `levels`.
    pub fn new(
        metric: &str,
        place: &str,
        levels: &[Level],
        errors: Vec<Result<f64, String>>,
    ) -> Self {
        let sizes: Vec<f64> = levels.iter().map(|level| level.size).collect();
        let numbers: Result<Vec<f64>, String> = errors.iter().cloned().collect();
        Curve {
            metric: metric.to_owned(),
            place: place.to_owned(),
            order: numbers.and_then(|e| order(&sizes, &e).map_err(|error| error.to_string())),
            errors,
            plateau: None,
        }
    }

    /// The same with its plateau, if it ends in one above the reference's `floor`.
    pub fn with_plateau(mut self, floor: f64) -> Self {
        let errors: Result<Vec<f64>, String> = self.errors.iter().cloned().collect();
        if let (Ok(errors), Ok(order)) = (errors, &self.order) {
            self.plateau = Plateau::find(&errors, &order.pairwise, floor);
        }
        self
    }

    /// Where the row of the order stands.
    pub fn order_place(place: &str, metric: &str) -> String {
        format!("{place}:{metric}")
    }
}

/// The name of a level in rows: `grid.h_m=10`.
pub fn label(over: &str, value: f64) -> String {
    format!("{over}={value}")
}

/// The place of a number on a level: `R1@grid.h_m=10`.
pub fn at_level(place: &str, over: &str, value: f64) -> String {
    format!("{place}@{}", label(over, value))
}

impl Convergence {
    /// The levels' names in rows, coarse to fine.
    pub fn labels(&self) -> Vec<String> {
        let values = self.levels.iter();
        values.map(|l| label(&self.over, l.value)).collect()
    }

    /// Orders as measurements: least squares with its interval, and between neighbours.
    pub fn measurements(&self, against: Option<(Evidence, &str)>) -> Vec<Measurement> {
        let mut all = Vec::new();
        for curve in &self.curves {
            let place = Curve::order_place(&curve.place, &curve.metric);
            let mut add = |place: String, value| {
                all.push(Measurement {
                    method: self.method.clone(),
                    metric: ORDER.to_owned(),
                    place,
                    value,
                    unit: "1".to_owned(),
                    against: against.map(|(kind, name)| (kind, name.to_owned())),
                });
            };
            let order = match &curve.order {
                Ok(order) => order,
                Err(reason) => {
                    add(place, Err(reason.clone()));
                    continue;
                }
            };
            add(place.clone(), Ok(order.fit.value));
            if let Some([low, high]) = order.fit.interval {
                add(format!("{place}:low"), Ok(low));
                add(format!("{place}:high"), Ok(high));
            }
            for (pair, value) in self.levels.windows(2).zip(&order.pairwise) {
                let between = format!("{}={}..{}", self.over, pair[0].value, pair[1].value);
                add(format!("{place}@{between}"), Ok(*value));
            }
        }
        all.extend(self.plateaus());
        all
    }

    /// Where errors no longer fall, and what holds them up.
    fn plateaus(&self) -> Vec<Measurement> {
        let row = |curve: &Curve| {
            let plateau = curve.plateau.as_ref()?;
            let place = Curve::order_place(&curve.place, &curve.metric);
            let [from, to] = [self.levels.get(plateau.from)?, self.levels.last()?].map(|l| l.value);
            let other = plateau.other.as_ref();
            Some(Measurement {
                method: self.method.clone(),
                metric: PLATEAU.to_owned(),
                place: format!("{place}@{}={from}..{to}", self.over),
                value: Ok(plateau.order),
                unit: "1".to_owned(),
                against: other.map(|other| (other.evidence, plateau.held_by())),
            })
        };
        self.curves.iter().filter_map(row).collect()
    }

    /// The plateaus in words, one a line.
    pub fn plateau_notes(&self) -> Vec<String> {
        let note = |curve: &Curve| {
            let plateau = curve.plateau.as_ref()?;
            Some(format!(
                "plateau: {} at {} no longer falls from {} on (order {:.2}): {}",
                curve.metric,
                curve.place,
                label(&self.over, self.levels.get(plateau.from)?.value),
                plateau.order,
                plateau.held_by()
            ))
        };
        self.curves.iter().filter_map(note).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn levels() -> Vec<Level> {
        let level = |value: f64| Level { value, size: value };
        [4.0, 2.0, 1.0].map(level).to_vec()
    }

    fn study(errors: Vec<Result<f64, String>>) -> Convergence {
        Convergence {
            over: "grid.h_m".into(),
            method: "fixed".into(),
            levels: levels(),
            curves: vec![Curve::new("rel_l2", "A", &levels(), errors)],
        }
    }

    #[test]
    fn orders_are_told_apart_by_their_places() {
        let rows = study(vec![Ok(0.16), Ok(0.04), Ok(0.01)]).measurements(None);
        let places: Vec<&str> = rows.iter().map(|m| m.place.as_str()).collect();
        assert_eq!(
            places,
            [
                "A:rel_l2",
                "A:rel_l2:low",
                "A:rel_l2:high",
                "A:rel_l2@grid.h_m=4..2",
                "A:rel_l2@grid.h_m=2..1"
            ]
        );
        assert!(rows.iter().all(|m| m.metric == ORDER));
        for row in &rows {
            assert!((row.value.clone().expect("a number") - 2.0).abs() < 1e-9);
        }
        assert_eq!(at_level("A", "grid.h_m", 0.5), "A@grid.h_m=0.5");
    }

    #[test]
    fn a_plateau_has_a_row_from_its_first_level_to_the_finest() {
        let mut flat = study(vec![Ok(0.16), Ok(0.15), Ok(0.149)]);
        assert_eq!(flat.plateau_notes(), Vec::<String>::new());
        flat.curves = vec![flat.curves[0].clone().with_plateau(0.0)];
        let rows = flat.measurements(None);
        let row = rows
            .iter()
            .find(|row| row.metric == PLATEAU)
            .expect("a plateau");
        assert_eq!(row.place, "A:rel_l2@grid.h_m=4..1");
        assert!(flat.plateau_notes()[0].contains("rel_l2 at A no longer falls from grid.h_m=4 on"));
    }

    #[test]
    fn a_level_without_an_error_leaves_no_order() {
        let failed = Err("the run failed: it grew".to_owned());
        let rows = study(vec![Ok(0.16), failed, Ok(0.01)]).measurements(None);
        assert_eq!(rows.len(), 1);
        let why = rows[0].value.clone().expect_err("no order");
        assert!(why.contains("it grew"));
    }
}
