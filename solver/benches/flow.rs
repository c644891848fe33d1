//! Rate of the fused explicit passes over a million points, to the nodes and back, sorting included, by
//! basis, law and transfer: `cargo bench -p anechoic-solver --bench flow`.
//!
//! Beside criterion's times (of the thread's CPU), each line prints the best rate, and the traffic of
//! 216 bytes a point-step as a share of what STREAM's triad moves on one thread in the same run. The
//! last line sets two threads on one body against two bodies of half the size on a thread each.

use anechoic_solver::flow::{Carry, Constitution, Dimension, Flow, NodeSums, Space, Start};
use anechoic_solver::grid::Grid;
use anechoic_solver::material::linear_elastic::LinearElastic;
use anechoic_solver::material::von_mises::VonMises;
use anechoic_solver::problem::{BasisKind, Elastic};
use anechoic_solver::tensor::Vector;
use cpu_time::ThreadTime;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::{Duration, Instant};

const CELLS: [usize; 2] = [500, 500];
/// Bytes of a point-step, as rates are compared elsewhere.
const TRAFFIC: f64 = 216.0;
const ELASTIC: Elastic = Elastic {
    youngs_modulus: 1.5e5,
    poissons_ratio: 0.3,
    density: 650.0,
};

/// What a step is made of.
#[derive(Clone, Copy)]
struct Kind {
    basis: BasisKind,
    law: Constitution,
    carry: Carry,
    mean_volumes: bool,
}

/// A body and what its nodes need.
struct Run {
    flow: Box<dyn Flow<2>>,
    sums: NodeSums<2>,
    v: Vec<Vector<2>>,
    a: Vec<Vector<2>>,
}

/// Fractions that look random.
fn scattered(k: usize, by: f64) -> f64 {
    ((k as f64 + 1.0) * by).fract() - 0.5
}

impl Run {
    /// `cells` cells with four points each, off their centres, and two empty cells around.
    fn new(cells: [usize; 2], kind: Kind, shared: bool) -> Self {
        let grid = Grid {
            origin: [-2.0; 2],
            h: [1.0; 2],
            cells: cells.map(|n| n + 4),
        };
        let n = 4 * cells[0] * cells[1];
        let places: Vec<Vector<2>> = (0..n)
            .map(|k| {
                let (i, j) = (k % (2 * cells[0]), k / (2 * cells[0]));
                let off = [scattered(k, 0.618_033_988), scattered(k, 0.754_877_666)];
                [
                    (i as f64 + 0.5 + 0.6 * off[0]) * 0.5,
                    (j as f64 + 0.5 + 0.6 * off[1]) * 0.5,
                ]
            })
            .collect();
        let velocities = places
            .iter()
            .map(|x| [0.1 * (0.1 * x[1]).sin(), 0.1 * (0.1 * x[0]).cos()]);
        let nodes = grid.node_count();
        let start = Start {
            velocities: velocities.collect(),
            grid,
            basis: kind.basis,
            per_axis: 2,
            places,
            stress: None,
            volume: 0.25,
            density: ELASTIC.density,
            carry: kind.carry,
            mean_volumes: kind.mean_volumes,
            shared,
        };
        let flow = Space::flow(kind.law, start).expect("places within the grid");
        Run {
            flow,
            sums: NodeSums::new(nodes),
            v: vec![[0.0; 2]; nodes],
            a: vec![[0.0; 2]; nodes],
        }
    }

    /// One step; returns what `clock` says the two passes took.
    fn step<T>(&mut self, start: impl Fn() -> T, elapsed: impl Fn(T) -> Duration) -> Duration {
        let dt = 0.4 / ELASTIC.p_speed();
        self.sums.clear();
        let clock = start();
        self.flow.to_nodes(&mut self.sums).expect("within the grid");
        let to_nodes = elapsed(clock);
        let NodeSums {
            mass,
            momentum,
            force,
        } = &self.sums;
        for (k, (v, a)) in self.v.iter_mut().zip(&mut self.a).enumerate() {
            // nodes that hardly any point sees rest
            let per_mass = if mass[k] > 0.02 * ELASTIC.density {
                1.0 / mass[k]
            } else {
                0.0
            };
            *a = force[k].map(|f| f * per_mass);
            *v = std::array::from_fn(|i| momentum[k][i] * per_mass + dt * a[i]);
        }
        let clock = start();
        self.flow
            .to_points(&self.v, &self.a, dt)
            .expect("a sound step");
        to_nodes + elapsed(clock)
    }

