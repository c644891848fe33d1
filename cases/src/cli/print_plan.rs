//! What is printed of a plan: what would be solved, what taken from disk, and where it lies.

use super::args::Format;
use super::print::json_text;
use crate::commands::{Exported, Options, Plan, Share, Workflow};
use crate::error::CaseError;
use crate::prepare::Prepared;
use crate::resume::{Decision, Reuse, folder};
use anechoic_reports::format;
use anechoic_solver::record::Status;
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
                Decision::of(scene, &study, &plan.kind, options.reuse, options.sampling),
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

/// What a shard did, and how its study is merged.
pub fn share(share: &Share, format: Format) -> Result<String, CaseError> {
    let word = |status: &Status| match status {
        Status::Complete => "complete".to_owned(),
        Status::Cancelled => "stopped".to_owned(),
        Status::Failed(error) => format!("failed: {error}"),
    };
    if format == Format::Json {
        let runs: Vec<Value> = share
            .solved
            .iter()
            .map(|run| {
                let folder = run.folder.display().to_string();
                json!({"run": run.name, "folder": folder, "status": word(&run.status)})
            })
            .collect();
        return json_text(&json!({
            "shard": share.shard.to_string(),
            "solved": runs,
            "references": share.references,
            "taken": share.taken,
            "merge": share.merge,
        }));
    }
    let mut text = format!("shard {} of {} runs: ", share.shard, share.runs);
    let _ = match (share.solved.len(), share.taken, share.references.len()) {
        (0, 0, 0) => writeln!(text, "there is nothing to do"),
        (0, taken, 0) => writeln!(text, "nothing to do, {taken} were there"),
        (solved, taken, _) => writeln!(text, "{solved} solved, {taken} were there"),
    };
    for hash in &share.references {
        let _ = writeln!(text, "  certified reference {hash}");
    }
    for hash in &share.without {
        let _ = writeln!(
            text,
            "  certified reference {hash} could not be computed; the merge tries again"
        );
    }
    for run in &share.solved {
        let (status, folder) = (word(&run.status), run.folder.display());
        let _ = writeln!(text, "  {}: {status} -> {folder}", run.name);
    }
    for (name, why) in &share.left_out {
        let _ = writeln!(text, "  {name} is left out: {why}");
    }
    let _ = writeln!(
        text,
        "nothing is judged yet; when all shards are done, merge them with\n  {}",
        share.merge
    );
    Ok(text)
}

/// The files of a study that was written down, and how they are started.
pub fn written(plan: &Workflow) -> String {
    let minutes = |seconds: f64| format!("{:.1}", seconds / 60.0);
    let mut text = format!(
        "{} runs and {} missing references in {} shards: about {} min of CPU time, the longest shard {} min\n",
        plan.runs,
        plan.references,
        plan.shards,
        minutes(plan.total_s),
        minutes(plan.longest_s),
    );
    for file in &plan.files {
        let _ = writeln!(text, "  {}", file.display());
    }
    let dir = plan.folder.display();
    let _ = write!(
        text,
        "start them from this folder with one of
  snakemake -s {dir}/Snakefile --cores 2
  snakemake -s {dir}/Snakefile --profile {dir}/profile
  sbatch --dependency=afterany:$(sbatch --parsable {dir}/slurm.sh) {dir}/slurm-merge.sh
"
    );
    text
}
