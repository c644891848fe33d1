//! Methods in the order of their echo, with what they cost beside it.

use crate::judge::RUN;
use crate::norms::{group_of, group_worst};
use crate::row::Row;
use serde::{Deserialize, Serialize};

/// Below which echo a reference cannot tell methods apart.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Floor {
    /// The floor, in the unit of the ranked metric.
    pub value: f64,
    /// How it was found, for example `change under a larger buffer`.
    pub how: String,
}

/// One method in a ranking.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ranked {
    /// Boundary method as in `--method`.
    pub method: String,
    /// Mean echo over the groups; `None`: not measured, and therefore not ranked.
    pub echo: Option<f64>,
    /// Worst echo of any receiver.
    pub worst: Option<f64>,
    /// CPU time (s).
    pub cpu_s: Option<f64>,
    /// Unknowns of the linear system.
    pub unknowns: Option<f64>,
    /// Largest memory at once (bytes).
    pub peak_bytes: Option<f64>,
    /// Place, from 1; methods at or below the floor share the first. `None`: not ranked.
    pub rank: Option<usize>,
}

/// A ranking by one metric.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ranking {
    /// The metric, for example `echo_ratio`.
    pub metric: String,
    /// The floor of the reference, if known.
    pub floor: Option<Floor>,
    /// Methods, best first; those without a number at the end.
    pub methods: Vec<Ranked>,
}

impl Ranking {
    /// Ranks the methods of `rows` by `metric`: the smaller, the better.
    ///
    /// Methods at or below the floor tie and stand in the order of their CPU time.
    pub fn from_rows(rows: &[Row], metric: &str, floor: Option<Floor>) -> Self {
        let mut names: Vec<&str> = Vec::new();
        for row in rows {
            if !names.contains(&row.method.as_str()) {
                names.push(&row.method);
            }
        }
        let limit = floor.as_ref().map_or(0.0, |f| f.value);
        let groups = groups_of(rows, metric);
        let mut methods: Vec<Ranked> = names
            .iter()
            .map(|name| entry(rows, name, metric, &groups))
            .collect();
        methods.sort_by(|a, b| {
            let key = |m: &Ranked| m.echo.map_or(f64::INFINITY, |e| e.max(limit));
            let cpu = |m: &Ranked| m.cpu_s.unwrap_or(f64::INFINITY);
            key(a)
                .total_cmp(&key(b))
                .then(cpu(a).total_cmp(&cpu(b)))
                .then_with(|| a.method.cmp(&b.method))
        });
        for i in 0..methods.len() {
            methods[i].rank = methods[i].echo.map(|echo| match methods[..i].last() {
                Some(before) if before.echo.is_some_and(|b| b.max(limit) == echo.max(limit)) => {
                    before.rank.unwrap_or(i + 1)
                }
                _ => i + 1,
            });
        }
        Ranking {
            metric: metric.to_owned(),
            floor,
            methods,
        }
    }

    /// Is `echo` at or below the floor?
    pub fn below_floor(&self, echo: f64) -> bool {
        self.floor.as_ref().is_some_and(|f| echo <= f.value)
    }
}

/// The groups at which `metric` was measured for any method.
fn groups_of<'a>(rows: &'a [Row], metric: &str) -> Vec<&'a str> {
    let mut groups: Vec<&str> = Vec::new();
    for row in rows.iter().filter(|row| row.metric == metric) {
        let place = row.place.as_str();
        let is_group = group_of(place) == place && !place.contains(':') && place != RUN;
        if is_group && !groups.contains(&place) {
            groups.push(place);
        }
    }
    groups
}

/// A method's line; its echo needs every group, so that no method gains by what it lacks.
fn entry(rows: &[Row], method: &str, metric: &str, groups: &[&str]) -> Ranked {
    let value = |metric: &str, place: &str| {
        rows.iter()
            .find(|r| r.method == method && r.metric == metric && r.place == place)
            .and_then(|r| r.value)
    };
    let means: Option<Vec<f64>> = groups.iter().map(|group| value(metric, group)).collect();
    let means = means.filter(|means| !means.is_empty());
    let echo = means
        .as_ref()
        .map(|means| means.iter().sum::<f64>() / means.len() as f64);
    // A receiver that is its own group has no row of its own for the worst.
    let worst = means.and_then(|means| {
        let worst = groups
            .iter()
            .zip(means)
            .map(|(group, mean)| value(metric, &group_worst(group)).unwrap_or(mean));
        worst.reduce(f64::max)
    });
    Ranked {
        method: method.to_owned(),
        echo,
        worst,
        cpu_s: value("cpu_s", RUN),
        unknowns: value("unknowns", RUN),
        peak_bytes: value("peak_bytes", RUN),
        rank: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::{Measurement, judge};

    fn at(method: &str, metric: &str, place: &str, value: f64) -> Measurement {
        Measurement {
            place: place.to_owned(),
            ..Measurement::of_run(method, metric, value, "1")
        }
    }

    fn ranking(floor: f64) -> Ranking {
        let numbers = [
            at("fixed", "echo_ratio", "A", 0.9),
            at("fixed", "echo_ratio", "B", 1.1),
            at("fixed", "echo_ratio", "B1", 55.0),
            at("fixed", "echo_ratio", "B:worst", 1.3),
            at("pml", "echo_ratio", "A", 1e-4),
            at("pml", "echo_ratio", "B", 1e-4),
            at("pml", "cpu_s", "run", 8.0),
            at("extended", "echo_ratio", "A", 2e-4),
            at("extended", "echo_ratio", "B", 2e-4),
            at("free", "echo_ratio", "A", 1e-9),
            at("extended", "cpu_s", "run", 5.0),
            at("dashpot", "cpu_s", "run", 1.0),
        ];
        let floor = Floor {
            value: floor,
            how: "buffer".to_owned(),
        };
        Ranking::from_rows(
            &judge("c", "gate", &numbers, &[]),
            "echo_ratio",
            Some(floor),
        )
    }

    fn order(ranking: &Ranking) -> Vec<(&str, Option<usize>)> {
        ranking
            .methods
            .iter()
            .map(|m| (m.method.as_str(), m.rank))
            .collect()
    }

    #[test]
    fn groups_count_once_and_what_lacks_one_comes_last() {
        let ranking = ranking(0.0);
        assert_eq!(
            order(&ranking),
            [
                ("pml", Some(1)),
                ("extended", Some(2)),
                ("fixed", Some(3)),
                ("dashpot", None),
                ("free", None)
            ]
        );
        let fixed = &ranking.methods[2];
        assert_eq!(fixed.echo, Some(1.0));
        assert_eq!(fixed.worst, Some(1.3));
    }

    #[test]
    fn methods_below_the_floor_tie_and_the_cheaper_stands_first() {
        let ranking = ranking(1e-3);
        assert_eq!(
            order(&ranking),
            [
                ("extended", Some(1)),
                ("pml", Some(1)),
                ("fixed", Some(3)),
                ("dashpot", None),
                ("free", None)
            ]
        );
        assert!(ranking.below_floor(2e-4) && !ranking.below_floor(0.9));
    }
}
