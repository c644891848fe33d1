//! Gates of the damping layer's two forms: S21's, printed as a factor of every step, drifts with the step;
//! the rate does not. Both follow the closed form of a viscous layer (Riccati's equation).

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic_reference::analytic::damping_layer::{DampingLayer, End};
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::problem::{Drive, Problem};
use anechoic_tests::explicit::leapfrog;
use anechoic_tests::{column, solved};
use std::f64::consts::PI;

/// Thickness (m) of the layer, cells (m) of the column, steps over the time through a cell.
const THICKNESS: f64 = 10.0;
const CELL: f64 = 0.5;
const COURANTS: [f64; 3] = [0.4, 0.2, 0.1];
/// S21's coefficient (1/m), a quarter of it, so that enough comes back to be told at the shortest step.
const ALPHA: f64 = 0.0025;
/// The rate (1/s) at the outer end that is the printed one at the longest of the steps.
const RATE: f64 = 7.86;

/// Frequencies (Hz) of waves in the layer.
const AT: [f64; 3] = [1.0, 2.0, 3.0];

/// Reflection of a harmonic wave by what lies below the column: the transform of what comes after
/// `back` (s) at the free top, over twice that of the pulse.
fn harmonic_reflection(problem: &Problem<2>) -> [f64; 3] {
    let record = solved(problem);
    let Drive::SideVelocity { pulse, .. } = &problem.drives[0] else {
        panic!("the column is driven at its top");
    };
    let back = 2.0 * problem.target.upper[1] / problem.material.p_speed();
    let values = record.receivers.column("A_vy").unwrap();
    AT.map(|f| {
        let (mut echo, mut sent) = ([0.0; 2], [0.0; 2]);
        for (t, v) in record.receivers.times.iter().zip(values) {
            let (sine, cosine) = (2.0 * PI * f * t).sin_cos();
            let first = 2.0 * pulse.value(*t);
            sent = [sent[0] + first * cosine, sent[1] + first * sine];
            // from just before its front to just before the second echo's
            if (0.9 * back..1.95 * back).contains(t) {
                echo = [echo[0] + v * cosine, echo[1] + v * sine];
            }
        }
        echo[0].hypot(echo[1]) / sent[0].hypot(sent[1])
    })
}

/// The column over a layer with a fixed end.
fn over(layer: SideMethod, courant: f64) -> Problem<2> {
    let mut problem = leapfrog(column(CELL, layer), courant);
    problem.end_time = 3.2;
    problem.probes.energy_every = None;
    problem
}

fn layer() -> SideMethod {
    SideMethod::new("damping-layer").with("thickness_m", THICKNESS)
}

fn printed() -> SideMethod {
    let layer = layer().with_choice("form", "printed");
    layer.with("alpha_per_m", ALPHA)
}

fn rate() -> SideMethod {
    layer().with("sigma_max_per_s", RATE).with("power", 1.0)
}

/// The closed form for damping at the rate `g` (1/s) at the depth x (m).
fn exact(problem: &Problem<2>, g: impl Fn(f64) -> f64) -> [f64; 3] {
    let layer = DampingLayer::new(THICKNESS, problem.material.p_speed(), End::Fixed, g).unwrap();
    AT.map(|f| layer.reflection(f).unwrap().norm())
}

/// What a mesh of 0.5 m may add: (k h)^2/8 of an impedance at 3 Hz is 0.3 %, and the window cuts the
/// tail of the echo at the second one's front.
const MOST: f64 = 0.01;

fn near(own: [f64; 3], exact: [f64; 3]) -> bool {
    own.iter()
        .zip(exact)
        .all(|(own, exact)| (own - exact).abs() < MOST)
}

/// A step takes the share beta = alpha x, so the rate is -ln(1 - beta)/dt and doubles as the step is
/// halved.
#[test]
fn the_printed_layer_drifts_with_the_step_as_its_closed_form_says() {
    let mut by_step = Vec::new();
    for courant in COURANTS {
        let problem = over(printed(), courant);
        let own = harmonic_reflection(&problem);
        let dt = problem.dt;
        let exact = exact(&problem, |x| -(1.0 - ALPHA * x).ln() / dt);
        println!("printed, Courant number {courant}: R {own:.4?} for {exact:.4?}");
        assert!(near(own, exact), "{courant}");
        by_step.push(own);
    }
    for f in 0..3 {
        let drift = by_step[2][f] / by_step[0][f];
        println!(
            "a quarter of the step at {} Hz: {drift:.3} times the echo",
            AT[f]
        );
        assert!((drift - 1.0).abs() > 0.3, "{drift}");
    }
}

#[test]
fn the_rate_does_not_drift_and_follows_its_closed_form() {
    let mut first = None;
    for courant in COURANTS {
        let problem = over(rate(), courant);
        let own = harmonic_reflection(&problem);
        let exact = exact(&problem, |x| RATE * x / THICKNESS);
        println!("rate, Courant number {courant}: R {own:.4?} for {exact:.4?}");
        assert!(near(own, exact), "{courant}");
        let first = first.get_or_insert(own);
        for (own, first) in own.iter().zip(first.iter()) {
            assert!((own - first).abs() < 0.5 * MOST, "{own} {first}");
        }
    }
}

/// In the printed layer's own closed form another step's rate is another layer.
#[test]
fn a_layer_of_another_step_is_found_out() {
    let problem = over(printed(), COURANTS[0]);
    let own = harmonic_reflection(&problem);
    let half = exact(&problem, |x| ALPHA * x / (0.5 * problem.dt));
    assert!(!near(own, half), "{own:?} {half:?}");
}
