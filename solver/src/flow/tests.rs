use super::*;
use crate::basis::{Discretisation, on_grid};
use crate::problem::Elastic;
use crate::tensor::{add_scaled, contract, mul_transposed};

const KINDS: [BasisKind; 3] = [BasisKind::Linear, BasisKind::Gimp, BasisKind::Bspline];
const FLIP: Carry = Carry::Flip { pic: 0.0 };

fn law() -> LinearElastic {
    LinearElastic::new(&Elastic {
        youngs_modulus: 1e4,
        poissons_ratio: 0.3,
        density: 2.0,
    })
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

/// Points all over the grid, so many in each cell that no node is faint, moving and stressed.
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
        for carry in [Carry::Affine, FLIP] {
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
    flow.kick(&field(nodes, 0.0), &a, 0.5).expect("a kick");
    let (mut sums, mut momentum) = (NodeSums::new(nodes), vec![[0.0; D]; nodes]);
    flow.to_nodes(&mut sums).expect("within the grid");
    flow.momentum(&mut momentum).expect("within the grid");

    let n = flow.len();
    let disc = general(flow.as_ref(), &start);
    let mut expected = NodeSums::new(nodes);
    let mass = vec![start.density * start.volume; n];
    disc.scatter_scalar(0..n, &mass, &mut expected.mass);
    let v = flow.velocities();
    if start.carry == Carry::Affine {
        let l = vec![gradient.map(|row| row.map(|x| 0.5 * x)); n];
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
        for carry in [Carry::Affine, FLIP, Carry::Flip { pic: 0.3 }] {
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
        Carry::Flip { pic } => pic,
        Carry::Affine => 0.0,
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
    let start = cloud::<2>(BasisKind::Gimp, Carry::Affine);
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

#[test]
fn rigid_motion_only_turns_the_stress() {
    let mut start = cloud::<2>(BasisKind::Bspline, FLIP);
    let stress = [[3.0, 0.7], [0.7, -1.0]];
    start.stress = Some(vec![stress; start.places.len()]);
    // the increment of a turn by this angle over a step of one second
    let angle: f64 = 0.1;
    let (c, s) = (angle.cos(), angle.sin());
    let turn = linear_field(&start.grid, &[[c - 1.0, -s], [s, c - 1.0]]);
    let mut flow = flow(law(), start).expect("within the grid");
    let translation = vec![[2.0, -3.0]; turn.len()];
    flow.drift(&translation, 0.0).expect("a sound step");
    assert!(
        (0..flow.len()).all(|p| contract(&flow.stress(p), &stress) == contract(&stress, &stress))
    );
    flow.drift(&turn, 1.0).expect("a sound step");
    let r = [[c, -s], [s, c]];
    let turned = mul_transposed(&crate::tensor::mul(&r, &stress), &r);
    for p in 0..flow.len() {
        let difference = add_scaled(&flow.stress(p), -1.0, &turned);
        // rounding of strains of order one against a modulus of 1e4
        assert!(contract(&difference, &difference).sqrt() < 1e-10);
    }
}

#[test]
fn force_of_a_uniform_stress_is_its_traction_on_the_ends() {
    // one point in the middle of each quarter of a cell fills the grid
    let grid = grid::<2>();
    let mut points = crate::points::Points::<2>::default();
    for cell in 0..grid.cells[0] * grid.cells[1] {
        let index = [cell % grid.cells[0], cell / grid.cells[0]];
        let lower = std::array::from_fn(|a| grid.origin[a] + grid.h[a] * index[a] as f64);
        points.fill_cell(&lower, &grid.h, 2, 2.0);
    }
    let stress = [[3.0, 0.7], [0.7, -1.0]];
    for basis in KINDS {
        let n = points.len();
        let mut flow = flow(
            law(),
            Start {
                grid: grid.clone(),
                basis,
                per_axis: 2,
                places: points.place.clone(),
                velocities: vec![[0.0; 2]; n],
                stress: Some(vec![stress; n]),
                volume: points.volume[0],
                density: 2.0,
                carry: FLIP,
                shared: false,
            },
        )
        .expect("within the grid");
        let mut sums = NodeSums::new(grid.node_count());
        flow.to_nodes(&mut sums).expect("within the grid");
        for i in 0..2 {
            let total: f64 = sums.force.iter().map(|f| f[i]).sum();
            assert!(total.abs() < 1e-11);
        }
        for (node, f) in sums.force.iter().enumerate() {
            let index = grid.lattice(node);
            // B-splines give a corner more than the half edge that the others do
            let near = |a: usize| index[a] < 2 || index[a] + 2 > grid.cells[a];
            if basis == BasisKind::Bspline && near(0) && near(1) {
                continue;
            }
            let mut expected = [0.0; 2];
            for axis in 0..2 {
                let across = 1 - axis;
                let at_end = |a: usize| index[a] == 0 || index[a] == grid.cells[a];
                // half a cell's edge belongs to a corner
                let edge = grid.h[across] * if at_end(across) { 0.5 } else { 1.0 };
                let normal = match index[axis] {
                    0 => 1.0,
                    i if i == grid.cells[axis] => -1.0,
                    _ => 0.0,
                };
                for i in 0..2 {
                    expected[i] += normal * edge * stress[i][axis];
                }
            }
            for i in 0..2 {
                assert!(
                    (f[i] - expected[i]).abs() < 1e-12,
                    "{basis:?} {node} {f:?} {expected:?}"
                );
            }
        }
    }
}

/// A few steps of a free body.
fn run(flow: &mut dyn Flow<2>, nodes: usize, steps: usize) -> NodeSums<2> {
    let mut sums = NodeSums::new(nodes);
    let dt = 2e-4;
    for _ in 0..steps {
        sums.clear();
        flow.to_nodes(&mut sums).expect("within the grid");
        let a: Vec<Vector<2>> = (0..nodes)
            .map(|k| {
                sums.force[k].map(|f| {
                    if sums.mass[k] > 1e-3 {
                        f / sums.mass[k]
                    } else {
                        0.0
                    }
                })
            })
            .collect();
        let v: Vec<Vector<2>> = (0..nodes)
            .map(|k| {
                let per_mass = if sums.mass[k] > 1e-3 {
                    1.0 / sums.mass[k]
                } else {
                    0.0
                };
                std::array::from_fn(|i| sums.momentum[k][i] * per_mass + dt * a[k][i])
            })
            .collect();
        flow.to_points(&v, &a, dt).expect("a sound step");
    }
    sums
}

/// The cloud without the points near the ends of the grid.
fn free(carry: Carry) -> Start<2> {
    let mut start = cloud::<2>(BasisKind::Bspline, carry);
    let inside = |x: &Vector<2>| x[0].abs() < 3.0 && x[1] > 0.9 && x[1] < 1.7;
    start.grid.origin = [-5.0, -2.0];
    start.grid.cells = [40, 40];
    let kept: Vec<usize> = (0..start.places.len())
        .filter(|&p| inside(&start.places[p]))
        .collect();
    start.places = kept.iter().map(|&p| start.places[p]).collect();
    start.velocities = kept.iter().map(|&p| start.velocities[p]).collect();
    start.stress = None;
    start
}

#[test]
fn one_thread_and_two_give_the_same_bits() {
    for carry in [Carry::Affine, FLIP] {
        let start = free(carry);
        let nodes = start.grid.node_count();
        let mut alone = flow(law(), start.clone()).expect("within the grid");
        let mut shared = flow(
            law(),
            Start {
                shared: true,
                ..start
            },
        )
        .expect("within the grid");
        let expected = run(alone.as_mut(), nodes, 80);
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(2)
            .build()
            .expect("two threads");
        let got = pool.install(|| run(shared.as_mut(), nodes, 80));
        assert_eq!(got, expected);
        assert_same_points(alone.as_ref(), shared.as_ref());
    }
}

#[test]
fn the_order_of_points_at_the_start_changes_nothing_but_rounding() {
    let start = free(Carry::Affine);
    let nodes = start.grid.node_count();
    let mut turned = start.clone();
    turned.places.reverse();
    turned.velocities.reverse();
    let mut first = flow(law(), start).expect("within the grid");
    let mut second = flow(law(), turned).expect("within the grid");
    let (a, b) = (
        run(first.as_mut(), nodes, 80),
        run(second.as_mut(), nodes, 80),
    );
    for (a, b) in a.force.as_flattened().iter().zip(b.force.as_flattened()) {
        assert!((a - b).abs() < 1e-7, "{a} {b}");
    }
}

#[test]
fn points_far_from_where_they_were_sorted_are_seen() {
    // moves all points by several cells in one step
    let start = free(FLIP);
    let nodes = start.grid.node_count();
    let mut flow = flow(law(), start.clone()).expect("within the grid");
    let mut sums = NodeSums::new(nodes);
    flow.drift(&vec![[0.3, 1.3]; nodes], 1.0)
        .expect("a sound step");
    flow.to_nodes(&mut sums).expect("within the grid");
    let mut moved = start;
    for x in &mut moved.places {
        *x = [x[0] + 0.3, x[1] + 1.3];
    }
    let mut expected = NodeSums::new(nodes);
    let mut fresh = self::flow(law(), moved).expect("within the grid");
    fresh.to_nodes(&mut expected).expect("within the grid");
    assert_near(&sums.mass, &expected.mass, "mass");
}

#[test]
fn faults_name_the_point() {
    let start = free(FLIP);
    let nodes = start.grid.node_count();
    let new = || flow(law(), start.clone()).expect("within the grid");
    let mut sums = NodeSums::new(nodes);

    let mut lost = new();
    lost.drift(&vec![[100.0, 0.0]; nodes], 1.0)
        .expect("a sound step");
    let place = match lost.to_nodes(&mut sums) {
        Err(Fault::Left { place }) => place,
        other => panic!("{other:?}"),
    };
    assert!(place[0] > 90.0);

    let mut torn = new();
    let v = linear_field(&start.grid, &[[-2.0, 0.0], [0.0, 0.0]]);
    match torn.drift(&v, 1.0) {
        Err(Fault::Inverted { determinant, .. }) => assert!((determinant + 1.0).abs() < 1e-12),
        other => panic!("{other:?}"),
    }

    let mut wild = new();
    let mut a = vec![[0.0; 2]; nodes];
    a[start.grid.node([12, 13])] = [f64::NAN, 0.0];
    match wild.kick(&vec![[0.0; 2]; nodes], &a, 1.0) {
        Err(Fault::NonFinite { place, .. }) => {
            let node = start.grid.node_place(start.grid.node([12, 13]));
            assert!((0..2).all(|i| (place[i] - node[i]).abs() < 1.5 * start.grid.h[i]));
        }
        other => panic!("{other:?}"),
    }
}
