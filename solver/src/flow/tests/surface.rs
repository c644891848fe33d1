use super::*;
use crate::flow::surface::Surface;
use crate::points::Points;

/// A rectangle of full cells of two points an axis, its sides `off` cells from the cells' faces.
fn rectangle(basis: BasisKind, off: f64) -> Start<2> {
    let grid = Grid {
        origin: [0.0; 2],
        h: [0.5, 0.25],
        cells: [12, 14],
    };
    let mut points = Points::<2>::default();
    for (i, j) in (4..9).flat_map(|i| (3..10).map(move |j| (i, j))) {
        let lower = [grid.h[0] * (i as f64 + off), grid.h[1] * (j as f64 - off)];
        points.fill_cell(&lower, &grid.h, 2, None, 2.0);
    }
    let places = points.place;
    Start {
        velocities: places.iter().map(|x| [1.0 + x[1], x[0] * x[1]]).collect(),
        stress: Some(places.iter().map(|x| [[x[0], 0.3], [0.3, x[1]]]).collect()),
        volume: points.volume[0],
        basis,
        per_axis: 2,
        density: 2.0,
        carry: FLIP,
        mean_volumes: false,
        shared: false,
        grid,
        places,
    }
}

/// Sums of a body and what they are once faint nodes have been folded.
fn folded(start: &Start<2>) -> (NodeSums<2>, NodeSums<2>, Surface<2>, Box<dyn Flow<2>>) {
    let mut flow = flow(law(), start.clone()).expect("within the grid");
    let mut sums = NodeSums::new(start.grid.node_count());
    flow.to_nodes(&mut sums).expect("within the grid");
    let mut surface = Surface::new(&start.grid, 4.0 * start.density * start.volume);
    let whole = sums.clone();
    surface.fold(&mut sums);
    (whole, sums, surface, flow)
}

#[test]
fn faint_nodes_are_those_of_the_general_discretisation() {
    for (basis, off) in [(BasisKind::Bspline, 0.13), (BasisKind::Gimp, 0.05)] {
        let start = rectangle(basis, off);
        let (_, sums, surface, flow) = folded(&start);
        // beyond two sides and the corners between
        assert!(surface.len() > 12, "{}", surface.len());
        let n = flow.len();
        let disc = general(flow.as_ref(), &start);
        let mut expected = NodeSums::new(start.grid.node_count());
        let mass = vec![flow.point_mass(); n];
        disc.scatter_scalar(0..n, &mass, &mut expected.mass);
        disc.scatter_vector(0..n, &mass, flow.velocities(), &mut expected.momentum);
        let volumes = vec![-start.volume; n];
        let stress = stresses(flow.as_ref());
        disc.scatter_stress(0..n, &volumes, &stress, &mut expected.force);
        let pick = |sums: &NodeSums<2>| -> Vec<f64> {
            let nodes = (0..sums.mass.len()).filter(|&node| {
                // beyond corners the general discretisation asks for less: it looks along axes only, and
                // where both sides just reach nodes that are not faint it leaves the node beyond
                let index = start.grid.lattice(node);
                (6..8).contains(&index[0]) || (5..9).contains(&index[1])
            });
            let all = |n: usize| [[sums.mass[n], 0.0], sums.momentum[n], sums.force[n]];
            nodes.flat_map(|n| all(n).into_iter().flatten()).collect()
        };
        assert_near(&pick(&sums), &pick(&expected), &format!("{basis:?}"));
    }
}

#[test]
fn following_is_the_adjoint_of_folding() {
    let mut corner = rectangle(BasisKind::Bspline, 0.13);
    // light nodes next to ends and corners
    corner.places = vec![[2.3, 0.01], [0.01, 0.02], [5.99, 3.49], [3.1, 3.49]];
    corner.velocities.truncate(4);
    corner.stress = Some(vec![[[1.0, 0.3], [0.3, -2.0]]; 4]);
    for start in [rectangle(BasisKind::Bspline, 0.13), corner] {
        let (whole, sums, surface, _) = folded(&start);
        let v = field::<2>(start.grid.node_count(), 0.7);
        let mut following = v.clone();
        surface.follow(&mut following);
        let power = |f: &[Vector<2>], v: &[Vector<2>]| -> f64 {
            let pairs = f.as_flattened().iter().zip(v.as_flattened());
            pairs.map(|(f, v)| f * v).sum()
        };
        for (whole, sums) in [
            (&whole.force, &sums.force),
            (&whole.momentum, &sums.momentum),
        ] {
            let (expected, got) = (power(whole, &following), power(sums, &v));
            assert!((expected - got).abs() < 1e-12);
        }
        let mut again = whole.momentum.clone();
        surface.fold_field(&mut again);
        assert_eq!(again, sums.momentum);
        assert_ne!(sums.mass, whole.mass);
    }
}

