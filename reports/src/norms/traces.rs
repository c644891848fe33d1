//! Vector series at receivers: what the norms compare.

use super::{NormError, check_finite, check_length, check_times};
use anechoic_solver::record::SeriesTable;
use std::collections::BTreeSet;

/// Series of one receiver.
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// Name, for example `A1`.
    pub name: String,
    /// One series a component of the vector, each as long as the times.
    pub components: Vec<Vec<f64>>,
}

impl Trace {
    /// The vector's magnitude at each time.
    pub fn magnitude(&self) -> Vec<f64> {
        let samples = self.components.first().map_or(0, Vec::len);
        (0..samples)
            .map(|i| {
                self.components
                    .iter()
                    .map(|c| c[i] * c[i])
                    .sum::<f64>()
                    .sqrt()
            })
            .collect()
    }

    /// Magnitude of the difference to `other` at each time; both have the same shape.
    pub(super) fn distance(&self, other: &Trace) -> Vec<f64> {
        let components = self
            .components
            .iter()
            .zip(&other.components)
            .map(|(a, b)| a.iter().zip(b).map(|(x, y)| x - y).collect())
            .collect();
        Trace {
            name: String::new(),
            components,
        }
        .magnitude()
    }
}

/// Vector series at several receivers over the same times.
#[derive(Clone, Debug, PartialEq)]
pub struct Traces {
    times: Vec<f64>,
    receivers: Vec<Trace>,
}

impl Traces {
    /// Checks shapes, names and finiteness once, so that no norm has to.
    ///
    /// `times` in seconds, strictly increasing; every component as long as `times`; every receiver
    /// with the same number of components, at least one.
    pub fn new(times: Vec<f64>, receivers: Vec<Trace>) -> Result<Self, NormError> {
        check_times(&times)?;
        let Some(first) = receivers.first() else {
            return Err(NormError::TooFew {
                what: "a comparison of receivers",
                needed: 1,
                found: 0,
            });
        };
        let dimension = first.components.len().max(1);
        let mut names = BTreeSet::new();
        for trace in &receivers {
            if !names.insert(trace.name.as_str()) {
                return Err(NormError::AmbiguousReceiver {
                    receiver: trace.name.clone(),
                });
            }
            let what = format!("the components of receiver {}", trace.name);
            check_length(&what, dimension, trace.components.len())?;
            for (axis, component) in trace.components.iter().enumerate() {
                let what = format!("component {axis} of receiver {}", trace.name);
                check_length(&what, times.len(), component.len())?;
                check_finite(&what, component)?;
            }
        }
        Ok(Traces { times, receivers })
    }

    /// Takes the columns `NAME_SUFFIX` of a record's table, one component a suffix, in their order.
    ///
    /// `["ux", "uy"]` gives displacements (m), `["vx", "vy"]` velocities (m/s). Receivers are those
    /// with a column of any of them, in the table's order; each must have all.
    pub fn from_table(table: &SeriesTable, suffixes: &[&str]) -> Result<Self, NormError> {
        let mut names: Vec<&str> = Vec::new();
        for column in &table.columns {
            let receiver = suffixes
                .iter()
                .find_map(|suffix| column.name.strip_suffix(suffix)?.strip_suffix('_'));
            if let Some(name) = receiver.filter(|name| !names.contains(name)) {
                names.push(name);
            }
        }
        if names.is_empty() {
            return Err(NormError::MissingColumn {
                column: format!("*_{}", suffixes.join(" or *_")),
            });
        }
        let receivers = names
            .into_iter()
            .map(|name| Self::receiver_of_table(table, name, suffixes))
            .collect::<Result<_, _>>()?;
        Self::new(table.times.clone(), receivers)
    }

    fn receiver_of_table(
        table: &SeriesTable,
        name: &str,
        suffixes: &[&str],
    ) -> Result<Trace, NormError> {
        let components = suffixes
            .iter()
            .map(|suffix| {
                let column = format!("{name}_{suffix}");
                match table.column(&column) {
                    Some(values) => Ok(values.to_vec()),
                    None => Err(NormError::MissingColumn { column }),
                }
            })
            .collect::<Result<_, _>>()?;
        Ok(Trace {
            name: name.to_owned(),
            components,
        })
    }

    /// Sampling times (s).
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The receivers in their order.
    pub fn receivers(&self) -> &[Trace] {
        &self.receivers
    }

    /// The receiver called `name`.
    pub fn receiver(&self, name: &str) -> Option<&Trace> {
        self.receivers.iter().find(|r| r.name == name)
    }

