//! From measurements and claims to rows with verdicts.

use crate::norms::{NormError, Score};
use crate::row::{Row, Verdict};
use anechoic_reference::claim::{Claim, Evidence};
use anechoic_solver::record::Cost;

/// One number that was measured, or why it could not be.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurement {
    /// Boundary method as in `--method`.
    pub method: String,
    /// Metric id.
    pub metric: String,
    /// Receiver, group, field, or `run` for what concerns a run as a whole.
    pub place: String,
    /// The number, or the reason that there is none.
    pub value: Result<f64, String>,
    /// Unit; ratios have `1`.
    pub unit: String,
    /// Kind and name of what it was measured against; `None` for a number that needs no reference.
    pub against: Option<(Evidence, String)>,
}

impl Measurement {
    /// A number of a run as a whole that needs no reference.
    pub fn of_run(method: &str, metric: &str, value: f64, unit: &str) -> Self {
        Measurement {
            method: method.to_owned(),
            metric: metric.to_owned(),
            place: RUN.to_owned(),
            value: Ok(value),
            unit: unit.to_owned(),
            against: None,
        }
    }
}

/// Place of numbers that concern a run as a whole.
pub const RUN: &str = "run";

/// The measurements of one metric at several places.
///
/// A metric that could not be computed becomes a single measurement at `run`, with the error as
/// its reason, so that it shows; its claims become `not evaluated` with the same reason.
pub fn measurements(
    method: &str,
    metric: &str,
    unit: &str,
    against: Option<(Evidence, &str)>,
    scores: Result<Vec<Score>, NormError>,
) -> Vec<Measurement> {
    let measurement = |place: &str, value| Measurement {
        method: method.to_owned(),
        metric: metric.to_owned(),
        place: place.to_owned(),
        value,
        unit: unit.to_owned(),
        against: against.map(|(kind, name)| (kind, name.to_owned())),
    };
    match scores {
        Ok(scores) => scores
            .iter()
            .map(|s| measurement(&s.place, Ok(s.value)))
            .collect(),
        Err(error) => vec![measurement(RUN, Err(error.to_string()))],
    }
}

/// Metrics that tell what a run cost.
pub const COSTS: [&str; 8] = [
    "cpu_s",
    "wall_s",
    "peak_bytes",
    "steps",
    "iterations",
    "unknowns",
    "points",
    "us_per_point_step",
];

/// The cost rows of a run.
pub fn cost_measurements(method: &str, cost: &Cost) -> Vec<Measurement> {
    let point_steps = cost.points as f64 * cost.steps as f64;
    let mut rows: Vec<Measurement> = [
        ("cpu_s", cost.cpu_s, "s"),
        ("wall_s", cost.wall_s, "s"),
        ("peak_bytes", cost.peak_bytes as f64, "B"),
        ("steps", cost.steps as f64, "1"),
        ("iterations", cost.iterations as f64, "1"),
        ("unknowns", cost.unknowns as f64, "1"),
        ("points", cost.points as f64, "1"),
        ("us_per_point_step", 1e6 * cost.cpu_s / point_steps, "us"),
    ]
    .into_iter()
    .map(|(metric, value, unit)| Measurement::of_run(method, metric, value, unit))
    .collect();
    if point_steps == 0.0
        && let Some(last) = rows.last_mut()
    {
        last.value = Err("the run made no step".to_owned());
    }
    rows
}

/// Rows of one case: every claim in its order, then the measurements that no claim asks for.
///
/// A claim meets the measurement of its method, metric and place whose reference is of its kind of
/// evidence (or that needs none). No such number, more than one, or one that is not finite: the
/// row says `not evaluated` and why.
pub fn judge(
    case: &str,
    profile: &str,
    measurements: &[Measurement],
    claims: &[Claim],
) -> Vec<Row> {
    let blank = |method: &str, metric: &str, place: &str| Row {
        case: case.to_owned(),
        profile: profile.to_owned(),
        method: method.to_owned(),
        metric: metric.to_owned(),
        place: place.to_owned(),
        value: None,
        unit: String::new(),
        evidence: String::new(),
        reference: String::new(),
        accept: None,
        verdict: None,
        why: String::new(),
    };
    let judged = claims.iter().map(|claim| {
        let mut row = blank(&claim.method, &claim.metric, &claim.place);
        judge_claim(claim, measurements, &mut row);
        row
    });
    let unclaimed = measurements
        .iter()
        .filter(|m| !claims.iter().any(|claim| meets(claim, m)))
        .map(|m| {
            let mut row = blank(&m.method, &m.metric, &m.place);
            row.unit.clone_from(&m.unit);
            match finite(&m.value) {
                Ok(value) => row.value = Some(value),
                Err(reason) => row.why = reason,
            }
            row
        });
    judged.chain(unclaimed).collect()
}

