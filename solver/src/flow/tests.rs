use super::*;
use crate::basis::{Discretisation, on_grid};
use crate::problem::Elastic;
mod cells;
mod patches;
mod runs;
mod surface;

const KINDS: [BasisKind; 3] = [BasisKind::Linear, BasisKind::Gimp, BasisKind::Bspline];
const FLIP: Carry = Carry::Flip { pic: 0.0 };
const AFFINE: Carry = Carry::Affine { pic: 0.0 };
const SHARED: [Carry; 2] = [Carry::Affine { pic: 0.3 }, Carry::Flip { pic: 0.3 }];

const ELASTIC: Elastic = Elastic {
    youngs_modulus: 1e4,
    poissons_ratio: 0.3,
    density: 2.0,
};

fn law() -> LinearElastic {
    LinearElastic::new(&ELASTIC)
}

/// Fractions that look random.
fn fraction(k: usize, a: usize) -> f64 {
    let by = [0.618_033_988, 0.754_877_666, 0.819_172_513][a];
    ((k as f64 + 0.5) * by).fract()
}

fn grid<const D: usize>() -> Grid<D> {
    Grid {
        origin: std::array::from_fn(|a| [-1.0, 0.5, 2.0][a]),
        h: std::array::from_fn(|a| [0.5, 0.25, 0.4][a]),
        cells: std::array::from_fn(|a| [6, 11, 9][D - 1 - a]),
    }
}

/// Points all over the grid, so many in each cell that no node is light, moving and stressed.
fn cloud<const D: usize>(basis: BasisKind, carry: Carry) -> Start<D> {
    let grid = grid::<D>();
    let cells: usize = grid.cells.iter().product();
    let n = 5 * cells;
    let place = |k: usize| -> Vector<D> {
        std::array::from_fn(|a| grid.origin[a] + grid.h[a] * grid.cells[a] as f64 * fraction(k, a))
    };
    let places: Vec<Vector<D>> = (0..n).map(place).collect();
    let velocities = places
        .iter()
        .map(|x| std::array::from_fn(|i| (1.0 + x[i]).sin() + 0.3 * x[(i + 1) % D]));
    let stress = places.iter().map(|x| {
        let off = 0.2 * x[0];
        let diagonal = |i: usize| 1.0 + x[i] * x[D - 1];
        std::array::from_fn(|i| std::array::from_fn(|j| if i == j { diagonal(i) } else { off }))
    });
    Start {
        velocities: velocities.collect(),
        stress: Some(stress.collect()),
        basis,
        per_axis: 2,
        volume: 0.02,
        density: 2.0,
        carry,
        mean_volumes: false,
        shared: false,
        grid,
        places,
    }
}

/// A nodal field.
fn field<const D: usize>(nodes: usize, phase: f64) -> Vec<Vector<D>> {
    (0..nodes)
        .map(|k| std::array::from_fn(|i| (0.37 * k as f64 + i as f64 + phase).sin()))
        .collect()
}

fn linear_field<const D: usize>(grid: &Grid<D>, gradient: &Matrix<D>) -> Vec<Vector<D>> {
    let value = |x: Vector<D>| gradient.map(|row| 0.1 + (0..D).map(|j| row[j] * x[j]).sum::<f64>());
    (0..grid.node_count())
        .map(|n| value(grid.node_place(n)))
        .collect()
}

fn assert_near(got: &[f64], expected: &[f64], what: &str) {
    let largest = expected.iter().fold(1e-300, |m: f64, x| m.max(x.abs()));
    assert_eq!(got.len(), expected.len());
    for (k, (a, b)) in got.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= 1e-12 * largest, "{what} {k}: {a} {b}");
    }
}

/// The general discretisation with the points of a flow as they stand.
fn general<const D: usize>(flow: &dyn Flow<D>, start: &Start<D>) -> Box<dyn Discretisation<D>> {
    let mut disc = on_grid(start.basis, &start.grid, 2);
    disc.place(flow.places()).expect("points within the grid");
    disc
}

fn stresses<const D: usize>(flow: &dyn Flow<D>) -> Vec<Matrix<D>> {
    (0..flow.len()).map(|p| flow.stress(p)).collect()
}

#[test]
fn sums_are_those_of_the_general_discretisation() {
    for basis in KINDS {
        for carry in [AFFINE, FLIP].into_iter().chain(SHARED) {
            check_sums::<2>(cloud(basis, carry));
            check_sums::<3>(cloud(basis, carry));
        }
    }
}

