use super::*;
use crate::tensor::{add_scaled, contract, mul, mul_transposed};

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
    let turned = mul_transposed(&mul(&r, &stress), &r);
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
        points.fill_cell(&lower, &grid.h, 2, None, 2.0);
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
                mean_volumes: false,
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
