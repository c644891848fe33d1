//! The cube's values as data: the whole scene, and what profiles, presets and methods change.

use crate::field::{Field, Kind, Range};
use crate::scene::Overlay;

/// All values, as the profile `paper` runs them.
pub(super) const WHOLE: &str = r#"
basis = "linear"
t1_s = 0.8
target = { size_m = 400.0 }
grid = { h_m = 20.0 }
time = { scheme = "explicit", end_s = 1.8 }
points = { mode = "moving", transfer = "affine", per_cell = 8 }
solver = { rel_tol = 1e-10, kind = "auto" }
material = { E_Pa = 2e9, nu = 0.25, rho_kg_m3 = 2000.0 }
source = { wavelet = "ricker", frequency_Hz = 3.0, amplitude_N = 4e6, t0_s = 0.4 }
receivers = [
  { name = "A1", x_m = 205.0, y_m = 0.0, z_m = 0.0 },
  { name = "A2", x_m = 365.0, y_m = 0.0, z_m = 0.0 },
  { name = "A3", x_m = 205.0, y_m = 0.0, z_m = 205.0 },
  { name = "A4", x_m = 365.0, y_m = 0.0, z_m = 365.0 },
  { name = "B1", x_m = 0.0, y_m = -205.0, z_m = 0.0 },
  { name = "B2", x_m = 0.0, y_m = -365.0, z_m = 0.0 },
  { name = "C1", x_m = 205.0, y_m = -205.0, z_m = 205.0 },
  { name = "C2", x_m = 365.0, y_m = -365.0, z_m = 365.0 },
]

[boundary]
left = { method = "roller" }
back = { method = "roller" }
top = { method = "free" }
right = { method = "pml", thickness_m = 160.0, reflection = 0.01 }
front = { method = "pml", thickness_m = 160.0, reflection = 0.01 }
bottom = { method = "pml", thickness_m = 160.0, reflection = 0.01 }
"#;

/// Discretisation, point mode, duration.
pub(super) const PROFILES: &[Overlay] = &[
    Overlay::new(
        "gate",
        "10 cells along each edge to 1.2 s, echoes from 0.6 s on, frozen points",
        "t1_s = 0.6
        time.end_s = 1.2
        points = { mode = 'frozen', transfer = 'keep' }
        target = { size_m = 200.0 }
        receivers = [
          { name = 'A1', x_m = 105.0, y_m = 0.0, z_m = 0.0 },
          { name = 'A2', x_m = 185.0, y_m = 0.0, z_m = 185.0 },
          { name = 'B1', x_m = 0.0, y_m = -105.0, z_m = 0.0 },
          { name = 'B2', x_m = 0.0, y_m = -185.0, z_m = 0.0 },
          { name = 'C1', x_m = 105.0, y_m = -105.0, z_m = 105.0 },
          { name = 'C2', x_m = 185.0, y_m = -185.0, z_m = 185.0 },
        ]",
    ),
    Overlay::new(
        "quick",
        "20 cells along each edge, frozen points: the targets hold",
        "points = { mode = 'frozen', transfer = 'keep' }",
    ),
    Overlay::new("paper", "moving points, affine transfer", ""),
];

/// Other schemes.
pub(super) const PRESETS: &[Overlay] = &[Overlay::new(
    "implicit",
    "Newmark's steps of 0.01 s",
    "time.scheme = 'newmark'",
)];

/// The same method with the same parameters on the three outer sides.
macro_rules! around {
    ($side:literal) => {
        concat!(
            "boundary.right = ",
            $side,
            "\nboundary.front = ",
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
        "standard run: 160 m of elastic material, fixed at its outer edge",
        around!("{ method = 'extended', thickness_m = 160.0 }"),
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
        "160 m whose damping grows outward",
        around!("{ method = 'damping-layer', thickness_m = 160.0 }"),
    ),
    Overlay::new(
        "pml",
        "true perfectly matched layer of 160 m: 8 cells of 20 m",
        around!("{ method = 'pml', thickness_m = 160.0, reflection = 0.01 }"),
    ),
    Overlay::new(
        "extended",
        "so much elastic material that nothing comes back: what the certified reference is",
        around!("{ method = 'extended' }"),
    )
    .on_request(),
];

/// Its own fields.
pub(super) const FIELDS: &[Field] = &[
    Field::new(
        "t1_s",
        Kind::Number(Range::within(0.0, f64::INFINITY)),
        "from when on echoes are looked for (s)",
    ),
    Field::new(
        "target.size_m",
        Kind::Number(Range::POSITIVE),
        "edges of the quarter of a block of ground, 0 to size along x and z, -size to 0 along y (m)",
    ),
    Field::new(
        "source.wavelet",
        Kind::Word(&["sine", "half-sine", "sine-squared", "ricker", "step"]),
        "shape of the force over time",
    ),
    Field::new(
        "source.frequency_Hz",
        Kind::Number(Range::POSITIVE),
        "its frequency f; sine lasts 1/f, half-sine and sine-squared 1/(2f), in which step rises (Hz)",
    ),
    Field::new(
        "source.amplitude_N",
        Kind::Number(Range::POSITIVE),
        "largest force on the whole ground, downward; a quarter of it acts on the quarter (N)",
    ),
    Field::new(
        "source.t0_s",
        Kind::Number(Range::POSITIVE),
        "centre of the Ricker wavelet, which lasts 2 t0 (s)",
    ),
];
