//! What is printed.

use super::args::Format;
use crate::certified::causality::buffered;
use crate::certified::library::Library;
use crate::commands::{Atlas, Finished, Recomputed};
use crate::error::CaseError;
use crate::field::short;
use crate::posed::Posed;
use crate::prepare::Prepared;
use crate::scene::{Overlay, SceneInfo};
use crate::store;
use crate::study::Kind;
use anechoic_reports::export::summary_json;
use anechoic_reports::format;
use anechoic_reports::judge::Tally;
use anechoic_reports::row::{Row, Verdict};
use anechoic_reports::table::{
    bill_table, measurement_table, ranking_table, upshot_table, verdict_table,
};
use anechoic_solver::boundary::METHODS;
use anechoic_solver::record::Status;
use anechoic_solver::{Bill, Item};
use serde_json::{Value, json};
use std::fmt::Write as _;
use std::io::Write as _;

/// Prints to stdout; a reader that has gone away is no error.
pub fn out(text: &str) {
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
}

/// What the program is and what to type next.
pub fn welcome() -> String {
    "\
anechoic measures how much echo boundary methods leave in particle geomechanics (MPM):
a scene is solved with each method, the records are compared with what is true, and the
differences become rows, verdicts, a ranking and a report.

Type next:
  anechoic list                      cases and methods
  anechoic show compression-1d       a scene and what it will cost
  anechoic compare compression-1d    solve it with all methods and rank them
  anechoic compare point-source      the headline case: about two minutes
  anechoic --help                    all commands, with examples
"
    .to_owned()
}

/// Cases and methods.
pub fn list(scenes: &[&SceneInfo], format: Format) -> Result<String, CaseError> {
    if format == Format::Json {
        let names = |overlays: &[Overlay]| -> Vec<Value> {
            let entry = |o: &Overlay| json!({"name": o.name, "summary": o.summary});
            overlays.iter().map(entry).collect()
        };
        let cases: Vec<Value> = scenes
            .iter()
            .map(|scene| {
                let sweeps = scene.sweeps.iter();
                let sweeps = sweeps.map(|s| json!({"name": s.name, "summary": s.summary}));
                json!({
                    "case": scene.name,
                    "title": scene.title,
                    "source": scene.source,
                    "profiles": names(scene.profiles),
                    "presets": names(scene.presets),
                    "methods": names(scene.methods),
                    "sweeps": sweeps.collect::<Vec<_>>(),
                })
            })
            .collect();
        return json_text(&cases);
    }
    let mut text = String::from("Cases\n");
    for scene in scenes {
        let _ = writeln!(
            text,
            "  {}: {}\n      {}",
            scene.name, scene.title, scene.source
        );
        for (kind, overlays) in [
            ("profiles", scene.profiles),
            ("presets", scene.presets),
            ("methods", scene.methods),
        ] {
            let _ = writeln!(text, "    {kind}");
            for overlay in overlays {
                let _ = writeln!(text, "      {:<14} {}", overlay.name, overlay.summary);
            }
        }
        if !scene.sweeps.is_empty() {
            let _ = writeln!(text, "    sweeps");
        }
        for sweep in scene.sweeps {
            let _ = writeln!(text, "      {:<14} {}", sweep.name, sweep.summary);
        }
    }
    text.push_str("\nMethods of a side (boundary.SIDE.method)\n");
    for method in METHODS {
        let _ = writeln!(text, "  {:<14} {}", method.name, method.summary);
    }
    Ok(text)
}

