//! The computed displacements as a field: differentiated numerically, they obey the equation of
//! motion, leave the surface free of stress, and come to rest in Flamant's static field.

use super::*;

/// Stress (s_xx, s_yy, s_xy) from the displacement gradient du_i/dx_j, in plane strain.
fn stress(material: &Elastic, gradient: [[f64; 2]; 2]) -> [f64; 3] {
    let (lame, shear) = (material.lame(), material.shear_modulus());
    let [[xx, xy], [yx, yy]] = gradient;
    let volume = lame * (xx + yy);
    [
        volume + 2.0 * shear * xx,
        volume + 2.0 * shear * yy,
        shear * (xy + yx),
    ]
}

/// First and second derivative on five points at distances -2..2, fourth order.
const FIRST: [f64; 5] = [1.0 / 12.0, -2.0 / 3.0, 0.0, 2.0 / 3.0, -1.0 / 12.0];
const SECOND: [f64; 5] = [-1.0 / 12.0, 4.0 / 3.0, -5.0 / 2.0, 4.0 / 3.0, -1.0 / 12.0];
/// First derivative at the first of five points.
const ONE_SIDED: [f64; 5] = [-25.0 / 12.0, 4.0, -3.0, 4.0 / 3.0, -0.25];

/// 5 x 5 receivers around a place, `h` apart; [i][j] at (x + (i-2) h, y + (j-2) h), y up.
fn patch(material: &Elastic, (x, depth): (f64, f64), h: f64, end: f64) -> Vec<Vec<Response>> {
    let at = |i: usize, j: usize| {
        let place = (x + (i as f64 - 2.0) * h, depth - (j as f64 - 2.0) * h);
        response(material, place, end, 0.05)
    };
    (0..5).map(|i| (0..5).map(|j| at(i, j)).collect()).collect()
}

#[test]
fn satisfies_the_equation_of_motion() {
    let (h, dt) = (2.0, 2e-3);
    for material in [rock(), clay()] {
        let (lame, shear) = (material.lame(), material.shear_modulus());
        for place in [(300.0, 100.0), (900.0, 300.0), (0.0, 600.0), (-400.0, 20.0)] {
            let patch = patch(&material, place, h, 3.0);
            for direction in BOTH {
                let (mut worst, mut largest) = (0.0f64, 0.0f64);
                for step in 1..40 {
                    let t = 0.4 + 0.05 * f64::from(step);
                    let u = |i: usize, j: usize, t| {
                        patch[i][j].displacement(direction, ricker, t).unwrap()
                    };
                    let mut field = [[[0.0; 2]; 5]; 5];
                    for (i, row) in field.iter_mut().enumerate() {
                        for (j, value) in row.iter_mut().enumerate() {
                            *value = u(i, j, t);
                        }
                    }
                    for c in 0..2 {
                        let (mut inertia, mut xx, mut yy, mut cross) = (0.0, 0.0, 0.0, 0.0);
                        for k in 0..5 {
                            let late = t + (k as f64 - 2.0) * dt;
                            inertia += SECOND[k] * u(2, 2, late)[c] / (dt * dt);
                            xx += SECOND[k] * field[k][2][c] / (h * h);
                            yy += SECOND[k] * field[2][k][c] / (h * h);
                            for l in 0..5 {
                                cross += FIRST[k] * FIRST[l] * field[k][l][1 - c] / (h * h);
                            }
                        }
                        let along = if c == 0 { xx } else { yy };
                        let force = (lame + shear) * (along + cross) + shear * (xx + yy);
                        let inertia = material.density() * inertia;
                        worst = worst.max((inertia - force).abs());
                        largest = largest.max(inertia.abs());
                    }
                }
                assert!(
                    worst < 1e-4 * largest,
                    "{place:?} {direction:?}: {:e}",
                    worst / largest
                );
            }
        }
    }
}

