//! What the paper says of the point source, and how it fares here.

use super::{Direction, PointSource};
use anechoic_reports::study::Finding;
use anechoic_solver::wavelet::Wavelet;

/// Which of the paper's tests the scene is, if its load and its metric's window are that test's.
pub(super) fn test(scene: &PointSource) -> Option<&'static str> {
    let (source, papers) = (&scene.source, PointSource::default());
    let same = source.direction == Direction::Vertical
        && scene.t1_s == papers.t1_s
        && scene.time.end_s == papers.time.end_s
        && scene.material == papers.material;
    match (source.wavelet, source.frequency, source.amplitude) {
        _ if !same => None,
        (Wavelet::Sine, 2.0, 1e6) => Some("Test 1"),
        (Wavelet::Sine, 2.0, 1e8) => Some("Test 2"),
        (Wavelet::Ricker, 3.0, 1e6) => Some("Test 3"),
        _ => None,
    }
}

/// Finding, place, note.
pub(super) const LEDGER: &[(Finding, &str, &str)] = &[];
