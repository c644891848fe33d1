//! From records to norms, verdicts, tables, pictures and the report.
//!
//! - [`norms`]: every metric as a pure function of records and references.
//! - [`judge`](mod@judge): from measurements and claims to rows with verdicts.
//! - [`row`]: the flat rows that everything ends in.
//! - [`ranking`]: methods by their echo, cost beside it, down to the floor of the reference.
//! - [`table`], [`export`]: rows for the terminal and for other programs.
//! - [`plot`]: pictures as SVG and PNG, one file a kind.
//! - [`provenance`]: where a result comes from.
//! - [`format`](mod@format): numbers as readers want them.

pub mod export;
pub mod format;
pub mod judge;
pub mod norms;
pub mod plot;
pub mod provenance;
pub mod ranking;
pub mod row;
pub mod table;
