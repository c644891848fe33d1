//! A gate that nothing can fail proves nothing: each method is broken in a way that a programmer might
//! break it, and a claim of the gate must fail. Unbroken, the same runs pass.

use anechoic_solver::boundary::{SideMethod, Value};
use anechoic_solver::problem::Problem;
use anechoic_tests::study::{failing, judged};

/// The extended column certifies the perfectly matched layer.
const METHODS: [&str; 5] = ["fixed", "dashpot", "damping-layer", "pml", "extended"];

/// Claims that fail when `change` alters the base of `method`.
fn failing_when(method: &str, change: impl Fn(&mut SideMethod)) -> Vec<String> {
    let with = if method == "pml" {
        vec!["pml", "extended"]
    } else {
        vec![method]
    };
    let failing = failing(&judged(&with, |name, problem: &mut Problem<2>| {
        if name == method {
            change(&mut problem.sides[1][0]);
        }
    }));
    println!("{method} broken: {failing:?} fail");
    failing
}

fn number(base: &SideMethod, key: &str) -> f64 {
    match base.params.get(key) {
        Some(Value::Number(number)) => *number,
        other => panic!("{key}: {other:?}"),
    }
}

#[test]
fn healthy_methods_pass() {
    assert_eq!(failing(&judged(&METHODS, |_, _| {})), [""; 0]);
}

#[test]
fn a_dashpot_on_half_the_mass_fails() {
    let failing = failing_when("dashpot", |base| {
        *base = base.clone().with("impedance", 0.5)
    });
    assert!(failing.contains(&"dashpot/residual/A".to_owned()));
    assert!(failing.contains(&"dashpot/residual/B".to_owned()));
}

#[test]
fn a_dashpot_a_twentieth_too_strong_fails() {
    let failing = failing_when("dashpot", |base| {
        *base = base.clone().with("impedance", 1.05)
    });
    assert!(failing.contains(&"dashpot/residual/A".to_owned()));
}

#[test]
fn a_damping_layer_with_its_sign_flipped_fails() {
    let failing = failing_when("damping-layer", |base| {
        let rate = number(base, "sigma_max_per_s");
        *base = base.clone().with("sigma_max_per_s", -rate);
    });
    assert_eq!(failing, ["damping-layer/residual/A:3-4s"]);
}

#[test]
fn a_perfectly_matched_layer_that_is_too_thin_fails() {
    let failing = failing_when("pml", |base| *base = base.clone().with("thickness_m", 4.0));
    assert!(failing.contains(&"pml/residual/A".to_owned()));
}

#[test]
fn an_extended_column_that_ends_early_fails() {
    let failing = failing_when("extended", |base| {
        *base = base.clone().with("thickness_m", 60.0)
    });
    assert!(failing.contains(&"extended/residual/A".to_owned()));
}

#[test]
fn every_method_that_is_left_out_fails() {
    for method in METHODS {
        let failing = failing_when(method, |base| *base = SideMethod::new("free"));
        assert!(
            failing.iter().any(|claim| claim.starts_with(method)),
            "{method}: {failing:?}"
        );
    }
}
