//! The elastic step against the implicit law, and what tests of the laws share: stress written out in
//! three dimensions, invariants from its entries, paths that go everywhere.

use super::*;
use crate::material::MaterialBlock;
use crate::material::linear_elastic::LinearElastic;
use crate::tensor::{add_scaled, contract, identity, mul, sym, zero};

/// E = 500 s_u, nu = 0.49 with s_u = 2.5 kPa: the clay of the pipe.
pub const CLAY: Elastic = Elastic {
    youngs_modulus: 1.25e6,
    poissons_ratio: 0.49,
    density: 650.0,
};

/// The clay's strength (Pa).
pub const S_U: f64 = 2.5e3;

/// Stress of a plane state as a tensor in three dimensions.
pub fn full([xx, yy, xy, zz]: [f64; 4]) -> Matrix<3> {
    [[xx, xy, 0.0], [xy, yy, 0.0], [0.0, 0.0, zz]]
}

/// sqrt(J2), J2 = s : s / 2 with the deviator s (Pa).
pub fn root_j2(t: &Matrix<3>) -> f64 {
    let mean = (t[0][0] + t[1][1] + t[2][2]) / 3.0;
    let deviator = add_scaled(t, -mean, &identity());
    (0.5 * contract(&deviator, &deviator)).sqrt()
}

/// Velocity gradients (1/s) that turn from step to step and lead past yield, at angles that share no
/// period: as many entries as `entries` says, each within `rate`.
pub fn path(steps: usize, rate: f64) -> impl Iterator<Item = Matrix<3>> {
    (0..steps).map(move |n| {
        let mut l = zero::<3>();
        for (k, entry) in l.iter_mut().flatten().enumerate() {
            *entry = rate * (0.37 * n as f64 * (1.0 + 0.29 * k as f64) + 1.3 * k as f64).sin();
        }
        l
    })
}

/// The in-plane part of a gradient.
pub fn plane(l: &Matrix<3>) -> Matrix<2> {
    [[l[0][0], l[0][1]], [l[1][0], l[1][1]]]
}

/// The in-plane part of a plane state.
fn in_plane([xx, yy, xy, _]: &[f64; 4]) -> Matrix<2> {
    [[*xx, *xy], [*xy, *yy]]
}

/// The implicit law's Kirchhoff stress after the increment `a` from `stress`.
fn implicit(a: &Matrix<2>, stress: &Matrix<2>) -> Matrix<2> {
    let (mut next, mut first) = ([zero::<2>()], [zero::<2>()]);
    LinearElastic::new(&CLAY)
        .finite_stress(&[*a], &[*stress], &mut next, &mut first)
        .expect("the increment has a positive determinant");
    next[0]
}

#[test]
fn a_step_without_spin_is_that_of_the_implicit_law() {
    let law = Hypoelastic::new(&CLAY);
    let mut state = [1e3, -2e3, 400.0, -300.0];
    for l in path(20, 3.0) {
        let (l, dt) = (sym(&plane(&l)), 0.03);
        let expected = implicit(&l.map(|row| row.map(|x| x * dt)), &in_plane(&state));
        state = PlaneStep::new(&l, dt).trial(&law, &state);
        let own = in_plane(&state);
        for (own, other) in own.iter().flatten().zip(expected.iter().flatten()) {
            assert!(
                (own - other).abs() < 1e-9 * CLAY.youngs_modulus,
                "{own} {other}"
            );
        }
    }
}

/// Where material stretches and turns at once the implicit law's strain lags by half a step's angle:
/// both come to one stress, this one with the second power of the step, that one with the first.
#[test]
fn the_turning_frame_is_of_second_order() {
    let law = Hypoelastic::new(&CLAY);
    let run = |steps: usize| {
        // exp(dt l) - 1, so that all lengths of step follow one motion.
        let dt = 1.0 / steps as f64;
        let l = [[0.03 * dt, 1.1 * dt], [-dt, -0.02 * dt]];
        let (mut a, mut power) = (l, l);
        for n in 2..20 {
            power = mul(&power, &l).map(|row| row.map(|x| x / f64::from(n)));
            a = add_scaled(&a, 1.0, &power);
        }
        let (mut own, mut other) = ([0.0; 4], zero::<2>());
        for _ in 0..steps {
            own = PlaneStep::new(&a, 1.0).trial(&law, &own);
            other = implicit(&a, &other);
        }
        (own[2], other[0][1])
    };
    let exact = run(20_000).0;
    let ((a, lag_a), (b, lag_b)) = (run(50), run(100));
    let order = ((a - exact) / (b - exact)).log2();
    assert!((1.9..2.1).contains(&order), "{order}");
    let lagging = ((lag_a - exact) / (lag_b - exact)).log2();
    assert!((0.8..1.2).contains(&lagging), "{lagging}");
    assert!((lag_b - exact).abs() > 10.0 * (b - exact).abs());
}

