use super::super::along::{Along, fold};
use super::super::{bspline::QuadraticBSpline, gimp::Gimp, linear::Linear};
use super::*;

/// Calls a check with each basis, on a cloud of points that reaches into all corners of a grid.
macro_rules! with_each_basis {
    ($check:ident) => {{
        $check(cloud(Linear));
        $check(cloud(Gimp::new(2)));
        $check(cloud(Gimp::new(1)));
        $check(cloud(QuadraticBSpline));
    }};
}

type Cloud<B> = (GridDiscretisation<B, 2>, Vec<Vector<2>>);

fn cloud<B: Basis>(basis: B) -> Cloud<B> {
    let grid = Grid {
        origin: [-1.0, 0.5],
        h: [0.5; 2],
        cells: [4, 3],
    };
    let places: Vec<Vector<2>> = (0..40)
        .map(|k| {
            let k = k as f64;
            [
                -1.0 + 2.0 * (0.37 * k).fract(),
                0.5 + 1.5 * (0.61 * k + 0.1).fract(),
            ]
        })
        .collect();
    let mut disc = GridDiscretisation::new(grid, basis, 4);
    disc.place(&places).expect("the cloud lies within the grid");
    (disc, places)
}

#[test]
fn gradient_of_a_linear_field_is_exact_on_any_cloud() {
    with_each_basis!(check_gradient);
}

fn check_gradient<B: Basis>((disc, places): Cloud<B>) {
    let field: Vec<Vector<2>> = (0..disc.node_count())
        .map(|n| disc.grid.node_place(n))
        .map(|x| [1.0 + 2.0 * x[0] - 3.0 * x[1], 0.5 * x[0] + 4.0 * x[1]])
        .collect();
    let mut gradients = vec![[[0.0; 2]; 2]; places.len()];
    let mut values = vec![[0.0; 2]; places.len()];
    disc.gradient(0..places.len(), &field, &mut gradients);
    disc.gather(0..places.len(), &field, &mut values);
    for ((g, v), x) in gradients.iter().zip(&values).zip(&places) {
        for (got, expected) in g.as_flattened().iter().zip([2.0, -3.0, 0.5, 4.0]) {
            assert!((got - expected).abs() < 1e-12);
        }
        assert!((v[0] - (1.0 + 2.0 * x[0] - 3.0 * x[1])).abs() < 1e-12);
    }
}

#[test]
fn scatters_conserve_mass_and_momentum() {
    with_each_basis!(check_scatters);
}

fn check_scatters<B: Basis>((disc, places): Cloud<B>) {
    let n = places.len();
    let mass: Vec<f64> = (0..n).map(|k| 1.0 + 0.1 * k as f64).collect();
    let v: Vec<Vector<2>> = places.iter().map(|x| [x[1], -x[0]]).collect();
    let l = vec![[[0.3, -0.7], [0.2, 0.9]]; n];
    let mut nodal = vec![0.0; disc.node_count()];
    let mut momentum = vec![[0.0; 2]; disc.node_count()];
    disc.scatter_scalar(0..n, &mass, &mut nodal);
    disc.scatter_affine(0..n, &mass, &v, &l, &places, &mut momentum);
    assert!((nodal.iter().sum::<f64>() - mass.iter().sum::<f64>()).abs() < 1e-11);
    for i in 0..2 {
        let nodes: f64 = momentum.iter().map(|p| p[i]).sum();
        let points: f64 = mass.iter().zip(&v).map(|(m, v)| m * v[i]).sum();
        assert!((nodes - points).abs() < 1e-11);
    }
}

#[test]
fn tangent_is_the_derivative_of_the_internal_force() {
    with_each_basis!(check_tangent);
}

