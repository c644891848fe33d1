use super::*;
use crate::tensor::{contract, trace};

/// `l` of each point with the trace of its cell's centre, both by the general discretisation; its own trace
/// in cells with a node of less than a tenth of a full cell's mass, if there are `masses`.
fn mean_gradients<const D: usize>(
    flow: &dyn Flow<D>,
    start: &Start<D>,
    v: &[Vector<D>],
    masses: Option<&[f64]>,
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
    let full = start.density * start.grid.h.iter().product::<f64>();
    let is_thin = |x: &Vector<D>| {
        let (cell, _) = start.grid.locate(x).expect("within the grid");
        let corner = |k: usize| {
            start
                .grid
                .node(std::array::from_fn(|a| cell[a] + (k >> a & 1)))
        };
        masses.is_some_and(|masses| (0..1 << D).any(|k| masses[corner(k)] < 0.1 * full))
    };
    let points = l.iter_mut().zip(&at_centre).zip(flow.places());
    for ((l, centre), _) in points.filter(|(_, x)| !is_thin(x)) {
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
    let l = mean_gradients(flow.as_ref(), &start, &v, None);
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
    let l = mean_gradients(flow.as_ref(), &start, &v, Some(&sums.mass));
    let (forces, velocities) = (sums.force.as_flattened(), v.as_flattened());
    let power: f64 = forces.iter().zip(velocities).map(|(f, v)| f * v).sum();
    let stress = stresses(flow.as_ref());
    let work: Vec<f64> = stress.iter().zip(&l).map(|(s, l)| contract(s, l)).collect();
    let scale: f64 = work.iter().map(|w| w.abs()).sum();
    let expected: f64 = work.iter().sum();
    assert!((power + start.volume * expected).abs() < 1e-12 * start.volume * scale);
}

/// A lone pressed point near a node: its functions give the farthest corners of its cell a sixtieth of its
/// mass, and its pressure would turn them around in a step. Alone in a thin cell it keeps its own
/// divergence, swings and springs back, at Courant numbers up to 0.4.
#[test]
fn what_splashes_does_not_blow_up() {
    for courant in [0.2, 0.4] {
        let grid = grid::<2>();
        let h = grid.h.into_iter().fold(f64::INFINITY, f64::min);
        let place = std::array::from_fn(|a| grid.origin[a] + (2.0 + 1e-3) * grid.h[a]);
        let start = Start {
            places: vec![place],
            velocities: vec![[0.0; 2]],
            stress: Some(vec![[[-1.0, 0.0], [0.0, -1.0]]]),
            mean_volumes: true,
            ..cloud(BasisKind::Bspline, Carry::Affine)
        };
        let mut flow = flow(law(), start.clone()).expect("within the grid");
        let mut sums = NodeSums::new(grid.node_count());
        let dt = courant * h / ELASTIC.p_speed();
        let mut largest = 0.0_f64;
        for _ in 0..200 {
            sums.clear();
            flow.to_nodes(&mut sums).expect("within the grid");
            let per_mass = |x: &[Vector<2>]| -> Vec<Vector<2>> {
                let nodes = x.iter().zip(&sums.mass);
                let over = |(x, m): (&Vector<2>, &f64)| match *m > 0.0 {
                    true => x.map(|x| x / m),
                    false => [0.0; 2],
                };
                nodes.map(over).collect()
            };
            let a = per_mass(&sums.force);
            let mut v = per_mass(&sums.momentum);
            for (v, a) in v.iter_mut().zip(&a) {
                *v = std::array::from_fn(|i| v[i] + dt * a[i]);
            }
            flow.to_points(&v, &a, dt).expect("a sound step");
            largest = largest.max(trace(&stresses(flow.as_ref())[0]).abs());
        }
        println!(
            "Courant {courant}: pressure up to {:.2} of its start",
            0.5 * largest
        );
        assert!(largest < 2.0 * 1.5, "{largest}");
    }
}
