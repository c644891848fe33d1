//! The budget of an error: what each of its causes contributes, from runs that differ in one thing.
//!
//! Rows have the metric `share` and the place `RECEIVER:NAME:METRIC` (`R1:time:peak_error`): the
//! distance of two series by that metric's norm, over the true series.

use crate::format;
use crate::judge::Measurement;
use anechoic_reference::claim::Evidence;
use serde::{Deserialize, Serialize};

/// The metric of shares.
pub const SHARE: &str = "share";

/// What one cause contributes to one error at one receiver.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Share {
    /// The cause: `total`, `space`, `time`, `points`, `transfer`, `boundary`, `reference`.
    pub name: String,
    /// The receiver; the run as a whole where no receiver has a number.
    pub place: String,
    /// By which error's norm.
    pub metric: String,
    /// The share of the true series, or why there is none.
    pub value: Result<f64, String>,
    /// What the run is compared with, and the kind of evidence that this is.
    pub against: (Evidence, String),
}

/// Shares of the errors of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Budget {
    /// Boundary method as in `--method`.
    pub method: String,
    /// The shares, cause by cause.
    pub shares: Vec<Share>,
}

impl Budget {
    /// The shares as measurements.
    pub fn measurements(&self) -> Vec<Measurement> {
        let number = |share: &Share| Measurement {
            method: self.method.clone(),
            metric: SHARE.to_owned(),
            place: format!("{}:{}:{}", share.place, share.name, share.metric),
            value: share.value.clone(),
            unit: "1".to_owned(),
            against: Some(share.against.clone()),
        };
        self.shares.iter().map(number).collect()
    }

    /// The largest share of the error `metric` at `place` among causes other than `cause`; the total
    /// is no cause.
    pub fn largest_but(&self, cause: &str, metric: &str, place: &str) -> Option<(&Share, f64)> {
        let others = self.shares.iter().filter(|share| {
            share.name != cause
                && share.name != "total"
                && share.metric == metric
                && share.place == place
        });
        let numbers = others.filter_map(|share| Some((share, *share.value.as_ref().ok()?)));
        numbers.max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Places with a number, in the order of their first appearance.
    fn places(&self) -> Vec<&str> {
        let measured = self.shares.iter().filter(|share| share.value.is_ok());
        distinct(measured.map(|share| share.place.as_str()))
    }
}

fn distinct<'a>(words: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut seen = Vec::new();
    for word in words {
        if !seen.contains(&word) {
            seen.push(word);
        }
    }
    seen
}

/// Heads of the table of a budget.
pub fn head(budget: &Budget) -> Vec<String> {
    let mut head = ["metric", "share", "evidence", "against"]
        .map(str::to_owned)
        .to_vec();
    head.extend(budget.places().into_iter().map(str::to_owned));
    head
}

/// Its lines under [`head`].
pub fn cells(budget: &Budget) -> Vec<Vec<String>> {
    let places = budget.places();
    let mut lines = Vec::new();
    for metric in distinct(budget.shares.iter().map(|share| share.metric.as_str())) {
        let own: Vec<&Share> = budget
            .shares
            .iter()
            .filter(|s| s.metric == metric)
            .collect();
        for name in distinct(own.iter().map(|share| share.name.as_str())) {
            let of_cause: Vec<&&Share> = own.iter().filter(|share| share.name == name).collect();
            let (evidence, against) = &of_cause[0].against;
            let against = match &of_cause[0].value {
                Ok(_) => against,
                Err(why) => why,
            };
            let mut line = [metric, name, evidence.name(), against]
                .map(str::to_owned)
                .to_vec();
            line.extend(places.iter().map(|place| {
                let share = of_cause.iter().find(|share| share.place == *place);
                match share.map(|share| &share.value) {
                    Some(Ok(value)) => format::number(*value),
                    Some(Err(_)) | None => "–".to_owned(),
                }
            }));
            lines.push(line);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn budget() -> Budget {
        let share = |name: &str, place: &str, value: Result<f64, String>| Share {
            name: name.into(),
            place: place.into(),
            metric: "rel_l2".into(),
            value,
            against: (Evidence::Refinement, format!("finer {name}")),
        };
        Budget {
            method: "pml".into(),
            shares: vec![
                share("total", "A", Ok(0.5)),
                share("space", "A", Ok(0.4)),
                share("time", "A", Ok(0.1)),
                share("boundary", "A", Err("the run failed".into())),
                share("time", "B", Ok(0.2)),
            ],
        }
    }

    #[test]
    fn the_largest_other_share_is_neither_the_total_nor_the_own() {
        let budget = budget();
        let largest = |cause, place| {
            let found = budget.largest_but(cause, "rel_l2", place);
            found.map(|(share, value)| (share.name.clone(), value))
        };
        assert_eq!(largest("time", "A"), Some(("space".to_owned(), 0.4)));
        assert_eq!(largest("space", "A"), Some(("time".to_owned(), 0.1)));
        assert_eq!(largest("time", "B"), None);
        assert_eq!(budget.largest_but("space", "peak_error", "A"), None);
    }

    #[test]
    fn a_cause_has_a_line_with_its_evidence_or_why_there_is_none() {
        let lines = cells(&budget());
        let head = head(&budget());
        assert_eq!(
            head[..],
            ["metric", "share", "evidence", "against", "A", "B"]
        );
        let time = [
            "rel_l2",
            "time",
            "refinement",
            "finer time",
            "0.100",
            "0.200",
        ];
        assert_eq!(lines[2], time);
        assert_eq!(lines[3][3..], ["the run failed", "–", "–"]);
        let places: Vec<String> = budget()
            .measurements()
            .into_iter()
            .map(|number| number.place)
            .collect();
        assert_eq!(places[1], "A:space:rel_l2");
    }
}