fn check_sums<const D: usize>(start: Start<D>)
where
    LinearElastic: Law<D>,
{
    let mut flow = flow(law(), start.clone()).expect("within the grid");
    let nodes = start.grid.node_count();
    // a kick by a linear field gives all points one gradient and leaves their places
    let gradient: Matrix<D> =
        std::array::from_fn(|i| std::array::from_fn(|j| 0.3 * i as f64 - 0.7 * j as f64 + 0.2));
    let a = linear_field(&start.grid, &gradient);
    let share = field(nodes, 0.0);
    flow.kick(&share, &a, 0.5).expect("a kick");
    let (mut sums, mut momentum) = (NodeSums::new(nodes), vec![[0.0; D]; nodes]);
    flow.to_nodes(&mut sums).expect("within the grid");
    flow.momentum(&mut momentum).expect("within the grid");

    let n = flow.len();
    let disc = general(flow.as_ref(), &start);
    let mut expected = NodeSums::new(nodes);
    let mass = vec![start.density * start.volume; n];
    disc.scatter_scalar(0..n, &mass, &mut expected.mass);
    let v = flow.velocities();
    if let Carry::Affine { pic } = start.carry {
        let mut l = vec![[[0.0; D]; D]; n];
        disc.gradient(0..n, &share, &mut l);
        for x in &mut l {
            *x = std::array::from_fn(|i| {
                std::array::from_fn(|j| (1.0 - pic) * 0.5 * gradient[i][j] + pic * x[i][j])
            });
        }
        disc.scatter_affine(0..n, &mass, v, &l, flow.places(), &mut expected.momentum);
    } else {
        disc.scatter_vector(0..n, &mass, v, &mut expected.momentum);
    }
    let volumes = vec![-start.volume; n];
    disc.scatter_stress(
        0..n,
        &volumes,
        &stresses(flow.as_ref()),
        &mut expected.force,
    );
    let what = format!("{:?} {:?} D = {D}", start.basis, start.carry);
    assert_near(&sums.mass, &expected.mass, &what);
    assert_near(
        sums.momentum.as_flattened(),
        expected.momentum.as_flattened(),
        &what,
    );
    assert_near(
        sums.force.as_flattened(),
        expected.force.as_flattened(),
        &what,
    );
    assert_near(
        momentum.as_flattened(),
        expected.momentum.as_flattened(),
        &what,
    );

    // a partition of unity, and functions that reproduce linear fields, lose nothing
    let total: f64 = sums.mass.iter().sum();
    assert_near(&[total], &[mass.iter().sum()], &what);
    for i in 0..D {
        let given: f64 = sums.momentum.iter().map(|p| p[i]).sum();
        assert!((given - flow.total_momentum()[i]).abs() < 1e-12 * total);
    }
}

#[test]
fn points_move_as_by_the_general_discretisation() {
    for basis in KINDS {
        for carry in [AFFINE, FLIP].into_iter().chain(SHARED) {
            check_points::<2>(cloud(basis, carry));
            check_points::<3>(cloud(basis, carry));
        }
    }
}

fn check_points<const D: usize>(start: Start<D>)
where
    LinearElastic: Law<D>,
{
    let mut flow = flow(law(), start.clone()).expect("within the grid");
    let (n, nodes, dt) = (flow.len(), start.grid.node_count(), 1e-3);
    let (v, a) = (field(nodes, 0.0), field(nodes, 1.0));
    let disc = general(flow.as_ref(), &start);
    let (mut vp, mut ap) = (vec![[0.0; D]; n], vec![[0.0; D]; n]);
    let mut l = vec![[[0.0; D]; D]; n];
    disc.gather(0..n, &v, &mut vp);
    disc.gather(0..n, &a, &mut ap);
    disc.gradient(0..n, &v, &mut l);
    let pic = match start.carry {
        Carry::Flip { pic } | Carry::Affine { pic } => pic,
    };
    let (mut places, mut velocities) = (flow.places().to_vec(), flow.velocities().to_vec());
    let mut stress = stresses(flow.as_ref());
    for p in 0..n {
        for i in 0..D {
            places[p][i] += dt * vp[p][i];
            let kicked = velocities[p][i] + dt * ap[p][i];
            velocities[p][i] = kicked + pic * (vp[p][i] - kicked);
        }
        let mut state = law().prestressed(&stress[p]);
        Law::<D>::advance(&law(), &l[p], dt, &mut state);
        stress[p] = Law::<D>::stress(&law(), &state);
    }
    // the outermost points may leave the grid, which is for the next pass to find
    flow.to_points(&v, &a, dt).expect("a sound step");
    let what = format!("{:?} {:?} D = {D}", start.basis, start.carry);
    assert_near(flow.places().as_flattened(), places.as_flattened(), &what);
    assert_near(
        flow.velocities().as_flattened(),
        velocities.as_flattened(),
        &what,
    );
    let got = stresses(flow.as_ref());
    let (got, expected) = (got.as_flattened(), stress.as_flattened());
    assert_near(got.as_flattened(), expected.as_flattened(), &what);
}

#[test]
fn modified_order_with_the_same_velocities_is_the_plain_order() {
    let start = cloud::<2>(BasisKind::Gimp, AFFINE);
    let nodes = start.grid.node_count();
    let (v, a) = (field(nodes, 0.0), field(nodes, 1.0));
    let mut plain = flow(law(), start.clone()).expect("within the grid");
    let mut parts = flow(law(), start).expect("within the grid");
    plain.to_points(&v, &a, 1e-3).expect("a sound step");
    parts.kick(&v, &a, 1e-3).expect("a kick");
    parts.drift(&v, 1e-3).expect("a sound step");
    assert_same_points(plain.as_ref(), parts.as_ref());
}

fn assert_same_points<const D: usize>(a: &dyn Flow<D>, b: &dyn Flow<D>) {
    assert_eq!(a.places(), b.places());
    assert_eq!(a.velocities(), b.velocities());
    assert_eq!(stresses(a), stresses(b));
}

#[test]
fn a_linear_velocity_gives_each_point_its_gradient() {
    let gradient = [[0.2, -0.1], [0.4, 0.3]];
    for basis in KINDS {
        let mut start = cloud::<2>(basis, FLIP);
        start.stress = None;
        let v = linear_field(&start.grid, &gradient);
        let mut flow = flow(law(), start).expect("within the grid");
        flow.drift(&v, 1e-6).expect("a sound step");
        let mut state = [0.0; 3];
        Law::<2>::advance(&law(), &gradient, 1e-6, &mut state);
        let expected = Law::<2>::stress(&law(), &state);
        for p in 0..flow.len() {
            let got = flow.stress(p);
            assert_near(got.as_flattened(), expected.as_flattened(), "stress");
        }
    }
}
