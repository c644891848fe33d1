//! Independent way: an integral over real wavenumbers at complex frequency, with Hooke's law and the
//! boundary conditions solved anew for each wavenumber. It shares neither contour, nor spectrum, nor
//! quadrature with the closed form.

use super::*;
use num_complex::Complex64;

/// One wave exp(-i k x - decay z), z downward: its displacement at z = 0, and from it the stresses.
struct Wave {
    decay: Complex64,
    displacement: [Complex64; 2],
}

impl Wave {
    /// Traction components (s_zz, s_xz) on z = 0.
    fn stress(&self, material: &Elastic, k: f64) -> [Complex64; 2] {
        let [x, z] = self.displacement;
        let (dx, dz) = (Complex64::new(0.0, -k), -self.decay);
        let (lame, shear) = (material.lame(), material.shear_modulus());
        [
            lame * (dx * x + dz * z) + 2.0 * shear * dz * z,
            shear * (dz * x + dx * z),
        ]
    }
}

/// Transform (u_x, u_y) of the impulse response at Laplace parameter `s`, Re s > 0.
///
/// The trapezoidal rule in k repeats the force every 2 pi/dk; attenuation of Re s/c_p a metre makes
/// the copies negligible, and the integrand dies like exp(-k depth).
fn transform(
    material: &Elastic,
    (offset, depth): (f64, f64),
    direction: Direction,
    s: Complex64,
) -> [Complex64; 2] {
    let period = offset.abs() + 36.0 * material.p_speed() / s.re;
    let dk = 2.0 * PI / period;
    let last = (36.0 / depth + 4.0 * s.norm() / material.s_speed()) / dk;
    let mut sum = [Complex64::ZERO; 2];
    for i in -(last as i64)..=last as i64 {
        // Half a step aside: no node at k = 0, where P and S are one wave.
        let k = (i as f64 + 0.5) * dk;
        let decay = |speed: f64| (k * k + s * s / (speed * speed)).sqrt();
        let (p, q) = (decay(material.p_speed()), decay(material.s_speed()));
        let ik = Complex64::new(0.0, k);
        // P moves along its gradient, S across.
        let waves = [
            Wave {
                decay: p,
                displacement: [-ik, -p],
            },
            Wave {
                decay: q,
                displacement: [q, -ik],
            },
        ];
        let [[a, c], [b, d]] = [waves[0].stress(material, k), waves[1].stress(material, k)];
        let [right_a, right_c] = match direction {
            Direction::Vertical => [-1.0, 0.0],
            Direction::Horizontal => [0.0, -1.0],
        };
        let determinant = a * d - b * c;
        let amplitudes = [
            (d * right_a - b * right_c) / determinant,
            (a * right_c - c * right_a) / determinant,
        ];
        for (wave, amplitude) in waves.iter().zip(amplitudes) {
            let factor = amplitude * (-ik * offset - wave.decay * depth).exp() * dk / (2.0 * PI);
            sum[0] += wave.displacement[0] * factor;
            sum[1] -= wave.displacement[1] * factor; // y up
        }
    }
    sum
}

#[test]
fn transform_of_the_response_is_the_wavenumber_integral() {
    // Below, within and beyond the critical angle, with head wave, and close to the surface.
    let places = [
        (0.0, 600.0),
        (300.0, 100.0),
        (-300.0, 100.0),
        (60.0, 300.0),
        (900.0, 300.0),
        (500.0, 5.0),
    ];
    let attenuation = 4.0;
    for material in [rock(), clay()] {
        for place in places {
            let response = response(&material, place, 9.0, 0.03);
            for direction in BOTH {
                for frequency in [0.0, 0.7, 3.0, 7.0] {
                    let s = Complex64::new(attenuation, 2.0 * PI * frequency);
                    let mut own = [Complex64::ZERO; 2];
                    for node in &response.nodes {
                        let weight = node.weight(direction);
                        let factor = (-s * node.delay).exp();
                        own[0] += weight[0] * factor;
                        own[1] += weight[1] * factor;
                    }
                    let other = transform(&material, place, direction, s);
                    let scale = other[0].norm().hypot(other[1].norm());
                    let error = (own[0] - other[0]).norm().hypot((own[1] - other[1]).norm());
                    assert!(
                        error < 1e-8 * scale,
                        "{place:?} {direction:?} {frequency} Hz: {:e}",
                        error / scale
                    );
                }
            }
        }
    }
}
