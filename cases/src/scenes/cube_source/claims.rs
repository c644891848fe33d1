//! What is claimed of the layer: echo ratios of the groups against the certified reference.

use super::CubeSource;
use crate::scene::SceneClaim;

/// The claims, for the scene as run.
pub(super) fn claims(_scene: &CubeSource) -> Vec<SceneClaim> {
    Vec::new()
}