/// A scene, its windows and its bill.
pub fn show(prepared: &Prepared, format: Format) -> Result<String, CaseError> {
    let bill = &prepared.bill;
    let windows = prepared.scene.windows();
    if format == Format::Json {
        let windows: Vec<Value> = windows
            .iter()
            .map(|w| json!({"where": w.place(), "from_s": w.from_s, "to_s": w.to_s}))
            .collect();
        return json_text(&json!({
            "case": prepared.info.name,
            "profile": prepared.profile,
            "method": prepared.method,
            "hash": prepared.hash(),
            "scene": prepared.table,
            "windows": windows,
            "bill": {
                "features": bill.features,
                "points": bill.points,
                "nodes": bill.nodes,
                "unknowns": bill.unknowns,
                "steps": bill.steps,
                "bytes_per_point": bill.point_bytes() / bill.points,
                "bytes_per_node": bill.bytes_per_node(),
                "bytes": bill.bytes(),
                "seconds": bill.seconds(),
                "items": bill.items.iter().map(item_json).collect::<Vec<_>>(),
            },
        }));
    }
    let info = prepared.info;
    let mut text = format!(
        "{}: {}\n{}\nprofile {}, method {}\n\n",
        info.name, info.title, info.source, prepared.profile, prepared.method
    );
    for field in info.all_fields() {
        let value = field
            .path
            .split('.')
            .try_fold(None, |value: Option<&toml::Value>, key| {
                let next = match value {
                    None => prepared.table.get(key),
                    Some(value) => value.get(key),
                };
                next.map(Some)
            });
        if let Some(Some(value)) = value {
            let _ = writeln!(
                text,
                "  {:<24} {:<28} {}",
                field.path,
                one_line(value),
                field.doc
            );
        }
    }
    if !windows.is_empty() {
        text.push_str("\nEchoes are looked for\n");
    }
    for window in windows {
        let end = window
            .to_s
            .map_or("the end".to_owned(), |to| format!("{to} s"));
        let _ = writeln!(
            text,
            "  {:<8} from {:.4} s to {end}",
            window.place(),
            window.from_s
        );
    }
    text += &bill_text(bill);
    if let Some(problem) = prepared.scene.extended() {
        let _ = writeln!(
            text,
            "  reference  {}",
            reference(prepared.info.name, &problem)?
        );
    }
    Ok(text)
}

/// The bill, feature by feature.
fn bill_text(bill: &Bill) -> String {
    let mut text = format!(
        "\nBill\n  features   {}\n  points     {}\n  nodes      {}\n  unknowns   {}\n  steps      {}\n  memory     {}, without the factor of a direct solver\n  time       {}\n\n",
        bill.features.join(", "),
        format::count(bill.points),
        format::count(bill.nodes),
        format::count(bill.unknowns),
        format::count(bill.steps),
        format::bytes(bill.bytes() as f64),
        estimate(bill),
    );
    text += &bill_table(bill);
    text
}

fn item_json(item: &Item) -> Value {
    json!({
        "feature": item.feature,
        "holds": item.holds,
        "points": item.points,
        "bytes_per_point": item.bytes_per_point,
        "bytes_per_node": item.bytes_per_node,
        "record_bytes": item.record_bytes,
        "step_s": item.step_s,
    })
}

/// About how long a run takes.
fn estimate(bill: &Bill) -> String {
    let seconds = bill.seconds();
    let digits = if seconds < 10.0 { 1 } else { 0 };
    format!("about {seconds:.digits$} s of one core")
}

/// Whether a certified reference is at hand, and what it takes otherwise.
fn reference(case: &str, problem: &Posed) -> Result<String, CaseError> {
    Ok(match Library::shipped().find(case, problem)? {
        Some(found) if found.about.serves(problem.last_time()).is_ok() => format!(
            "certified, stored ({}), serves until {:.2} s",
            found.about.hash, found.about.serves_until_s
        ),
        _ => {
            let bill = buffered(problem, 1.0).bill()?;
            format!(
                "certified; does not come with the program: the first comparison computes it, {} unknowns, {}",
                format::count(bill.unknowns),
                estimate(&bill)
            )
        }
    })
}

/// What a reference is, what it cost, and how it compares with the one before.
pub fn recomputed(recomputed: &Recomputed) -> String {
    let about = &recomputed.reference.about;
    let buffers: Vec<String> = about
        .buffer_m
        .iter()
        .map(|(side, m)| format!("{side} {m} m"))
        .collect();
    let mut text = format!(
        "certified reference {}-{}\n  serves     until {:.3} s, buffer {}\n  cost       {} unknowns, {} steps, {:.1} s, {}\n",
        about.case,
        about.hash,
        about.serves_until_s,
        buffers.join(", "),
        format::count(about.cost.unknowns),
        format::count(about.cost.steps),
        about.cost.wall_s,
        format::bytes(about.cost.peak_bytes as f64),
    );
    if let Some(floor) = &about.floor_m {
        let largest = floor.values().copied().fold(0.0, f64::max);
        let _ = writeln!(text, "  floor      {largest:.1e} m at most");
    }
    match recomputed.change {
        Some(change) => {
            let _ = writeln!(
                text,
                "  change     {change:.1e} of the peaks, from the one stored before"
            );
        }
        None => text.push_str("  change     none was stored before\n"),
    }
    for file in &recomputed.files {
        let _ = writeln!(text, "  {}", file.display());
    }
    text
}

