//! Appendix A of K25: the published layer's parameters, one by one, with a true layer and a damping
//! layer beside it.

use crate::sweep::named::{NamedPart, NamedSweep};
use anechoic_reports::study::Finding;

/// The sweep.
pub(super) static APPENDIX_A: NamedSweep = NamedSweep {
    name: "appendix-a",
    summary: "mesh, thickness, strength and damping of the published layer (K25, Appendix A)",
    presets: &["test-2"],
    methods,
    parts: PARTS,
    ledger: LEDGER,
};

/// The published layer has the published transfer where points move; the others cannot have it, or
/// are not meant to.
fn methods(profile: &str) -> &'static [&'static str] {
    match profile {
        "paper" => &["pml-stretched/flip", "pml", "damping-layer"],
        _ => &["pml-stretched", "pml", "damping-layer"],
    }
}

const PARTS: &[NamedPart] = &[
    NamedPart {
        name: "mesh",
        title: "A.1: size of cells, layer of 1000 m (true layer: 10 cells)",
        axis: "cell size h (m)",
        over: &["grid.h_m=40,20,10"],
        names: &[],
        falls: None,
    },
    NamedPart {
        name: "thickness",
        title: "A.2: thickness of the layer",
        axis: "thickness L (m)",
        over: &[
            "pml-stretched.thickness_m,pml.thickness_m,damping-layer.thickness_m=200..2000:200",
        ],
        names: &[],
        falls: Some("pml-stretched"),
    },
    NamedPart {
        name: "profile",
        title: "A.3: power of the layer's profile, 1000 m",
        axis: "power beta",
        over: &["pml-stretched.beta,damping-layer.power=1..4:1"],
        names: &[],
        falls: None,
    },
    NamedPart {
        name: "strength",
        title: "A.3: strength with thickness, alpha/L = 0.004/m",
        axis: "strength alpha",
        over: &["pml-stretched.alpha=0.8..8:0.8/pml-stretched.thickness_m=200..2000:200"],
        names: &[],
        falls: Some("pml-stretched"),
    },
    NamedPart {
        name: "rayleigh",
        title: "A.4, cases 5, 6, 7, 8, 3: Rayleigh damping alpha_M",
        axis: "alpha_M (1/s)",
        over: &["pml-stretched.rayleigh_per_s=0,0.1,0.5,0.8,1"],
        names: &[],
        falls: Some("pml-stretched"),
    },
    NamedPart {
        name: "damping",
        title: "A.4: the nine cases of Table A.3",
        axis: "case of Table A.3",
        over: &[
            "pml-stretched.relaxed_modulus_ratio=1,0.999,0.99,0.9,0.99,0.99,0.99,0.99,1/pml-stretched.rayleigh_per_s=1,1,1,1,0,0.1,0.5,0.8,0",
        ],
        names: &[
            "case-1", "case-2", "case-3", "case-4", "case-5", "case-6", "case-7", "case-8",
            "case-9",
        ],
        falls: None,
    },
];

/// Finding, place, note.
const LEDGER: &[(Finding, &str, &str)] = &[];
