//! Memory of explicit steps: points take what they say, and steps allocate nothing, with one thread and
//! two.

use allocation_counter::measure;
use anechoic_solver::flow::surface::Surface;
use anechoic_solver::flow::{Carry, Constitution, Dimension, Flow, NodeSums, Space, Start};
use anechoic_solver::grid::Grid;
use anechoic_solver::material::linear_elastic::LinearElastic;
use anechoic_solver::problem::{BasisKind, Elastic};

const ELASTIC: Elastic = Elastic {
    youngs_modulus: 1.5e5,
    poissons_ratio: 0.3,
    density: 650.0,
};

/// A block of 30 cells by `rows` in the middle of a grid, drifting.
fn block(rows: usize, carry: Carry, shared: bool) -> (Grid<2>, Box<dyn Flow<2>>) {
    let grid = Grid {
        origin: [0.0; 2],
        h: [1.0; 2],
        cells: [50, 50],
    };
    let places: Vec<[f64; 2]> = (0..120 * rows)
        .map(|k| [10.25 + 0.5 * (k % 60) as f64, 10.25 + 0.5 * (k / 60) as f64])
        .collect();
    let start = Start {
        velocities: vec![[2.0, 3.0]; places.len()],
        stress: None,
        volume: 0.25,
        density: ELASTIC.density,
        basis: BasisKind::Gimp,
        per_axis: 2,
        carry,
        mean_volumes: true,
        grid: grid.clone(),
        places,
        shared,
    };
    let law = Constitution::LinearElastic(LinearElastic::new(&ELASTIC));
    (grid, Space::flow(law, start).expect("within the grid"))
}

/// Steps of a free body in modified order, without a node's own allocation.
fn run(flow: &mut dyn Flow<2>, grid: &Grid<2>, steps: &[usize]) -> Vec<u64> {
    let nodes = grid.node_count();
    let (mut sums, dt) = (NodeSums::new(nodes), 0.4 / ELASTIC.p_speed());
    let (mut v, mut a) = (vec![[0.0; 2]; nodes], vec![[0.0; 2]; nodes]);
    let mut surface = Surface::new(grid, ELASTIC.density);
    let mut counts = Vec::with_capacity(steps.len());
    for &n in steps {
        let memory = measure(|| {
            for _ in 0..n {
                sums.clear();
                flow.to_nodes(&mut sums).expect("within the grid");
                surface.fold(&mut sums);
                for k in 0..nodes {
                    let per_mass = if sums.mass[k] > 0.0 {
                        1.0 / sums.mass[k]
                    } else {
                        0.0
                    };
                    a[k] = sums.force[k].map(|f| f * per_mass);
                    v[k] = std::array::from_fn(|i| sums.momentum[k][i] * per_mass + dt * a[k][i]);
                }
                surface.follow(&mut v);
                surface.follow(&mut a);
                flow.to_points(&v, &a, dt).expect("a sound step");
            }
        });
        counts.push(memory.count_total);
    }
    counts
}

#[test]
fn points_take_what_they_say() {
    // place, velocity, a spare of either; stress and gradient twice; two keys
    for (carry, bytes) in [
        (Carry::Flip { pic: 0.0 }, 104),
        (Carry::Affine { pic: 0.0 }, 168),
    ] {
        let held = |rows: usize| {
            let mut kept = None;
            let memory = measure(|| kept = Some(block(rows, carry, false).1));
            let says = kept.map(|flow| flow.bytes_per_point());
            (memory.bytes_current, says)
        };
        let ((less, _), (more, says)) = (held(10), held(30));
        assert_eq!(says, Some(bytes));
        assert_eq!(more - less, 120 * 20 * bytes as i64);
    }
}

#[test]
fn steps_allocate_nothing() {
    let (grid, mut flow) = block(30, Carry::Affine { pic: 0.0 }, false);
    let before = flow.total_momentum();
    // over these steps the block moves by several cells and is sorted many times
    let counts = run(flow.as_mut(), &grid, &[2, 100]);
    assert_eq!(counts[1], 0);
    let after = flow.total_momentum();
    assert!((0..2).all(|i| (after[i] - before[i]).abs() < 1e-9 * before[i].abs()));
}

#[test]
fn steps_of_two_threads_allocate_nothing() {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(2)
        .build()
        .expect("two threads");
    let (grid, mut flow) = block(30, Carry::Affine { pic: 0.0 }, true);
    let counts = pool.install(|| run(flow.as_mut(), &grid, &[40, 100]));
    assert_eq!(counts[1], 0);
}
