//! The error budget of the point source: what space, time, points, transfer, boundary and reference each
//! contribute, on its cells (20 m) and its step (0.01 s), at receivers where Lamb's closed form is known;
//! and plateaus of refinements that it explains.
//!
//! Every share is a difference of two series that differ in one thing, over the true peak. What the
//! harness exists for needs the boundary's share to be the smallest by far.

use anechoic::commands::{Finished, Options, converge, run};
use anechoic::over::Over;
use anechoic_reports::row::Row;
use anechoic_tests::study::narrow_column;

fn lamb(out: &std::path::Path) -> Options {
    Options::new("lamb", out).profile("gate").set("grid.h_m=20")
}

/// The budget of the scene after a change.
fn budget(change: impl Fn(Options) -> Options) -> Finished {
    let out = tempfile::tempdir().expect("a temporary folder");
    let finished = converge(&change(lamb(out.path())), &[], true);
    finished.unwrap_or_else(|error| panic!("{error}"))
}

/// The share of a cause in the largest deviation at the worst receiver.
fn share(finished: &Finished, cause: &str) -> f64 {
    let end = format!(":{cause}:peak_error");
    let own = |row: &&Row| row.metric == "share" && row.place.ends_with(&end);
    let shares = finished.rows.iter().filter(own);
    let values: Vec<f64> = shares.filter_map(|row| row.value).collect();
    assert!(!values.is_empty(), "no share of {cause}");
    let worst = values.into_iter().fold(0.0, f64::max);
    println!("  {cause:<12} {:>12.6} %", 100.0 * worst);
    worst
}

/// Displacements of the receivers, component after component, every `every`-th step.
fn series(every: usize, change: impl Fn(Options) -> Options) -> Vec<Vec<f64>> {
    let out = tempfile::tempdir().expect("a temporary folder");
    let finished = run(&change(lamb(out.path()))).unwrap_or_else(|error| panic!("{error}"));
    let record = &finished.study.runs[0].record;
    let moved = record.receivers.columns.iter();
    moved
        .filter(|column| column.name.contains("_u"))
        .map(|column| column.values.iter().copied().step_by(every).collect())
        .collect()
}

/// Largest distance of the displacement vectors at each receiver (m).
fn apart(a: &[Vec<f64>], b: &[Vec<f64>]) -> Vec<f64> {
    assert_eq!((a.len(), a[0].len()), (b.len(), b[0].len()));
    let distance = |c: usize, i: usize| (a[c][i] - b[c][i]).hypot(a[c + 1][i] - b[c + 1][i]);
    let largest = |c: usize| (0..a[0].len()).map(|i| distance(c, i)).fold(0.0, f64::max);
    (0..a.len()).step_by(2).map(largest).collect()
}

#[test]
fn the_boundary_is_the_smallest_share_but_for_the_reference() {
    println!("cells of 20 m, 0.01 s, 10 cells of pml, worst receiver");
    let own = budget(|o| o.method("pml"));
    let of = |cause| share(&own, cause);
    let (total, space, time, points) = (of("total"), of("space"), of("time"), of("points"));
    let (boundary, reference) = (of("boundary"), of("reference"));
    // dispersion is the largest, and halving the cells leaves a quarter of it
    assert!(space > 0.5 * total && time < 0.5 * total && points < 0.5 * total);
    assert!(boundary < 0.05 * total && boundary > 0.0);
    assert!(reference < 1e-5 * boundary && reference > 0.0);
    // the worst receiver of each cause is the same one: what is left adds up to the total within a third
    assert!((4.0 / 3.0 * space + time - total).abs() < total / 3.0);
    println!("points that carry the motion, against frozen ones");
    let (frozen, truth) = (series(1, |o| o), truth());
    let still = vec![vec![0.0; truth[0].len()]; truth.len()];
    let transfer = |preset: &str| {
        let moving = series(1, |mut o| {
            o.request.presets.push(preset.to_owned());
            o
        });
        let (distances, peaks) = (apart(&frozen, &moving), apart(&truth, &still));
        let ratios = distances
            .iter()
            .zip(&peaks)
            .map(|(distance, peak)| distance / peak);
        let worst = ratios.fold(0.0, f64::max);
        println!("  {preset:<15} {:>9.2} %", 100.0 * worst);
        worst
    };
    // affine damps the shortest waves of the wavelet, which four cells hardly carry
    let (affine, flip) = (transfer("moving-affine"), transfer("moving-flip"));
    assert!(affine < 0.3 * total && flip > 4.0 * affine);
    let smooth = series(1, |mut o| {
        o.request.presets.push("bspline".to_owned());
        o
    });
    let (errors, peaks) = (apart(&smooth, &truth), apart(&truth, &still));
    let smooth = errors
        .iter()
        .zip(&peaks)
        .map(|(e, peak)| e / peak)
        .fold(0.0, f64::max);
    println!(
        "  total with B-splines, consistent masses {:.2} %",
        100.0 * smooth
    );
    assert!(smooth < 0.6 * total);
}

