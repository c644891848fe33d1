//! Numbers that the papers print, as rows beside our own: comparisons, which no verdict rests on.

use super::PAPER;
use crate::runner::Run;
use anechoic_reference::claim::Evidence;
use anechoic_reference::paper::{PaperValue, values_of};
use anechoic_reports::row::Row;

/// The printed numbers of the test that the runs are, for the methods that were run.
pub(super) fn rows(runs: &[&Run]) -> Vec<Row> {
    let Some(first) = runs.first() else {
        return Vec::new();
    };
    let Some(test) = first.prepared.scene.paper_test() else {
        return Vec::new();
    };
    let was_run = |value: &PaperValue| {
        let methods = runs.iter().map(|run| run.manifest.method.as_str());
        methods
            .into_iter()
            .any(|method| method.split('/').next() == Some(value.method))
    };
    values_of(&first.manifest.case)
        .filter(|value| value.variant == test && was_run(value))
        .map(|value| Row {
            case: first.manifest.case.clone(),
            profile: first.manifest.profile.clone(),
            method: PAPER.to_owned(),
            metric: value.metric.to_owned(),
            place: value.place.to_owned(),
            value: Some(value.value()),
            unit: value.unit.to_owned(),
            evidence: Evidence::Paper.name().to_owned(),
            reference: format!(
                "{} section {}, {test}: {}",
                value.paper.short, value.section, value.method
            ),
            accept: None,
            verdict: None,
            why: String::new(),
        })
        .collect()
}
