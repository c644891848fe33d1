//! Gates of the transfer between points and nodes: what it loses in a closed box, how late it is.
//!
//! Analytic: a closed elastic box keeps its energy. The bounds for `affine` are those of the point
//! source's specification; `flip` is reported beside it and must be worse.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::problem::{Drive, PointMode, Problem, Transfer};
use anechoic_solver::record::Record;
use anechoic_solver::wavelet::{Pulse, Wavelet};
use anechoic_tests::{half_space, solved};

const SINE: Pulse = Pulse {
    wavelet: Wavelet::Sine,
    amplitude: 1e6,
    frequency: 2.0,
    t0: 0.0,
};
const RICKER: Pulse = Pulse {
    wavelet: Wavelet::Ricker,
    amplitude: 1e6,
    frequency: 3.0,
    t0: 0.5,
};

/// The half-space's box closed by fixed walls, 6 s.
fn closed_box(mode: PointMode, transfer: Transfer, pulse: Pulse) -> Problem<2> {
    let mut problem = half_space(SideMethod::new("fixed"), mode, transfer);
    problem.end_time = 6.0;
    problem.rel_tol = 1e-12;
    for drive in &mut problem.drives {
        if let Drive::PointForce { pulse: force, .. } = drive {
            *force = pulse;
        }
    }
    problem
}

/// Rate of loss of the energy once the force is over, from 1.2 s to the end (1/s).
fn loss(record: &Record) -> f64 {
    let energy = record.energy.column("total").unwrap();
    let times = &record.energy.times;
    let from = times.iter().position(|t| *t >= 1.2).unwrap();
    let last = times.len() - 1;
    (energy[from] / energy[last]).ln() / (times[last] - times[from])
}

#[test]
fn frozen_nodes_keep_the_energy_of_a_closed_box() {
    for pulse in [SINE, RICKER] {
        let rate = loss(&solved(&closed_box(
            PointMode::Frozen,
            Transfer::Keep,
            pulse,
        )));
        println!("keep, {:?}: loss {rate:.1e} /s", pulse.wavelet);
        assert!(rate.abs() < 1e-10);
    }
}

#[test]
fn affine_loses_little_and_flip_much_more() {
    for (pulse, most) in [(SINE, 0.003), (RICKER, 0.01)] {
        let rate = |transfer| loss(&solved(&closed_box(PointMode::Moving, transfer, pulse)));
        let (affine, flip) = (rate(Transfer::Affine), rate(Transfer::Flip));
        println!(
            "{:?}: loss of affine {affine:.4} /s, flip {flip:.4} /s",
            pulse.wavelet
        );
        // the points' energy breathes by a few parts in 10,000 about its course
        assert!(affine > -5e-4 && affine <= most);
        assert!(flip > 0.01 && flip > 3.0 * affine);
    }
}

/// Delay (s) of a series against another by the largest correlation, a parabola between samples.
fn delay(late: &[f64], early: &[f64], dt: f64) -> f64 {
    let correlation = |lag: i64| -> f64 {
        (0..late.len() as i64)
            .filter(|k| (0..early.len() as i64).contains(&(k - lag)))
            .map(|k| late[k as usize] * early[(k - lag) as usize])
            .sum()
    };
    let best = (-20..=20)
        .max_by(|a, b| correlation(*a).total_cmp(&correlation(*b)))
        .unwrap();
    let [a, b, c] = [best - 1, best, best + 1].map(correlation);
    dt * (best as f64 + 0.5 * (a - c) / (a - 2.0 * b + c))
}

#[test]
fn affine_is_not_late() {
    let series = |mode, transfer| {
        let mut problem = half_space(SideMethod::new("pml"), mode, transfer);
        problem.end_time = 2.0;
        solved(&problem).receivers.column("A2_uy").unwrap().to_vec()
    };
    let frozen = series(PointMode::Frozen, Transfer::Keep);
    let affine = delay(&series(PointMode::Moving, Transfer::Affine), &frozen, 0.01);
    println!("delay of affine at A2: {:.2} ms", 1e3 * affine);
    assert!(affine.abs() < 2e-3);
}