#[test]
fn following_keeps_linear_fields() {
    let start = rectangle(BasisKind::Gimp, 0.05);
    let (_, _, surface, _) = folded(&start);
    let linear = linear_field(&start.grid, &[[0.2, -0.3], [0.7, 1.1]]);
    let mut following = linear.clone();
    surface.follow(&mut following);
    assert_near(following.as_flattened(), linear.as_flattened(), "velocity");
}

#[test]
fn folding_keeps_the_mass_and_empties_no_node() {
    let mut start = rectangle(BasisKind::Bspline, 0.0);
    for turn in 0..200 {
        // two points somewhere
        start.places = (2 * turn..2 * turn + 2)
            .map(|k| [6.0 * fraction(k, 0), 3.5 * fraction(k, 1)])
            .collect();
        start.velocities.truncate(2);
        start.stress = None;
        let (whole, sums, _, _) = folded(&start);
        assert!(sums.mass.iter().all(|m| *m >= 0.0));
        let total = |sums: &NodeSums<2>| sums.mass.iter().sum::<f64>();
        assert_near(&[total(&sums)], &[total(&whole)], "mass");
    }
}

/// Ragged clouds of sixteen points a cell: where chains of faint nodes lean on each other, those at their ends take
/// from no node more than it can spare. A node that is left with hardly any mass, or less than none, has a velocity
/// without bound.
#[test]
fn no_chain_of_nodes_takes_more_than_there_is() {
    let mut start = rectangle(BasisKind::Bspline, 0.0);
    let mut surface = Surface::new(&start.grid, 16.0 * start.density * start.volume);
    let mut seed = 1u32;
    let mut random = || {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(seed >> 8) / f64::from(1 << 24)
    };
    let mut worst = f64::INFINITY;
    for _ in 0..1000 {
        // cells that are empty, full, or have a point of their own
        start.places.clear();
        for (i, j) in (1..11).flat_map(|i| (1..13).map(move |j| (f64::from(i), f64::from(j)))) {
            let points = [0, 0, 1, 16][(4.0 * random()) as usize];
            let place = |_| [0.5 * (i + random()), 0.25 * (j + random())];
            start.places.extend((0..points).map(place));
        }
        start.velocities = vec![[0.0; 2]; start.places.len()];
        start.stress = None;
        let mut flow = flow(law(), start.clone()).expect("within the grid");
        let mut sums = NodeSums::new(start.grid.node_count());
        flow.to_nodes(&mut sums).expect("within the grid");
        let whole = sums.mass.clone();
        surface.fold(&mut sums);
        let pairs = whole.iter().zip(&sums.mass);
        let kept = pairs.filter(|(_, after)| **after != 0.0);
        let least = kept.map(|(before, after)| after / before);
        worst = least.fold(worst, f64::min);
    }
    println!("a node keeps {worst:.3} of its mass at least");
    assert!(worst >= 0.5, "{worst}");
}

/// A body one cell from the grid's end, whose faint nodes are the end's own: what holds them along the normal holds
/// them still once nodes have followed.
#[test]
fn nodes_on_an_end_do_not_follow_along_its_normal() {
    let mut start = rectangle(BasisKind::Bspline, 0.13);
    start.grid.cells[1] = 11;
    let (whole, _, surface, _) = folded(&start);
    let v = field::<2>(start.grid.node_count(), 0.7);
    let mut following = v.clone();
    surface.follow(&mut following);
    for i in 5..9 {
        let node = start.grid.node([i, 11]);
        assert!(whole.mass[node] > 0.0 && whole.mass[node] < 5e-3 * 2.0 * 0.125);
        assert_eq!(following[node], v[node]);
    }
}
