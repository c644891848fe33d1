//! Series of records and references as the norms want them.

use crate::scene::{Quantity, Reference, Window};
use anechoic_reports::norms::{NormError, Trace, Traces};
use anechoic_solver::record::Record;

/// The recorded motion.
pub fn traces(record: &Record, quantity: Quantity) -> Result<Traces, NormError> {
    let letter = quantity.letter();
    let suffixes = [format!("{letter}x"), format!("{letter}y")];
    Traces::from_table(&record.receivers, &[&suffixes[0], &suffixes[1]])
}

/// The true motion at the record's times.
pub fn traces_of(reference: &Reference, record: &Record) -> Result<Traces, NormError> {
    let receivers = reference
        .receivers
        .iter()
        .map(|(name, components)| Trace {
            name: name.clone(),
            components: components.to_vec(),
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
