//! Times of one pass over 120,000 points and of one pass over their 30,351 nodes, by basis: what
//! the constants of `solver/src/bill/prices.rs` are made of. `cargo bench -p anechoic-solver --bench pass`.

use anechoic_solver::basis::{Discretisation, on_grid};
use anechoic_solver::grid::Grid;
use anechoic_solver::linear::block_matrix::BlockMatrix;
use anechoic_solver::linear::cg::ConjugateGradients;
use anechoic_solver::material::MaterialBlock;
use anechoic_solver::material::linear_elastic::LinearElastic;
use anechoic_solver::points::{BLOCK, Points, blocks};
use anechoic_solver::problem::{BasisKind, Elastic};
use anechoic_solver::tensor::{Matrix, Vector, zero};
use cpu_time::ThreadTime;
use criterion::measurement::WallTime;
use criterion::{Bencher, BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

const CELLS: [usize; 2] = [200, 150];
const H: f64 = 20.0;

/// Cells filled with four points each.
fn filled(kind: BasisKind) -> (Box<dyn Discretisation<2>>, Points<2>) {
    let grid = Grid {
        origin: [0.0; 2],
        h: [H; 2],
        cells: CELLS,
    };
    let mut points = Points::default();
    for cell in 0..CELLS[0] * CELLS[1] {
        let (x, y) = (cell % CELLS[0], cell / CELLS[0]);
        points.fill_cell(&[x as f64 * H, y as f64 * H], &[H; 2], 2, None, 2000.0);
    }
    let mut disc = on_grid(kind, &grid, 2);
    disc.place(&points.place)
        .expect("points of the grid's cells");
    (disc, points)
}

fn material() -> LinearElastic {
    LinearElastic::new(&Elastic {
        youngs_modulus: 2e9,
        poissons_ratio: 0.25,
        density: 2000.0,
    })
}

/// Times a pass in CPU time, which other programs disturb least.
fn cpu<T>(bencher: &mut Bencher<'_>, mut pass: impl FnMut() -> T) {
    bencher.iter_custom(|times| {
        let start = ThreadTime::now();
        for _ in 0..times {
            black_box(pass());
        }
        start.elapsed()
    });
}

/// Passes over the points.
fn of_points(
    group: &mut BenchmarkGroup<'_, WallTime>,
    disc: &mut dyn Discretisation<2>,
    points: &Points<2>,
) {
    let nodes = disc.node_count();
    let field: Vec<Vector<2>> = (0..nodes)
        .map(|k| [(k as f64).sin(), (k as f64).cos()])
        .collect();
    let mut out = vec![[0.0; 2]; nodes];
    let all = 0..points.len();
    let material = material();
    let mut vectors = [[0.0; 2]; BLOCK];
    let mut matrices: [Matrix<2>; BLOCK] = [zero(); BLOCK];
    group.throughput(Throughput::Elements(points.len() as u64));
    group.bench_function("gather", |b| {
        cpu(b, || {
            for block in blocks(all.clone()) {
                let n = block.len();
                disc.gather(block, &field, &mut vectors[..n]);
            }
        });
    });
    group.bench_function("scatter", |b| {
        cpu(b, || {
            for block in blocks(all.clone()) {
                let n = block.len();
                disc.scatter_vector(block.clone(), &points.mass[block], &vectors[..n], &mut out);
            }
        });
    });
    group.bench_function("affine scatter", |b| {
        cpu(b, || {
            for block in blocks(all.clone()) {
                let (n, mass) = (block.len(), &points.mass[block.clone()]);
                let places = &points.place[block.clone()];
                disc.scatter_affine(block, mass, &vectors[..n], &matrices[..n], places, &mut out);
            }
        });
    });
    group.bench_function("small strain force", |b| {
        cpu(b, || {
            for block in blocks(all.clone()) {
                let n = block.len();
                disc.gradient(block.clone(), &field, &mut matrices[..n]);
                let mut stress: [Matrix<2>; BLOCK] = [zero(); BLOCK];
                material.small_stress(&matrices[..n], &mut stress[..n]);
                let volumes = &points.volume[block.clone()];
                disc.scatter_stress(block, volumes, &stress[..n], &mut out);
            }
        });
    });
    group.bench_function("finite strain force", |b| {
        cpu(b, || {
            let start: [Matrix<2>; BLOCK] = [zero(); BLOCK];
            let (mut next, mut first) = (start, start);
            for block in blocks(all.clone()) {
                let n = block.len();
                disc.gradient(block.clone(), &out, &mut matrices[..n]);
                // small enough that no point inverts
                matrices[..n].fill([[1e-6, 2e-6], [0.0, 1e-6]]);
                material
                    .finite_stress(&matrices[..n], &start[..n], &mut next[..n], &mut first[..n])
                    .expect("small strain");
                let volumes = &points.volume[block.clone()];
                disc.scatter_stress(block, volumes, &first[..n], &mut out);
            }
        });
    });
    group.bench_function("finite strain moduli", |b| {
        cpu(b, || {
            let start: [Matrix<2>; BLOCK] = [[[1e3, 0.0], [0.0, 1e3]]; BLOCK];
            let mut moduli = [material.small_moduli(); BLOCK];
            for block in blocks(all.clone()) {
                let n = block.len();
                disc.gradient(block, &field, &mut matrices[..n]);
                matrices[..n].fill([[1e-6, 2e-6], [0.0, 1e-6]]);
                material.finite_moduli(&matrices[..n], &start[..n], &mut moduli[..n]);
                black_box(&moduli);
            }
        });
    });
    let mut matrix = BlockMatrix::zeros(disc.pattern());
    let moduli = [material.small_moduli(); BLOCK];
    group.bench_function("tangent", |b| {
        cpu(b, || {
            for block in blocks(all.clone()) {
                let (n, volumes) = (block.len(), &points.volume[block.clone()]);
                disc.scatter_tangent(block, volumes, &moduli[..n], &mut matrix);
            }
        });
    });
    let weights = [[1.0; 2]; BLOCK];
    group.bench_function("consistent mass", |b| {
        cpu(b, || {
            for block in blocks(all.clone()) {
                let n = block.len();
                disc.scatter_mass(block, &weights[..n], &mut matrix);
            }
        });
    });
    group.bench_function("find nodes", |b| {
        cpu(b, || {
            disc.replace(&points.place)
                .expect("points of the grid's cells")
        });
    });
}

/// Passes over the nodes.
fn of_nodes(
    group: &mut BenchmarkGroup<'_, WallTime>,
    disc: &dyn Discretisation<2>,
    points: &Points<2>,
) {
    let nodes = disc.node_count();
    let mut matrix = BlockMatrix::zeros(disc.pattern());
    let moduli = [material().small_moduli(); BLOCK];
    for block in blocks(0..points.len()) {
        let (n, volumes) = (block.len(), &points.volume[block.clone()]);
        disc.scatter_tangent(block, volumes, &moduli[..n], &mut matrix);
    }
    matrix.add_diagonal(1.0, &vec![[1e11; 2]; nodes]);
    let field: Vec<Vector<2>> = (0..nodes)
        .map(|k| [(k as f64).sin(), (k as f64).cos()])
        .collect();
    let mut out = vec![[0.0; 2]; nodes];
    group.throughput(Throughput::Elements(nodes as u64));
    group.bench_function("matrix times vector", |b| {
        cpu(b, || matrix.apply(&field, &mut out));
    });
    let mut cg = ConjugateGradients::<2>::new(nodes);
    let held = vec![[false; 2]; nodes];
    // ten of them, started once
    group.throughput(Throughput::Elements(10 * nodes as u64));
    group.bench_function("iteration of conjugate gradients", |b| {
        cpu(b, || cg.solve(&matrix, &held, &field, &mut out, 0.0, 10));
    });
}

fn passes(c: &mut Criterion) {
    for (name, kind) in [
        ("linear", BasisKind::Linear),
        ("gimp", BasisKind::Gimp),
        ("bspline", BasisKind::Bspline),
    ] {
        let (mut disc, points) = filled(kind);
        let mut group = c.benchmark_group(name);
        group.sample_size(10);
        of_points(&mut group, disc.as_mut(), &points);
        of_nodes(&mut group, disc.as_ref(), &points);
        group.finish();
    }
}

criterion_group!(benches, passes);
criterion_main!(benches);
