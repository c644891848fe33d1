//! Gates of the transfers in explicit steps: what they lose in a closed box, what they keep of momentum,
//! and that what moves along leaves uniform motion alone.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::problem::{
    BasisKind, Drive, PointMode, Problem, Side, StressUpdate, Transfer,
};
use anechoic_solver::record::Record;
use anechoic_solver::wavelet::{Pulse, Wavelet};
use anechoic_tests::explicit::{FLOWS, flowing, leapfrog};
use anechoic_tests::{block, column, half_space, solved};
use std::f64::consts::PI;

const LINEAR: (BasisKind, StressUpdate) = (BasisKind::Linear, StressUpdate::Usl);

/// Transfers with their share of pic.
const TRANSFERS: [(Transfer, f64); 4] = [
    (Transfer::Affine, 0.0),
    (Transfer::Flip, 0.0),
    (Transfer::Flip, 0.05),
    (Transfer::Pic, 0.0),
];

/// The half-space's box closed by fixed walls, 6 s, as in the implicit gate.
fn closed_box((transfer, share): (Transfer, f64), ricker: bool) -> Problem<2> {
    let walls = half_space(SideMethod::new("fixed"), PointMode::Frozen, Transfer::Keep);
    let mut problem = flowing(walls, 0.4, LINEAR, transfer);
    problem.flow.pic_share = share;
    problem.end_time = 6.0;
    for drive in &mut problem.drives {
        if let Drive::PointForce { pulse, .. } = drive {
            *pulse = Pulse {
                wavelet: if ricker {
                    Wavelet::Ricker
                } else {
                    Wavelet::Sine
                },
                frequency: if ricker { 3.0 } else { 2.0 },
                t0: 0.5,
                ..*pulse
            };
        }
    }
    problem
}

/// Rate of loss of the energy from `from` (s) to the end (1/s).
fn loss(record: &Record, from: f64) -> f64 {
    let energy = record.energy.column("total").unwrap();
    let times = &record.energy.times;
    let first = times.partition_point(|t| *t < from);
    // a period of the wave on either end: the energy of points breathes about its course
    let mean = |k: usize| energy[k..k + 40].iter().sum::<f64>() / 40.0;
    let last = energy.len() - 41;
    (mean(first) / mean(last)).ln() / (times[last] - times[first])
}

/// Analytic: a closed elastic box keeps its energy. Explicit steps move points by nodes whose last kick is
/// not filtered yet, so that what they lose goes with the step: the bounds of `affine` in implicit steps
/// (0.003/s of a sine, 0.01/s of a Ricker wavelet) hold at half of S21's step; at the whole of it the
/// wavelet's is half as much again. The other transfers stand beside it in their order.
#[test]
fn affine_keeps_the_energy_of_a_closed_box_in_explicit_steps() {
    for (ricker, most) in [(false, 0.003), (true, 0.01)] {
        let rates = TRANSFERS.map(|transfer| loss(&solved(&closed_box(transfer, ricker)), 1.2));
        let mut short = closed_box(TRANSFERS[0], ricker);
        short.dt *= 0.5;
        let short = loss(&solved(&short), 1.2);
        println!(
            "ricker {ricker}: loss of affine, flip, flip + 0.05 pic, pic {rates:.4?} /s; affine at half the step {short:.4}"
        );
        let [affine, flip, share, pic] = rates;
        assert!(affine > 0.0 && affine <= 1.5 * most, "{affine}");
        assert!(
            short <= most && (0.3..0.7).contains(&(short / affine)),
            "{short}"
        );
        assert!(flip > 10.0 * affine && share > 1.5 * flip && pic > 1.5 * share);
    }
}

/// A column over rollers, its top moved by a full sine of 2 Hz and free afterwards: 16 m, or 16 cells.
fn ringing(transfer: Transfer, share: f64) -> Problem<2> {
    let mut problem = column(1.0, SideMethod::new("roller"));
    problem.drives = vec![Drive::SideVelocity {
        side: Side::TOP,
        pulse: Pulse {
            wavelet: Wavelet::Sine,
            amplitude: 1e-3,
            frequency: 2.0,
            t0: 0.0,
        },
    }];
    let mut problem = flowing(problem, 0.4, LINEAR, transfer);
    problem.flow.pic_share = share;
    problem
}

