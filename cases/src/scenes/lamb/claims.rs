//! What is claimed of the solver, and of methods that pass for a half-space.
//!
//! What separates a mesh from the half-space is dispersion. The trapezoidal rule slows a wave of
//! circular frequency w down by the share (w dt)^2/12, the mesh one of wavenumber k by
//!
//! ```text
//! (k h)^2/24      bilinear elements (and GIMP at rest, which is the same), lumped masses;
//!                 with consistent ones they are as much too fast
//! (k h)^2/8       quadratic B-splines, lumped masses
//! (k h)^4/15      quadratic B-splines, consistent masses, four points a cell
//! ```
//!
//! (Hughes, The Finite Element Method, 1987, chapter 9, and the functions' own symbols), so that at the
//! distance r it lags by k r times that: the phase from which every bound here is made.

use super::Lamb;
use super::exact::Smoothness;
use crate::scene::{Scene, SceneClaim};
use crate::spec::ReceiverSpec;
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::convergence::{self, Curve};
use anechoic_solver::problem::{BasisKind, MassKind, PointMode, Transfer};
use std::f64::consts::PI;

/// Largest `peak_error` on cells of 5 m, at every receiver of the scene as it comes. The worst, R3 under
/// the vertical force, has 4.9 % at a step of 0.00025 s per metre of cell and 5.6 % at twice that: the
/// trapezoidal rule's own share falls from 0.9 to 0.2 %.
const TARGET: f64 = 0.05;

/// Cells (m) for which the target is stated, or smaller ones.
const TARGET_CELL_M: f64 = 5.0;

/// Bounds above this say nothing.
const MEANINGLESS: f64 = 0.5;

/// A receiver nearer than so many cells sees the force's singularity, which no mesh has.
const NEAR_CELLS: f64 = 5.0;

/// Strain under the force, F/(G h), up to which moving points count as linear.
const LINEAR_STRAIN: f64 = 1e-4;

/// Methods that pass for a half-space.
const METHODS: [&str; 2] = ["extended", "pml"];

/// The claims, for the scene as run.
pub(super) fn claims(scene: &Lamb) -> Vec<SceneClaim> {
    let obstacle = obstacle(scene);
    let claim = |method: &str, receiver: &ReceiverSpec| {
        let (bound, why) = bound(scene, receiver);
        SceneClaim {
            not_here: obstacle
                .clone()
                .or_else(|| out_of_reach(scene, receiver, bound)),
            claim: Claim {
                method: method.to_owned(),
                metric: "peak_error".to_owned(),
                place: receiver.name.clone(),
                accept: Accept::at_most(bound),
                evidence: Evidence::Analytic,
                why,
            },
        }
    };
    let methods = METHODS.into_iter();
    methods
        .flat_map(|method| scene.receivers.iter().map(move |r| (method, r)))
        .map(|(method, receiver)| claim(method, receiver))
        .collect()
}

/// What a receiver's `peak_error` may be, and why.
fn bound(scene: &Lamb, receiver: &ReceiverSpec) -> (f64, String) {
    if is_target(scene) {
        let why = "the target on cells of 5 m: a good explicit finite-element run leaves 1 to 4 %";
        return (TARGET, why.to_owned());
    }
    let Lag { second, fourth } = Lag::of(scene, receiver);
    let lag = second + fourth;
    // f^2 and f^4 of the frequencies that a wavelet reaches
    let (bound, how) = match Smoothness::of(&scene.source.pulse()) {
        Smoothness::Smooth => (
            3.0 * second + 9.0 * fourth,
            "three times that (nine times what grows with its fourth power), since a Ricker wavelet reaches up to twice its frequency",
        ),
        Smoothness::Bent => (
            6.0 * second + 36.0 * fourth,
            "six times that (36 times what grows with its fourth power), since a squared sine has twice the frequency of its sine",
        ),
        Smoothness::Kinked => (
            0.6 * lag.cbrt(),
            "0.6 of its cube root, the width over which a front with a kink disperses",
        ),
    };
    let why = format!("a surface wave of the source's frequency lags by {lag:.3} rad; {how}");
    (bound, why)
}

/// Phase (rad) by which a surface wave of the source's frequency lags at a receiver.
struct Lag {
    /// What grows with the square of the frequency.
    second: f64,
    /// What grows with its fourth power.
    fourth: f64,
}

impl Lag {
    fn of(scene: &Lamb, receiver: &ReceiverSpec) -> Self {
        let omega = 2.0 * PI * scene.source.frequency;
        let material = &scene.material;
        let speed = Elastic::new(material.youngs_modulus, material.nu, material.rho_kg_m3)
            .map_or(f64::NAN, |elastic| elastic.rayleigh_speed());
        let k = omega / speed;
        let square = (k * scene.cell_m()).powi(2);
        let (second, fourth) = match (scene.basis, scene.time.mass) {
            (BasisKind::Linear | BasisKind::Gimp, _) => (square / 24.0, 0.0),
            (BasisKind::Bspline, MassKind::Lumped) => (square / 8.0, 0.0),
            (BasisKind::Bspline, MassKind::Consistent) => (0.0, square * square / 15.0),
        };
        let way = k * distance(scene, receiver);
        Lag {
            second: way * (second + (omega * scene.dt()).powi(2) / 12.0),
            fourth: way * fourth,
        }
    }
}

