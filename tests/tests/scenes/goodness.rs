//! Goodness of fit in the rows of a study: every receiver of every run against what is known of it.

use anechoic_tests::program::{anechoic, folder, narrow, rows};

/// `goodness` of a method at a place; there must be exactly one.
#[track_caller]
fn goodness(rows: &[serde_json::Value], method: &str, place: &str) -> f64 {
    let is = |row: &&serde_json::Value| row["method"] == method && row["where"] == place;
    let found: Vec<_> = rows.iter().filter(is).collect();
    assert_eq!(found.len(), 1, "{method} {place}: {found:?}");
    assert_eq!(found[0]["metric"], "goodness");
    found[0]["value"].as_f64().expect("a number")
}

#[test]
fn every_run_has_one_at_each_receiver() {
    let folder = folder();
    let methods = ["fixed", "dashpot", "damping-layer"].map(|method| ["--method", method]);
    let compare = [
        &["compare", "compression-1d"],
        &methods.concat()[..],
        &["--filter", "goodness", "--format", "json"],
    ];
    let output = anechoic(folder.path(), &narrow(&compare.concat()));
    assert_eq!(output.code, 0, "{}", output.err);
    let rows = rows(&output.out);
    // Rollers and dashpot are compared with the closed form of what they are: the solver is good.
    for method in ["fixed", "dashpot"] {
        for receiver in ["A", "B"] {
            let value = goodness(&rows, method, receiver);
            assert!((9.0..10.0).contains(&value), "{method} {receiver}: {value}");
        }
    }
    // A damping layer has no closed form but that without echo, of which it leaves some.
    for receiver in ["A", "B"] {
        let value = goodness(&rows, "damping-layer", receiver);
        assert!((4.0..8.0).contains(&value), "{receiver}: {value}");
    }
    assert_eq!(rows.len(), 6);
}
