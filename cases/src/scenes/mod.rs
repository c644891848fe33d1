//! The benchmarks: one file and one line each.

use crate::error::CaseError;
use crate::scene::SceneInfo;

macro_rules! scenes {
    ($($module:ident),* $(,)?) => {
        $(pub mod $module;)*

        /// All benchmarks, in the order in which they are listed.
        pub static SCENES: &[&SceneInfo] = &[$(&$module::INFO),*];
    };
}

scenes! {
    compression_1d,
    cube_source,
    lamb,
    mudmat,
    pipe_penetration,
    point_source,
}

/// The benchmark called `name`.
///
/// # Errors
/// [`CaseError::Unknown`] with the nearest name.
pub fn find(name: &str) -> Result<&'static SceneInfo, CaseError> {
    SCENES
        .iter()
        .copied()
        .find(|scene| scene.name == name)
        .ok_or_else(|| CaseError::unknown("case", name, SCENES.iter().map(|s| s.name)))
}
