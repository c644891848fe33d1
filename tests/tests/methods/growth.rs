//! Energy that grows after the load is said aloud, and proves no small echo.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic::judge::judge_runs;
use anechoic::judge::references::References;
use anechoic::prepare::Request;
use anechoic::runner::Run;
use anechoic_reports::row::{Row, Verdict};
use anechoic_tests::study::altered;

/// A run of a small half-space, ten cells of layer, as judged: its notes.
fn notes(method: &str, nu: f64) -> Vec<String> {
    let request = Request {
        target: "point-source".to_owned(),
        profile: Some("gate".to_owned()),
        sets: vec![
            format!("material.nu={nu}"),
            "time.end_s=3".to_owned(),
            "t1_s=1.5".to_owned(),
            format!("{method}.thickness_m=200"),
        ],
        ..Request::default()
    };
    let run = altered(&request, Some(method), |_| {});
    let judged = judge_runs(&[&run], &References::default());
    judged
        .notes
        .into_iter()
        .filter(|note| note.contains("unstable"))
        .collect()
}

#[test]
fn the_published_layer_is_called_unstable_where_it_is() {
    assert_eq!(notes("pml-stretched", 0.25), Vec::<String>::new());
    assert_eq!(notes("pml", 0.45), Vec::<String>::new());
    let notes = notes("pml-stretched", 0.45);
    println!("{notes:?}");
    assert_eq!(notes.len(), 1);
    for words in [
        "pml-stretched: its energy grows by ",
        "unstable here",
        "ill-posed",
        "3.32",
    ] {
        assert!(notes[0].contains(words), "{words} is missing");
    }
}

/// A column over a true layer with its energy multiplied by `growth` to the power of t - 1 s from
/// there on, as judged.
fn judged_with(growth: f64) -> (Vec<Row>, Vec<String>) {
    let sets = ["body.width_m=2", "receivers.A.x_m=1", "receivers.B.x_m=1"];
    let request = Request {
        target: "compression-1d".to_owned(),
        profile: Some("gate".to_owned()),
        sets: sets.map(str::to_owned).to_vec(),
        ..Request::default()
    };
    let mut runs: Vec<Run> = ["extended", "pml"]
        .map(|method| altered(&request, Some(method), |_| {}))
        .into();
    let energy = &mut runs[1].record.energy;
    let total = energy
        .columns
        .iter_mut()
        .find(|c| c.name == "total")
        .unwrap();
    for (value, t) in total.values.iter_mut().zip(&energy.times) {
        *value *= growth.powf((t - 1.0).max(0.0));
    }
    let runs: Vec<&Run> = runs.iter().collect();
    let judged = judge_runs(&runs, &References::default());
    let of_layer = judged.rows.into_iter().filter(|row| row.method == "pml");
    (of_layer.collect(), judged.notes)
}

#[test]
fn a_run_whose_energy_runs_away_proves_no_small_echo() {
    let residuals = |rows: &[Row]| -> Vec<Option<Verdict>> {
        let of = rows
            .iter()
            .filter(|row| row.metric == "residual" && row.accept.is_some());
        of.map(|row| row.verdict).collect()
    };
    let (rows, notes) = judged_with(1.0);
    let stable = residuals(&rows);
    assert!(!stable.is_empty());
    assert!(
        stable.iter().all(|v| *v == Some(Verdict::Pass)),
        "{stable:?}"
    );
    assert!(
        !notes.iter().any(|note| note.contains("unstable")),
        "{notes:?}"
    );
    let (rows, notes) = judged_with(1e9);
    assert!(
        notes
            .iter()
            .any(|note| note.starts_with("pml: its energy grows")),
        "{notes:?}"
    );
    assert_eq!(residuals(&rows), vec![Some(Verdict::Fail); stable.len()]);
    let why = rows.iter().filter(|row| row.verdict == Some(Verdict::Fail));
    assert!(why.clone().count() > 0 && why.clone().all(|row| row.why.contains("unstable")));
}
