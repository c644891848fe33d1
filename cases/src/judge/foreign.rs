//! Is a series of another program a motion of the scene at all?

use crate::runner::Run;
use anechoic_reports::judge::Measurement;

/// Nothing at all departs from the truth by 1, a motion with the wrong sign by 2, one in millimetres by
/// 999; boundary methods that echo least of all the standard run stay far below.
const UNRECOGNISABLE: f64 = 0.9;

/// Metrics that look for echoes, and find none where there is no motion.
pub(super) const OF_ECHO: [&str; 5] = [
    "residual",
    "echo_ratio",
    "echo_level_db",
    "amplitude_ratio",
    "arrival_s",
];

/// Refuses to judge a scored series that is far from the scene's motion, and takes the numbers away in
/// which that does not show.
///
/// # Errors
/// Where it is how far off, and what to look at.
pub(super) fn recognised(run: &Run, numbers: &mut Vec<Measurement>) -> Result<(), String> {
    let standard = Some(run.prepared.info.standard);
    let judged_as = run.manifest.judged_as();
    if run.manifest.scored.is_none() || judged_as.is_none() || judged_as == standard {
        return Ok(());
    }
    let far = numbers.iter().find_map(|n| {
        let receiver = n.metric == "rel_l2" && !n.place.contains(':');
        let value = n.value.as_ref().ok().filter(|_| receiver)?;
        (*value > UNRECOGNISABLE).then_some((&n.place, value))
    });
    let Some((place, value)) = far else {
        return Ok(());
    };
    let reason = format!(
        "the series is not the scene's motion: rel_l2 at {place} is {value:.3} (no motion at all has 1); check signs (y up), units (m, s) and the load"
    );
    numbers.retain(|n| !OF_ECHO.contains(&n.metric.as_str()));
    Err(reason)
}
