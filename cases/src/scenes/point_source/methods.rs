//! Boundary methods of the point source, and the published layer taken apart.

use crate::scene::Overlay;

/// The same method with the same parameters on the three absorbing sides, and other values beside.
macro_rules! around {
    ($side:literal $(, $others:literal)?) => {
        concat!(
            $($others, "\n",)?
            "boundary.left = ",
            $side,
            "\nboundary.right = ",
            $side,
            "\nboundary.bottom = ",
            $side
        )
    };
}

/// A variant whose nodes keep their motion (frozen points).
macro_rules! kept {
    ($name:literal, $summary:literal, $side:literal) => {
        Overlay::new(
            $name,
            $summary,
            around!($side, "points = { mode = 'frozen', transfer = 'keep' }"),
        )
    };
}

/// A variant whose points carry the motion as published; whether they move is the profile's choice.
macro_rules! flip {
    ($name:literal, $summary:literal, $side:literal) => {
        Overlay::new($name, $summary, around!($side, "points.transfer = 'flip'"))
    };
}

/// Boundary methods.
pub(super) const METHODS: &[Overlay] = &[
    Overlay::new(
        "fixed",
        "standard run: 1000 m of elastic material, fixed at its outer edge",
        around!("{ method = 'extended', thickness_m = 1000.0 }"),
    ),
    Overlay::new(
        "fixed-at-target",
        "fixed at the target's own edge",
        around!("{ method = 'fixed' }"),
    )
    .on_request(),
    Overlay::new(
        "dashpot",
        "viscous tractions on the target's edge",
        around!("{ method = 'dashpot' }"),
    ),
    Overlay::new(
        "damping-layer",
        "1000 m whose damping grows to 12/s",
        around!("{ method = 'damping-layer', thickness_m = 1000.0 }"),
    ),
    Overlay::new(
        "pml-stretched",
        "the published layer of absorbing particles, 1000 m",
        around!("{ method = 'pml-stretched', thickness_m = 1000.0 }"),
    ),
    Overlay::new(
        "pml",
        "true perfectly matched layer of 10 cells",
        around!("{ method = 'pml' }"),
    ),
    Overlay::new(
        "pml-20",
        "the same of 400 m: 20 cells of 20 m",
        around!("{ method = 'pml', thickness_m = 400.0 }"),
    ),
    Overlay::new(
        "pml-50",
        "the same of 1000 m: 50 cells of 20 m",
        around!("{ method = 'pml', thickness_m = 1000.0 }"),
    ),
    Overlay::new(
        "pml-static",
        "10 cells that give way under a load that stays on",
        around!("{ method = 'pml', static_load = 'follow' }"),
    )
    .on_request(),
    Overlay::new(
        "pml-20-static",
        "the same of 400 m",
        around!("{ method = 'pml', thickness_m = 400.0, static_load = 'follow' }"),
    )
    .on_request(),
    Overlay::new(
        "extended",
        "so much elastic material that nothing comes back: what the certified reference is",
        around!("{ method = 'extended' }"),
    )
    .on_request(),
];

/// The published layer's parts, one by one, with kept nodes and with the published transfer.
pub(super) const ABLATION: &[Overlay] = &[
    kept!(
        "fixed/kept",
        "standard run, nodes keep their motion",
        "{ method = 'extended', thickness_m = 1000.0 }"
    ),
    kept!(
        "pml-stretched/kept",
        "the published layer",
        "{ method = 'pml-stretched', thickness_m = 1000.0 }"
    ),
    kept!(
        "pml-stretched/kept-no-stretch",
        "without its stretch",
        "{ method = 'pml-stretched', thickness_m = 1000.0, alpha = 0.0 }"
    ),
    kept!(
        "pml-stretched/kept-no-memory",
        "without its viscoelastic memory",
        "{ method = 'pml-stretched', thickness_m = 1000.0, relaxed_modulus_ratio = 1.0 }"
    ),
    kept!(
        "pml-stretched/kept-no-rayleigh",
        "without its Rayleigh damping",
        "{ method = 'pml-stretched', thickness_m = 1000.0, rayleigh_per_s = 0.0 }"
    ),
    kept!(
        "pml-stretched/kept-bare",
        "the stretch alone",
        "{ method = 'pml-stretched', thickness_m = 1000.0, rayleigh_per_s = 0.0, relaxed_modulus_ratio = 1.0 }"
    ),
    kept!(
        "pml/kept",
        "true perfectly matched layer of 10 cells",
        "{ method = 'pml' }"
    ),
    flip!(
        "fixed/flip",
        "standard run, published transfer",
        "{ method = 'extended', thickness_m = 1000.0 }"
    ),
    flip!(
        "pml-stretched/flip",
        "the published layer with the published transfer",
        "{ method = 'pml-stretched', thickness_m = 1000.0 }"
    ),
    flip!(
        "pml-stretched/flip-no-stretch",
        "without its stretch",
        "{ method = 'pml-stretched', thickness_m = 1000.0, alpha = 0.0 }"
    ),
    flip!(
        "pml-stretched/flip-no-memory",
        "without its viscoelastic memory",
        "{ method = 'pml-stretched', thickness_m = 1000.0, relaxed_modulus_ratio = 1.0 }"
    ),
    flip!(
        "pml-stretched/flip-no-rayleigh",
        "without its Rayleigh damping",
        "{ method = 'pml-stretched', thickness_m = 1000.0, rayleigh_per_s = 0.0 }"
    ),
    flip!(
        "pml-stretched/flip-bare",
        "the stretch, and displacements sent to nodes and back in every step",
        "{ method = 'pml-stretched', thickness_m = 1000.0, rayleigh_per_s = 0.0, relaxed_modulus_ratio = 1.0 }"
    ),
    flip!(
        "pml-stretched/flip-bare-incremental",
        "the stretch alone: displacements by increments",
        "{ method = 'pml-stretched', thickness_m = 1000.0, rayleigh_per_s = 0.0, relaxed_modulus_ratio = 1.0, displacement = 'incremental' }"
    ),
    flip!(
        "pml/flip",
        "true perfectly matched layer of 10 cells, forced: it grows",
        "{ method = 'pml', with_flip = 'force' }"
    ),
];
