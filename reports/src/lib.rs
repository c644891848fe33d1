//! From records to norms, verdicts, tables, pictures and the report.
//!
//! ```text
//! record ──► norms ──► judge ──► rows ──► ranking ──► table, export   (terminal, other programs)
//!    │                            └────────┴────┐
//!    └─────► plot ──► figures ──► study ◄───────┘──► html             (people)
//! ```
//!
//! - [`norms`]: every metric as a pure function of records and references.
//! - [`judge`](mod@judge): from measurements and claims to rows with verdicts.
//! - [`row`]: the flat rows that everything ends in.
//! - [`ranking`]: methods by their echo, cost beside it, down to the floor of the reference.
//! - [`convergence`]: errors on several levels, and the orders they fall with; [`plateau`]: where they
//!   no longer fall; [`budget`]: what space, time, boundary and reference contribute.
//! - [`sweep`]: methods at several points of their parameters.
//! - [`stability`]: which runs at extremes stay stable.
//! - [`tradeoff`]: error against cost, and what an echo takes.
//! - [`table`], [`export`]: rows for the terminal and for other programs.
//! - [`diff`](mod@diff): what changed from one list of rows to another.
//! - [`plot`]: pictures as SVG and PNG, one file a kind.
//! - [`fields`]: fields for ParaView.
//! - [`study`]: everything that a report shows, as data; [`provenance`]: where a result comes from.
//! - [`html`]: the report as one self-contained page.
//! - [`format`](mod@format): numbers as readers want them.

pub mod budget;
pub mod convergence;
pub mod diff;
pub mod export;
pub mod fields;
pub mod format;
pub mod html;
pub mod judge;
pub mod norms;
pub mod plateau;
pub mod plot;
pub mod provenance;
pub mod ranking;
pub mod row;
pub mod stability;
pub mod study;
pub mod sweep;
pub mod table;
pub mod tradeoff;