    /// Pairs each receiver with its counterpart in `other` (named `side` in errors).
    ///
    /// Both must have the same times to a millionth of the sampling interval, receivers and
    /// number of components.
    pub(super) fn pair<'a>(
        &'a self,
        other: &'a Traces,
        side: &'static str,
    ) -> Result<Vec<(&'a Trace, &'a Trace)>, NormError> {
        self.same_times(other)?;
        if let Some(extra) = other
            .receivers
            .iter()
            .find(|r| self.receiver(&r.name).is_none())
        {
            return Err(NormError::MissingReceiver {
                receiver: extra.name.clone(),
                from: "the method's record",
            });
        }
        self.receivers
            .iter()
            .map(|mine| {
                let theirs =
                    other
                        .receiver(&mine.name)
                        .ok_or_else(|| NormError::MissingReceiver {
                            receiver: mine.name.clone(),
                            from: side,
                        })?;
                let what = format!("receiver {} of {side}", mine.name);
                check_length(&what, mine.components.len(), theirs.components.len())?;
                Ok((mine, theirs))
            })
            .collect()
    }

    fn same_times(&self, other: &Traces) -> Result<(), NormError> {
        check_length("the times", self.times.len(), other.times.len())?;
        let span = self.times[self.times.len() - 1] - self.times[0];
        let tolerance = 1e-6 * span / self.times.len() as f64;
        let differ = |(a, b): (&f64, &f64)| (a - b).abs() > tolerance;
        match self.times.iter().zip(&other.times).position(differ) {
            None => Ok(()),
            Some(index) => Err(NormError::Times {
                index,
                left: self.times[index],
                right: other.times[index],
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use anechoic_solver::record::Column;

    fn trace(name: &str, values: &[f64]) -> Trace {
        Trace {
            name: name.to_owned(),
            components: vec![values.to_vec()],
        }
    }

    fn column(name: &str, values: &[f64]) -> Column {
        Column {
            name: name.to_owned(),
            unit: "m".to_owned(),
            values: values.to_vec(),
        }
    }

    #[test]
    fn magnitude_is_the_vectors_length() {
        let t = Trace {
            name: "A1".to_owned(),
            components: vec![vec![3.0, 0.0], vec![-4.0, 2.0]],
        };
        assert_eq!(t.magnitude(), vec![5.0, 2.0]);
    }

    #[test]
    fn damaged_series_are_refused() {
        let times = vec![0.0, 1.0];
        let nan = Traces::new(times.clone(), vec![trace("A", &[0.0, f64::NAN])]);
        assert!(matches!(nan, Err(NormError::NonFinite { index: 1, .. })));
        let short = Traces::new(times.clone(), vec![trace("A", &[0.0])]);
        assert!(matches!(
            short,
            Err(NormError::Shape {
                expected: 2,
                found: 1,
                ..
            })
        ));
        let twice = Traces::new(
            times.clone(),
            vec![trace("A", &[0.0, 1.0]), trace("A", &[0.0, 1.0])],
        );
        assert!(matches!(twice, Err(NormError::AmbiguousReceiver { .. })));
        let backwards = Traces::new(vec![1.0, 1.0], vec![trace("A", &[0.0, 1.0])]);
        assert_eq!(backwards, Err(NormError::NotIncreasing { index: 1 }));
        assert!(matches!(
            Traces::new(times, vec![]),
            Err(NormError::TooFew { .. })
        ));
    }

    #[test]
    fn table_columns_become_components_in_the_order_asked_for() {
        let table = SeriesTable {
            times: vec![0.0, 1.0],
            columns: vec![
                column("A1_ux", &[1.0, 2.0]),
                column("A1_uy", &[3.0, 4.0]),
                column("B_ux", &[5.0, 6.0]),
                column("B_uy", &[7.0, 8.0]),
            ],
        };
        let traces = Traces::from_table(&table, &["ux", "uy"]).expect("the table is whole");
        let b = traces.receiver("B").expect("B is in the table");
        assert_eq!(b.components, vec![vec![5.0, 6.0], vec![7.0, 8.0]]);
        let velocities = Traces::from_table(&table, &["vx"]);
        assert!(matches!(velocities, Err(NormError::MissingColumn { .. })));
        let partial = Traces::from_table(&table, &["ux", "vz"]);
        assert_eq!(
            partial,
            Err(NormError::MissingColumn {
                column: "A1_vz".to_owned()
            })
        );
        let headless = SeriesTable {
            times: vec![0.0, 1.0],
            columns: vec![column("A1_uy", &[3.0, 4.0])],
        };
        assert!(Traces::from_table(&headless, &["ux", "uy"]).is_err());
    }

    #[test]
    fn pairs_need_the_same_receivers_and_times() {
        let times = vec![0.0, 1.0];
        let a = Traces::new(times.clone(), vec![trace("A", &[0.0, 1.0])]).expect("valid");
        let b = Traces::new(times.clone(), vec![trace("B", &[0.0, 1.0])]).expect("valid");
        let both = Traces::new(
            times,
            vec![trace("A", &[0.0, 1.0]), trace("B", &[0.0, 1.0])],
        )
        .expect("valid");
        let late = Traces::new(vec![0.0, 1.1], vec![trace("A", &[0.0, 1.0])]).expect("valid");
        let missing = both.pair(&a, "the reference");
        assert_eq!(
            missing,
            Err(NormError::MissingReceiver {
                receiver: "B".to_owned(),
                from: "the reference"
            })
        );
        assert!(matches!(
            a.pair(&both, "the reference"),
            Err(NormError::MissingReceiver { .. })
        ));
        assert!(a.pair(&b, "the reference").is_err());
        assert_eq!(
            a.pair(&late, "the reference"),
            Err(NormError::Times {
                index: 1,
                left: 1.0,
                right: 1.1
            })
        );
    }
}