    fn cpu_step(&mut self) -> Duration {
        self.step(ThreadTime::now, |clock| clock.elapsed())
    }
}

/// Bytes a second of `a = b + s c` over arrays far larger than the caches.
fn triad() -> f64 {
    const N: usize = 8 << 20;
    let (mut a, b, c) = (vec![0.0; N], vec![1.0; N], vec![2.0; N]);
    let mut best = f64::INFINITY;
    for _ in 0..10 {
        let clock = ThreadTime::now();
        for ((a, b), c) in a.iter_mut().zip(&b).zip(&c) {
            *a = b + 3.0 * c;
        }
        black_box(&mut a);
        best = best.min(clock.elapsed().as_secs_f64());
    }
    24.0 * N as f64 / best
}

fn rates(c: &mut Criterion) {
    let triad = triad();
    println!("triad {:.2} GB/s", triad * 1e-9);
    let elastic = Constitution::LinearElastic(LinearElastic::new(&ELASTIC));
    // a strength that the points' motion reaches within some steps
    let von_mises = Constitution::VonMises(VonMises::new(&ELASTIC, 1e-3 * ELASTIC.youngs_modulus));
    let mut group = c.benchmark_group("flow");
    group.sample_size(10);
    let kind = |basis, law, carry| Kind {
        basis,
        law,
        carry,
        mean_volumes: false,
    };
    let (affine, flip) = (Carry::Affine { pic: 0.0 }, Carry::Flip { pic: 0.0 });
    let clay = kind(BasisKind::Gimp, von_mises, affine);
    for (name, kind) in [
        (
            "bspline elastic affine",
            kind(BasisKind::Bspline, elastic, affine),
        ),
        (
            "bspline elastic flip",
            kind(BasisKind::Bspline, elastic, flip),
        ),
        (
            "gimp elastic affine",
            kind(BasisKind::Gimp, elastic, affine),
        ),
        ("gimp von-mises affine", clay),
        (
            "gimp von-mises affine f-bar",
            Kind {
                mean_volumes: true,
                ..clay
            },
        ),
        (
            "linear elastic flip",
            kind(BasisKind::Linear, elastic, flip),
        ),
    ] {
        let mut run = Run::new(CELLS, kind, false);
        let points = run.flow.len();
        let mut best = f64::INFINITY;
        group.throughput(Throughput::Elements(points as u64));
        group.bench_function(name, |b| {
            b.iter_custom(|steps| {
                let time: Duration = (0..steps).map(|_| run.cpu_step()).sum();
                best = best.min(time.as_secs_f64() / steps as f64);
                time
            });
        });
        let rate = points as f64 / best;
        println!(
            "{name}: best {:.1} million point-steps per CPU second, {:.2} of triad",
            1e-6 * rate,
            rate * TRAFFIC / triad
        );
    }
    group.finish();
}

/// Steps of each measurement with threads.
const STEPS: usize = 8;

fn threads(_: &mut Criterion) {
    let elastic = Constitution::LinearElastic(LinearElastic::new(&ELASTIC));
    let kind = Kind {
        basis: BasisKind::Bspline,
        law: elastic,
        carry: Carry::Affine { pic: 0.0 },
        mean_volumes: false,
    };
    let new = |cells, shared| Run::new(cells, kind, shared);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(2)
        .build()
        .expect("two threads");
    let wall = |run: &mut Run| -> f64 {
        let steps = (0..STEPS).map(|_| run.step(Instant::now, |clock| clock.elapsed()));
        steps.sum::<Duration>().as_secs_f64()
    };
    let mut whole = new(CELLS, true);
    let half = [CELLS[0], CELLS[1] / 2];
    let (mut first, mut second) = (new(half, false), new(half, false));
    let (mut together, mut apart) = (f64::INFINITY, f64::INFINITY);
    for _ in 0..8 {
        together = together.min(pool.install(|| wall(&mut whole)));
        let (a, b) = pool.join(|| wall(&mut first), || wall(&mut second));
        apart = apart.min(a.max(b));
    }
    println!(
        "two threads: {:.2} of two copies of half the size",
        apart / together
    );
}

criterion_group!(benches, rates, threads);
criterion_main!(benches);