fn judge_claim(claim: &Claim, measurements: &[Measurement], row: &mut Row) {
    row.evidence = claim.evidence.name().to_owned();
    row.accept = Some(claim.accept);
    let found: Vec<&Measurement> = measurements.iter().filter(|m| meets(claim, m)).collect();
    if let Some(first) = found.first() {
        row.unit.clone_from(&first.unit);
        if let Some((_, name)) = &first.against {
            row.reference.clone_from(name);
        }
    } else {
        row.unit = unit_of(&claim.metric).to_owned();
    }
    let value = match found.as_slice() {
        [] => Err(why_absent(claim, measurements)),
        [only] => finite(&only.value),
        several => Err(format!(
            "measured {} times; which one is meant?",
            several.len()
        )),
    };
    match value {
        Ok(value) => {
            row.value = Some(value);
            row.verdict = Some(if claim.accept.holds(value) {
                Verdict::Pass
            } else {
                Verdict::Fail
            });
            row.why.clone_from(&claim.why);
        }
        Err(reason) => {
            row.verdict = Some(Verdict::NotEvaluated);
            row.why = reason;
        }
    }
}

/// Unit of a metric, which its name ends with unless it is a ratio or a count.
fn unit_of(metric: &str) -> &'static str {
    if metric.starts_with("us_") {
        return "us";
    }
    [
        ("_per_s", "1/s"),
        ("_s", "s"),
        ("_db", "dB"),
        ("_bytes", "B"),
    ]
    .into_iter()
    .find_map(|(ending, unit)| metric.ends_with(ending).then_some(unit))
    .unwrap_or("1")
}

fn meets(claim: &Claim, m: &Measurement) -> bool {
    claim.place == m.place && same_number(claim, m)
}

fn same_number(claim: &Claim, m: &Measurement) -> bool {
    claim.method == m.method
        && claim.metric == m.metric
        && m.against
            .as_ref()
            .is_none_or(|(kind, _)| *kind == claim.evidence)
}

/// The reason of a metric that failed as a whole, or that nobody measured it.
fn why_absent(claim: &Claim, measurements: &[Measurement]) -> String {
    measurements
        .iter()
        .filter(|m| same_number(claim, m) && m.place == RUN)
        .find_map(|m| m.value.as_ref().err().cloned())
        .unwrap_or_else(|| {
            format!(
                "{} of {} at {} was not measured",
                claim.metric, claim.method, claim.place
            )
        })
}

fn finite(value: &Result<f64, String>) -> Result<f64, String> {
    match value {
        Ok(v) if v.is_finite() => Ok(*v),
        Ok(v) => Err(format!("the value is {v}")),
        Err(reason) => Err(reason.clone()),
    }
}

/// How many claims ended how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tally {
    /// Claims that hold.
    pub pass: usize,
    /// Claims that do not hold.
    pub fail: usize,
    /// Claims that could not be judged.
    pub not_evaluated: usize,
}

impl Tally {
    /// Counts the claims among `rows`.
    pub fn of<'a>(rows: impl IntoIterator<Item = &'a Row>) -> Self {
        let mut tally = Tally::default();
        for verdict in rows.into_iter().filter_map(|row| row.verdict) {
            match verdict {
                Verdict::Pass => tally.pass += 1,
                Verdict::Fail => tally.fail += 1,
                Verdict::NotEvaluated => tally.not_evaluated += 1,
            }
        }
        tally
    }
}

/// Does agreement in this row count as verification?
pub fn verifies(row: &Row) -> bool {
    [
        Evidence::Analytic,
        Evidence::Independent,
        Evidence::Certified,
        Evidence::Paper,
        Evidence::Regression,
        Evidence::Refinement,
    ]
    .iter()
    .any(|kind| kind.verifies() && kind.name() == row.evidence)
}

#[cfg(test)]
mod tests {
    use super::*;
    use anechoic_reference::claim::Accept;

    fn claim(metric: &str, place: &str, evidence: Evidence, max: f64) -> Claim {
        Claim {
            method: "pml".to_owned(),
            metric: metric.to_owned(),
            place: place.to_owned(),
            accept: Accept::at_most(max),
            evidence,
            why: "the layer's theory".to_owned(),
        }
    }

    fn echo(value: f64) -> Vec<Measurement> {
        measurements(
            "pml",
            "residual",
            "1",
            Some((Evidence::Certified, "extended column")),
            Ok(vec![Score::new("A", value)]),
        )
    }

