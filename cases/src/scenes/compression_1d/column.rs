//! What is true of the column, and what is claimed of its boundaries.
//!
//! Velocities are those of d'Alembert's images: T = 2H/c is the way down and up. A receiver at height
//! y sees the pulse after (H - y)/c and the echo of the base after (H + y)/c.

use super::Compression1d;
use crate::checks::{inner_thickness, number};
use crate::scene::{Quantity, Reference, Role, Scene, SceneClaim, Window};
use crate::spec::ReceiverSpec;
use anechoic_reference::analytic::dalembert::{Base, Dalembert, Top};
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::convergence::{self, Curve};
use anechoic_solver::boundary::{SideMethod, extended};
use anechoic_solver::problem::{PointMode, Scheme};
use anechoic_solver::wavelet::Wavelet;

/// Strain of the pulse, amplitude over c, up to which the body counts as linear: its effect on the
/// wave is of this order, far below the 1 % of the claims.
const LINEAR_STRAIN: f64 = 1e-4;

/// Where the echo of overlapping pulses is over: this share of a pulse behind their end.
const TAIL: f64 = 0.15;

/// Cells that the pulse is long, as at h = 1 m; the bounds hold for no fewer.
const CELLS: f64 = 31.0;

/// c dt/h of implicit steps, as at 0.005 s per metre of cell; the bounds hold for no larger.
const COURANT: f64 = 0.315;

/// The paper's c (m/s), for which its printed times hold.
const PAPER_SPEED: f64 = 62.844;

/// When the echo of the base comes to a receiver, and when the pulse has passed it (s).
fn echo_and_pulse(scene: &Compression1d, receiver: &ReceiverSpec) -> [f64; 2] {
    let c = scene.material.elastic().p_speed();
    let echo = (scene.body.height_m + receiver.y_m) / c;
    let direct_over = (scene.body.height_m - receiver.y_m) / c + scene.pulse().end();
    [echo, direct_over]
}

/// Windows of a receiver: its own, and the paper's 3..4 s.
pub(super) fn windows(scene: &Compression1d, receiver: &ReceiverSpec) -> Vec<Window> {
    let [echo, direct_over] = echo_and_pulse(scene, receiver);
    // At the top the echo comes into silence: look from its arrival on. Near the base it runs into
    // the pulse itself: look when both are over (1.45 s at B), for what comes after.
    let from_s = if direct_over <= echo {
        echo
    } else {
        echo + (1.0 + TAIL) * scene.pulse().end()
    };
    let window = |label: &str, from_s, to_s, stated_by| Window {
        receiver: receiver.name.clone(),
        label: label.to_owned(),
        from_s,
        to_s,
        stated_by,
    };
    let mut windows = vec![window("", from_s, None, None)];
    if scene.time.end_s >= 4.0 {
        let paper = (Evidence::Paper, "S21 section 3.1");
        windows.push(window("3-4s", 3.0, Some(4.0), Some(paper)));
    }
    windows
}

/// Both references: with the base as modelled, where a closed form knows it, and without echo.
pub(super) fn references(scene: &Compression1d, times: &[f64]) -> Result<Vec<Reference>, String> {
    let sides = &scene.boundary;
    for (name, side, wanted) in [
        ("left", &sides.left, "roller"),
        ("right", &sides.right, "roller"),
        ("top", &sides.top, "free"),
    ] {
        if side.method != wanted {
            return Err(format!(
                "d'Alembert's column has boundary.{name} = {wanted}, here it is {}",
                side.method
            ));
        }
    }
    if let Some(reason) = two_stiffnesses(scene) {
        return Err(reason);
    }
    let mut references = vec![series(
        scene,
        times,
        "dalembert-no-echo",
        Role::NoEcho,
        Base::Absorbing,
    )?];
    if let Some(base) = base(&sides.bottom) {
        references.push(series(scene, times, "dalembert", Role::Modelled, base)?);
    }
    Ok(references)
}

/// Until when (s) the column as run is free of its outer end: the way from the top by that end to the
/// nearest receiver takes (H + 2 b + y)/c when b metres are added below the base.
pub(super) fn serves_until_s(scene: &Compression1d) -> Option<f64> {
    let base = &scene.boundary.bottom;
    if base.method != "extended" {
        return None;
    }
    let added = extended::thickness(&scene.problem(), base);
    let lowest = scene.receivers.iter().map(|r| r.y_m);
    let way = scene.body.height_m + 2.0 * added + lowest.fold(f64::INFINITY, f64::min);
    Some(way / scene.material.elastic().p_speed())
}

