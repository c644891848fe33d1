//! The runs of a study of stability: all methods at extremes of step, material, layer and points.

use super::Plan;
use super::points::Points;
use crate::commands::Options;
use crate::error::CaseError;
use crate::judge::{RATIO_AXIS, STEP_AXIS};
use crate::prepare::{Prepared, Target};
use crate::study::Kind;
use crate::sweep::{Grid, Part, Setting};
use anechoic_solver::boundary::{MethodInfo, Rungs, find};

/// Steps over the time that the fastest wave takes through a cell.
const STEPS: [f64; 7] = [0.001, 0.01, 0.1, 1.0, 5.0, 20.0, 100.0];
/// Fewest steps of a run whose step is an extreme.
const FEWEST: f64 = 200.0;
/// Most steps of it: under the gate's profile, and else.
const MOST: [f64; 2] = [500.0, 2000.0];
/// Steps that a pulse takes at least, so that it is one.
const IN_PULSE: f64 = 20.0;

const RATIOS: [f64; 7] = [0.0, 0.25, 0.4, 0.45, 0.49, 0.499, 0.4999];

/// The true layer is refused with flip unless it is forced: here its growth is what is asked for.
const TRANSFERS: [(&str, &[&str]); 5] = [
    (
        "frozen, keep",
        &["points.mode=frozen", "points.transfer=keep"],
    ),
    (
        "frozen, affine",
        &["points.mode=frozen", "points.transfer=affine"],
    ),
    (
        "moving, affine",
        &["points.mode=moving", "points.transfer=affine"],
    ),
    (
        "moving, flip (pml forced)",
        &[
            "points.mode=moving",
            "points.transfer=flip",
            "pml.with_flip=force",
        ],
    ),
    (
        "moving, pic",
        &["points.mode=moving", "points.transfer=pic"],
    ),
];

const BASES: [(&str, &[&str]); 5] = [
    (
        "linear, consistent",
        &["basis=linear", "time.mass=consistent"],
    ),
    ("gimp, lumped", &["basis=gimp", "time.mass=lumped"]),
    ("gimp, consistent", &["basis=gimp", "time.mass=consistent"]),
    ("bspline, lumped", &["basis=bspline", "time.mass=lumped"]),
    (
        "bspline, consistent",
        &["basis=bspline", "time.mass=consistent"],
    ),
];

const PER_CELL: [usize; 4] = [1, 4, 9, 16];

/// Edges of cells along x over those along y.
const ASPECTS: [f64; 5] = [0.05, 0.2, 2.0, 5.0, 20.0];

/// Distances of points from cells' faces, over cells' edges: hardly inside, and hardly apart.
const FACE_GAPS: [f64; 3] = [1e-9, 1e-3, 0.499_999_999];

/// Stiffness of the middle third of the body over that of all else.
const CONTRASTS: [f64; 4] = [1e-6, 1e-3, 1e3, 1e6];

/// Steps of the long run: under the gate's profile, and else.
const LONG: [f64; 2] = [2000.0, 100_000.0];

/// What becomes of `stability`.
pub(super) fn stability(options: &Options) -> Result<Plan, CaseError> {
    let target = Target::find(&options.request)?;
    let mut methods = options.methods.clone();
    if methods.is_empty() {
        methods = usual(&target);
    }
    let mut points = Points::alone();
    let mut parts = Vec::new();
    let base = target.prepare(Some(target.info.standard))?;
    let mut add = |title: &str, methods: &[String], settings: Vec<Setting>| {
        if settings.is_empty() {
            return Ok(());
        }
        let about = Part {
            name: title.to_owned(),
            title: title.to_owned(),
            axis: title.to_owned(),
            ..Part::default()
        };
        let part = points.part(about, &options.request, methods, settings)?;
        parts.push(part);
        Ok::<(), CaseError>(())
    };
    add(STEP_AXIS, &methods, steps(&base))?;
    add(RATIO_AXIS, &methods, numbers("nu", "material.nu", &RATIOS))?;
    let words = |all: &[(&str, &[&str])]| -> Vec<Setting> {
        let own = |sets: &[&str]| sets.iter().map(|set| (*set).to_owned()).collect();
        all.iter()
            .map(|(label, sets)| named((*label).to_owned(), own(sets)))
            .collect()
    };
    add(
        "transfer between points and nodes",
        &methods,
        words(&TRANSFERS),
    )?;
    add("basis and masses", &methods, words(&BASES))?;
    let per_cell =
        PER_CELL.map(|n| named(format!("{n} a cell"), vec![format!("points.per_cell={n}")]));
    add("points in a cell", &methods, per_cell.to_vec())?;
    if has(&base, "material.inclusion") {
        let contrasts = numbers("contrast", "material.inclusion", &CONTRASTS);
        add(
            "contrast of stiffness: the middle over the rest",
            &methods,
            contrasts,
        )?;
    }
    add("edges of a cell along x over y", &methods, aspects(&base))?;
    add(
        "points near cells' faces, over edges",
        &methods,
        face_gaps(),
    )?;
    for method in &methods {
        let Ok(scene) = target.prepare(Some(method)) else {
            continue;
        };
        let title = format!("strength and thickness of {method}");
        add(&title, std::slice::from_ref(method), strengths(&scene))?;
    }
    let count = if base.profile == "gate" {
        LONG[0]
    } else {
        LONG[1]
    };
    add("long run", &methods, vec![long(&base, count)])?;
    let grid = Grid {
        name: "stability".to_owned(),
        parts,
    };
    points.plan(Kind::Stability(grid), options)
}

