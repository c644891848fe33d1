use super::super::damping_layer::{DampingLayer, End};
use super::damping::Layer;
use super::*;

fn rock() -> Elastic {
    Elastic::new(2e9, 0.3, 2000.0).unwrap()
}

fn at(wave: Wave, angle: f64) -> Medium {
    Medium::new(&rock(), wave, angle).unwrap()
}

/// Angles below and beyond the critical one of S, 32.3 degrees.
const ANGLES: [f64; 6] = [0.0, 15.0, 30.0, 45.0, 60.0, 85.0];

#[test]
fn walls_and_free_surfaces_return_all_energy() {
    for wave in Wave::BOTH {
        for angle in ANGLES {
            let medium = at(wave, angle);
            for reflection in [medium.fixed(), medium.dashpot(0.0)] {
                let total = reflection.total(wave);
                assert!((total - 1.0).abs() < 1e-13, "{wave:?} {angle}: {total}");
            }
        }
    }
}

#[test]
fn a_free_surface_reflects_as_achenbach_prints_it() {
    // his section 5.6: kappa = c_p/c_s, angles theta of P and theta_s of S
    for angle in [10.0_f64, 40.0, 70.0] {
        let theta = angle.to_radians();
        let kappa = rock().p_speed() / rock().s_speed();
        let theta_s = (theta.sin() / kappa).asin();
        let (both, square) = (
            (2.0 * theta).sin() * (2.0 * theta_s).sin(),
            (kappa * (2.0 * theta_s).cos()).powi(2),
        );
        let p = (both - square) / (both + square);
        let s = 2.0 * kappa * (2.0 * theta).sin() * (2.0 * theta_s).cos() / (both + square);
        let own = at(Wave::P, angle).dashpot(0.0);
        assert!((own.amplitude(Wave::P, Wave::P) - p.abs()).abs() < 1e-13);
        assert!((own.amplitude(Wave::P, Wave::S) - s.abs()).abs() < 1e-13);
    }
}

#[test]
fn dashpots_take_up_what_meets_them_head_on() {
    for wave in Wave::BOTH {
        assert!(at(wave, 0.0).dashpot(1.0).total(wave) < 1e-15);
        for share in [0.5, 2.0] {
            let expected = (1.0_f64 - share).abs() / (1.0 + share);
            assert!((at(wave, 0.0).dashpot(share).total(wave) - expected).abs() < 1e-14);
        }
        // and, of infinite impedance, nothing
        let wall = at(wave, 60.0).dashpot(1e12).amplitudes - at(wave, 60.0).fixed().amplitudes;
        assert!(wall.largest() < 1e-9);
    }
}

/// What dashpots dissipate is what does not come back: the power of their tractions, independent of
/// the amplitudes' normalisation.
#[test]
fn dashpots_dissipate_what_does_not_come_back() {
    for wave in Wave::BOTH {
        for angle in ANGLES {
            let medium = at(wave, angle);
            let reflection = medium.dashpot(1.0);
            let incident = medium.motion.column(wave as usize);
            let back = medium.mirrored_motion() * reflection.amplitudes;
            let back = back.column(wave as usize);
            let speeds = [rock().p_speed(), rock().s_speed()];
            let dissipated: f64 = (0..2)
                .map(|i| speeds[i] * (incident[i] + back[i]).norm_sqr())
                .sum();
            let kept = 1.0 - reflection.total(wave).powi(2);
            let share = dissipated / reflection.flux[wave as usize];
            assert!(
                (share - kept).abs() < 1e-12,
                "{wave:?} {angle}: {share} {kept}"
            );
        }
    }
}

#[test]
fn a_matched_layer_follows_the_law_of_the_cosine() {
    let (r, c) = (1e-4_f64, rock().p_speed());
    let strength = 0.5 * c * (1.0 / r).ln();
    assert!((at(Wave::P, 0.0).stretched(strength).total(Wave::P) / r - 1.0).abs() < 1e-12);
    let medium = at(Wave::P, 60.0);
    let (layer, wall) = (medium.stretched(strength), medium.fixed());
    let law = r.powf(60_f64.to_radians().cos());
    let same = layer.amplitude(Wave::P, Wave::P) / wall.amplitude(Wave::P, Wave::P);
    assert!((same / law - 1.0).abs() < 1e-12);
    // S is slower, so that it decays the more
    let head_on = at(Wave::S, 0.0).stretched(strength).total(Wave::S);
    assert!((head_on / r.powf(c / rock().s_speed()) - 1.0).abs() < 1e-12);
}