#[test]
fn carrying_the_motion_has_a_share_of_its_own() {
    let out = tempfile::tempdir().expect("a temporary folder");
    let options = narrow_column(out.path())
        .method("dashpot")
        .set("points.mode=moving")
        .set("points.transfer=affine")
        .set("source.amplitude_m_s=0.001");
    let finished = converge(&options, &[], true).unwrap_or_else(|error| panic!("{error}"));
    let (transfer, total) = (share(&finished, "transfer"), share(&finished, "total"));
    assert!(transfer > 0.0 && transfer < total, "{transfer} of {total}");
}

#[test]
fn a_share_is_the_distance_of_two_runs_over_the_true_peak() {
    let own = budget(|o| o);
    let (whole, quarter) = (series(1, |o| o), series(4, |o| o.set("time.dt_s=0.0025")));
    let value = |metric: &str, place: &str| {
        let mut rows = own.rows.iter();
        let row = rows.find(|row| row.metric == metric && row.place == place);
        row.and_then(|row| row.value)
            .unwrap_or_else(|| panic!("no {metric} at {place}"))
    };
    let truth = truth();
    let still = vec![vec![0.0; truth[0].len()]; truth.len()];
    let (distances, peaks) = (apart(&whole, &quarter), apart(&truth, &still));
    for (i, (distance, peak)) in distances.iter().zip(&peaks).enumerate() {
        let row = value("share", &format!("R{}:time:peak_error", i + 1));
        assert!((row - distance / peak).abs() < 1e-12, "R{}: {row}", i + 1);
    }
    // the sides are extended: no boundary has a share, and the row says why
    let boundary = own
        .rows
        .iter()
        .find(|row| row.place == "run:boundary:peak_error");
    let boundary = boundary.expect("a row");
    assert!(
        boundary.value.is_none() && boundary.why.contains("extended"),
        "{}",
        boundary.why
    );
}

/// The true series at the steps of the scene.
fn truth() -> Vec<Vec<f64>> {
    let out = tempfile::tempdir().expect("a temporary folder");
    let prepared = anechoic::commands::show(&lamb(out.path()).request, None);
    let scene = prepared.unwrap_or_else(|error| panic!("{error}")).scene;
    let times: Vec<f64> = (0..=160).map(|step| 0.01 * f64::from(step)).collect();
    let references = scene.references(&times).expect("Lamb's problem");
    let receivers = references[0].receivers.iter();
    receivers
        .flat_map(|(_, components)| components.clone())
        .collect()
}

#[test]
fn a_plateau_is_named_with_the_share_that_holds_it_up() {
    let out = tempfile::tempdir().expect("a temporary folder");
    let options = narrow_column(out.path())
        .set("source.wavelet=sine-squared")
        .set("time.dt_s=0.04")
        .method("dashpot");
    let over = ["grid.h_m=2,1,0.5", "time.dt_s=0.04,0.02"];
    let over = over.map(|text| Over::parse(text).expect("levels"));
    let finished = converge(&options, &over, true).unwrap_or_else(|error| panic!("{error}"));
    let plateaus: Vec<&Row> = finished
        .rows
        .iter()
        .filter(|r| r.metric == "plateau")
        .collect();
    for row in &plateaus {
        println!(
            "{} {:?} {}: {}",
            row.place, row.value, row.evidence, row.reference
        );
    }
    // the step stays where it is and holds up what finer cells would give; a finer step does not
    let cells = plateaus
        .iter()
        .find(|row| row.place == "B:rel_l2@grid.h_m=2..0.5");
    let cells = cells.expect("the error does not fall");
    assert_eq!(cells.evidence, "refinement");
    assert!(
        cells.reference.starts_with("held up by time"),
        "{}",
        cells.reference
    );
    assert!(
        !plateaus
            .iter()
            .any(|row| row.place.starts_with("B:") && row.place.contains("dt_s"))
    );
}
