//! The runs of a study of accuracy against cost: each method on the ladder that its file exports.

use super::Plan;
use super::points::Points;
use crate::commands::Options;
use crate::error::CaseError;
use crate::judge::CERTIFIER;
use crate::prepare::{Prepared, Target};
use crate::study::Kind;
use crate::sweep::{Grid, Part, Setting};
use anechoic_solver::boundary::{MethodInfo, Rungs, find};

/// What becomes of `tradeoff`.
pub(super) fn tradeoff(options: &Options) -> Result<Plan, CaseError> {
    let target = Target::find(&options.request)?;
    let mut points = Points::default();
    let mut parts = Vec::new();
    for method in methods(options, &target)? {
        let scene = match target.prepare(Some(&method)) {
            Ok(scene) => scene,
            Err(error) => {
                points.leave_out(&method, error)?;
                continue;
            }
        };
        let settings = rungs(&scene);
        let about = Part {
            name: method.clone(),
            title: method.clone(),
            axis: match ladders(&scene).as_slice() {
                [] => String::new(),
                all => all
                    .iter()
                    .map(|(info, i)| info.ladder[*i].param)
                    .collect::<Vec<_>>()
                    .join(", "),
            },
            points: Vec::new(),
        };
        parts.push(points.part(about, &options.request, &[method], settings)?);
    }
    parts.retain(|part| !part.points.iter().all(|point| point.runs.is_empty()));
    let grid = Grid {
        name: "tradeoff".to_owned(),
        parts,
    };
    points.plan(Kind::Tradeoff(grid), options)
}

/// The methods that are named; else each kind of sides once, and the extended mesh, by which cost is
/// measured.
fn methods(options: &Options, target: &Target) -> Result<Vec<String>, CaseError> {
    let mut names: Vec<String> = options.methods.clone();
    if names.is_empty() {
        let usual = target.info.methods.iter().filter(|m| !m.on_request);
        names = usual.map(|m| m.name.to_owned()).collect();
    }
    if target.info.method(CERTIFIER).is_some() {
        // First, so that presets whose sides are extended are left to its ladder.
        names.retain(|name| name != CERTIFIER);
        names.insert(0, CERTIFIER.to_owned());
    }
    let mut kinds: Vec<Vec<String>> = Vec::new();
    let mut kept = Vec::new();
    for name in names {
        if target.info.method(&name).is_none() {
            let known = target.info.methods.iter().map(|m| m.name);
            return Err(CaseError::unknown("method", &name, known));
        }
        // One that does not apply has no kind; why is found when its runs are prepared.
        let kind = target.prepare(Some(&name)).map(|scene| sides(&scene));
        match kind {
            Ok(kind) if kinds.contains(&kind) => {}
            Ok(kind) => {
                kinds.push(kind);
                kept.push(name);
            }
            Err(_) => kept.push(name),
        }
    }
    if let Some(at) = kept.iter().position(|name| name == CERTIFIER) {
        let certifier = kept.remove(at);
        kept.push(certifier);
    }
    Ok(kept)
}

/// The methods of a scene's sides and what they choose among words: runs that differ in numbers alone
/// are on one ladder.
fn sides(scene: &Prepared) -> Vec<String> {
    let named = scene.scene.boundary().named();
    let kind = |side: &anechoic_solver::boundary::SideMethod| {
        let words = side
            .params
            .iter()
            .filter(|(_, value)| matches!(value, anechoic_solver::boundary::Value::Text(_)));
        let words: Vec<String> = words
            .map(|(key, value)| format!("{key}={value:?}"))
            .collect();
        format!("{} {}", side.method, words.join(" "))
    };
    named.into_iter().map(|(_, side)| kind(side)).collect()
}

/// The ladders of the methods on a scene's sides: method and place in its list.
fn ladders(scene: &Prepared) -> Vec<(&'static MethodInfo, usize)> {
    let mut all: Vec<(&'static MethodInfo, usize)> = Vec::new();
    for (_, side) in scene.scene.boundary().named() {
        let Some(info) = find(&side.method) else {
            continue;
        };
        if !all.iter().any(|(other, _)| other.name == info.name) {
            all.extend((0..info.ladder.len()).map(|i| (info, i)));
        }
    }
    all
}

/// All combinations of the rungs of a scene's methods; the scene as it is where there are none.
fn rungs(scene: &Prepared) -> Vec<Setting> {
    let cell = scene.scene.cell_m();
    let mut settings = vec![Setting {
        label: String::new(),
        value: None,
        sets: Vec::new(),
    }];
    for (info, at) in ladders(scene) {
        let ladder = &info.ladder[at];
        let values: Vec<f64> = match ladder.rungs {
            Rungs::Cells(cells) => cells.iter().map(|n| n * cell).collect(),
            Rungs::Numbers(numbers) => numbers.to_vec(),
        };
        let mut next = Vec::new();
        for setting in &settings {
            for value in &values {
                let set = format!("{}.{}={value}", info.name, ladder.param);
                let label = format!("{}={value}", ladder.param);
                next.push(Setting {
                    label: match setting.label.as_str() {
                        "" => label,
                        before => format!("{before},{label}"),
                    },
                    value: setting.value.or(Some(*value)),
                    sets: [setting.sets.clone(), vec![set]].concat(),
                });
            }
        }
        settings = next;
    }
    // The extended mesh as it is as well: so much that nothing comes back.
    if scene.method == CERTIFIER {
        settings.push(Setting {
            label: "no-echo".to_owned(),
            value: None,
            sets: Vec::new(),
        });
    }
    for setting in &mut settings {
        if setting.label.is_empty() {
            "as-it-is".clone_into(&mut setting.label);
        }
    }
    settings
}
