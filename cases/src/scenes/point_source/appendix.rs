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
const LEDGER: &[(Finding, &str, &str)] = &[
    (
        Finding::Reproduced,
        "Appendix A.1, finer cells",
        "Refinement does not bring the published layer's echo down: mean echo 11.3, 9.4, 9.7 % on cells of 40, 20, 10 m (frozen points, layer of 1000 m); with the published transfer 22.5, 8.1, 5.7 %. The paper sees a persistent echo on its finest mesh as well.",
    ),
    (
        Finding::Reproduced,
        "Appendix A.2, thicker layers",
        "The echo falls with the thickness: mean 83 % at 200 m, 9.4 % at 1000 m, 4.5 % at 2000 m. At B it rises by one per cent of itself from 1200 to 1400 m, so that strict monotony is missed there.",
    ),
    (
        Finding::Reproduced,
        "Appendix A.2, no difference from 1400 m on",
        "At the paper's receiver A1 the largest late displacement is 5.6e-4 m at 1400 m and 5.3e-4 m at 2000 m. The mean echo of all receivers still falls from 5.7 to 4.5 %.",
    ),
    (
        Finding::Reproduced,
        "Appendix A.2, plateau from 800 m on",
        "With the published transfer (profile paper) the mean echo is 9.2, 8.4, 8.1, 7.9, 7.9 % at 600, 800, 1000, 1400, 2000 m. Without it, on frozen points, there is no plateau: from 800 to 1400 m the mean late displacement at A1 falls from 4.0e-4 to 1.6e-4 m, and the mean echo from 14.6 to 5.7 %.",
    ),
    (
        Finding::Differs,
        "Appendix A.2, thickness as the remedy",
        "A true layer of 200 m leaves 0.6 % where the published one leaves 83 % at 200 m and 4.5 % at 2000 m.",
    ),
    (
        Finding::Reproduced,
        "Appendix A.3, beta = 1",
        "Mean echo 9.4, 12.7, 12.2, 13.1 % at beta = 1, 2, 3, 4: a linear profile is best, and the trend is weak.",
    ),
    (
        Finding::Reproduced,
        "Appendix A.3, alpha/L kept: weaker is worse up to alpha = 2.4",
        "Mean echo 92 and 47 % at alpha = 0.8 and 1.6 where alpha = 4 has 83 and 40 % at the same thickness; at 2.4 they are level (24 and 25 %).",
    ),
    (
        Finding::Reproduced,
        "Appendix A.3, no change from alpha = 3.2 on",
        "With the published transfer 7.9 to 8.1 % from 3.2 to 8. On frozen points the mean echo falls from 16.8 % at 3.2 to 6.5 % at 5.6, and then stays between 5.8 and 6.5 %.",
    ),
    (
        Finding::Reproduced,
        "Appendix A.4, relaxed modulus",
        "Without memory, E0 = 0.999 E, 0.99 E: 9.7, 9.6, 9.4 %; 0.9 E: 7.6 %. It hardly matters.",
    ),
    (
        Finding::Reproduced,
        "Appendix A.4, Rayleigh damping",
        "Mean echo 87, 65, 23, 13, 9.4 % at alpha_M = 0, 0.1, 0.5, 0.8, 1 per second; 93 % without memory as well: what absorbs is this term. With the published transfer 8.4, 8.2, 7.8, 7.9, 8.1 %: there it is the transfer that absorbs.",
    ),
    (
        Finding::UnderSpecified,
        "Appendix A.2, receiver A1",
        "Printed at (2525, 65) here and at (1525, 65) in section 3.1; the latter is used. What is drawn is the magnitude's mean and range, less the reference's mean, whose range is the band.",
    ),
];
