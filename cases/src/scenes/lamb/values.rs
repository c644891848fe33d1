//! Lamb's problem as data: its values, and what profiles, presets and methods change.

use crate::scene::Overlay;

/// The scene's values: material of the point source, the receivers of its independent reference.
pub(super) const VALUES: &str = r#"
basis = "linear"
t1_s = 2.0
target = { x_min_m = -100.0, x_max_m = 1000.0, depth_m = 700.0 }
grid = { h_m = 10.0 }
time = { scheme = "newmark", end_s = 3.0 }
points = { mode = "frozen", transfer = "keep", per_cell = 4 }
solver = { rel_tol = 1e-10, kind = "auto" }
material = { E_Pa = 2e9, nu = 0.25, rho_kg_m3 = 2000.0 }
receivers = [
  { name = "R1", x_m = 500.0, y_m = 0.0 },
  { name = "R2", x_m = 300.0, y_m = -100.0 },
  { name = "R3", x_m = 900.0, y_m = -300.0 },
  { name = "R4", x_m = 0.0, y_m = -600.0 },
]

[source]
x_m = 0.0
y_m = 0.0
direction = "vertical"
wavelet = "ricker"
frequency_Hz = 3.0
amplitude_N_m = 1.0
t0_s = 0.5

[boundary]
left = { method = "extended" }
right = { method = "extended" }
bottom = { method = "extended" }
top = { method = "free" }
"#;

/// Discretisation, point mode, duration.
pub(super) const PROFILES: &[Overlay] = &[
    Overlay::new(
        "gate",
        "cells of 10 m, frozen points, three near receivers, 1.6 s",
        "t1_s = 1.0
        time.end_s = 1.6
        target = { x_min_m = -100.0, x_max_m = 400.0, depth_m = 400.0 }
        receivers = [
          { name = 'R1', x_m = 300.0, y_m = 0.0 },
          { name = 'R2', x_m = 200.0, y_m = -100.0 },
          { name = 'R3', x_m = 0.0, y_m = -300.0 },
        ]",
    ),
    Overlay::new("quick", "cells of 10 m, frozen points, 3 s", ""),
    Overlay::new(
        "paper",
        "cells of 5 m, frozen points, half the step, 3 s: the target holds",
        // At 0.0005 s per metre the trapezoidal rule alone takes 0.9 % at R3, and the target is missed.
        "grid.h_m = 5.0
        time.dt_s = 0.00125",
    ),
];

/// Other loads, and points that carry the motion.
pub(super) const PRESETS: &[Overlay] = &[
    Overlay::new(
        "horizontal",
        "the force acts to the right",
        "source.direction = 'horizontal'",
    ),
    Overlay::new(
        "bspline",
        "quadratic B-splines with consistent masses, which hardly disperse",
        "basis = 'bspline'
        time.mass = 'consistent'",
    ),
    Overlay::new(
        "moving-affine",
        "points move and carry the motion with its gradient",
        "points = { mode = 'moving', transfer = 'affine' }",
    ),
    Overlay::new(
        "moving-flip",
        "points move and carry the motion as published; reported, not judged",
        "points = { mode = 'moving', transfer = 'flip' }",
    ),
];

/// The same method with the same parameters on the three sides that end the half-space.
macro_rules! around {
    ($side:literal) => {
        concat!(
            "boundary.left = ",
            $side,
            "\nboundary.right = ",
            $side,
            "\nboundary.bottom = ",
            $side
        )
    };
}

/// Boundary methods.
pub(super) const METHODS: &[Overlay] = &[
    Overlay::new(
        "fixed",
        "fixed at the target's edge: everything comes back",
        around!("{ method = 'fixed' }"),
    ),
    Overlay::new(
        "dashpot",
        "viscous tractions on the target's edge",
        around!("{ method = 'dashpot' }"),
    ),
    Overlay::new(
        "damping-layer",
        "500 m whose damping grows to 12/s",
        around!("{ method = 'damping-layer', thickness_m = 500.0 }"),
    ),
    Overlay::new(
        "pml",
        "true perfectly matched layer of 10 cells",
        around!("{ method = 'pml' }"),
    ),
    Overlay::new(
        "extended",
        "so much elastic material that nothing comes back: the solver against Lamb",
        around!("{ method = 'extended' }"),
    ),
];
