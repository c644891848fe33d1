//! The point source's values as data: the paper's, and what profiles, presets and methods change.

use crate::scene::Overlay;

/// The paper's values, reading `receivers` of its geometry, Test 1.
pub(super) const PAPER: &str = r#"
basis = "linear"
t1_s = 5.0
target = { x_min_m = 1000.0, x_max_m = 3000.0, depth_m = 2000.0 }
grid = { h_m = 20.0 }
time = { scheme = "newmark", dt_s = 0.01, end_s = 10.0 }
points = { mode = "moving", transfer = "affine", per_cell = 4 }
solver = { rel_tol = 1e-10, kind = "auto" }
material = { E_Pa = 2e9, nu = 0.25, rho_kg_m3 = 2000.0 }
receivers = [
  { name = "A1", x_m = 1525.0, y_m = -65.0 },
  { name = "A2", x_m = 1805.0, y_m = -65.0 },
  { name = "A3", x_m = 2205.0, y_m = -65.0 },
  { name = "A4", x_m = 2795.0, y_m = -65.0 },
  { name = "B1", x_m = 1125.0, y_m = -575.0 },
  { name = "B2", x_m = 1125.0, y_m = -805.0 },
  { name = "B3", x_m = 1125.0, y_m = -1205.0 },
  { name = "B4", x_m = 1125.0, y_m = -1795.0 },
  { name = "C1", x_m = 1725.0, y_m = -725.0 },
  { name = "C2", x_m = 2105.0, y_m = -1105.0 },
  { name = "C3", x_m = 2865.0, y_m = -1865.0 },
]

[source]
x_m = 1120.0
y_m = 0.0
direction = "vertical"
wavelet = "sine"
frequency_Hz = 2.0
amplitude_N_m = 1e6
t0_s = 0.5

[boundary]
left = { method = "pml" }
right = { method = "pml" }
bottom = { method = "pml" }
top = { method = "free" }
"#;

/// Discretisation, point mode, duration.
pub(super) const PROFILES: &[Overlay] = &[
    Overlay::new(
        "gate",
        "a quarter of the target to 5 s, echoes from 2.5 s on, frozen points",
        "t1_s = 2.5
        time.end_s = 5.0
        points = { mode = 'frozen', transfer = 'keep' }
        target = { x_min_m = 1000.0, x_max_m = 2000.0, depth_m = 1000.0 }
        receivers = [
          { name = 'A1', x_m = 1325.0, y_m = -65.0 },
          { name = 'A2', x_m = 1795.0, y_m = -65.0 },
          { name = 'B1', x_m = 1125.0, y_m = -575.0 },
          { name = 'B2', x_m = 1125.0, y_m = -805.0 },
          { name = 'C1', x_m = 1725.0, y_m = -725.0 },
        ]",
    ),
    Overlay::new(
        "quick",
        "frozen points: the targets hold",
        "points = { mode = 'frozen', transfer = 'keep' }",
    ),
    Overlay::new("paper", "moving points, affine transfer", ""),
];

/// Other readings and loads.
pub(super) const PRESETS: &[Overlay] = &[
    Overlay::new(
        "test-1",
        "one full sine of 2 Hz, 1e6 N/m (the default)",
        "source = { wavelet = 'sine', frequency_Hz = 2.0, amplitude_N_m = 1e6 }",
    ),
    Overlay::new(
        "test-2",
        "the same, 100 times larger",
        "source = { wavelet = 'sine', frequency_Hz = 2.0, amplitude_N_m = 1e8 }",
    ),
    Overlay::new(
        "test-3",
        "Ricker wavelet of 3 Hz",
        "source = { wavelet = 'ricker', frequency_Hz = 3.0, amplitude_N_m = 1e6, t0_s = 0.5 }",
    ),
    Overlay::new(
        "half-sine",
        "half a sine of 2 Hz: a net impulse, whose slow tail drowns the paper's metric",
        "source = { wavelet = 'half-sine', frequency_Hz = 2.0, amplitude_N_m = 1e6 }",
    ),
    Overlay::new(
        "step",
        "a force that rises within 0.25 s and stays on, 10 s, frozen points: does the ground settle right?",
        "source = { wavelet = 'step', frequency_Hz = 2.0, amplitude_N_m = 1e6 }
        time.end_s = 10.0
        points = { mode = 'frozen', transfer = 'keep' }",
    ),
    Overlay::new(
        "explicit",
        "leapfrog, at 0.55 of the time through a cell",
        "time.scheme = 'explicit'",
    ),
    Overlay::new(
        "paper-transfer",
        "the paper's own transfer between points and nodes (flip), with its own layer",
        "points.transfer = 'flip'
        boundary.left = { method = 'pml-stretched', thickness_m = 1000.0 }
        boundary.right = { method = 'pml-stretched', thickness_m = 1000.0 }
        boundary.bottom = { method = 'pml-stretched', thickness_m = 1000.0 }",
    ),
    Overlay::new(
        "counts",
        "the geometry that has the paper's 20,000 + 60,000 points, with the receivers inside it",
        "target = { x_min_m = 1000.0, x_max_m = 3000.0, depth_m = 1000.0 }
        receivers = [
          { name = 'A1', x_m = 1525.0, y_m = -65.0 },
          { name = 'A2', x_m = 1805.0, y_m = -65.0 },
          { name = 'A3', x_m = 2205.0, y_m = -65.0 },
          { name = 'A4', x_m = 2795.0, y_m = -65.0 },
          { name = 'B1', x_m = 1125.0, y_m = -575.0 },
          { name = 'B2', x_m = 1125.0, y_m = -805.0 },
          { name = 'C1', x_m = 1725.0, y_m = -725.0 },
        ]",
    ),
];
