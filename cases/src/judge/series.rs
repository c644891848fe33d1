//! Series of records and references as the norms want them.

use crate::scene::{Quantity, Reference, Window};
use anechoic_reports::norms::{NormError, Trace, Traces};
use anechoic_solver::record::{Record, SeriesTable};

/// The recorded motion.
pub fn traces(record: &Record, quantity: Quantity) -> Result<Traces, NormError> {
    let suffixes = axes_of(&record.receivers, quantity.letter());
    let suffixes: Vec<&str> = suffixes.iter().map(String::as_str).collect();
    Traces::from_table(&record.receivers, &suffixes)
}

/// How the columns of the components of a quantity end: those of x and y, and that of z where a table has
/// it.
pub(super) fn axes_of(table: &SeriesTable, letter: char) -> Vec<String> {
    let has = |axis: &str| table.columns.iter().any(|c| c.name.ends_with(axis));
    let all = ["x", "y", "z"].map(|axis| format!("{letter}{axis}"));
    let spatial = has(&format!("_{}", all[2]));
    all.into_iter().take(if spatial { 3 } else { 2 }).collect()
}

/// The true motion at the record's times.
pub fn traces_of(reference: &Reference, record: &Record) -> Result<Traces, NormError> {
    let receivers = reference
        .receivers
        .iter()
        .map(|(name, components)| Trace {
            name: name.clone(),
            components: components.clone(),
        })
        .collect();
    Traces::new(record.receivers.times.clone(), receivers)
}

/// The receiver of a window alone, up to the window's end.
pub(super) fn cut(traces: &Traces, window: &Window) -> Result<Traces, NormError> {
    let end = window.to_s.map_or(traces.times().len(), |to| {
        traces.times().partition_point(|t| *t <= to)
    });
    let receiver = traces
        .receivers()
        .iter()
        .find(|trace| trace.name == window.receiver)
        .ok_or_else(|| NormError::MissingReceiver {
            receiver: window.receiver.clone(),
            from: "the record",
        })?;
    Traces::new(
        traces.times()[..end].to_vec(),
        vec![Trace {
            name: receiver.name.clone(),
            components: receiver
                .components
                .iter()
                .map(|values| values[..end].to_vec())
                .collect(),
        }],
    )
}