/// Each kind of method once: presets that differ in a layer's numbers alone are one method.
fn usual(target: &Target) -> Vec<String> {
    let mut kinds: Vec<Vec<String>> = Vec::new();
    let mut names = Vec::new();
    for method in target.info.methods.iter().filter(|m| !m.on_request) {
        let Ok(scene) = target.prepare(Some(method.name)) else {
            continue;
        };
        let sides = scene.scene.boundary().named();
        let kind: Vec<String> = sides.iter().map(|(_, side)| side.method.clone()).collect();
        if !kinds.contains(&kind) {
            kinds.push(kind);
            names.push(method.name.to_owned());
        }
    }
    names
}

/// A number at its extremes.
fn numbers(name: &str, field: &str, values: &[f64]) -> Vec<Setting> {
    let setting = |value: &f64| Setting {
        label: format!("{name}={value}"),
        value: Some(*value),
        sets: vec![format!("{field}={value}")],
    };
    values.iter().map(setting).collect()
}

/// Cells longer than high and higher than long, as large as the scene's unless the body is narrower: the
/// longer edge alone is stated, and with that of the scene there would be more by the ratio.
fn aspects(scene: &Prepared) -> Vec<Setting> {
    let (h, most) = (scene.scene.cell_m(), scene.scene.posed().narrowest());
    let setting = |aspect: &f64| {
        let longer = (h * aspect.max(1.0 / aspect).sqrt()).min(most);
        Setting {
            label: format!("aspect={aspect}"),
            value: Some(*aspect),
            sets: vec![
                format!("grid.aspect={aspect}"),
                format!("grid.h_m={longer:.3}"),
            ],
        }
    };
    ASPECTS.iter().map(setting).collect()
}

/// Points at rest near faces, and points that go to and fro over them.
fn face_gaps() -> Vec<Setting> {
    let gap = |mode: &str, gap: f64, sets: &[&str]| {
        let mut all = vec![format!("points.face_gap={gap}")];
        all.extend(sets.iter().map(|set| (*set).to_owned()));
        named(format!("{mode}, gap={gap}"), all)
    };
    let [frozen, moving] = [TRANSFERS[0].1, TRANSFERS[2].1];
    let resting = FACE_GAPS.iter().map(|value| gap("frozen", *value, frozen));
    resting
        .chain([gap("moving", FACE_GAPS[0], moving)])
        .collect()
}

fn named(label: String, sets: Vec<String>) -> Setting {
    Setting {
        label,
        value: None,
        sets,
    }
}

/// Is it a field of the scene?
fn has(scene: &Prepared, field: &str) -> bool {
    scene.info.all_fields().iter().any(|own| own.path == field)
}

/// A run of `count` steps of `dt` (s), with a pulse that fits.
fn timed(scene: &Prepared, label: String, dt: f64, count: f64) -> Setting {
    let end = count * dt;
    let pulse = scene.scene.posed().pulses().first().copied();
    let mut sets = vec![format!("time.dt_s={dt}"), format!("time.end_s={end}")];
    if let Some(pulse) = pulse {
        // No shorter than some steps, and over in the first quarter of the run.
        let length = pulse.end().max(IN_PULSE * dt).min(0.25 * end);
        let scale = pulse.end() / length;
        sets.push(format!("source.frequency_Hz={}", pulse.frequency * scale));
        if has(scene, "source.t0_s") {
            sets.push(format!("source.t0_s={}", pulse.t0 / scale));
        }
    }
    if has(scene, "t1_s") {
        sets.push(format!("t1_s={}", 0.5 * end));
    }
    named(label, sets)
}

/// Steps from a thousandth to a hundred times the time of the fastest wave through a cell.
fn steps(scene: &Prepared) -> Vec<Setting> {
    let problem = scene.scene.posed();
    let cell = scene.scene.cell_m() / problem.material().p_speed();
    let most = if scene.profile == "gate" {
        MOST[0]
    } else {
        MOST[1]
    };
    let of = |factor: &f64| {
        let dt = factor * cell;
        let count = (problem.end_time() / dt).clamp(FEWEST, most).round();
        let setting = timed(scene, format!("dt = {factor} h/c_p"), dt, count);
        Setting {
            value: Some(*factor),
            ..setting
        }
    };
    STEPS.iter().map(of).collect()
}

/// The scene's own step, so often.
fn long(scene: &Prepared, count: f64) -> Setting {
    let mut setting = timed(
        scene,
        format!("{count} steps"),
        scene.scene.posed().dt(),
        count,
    );
    // The pulse stays what it is.
    setting.sets.retain(|set| !set.starts_with("source."));
    setting
}

/// Extremes of the parameters of the methods on a scene's sides, one at a time.
fn strengths(scene: &Prepared) -> Vec<Setting> {
    let cell = scene.scene.cell_m();
    let mut infos: Vec<&'static MethodInfo> = Vec::new();
    for (_, side) in scene.scene.boundary().named() {
        if let Some(info) = find(&side.method)
            && !infos.iter().any(|other| other.name == info.name)
        {
            infos.push(info);
        }
    }
    let mut settings = Vec::new();
    for info in infos {
        for extreme in info.extremes {
            let values: Vec<f64> = match extreme.rungs {
                Rungs::Cells(cells) => cells.iter().map(|n| n * cell).collect(),
                Rungs::Numbers(numbers) => numbers.to_vec(),
            };
            settings.extend(values.into_iter().map(|value| {
                let set = format!("{}.{}={value}", info.name, extreme.param);
                named(set.clone(), vec![set])
            }));
        }
    }
    settings
}
