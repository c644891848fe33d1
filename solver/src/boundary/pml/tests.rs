use super::*;

#[test]
fn default_reflections_are_those_of_the_table() {
    for (cells, r) in [
        (2.0, 1e-3),
        (5.0, 1e-3),
        (10.0, 1e-4),
        (20.0, 1e-6),
        (50.0, 1e-8),
    ] {
        assert!(
            (default_reflection(cells) / r - 1.0).abs() < 1e-12,
            "{cells}"
        );
    }
    assert!(default_reflection(15.0) < 1e-4 && default_reflection(15.0) > 1e-6);
}

#[test]
fn memory_follows_its_equation() {
    // a constant gradient from rest: phi = g/p (1 - exp(-p t))
    let c = Coefficients::<2>::new(&[3.0, 0.0], 0.0, 1e-3);
    let g = [[2.0, 1.0], [0.0, 0.0]];
    let mut phi = zero::<2>();
    for _ in 0..1000 {
        phi = c.advance(&phi, &g, &g);
    }
    assert!((phi[0][0] - 2.0 / 3.0 * (1.0 - (-3.0_f64).exp())).abs() < 1e-6);
    // without damping the memory is the plain integral
    assert!((phi[0][1] - 1.0).abs() < 1e-12);
}
