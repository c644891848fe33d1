//! The slide's values as data: the paper's, and what profiles, presets and methods change.

use crate::scene::Overlay;

/// The paper's values; gravity is (1 - 1000/1500) 9.81 m/s2.
pub(super) const PAPER: &str = r#"
basis = "bspline"
body = { width_m = 20.0, height_m = 10.0 }
grid = { h_m = 0.025 }
time = { scheme = "explicit", courant = 0.4, end_s = 1.0 }
points = { mode = "moving", transfer = "affine", per_cell = 16 }
flow = { update = "usl", pic_share = 0.0, volume = "cell" }
material = { E_Pa = 150e3, nu = 0.49, rho_kg_m3 = 1500.0, s_u0_Pa = 500.0, viscosity = 0.65, index = 0.4, reference_rate_1_s = 0.06 }
slide = { velocity_m_s = 6.0, gravity_m_s2 = 3.27 }
mudmat = { exposed_m = 1.0, length_m = 10.0, friction = 0.0, reach = 0.5 }
receivers = [{ name = "A", x_m = -8.0, y_m = 0.1 }, { name = "B", x_m = -2.5, y_m = 5.0 }]

[boundary]
left = { method = "inflow" }
right = { method = "free" }
bottom = { method = "roller" }
top = { method = "free" }
"#;

/// Discretisation, point mode, duration.
pub(super) const PROFILES: &[Overlay] = &[
    Overlay::new(
        "gate",
        "cells of e/10 with four points, to 0.6 s",
        "grid.h_m = 0.1
        points.per_cell = 4
        time.end_s = 0.6",
    ),
    Overlay::new(
        "quick",
        "cells of e/20 with four points, to 1 s",
        "grid.h_m = 0.05
        points.per_cell = 4",
    ),
    Overlay::new(
        "paper",
        "cells of e/40 with 4 x 4 points: 5.1 million, to 1 s",
        "",
    ),
];

/// Other slides.
pub(super) const PRESETS: &[Overlay] = &[
    Overlay::new("long", "a slide of 50 m", "body.width_m = 50.0"),
    Overlay::new(
        "weightless",
        "without weight and its stress",
        "slide.gravity_m_s2 = 0.0",
    ),
];

/// Boundary methods: what the left end and the top are made of.
pub(super) const METHODS: &[Overlay] = &[
    Overlay::new(
        "none",
        "inflow on the left, free top: everything comes back",
        "boundary.left.method = 'inflow'
        boundary.top.method = 'free'",
    ),
    Overlay::new(
        "damping-layer",
        "S21's layer of the 10 m before the inflow, alpha = 0.005 a step",
        "boundary.left = { method = 'damping-layer', placement = 'inside', thickness_m = 10.0, form = 'printed', alpha_per_m = 0.005, end = 'inflow' }
        boundary.top.method = 'free'",
    ),
    Overlay::new(
        "dashpot",
        "viscous tractions on the free top",
        "boundary.left.method = 'inflow'
        boundary.top.method = 'dashpot'",
    ),
    Overlay::new(
        "hybrid",
        "layer on the left, dashpot on the top",
        "boundary.left = { method = 'damping-layer', placement = 'inside', thickness_m = 10.0, form = 'printed', alpha_per_m = 0.005, end = 'inflow' }
        boundary.top.method = 'dashpot'",
    ),
    Overlay::new(
        "hybrid-rate",
        "the same with a layer that damps by its rate, whatever the step",
        "boundary.left = { method = 'damping-layer', placement = 'inside', thickness_m = 10.0, form = 'rate', sigma_max_per_s = 100.0, power = 2.0, end = 'inflow' }
        boundary.top.method = 'dashpot'",
    ),
    Overlay::new(
        "pml",
        "the true layer before the slide's end, ten cells that move along; free top",
        "boundary.left.method = 'pml'
        boundary.top.method = 'free'",
    ),
    Overlay::new(
        "pml-dashpot",
        "the true layer on the left, dashpot on the top",
        "boundary.left.method = 'pml'
        boundary.top.method = 'dashpot'",
    ),
    Overlay::new(
        "extended",
        "the slide goes on so far, 50 m, that its end is not heard before 1.05 s; free top",
        "boundary.left = { method = 'extended', thickness_m = 30.0 }
        boundary.top.method = 'free'",
    ),
    Overlay::new(
        "extended-dashpot",
        "the same with the dashpot on the top",
        "boundary.left = { method = 'extended', thickness_m = 30.0 }
        boundary.top.method = 'dashpot'",
    ),
];
