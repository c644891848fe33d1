//! Damping layer.

use super::params::{MethodInfo, Param, ParamKind};

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "damping-layer",
    summary: "viscous layer, rate sigma_max (d/L)^p growing towards its outer end",
    params: &[
        Param {
            name: "thickness_m",
            doc: "thickness L of the layer",
            kind: ParamKind::Number { unit: "m", default: None, min: 1e-9, max: 1e9 },
        },
        Param {
            name: "sigma_max_per_s",
            doc: "damping rate at the outer end",
            kind: ParamKind::Number { unit: "1/s", default: Some(12.0), min: 0.0, max: 1e9 },
        },
        Param {
            name: "power",
            doc: "power p of the profile",
            kind: ParamKind::Number { unit: "1", default: Some(2.0), min: 0.0, max: 10.0 },
        },
        Param {
            name: "placement",
            doc: "outside: material is added to the body; inside: the outermost part of the body is damped",
            kind: ParamKind::Choice(&["outside", "inside"]),
        },
        Param {
            name: "end",
            doc: "condition behind the layer",
            kind: ParamKind::Choice(&["fixed", "roller", "free"]),
        },
    ],
};
