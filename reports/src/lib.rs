//! From records to norms, verdicts, tables, pictures and the report.
//!
//! - [`row`]: the flat rows that everything ends in.

pub mod row;