#[test]
fn a_viscous_layer_head_on_is_the_scalar_one() {
    let rate = |x: f64| 12.0 * (x / 600.0).powi(2);
    let layer = Layer {
        thickness: 600.0,
        rate,
    };
    for (wave, speed) in [(Wave::P, rock().p_speed()), (Wave::S, rock().s_speed())] {
        let own = layer.reflection(&at(wave, 0.0), 2.0).unwrap().total(wave);
        let scalar = DampingLayer::new(600.0, speed, End::Fixed, rate).unwrap();
        let scalar = scalar.reflection(2.0).unwrap().norm();
        assert!((own - scalar).abs() < 1e-8, "{wave:?}: {own} {scalar}");
    }
}

#[test]
fn a_layer_without_damping_is_a_wall_further_out() {
    let layer = Layer {
        thickness: 300.0,
        rate: |_| 0.0,
    };
    for wave in Wave::BOTH {
        for angle in [20.0, 70.0] {
            let medium = at(wave, angle);
            let own = layer.reflection(&medium, 2.0).unwrap();
            let wall = medium.fixed();
            let mut expected = wall.amplitudes;
            for (i, row) in expected.0.iter_mut().enumerate() {
                for (j, x) in row.iter_mut().enumerate() {
                    let both = medium.slowness[i] + medium.slowness[j];
                    let way = 2.0 * std::f64::consts::PI * 2.0 * 300.0 * both;
                    *x *= (Complex64::new(0.0, -1.0) * way).exp();
                }
            }
            assert!(
                (own.amplitudes - expected).largest() < 1e-7,
                "{wave:?} {angle}"
            );
        }
    }
}

/// Constant damping is a half-space's worth of another medium: the wave equation with the density
/// rho (1 - i g/w), solved as partial waves of complex slowness and matched at the inner edge.
#[test]
fn constant_damping_is_a_slab_of_complex_density() {
    let (rate, frequency, thickness) = (5.0, 2.0, 200.0);
    let angular = 2.0 * std::f64::consts::PI * frequency;
    let (lame, shear) = (rock().lame(), rock().shear_modulus());
    for (wave, angle) in [(Wave::P, 40.0), (Wave::S, 20.0), (Wave::S, 50.0)] {
        let medium = at(wave, angle);
        let p = Complex64::from(
            angle.to_radians().sin() / [rock().p_speed(), rock().s_speed()][wave as usize],
        );
        let density = rock().density() * Complex64::new(1.0, -rate / angular);
        let xi = [lame + 2.0 * shear, shear].map(|m| (density / m - p * p).sqrt());
        let stress = |xi: Complex64, u: [Complex64; 2]| {
            [
                lame * (xi * u[0] + p * u[1]) + 2.0 * shear * xi * u[0],
                shear * (p * u[0] + xi * u[1]),
            ]
        };
        let shapes = [[xi[0], p], [-p, xi[1]]];
        let motion = Matrix2::columns(shapes[0], shapes[1]);
        let traction = Matrix2::columns(stress(xi[0], shapes[0]), stress(xi[1], shapes[1]));
        let back = mirror().scale(-Complex64::ONE) * traction;
        // from the wall at the far end to the impedance T = Z u at the inner edge
        let ways =
            Matrix2::diagonal(xi.map(|x| (Complex64::new(0.0, -angular * thickness) * x).exp()));
        let wall = (mirror() * motion).inverse() * motion.scale(-Complex64::ONE);
        let r = ways * wall * ways;
        let z = (traction + back * r) * (motion + mirror() * motion * r).inverse();
        let left = medium.mirrored_traction() - z * medium.mirrored_motion();
        let right = medium.traction - z * medium.motion;
        let expected = left.inverse() * right.scale(-Complex64::ONE);
        let layer = Layer {
            thickness,
            rate: |_| rate,
        };
        let own = layer.reflection(&medium, frequency).unwrap().amplitudes;
        assert!((own - expected).largest() < 1e-7, "{wave:?} {angle}");
    }
}

#[test]
fn refuses_what_has_no_reflection() {
    assert!(Medium::new(&rock(), Wave::P, 90.0).is_err());
    assert!(Medium::new(&rock(), Wave::P, f64::NAN).is_err());
    let critical = (rock().s_speed() / rock().p_speed()).asin().to_degrees();
    assert_eq!(
        Medium::new(&rock(), Wave::S, critical).unwrap_err(),
        ObliqueError::Grazing
    );
    let layer = Layer {
        thickness: -1.0,
        rate: |_| 1.0,
    };
    assert!(layer.reflection(&at(Wave::P, 10.0), 2.0).is_err());
}
