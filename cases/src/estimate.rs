//! What work will take, before it is done: rough, for people and schedulers.

use crate::prepare::Prepared;
use anechoic_solver::Bill;
use anechoic_solver::problem::{PointMode, Problem, Transfer};

/// Time of a point-step (us) where nodes keep their motion, with layers and pictures, as measured on
/// one core of a server of 2023.
const FROZEN_US: f64 = 0.11;
/// The same where points that rest carry the motion.
const CARRIED_US: f64 = 0.3;
/// The same where points move.
const MOVING_US: f64 = 0.6;

/// Memory at the peak of a run over that of its points and nodes: twice with conjugate gradients; the
/// factor of a direct solver takes as much again.
const PEAK: f64 = 4.0;

/// Memory of a stored step in bytes: some sixty series of numbers.
const STEP_BYTES: f64 = 512.0;

/// Time of a point-step (us).
pub fn us_per_point_step(problem: &Problem<2>) -> f64 {
    match (problem.point_mode, problem.transfer) {
        (PointMode::Frozen, Transfer::Keep) => FROZEN_US,
        (PointMode::Frozen, _) => CARRIED_US,
        (PointMode::Moving, _) => MOVING_US,
    }
}

/// CPU time of a run (s).
pub fn seconds(problem: &Problem<2>, bill: &Bill) -> f64 {
    1e-6 * us_per_point_step(problem) * bill.points as f64 * bill.steps as f64
}

/// Memory of a run at its peak, its record apart (bytes).
pub fn peak_bytes(bill: &Bill) -> f64 {
    let own = bill.points * bill.bytes_per_point + bill.nodes * bill.bytes_per_node;
    PEAK * own as f64
}

/// Memory of a run's record (bytes).
pub fn record_bytes(scene: &Prepared) -> f64 {
    STEP_BYTES * scene.bill.steps as f64
}
