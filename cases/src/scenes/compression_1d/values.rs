//! The column's values as data: the paper's, and what profiles, presets and methods change.

use crate::field::{Field, Kind, Range};
use crate::scene::Overlay;

/// The paper's values.
pub(super) const PAPER: &str = r#"
basis = "linear"
body = { width_m = 50.0, height_m = 50.0 }
grid = { h_m = 1.0 }
time = { scheme = "newmark", end_s = 5.0 }
points = { mode = "moving", transfer = "affine", per_cell = 4 }
solver = { rel_tol = 1e-10, kind = "auto" }
material = { E_Pa = 150e3, nu = 0.49, rho_kg_m3 = 650.0 }
source = { wavelet = "half-sine", amplitude_m_s = 1.0, frequency_Hz = 1.0 }
receivers = [{ name = "A", x_m = 25.0, y_m = 50.0 }, { name = "B", x_m = 25.0, y_m = 5.0 }]

[boundary]
left = { method = "roller" }
right = { method = "roller" }
bottom = { method = "roller" }
top = { method = "free" }
"#;

/// Fields of the source.
pub(super) const SOURCE: &[Field] = &[
    Field::new(
        "source.wavelet",
        Kind::Word(&["half-sine", "sine-squared", "sine"]),
        "shape of the top's velocity",
    ),
    Field::new(
        "source.amplitude_m_s",
        Kind::Number(Range::POSITIVE),
        "largest velocity of the top, downward (m/s)",
    ),
    Field::new(
        "source.frequency_Hz",
        Kind::Number(Range::POSITIVE),
        "its frequency f; half-sine and sine-squared last 1/(2f) (Hz)",
    ),
];

/// Discretisation, point mode, duration.
pub(super) const PROFILES: &[Overlay] = &[
    Overlay::new(
        "gate",
        "as quick, to 4 s",
        "points = { mode = 'frozen', transfer = 'keep' }
        source.amplitude_m_s = 1e-3
        time.end_s = 4.0",
    ),
    Overlay::new(
        "quick",
        "frozen points, amplitude 1e-3 m/s: the targets hold",
        "points = { mode = 'frozen', transfer = 'keep' }
        source.amplitude_m_s = 1e-3",
    ),
    Overlay::new("paper", "moving points, amplitude 1 m/s as printed", ""),
];

/// Other readings and loads.
pub(super) const PRESETS: &[Overlay] = &[
    Overlay::new(
        "linear",
        "amplitude 1e-3 m/s, at which d'Alembert holds",
        "source.amplitude_m_s = 1e-3",
    ),
    Overlay::new(
        "explicit",
        "leapfrog with S21's step, 0.4 of the time through a cell",
        "time.scheme = 'explicit'",
    ),
    Overlay::new(
        "printed",
        "Poisson's ratio 0.3 as printed: 17.6 m/s",
        "material.nu = 0.3",
    ),
];

/// Boundary methods: what the base is made of.
pub(super) const METHODS: &[Overlay] = &[
    Overlay::new(
        "fixed",
        "base on rollers: everything comes back",
        "boundary.bottom.method = 'roller'",
    ),
    Overlay::new(
        "dashpot",
        "viscous traction rho c_p on the base",
        "boundary.bottom.method = 'dashpot'",
    ),
    Overlay::new(
        "damping-layer",
        "the lowest 10 m are damped",
        "[boundary.bottom]
        method = 'damping-layer'
        placement = 'inside'
        thickness_m = 10.0
        power = 1.0
        sigma_max_per_s = 15.7
        end = 'free'",
    ),
    Overlay::new(
        "pml",
        "20 m of perfectly matched layer below the base: 20 cells at 1 m",
        "[boundary.bottom]
        method = 'pml'
        thickness_m = 20.0",
    ),
    Overlay::new(
        "extended",
        "the column goes on below the base",
        "boundary.bottom.method = 'extended'",
    ),
];
