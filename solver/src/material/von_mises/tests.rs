use super::*;
use crate::material::flow::tests::{CLAY, S_U, full, path, plane, root_j2};

fn law() -> VonMises {
    VonMises::new(&CLAY, S_U)
}

/// The elastic constants as the tests write them: bulk and shear modulus (Pa).
fn bulk_and_shear() -> (f64, f64) {
    let (e, nu) = (CLAY.youngs_modulus, CLAY.poissons_ratio);
    (e / (3.0 * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)))
}

#[test]
fn no_path_leaves_the_surface_and_only_the_deviator_yields() {
    let mut state = [0.0; 4];
    let (bulk, _) = bulk_and_shear();
    let (dt, mut volume, mut yielding) = (1e-3, 0.0, 0);
    for l in path(400, 4.0) {
        law().advance(&plane(&l), dt, &mut state);
        let l = plane(&l);
        volume += ((1.0 + dt * l[0][0]) * (1.0 + dt * l[1][1]) - dt * dt * l[0][1] * l[1][0]).ln();
        let shear = root_j2(&full(state));
        assert!(shear < S_U * (1.0 + 1e-12), "{shear}");
        yielding += usize::from(shear > S_U * (1.0 - 1e-9));
    }
    assert!((100..400).contains(&yielding), "{yielding}");
    let mean = (state[0] + state[1] + state[3]) / 3.0;
    // The mid-point's trace is ln J to third order in increments of 4e-3: at most 1e-8 a step.
    assert!(volume.abs() > 1e-3);
    assert!(
        (mean - bulk * volume).abs() < 400.0 * 1e-8 * bulk,
        "{mean} {volume}"
    );
}

#[test]
fn below_yield_it_is_elastic_and_gives_all_back() {
    let mut state = [0.0; 4];
    let rate = 0.45 * S_U / bulk_and_shear().1;
    let dt = 0.01;
    for _ in 0..100 {
        law().advance(&[[0.0, rate], [rate, 0.0]], dt, &mut state);
    }
    assert!((state[2] / (0.9 * S_U) - 1.0).abs() < 1e-4);
    // The way back: (I + A)^-1 - I for each step.
    let a = rate * dt;
    let back = [[a * a, -a], [-a, a * a]].map(|row| row.map(|x: f64| x / (1.0 - a * a) / dt));
    for _ in 0..100 {
        law().advance(&back, dt, &mut state);
    }
    assert!(state.iter().all(|s| s.abs() < 1e-8 * S_U), "{state:?}");
}

/// With dtau/dt = W tau - tau W + 2 G (D - D_p), the flow of simple shear comes to rest at
/// xx = -yy = s_u^2/G, xy = s_u sqrt(1 - (s_u/G)^2).
#[test]
fn simple_shear_ends_at_the_shear_strength() {
    let (_, shear) = bulk_and_shear();
    let mut state = [0.0; 4];
    for _ in 0..4000 {
        law().advance(&[[0.0, 1.0], [0.0, 0.0]], 1e-4, &mut state);
    }
    let lean = S_U / shear;
    assert!((state[2] / (S_U * (1.0 - lean * lean).sqrt()) - 1.0).abs() < 1e-6);
    assert!((state[2] / S_U - 1.0).abs() < 1e-4);
    assert!((state[0] / (S_U * lean) - 1.0).abs() < 0.02, "{state:?}");
    assert!((state[0] + state[1]).abs() < 1e-3 * S_U);
}

/// Squeezed along y between planes that hold z, free along x: the velocity along x is sought in
/// every step so that xx stays zero.
#[test]
fn plane_strain_compression_ends_at_twice_the_strength() {
    let mut state = [0.0; 4];
    let dt = 1e-4;
    let mut half_way = 0.0;
    for step in 0..1000 {
        let after = |rate: f64| {
            let mut next = state;
            law().advance(&[[rate, 0.0], [0.0, -1.0]], dt, &mut next);
            next
        };
        let (mut low, mut high) = (-2.0, 4.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if after(middle)[0] > 0.0 {
                high = middle;
            } else {
                low = middle;
            }
        }
        state = after(0.5 * (low + high));
        assert!(state[0].abs() < 1e-6 * S_U);
        if step == 5 {
            half_way = state[1];
        }
    }
    // At 6e-4 of strain the difference of stresses is that of plane strain elasticity, E/(1 - nu^2).
    let plane_modulus = CLAY.youngs_modulus / (1.0 - CLAY.poissons_ratio.powi(2));
    assert!((half_way / (-6e-4 * plane_modulus) - 1.0).abs() < 2e-3);
    assert!((state[1] / (-2.0 * S_U) - 1.0).abs() < 1e-6, "{state:?}");
}

