//! What is claimed of the layer: echo ratios of the groups against the certified reference, for the whole
//! cube (profiles `quick`, `paper`) and for the gate's.

use super::CubeSource;
use crate::scene::SceneClaim;
use crate::spec::ReceiverSpec;
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_solver::problem::PointMode;

/// Mean and worst of a group's receivers as measured.
type Measured = (&'static str, [f64; 2]);

/// On the gate's cube of 10 cells.
const GATE: &[Measured] = &[
    ("A", [0.00248, 0.00386]),
    ("B", [0.00265, 0.00277]),
    ("C", [0.00575, 0.00970]),
];

/// On the cube of 20 cells, points at rest.
const WHOLE: &[Measured] = &[
    ("A", [0.00241, 0.00554]),
    ("B", [0.00458, 0.00629]),
    ("C", [0.00484, 0.00776]),
];

/// The same, points that move.
const MOVING: &[Measured] = &[
    ("A", [0.00389, 0.00888]),
    ("B", [0.00479, 0.00668]),
    ("C", [0.00502, 0.00773]),
];

/// The prototype's worst receiver on a quarter of 20^3 cells with 8 cells of layer.
const WORST: f64 = 0.016;

/// The claims, for the scene as run.
pub(super) fn claims(scene: &CubeSource) -> Vec<SceneClaim> {
    let gates = scene.target.size_m == 200.0;
    let not_here = obstacle(scene, gates);
    let claim = |place: String, accept: Accept, why: &str| SceneClaim {
        claim: Claim {
            method: "pml".to_owned(),
            metric: "echo_ratio".to_owned(),
            place,
            accept,
            evidence: Evidence::Certified,
            why: why.to_owned(),
        },
        not_here: not_here.clone(),
    };
    let within = |value: f64| Accept::within(0.75 * value, 1.25 * value);
    let of = |(group, [mean, worst]): &Measured| match gates {
        true => [
            claim(
                (*group).to_owned(),
                within(*mean),
                "measured, with a quarter to either side: without psi in the edges the means are 0.34, 0.48 and 0.82 %",
            ),
            claim(
                format!("{group}:worst"),
                within(*worst),
                "measured, with a quarter to either side",
            ),
        ],
        false => [
            claim(
                (*group).to_owned(),
                Accept::at_most(1.25 * mean),
                "measured, and a quarter above; the mean of all receivers is 0.36 % at rest and 0.44 % moving, a prototype's 0.48 %",
            ),
            claim(
                format!("{group}:worst"),
                Accept::at_most(WORST),
                "a prototype in finite elements leaves 1.6 % at its worst receiver",
            ),
        ],
    };
    let measured = match (gates, scene.points.mode) {
        (true, _) => GATE,
        (false, PointMode::Frozen) => WHOLE,
        (false, PointMode::Moving) => MOVING,
    };
    measured.iter().flat_map(of).collect()
}

/// Why the claims do not apply to the scene as it stands.
fn obstacle(scene: &CubeSource, gates: bool) -> Option<String> {
    let whole = CubeSource::default();
    let (size, times) = match gates {
        true => (200.0, (0.6, 1.2)),
        false => (whole.target.size_m, (whole.t1_s, whole.time.end_s)),
    };
    let here = |receivers: &[ReceiverSpec]| {
        let inside = |r: &ReceiverSpec| [r.x_m, -r.y_m, r.z_m].iter().all(|x| *x <= size);
        receivers.iter().all(inside)
    };
    let time = &scene.time;
    let differs = |name: &str, same: bool| (!same).then(|| name.to_owned());
    let reasons: Vec<String> = [
        differs("target.size_m", scene.target.size_m == size),
        differs(
            "receivers",
            here(&scene.receivers) && (gates || scene.receivers == whole.receivers),
        ),
        differs(
            "points",
            scene.points.per_cell == whole.points.per_cell
                && (!gates || scene.points.mode == PointMode::Frozen),
        ),
        differs("material", scene.material == whole.material),
        differs("grid", scene.grid == whole.grid),
        differs("basis", scene.basis == whole.basis),
        differs(
            "time.scheme",
            (time.scheme, time.dt_s) == (whole.time.scheme, None),
        ),
        differs("times", (scene.t1_s, time.end_s) == times),
        differs("source", scene.source == whole.source),
    ]
    .into_iter()
    .flatten()
    .collect();
    (!reasons.is_empty()).then(|| {
        format!(
            "the claims are stated for the profiles as they come; here these differ: {}",
            reasons.join(", ")
        )
    })
}
