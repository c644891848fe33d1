//! Times of a step and its parts on the point source's mesh: 4000 x 3000 m, cells of 20 m, 120,000
//! points, one thread. `cargo bench -p anechoic-solver`.

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::linear::Moment;
use anechoic_solver::physics::model::Model;
use anechoic_solver::probe::Probes;
use anechoic_solver::problem::{
    Aabb, BasisKind, Drive, Elastic, MassKind, PointMode, Problem, Scheme, SolverKind, Transfer,
};
use anechoic_solver::setup;
use anechoic_solver::time::newmark::Newmark;
use anechoic_solver::time::{ForceScale, Integrator, Motion, Rates, System};
use anechoic_solver::wavelet::{Pulse, Wavelet};
use criterion::{Criterion, criterion_group, criterion_main};

const DT: f64 = 0.01;

fn problem(point_mode: PointMode, transfer: Transfer, layer: &str, thickness: f64) -> Problem<2> {
    let side = SideMethod::new(layer).with("thickness_m", thickness);
    Problem {
        target: Aabb {
            lower: [1000.0, -2000.0],
            upper: [3000.0, 0.0],
        },
        cell_size: 20.0,
        aspect: 1.0,
        face_gap: None,
        inclusion: None,
        basis: BasisKind::Linear,
        scheme: Scheme::Newmark,
        mass: MassKind::Lumped,
        dt: DT,
        end_time: 10.0,
        point_mode,
        transfer,
        points_per_cell: 4,
        flow: Default::default(),
        material: Elastic {
            youngs_modulus: 2e9,
            poissons_ratio: 0.25,
            density: 2000.0,
        },
        sides: [
            [side.clone(), side.clone()],
            [side, SideMethod::new("free")],
        ],
        drives: vec![Drive::PointForce {
            place: [1120.0, 0.0],
            direction: [0.0, -1.0],
            pulse: Pulse {
                wavelet: Wavelet::Sine,
                amplitude: 1e6,
                frequency: 2.0,
                t0: 0.0,
            },
        }],
        probes: Probes::default(),
        solver: SolverKind::Auto,
        rel_tol: 1e-10,
    }
}

/// A model that has been under way for a quarter of a second, so that waves are in it.
fn under_way(problem: &Problem<2>) -> (Model<2>, Newmark<2>, usize) {
    let mut model = setup::model(problem).expect("a valid problem");
    let mut newmark = Newmark::new(model.grid.node_count());
    for step in 0..25 {
        make_step(&mut model, &mut newmark, step);
    }
    (model, newmark, 25)
}

fn times(step: usize) -> ([f64; 2], Moment) {
    let times = [step as f64 * DT, (step + 1) as f64 * DT];
    (
        times,
        Moment {
            step,
            time_s: times[1],
        },
    )
}

fn make_step(model: &mut Model<2>, newmark: &mut Newmark<2>, step: usize) {
    let (times, moment) = times(step);
    newmark.step(model, times, moment).expect("a stable run");
}

fn whole_steps(c: &mut Criterion) {
    let mut group = c.benchmark_group("step");
    group.sample_size(20);
    for (name, mode, transfer, layer, thickness) in [
        (
            "frozen, 120,000 points",
            PointMode::Frozen,
            Transfer::Keep,
            "extended",
            1000.0,
        ),
        (
            "moving affine, 120,000 points",
            PointMode::Moving,
            Transfer::Affine,
            "extended",
            1000.0,
        ),
        (
            "moving flip, 120,000 points",
            PointMode::Moving,
            Transfer::Flip,
            "extended",
            1000.0,
        ),
        (
            "frozen pml of 10 cells, 52,800 points",
            PointMode::Frozen,
            Transfer::Keep,
            "pml",
            200.0,
        ),
        (
            "moving pml of 10 cells, 52,800 points",
            PointMode::Moving,
            Transfer::Affine,
            "pml",
            200.0,
        ),
    ] {
        let (mut model, mut newmark, mut step) =
            under_way(&problem(mode, transfer, layer, thickness));
        group.bench_function(name, |b| {
            b.iter(|| {
                make_step(&mut model, &mut newmark, step);
                step += 1;
            });
        });
    }
    group.finish();
}

fn parts(c: &mut Criterion) {
    let mut group = c.benchmark_group("part");
    group.sample_size(20);
    let problem = problem(PointMode::Moving, Transfer::Affine, "extended", 1000.0);
    let (mut model, _, step) = under_way(&problem);
    let (times, moment) = times(step);
    group.bench_function("masses and transfer to nodes", |b| {
        b.iter(|| model.begin_step(times, moment));
    });
    let rest = vec![[0.0; 2]; model.grid.node_count()];
    let mut force = rest.clone();
    let mut correction = rest.clone();
    group.bench_function("forces", |b| {
        let still = Motion {
            increment: &rest,
            v: &rest,
            a: &rest,
        };
        b.iter(|| model.residual(&still, &mut force).expect("finite forces"));
    });
    let largest = force
        .as_flattened()
        .iter()
        .map(|f| f * f)
        .sum::<f64>()
        .sqrt();
    let scale = ForceScale {
        largest,
        rounding: 0.0,
    };
    let rates = Rates {
        mass: 4.0 / (DT * DT),
        viscous: 2.0 / DT,
    };
    group.bench_function("assembly and solve, moving", |b| {
        b.iter(|| {
            model
                .solve(rates, &rest, &force, scale, &mut correction)
                .expect("convergence")
        });
    });
    let frozen = Problem {
        point_mode: PointMode::Frozen,
        transfer: Transfer::Keep,
        ..problem
    };
    let (mut model, _, _) = under_way(&frozen);
    model
        .begin_step(times, moment)
        .expect("points within the grid");
    group.bench_function("solve, frozen", |b| {
        b.iter(|| {
            model
                .solve(rates, &rest, &force, scale, &mut correction)
                .expect("convergence")
        });
    });
    group.finish();
}

criterion_group!(benches, whole_steps, parts);
criterion_main!(benches);