/// Analytic. Points at the quarters of their cells send a wave of wave number k back to the nodes times
/// F = 0.625 + 0.375 cos kh (point-source specification). A share eta of the nodes' velocity in every step
/// then takes eta (1 - F) of it, so that the energy of a standing wave, half of it motion, falls at the
/// rate eta (1 - F)/dt. Flip moves points by nodes whose last kick is not filtered yet, which adds
/// (1 - F) dt a to the velocity F v of the way: damping of w^2 (1 - F) dt, for the share that is flip. Each k
/// of the pulse falls at its own rate.
fn closed_form(problem: &Problem<2>, share: f64, times: [f64; 2]) -> f64 {
    let (h, dt) = (problem.cell_size, problem.dt);
    let Drive::SideVelocity { pulse, .. } = &problem.drives[0] else {
        panic!("the column is driven at its top");
    };
    let left = |t: f64| -> f64 {
        let frequencies = (1..400).map(|n| 0.025 * f64::from(n));
        let energies = frequencies.map(|f| {
            let (mut re, mut im) = (0.0, 0.0);
            for n in 0..1000 {
                let s = pulse.end() * (f64::from(n) + 0.5) / 1000.0;
                let (sine, cosine) = (2.0 * PI * f * s).sin_cos();
                re += pulse.value(s) * cosine;
                im += pulse.value(s) * sine;
            }
            let kh = 2.0 * PI * f / problem.material.p_speed() * h;
            let filtered = 0.375 * (1.0 - kh.cos());
            let kicks = (1.0 - share) * (2.0 * PI * f).powi(2) * dt;
            let rate = filtered * (share / dt + kicks);
            (re * re + im * im) * (-rate * t).exp()
        });
        energies.sum()
    };
    (left(times[0]) / left(times[1])).ln()
}

/// Loss (natural logarithm) over one way down and up, and its times from the pulse's middle (s): the energy
/// breathes as the wave is turned back at the ends, and is in one phase then.
fn round_trip(problem: &Problem<2>) -> (f64, [f64; 2]) {
    let record = solved(problem);
    let (times, energy) = (&record.energy.times, record.energy.column("total").unwrap());
    let trip = 2.0 * problem.target.upper[1] / problem.material.p_speed() / problem.dt;
    let first = times.partition_point(|t| *t < 0.6);
    let last = first + trip.round() as usize;
    // filtered from when it is sent out
    let since = [first, last].map(|k| times[k] - 0.25);
    ((energy[first] / energy[last]).ln(), since)
}

#[test]
fn a_share_of_pic_takes_what_its_filter_says() {
    for (transfer, share) in [
        (Transfer::Flip, 0.0),
        (Transfer::Flip, 0.05),
        (Transfer::Flip, 0.2),
        (Transfer::Pic, 1.0),
    ] {
        let of_flip = if transfer == Transfer::Pic {
            0.0
        } else {
            share
        };
        let problem = ringing(transfer, of_flip);
        let (own, since) = round_trip(&problem);
        let exact = closed_form(&problem, share, since);
        let period = 0.5 / (since[1] - since[0]);
        println!(
            "{transfer:?}, share {share}: loss a period {:.4}, {:.4} by the filter",
            own * period,
            exact * period
        );
        assert!((own - exact).abs() < 0.05 * exact + 0.002, "{own} {exact}");
    }
    // along a line affine gives back what linear functions hold: it takes nothing
    let (own, _) = round_trip(&ringing(Transfer::Affine, 0.0));
    println!("affine along a line: loss in one round trip {own:.1e}");
    assert!(own.abs() < 2e-3, "{own}");
}

