use super::*;
use crate::material::flow::tests::{full, path, plane, root_j2};

/// The slide of the mudmat: E = 300 s_u0, nu = 0.49.
const SLIDE: Elastic = Elastic {
    youngs_modulus: 1.5e5,
    poissons_ratio: 0.49,
    density: 1500.0,
};
const STRENGTH: RateStrength = RateStrength {
    s_u0: 500.0,
    viscosity: 0.65,
    index: 0.4,
    reference_rate: 0.06,
};
/// Strength (Pa) at 0, 1, 10 and 100 times the reference rate: 500 (1 + 0.65 k^0.4), by hand.
const BY_HAND: [(f64, f64); 4] = [
    (0.0, 500.0),
    (0.06, 825.0),
    (0.6, 1316.363),
    (6.0, 2550.611),
];

fn law() -> HerschelBulkley {
    HerschelBulkley::new(&SLIDE, STRENGTH)
}

#[test]
fn strength_is_that_computed_by_hand() {
    for (rate, strength) in BY_HAND {
        assert!((STRENGTH.at(rate) / strength - 1.0).abs() < 1e-6, "{rate}");
    }
}

/// Both motions shear at the same rate: x' = rate y, and a stretch along x of half of it with a
/// shortening along y.
#[test]
fn flow_at_a_rate_ends_at_its_strength() {
    for (rate, strength) in &BY_HAND[1..] {
        let gradients = [
            [[0.0, *rate], [0.0, 0.0]],
            [[0.5 * rate, 0.0], [0.0, -0.5 * rate]],
        ];
        for l in gradients {
            let mut state = [0.0; 4];
            for _ in 0..4000 {
                law().advance(&l, 1e-4 / rate, &mut state);
            }
            let [xx, yy, xy, _] = state;
            let shear = (0.5 * (xx - yy)).hypot(xy);
            assert!((shear / strength - 1.0).abs() < 1e-6, "{l:?}: {shear}");
        }
    }
}

#[test]
fn a_rotation_is_no_shear() {
    let mut state = [600.0, -600.0, 0.0, 0.0];
    // A quarter turn each second, in a thousand steps: each is the motion's gradient less the unit.
    let dt = 1e-3;
    let (s, c) = (0.5 * std::f64::consts::PI * dt).sin_cos();
    let l = [[(c - 1.0) / dt, -s / dt], [s / dt, (c - 1.0) / dt]];
    law().advance(&l, dt, &mut state);
    assert!(
        (root_j2(&full(state)) / 500.0 - 1.0).abs() < 1e-9,
        "{state:?}"
    );
}

#[test]
fn motion_that_stops_leaves_the_strength_at_rest() {
    let mut state = [0.0; 4];
    for _ in 0..100 {
        law().advance(&[[0.0, 6.0], [0.0, 0.0]], 1e-3, &mut state);
    }
    assert!((root_j2(&full(state)) / 2550.611 - 1.0).abs() < 1e-6);
    law().advance(&[[0.0; 2]; 2], 1e-3, &mut state);
    assert!((root_j2(&full(state)) / 500.0 - 1.0).abs() < 1e-12);
}

#[test]
fn rest_and_small_stress_stay_finite_and_elastic() {
    let mut state = [0.0; 4];
    law().advance(&[[0.0; 2]; 2], 1e-4, &mut state);
    assert_eq!(state, [0.0; 4]);
    // Fast, but over so little strain that the stress is below the strength at rest.
    law().advance(&[[0.0, 100.0], [0.0, 0.0]], 1e-5, &mut state);
    let shear = 1.5e5 / (2.0 * 1.49);
    assert!((state[2] / (shear * 1e-3) - 1.0).abs() < 1e-5, "{state:?}");
}

/// Whatever the length of the step, stress ends at or below the strength of its rate, written out
/// from Eq (8) and (9) again.
#[test]
fn steps_of_any_length_end_on_the_surface_or_inside() {
    for (dt, wide) in [(1e-5, 1.0), (1e-3, 1.002), (0.1, 1.2)] {
        let mut state = [0.0; 4];
        let mut yielding = 0;
        for l in path(300, 4.0) {
            let l = plane(&l);
            law().advance(&l, dt, &mut state);
            let rate = ((l[0][0] - l[1][1]).powi(2) + (l[0][1] + l[1][0]).powi(2)).sqrt();
            let strength = 500.0 * (1.0 + 0.65 * (rate / 0.06).powf(0.4));
            let shear = root_j2(&full(state));
            // `wide`: the mid-point's rate departs from that of the start by a share of dt |l|.
            assert!(
                shear < wide * (1.0 + 1e-9) * strength,
                "{dt} {shear} {strength}"
            );
            yielding += usize::from(shear > 500.0);
        }
        assert!(dt < 1e-4 || yielding > 100, "{dt} {yielding}");
    }
}

#[test]
fn without_viscosity_it_is_von_mises() {
    use crate::material::von_mises::VonMises;
    let plain = RateStrength {
        viscosity: 0.0,
        ..STRENGTH
    };
    let (thick, perfect) = (
        HerschelBulkley::new(&SLIDE, plain),
        VonMises::new(&SLIDE, 500.0),
    );
    let (mut own, mut other) = ([0.0; 4], [0.0; 4]);
    for l in path(300, 4.0) {
        thick.advance(&plane(&l), 1e-3, &mut own);
        perfect.advance(&plane(&l), 1e-3, &mut other);
        assert_eq!(own, other);
    }
    assert!(root_j2(&full(own)) > 499.0);
}
