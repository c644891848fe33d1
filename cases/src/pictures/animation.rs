//! The wave field over time: standard, a method, and the run without echo, side by side.

use super::fields::{AROUND, SHOWN, around, at, flows, magnitude, mesh, quantity, windows};
use super::{NO_ECHO, PictureError};
use crate::judge::CERTIFIER;
use crate::runner::Run;
use anechoic_reports::plot::{Corners, Field, PlotError, SnapshotPlot};
use anechoic_reports::ranking::Ranking;

/// The animation as a GIF; none where the runs were not asked for one.
///
/// # Errors
/// What is missing, and what the drawing says.
pub fn draw(runs: &[Run], ranking: &Ranking) -> Result<Option<Vec<u8>>, PictureError> {
    if runs.iter().all(|run| run.frames.animation.is_empty()) {
        return Ok(None);
    }
    let named = |name: &str| {
        let mut runs = runs
            .iter()
            .filter(|run| run.complete() && !run.frames.animation.is_empty());
        runs.find(|run| run.manifest.method == name)
    };
    let standard = runs
        .first()
        .and_then(|run| named(run.prepared.info.standard));
    let not_shown =
        |name: &str| name == CERTIFIER || standard.is_some_and(|run| run.manifest.method == name);
    let best = ranking.methods.iter().filter(|m| !not_shown(&m.method));
    let best = best.into_iter().find_map(|m| named(&m.method));
    let (Some(standard), Some(method)) = (standard, named(SHOWN).or(best)) else {
        return Err(PictureError::Incomplete(
            "it needs the standard run and a method that absorbs, both complete",
        ));
    };
    let mut shown = vec![
        (standard.manifest.method.as_str(), standard, mesh(standard)),
        (method.manifest.method.as_str(), method, mesh(method)),
    ];
    if let Some(extended) = named(CERTIFIER) {
        // It goes on far beyond the picture.
        shown.push((NO_ECHO, extended, around(mesh(standard), 1.0)));
    }
    let rows = method.frames.animation.iter().filter_map(|frame| {
        let fields: Option<Vec<_>> = shown
            .iter()
            .map(|(_, run, _)| at(&run.frames.animation, frame.time).map(magnitude))
            .collect();
        let fields: Result<Vec<_>, PlotError> = fields?.into_iter().collect();
        Some(fields.map(|fields| (frame.time, fields)))
    });
    let rows: Vec<(f64, Vec<Field>)> = rows.collect::<Result<_, PlotError>>()?;
    let [quantity, unit] = method.frames.animation.first().map_or([""; 2], quantity);
    let mut meshes: Vec<Corners> = shown.iter().map(|(_, _, mesh)| *mesh).collect();
    let mut extent = around(mesh(method), AROUND);
    // material that flows leaves its mesh
    let flowing = method.frames.animation.first().is_some_and(flows);
    if let Some(own) = windows(&rows).filter(|_| flowing) {
        (meshes, extent) = own;
    }
    let plot = SnapshotPlot {
        quantity: quantity.into(),
        unit: unit.into(),
        methods: shown
            .iter()
            .map(|(name, _, _)| (*name).to_owned())
            .collect(),
        rows,
        extent,
        meshes,
    };
    Ok(Some(plot.to_gif()?))
}