/// Verdicts, ranking, measurements, and where the report lies; or the rows as JSON.
pub fn results(studies: &[Finished], format: Format) -> Result<String, CaseError> {
    if format == Format::Json {
        let rows: Vec<_> = studies.iter().flat_map(|s| s.rows.clone()).collect();
        return rows_as_json(&rows);
    }
    let mut text = String::new();
    for finished in studies {
        let tally = Tally::of(&finished.rows);
        // Of a map, claims that hold are no news.
        let quiet = matches!(finished.study.kind, Kind::Stability(_));
        let told = finished
            .rows
            .iter()
            .filter(|row| !quiet || row.verdict != Some(Verdict::Pass));
        let told: Vec<Row> = told.cloned().collect();
        if told.iter().any(|row| row.verdict.is_some()) {
            text += &verdict_table(&told);
        }
        let _ = writeln!(
            text,
            "{} pass, {} fail, {} not evaluated\n",
            tally.pass, tally.fail, tally.not_evaluated
        );
        match (&finished.study.upshot, &finished.study.ranking) {
            (Some(upshot), _) => text += &upshot_table(upshot),
            (_, Some(ranking)) if finished.study.runs.len() > 1 => text += &ranking_table(ranking),
            _ => text += &measurement_table(&finished.rows),
        }
        let _ = writeln!(text, "\nreport: {}", finished.study.report.display());
        if let Some(animation) = &finished.study.animation {
            let _ = writeln!(text, "animation: {}", animation.display());
        }
    }
    Ok(text)
}

/// Verdicts of an atlas and where its report lies; or the rows as JSON.
pub fn atlas(atlas: &Atlas, format: Format) -> Result<String, CaseError> {
    if format == Format::Json {
        return rows_as_json(&atlas.rows);
    }
    let tally = Tally::of(&atlas.rows);
    Ok(format!(
        "{}{} pass, {} fail, {} not evaluated\n\n{}\nreport: {}\n",
        verdict_table(&atlas.rows),
        tally.pass,
        tally.fail,
        tally.not_evaluated,
        measurement_table(&atlas.rows),
        atlas.report.display()
    ))
}

fn rows_as_json(rows: &[Row]) -> Result<String, CaseError> {
    summary_json(rows).map_err(|error| CaseError::Report {
        what: "the rows as JSON".into(),
        reason: error.to_string(),
    })
}

/// What is to be known of the results, for stderr: runs that did not end, references, pictures, notes.
pub fn missing(finished: &Finished) -> String {
    let mut text = String::new();
    for (run, name) in finished.study.runs.iter().zip(&finished.study.names) {
        let how = match &run.record.status {
            Status::Complete => continue,
            Status::Cancelled => "stopped before its end".to_owned(),
            Status::Failed(error) => format!("failed: {error}"),
        };
        let _ = writeln!(text, "{name}: {how}; what stands is stored");
    }
    for note in &finished.study.notes {
        let _ = writeln!(text, "note: {note}");
    }
    if finished.nothing_judged() {
        text += "none of the claims could be judged; the rows say why\n";
    }
    text
}

/// A value on one line.
fn one_line(value: &toml::Value) -> String {
    match value {
        toml::Value::Table(side) => {
            let method = side
                .get("method")
                .and_then(toml::Value::as_str)
                .unwrap_or("");
            let others: Vec<String> = side
                .iter()
                .filter(|(key, _)| *key != "method")
                .map(|(key, value)| format!("{key} {value}"))
                .collect();
            if others.is_empty() {
                method.to_owned()
            } else {
                format!("{method}: {}", others.join(", "))
            }
        }
        toml::Value::Array(list) => {
            let text = |r: &toml::Value| {
                let get = |key| r.get(key).map_or(String::new(), ToString::to_string);
                format!(
                    "{} ({}, {})",
                    get("name").trim_matches('"'),
                    get("x_m"),
                    get("y_m")
                )
            };
            list.iter().map(text).collect::<Vec<_>>().join(", ")
        }
        toml::Value::Float(x) => short(*x),
        other => other.to_string().trim_matches('"').to_owned(),
    }
}

pub(super) fn json_text(value: &impl serde::Serialize) -> Result<String, CaseError> {
    store::json(value).map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
}
