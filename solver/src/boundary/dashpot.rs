//! Dashpot.

use super::params::{MethodInfo, Param, ParamKind};

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "dashpot",
    summary: "viscous tractions rho c_p (normal) and rho c_s (tangential) on the side",
    params: &[Param {
        name: "impedance",
        doc: "share of the material's impedance that the dashpots have",
        kind: ParamKind::Number { unit: "1", default: Some(1.0), min: 0.0, max: 1e6 },
    }],
};
