//! Levels of a convergence study: what is no refinement is refused before anything is solved.

use crate::error::CaseError;
use crate::over::{CELLS, Over, level_in};
use crate::prepare::Prepared;
use anechoic_reports::convergence::{Curve, at_level};

/// Each level must be a number of the scene, and cells that were asked for finer must be finer.
pub(super) fn check(scenes: &[Prepared], over: &Over) -> Result<(), CaseError> {
    let wrong = |what: String| Err(CaseError::Usage(format!("--over {}: {what}", over.field)));
    for (scene, value) in scenes.iter().zip(&over.values) {
        if level_in(&scene.table, &over.field) != Some(*value) {
            return wrong(format!(
                "is no number that errors could fall with; a field of the scene or a method's parameter is, for example {CELLS} or pml.thickness_m"
            ));
        }
    }
    if over.field != CELLS {
        return Ok(());
    }
    for (pair, values) in scenes.windows(2).zip(over.values.windows(2)) {
        let [coarse, fine] = [&pair[0], &pair[1]].map(|scene| scene.scene.cell_m());
        if fine >= coarse {
            return wrong(format!(
                "{} and {} give the same cells of {coarse} m, since cells are fitted to the body",
                values[0], values[1]
            ));
        }
    }
    Ok(())
}

/// Places that rows of the study may have, given those of one run.
pub(super) fn places(of_run: &[String], over: &Over) -> Vec<String> {
    let mut places = Vec::new();
    for place in of_run {
        let on_level = |value: &f64| at_level(place, &over.field, *value);
        places.extend(over.values.iter().map(on_level));
        for metric in ["rel_l2", "peak_error"] {
            places.push(Curve::order_place(place, metric));
        }
    }
    places
}
