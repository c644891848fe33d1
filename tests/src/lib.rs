//! What the gates share: small problems with a monitor that lets them run, comparisons through the
//! library ([`study`]), the program as it is typed ([`program`]), operators as dense matrices ([`dense`]),
//! explicit steps ([`explicit`]).

pub mod dense;
pub mod explicit;
pub mod program;
pub mod space;
pub mod study;

pub mod twin;
mod twin_shift;

use anechoic_solver::Monitor;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::flow::{Dimension, Space};
use anechoic_solver::probe::{Probes, Receiver};
use anechoic_solver::problem::{
    Aabb, BasisKind, Drive, Elastic, FlowSetup, MassKind, PointMode, Problem, Scheme, Side,
    SolverKind, Transfer,
};
use anechoic_solver::record::Record;
use anechoic_solver::wavelet::{Pulse, Wavelet};

/// All bases with all masses.
pub const KINDS: [(BasisKind, MassKind); 6] = [
    (BasisKind::Linear, MassKind::Lumped),
    (BasisKind::Linear, MassKind::Consistent),
    (BasisKind::Gimp, MassKind::Lumped),
    (BasisKind::Gimp, MassKind::Consistent),
    (BasisKind::Bspline, MassKind::Lumped),
    (BasisKind::Bspline, MassKind::Consistent),
];

/// Thickness (m) of [`ten_cells`].
pub const DEPTH: f64 = 200.0;

/// Reflection that [`ten_cells`] aims at.
pub const REFLECTION: f64 = 1e-4;

/// The true layer of ten cells of 20 m.
pub fn ten_cells() -> SideMethod {
    SideMethod::new("pml")
        .with("thickness_m", DEPTH)
        .with("reflection", REFLECTION)
}

/// Lets every step pass.
#[derive(Debug)]
pub struct Unwatched;

impl Monitor for Unwatched {
    fn step(&self, _done: usize, _total: usize) -> bool {
        true
    }
}

/// Solves and insists on success.
///
/// # Panics
/// When the problem cannot be set up or the run fails.
pub fn solved<const D: usize>(problem: &Problem<D>) -> Record
where
    Space: Dimension<D>,
{
    let outcome = anechoic_solver::solve(problem, &Unwatched).expect("the problem is well put");
    assert_eq!(outcome.error, None);
    outcome.record
}

/// A block of 4 x 3 m, free all round, linear elastic with all wave speeds of a few m/s.
pub fn block(transfer: Transfer, point_mode: PointMode) -> Problem<2> {
    let free = || SideMethod::new("free");
    Problem {
        target: Aabb {
            lower: [0.0, 0.0],
            upper: [4.0, 3.0],
        },
        cell_size: 0.5,
        aspect: 1.0,
        face_gap: None,
        inclusion: None,
        basis: BasisKind::Linear,
        scheme: Scheme::Newmark,
        mass: MassKind::Lumped,
        dt: 0.02,
        end_time: 4.0,
        point_mode,
        transfer,
        points_per_cell: 4,
        material: Elastic {
            youngs_modulus: 10.0,
            poissons_ratio: 0.3,
            density: 2.0,
        },
        flow: FlowSetup::default(),
        sides: [[free(), free()], [free(), free()]],
        drives: Vec::new(),
        probes: Probes {
            energy_every: Some(1),
            ..Probes::default()
        },
        solver: SolverKind::Auto,
        rel_tol: 1e-13,
    }
}

/// A column of compression-1d's material, one cell wide per metre of `width`, pushed from its top by
/// a sin^2 pulse of 0.5 s and 1 mm/s; base as given.
pub fn column(h: f64, base: SideMethod) -> Problem<2> {
    Problem {
        target: Aabb {
            lower: [0.0, 0.0],
            upper: [4.0 * h, 50.0],
        },
        cell_size: h,
        aspect: 1.0,
        face_gap: None,
        inclusion: None,
        dt: 0.005 * h,
        end_time: 3.0,
        material: Elastic {
            youngs_modulus: 150e3,
            poissons_ratio: 0.49,
            density: 650.0,
        },
        sides: [
            [SideMethod::new("roller"), SideMethod::new("roller")],
            [base, SideMethod::new("free")],
        ],
        drives: vec![Drive::SideVelocity {
            side: Side::TOP,
            pulse: Pulse {
                wavelet: Wavelet::SineSquared,
                amplitude: -1e-3,
                frequency: 1.0,
                t0: 0.0,
            },
        }],
        probes: Probes {
            receivers: vec![Receiver {
                name: "A".into(),
                place: [2.0 * h, 50.0],
            }],
            energy_every: Some(1),
            ..Probes::default()
        },
        rel_tol: 1e-10,
        ..block(Transfer::Keep, PointMode::Frozen)
    }
}

/// Where the receivers of [`half_space`] are: two at the surface, two below.
pub const PLACES: [(&str, [f64; 2]); 4] = [
    ("A1", [300.0, -20.0]),
    ("A2", [700.0, -20.0]),
    ("B1", [150.0, -500.0]),
    ("C1", [700.0, -500.0]),
];

/// A small point source: 800 x 600 m of the half-space of K25 3.1, cells of 20 m, a full sine of
/// 2 Hz at (150, 0), the same method left, right and below.
pub fn half_space(layer: SideMethod, point_mode: PointMode, transfer: Transfer) -> Problem<2> {
    Problem {
        target: Aabb {
            lower: [0.0, -600.0],
            upper: [800.0, 0.0],
        },
        cell_size: 20.0,
        aspect: 1.0,
        face_gap: None,
        inclusion: None,
        dt: 0.01,
        end_time: 3.0,
        material: Elastic {
            youngs_modulus: 2e9,
            poissons_ratio: 0.25,
            density: 2000.0,
        },
        sides: [
            [layer.clone(), layer.clone()],
            [layer, SideMethod::new("free")],
        ],
        drives: vec![Drive::PointForce {
            place: [150.0, 0.0],
            direction: [0.0, -1.0],
            pulse: Pulse {
                wavelet: Wavelet::Sine,
                amplitude: 1e6,
                frequency: 2.0,
                t0: 0.0,
            },
        }],
        probes: Probes {
            receivers: PLACES
                .iter()
                .map(|(name, place)| Receiver {
                    name: (*name).into(),
                    place: *place,
                })
                .collect(),
            energy_every: Some(1),
            ..Probes::default()
        },
        rel_tol: 1e-10,
        ..block(transfer, point_mode)
    }
}

/// Largest difference of a run's displacement vector from another's over the largest of the latter,
/// the worst of all receivers.
///
/// # Panics
/// When a record lacks a receiver.
pub fn worst_echo(record: &Record, reference: &Record) -> f64 {
    let column = |record: &Record, name: String| -> Vec<f64> {
        record
            .receivers
            .column(&name)
            .expect("a receiver of the problem")
            .to_vec()
    };
    let largest = |x: &[f64], y: &[f64]| {
        x.iter()
            .zip(y)
            .map(|(x, y)| x.hypot(*y))
            .fold(0.0, f64::max)
    };
    PLACES
        .iter()
        .map(|(name, _)| {
            let [mx, my] = ["ux", "uy"].map(|c| column(record, format!("{name}_{c}")));
            let [rx, ry] = ["ux", "uy"].map(|c| column(reference, format!("{name}_{c}")));
            let minus = |a: &[f64], b: &[f64]| -> Vec<f64> {
                a.iter().zip(b).map(|(a, b)| a - b).collect()
            };
            largest(&minus(&mx, &rx), &minus(&my, &ry)) / largest(&rx, &ry)
        })
        .fold(0.0, f64::max)
}
