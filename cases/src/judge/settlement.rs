//! What stays after a force that stays on, or after a net impulse: measured where the scene's forces leave
//! such a thing.

use super::Subject;
use crate::posed::either;
use crate::scene::Quantity;
use anechoic_reports::judge::Measurement;
use anechoic_reports::norms::{drift_error, settlement_error, with_groups};
use anechoic_solver::problem::Drive;
use anechoic_solver::wavelet::Lasting;

/// Settlement or drift, whichever there is.
pub(super) fn measure(subject: &Subject<'_>, numbers: &mut Vec<Measurement>) {
    let left = |what: Lasting| {
        either!(subject.problem, problem => problem.drives.iter().any(
            |d| matches!(d, Drive::PointForce { pulse, .. } if pulse.lasting() == what)
        ))
    };
    if subject.reference.quantity != Quantity::Displacement {
        return;
    }
    let (metric, scores) = if left(Lasting::Force) {
        let scores = subject
            .pair()
            .and_then(|(run, truth)| settlement_error(run, truth));
        ("settlement_error", scores)
    } else if left(Lasting::Impulse) {
        let scores = subject
            .pair()
            .and_then(|(run, truth)| drift_error(run, truth));
        ("drift_error", scores)
    } else {
        return;
    };
    let scores = scores.and_then(|scores| with_groups(&scores));
    subject.put(metric, "1", scores, numbers);
}
