//! From a record to a verdict, and that the verdict turns when the record is damaged.

use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::judge::{Tally, judge, measurements};
use anechoic_reports::norms::{NormError, Onset, Score, Traces, echo_ratio, with_groups};
use anechoic_reports::row::Row;
use anechoic_solver::record::{Column, SeriesTable};

const RECEIVERS: [&str; 3] = ["A1", "A2", "B"];

/// A pulse at 1 s and its echo at 3 s.
fn table(echo: f64) -> SeriesTable {
    let times: Vec<f64> = (0..=400).map(|i| f64::from(i) * 0.01).collect();
    let pulse = |t: f64| (-((t - 1.0) / 0.1).powi(2)).exp();
    let column = |name: &str, axis: &str, share: f64| Column {
        name: format!("{name}_{axis}"),
        unit: "m".to_owned(),
        values: times
            .iter()
            .map(|t| share * (pulse(*t) + echo * pulse(t - 2.0)))
            .collect(),
    };
    let columns = RECEIVERS
        .iter()
        .flat_map(|name| [column(name, "ux", 0.6), column(name, "uy", -0.8)])
        .collect();
    SeriesTable { times, columns }
}

fn traces(table: &SeriesTable) -> Result<Traces, NormError> {
    Traces::from_table(table, &["ux", "uy"])
}

fn echoes(method: &SeriesTable) -> Result<Vec<Score>, NormError> {
    let onset = Onset::Same(2.0);
    let (reference, standard) = (traces(&table(0.0))?, traces(&table(-0.5))?);
    with_groups(&echo_ratio(
        &traces(method)?,
        &reference,
        &standard,
        &onset,
    )?)
}

fn rows(method: &SeriesTable) -> Vec<Row> {
    let claims = ["A", "A:worst", "B"].map(|place| Claim {
        method: "pml".to_owned(),
        metric: "echo_ratio".to_owned(),
        place: place.to_owned(),
        accept: Accept::at_most(0.01),
        evidence: Evidence::Certified,
        why: "what ten cells leave".to_owned(),
    });
    let against = Some((Evidence::Certified, "extended"));
    let numbers = measurements("pml", "echo_ratio", "1", against, echoes(method));
    judge("made-up", "gate", &numbers, &claims)
}

fn tally(method: &SeriesTable) -> (usize, usize, usize) {
    let tally = Tally::of(&rows(method));
    (tally.pass, tally.fail, tally.not_evaluated)
}

#[test]
fn a_quiet_method_passes_with_the_number_it_earned() {
    let rows = rows(&table(0.004));
    let value = rows[0].value.expect("measured");
    assert!((value - 0.008).abs() < 1e-12, "{value}");
    assert_eq!(tally(&table(0.004)), (3, 0, 0));
    // Claims first, then the receivers that no claim asks for.
    assert_eq!(rows.len(), 5);
}

#[test]
fn damage_turns_the_verdict() {
    assert_eq!(tally(&table(0.006)), (0, 3, 0));
    let mut flipped = table(0.004);
    for value in &mut flipped.columns[5].values {
        *value = -*value;
    }
    assert_eq!(
        tally(&flipped),
        (3, 0, 0),
        "a flip before the onset is not an echo"
    );
    for (value, t) in flipped.columns[5].values.iter_mut().zip(&flipped.times) {
        if *t > 2.0 {
            *value += 0.01;
        }
    }
    assert_eq!(tally(&flipped), (2, 1, 0));
}

#[test]
fn what_cannot_be_compared_is_not_evaluated() {
    let mut missing = table(0.004);
    missing.columns.pop();
    assert_eq!(tally(&missing), (0, 0, 3));
    assert!(rows(&missing)[0].why.contains("B_uy"));
    let mut bad = table(0.004);
    bad.columns[0].values[7] = f64::NAN;
    assert_eq!(tally(&bad), (0, 0, 3));
    let mut late = table(0.004);
    late.times[400] += 0.005;
    assert_eq!(tally(&late), (0, 0, 3));
    assert!(rows(&late)[0].why.contains("times differ at sample 400"));
}