/// A frame that turns sees the same material: with F* = Q1 F Q0^T the stress must be Q tau Q^T, which
/// the mid-point rule gives exactly for the rotation alone and to second order beside a stretch.
#[test]
fn a_turning_frame_sees_the_same_stress() {
    let turn = |angle: f64| {
        let (s, c) = angle.sin_cos();
        [[c, -s], [s, c]]
    };
    let error = |steps: usize| {
        let dt = 1.0 / steps as f64;
        let (mut still, mut turned) = ([0.0; 4], [0.0; 4]);
        for step in 0..steps {
            let l = [[0.004, 0.003], [0.001, -0.006]];
            law().advance(&l, dt, &mut still);
            let angle = |n: usize| 1.2 * n as f64 * dt;
            let f = [
                [1.0 + dt * l[0][0], dt * l[0][1]],
                [dt * l[1][0], 1.0 + dt * l[1][1]],
            ];
            let (q0, q1) = (turn(angle(step)), turn(angle(step + 1)));
            let product = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| {
                let entry = |i: usize, j: usize| a[i][0] * b[0][j] + a[i][1] * b[1][j];
                [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]]
            };
            let back = [[q0[0][0], q0[1][0]], [q0[0][1], q0[1][1]]];
            let seen = product(product(q1, f), back);
            let rates = [
                [(seen[0][0] - 1.0) / dt, seen[0][1] / dt],
                [seen[1][0] / dt, (seen[1][1] - 1.0) / dt],
            ];
            law().advance(&rates, dt, &mut turned);
        }
        let (s, c) = 1.2_f64.sin_cos();
        let [xx, yy, xy, zz] = still;
        let expected = [
            c * c * xx - 2.0 * s * c * xy + s * s * yy,
            s * s * xx + 2.0 * s * c * xy + c * c * yy,
            s * c * (xx - yy) + (c * c - s * s) * xy,
            zz,
        ];
        assert!(root_j2(&full(still)) > 0.999 * S_U);
        let off = turned.iter().zip(expected).map(|(a, b)| (a - b).abs());
        off.fold(0.0, f64::max) / S_U
    };
    let (coarse, fine) = (error(100), error(200));
    assert!(coarse < 1e-3, "{coarse}");
    assert!((coarse / fine).log2() > 1.8, "{coarse} {fine}");
}

#[test]
fn plane_strain_in_three_dimensions_is_the_same() {
    let (mut flat, mut solid) = ([0.0; 4], [0.0; 6]);
    for l in path(300, 4.0) {
        let flat_l = plane(&l);
        let solid_l = [[l[0][0], l[0][1], 0.0], [l[1][0], l[1][1], 0.0], [0.0; 3]];
        law().advance(&flat_l, 1e-3, &mut flat);
        law().advance(&solid_l, 1e-3, &mut solid);
        let [xx, yy, xy, zz] = flat;
        for (own, other) in solid.iter().zip([xx, yy, zz, xy, 0.0, 0.0]) {
            assert!((own - other).abs() < 1e-8 * S_U, "{flat:?} {solid:?}");
        }
    }
}

#[test]
fn paths_in_three_dimensions_meet_the_surface_too() {
    let mut state = [0.0; 6];
    let mut yielding = 0;
    for l in path(400, 4.0) {
        law().advance(&l, 1e-3, &mut state);
        let shear = root_j2(&Law::<3>::stress(&law(), &state));
        assert!(shear < S_U * (1.0 + 1e-12));
        yielding += usize::from(shear > S_U * (1.0 - 1e-9));
    }
    assert!(yielding > 100, "{yielding}");
}

/// Work of the mean stress on the step's strain, less what the elastic energy takes: never negative,
/// and zero where the step is elastic. The strain is that of the mid-point, written out again.
#[test]
fn flow_takes_energy_and_never_gives_any() {
    let mut state = [0.0; 6];
    let (dt, mut taken) = (1e-3, 0.0);
    for l in path(400, 4.0) {
        // Without spin the mean of the stresses before and after is what works.
        let mut strain = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..3 {
                strain[i][j] = 0.5 * (l[i][j] + l[j][i]);
            }
        }
        let before = (
            Law::<3>::stress(&law(), &state),
            Law::<3>::energy_density(&law(), &state),
        );
        law().advance(&strain, dt, &mut state);
        let after = Law::<3>::stress(&law(), &state);
        let mut work = 0.0;
        for i in 0..3 {
            for j in 0..3 {
                work += 0.5 * (before.0[i][j] + after[i][j]) * strain[i][j] * dt;
            }
        }
        let loss = work - (Law::<3>::energy_density(&law(), &state) - before.1);
        // The mid-point's strain departs from dt D in second order: 4e-3 of the step's work.
        assert!(loss > -0.01 * work.abs() - 1e-12, "{loss} of {work}");
        taken += loss;
    }
    assert!(taken > 0.5 * S_U * 0.1, "{taken}");
}

#[test]
fn no_strain_changes_nothing() {
    let mut state = [1e3, -500.0, 200.0, 300.0];
    let before = state;
    law().advance(&[[0.0; 2]; 2], 1e-3, &mut state);
    assert_eq!(state, before);
    let mut rest = [0.0; 6];
    law().advance(&[[0.0; 3]; 3], 1e-3, &mut rest);
    assert_eq!(rest, [0.0; 6]);
}

#[test]
fn the_wave_modulus_is_that_of_the_constants() {
    let (bulk, shear) = bulk_and_shear();
    let modulus = Law::<2>::p_modulus(&law());
    assert!((modulus / (bulk + 4.0 / 3.0 * shear) - 1.0).abs() < 1e-12);
}