#[test]
fn leaves_the_surface_free_of_stress() {
    let (x, h) = (300.0, 2.0);
    for material in [rock(), clay()] {
        let along: Vec<Response> = (0..5)
            .map(|i| response(&material, (x + (f64::from(i) - 2.0) * h, 0.0), 3.0, 0.05))
            .collect();
        let down: Vec<Response> = (0..5)
            .map(|j| response(&material, (x, f64::from(j) * h), 3.0, 0.05))
            .collect();
        for direction in BOTH {
            let (mut normal, mut shear, mut inner) = (0.0f64, 0.0f64, 0.0f64);
            for step in 0..250 {
                let t = 0.01 * f64::from(step);
                let mut gradient = [[0.0; 2]; 2];
                for k in 0..5 {
                    let u = along[k].displacement(direction, ricker, t).unwrap();
                    let v = down[k].displacement(direction, ricker, t).unwrap();
                    for c in 0..2 {
                        gradient[c][0] += FIRST[k] * u[c] / h;
                        gradient[c][1] -= ONE_SIDED[k] * v[c] / h; // y up
                    }
                }
                let [xx, yy, xy] = stress(&material, gradient);
                normal = normal.max(yy.abs());
                shear = shear.max(xy.abs());
                inner = inner.max(xx.abs());
            }
            assert!(normal < 1e-3 * inner, "{direction:?}: {:e}", normal / inner);
            assert!(shear < 1e-3 * inner, "{direction:?}: {:e}", shear / inner);
        }
    }
}

/// A force that rises within 1 s and stays.
fn ramp(t: f64) -> f64 {
    if t < 1.0 {
        t * t * (3.0 - 2.0 * t)
    } else {
        1.0
    }
}

/// Flamant 1892 (Johnson, Contact Mechanics, 1985, chapter 2): s_r = -2 F cos(angle to the force)/(pi r),
/// no other stress.
#[test]
fn comes_to_rest_in_flamants_stresses() {
    let (h, end) = (0.5, 60.0);
    for material in [rock(), clay()] {
        for (x, depth) in [(100.0, 60.0), (-30.0, 80.0), (0.0, 50.0)] {
            let patch = patch(&material, (x, depth), h, end);
            let r = f64::hypot(x, depth);
            let (sine, cosine) = (x / r, -depth / r);
            for (direction, toward) in [
                (Direction::Vertical, -cosine),
                (Direction::Horizontal, sine),
            ] {
                let u =
                    |i: usize, j: usize| patch[i][j].displacement(direction, ramp, end).unwrap();
                let mut gradient = [[0.0; 2]; 2];
                for (k, weight) in FIRST.iter().enumerate() {
                    let (along, up) = (u(k, 2), u(2, k));
                    for (c, row) in gradient.iter_mut().enumerate() {
                        row[0] += weight * along[c] / h;
                        row[1] += weight * up[c] / h;
                    }
                }
                let radial = -2.0 * toward / (PI * r);
                let exact = [
                    radial * sine * sine,
                    radial * cosine * cosine,
                    radial * sine * cosine,
                ];
                let own = stress(&material, gradient);
                for (one, other) in own.iter().zip(exact) {
                    let scale = 2.0 / (PI * r);
                    assert!(
                        (one - other).abs() < 3e-4 * scale,
                        "({x}, {depth}) {direction:?}: {own:?}, {exact:?}"
                    );
                }
            }
        }
    }
}

#[test]
fn comes_to_rest_in_flamants_settlement_of_the_surface() {
    for (material, young, poisson) in [(rock(), 2e9, 0.25), (clay(), 2e9, 0.4)] {
        let (near, far) = ((100.0, 0.0), (200.0, 0.0));
        let u = |place, direction| {
            response(&material, place, 60.0, 0.1)
                .displacement(direction, ramp, 60.0)
                .unwrap()
        };
        let difference = 2.0 * (1.0 - poisson * poisson) / (PI * young) * 2f64.ln();
        let settle = u(far, Direction::Vertical)[1] - u(near, Direction::Vertical)[1];
        assert!(
            (settle / difference - 1.0).abs() < 1e-4,
            "{settle} {difference}"
        );
        let shift = u(near, Direction::Horizontal)[0] - u(far, Direction::Horizontal)[0];
        assert!(
            (shift / difference - 1.0).abs() < 1e-4,
            "{shift} {difference}"
        );
        // Both sides move towards the load by the same amount at any distance.
        let inward = -(1.0 - 2.0 * poisson) * (1.0 + poisson) / (2.0 * young);
        let own = u(near, Direction::Vertical)[0];
        assert!((own / inward - 1.0).abs() < 1e-6, "{own} {inward}");
    }
}

#[test]
fn keeps_its_digits_close_to_the_force() {
    // 0.1 m is 1.6e-5 of the way of an S wave in 10 s, near the limit that is served.
    let settle = |depth| {
        let response = response(&rock(), (0.0, depth), 10.0, 0.1);
        response
            .displacement(Direction::Vertical, ramp, 10.0)
            .unwrap()[1]
    };
    let difference = 2.0 * (1.0 - 0.0625) / (PI * 2e9) * 2f64.ln();
    let own = settle(0.2) - settle(0.1);
    assert!((own / difference - 1.0).abs() < 1e-5, "{own} {difference}");
}