    #[test]
    fn a_claim_passes_or_fails_by_its_bound() {
        let claims = [claim("residual", "A", Evidence::Certified, 0.005)];
        let rows = judge("c", "gate", &echo(0.004), &claims);
        assert_eq!(rows.len(), 1);
        assert_eq!(rows[0].verdict, Some(Verdict::Pass));
        assert_eq!(rows[0].reference, "extended column");
        assert_eq!(rows[0].why, "the layer's theory");
        let rows = judge("c", "gate", &echo(0.006), &claims);
        assert_eq!(rows[0].verdict, Some(Verdict::Fail));
        assert_eq!(rows[0].value, Some(0.006));
    }

    #[test]
    fn a_number_against_another_reference_does_not_serve() {
        let claims = [claim("residual", "A", Evidence::Analytic, 0.005)];
        let rows = judge("c", "gate", &echo(0.004), &claims);
        assert_eq!(rows.len(), 2);
        assert_eq!(rows[0].verdict, Some(Verdict::NotEvaluated));
        assert!(rows[0].why.contains("not measured"));
        assert_eq!(rows[1].verdict, None);
        assert_eq!(rows[1].value, Some(0.004));
    }

    #[test]
    fn a_claim_that_nobody_measured_has_its_unit() {
        let claims = [
            "residual",
            "arrival_s",
            "growth_rate_per_s",
            "echo_level_db",
        ]
        .map(|metric| claim(metric, "A", Evidence::Analytic, 0.1));
        let rows = judge("c", "gate", &[], &claims);
        let units: Vec<&str> = rows.iter().map(|row| row.unit.as_str()).collect();
        assert_eq!(units, ["1", "s", "1/s", "dB"]);
        for m in cost_measurements("pml", &Cost::default()) {
            assert_eq!(unit_of(&m.metric), m.unit);
        }
    }

    #[test]
    fn what_failed_is_said_and_not_dropped() {
        let claims = [claim("residual", "A", Evidence::Certified, 0.005)];
        let error = NormError::MissingColumn {
            column: "A_vy".to_owned(),
        };
        let against = Some((Evidence::Certified, "extended column"));
        let failed = measurements("pml", "residual", "1", against, Err(error));
        let rows = judge("c", "gate", &failed, &claims);
        assert_eq!(rows[0].verdict, Some(Verdict::NotEvaluated));
        assert!(rows[0].why.contains("A_vy"));
        assert_eq!(rows[1].value, None);
        assert!(rows[1].why.contains("A_vy"));
        let nan = judge("c", "gate", &echo(f64::NAN), &claims);
        assert_eq!(nan[0].verdict, Some(Verdict::NotEvaluated));
        assert_eq!(nan[0].value, None);
    }

    #[test]
    fn two_numbers_for_one_claim_are_not_chosen_from() {
        let claims = [claim("residual", "A", Evidence::Certified, 0.005)];
        let both = [echo(0.001), echo(0.9)].concat();
        let rows = judge("c", "gate", &both, &claims);
        assert_eq!(rows[0].verdict, Some(Verdict::NotEvaluated));
        assert!(rows[0].why.contains("2 times"));
    }

    #[test]
    fn cost_needs_no_reference() {
        let cost = Cost {
            steps: 100,
            points: 50,
            cpu_s: 0.01,
            ..Cost::default()
        };
        let rows = cost_measurements("pml", &cost);
        let per_step = rows.last().expect("the last row");
        assert_eq!(per_step.metric, "us_per_point_step");
        assert_eq!(per_step.value, Ok(2.0));
        let claims = [claim("cpu_s", RUN, Evidence::Regression, 0.02)];
        let judged = judge("c", "gate", &rows, &claims);
        assert_eq!(judged[0].verdict, Some(Verdict::Pass));
        assert_eq!(judged.len(), rows.len());
        assert!(!verifies(&judged[0]));
        let idle = cost_measurements("pml", &Cost::default());
        assert!(idle.last().expect("the last row").value.is_err());
    }

    #[test]
    fn the_tally_counts_claims_only() {
        let claims = [
            claim("residual", "A", Evidence::Certified, 0.005),
            claim("residual", "B", Evidence::Certified, 0.005),
        ];
        let mut numbers = echo(0.006);
        numbers.push(Measurement::of_run("pml", "cpu_s", 1.0, "s"));
        let rows = judge("c", "gate", &numbers, &claims);
        let tally = Tally::of(&rows);
        assert_eq!((tally.pass, tally.fail, tally.not_evaluated), (0, 1, 1));
        assert!(verifies(&rows[0]));
    }
}
