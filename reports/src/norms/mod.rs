//! The metrics: pure functions of records and references.
//!
//! | file | metrics |
//! |---|---|
//! | [`traces`] | what is compared: vector series at receivers |
//! | [`echo`] | `amplitude_ratio`, `echo_ratio`, `echo_level_db`, `residual`, `peak_error`, `rel_l2` |
//! | [`group`] | means over groups of receivers with the worst beside them |
//! | [`mod@peak`] | peaks and `rd` |
//! | [`arrival`] | arrival differences by cross-correlation |
//! | [`energy`] | `energy_left`, `growth_rate_per_s` |
//! | [`unloaded`] | whether energy grows after the load |
//! | [`field`] | `l1`, `l2`, `linf` of fields |
//! | [`goodness`] | `envelope_misfit`, `phase_misfit`, `goodness` |
//! | [`settlement`] | `settlement_error`, `drift_error`: what stays |
//! | [`late`] | what a receiver still does late in a run |
//! | [`mod@order`] | `order` of convergence |
//!
//! A missing, extra, reshaped or non-finite series and differing time stamps are a [`NormError`];
//! nothing is skipped.

pub mod arrival;
pub mod curve;
pub mod echo;
pub mod energy;
pub mod field;
pub mod goodness;
pub mod group;
pub mod late;
pub mod order;
pub mod peak;
pub mod settlement;
pub mod traces;
pub mod unloaded;

mod fit;

pub use arrival::{Window, arrival_lag};
pub use curve::{CurveError, first_departure, largest_departure, mean_around};
pub use echo::{
    Onset, amplitude_ratio, echo_level_db, echo_ratio, echo_series, peak_error, rel_l2, residual,
};
pub use energy::{energy_left, growth_rate_per_s, target_energy};
pub use field::{FieldNorms, field_norms};
pub use fit::Slope;
pub use goodness::{Misfit, misfits};
pub use group::{
    Score, group_of, group_worst, with_groups, with_groups_db, with_groups_of_goodness,
};
pub use late::late_range;
pub use order::{Order, order};
pub use peak::{peak_deviation, rd, rd_at, rd_of_maximum};
pub use settlement::{drift_error, settlement_error};
pub use traces::{Trace, Traces};
pub use unloaded::{ROUNDING_GROWTH, Unloaded};

use thiserror::Error;

/// Why a metric cannot be computed. Times in seconds.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum NormError {
    /// A receiver of one side is absent from the other.
    #[error("receiver {receiver} is missing from {from}; both sides need the same receivers")]
    MissingReceiver {
        /// Name of the receiver.
        receiver: String,
        /// Which side lacks it.
        from: &'static str,
    },
    /// Two receivers of a record share a name, or a receiver is named like another one's group.
    #[error(
        "receiver {receiver} is ambiguous: it names two receivers or another receiver's group; rename it"
    )]
    AmbiguousReceiver {
        /// The name.
        receiver: String,
    },
    /// A table has no column of that name.
    #[error("there is no column {column}; the record must hold it")]
    MissingColumn {
        /// Name of the column.
        column: String,
    },
    /// Lengths or numbers of components differ.
    #[error("{what} has {found} values where {expected} are needed")]
    Shape {
        /// Which series.
        what: String,
        /// Needed length.
        expected: usize,
        /// Found length.
        found: usize,
    },
    /// A value is NaN or infinite.
    #[error("{what} is not finite at sample {index}: the run has diverged or the file is damaged")]
    NonFinite {
        /// Which series.
        what: String,
        /// First bad sample.
        index: usize,
    },
    /// The series are sampled at different times.
    #[error(
        "times differ at sample {index}: {left} s against {right} s; sample the reference at the record's times"
    )]
    Times {
        /// First sample that differs.
        index: usize,
        /// Time on the method's side.
        left: f64,
        /// Time on the other side.
        right: f64,
    },
    /// Times do not increase strictly.
    #[error("times do not increase at sample {index}")]
    NotIncreasing {
        /// First sample that is not later than its predecessor.
        index: usize,
    },
    /// Sampling is not uniform where it has to be.
    #[error("times are not uniform at sample {index}; resample before going on")]
    NotUniform {
        /// First sample off the raster.
        index: usize,
    },
    /// No sample lies in the window.
    #[error("no sample lies in {from} s .. {to} s; the record covers {start} s .. {end} s")]
    EmptyWindow {
        /// Start of the window.
        from: f64,
        /// End of the window.
        to: f64,
        /// First time of the record.
        start: f64,
        /// Last time of the record.
        end: f64,
    },
    /// No onset is given for a receiver.
    #[error("no onset t1 is given for receiver {receiver}")]
    NoOnset {
        /// Name of the receiver.
        receiver: String,
    },
    /// The quantity to divide by is zero.
    #[error("{what} is zero: the ratio has no meaning")]
    ZeroDenominator {
        /// What is zero.
        what: String,
    },
    /// A value is out of the range that the metric is defined on.
    #[error("{what} is {value}, but must be positive")]
    NotPositive {
        /// What is not positive.
        what: String,
        /// Its value.
        value: f64,
    },
    /// Too few values for the metric.
    #[error("{what} needs at least {needed} values, {found} are given")]
    TooFew {
        /// Which metric.
        what: &'static str,
        /// Least number.
        needed: usize,
        /// Given number.
        found: usize,
    },
    /// No frequency of a signal can be told apart in so short a record.
    #[error(
        "{what} reaches up to {highest} Hz, and a record this long resolves {lowest} Hz and more: a longer run is needed"
    )]
    NoBand {
        /// Which signal.
        what: String,
        /// Lowest frequency that the record resolves (Hz).
        lowest: f64,
        /// Highest frequency of the signal, or that the sampling allows (Hz).
        highest: f64,
    },
    /// The best lag lies at the end of the searched range.
    #[error("the correlation still rises at a lag of {lag_s} s; widen the searched range")]
    LagAtEdge {
        /// The lag at the edge.
        lag_s: f64,
    },
}

/// Refuses NaN and infinity.
pub(crate) fn check_finite(what: &str, values: &[f64]) -> Result<(), NormError> {
    match values.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(index) => Err(NormError::NonFinite {
            what: what.to_owned(),
            index,
        }),
    }
}

/// Refuses another length than `expected`.
pub(crate) fn check_length(what: &str, expected: usize, found: usize) -> Result<(), NormError> {
    if expected == found {
        Ok(())
    } else {
        Err(NormError::Shape {
            what: what.to_owned(),
            expected,
            found,
        })
    }
}

/// Refuses times that are not finite or do not increase, and an empty series.
pub(crate) fn check_times(times: &[f64]) -> Result<(), NormError> {
    if times.is_empty() {
        return Err(NormError::TooFew {
            what: "a series",
            needed: 1,
            found: 0,
        });
    }
    check_finite("time", times)?;
    match times.windows(2).position(|w| w[1] <= w[0]) {
        None => Ok(()),
        Some(i) => Err(NormError::NotIncreasing { index: i + 1 }),
    }
}

/// Largest absolute value; 0 of nothing.
pub(crate) fn max_abs(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| f64::max(m, v.abs()))
}
