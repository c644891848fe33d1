use super::*;
use crate::tensor::{contract, trace};

/// `l` of each point with the trace of its cell's centre, both by the general discretisation.
fn mean_gradients<const D: usize>(
    flow: &dyn Flow<D>,
    start: &Start<D>,
    v: &[Vector<D>],
) -> Vec<Matrix<D>> {
    let n = flow.len();
    let mut l = vec![[[0.0; D]; D]; n];
    general(flow, start).gradient(0..n, v, &mut l);
    let centres: Vec<Vector<D>> = flow
        .places()
        .iter()
        .map(|x| {
            let (cell, _) = start.grid.locate(x).expect("within the grid");
            let (origin, h) = (&start.grid.origin, &start.grid.h);
            std::array::from_fn(|a| origin[a] + h[a] * (cell[a] as f64 + 0.5))
        })
        .collect();
    let mut linear = on_grid(BasisKind::Linear, &start.grid, 2);
    linear.place(&centres).expect("within the grid");
    let mut at_centre = l.clone();
    linear.gradient(0..n, v, &mut at_centre);
    for (l, centre) in l.iter_mut().zip(&at_centre) {
        let more = (trace(centre) - trace(l)) / D as f64;
        for i in 0..D {
            l[i][i] += more;
        }
    }
    l
}

#[test]
fn points_take_the_divergence_of_their_cell() {
    for basis in KINDS {
        check_stress::<2>(cloud(basis, FLIP));
        check_stress::<3>(cloud(basis, FLIP));
    }
}

fn check_stress<const D: usize>(mut start: Start<D>)
where
    LinearElastic: Law<D>,
{
    start.mean_volumes = true;
    let mut flow = flow(law(), start.clone()).expect("within the grid");
    let v = field(start.grid.node_count(), 0.3);
    let l = mean_gradients(flow.as_ref(), &start, &v);
    let mut stress = stresses(flow.as_ref());
    for (stress, l) in stress.iter_mut().zip(&l) {
        let mut state = law().prestressed(stress);
        Law::<D>::advance(&law(), l, 1e-3, &mut state);
        *stress = Law::<D>::stress(&law(), &state);
    }
    flow.drift(&v, 1e-3).expect("a sound step");
    let got = stresses(flow.as_ref());
    let (got, expected) = (got.as_flattened(), stress.as_flattened());
    assert_near(got.as_flattened(), expected.as_flattened(), "stress");
}

#[test]
fn forces_do_the_work_of_the_stress() {
    for basis in KINDS {
        check_work::<2>(cloud(basis, FLIP));
        check_work::<3>(cloud(basis, FLIP));
    }
}

fn check_work<const D: usize>(mut start: Start<D>)
where
    LinearElastic: Law<D>,
{
    start.mean_volumes = true;
    let mut flow = flow(law(), start.clone()).expect("within the grid");
    let nodes = start.grid.node_count();
    let mut sums = NodeSums::new(nodes);
    flow.to_nodes(&mut sums).expect("within the grid");
    let v = field::<D>(nodes, 0.3);
    let l = mean_gradients(flow.as_ref(), &start, &v);
    let (forces, velocities) = (sums.force.as_flattened(), v.as_flattened());
    let power: f64 = forces.iter().zip(velocities).map(|(f, v)| f * v).sum();
    let stress = stresses(flow.as_ref());
    let work: Vec<f64> = stress.iter().zip(&l).map(|(s, l)| contract(s, l)).collect();
    let scale: f64 = work.iter().map(|w| w.abs()).sum();
    let expected: f64 = work.iter().sum();
    assert!((power + start.volume * expected).abs() < 1e-12 * start.volume * scale);
}
