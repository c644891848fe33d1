use super::*;

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
    for carry in [AFFINE, FLIP] {
        let mut start = free(carry);
        start.mean_volumes = carry == FLIP;
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
    let start = free(AFFINE);
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
    for mean_volumes in [false, true] {
        check_faults(Start {
            mean_volumes,
            ..free(FLIP)
        });
    }
}

fn check_faults(start: Start<2>) {
    let nodes = start.grid.node_count();
    let new = || flow(law(), start.clone()).expect("within the grid");
    let mut sums = NodeSums::new(nodes);

    let mut lost = new();
    lost.drift(&vec![[100.0, 0.0]; nodes], 1.0)
        .expect("a sound step");
    let left = lost.to_nodes(&mut sums);
    assert!(
        matches!(left, Err(Fault::Left { place }) if place[0] > 90.0),
        "{left:?}"
    );

    let mut torn = new();
    let v = linear_field(&start.grid, &[[-2.0, 0.0], [0.0, 0.0]]);
    let drifted = torn.drift(&v, 1.0);
    assert!(
        matches!(drifted, Err(Fault::Inverted { determinant, .. }) if (determinant + 1.0).abs() < 1e-12),
        "{drifted:?}"
    );

    let mut wild = new();
    let mut a = vec![[0.0; 2]; nodes];
    a[start.grid.node([12, 13])] = [f64::NAN, 0.0];
    let kicked = wild.kick(&vec![[0.0; 2]; nodes], &a, 1.0);
    let node = start.grid.node_place(start.grid.node([12, 13]));
    let near =
        |place: &Vector<2>| (0..2).all(|i| (place[i] - node[i]).abs() < 1.5 * start.grid.h[i]);
    assert!(
        matches!(&kicked, Err(Fault::NonFinite { field: "velocity", place }) if near(place)),
        "{kicked:?}"
    );
}
