//! From records to norms, verdicts, tables, pictures and the report.
//!
//! - [`norms`]: every metric as a pure function of records and references.
//! - [`row`]: the flat rows that everything ends in.

pub mod norms;
pub mod row;