/// Nothing but the force gives momentum: it is the sum of the steps' impulses, to rounding, with all sides
/// free, and stays what it is once the force is over.
#[test]
fn momentum_is_the_impulse_of_the_force_and_stays() {
    for kind in FLOWS {
        for (transfer, share) in TRANSFERS {
            let mut problem = flowing(block(transfer, PointMode::Frozen), 0.4, kind, transfer);
            problem.flow.pic_share = share;
            problem.flow.room = [[1.0; 2]; 2];
            problem.end_time = 8.0;
            let pulse = Pulse {
                wavelet: Wavelet::SineSquared,
                amplitude: 0.05,
                frequency: 0.25,
                t0: 0.0,
            };
            problem.drives = vec![Drive::PointForce {
                place: [1.3, 2.2],
                direction: [0.6, -0.8],
                pulse,
            }];
            let record = solved(&problem);
            let mut given = 0.0;
            let [px, py] = ["momentum_x", "momentum_y"].map(|n| record.energy.column(n).unwrap());
            for (k, (x, y)) in px.iter().zip(py).enumerate() {
                let apart = (x - 0.6 * given).hypot(y + 0.8 * given);
                assert!(apart < 1e-13, "{kind:?} {transfer:?}: {apart} in step {k}");
                given += problem.dt * pulse.value(k as f64 * problem.dt);
            }
            assert!(given > 0.04 && px.len() > 50);
        }
    }
}

/// A slab at 6 m/s between inflow, a layer that ends in it, a dashpot that moves along and free ends has
/// nothing to feel: no velocity departs from 6 m/s, no stress comes up.
#[test]
fn what_moves_along_leaves_uniform_motion_alone() {
    let printed = SideMethod::new("damping-layer")
        .with_choice("form", "printed")
        .with("thickness_m", 1.0);
    let inside = printed
        .with_choice("placement", "inside")
        .with_choice("end", "inflow");
    for kind in FLOWS {
        for left in [SideMethod::new("inflow"), inside.clone()] {
            let mut problem = flowing(
                block(Transfer::Affine, PointMode::Frozen),
                0.4,
                kind,
                Transfer::Affine,
            );
            problem.flow.velocity = [0.5, 0.0];
            problem.flow.room = [[0.0, 4.0], [0.0, 1.0]];
            problem.sides[0][0] = left;
            problem.sides[1] = [SideMethod::new("roller"), SideMethod::new("dashpot")];
            let record = solved(&problem);
            let energy = |name| record.energy.column(name).unwrap();
            let kinetic = energy("kinetic");
            let largest = energy("strain").iter().copied().fold(0.0, f64::max);
            let apart = kinetic.iter().map(|e| (e / kinetic[0] - 1.0).abs());
            let apart = apart.fold(0.0, f64::max);
            println!("{kind:?}: kinetic energy off by {apart:.1e}, strain {largest:.1e} J");
            assert!(apart < 1e-12 && largest < 1e-20 * kinetic[0]);
            assert!((kinetic[0] - 0.5 * 24.0 * 0.25).abs() < 1e-12);
        }
    }
    // a dashpot that stood still would brake it
    let mut still = flowing(
        block(Transfer::Affine, PointMode::Frozen),
        0.4,
        LINEAR,
        Transfer::Affine,
    );
    still.sides[1][1] = SideMethod::new("dashpot");
    still.flow.velocity = [0.0, 0.0];
    assert!(
        solved(&leapfrog(still, 0.4))
            .energy
            .column("kinetic")
            .unwrap()[9]
            == 0.0
    );
}

/// A surface that is pulled is as well held as one that is pushed: both waves are mirror images where
/// strains are small.
#[test]
fn a_pull_is_the_mirror_of_a_push() {
    for kind in FLOWS {
        let run = |sign: f64| {
            let mut problem = column(1.0, SideMethod::new("roller"));
            if let Drive::SideVelocity { pulse, .. } = &mut problem.drives[0] {
                pulse.amplitude = 1e-3 * sign;
            }
            let record = solved(&flowing(problem, 0.4, kind, Transfer::Affine));
            record.receivers.column("A_vy").unwrap().to_vec()
        };
        let (pull, push) = (run(1.0), run(-1.0));
        let apart = pull.iter().zip(&push).map(|(a, b)| (a + b).abs());
        let apart = apart.fold(0.0, f64::max);
        println!("{kind:?}: apart by {apart:.1e} m/s");
        assert!(apart < 5e-6, "{kind:?}: {apart}");
        assert!(push.iter().any(|v| *v < -0.9e-3));
    }
}
