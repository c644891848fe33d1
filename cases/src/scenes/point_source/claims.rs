//! What is claimed of the boundary methods: echo ratios of the groups against the certified
//! reference, for the paper's target (profiles `quick`, `paper`) and for the gate's.

use super::{PointSource, settlement};
use crate::scene::SceneClaim;
use crate::spec::TimeSpec;
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::tradeoff::RELATIVE_COST;
use anechoic_solver::problem::{PointMode, Scheme, Transfer};
use anechoic_solver::wavelet::Wavelet;

/// Method, group, what is accepted, why.
type Stated = (&'static str, &'static str, Accept, &'static str);

/// What the undamped operator's energy grows by at least (1/s): far above rounding, below what spectra
/// of small meshes have (0.02 to 0.37).
const GROWTH: f64 = 0.01;

pub(super) const GROUPS: [&str; 3] = ["A", "B", "C"];

/// The claims, for the scene as run.
pub(super) fn claims(scene: &PointSource) -> Vec<SceneClaim> {
    if scene.source.wavelet == Wavelet::Step {
        return settlement::claims(scene);
    }
    let (stated, not_here) = if is_gate(scene) {
        (gate(), other_soil(scene))
    } else {
        (targets(scene), obstacle(scene))
    };
    let claim = |(method, place, accept, why): Stated| SceneClaim {
        claim: Claim {
            method: method.to_owned(),
            metric: "echo_ratio".to_owned(),
            place: place.to_owned(),
            accept,
            evidence: Evidence::Certified,
            why: why.to_owned(),
        },
        not_here: not_here.clone(),
    };
    let ablation = !is_gate(scene) && scene.source.wavelet != Wavelet::Ricker;
    let growth = ablation.then(|| growth(not_here.clone()));
    stated.into_iter().map(claim).chain(growth).collect()
}

/// What an echo of half a per cent may cost on the paper's target, over the extended mesh.
pub(super) fn trades(scene: &PointSource) -> Vec<Claim> {
    if obstacle(scene).is_some() {
        return Vec::new();
    }
    vec![Claim {
        method: "pml".to_owned(),
        metric: RELATIVE_COST.to_owned(),
        place: "echo<=0.005".to_owned(),
        accept: Accept::at_most(0.1),
        evidence: Evidence::Certified,
        why: "10 cells of layer have a fifteenth of the extended mesh's unknowns".to_owned(),
    }]
}

/// That the stretch alone is unstable, which no reference is needed to see.
fn growth(not_here: Option<String>) -> SceneClaim {
    SceneClaim {
        claim: Claim {
            method: "pml-stretched/kept-bare".to_owned(),
            metric: "growth_rate_per_s".to_owned(),
            place: "total:low".to_owned(),
            accept: Accept::at_least(GROWTH),
            evidence: Evidence::Regression,
            why: "the operator is not symmetric: without damping its energy grows, beyond its interval".to_owned(),
        },
        not_here,
    }
}

/// At most so much at the groups A, B, C.
fn at_most(method: &'static str, bounds: [f64; 3], why: &'static str) -> Vec<Stated> {
    GROUPS
        .into_iter()
        .zip(bounds)
        .map(|(group, bound)| (method, group, Accept::at_most(bound), why))
        .collect()
}

/// The targets on the paper's target of 2000 x 2000 m.
fn targets(scene: &PointSource) -> Vec<Stated> {
    let ricker = scene.source.wavelet == Wavelet::Ricker;
    let frozen = scene.points.mode == PointMode::Frozen;
    let flip = scene.points.transfer == Transfer::Flip;
    let mut all = Vec::new();
    if ricker {
        all.extend(at_most(
            "pml",
            [0.005; 3],
            "10 cells in finite elements leave 0.14 / 0.21 / 0.21 % of a Ricker wavelet",
        ));
        all.extend(at_most(
            "pml-20",
            [if frozen { 0.001 } else { 0.002 }; 3],
            "20 cells leave at most 0.05 % of a Ricker wavelet frozen, 0.13 % moving",
        ));
    } else {
        all.extend(at_most(
            "pml",
            [0.01, 0.02, 0.01],
            "10 cells in finite elements leave 0.41 / 1.07 / 0.44 % of a full sine",
        ));
        all.extend(at_most(
            "pml-20",
            [0.003, 0.005, 0.003],
            "20 cells in finite elements leave 0.07 / 0.30 / 0.11 % of a full sine",
        ));
        if frozen {
            all.extend(at_most(
                "pml-50",
                [0.0005, 0.001, 0.0005],
                "50 cells in finite elements leave 0.006 / 0.059 / 0.010 % of a full sine",
            ));
        }
    }
    if flip && !ricker {
        all.extend(at_most(
            "pml-stretched",
            [0.05, 0.15, 0.12],
            "the published layer with the published transfer leaves 3.4 / 11.5 / 9.6 % in a prototype",
        ));
    }
    all.extend(ablation(ricker));
    all
}

/// What really absorbs in the published layer; on a full sine.
fn ablation(ricker: bool) -> Vec<Stated> {
    if ricker {
        return Vec::new();
    }
    let mut all = vec![
        (
            "pml-stretched/kept-bare",
            "B",
            Accept::at_least(1.0),
            "a real stretch slows the wave and absorbs nothing: as much comes back as from a fixed edge",
        ),
        (
            "pml-stretched/flip-bare",
            "B",
            Accept::within(0.10, 0.16),
            "displacements sent to nodes and back in every step absorb what the stretch does not",
        ),
    ];
    all.extend(at_most(
        "pml-stretched/flip",
        [0.05, 0.15, 0.12],
        "the published layer with the published transfer leaves 3.4 / 11.5 / 9.6 % in a prototype",
    ));
    all
}

/// Is this the gate's scene: a quarter of the target, half the time?
fn is_gate(scene: &PointSource) -> bool {
    let width = scene.target.x_max_m - scene.target.x_min_m;
    let size = (width, scene.target.depth_m) == (1000.0, 1000.0);
    size && (scene.t1_s, scene.time.end_s) == (2.5, 5.0) && scene.source.wavelet == Wavelet::Sine
}

/// Why the gate's bounds, which are measured values, do not hold.
fn other_soil(scene: &PointSource) -> Option<String> {
    let same = scene.material == PointSource::default().material;
    (!same).then(|| "measured in the paper's soil, and material is another here".to_owned())
}

/// The gate's own bounds: measured values with a quarter to spare, since a layer a cell thinner, let
/// alone one with a side missing, leaves more. Thick layers are nearer to the solver's tolerance.
fn gate() -> Vec<Stated> {
    [
        at_most(
            "pml",
            [0.0058, 0.0075, 0.0098],
            "10 cells leave 0.47 / 0.60 / 0.79 % here; the quarter above is for other processors' rounding and small changes of the scheme, and less than what a cell of layer is worth",
        ),
        at_most(
            "pml-20",
            [0.0017, 0.0013, 0.0021],
            "20 cells leave 0.13 / 0.10 / 0.16 % here; a quarter above",
        ),
        at_most(
            "pml-50",
            [0.00018, 0.00013, 0.00028],
            "50 cells leave 0.014 / 0.010 / 0.022 % here; a quarter above",
        ),
    ]
    .concat()
}

/// The paper's steps and end, implicit or explicit: the layer's equations are discretised alike.
fn is_stated_time(scene: &PointSource, papers: &PointSource) -> bool {
    let implicit = TimeSpec {
        scheme: papers.time.scheme,
        ..scene.time.clone()
    };
    let stated = [papers.time.scheme, Scheme::Explicit];
    implicit == papers.time && stated.contains(&scene.time.scheme)
}

/// Why the targets do not apply to the scene as it stands.
fn obstacle(scene: &PointSource) -> Option<String> {
    let papers = PointSource::default();
    let differs = |name: &str, same: bool| (!same).then(|| name.to_owned());
    let reasons: Vec<String> = [
        differs("target", scene.target == papers.target),
        differs("receivers", scene.receivers == papers.receivers),
        differs("material", scene.material == papers.material),
        differs("grid.h_m", scene.grid == papers.grid),
        differs("time", is_stated_time(scene, &papers)),
        differs("t1_s", scene.t1_s == papers.t1_s),
        differs("source", is_stated_load(scene)),
    ]
    .into_iter()
    .flatten()
    .collect();
    (!reasons.is_empty()).then(|| {
        format!(
            "the targets are stated for Tests 1 and 3 of profiles quick and paper; here these differ: {}",
            reasons.join(", ")
        )
    })
}

/// Test 1 or Test 3, whatever the force where points do not move.
fn is_stated_load(scene: &PointSource) -> bool {
    let source = &scene.source;
    let small = scene.points.mode == PointMode::Frozen || source.amplitude <= 1e6;
    small
        && matches!(
            (source.wavelet, source.frequency),
            (Wavelet::Sine, 2.0) | (Wavelet::Ricker, 3.0)
        )
}
