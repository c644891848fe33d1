//! Rows as files for other programs: `summary.json`, `summary.csv`, `junit.xml`.

use crate::format;
use crate::row::{Row, Verdict};
use crate::table::{value_text, verdict_name};
use anechoic_reference::claim::Accept;
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use thiserror::Error;

/// Why rows cannot be written.
#[derive(Debug, Error)]
pub enum ExportError {
    /// The JSON writer failed.
    #[error("summary.json cannot be written: {0}")]
    Json(#[from] serde_json::Error),
    /// The CSV writer failed.
    #[error("summary.csv cannot be written: {0}")]
    Csv(#[from] csv::Error),
    /// The CSV writer did not end with text.
    #[error("summary.csv cannot be written: {0}")]
    Text(String),
    /// The JUnit writer failed.
    #[error("junit.xml cannot be written: {0}")]
    Junit(#[from] quick_junit::SerializeError),
}

/// The contract with other programs: a list of flat rows.
pub fn summary_json(rows: &[Row]) -> Result<String, ExportError> {
    Ok(serde_json::to_string_pretty(rows)? + "\n")
}

/// The same rows as a table with the same keys; `accept` is written `min..max` with open ends
/// left out (`..0.01`), a missing value is empty.
pub fn summary_csv(rows: &[Row]) -> Result<String, ExportError> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record([
        "case",
        "profile",
        "method",
        "metric",
        "where",
        "value",
        "unit",
        "evidence",
        "reference",
        "accept",
        "verdict",
    ])?;
    for row in rows {
        writer.write_record([
            row.case.as_str(),
            &row.profile,
            &row.method,
            &row.metric,
            &row.place,
            &row.value.map_or_else(String::new, |v| v.to_string()),
            &row.unit,
            &row.evidence,
            &row.reference,
            &row.accept.as_ref().map_or_else(String::new, range),
            row.verdict.map_or("", verdict_name),
        ])?;
    }
    let bytes = writer
        .into_inner()
        .map_err(|e| ExportError::Text(e.to_string()))?;
    String::from_utf8(bytes).map_err(|e| ExportError::Text(e.to_string()))
}

/// One test case a claim, one suite a case and profile; what was not evaluated is skipped.
///
/// Carries no times, so that the same rows give the same bytes.
pub fn junit_xml(rows: &[Row]) -> Result<String, ExportError> {
    let mut suites: Vec<(String, TestSuite)> = Vec::new();
    for row in rows {
        let Some(verdict) = row.verdict else { continue };
        let name = format!("{} ({})", row.case, row.profile);
        let at = suites
            .iter()
            .position(|(known, _)| *known == name)
            .unwrap_or_else(|| {
                suites.push((name.clone(), TestSuite::new(name)));
                suites.len() - 1
            });
        suites[at].1.add_test_case(test_case(row, verdict));
    }
    let mut report = Report::new("anechoic");
    report.add_test_suites(suites.into_iter().map(|(_, suite)| suite));
    Ok(report.to_string()?)
}

fn test_case(row: &Row, verdict: Verdict) -> TestCase {
    let mut status = match verdict {
        Verdict::Pass => TestCaseStatus::success(),
        Verdict::Fail => TestCaseStatus::non_success(NonSuccessKind::Failure),
        Verdict::NotEvaluated => TestCaseStatus::skipped(),
    };
    let accept = row.accept.as_ref().map_or_else(String::new, format::accept);
    status.set_message(match verdict {
        Verdict::NotEvaluated => row.why.clone(),
        _ => format!("{} is not {accept}", value_text(row)),
    });
    status.set_description(row.why.clone());
    let name = format!("{} {} [{}]", row.metric, row.place, row.evidence);
    let mut case = TestCase::new(name, status);
    case.set_classname(format!("{}.{}", row.case, row.method));
    case
}

fn range(accept: &Accept) -> String {
    let end = |value: Option<f64>| value.map_or_else(String::new, |v| v.to_string());
    format!("{}..{}", end(accept.min), end(accept.max))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::{Measurement, judge};
    use anechoic_reference::claim::{Claim, Evidence};

    fn rows() -> Vec<Row> {
        let claim = |metric: &str, max: f64| Claim {
            method: "pml".to_owned(),
            metric: metric.to_owned(),
            place: "run".to_owned(),
            accept: Accept::at_most(max),
            evidence: Evidence::Certified,
            why: "theory, \"as printed\" & measured".to_owned(),
        };
        let measured = [
            Measurement::of_run("pml", "residual", 0.1 + 0.2, "1"),
            Measurement::of_run("pml", "peak_error", 0.2, "1"),
            Measurement::of_run("pml", "cpu_s", 1.5, "s"),
        ];
        let claims = [
            claim("residual", 0.5),
            claim("peak_error", 0.1),
            claim("order", 2.0),
        ];
        judge("compression-1d", "gate", &measured, &claims)
    }

    #[test]
    fn rows_survive_json_to_the_bit() {
        let text = summary_json(&rows()).expect("rows are plain");
        let back: Vec<Row> = serde_json::from_str(&text).expect("our own output");
        assert_eq!(back[0].value, Some(0.1 + 0.2));
        let without_why: Vec<Row> = rows()
            .into_iter()
            .map(|r| Row {
                why: String::new(),
                ..r
            })
            .collect();
        assert_eq!(back, without_why);
    }

    #[test]
    fn json_has_the_keys_of_the_contract_and_no_other() {
        let text = summary_json(&rows()).expect("rows are plain");
        let list: Vec<serde_json::Map<String, serde_json::Value>> =
            serde_json::from_str(&text).expect("a list of objects");
        let mut expected = [
            "case",
            "profile",
            "method",
            "metric",
            "where",
            "value",
            "unit",
            "evidence",
            "reference",
            "accept",
            "verdict",
        ];
        expected.sort_unstable();
        for row in &list {
            let mut keys: Vec<&str> = row.keys().map(String::as_str).collect();
            keys.sort_unstable();
            assert_eq!(keys, expected);
        }
        assert_eq!(list[2]["value"], serde_json::Value::Null);
        assert_eq!(list[2]["verdict"], "not evaluated");
        assert_eq!(list[0]["accept"]["max"], 0.5);
        assert_eq!(list[3]["accept"], serde_json::Value::Null);
    }

    #[test]
    fn csv_has_a_line_a_row() {
        let text = summary_csv(&rows()).expect("rows are plain");
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 1 + rows().len());
        assert_eq!(
            lines[2],
            "compression-1d,gate,pml,peak_error,run,0.2,1,certified,,..0.1,fail"
        );
        assert!(lines[1].contains("0.30000000000000004"));
    }

    #[test]
    fn junit_counts_failures_and_skips() {
        let text = junit_xml(&rows()).expect("rows are plain");
        assert!(text.contains(r#"tests="3""#), "{text}");
        assert!(text.contains(r#"failures="1""#));
        assert!(text.contains("<skipped") && text.contains("was not measured"));
        assert!(text.contains("&amp; measured"));
        assert!(!text.contains("cpu_s"));
    }
}
