//! Small problems in three dimensions.

use crate::half_space;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::probe::{Probes, Receiver};
use anechoic_solver::problem::{
    Aabb, Drive, FlowSetup, PointMode, Problem, Scheme, SolverKind, Transfer,
};
use anechoic_solver::wavelet::{Pulse, Wavelet};

/// Edge of a cell (m).
pub const CELL: f64 = 20.0;

/// Share of the time of a compressional wave through a cell that a step of [`quarter`] takes.
pub const COURANT: f64 = 0.55;

/// A quarter of a block of ground with so many cells along each edge, explicit steps, frozen points: planes
/// of symmetry at x = 0 and z = 0, a free surface y = 0 with a Ricker wavelet of 3 Hz in their corner, `layer`
/// on the three other sides. The material is that of [`half_space`].
pub fn quarter(cells: usize, layer: SideMethod) -> Problem<3> {
    let plane = half_space(layer.clone(), PointMode::Frozen, Transfer::Keep);
    let size = cells as f64 * CELL;
    let roller = || SideMethod::new("roller");
    Problem {
        target: Aabb {
            lower: [0.0, -size, 0.0],
            upper: [size, 0.0, size],
        },
        cell_size: CELL,
        aspect: 1.0,
        face_gap: None,
        inclusion: None,
        basis: plane.basis,
        scheme: Scheme::Explicit,
        mass: plane.mass,
        dt: COURANT * CELL / plane.material.p_speed(),
        end_time: 1.5,
        point_mode: PointMode::Frozen,
        transfer: Transfer::Keep,
        points_per_cell: 8,
        material: plane.material,
        flow: FlowSetup::default(),
        sides: [
            [roller(), layer.clone()],
            [layer.clone(), SideMethod::new("free")],
            [roller(), layer],
        ],
        drives: vec![force([0.0; 3], [0.0, -1.0, 0.0], 1e6)],
        probes: Probes {
            receivers: receivers(size),
            ..Probes::default()
        },
        solver: SolverKind::Auto,
        rel_tol: 1e-12,
    }
}

/// A Ricker wavelet of 3 Hz, centred at 0.4 s, of so many newtons.
pub fn force(place: [f64; 3], direction: [f64; 3], amplitude: f64) -> Drive<3> {
    Drive::PointForce {
        place,
        direction,
        pulse: Pulse {
            wavelet: Wavelet::Ricker,
            amplitude,
            frequency: 3.0,
            t0: 0.4,
        },
    }
}

/// On the surface, down the axis, and on the diagonals of faces and of the block.
fn receivers(size: f64) -> Vec<Receiver<3>> {
    let at = |name: &str, share: [f64; 3]| Receiver {
        name: name.into(),
        place: share.map(|s| s * size),
    };
    vec![
        at("A1", [0.5, 0.0, 0.0]),
        at("A2", [0.9, 0.0, 0.0]),
        at("A3", [0.9, 0.0, 0.9]),
        at("B1", [0.0, -0.5, 0.0]),
        at("B2", [0.0, -0.9, 0.0]),
        at("C1", [0.5, -0.5, 0.5]),
        at("C2", [0.9, -0.9, 0.9]),
    ]
}