/// What a closed form knows of the base; a damping layer has none in time.
fn base(bottom: &SideMethod) -> Option<Base> {
    match bottom.method.as_str() {
        "roller" | "fixed" => Some(Base::Roller),
        "free" => Some(Base::Dashpot {
            impedance_ratio: 0.0,
        }),
        "dashpot" => Some(Base::Dashpot {
            impedance_ratio: number(bottom, "impedance").unwrap_or(1.0),
        }),
        "extended" if bottom.params.is_empty() => Some(Base::Absorbing),
        _ => None,
    }
}

fn series(
    scene: &Compression1d,
    times: &[f64],
    name: &'static str,
    role: Role,
    base: Base,
) -> Result<Reference, String> {
    let pulse = scene.pulse();
    let speed = scene.material.elastic().p_speed();
    let column = Dalembert::new(scene.body.height_m, speed, base, Top::Free, pulse.end())
        .map_err(|error| error.to_string())?;
    let receivers = scene
        .receivers
        .iter()
        .map(|receiver| {
            // The pulse is that of the y-up velocity, so the solution is y-up as well.
            let vy: Result<Vec<f64>, _> = times
                .iter()
                .map(|&t| column.velocity(|t| pulse.value(t), receiver.y_m, t))
                .collect();
            let vy = vy.map_err(|error| error.to_string())?;
            Ok((receiver.name.clone(), vec![vec![0.0; times.len()], vy]))
        })
        .collect::<Result<_, String>>()?;
    Ok(Reference {
        name,
        role,
        evidence: Evidence::Analytic,
        quantity: Quantity::Velocity,
        receivers,
        pulses: true,
    })
}

/// The claims, for the scene as run.
pub(super) fn claims(scene: &Compression1d) -> Vec<SceneClaim> {
    let mut claims = Vec::new();
    for receiver in &scene.receivers {
        let at = receiver.name.as_str();
        let mut claim = |method: &str, metric: &str, place: &str, max, evidence, why: &str| {
            let overlap = (metric == "peak_deviation").then(|| overlap(scene, receiver));
            claims.push(SceneClaim {
                not_here: not_here(scene, receiver, evidence).or(overlap.flatten()),
                claim: Claim {
                    method: method.to_owned(),
                    metric: metric.to_owned(),
                    place: place.to_owned(),
                    accept: Accept::at_most(max),
                    evidence,
                    why: why.to_owned(),
                },
            });
        };
        let analytic = Evidence::Analytic;
        claim(
            "fixed",
            "peak_deviation",
            at,
            0.03,
            analytic,
            "every peak of the pulse and its echoes, 31 cells a pulse",
        );
        claim(
            "fixed",
            "arrival_s",
            at,
            0.02,
            analytic,
            "four steps of 0.005 s, in which the wave runs 1.3 cells",
        );
        claim(
            "dashpot",
            "residual",
            at,
            0.01,
            analytic,
            "a dashpot is exact in 1D; what is left is dispersion of the half sine's kinks",
        );
        claim(
            "extended",
            "residual",
            at,
            0.01,
            analytic,
            "nothing comes back before the end: dispersion alone, bounded as for the dashpot",
        );
        claim(
            "pml",
            "residual",
            at,
            0.005,
            Evidence::Certified,
            "20 cells of layer against the column that goes on, on the same mesh: what is left is the layer's own; 0.26 % in a prototype",
        );
        for method in ["dashpot", "damping-layer"] {
            claim(
                method,
                "residual",
                &format!("{at}:3-4s"),
                0.15,
                Evidence::Paper,
                "S21 section 3.1: below 15 % of the pulse at t = 3 s",
            );
        }
    }
    claims
}

/// Order of `rel_l2` in space and time together: two for a smooth wave, less what its start and the
/// coarsest mesh leave, and not more than a lucky pair of meshes can show.
const ORDER: Accept = Accept::within(1.6, 2.2);

/// Cells a pulse on the coarsest mesh at least, and how much finer the finest is at least.
const ORDER_WINDOW: [f64; 2] = [8.0, 4.0];

