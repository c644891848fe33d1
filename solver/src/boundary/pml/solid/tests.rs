//! The kernel alone, against the closed forms at the head of its file.

use super::*;
use crate::problem::Elastic;

const SOIL: Elastic = Elastic {
    youngs_modulus: 7.0,
    poissons_ratio: 0.3,
    density: 1.0,
};

/// Damping of a face, an edge and a corner (1/s).
const POINTS: [[f64; 3]; 3] = [[0.0, 3.0, 0.0], [2.0, 0.0, 5.0], [1.5, 4.0, 2.5]];

/// The two ends of an explicit step have the masses rho prod_j (1 +- b_j dt/2).
#[test]
fn explicit_masses_are_products_of_the_axes() {
    let dt = 0.3;
    let material = LinearElastic::new(&SOIL);
    let kernel = Solid::<3>::new(0..3, material, POINTS.to_vec(), Some(dt));
    let mut inertia = PointInertia::default();
    kernel.inertia(0..3, &mut inertia);
    for (p, beta) in POINTS.iter().enumerate() {
        let [c, k] = [inertia.viscous[p][0], inertia.stiffness[p][0]];
        for sign in [1.0, -1.0] {
            // the corner's part of C is odd in dt, like the rest of it
            let mass = 1.0 + sign * 0.5 * dt * c + 0.25 * dt * dt * k;
            let axes: f64 = beta.iter().map(|b| 1.0 + sign * 0.5 * dt * b).product();
            assert!((mass - axes).abs() < 1e-14, "{beta:?}: {mass}, {axes}");
        }
    }
}

/// What a step of one of g gives a stretched modulus at time t: the inverse transforms of 1/(W + b), 1/(W
/// (W + b)) and so on, times 1/W.
fn response(beta: &[f64; 3], j: usize, l: usize, t: f64) -> f64 {
    let total: f64 = beta.iter().sum();
    if j != l {
        return 1.0 + (total - beta[j] - beta[l]) * t;
    }
    let (own, product): (f64, f64) = (beta[l], beta.iter().product());
    let others = total - own;
    if own == 0.0 {
        let pair: f64 = (0..3).filter(|a| *a != l).map(|a| beta[a]).product();
        return 1.0 + others * t + 0.5 * pair * t * t;
    }
    let pair = product / own;
    let once = (1.0 - (-own * t).exp()) / own;
    1.0 + (others - own) * once + pair * (t - once) / own
}

/// The stress of a gradient that stays follows the stretched moduli in time, component by component.
#[test]
fn stress_of_a_step_follows_the_stretched_moduli() {
    let (dt, steps) = (1e-4, 5000);
    let moduli: Tensor4<3> = LinearElastic::new(&SOIL).small_moduli();
    for beta in &POINTS {
        let c = Coefficients::new(beta, 0.0, dt);
        for (k, l) in [(0, 0), (1, 0), (2, 1), (1, 2), (2, 2), (0, 2)] {
            let mut g = zero::<3>();
            g[k][l] = 1.0;
            let (mut phi, mut psi) = (zero::<3>(), zero::<3>());
            for _ in 0..steps {
                let next = c.advance(&phi, &g, &g);
                psi = integrated(&psi, &phi, &next, dt);
                phi = next;
            }
            let stress = stretched_stress(&moduli, beta, &g, [&phi, &psi]);
            for i in 0..3 {
                for j in 0..3 {
                    let t = dt * f64::from(steps);
                    let exact = moduli[i][j][k][l] * response(beta, j, l, t);
                    assert!(
                        (stress[i][j] - exact).abs() < 1e-6,
                        "{beta:?}, g_{k}{l}, P_{i}{j}: {} and {exact}",
                        stress[i][j]
                    );
                }
            }
        }
    }
}

/// psi is kept where layers overlap, and nowhere else.
#[test]
fn faces_keep_no_second_integral() {
    let material = LinearElastic::new(&SOIL);
    let kernel = Solid::<3>::new(0..3, material, POINTS.to_vec(), None);
    assert_eq!(kernel.integral.len(), 2);
}
