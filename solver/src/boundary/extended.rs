//! Extended domain.

use super::params::{MethodInfo, Param, ParamKind};

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "extended",
    summary: "plain material added so that no wave comes back during the run",
    params: &[Param {
        name: "thickness_m",
        doc: "material added; by default as much as the fastest wave needs not to come back before the end",
        kind: ParamKind::Number { unit: "m", default: None, min: 1e-9, max: 1e9 },
    }],
};
