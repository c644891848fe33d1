//! What is printed of a plan: what would be solved, what taken from disk, and where it lies.

use super::args::Format;
use super::print::json_text;
use crate::commands::{Exported, Options, Plan};
use crate::error::CaseError;
use crate::prepare::Prepared;
use crate::resume::{Decision, Reuse, folder};
use anechoic_reports::format;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// The plan under the options; nothing is written.
pub fn plan(plan: &Plan, options: &Options, format: Format) -> Result<String, CaseError> {
    let study = options.out.join(plan.folder());
    let decided: Vec<(&Prepared, Decision)> = plan
        .scenes
        .iter()
        .map(|scene| {
            (
                scene,
                Decision::of(scene, &study, options.reuse, options.sampling),
            )
        })
        .collect();
    if format == Format::Json {
        let runs: Vec<Value> = decided
            .iter()
            .map(|(scene, decision)| {
                json!({
                    "case": scene.info.name,
                    "profile": scene.profile,
                    "method": scene.method,
                    "points": scene.bill.points,
                    "unknowns": scene.bill.unknowns,
                    "steps": scene.bill.steps,
                    "folder": study.join(folder(scene)).display().to_string(),
                    "action": decision.word(),
                    "why": decision.why(),
                })
            })
            .collect();
        return json_text(&runs);
    }
    let count = |word: &str| decided.iter().filter(|(_, d)| d.word() == word).count();
    let mut text = format!("would solve {} runs", count("solve"));
    if options.reuse != Reuse::Nothing {
        let _ = write!(text, ", take {} from disk", count("take from disk"));
        let _ = write!(text, ", leave out {}", count("leave out"));
    }
    text.push('\n');
    for (scene, decision) in &decided {
        let _ = writeln!(
            text,
            "  {:<14} {} points, {} unknowns, {} steps -> {}",
            plan.kind.name_of_scene(scene),
            format::count(scene.bill.points),
            format::count(scene.bill.unknowns),
            format::count(scene.bill.steps),
            study.join(folder(scene)).display(),
        );
        if options.reuse != Reuse::Nothing {
            let _ = writeln!(text, "  {:<14} {}: {}", "", decision.word(), decision.why());
        }
    }
    Ok(text)
}

/// The files of a scene that was exported, and what its reference is.
pub fn exported(exported: &Exported) -> String {
    let mut text = String::new();
    for file in &exported.files {
        let _ = writeln!(text, "{}", file.display());
    }
    let _ = match &exported.reference {
        Ok(name) => writeln!(text, "the reference is {name}"),
        Err(why) => writeln!(text, "there is no reference: {why}"),
    };
    text
}