/// The claims on the order of convergence over cells of these sizes (m).
pub(super) fn orders(scene: &Compression1d, sizes: &[f64]) -> Vec<SceneClaim> {
    let obstacle = no_order(scene, sizes);
    let claim = |method: &str, receiver: &ReceiverSpec| SceneClaim {
        claim: Claim {
            method: method.to_owned(),
            metric: convergence::ORDER.to_owned(),
            place: Curve::order_place(&receiver.name, "rel_l2"),
            accept: ORDER,
            evidence: Evidence::Analytic,
            why: "the scheme is of second order in space and time, and the pulse is smooth"
                .to_owned(),
        },
        not_here: obstacle.clone(),
    };
    let methods = ["fixed", "dashpot"].into_iter();
    methods
        .flat_map(|method| scene.receivers.iter().map(move |r| claim(method, r)))
        .collect()
}

/// Why no order is claimed.
fn no_order(scene: &Compression1d, sizes: &[f64]) -> Option<String> {
    if scene.source.wavelet != Wavelet::SineSquared {
        return Some("no mesh resolves the kinks of this pulse, so the order is one; stated for --set source.wavelet=sine-squared".into());
    }
    if let Some(reason) = finite(scene) {
        return Some(reason);
    }
    let (coarse, fine) = (sizes.first()?, sizes.last()?);
    let pulse = scene.material.elastic().p_speed() * scene.pulse().end();
    let [cells, finer] = ORDER_WINDOW;
    (pulse / coarse < cells || coarse / fine < finer).then(|| {
        format!("stated for at least {cells} cells a pulse on the coarsest mesh and cells {finer} times smaller on the finest, not for {:.1} and {:.1}", pulse / coarse, coarse / fine)
    })
}

/// Why the peaks of a receiver are not judged: where the pulse meets its echo the exact velocity has a
/// cusp, which every mesh rounds (B: by 8.5, 6.6, 3.4 % at cells of 1, 0.5, 0.25 m).
fn overlap(scene: &Compression1d, receiver: &ReceiverSpec) -> Option<String> {
    let [echo, direct_over] = echo_and_pulse(scene, receiver);
    (direct_over > echo).then(|| {
        format!(
            "pulse and echo overlap at {} ({echo:.3}..{direct_over:.3} s): the exact velocity has a cusp there, which every mesh rounds",
            receiver.name
        )
    })
}

/// Why a claim does not apply to this receiver of the scene as it stands.
fn not_here(scene: &Compression1d, receiver: &ReceiverSpec, evidence: Evidence) -> Option<String> {
    if let Some(reason) = two_stiffnesses(scene) {
        return Some(reason);
    }
    let layer = inner_thickness(&scene.boundary.bottom);
    if layer > 0.0 && receiver.y_m <= layer {
        return Some(format!(
            "{} lies inside the damping layer (heights 0..{layer} m)",
            receiver.name
        ));
    }
    let c = scene.material.elastic().p_speed();
    if evidence == Evidence::Paper {
        let papers = (c / PAPER_SPEED - 1.0).abs() < 0.01 && scene.body.height_m == 50.0;
        return (!papers).then(|| {
            format!(
                "the paper's times hold for 63 m/s and 50 m, not for {c:.1} m/s and {} m",
                scene.body.height_m
            )
        });
    }
    if let Some(reason) = finite(scene) {
        return Some(reason);
    }
    let cells = c * scene.pulse().end() / scene.cell_m();
    let courant = c * scene.dt() / scene.cell_m();
    let most = match scene.time.scheme {
        Scheme::Explicit => super::COURANT + 1e-6,
        _ => COURANT,
    };
    (cells < CELLS || courant > most).then(|| {
        format!("stated for at least {CELLS} cells a pulse and Courant numbers of at most {most:.3}, not for {cells:.1} and {courant:.3}")
    })
}

/// Why d'Alembert does not hold where waves come back from within.
fn two_stiffnesses(scene: &Compression1d) -> Option<String> {
    let ratio = scene.material.inclusion?;
    Some(format!(
        "d'Alembert's column has one stiffness, here material.inclusion is {ratio}"
    ))
}

/// Why d'Alembert does not hold, where points move too far.
fn finite(scene: &Compression1d) -> Option<String> {
    let strain = scene.source.amplitude_m_s / scene.material.elastic().p_speed();
    (scene.points.mode == PointMode::Moving && strain > LINEAR_STRAIN).then(|| {
        format!(
            "the pulse's strain of {strain:.1e} is finite, so d'Alembert does not hold; use --preset linear"
        )
    })
}
