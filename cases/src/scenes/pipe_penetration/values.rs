//! The pipe's values as data: the paper's, and what profiles, presets and methods change.

use crate::scene::Overlay;

/// The paper's values.
pub(super) const PAPER: &str = r#"
basis = "bspline"
body = { width_m = 2.5, height_m = 2.5 }
grid = { h_m = 0.01 }
time = { scheme = "explicit", courant = 0.4 }
points = { mode = "moving", transfer = "affine", per_cell = 16 }
flow = { update = "usl", pic_share = 0.01, volume = "cell" }
material = { E_Pa = 1.25e6, nu = 0.49, rho_kg_m3 = 650.0, s_u_Pa = 2500.0 }
pipe = { diameter_m = 0.8, velocity_m_s = 5.0, depth = 0.5, friction = 0.0, reach = 0.5 }
receivers = [{ name = "R1", x_m = 0.0, y_m = -1.2 }, { name = "R2", x_m = 1.2, y_m = -1.2 }]

[boundary]
left = { method = "roller" }
right = { method = "roller" }
bottom = { method = "roller" }
top = { method = "free" }
"#;

/// Discretisation, point mode, duration.
pub(super) const PROFILES: &[Overlay] = &[
    Overlay::new(
        "gate",
        "cells of D/16 with four points, to w/D = 0.3",
        "grid.h_m = 0.05
        points.per_cell = 4
        pipe.depth = 0.3",
    ),
    Overlay::new(
        "quick",
        "cells of D/32 with four points",
        "grid.h_m = 0.025
        points.per_cell = 4",
    ),
    Overlay::new("paper", "cells of D/80 with 4 x 4 points: a million", ""),
];

/// Other loads.
pub(super) const PRESETS: &[Overlay] = &[
    Overlay::new("slow", "0.1 m/s: quasi-static", "pipe.velocity_m_s = 0.1"),
    Overlay::new(
        "slow-scaled",
        "the same with four times the density: half the steps",
        "pipe.velocity_m_s = 0.1
        material.rho_kg_m3 = 2600.0",
    ),
];

/// Boundary methods: what the right side and the base are made of.
pub(super) const METHODS: &[Overlay] = &[
    Overlay::new(
        "fixed",
        "rollers: everything comes back",
        "boundary.right.method = 'roller'
        boundary.bottom.method = 'roller'",
    ),
    Overlay::new(
        "dashpot",
        "viscous tractions rho c_p and rho c_s",
        "boundary.right.method = 'dashpot'
        boundary.bottom.method = 'dashpot'",
    ),
    Overlay::new(
        "damping-layer",
        "1 m of viscous layer beyond the soil, growing to 227/s: S21's alpha = 0.005 at its own step",
        "boundary.right = { method = 'damping-layer', thickness_m = 1.0, sigma_max_per_s = 227.0, power = 1.0, end = 'roller' }
        boundary.bottom = { method = 'damping-layer', thickness_m = 1.0, sigma_max_per_s = 227.0, power = 1.0, end = 'roller' }",
    ),
    Overlay::new(
        "damping-layer-thick",
        "4 m of it, growing with the square to 227/s, its end free: what the paper's 5 % takes",
        "boundary.right = { method = 'damping-layer', thickness_m = 4.0, sigma_max_per_s = 227.0, power = 2.0, end = 'free' }
        boundary.bottom = { method = 'damping-layer', thickness_m = 4.0, sigma_max_per_s = 227.0, power = 2.0, end = 'free' }",
    )
    .on_request(),
    Overlay::new(
        "damping-layer-printed",
        "the same as printed, alpha = 0.005 a step: as strong as steps are short",
        "boundary.right = { method = 'damping-layer', thickness_m = 1.0, form = 'printed', alpha_per_m = 0.005, end = 'roller' }
        boundary.bottom = { method = 'damping-layer', thickness_m = 1.0, form = 'printed', alpha_per_m = 0.005, end = 'roller' }",
    )
    .on_request(),
    Overlay::new(
        "pml",
        "perfectly matched layer of 0.5 m",
        "boundary.right = { method = 'pml', thickness_m = 0.5 }
        boundary.bottom = { method = 'pml', thickness_m = 0.5 }",
    ),
    Overlay::new(
        "extended",
        "the soil goes on so far, 7.75 m, that nothing comes back before w/D = 0.5",
        "boundary.right = { method = 'extended', thickness_m = 5.25 }
        boundary.bottom = { method = 'extended', thickness_m = 5.25 }",
    ),
];
