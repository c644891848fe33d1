//! Gates of the true layer in three dimensions: its limits in the plane, symmetry, step limit, decay, echo.

#![allow(
    clippy::unwrap_used,
    reason = "a gate that cannot be set up has failed"
)]

use allocation_counter::measure;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::flow::{Dimension, Space};
use anechoic_solver::linear::Moment;
use anechoic_solver::problem::{Drive, PointMode, Problem, Scheme, Transfer};
use anechoic_solver::record::Record;
use anechoic_solver::setup;
use anechoic_solver::time::{Motion, System};
use anechoic_tests::space::{CELL, force, quarter};
use anechoic_tests::{Unwatched, half_space, solved};

/// A layer of so many cells.
fn layer(cells: usize) -> SideMethod {
    SideMethod::new("pml")
        .with("thickness_m", cells as f64 * CELL)
        .with("reflection", 1e-2)
}

fn column<'a>(record: &'a Record, name: &str) -> &'a [f64] {
    record.receivers.column(name).unwrap()
}

fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, v| m.max(v.abs()))
}

/// Largest difference of two series.
fn apart(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// Ground between two planes of symmetry is plane strain: edges where two layers meet included, the layer
/// does what that of the plane does.
#[test]
fn between_planes_of_symmetry_it_is_the_layer_of_the_plane() {
    let (width, depth, thickness) = (160.0, 120.0, 2.0 * CELL);
    for (scheme, tolerance) in [(Scheme::Explicit, 1e-11), (Scheme::Newmark, 1e-8)] {
        let mut plane = half_space(layer(4), PointMode::Frozen, Transfer::Keep);
        let pulse = match force([0.0; 3], [0.0; 3], 1e6) {
            Drive::PointForce { pulse, .. } | Drive::SideVelocity { pulse, .. } => pulse,
        };
        (plane.scheme, plane.end_time, plane.rel_tol) = (scheme, 1.5, 1e-12);
        plane.target.lower = [0.0, -depth];
        plane.target.upper = [width, 0.0];
        plane.drives = vec![Drive::PointForce {
            place: [CELL, 0.0],
            direction: [0.6, -0.8],
            pulse,
        }];
        plane.probes.receivers.truncate(1);
        plane.probes.receivers[0].place = [130.0, -100.0];
        let mut space = quarter(8, layer(4));
        (space.scheme, space.dt, space.end_time) = (scheme, plane.dt, plane.end_time);
        space.target.lower = [0.0, -depth, 0.0];
        space.target.upper = [width, 0.0, thickness];
        space.sides[0] = plane.sides[0].clone();
        space.sides[2] = [SideMethod::new("roller"), SideMethod::new("roller")];
        // the force per metre on the nodes of three rows
        space.drives = [(0.0, 0.5), (CELL, 1.0), (2.0 * CELL, 0.5)]
            .map(|(z, share)| force([CELL, 0.0, z], [0.6, -0.8, 0.0], 1e6 * share * CELL))
            .to_vec();
        space.probes.receivers.truncate(1);
        space.probes.receivers[0].place = [130.0, -100.0, 13.0];
        let (plane, space) = (solved(&plane), solved(&space));
        for axis in ["ux", "uy", "vx", "vy"] {
            let name = format!("A1_{axis}");
            let (a, b) = (column(&plane, &name), column(&space, &name));
            let difference = apart(a, b) / peak(a);
            println!("{scheme:?}, {axis}: {difference:.1e}");
            assert!(peak(a) > 0.0 && difference < tolerance);
        }
        assert!(peak(column(&space, "A1_uz")) < tolerance * peak(column(&plane, "A1_ux")));
    }
}

/// The axes are alike: a force along the diagonal of a cube with the same layer at its three ends moves
/// a place as it moves the mirrored one.
#[test]
fn axes_are_alike() {
    let mut problem = quarter(4, layer(3));
    let size = 4.0 * CELL;
    problem.target.lower = [0.0; 3];
    problem.target.upper = [size; 3];
    problem.sides = std::array::from_fn(|_| [SideMethod::new("roller"), layer(3)]);
    let along = 1.0 / 3.0_f64.sqrt();
    problem.drives = vec![force([CELL; 3], [along; 3], 1e6)];
    problem.probes.receivers.truncate(3);
    for (receiver, place) in problem.probes.receivers.iter_mut().zip([
        [70.0, 35.0, 10.0],
        [10.0, 70.0, 35.0],
        [35.0, 10.0, 70.0],
    ]) {
        receiver.place = place;
    }
    let record = solved(&problem);
    for (a, b) in [
        ("A1_ux", "A2_uy"),
        ("A1_ux", "A3_uz"),
        ("A1_uy", "A2_uz"),
        ("A1_uz", "A3_uy"),
    ] {
        let (x, y) = (column(&record, a), column(&record, b));
        let difference = apart(x, y) / peak(x);
        println!("{a} against {b}: {difference:.1e}");
        assert!(peak(x) > 0.0 && difference < 1e-11);
    }
}

/// Where faces, edges and the corner meet, the effective matrix of implicit steps is the derivative of the
/// forces, and symmetric: analytic, the equations say so.
#[test]
fn the_tangent_is_that_of_the_forces_and_symmetric() {
    let mut problem = quarter(2, layer(2));
    problem.scheme = Scheme::Newmark;
    // large against 1/beta, so that all memories weigh
    problem.dt = 0.05;
    let dt = problem.dt;
    let mut model = setup::model(&problem).unwrap();
    let moment = Moment {
        step: 1,
        time_s: dt,
    };
    model.begin_step([0.0, dt], moment).unwrap();
    let n = model.grid.node_count();
    let (rest, rates) = (vec![[0.0; 3]; n], [4.0 / (dt * dt), 2.0 / dt]);
    let mut forces = |increment: &[[f64; 3]]| {
        let times = |rate: f64| -> Vec<[f64; 3]> {
            increment.iter().map(|d| d.map(|x| rate * x)).collect()
        };
        let (a, v) = (times(rates[0]), times(rates[1]));
        let trial = Motion {
            increment,
            v: &v,
            a: &a,
        };
        let mut out = rest.clone();
        let scale = model.residual(&trial, &mut out).unwrap();
        (out, scale)
    };
    let (start, _) = forces(&rest);
    // what is held has no force, and does not move
    let free = |x: f64, f: f64| if f == 0.0 { 0.0 } else { x };
    let mut rough = |seed: f64| -> (Vec<[f64; 3]>, Vec<[f64; 3]>, _) {
        let sine = |k: usize, i: usize| (seed * (3 * k + i + k * k) as f64).sin();
        let all: Vec<[f64; 3]> = (0..n)
            .map(|k| std::array::from_fn(|i| sine(k, i)))
            .collect();
        let (held, _) = forces(&all);
        let d: Vec<[f64; 3]> = (0..n)
            .map(|k| std::array::from_fn(|i| free(all[k][i], held[k][i])))
            .collect();
        let (end, scale) = forces(&d);
        let change = start.iter().zip(&end);
        let change = change.map(|(a, b)| std::array::from_fn(|i| a[i] - b[i]));
        (d, change.collect(), scale)
    };
    let ((x, kx, scale), (y, ky, _)) = (rough(1.3), rough(0.7));
    let dot = |a: &[[f64; 3]], b: &[[f64; 3]]| -> f64 {
        let pairs = a.as_flattened().iter().zip(b.as_flattened());
        pairs.map(|(a, b)| a * b).sum()
    };
    let asymmetry = (dot(&y, &kx) - dot(&x, &ky)).abs() / dot(&x, &kx).abs();
    let mut found = rest.clone();
    let [mass, viscous] = rates;
    let rates = anechoic_solver::time::Rates { mass, viscous };
    model.solve(rates, &rest, &kx, scale, &mut found).unwrap();
    let error = apart(found.as_flattened(), x.as_flattened());
    println!("asymmetry {asymmetry:.1e}; solved for an increment of 1: wrong by {error:.1e}");
    assert!(asymmetry < 1e-13 && error < 1e-9);
}

/// Highest frequency (rad/s) of the elastic mesh, by power iteration on M^-1 K.
fn highest_frequency<const D: usize>(problem: &Problem<D>) -> f64
where
    Space: Dimension<D>,
{
    let mut model = setup::model(problem).unwrap();
    let moment = Moment {
        step: 1,
        time_s: problem.dt,
    };
    model.begin_step([0.0, problem.dt], moment).unwrap();
    let n = model.grid.node_count();
    let rest = vec![[0.0; D]; n];
    // neighbours against each other, unequally
    let mut u: Vec<[f64; D]> = (0..n)
        .map(|k| std::array::from_fn(|i| ((7 * k + 3 * i + k * k) as f64).sin()))
        .collect();
    let mut force = rest.clone();
    let mut square = 0.0;
    for _ in 0..3000 {
        let trial = Motion {
            increment: &u,
            v: &rest,
            a: &rest,
        };
        model.residual(&trial, &mut force).unwrap();
        let mass = &model.nodes.lumped.mass;
        let size = |u: &[[f64; D]]| -> f64 {
            let all = u.as_flattened().iter().zip(mass.as_flattened());
            all.map(|(u, m)| u * u * m).sum::<f64>().sqrt()
        };
        let next: Vec<[f64; D]> = force
            .iter()
            .zip(mass)
            .map(|(f, m)| std::array::from_fn(|i| if m[i] > 0.0 { -f[i] / m[i] } else { 0.0 }))
            .collect();
        square = size(&next) / size(&u);
        let scale = 1.0 / size(&next);
        u = next.iter().map(|x| x.map(|x| scale * x)).collect();
    }
    square.sqrt()
}

/// Total energy after `steps` steps of `dt` (s) over its maximum in the first tenth; infinite when the run
/// breaks off.
fn energy_left(mut problem: Problem<3>, dt: f64, steps: usize) -> f64 {
    problem.dt = dt;
    problem.end_time = steps as f64 * dt;
    problem.probes.receivers.clear();
    problem.probes.energy_every = Some(1);
    let outcome = anechoic_solver::solve(&problem, &Unwatched).unwrap();
    if outcome.error.is_some() {
        return f64::INFINITY;
    }
    let energy = outcome.record.energy.column("total").unwrap().to_vec();
    energy[energy.len() - 1] / peak(&energy[..energy.len() / 10])
}

/// A block of 4 cells with layers of 3.
fn small(layer: SideMethod) -> Problem<3> {
    quarter(4, layer)
}

/// The layer has the step limit of the elastic mesh, which is that of the same block without damping.
#[test]
fn the_step_limit_is_the_elastic_one() {
    let elastic = SideMethod::new("extended").with("thickness_m", 3.0 * CELL);
    let mut implicit = small(elastic.clone());
    implicit.scheme = Scheme::Newmark;
    let limit = 2.0 / highest_frequency(&implicit);
    let time = CELL / implicit.material.p_speed();
    println!("step limit {:.4} h/c_p", limit / time);
    for (share, stable) in [(0.99, true), (1.01, false)] {
        for side in [elastic.clone(), layer(3)] {
            let name = side.method.clone();
            let left = energy_left(small(side), share * limit, 3000);
            println!("{name} at {share} of the limit: energy {left:.1e} after 3000 steps");
            assert_eq!(left < 2.0, stable);
        }
    }
}

/// 20,000 steps: energies of windows fall, whatever is left in the integrals.
#[test]
fn twenty_thousand_steps_decay() {
    let mut problem = small(layer(3));
    problem.end_time = 20_000.0 * problem.dt;
    problem.probes.receivers.clear();
    problem.probes.energy_every = Some(10);
    let record = solved(&problem);
    let energy = record.energy.column("total").unwrap();
    let windows: Vec<f64> = energy.chunks(201).map(peak).collect();
    let orders: Vec<f64> = windows.iter().map(|w| w.log10()).collect();
    println!("log10 of the largest energies (J) of ten windows: {orders:.1?}");
    assert!(windows.windows(2).all(|w| w[1] < w[0]));
}

/// Largest difference to the reference over the standard run's largest displacement from `t1` (s) on: mean
/// and worst of the receivers.
fn echo(record: &Record, reference: &Record, standard: &Record, t1: f64) -> [f64; 2] {
    let first = record.receivers.times.partition_point(|t| *t < t1);
    let names = record.receivers.columns.iter();
    let names: Vec<&str> = names.filter_map(|c| c.name.strip_suffix("_ux")).collect();
    let ratios: Vec<f64> = names
        .iter()
        .map(|name| {
            let of = |record: &Record, i: usize| {
                ["ux", "uy", "uz"].map(|axis| column(record, &format!("{name}_{axis}"))[i])
            };
            let norm = |u: [f64; 3]| u.iter().map(|x| x * x).sum::<f64>().sqrt();
            let (mut most, mut whole) = (0.0_f64, 0.0_f64);
            for i in first..record.receivers.times.len() {
                let (a, b) = (of(record, i), of(reference, i));
                most = most.max(norm(std::array::from_fn(|k| a[k] - b[k])));
                whole = whole.max(norm(of(standard, i)));
            }
            println!("  {name}: {:.3} %", 100.0 * most / whole);
            most / whole
        })
        .collect();
    [
        ratios.iter().sum::<f64>() / ratios.len() as f64,
        ratios.iter().copied().fold(0.0, f64::max),
    ]
}

/// What the layer takes is what it is billed, the second memory of edges and corners included: without it a
/// sixth is missing.
#[test]
fn edges_and_corners_are_on_the_bill() {
    let of = |side: SideMethod| {
        let mut problem = quarter(10, side);
        problem.end_time = 3.0 * problem.dt;
        let bill = anechoic_solver::bill(&problem).unwrap().bytes();
        let used = measure(|| drop(solved(&problem))).bytes_max;
        [bill as f64, used as f64]
    };
    let extended = SideMethod::new("extended").with("thickness_m", 8.0 * CELL);
    let ([billed, used], plain) = (of(layer(8)), of(extended));
    let [billed, used] = [billed - plain[0], used - plain[1]];
    println!("the layer takes {used:.3e} B, billed {billed:.3e} B");
    assert!((used / billed - 1.0).abs() < 0.1);
}

/// Eight cells of layer against the same mesh extended until nothing comes back (certified), by both schemes:
/// 0.286 and 0.809 % explicit, 0.287 and 0.816 % implicit, accepted with a twentieth to either side.
///
/// Mutations, mean and worst: U left out of explicit forces 0.31 and 0.83 %; psi not moved on 0.43 and 1.1 %;
/// q_l with the other sign 0.57 and 1.2 %; cross terms without memory 2.3 and 8.5 %. Without e_3 dt^2/4 in the
/// damping the echo is the same: the masses of a step's ends are checked beside the kernel.
#[test]
fn eight_cells_leave_little_echo() {
    for scheme in [Scheme::Explicit, Scheme::Newmark] {
        let run = |side: SideMethod| {
            let mut problem = quarter(10, side);
            (problem.scheme, problem.end_time, problem.rel_tol) = (scheme, 1.2, 1e-10);
            solved(&problem)
        };
        // 2 x 600 m and 200 m at 1095 m/s: nothing is back before 1.28 s
        let extended = |thickness: f64| SideMethod::new("extended").with("thickness_m", thickness);
        let (reference, standard) = (run(extended(600.0)), run(extended(160.0)));
        let [mean, worst] = echo(&run(layer(8)), &reference, &standard, 0.4);
        let per_cent = [100.0 * mean, 100.0 * worst];
        println!("{scheme:?}, 8 cells: mean and worst {per_cent:.3?} %");
        assert!((mean / 0.00286 - 1.0).abs() < 0.05 && (worst / 0.00812 - 1.0).abs() < 0.05);
    }
}