#[test]
fn one_axis_departs_from_henckys_law_with_the_third_power_of_the_step() {
    let law = Hypoelastic::new(&CLAY);
    let off = |stretch: f64| {
        let l = [[0.0, 0.0], [0.0, stretch - 1.0]];
        let [xx, yy, _, zz] = PlaneStep::new(&l, 1.0).trial(&law, &[0.0; 4]);
        assert_eq!(xx, zz);
        (yy - law.p_modulus() * stretch.ln()).abs()
    };
    let order = (off(1.04) / off(1.02)).log2();
    assert!((2.9..3.1).contains(&order), "{order}");
}

#[test]
fn a_rigid_rotation_turns_the_stress_and_adds_none() {
    // x' = x cos - y sin: the gradient of the motion less the unit, in a step of one second.
    let (s, c) = 0.8_f64.sin_cos();
    let l = [[c - 1.0, -s], [s, c - 1.0]];
    let state = [2e3, -1e3, 500.0, 700.0];
    let [xx, yy, xy, zz] = PlaneStep::new(&l, 1.0).trial(&Hypoelastic::new(&CLAY), &state);
    let expected_xx = c * c * 2e3 - 2.0 * s * c * 500.0 - s * s * 1e3;
    let expected_xy = s * c * (2e3 + 1e3) + (c * c - s * s) * 500.0;
    // Two half turns of 0.4 each.
    assert!((xx - expected_xx).abs() < 1e-8);
    assert!((xx + yy - 1e3).abs() < 1e-8);
    assert!((xy - expected_xy).abs() < 1e-8);
    assert_eq!(zz, 700.0);
}

#[test]
fn energy_is_half_stress_times_strain() {
    let law = Hypoelastic::new(&CLAY);
    let state = [3e3, -1e3, 800.0, 2e3];
    let stress = full(state);
    // Hooke's law the other way round.
    let (e, nu) = (CLAY.youngs_modulus, CLAY.poissons_ratio);
    let mut strain = stress.map(|row| row.map(|s| (1.0 + nu) / e * s));
    for i in 0..3 {
        strain[i][i] -= nu / e * (stress[0][0] + stress[1][1] + stress[2][2]);
    }
    let expected = 0.5 * contract(&stress, &strain);
    assert!((law.energy_density(&state) / expected - 1.0).abs() < 1e-12);
    assert!((law.energy_density(&components(&stress)) / expected - 1.0).abs() < 1e-12);
}

#[test]
fn a_turn_about_any_axis_turns_the_stress_and_adds_none() {
    // Rodrigues' matrix for 0.9 about (2, -1, 2)/3.
    let (s, c) = 0.9_f64.sin_cos();
    let n = [2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0];
    let cross = [[0.0, -n[2], n[1]], [n[2], 0.0, -n[0]], [-n[1], n[0], 0.0]];
    let mut turn = zero::<3>();
    for i in 0..3 {
        for j in 0..3 {
            let unit = if i == j { c } else { 0.0 };
            turn[i][j] = unit + s * cross[i][j] + (1.0 - c) * n[i] * n[j];
        }
    }
    let mut l = turn;
    (0..3).for_each(|i| l[i][i] -= 1.0);
    let stress = [
        [2e3, 300.0, -700.0],
        [300.0, -1e3, 500.0],
        [-700.0, 500.0, 900.0],
    ];
    let law = Hypoelastic::new(&CLAY);
    let own = tensor(&SolidStep::new(&l, 1.0).trial(&law, &components(&stress)));
    for i in 0..3 {
        for j in 0..3 {
            let mut expected = 0.0;
            for k in 0..3 {
                for m in 0..3 {
                    expected += turn[i][k] * stress[k][m] * turn[j][m];
                }
            }
            assert!((own[i][j] - expected).abs() < 1e-8, "{i}{j}");
        }
    }
}

#[test]
fn a_start_under_k0_has_equal_stress_along_and_across() {
    let k0 = CLAY.poissons_ratio / (1.0 - CLAY.poissons_ratio);
    let stress = [[-k0 * 4e4, 0.0], [0.0, -4e4]];
    let state = Hypoelastic::new(&CLAY).under(&stress);
    assert_eq!(in_plane(&state), stress);
    assert!((state[3] - stress[0][0]).abs() < 1e-9 * 4e4);
}

#[test]
fn the_return_shortens_the_deviator_and_keeps_the_mean() {
    let trial = [5e3, -3e3, 2e3, 1e3];
    let back = radial_return(trial, S_U, || S_U);
    assert!((root_j2(&full(back)) / S_U - 1.0).abs() < 1e-12);
    let mean = |s: [f64; 4]| (s[0] + s[1] + s[3]) / 3.0;
    assert!((mean(back) - mean(trial)).abs() < 1e-9);
    // The direction stays: all differences shrink alike.
    let share = S_U / root_j2(&full(trial));
    assert!((back[2] / trial[2] - share).abs() < 1e-12);
    assert!(((back[0] - back[3]) / (trial[0] - trial[3]) - share).abs() < 1e-12);
    let inside = [1e3, 0.0, 500.0, 300.0];
    assert_eq!(radial_return(inside, S_U, || unreachable!()), inside);
}
