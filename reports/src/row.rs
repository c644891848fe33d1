//! The flat rows of `summary.json`: one a number, and the contract with every other program.

use anechoic_reference::claim::Accept;
use serde::{Deserialize, Serialize};

/// What a row says of its claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Verdict {
    /// The claim holds.
    #[serde(rename = "pass")]
    Pass,
    /// The claim does not hold.
    #[serde(rename = "fail")]
    Fail,
    /// The claim could not be judged.
    #[serde(rename = "not evaluated")]
    NotEvaluated,
}

/// One number.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Case, for example `compression-1d`.
    pub case: String,
    /// Profile: `gate`, `quick`, `paper`.
    pub profile: String,
    /// Boundary method as in `--method`.
    pub method: String,
    /// Metric id.
    pub metric: String,
    /// Receiver (`A1`), group (`A`, `A:worst`), or field.
    #[serde(rename = "where")]
    pub place: String,
    /// The number; `None` when it could not be computed.
    pub value: Option<f64>,
    /// Unit; ratios have `1`.
    pub unit: String,
    /// Kind of evidence of the reference; empty for a mere measurement, but for shares and plateaus.
    pub evidence: String,
    /// Name of the reference; empty for a mere measurement.
    pub reference: String,
    /// What is accepted; `None` for a mere measurement.
    pub accept: Option<Accept>,
    /// The verdict; `None` for a mere measurement.
    pub verdict: Option<Verdict>,
    /// Why the bound is what it is, or why the row was not evaluated. Not part of the JSON contract.
    #[serde(skip)]
    pub why: String,
}