fn check_tangent<B: Basis>((disc, places): Cloud<B>) {
    let n = places.len();
    let volumes: Vec<f64> = (0..n).map(|k| 0.01 * (1 + k % 3) as f64).collect();
    let mut a: Tensor4<2> = Default::default();
    for (k, x) in a
        .as_flattened_mut()
        .as_flattened_mut()
        .as_flattened_mut()
        .iter_mut()
        .enumerate()
    {
        *x = 1.0 + 0.3 * k as f64;
    }
    let mut matrix = BlockMatrix::zeros(disc.pattern());
    disc.scatter_tangent(0..n, &volumes, &vec![a; n], &mut matrix);
    let u: Vec<Vector<2>> = (0..disc.node_count())
        .map(|k| [(k as f64).sin(), (1.7 * k as f64).cos()])
        .collect();
    let mut g = vec![[[0.0; 2]; 2]; n];
    disc.gradient(0..n, &u, &mut g);
    let stress: Vec<Matrix<2>> = g
        .iter()
        .map(|g| {
            std::array::from_fn(|i| std::array::from_fn(|j| crate::tensor::contract(&a[i][j], g)))
        })
        .collect();
    let (mut force, mut image) = (vec![[0.0; 2]; u.len()], vec![[0.0; 2]; u.len()]);
    disc.scatter_stress(0..n, &volumes, &stress, &mut force);
    matrix.apply(&u, &mut image);
    for (f, k) in force.iter().zip(&image) {
        assert!((f[0] - k[0]).abs() < 1e-11 && (f[1] - k[1]).abs() < 1e-11);
    }
}

#[test]
fn functions_are_the_hats_averaged_over_the_point() {
    // GIMP by its definition: the hat's mean over the point, here by many midpoints
    let basis = Gimp::new(2);
    for s in [3.01, 3.2, 3.25, 3.4, 3.5, 3.77, 3.99] {
        let along = basis.point(s, 8);
        let samples = 20_000;
        for (k, value) in along.values.iter().enumerate() {
            let node = (along.first + k as i32) as f64;
            let mean: f64 = (0..samples)
                .map(|i| s - 0.25 + 0.5 * (f64::from(i) + 0.5) / f64::from(samples))
                .map(|x| (1.0 - (x - node).abs()).max(0.0))
                .sum::<f64>()
                / f64::from(samples);
            assert!((value - mean).abs() < 1e-8, "{s} {k}: {value} {mean}");
        }
    }
}

#[test]
fn slopes_are_the_derivatives_and_cross_faces_without_a_jump() {
    fn check(basis: impl Basis) {
        let d = 1e-6;
        // beside faces and knots, and at the ends of the grid
        for s in [0.1, 0.3, 0.6, 1.3, 2.0 - 1e-4, 2.0 + 1e-4, 2.7, 5.55, 5.9] {
            let at = |s: f64| fold(basis.point(s, 6), 3, 6);
            let (low, mid, high) = (at(s - d), at(s), at(s + d));
            assert_eq!(low.first, high.first);
            for k in 0..3 {
                let slope = (high.values[k] - low.values[k]) / (2.0 * d);
                assert!((slope - mid.slopes[k]).abs() < 1e-5, "{s} {k}");
            }
        }
        let [below, above] = [1.0 - 1e-9, 1.0 + 1e-9].map(|s| fold(basis.point(s, 6), 3, 6));
        for node in 0..3 {
            let slope = |a: &Along| a.slopes[(node - a.first) as usize];
            assert!((slope(&below) - slope(&above)).abs() < 1e-8);
        }
    }
    check(Gimp::new(2));
    check(QuadraticBSpline);
}

#[test]
fn a_side_of_the_grid_is_interpolated_by_its_own_nodes() {
    fn check<B: Basis>((disc, _): Cloud<B>) {
        for x in [[-1.0, 0.9], [1.0, 1.3]] {
            let sample = disc.sample(&x);
            for (&node, &w) in sample.nodes.iter().zip(&sample.weights) {
                let on_side = disc.grid.node_place(node as usize)[0] == x[0];
                assert!(on_side || w.abs() < 1e-15, "{}", B::NAME);
            }
        }
    }
    with_each_basis!(check);
}

#[test]
fn functions_are_not_negative_within_the_grid() {
    fn check<B: Basis>((disc, _): Cloud<B>) {
        assert!(disc.values.iter().all(|n| *n >= 0.0), "{}", B::NAME);
    }
    with_each_basis!(check);
}