/// Distance (m) of a receiver from the force.
fn distance(scene: &Lamb, receiver: &ReceiverSpec) -> f64 {
    (receiver.x_m - scene.source.x_m).hypot(receiver.y_m - scene.source.y_m)
}

/// Is it the scene as it comes, with either direction of the force, on cells small enough?
fn is_target(scene: &Lamb) -> bool {
    let own = Lamb::default();
    let source = (
        scene.source.wavelet,
        scene.source.frequency,
        scene.source.x_m,
    );
    let own_source = (own.source.wavelet, own.source.frequency, own.source.x_m);
    let small =
        scene.cell_m() <= TARGET_CELL_M && scene.dt() <= super::STEP_PER_METRE * TARGET_CELL_M;
    small
        && scene.receivers == own.receivers
        && scene.material == own.material
        && source == own_source
}

/// Why no claim applies to the scene as it stands.
fn obstacle(scene: &Lamb) -> Option<String> {
    let sides = &scene.boundary;
    for (name, side) in [
        ("left", &sides.left),
        ("right", &sides.right),
        ("bottom", &sides.bottom),
    ] {
        // Methods that are judged have the same on all three; a file may mix them.
        if !METHODS.contains(&side.method.as_str()) {
            return Some(format!(
                "stated where nothing comes back; boundary.{name} is {}, which is not what a half-space has",
                side.method
            ));
        }
    }
    if let Some(ratio) = scene.material.inclusion {
        return Some(format!(
            "stated for one stiffness; here material.inclusion is {ratio}"
        ));
    }
    let points = &scene.points;
    if ![Transfer::Keep, Transfer::Affine].contains(&points.transfer) {
        return Some(
            "stated for the transfers keep and affine; others are reported, not judged".to_owned(),
        );
    }
    let lumped = (BasisKind::Bspline, MassKind::Lumped);
    if is_target(scene) && (scene.basis, scene.time.mass) == lumped {
        return Some(
            "stated for bases that disperse as little as linear functions with lumped masses do; quadratic B-splines want time.mass = \"consistent\""
                .to_owned(),
        );
    }
    let elastic = scene.material.elastic();
    let shear = elastic.youngs_modulus / (2.0 * (1.0 + elastic.poissons_ratio));
    let strain = scene.source.amplitude / (shear * scene.cell_m());
    (points.mode == PointMode::Moving && strain > LINEAR_STRAIN).then(|| {
        format!("the strain of {strain:.1e} under the force is finite, and Lamb's problem is linear; a smaller source.amplitude_N_m, or points.mode = \"frozen\"")
    })
}

/// Why a receiver of this scene is not judged.
fn out_of_reach(scene: &Lamb, receiver: &ReceiverSpec, bound: f64) -> Option<String> {
    let cells = distance(scene, receiver) / scene.cell_m();
    if cells < NEAR_CELLS {
        return Some(format!(
            "{} is {cells:.1} cells from the force, whose singularity no mesh has; stated from {NEAR_CELLS} cells on",
            receiver.name
        ));
    }
    // Also where the lag is no number.
    (bound.is_nan() || bound > MEANINGLESS).then(|| {
        format!(
            "the mesh is too coarse for a bound at {}: it would be {bound:.2}; a smaller grid.h_m",
            receiver.name
        )
    })
}

/// Order of `rel_l2`: two, on either side by what three meshes leave open.
const ORDER: Accept = Accept::within(1.7, 2.3);

/// The coarsest cells (m) that belong to the window of the order, and how much finer the finest are at
/// least: ten cells a shear wave of the scene as it comes.
const ORDER_WINDOW: (f64, f64) = (20.0, 2.0);

/// The claims on the order of convergence over cells of these sizes (m).
pub(super) fn orders(scene: &Lamb, sizes: &[f64]) -> Vec<SceneClaim> {
    let not_here = obstacle(scene).or_else(|| outside_window(scene, sizes));
    let claim = |receiver: &ReceiverSpec| SceneClaim {
        claim: Claim {
            method: "extended".to_owned(),
            metric: convergence::ORDER.to_owned(),
            place: Curve::order_place(&receiver.name, "rel_l2"),
            accept: ORDER,
            evidence: Evidence::Analytic,
            why: "dispersion of the scheme is of second order in space and time".to_owned(),
        },
        not_here: not_here.clone(),
    };
    scene.receivers.iter().map(claim).collect()
}

/// Why no order is claimed on these cells.
fn outside_window(scene: &Lamb, sizes: &[f64]) -> Option<String> {
    if Smoothness::of(&scene.source.pulse()) != Smoothness::Smooth {
        return Some("no mesh resolves where this force bends; stated for a Ricker wavelet that starts in silence".to_owned());
    }
    let (coarse, fine) = (sizes.first()?, sizes.last()?);
    let own = Lamb::default();
    let wave = |scene: &Lamb| {
        let elastic = scene.material.elastic();
        let shear = elastic.youngs_modulus / (2.0 * (1.0 + elastic.poissons_ratio));
        (shear / elastic.density).sqrt() / scene.source.frequency
    };
    let (cell, finer) = ORDER_WINDOW;
    let (wanted, cells) = (wave(&own) / cell, wave(scene) / coarse);
    (cells < wanted || coarse / fine < finer).then(|| {
        format!("stated for at least {wanted:.1} cells a shear wave on the coarsest mesh and cells {finer} times smaller on the finest, not for {cells:.1} and {:.1}", coarse / fine)
    })
}
