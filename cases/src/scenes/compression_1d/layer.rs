//! The damping layer of S21, Eqs (6)-(7), as printed: its strength and thickness, and what its damping by
//! the step makes of shorter steps.

use crate::sweep::named::{NamedPart, NamedSweep};
use anechoic_reports::study::Finding;

/// The sweep.
pub(super) static S21_LAYER: NamedSweep = NamedSweep {
    name: "s21-layer",
    summary: "strength, thickness and time step of the printed damping layer (S21, Eqs 6-7)",
    presets: &["explicit"],
    methods: |_| &["damping-layer"],
    parts: PARTS,
    ledger: LEDGER,
};

const PARTS: &[NamedPart] = &[
    NamedPart {
        name: "window",
        title: "thickness B and strength alpha, as printed",
        axis: "B (m) x alpha (1/m)",
        over: &[
            "damping-layer.form=printed",
            "damping-layer.thickness_m=5,7.5,10,15",
            "damping-layer.alpha_per_m=0.001,0.003,0.005,0.01,0.015,0.03",
        ],
        names: &[],
        falls: None,
    },
    NamedPart {
        name: "step",
        title: "time step: Courant numbers 0.8, 0.4, 0.2, 0.1, as printed and as a rate",
        axis: "time step (s)",
        over: &[
            "damping-layer.form=printed,rate",
            "time.dt_s=0.0127,0.00636,0.00318,0.00159",
        ],
        names: &[],
        falls: None,
    },
];

/// Finding, place, note.
const LEDGER: &[(Finding, &str, &str)] = &[
    (
        Finding::Reproduced,
        "section 4, strength between 0.003 and 0.015",
        "At S21's own step the least echo lies inside: 0.19 at alpha = 0.015 for B = 7.5 m, 0.25 at 0.01 for 10 m, 0.27 at 0.005 for 15 m, and it rises to either side (10 m: 1.20 at 0.001, 0.42 at 0.03). 5 m would need more than 0.03.",
    ),
    (
        Finding::Differs,
        "Eqs (6)-(7), any time step",
        "The printed factor damps by the step: alpha = 0.01 over 10 m leaves 0.31, 0.25, 0.43, 0.57 at A at Courant numbers 0.8, 0.4, 0.2, 0.1; as a rate of 15.7/s it leaves 0.23 at all of them. The window holds for one step.",
    ),
];
