//! Runs whose energy grows after the load: said aloud, and no proof of little echo.

use super::foreign::OF_ECHO;
use crate::posed::{Posed, either};
use crate::runner::Run;
use anechoic_reports::norms::Unloaded;
use anechoic_reports::row::{Row, Verdict};
use anechoic_solver::boundary::pml_stretched;
use anechoic_solver::problem::Elastic;

/// What a run's energy does after the load; `None` where that cannot be said.
pub(super) fn unloaded(run: &Run, problem: &Posed) -> Option<Unloaded> {
    if !either!(problem, problem => problem.flow.is_passive()) {
        return None;
    }
    let energy = &run.record.energy;
    let ends = problem.pulses().into_iter().map(|pulse| pulse.end());
    let load_end = ends.fold(0.0, f64::max);
    Unloaded::of(&energy.times, energy.column("total")?, load_end).ok()
}

/// Fails the claims of little echo that a run meets though its energy runs away, and says that it grows.
pub(super) fn unstable(run: &Run, rows: &mut [Row]) -> Option<String> {
    let problem = run.prepared.scene.posed();
    let unloaded = unloaded(run, &problem)?;
    if !unloaded.grows() && !unloaded.runs_away() {
        return None;
    }
    let rate = unloaded.rate.filter(|_| unloaded.grows());
    let by = rate.map_or(String::new(), |rate| {
        format!(" by {:.2} per second", rate.value)
    });
    let mut note = format!(
        "{}: its energy grows{by}, to {:.2e} times what the load brought: unstable here",
        run.manifest.method, unloaded.over_loaded
    );
    if let Some(reason) = ill_posed(run, problem.material()) {
        note = format!("{note}; {reason}");
    }
    if unloaded.runs_away() {
        for row in rows.iter_mut() {
            let little = row.accept.is_some_and(|accept| accept.max.is_some());
            let passes = row.verdict == Some(Verdict::Pass);
            if passes && little && OF_ECHO.contains(&row.metric.as_str()) {
                row.verdict = Some(Verdict::Fail);
                row.why.clone_from(&note);
            }
        }
    }
    Some(note)
}

/// Why the published layer grows in this material, if it does.
fn ill_posed(run: &Run, material: &Elastic) -> Option<String> {
    let sides = run.prepared.scene.boundary().named();
    let ratio = material.p_speed() / material.s_speed();
    let limit = pml_stretched::LARGEST_SPEED_RATIO;
    let mut sides = sides.into_iter();
    let used = sides.any(|(_, side)| side.method == pml_stretched::METHOD.name);
    (used && ratio > limit).then(|| {
        format!(
            "the published layer's equations are ill-posed where c_p/c_s exceeds 1 + sqrt 2 (nu = 0.396), and here it is {ratio:.2}"
        )
    })
}
