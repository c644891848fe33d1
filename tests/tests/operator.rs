//! Gates of the layers' semi-discrete operators on a mesh small enough for dense algebra: symmetry,
//! spectrum, constants. Analytic: the exact value follows from the equations.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::linear::Moment;
use anechoic_solver::physics::model::Model;
use anechoic_solver::problem::{MassKind, PointMode, Problem, Transfer};
use anechoic_solver::setup;
use anechoic_solver::tensor::Vector;
use anechoic_solver::time::{Motion, System};
use anechoic_tests::half_space;
use anechoic_tests::twin::{Broken, Twin};
use faer::Mat;

/// Reflection aimed at.
const REFLECTION: f64 = 1e-4;

fn pml() -> SideMethod {
    SideMethod::new("pml").with("reflection", REFLECTION)
}

/// Force on free unknowns for a displacement, at rest: a column of minus the stiffness.
fn column(model: &mut Model<2>, unknown: usize) -> Vec<f64> {
    let n = model.grid.node_count();
    let rest = vec![[0.0; 2]; n];
    let mut unit: Vec<Vector<2>> = rest.clone();
    unit[unknown / 2][unknown % 2] = 1.0;
    let mut force = rest.clone();
    let trial = Motion {
        increment: &unit,
        v: &rest,
        a: &rest,
    };
    model.residual(&trial, &mut force).unwrap();
    force.as_flattened().to_vec()
}

/// A mesh small enough for dense algebra: 60 x 40 m, layers of three cells left, right and below.
fn tiny(layer: SideMethod) -> Problem<2> {
    let layer = layer.with("thickness_m", 60.0);
    let mut problem = half_space(layer, PointMode::Frozen, Transfer::Keep);
    problem.target.lower = [0.0, -40.0];
    problem.target.upper = [60.0, 0.0];
    problem.drives.clear();
    problem.probes.receivers.clear();
    problem
}

/// Free unknowns and the stiffness on them, probed column by column from rest.
fn probed(problem: &Problem<2>) -> (Model<2>, Vec<usize>, Mat<f64>) {
    let mut model = setup::model(problem).unwrap();
    model.begin_step(
        [0.0, problem.dt],
        Moment {
            step: 1,
            time_s: problem.dt,
        },
    );
    // what is held has no force at all
    let free: Vec<usize> = (0..2 * model.grid.node_count())
        .filter(|&i| column(&mut model, i)[i] != 0.0)
        .collect();
    let columns: Vec<Vec<f64>> = free.iter().map(|&j| column(&mut model, j)).collect();
    let k = Mat::from_fn(free.len(), free.len(), |i, j| -columns[j][free[i]]);
    (model, free, k)
}

#[test]
fn the_true_layers_tangent_is_symmetric_to_rounding() {
    let (_, _, k) = probed(&tiny(pml()));
    let asymmetry = (&k - k.transpose()).norm_max() / k.norm_max();
    println!("asymmetry of the tangent: {asymmetry:.1e}");
    assert!(asymmetry < 1e-14);
    let shifted = tiny(pml().with("alpha_per_s", 2.0));
    for mass in [MassKind::Lumped, MassKind::Consistent] {
        let (_, _, k) = probed(&Problem {
            mass,
            ..shifted.clone()
        });
        let asymmetry = (&k - k.transpose()).norm_max() / k.norm_max();
        println!("with a frequency shift, {mass:?} masses: {asymmetry:.1e}");
        assert!(asymmetry < 1e-14);
    }
    let (_, _, k) = probed(&tiny(SideMethod::new("pml-stretched")));
    let asymmetry = (&k - k.transpose()).norm_max() / k.norm_max();
    assert!(
        asymmetry > 1e-2,
        "the published layer's is not: {asymmetry}"
    );
}

/// Largest real part of the spectrum of the true layer's semi-discrete operator, over c_p/h.
///
/// State (u, v, phi, theta_1, theta_2): du = v, dphi_kl = (B u)_kl - (b_l + alpha) phi_kl,
/// M dv = -C v - Kd u - sum V B' P(B u, phi) - T_1 theta_1 - T_2 theta_2,
/// dtheta_1 = u - alpha theta_1, dtheta_2 = theta_1 - alpha theta_2 (none of these where alpha = 0).
fn growth_of_the_true_layer(nu: f64, alpha: f64) -> f64 {
    let mut problem = tiny(pml().with("alpha_per_s", alpha));
    problem.material.poissons_ratio = nu;
    let (model, free, _) = probed(&problem);
    let own = model.regions.last().unwrap().range.clone();
    let geometry = [[0.0, 60.0], [-40.0, 0.0]];
    let layer = (60.0, REFLECTION, 20.0);
    let material = &problem.material;
    let twin = Twin::new(
        &model.points,
        own.clone(),
        material,
        geometry,
        layer,
        Broken::Nothing,
    );
    let (n, q) = (free.len(), own.len());
    // without memory: the same mesh with plain elastic stress, and the twin's at phi = 0
    let mut plain = tiny(SideMethod::new("extended"));
    plain.material = *material;
    let (_, plain_free, k) = probed(&plain);
    assert_eq!(plain_free, free);
    let thetas = if alpha > 0.0 { 2 * n } else { 0 };
    let mut a = Mat::zeros(2 * n + 4 * q + thetas, 2 * n + 4 * q + thetas);
    let lumped = &model.nodes.lumped;
    let at = |values: &[Vector<2>], i: usize| values[free[i] / 2][free[i] % 2];
    for i in 0..n {
        a[(i, n + i)] = 1.0;
        let mass = at(&lumped.mass, i);
        a[(n + i, n + i)] = -at(&lumped.viscous, i) / mass;
        for j in 0..n {
            let spring = if i == j {
                at(&lumped.stiffness, i)
            } else {
                0.0
            };
            a[(n + i, j)] = -(k[(i, j)] + spring) / mass;
        }
    }
    let rest = vec![[0.0; 2]; model.grid.node_count()];
    for point in 0..q {
        let p = own.start + point;
        for (component, (kk, l)) in [(0, 0), (0, 1), (1, 0), (1, 1)].into_iter().enumerate() {
            let row = 2 * n + 4 * point + component;
            a[(row, row)] = -twin.beta[point][l] - alpha;
            // memory onto forces
            let mut phi = [[0.0; 2]; 2];
            phi[kk][l] = 1.0;
            let stress = twin.stress(point, &[[0.0; 2]; 2], &phi);
            let mut force = rest.clone();
            let volume = &model.points.volume[p..p + 1];
            model
                .disc
                .scatter_stress(p..p + 1, volume, &[stress], &mut force);
            for i in 0..n {
                a[(n + i, row)] -= at(&force, i) / at(&lumped.mass, i);
            }
        }
        for j in 0..n {
            let mut unit = rest.clone();
            unit[free[j] / 2][free[j] % 2] = 1.0;
            let mut g = [[[0.0; 2]; 2]];
            model.disc.gradient(p..p + 1, &unit, &mut g);
            for (component, value) in g.as_flattened().as_flattened().iter().enumerate() {
                a[(2 * n + 4 * point + component, j)] = *value;
            }
        }
    }
    if alpha > 0.0 {
        let first = 2 * n + 4 * q;
        let mut sums = rest.clone();
        for (p, [b1, b2]) in own.zip(&twin.beta) {
            let (disc, mass) = (&model.disc, &model.points.mass[p..p + 1]);
            disc.scatter_vector(p..p + 1, mass, &[[b1 + b2, b1 * b2]], &mut sums);
        }
        for i in 0..n {
            let ([s1, s2], mass) = (sums[free[i] / 2], at(&lumped.mass, i));
            let t1 = alpha * alpha * s1 - 2.0 * alpha * s2;
            a[(n + i, first + i)] = -t1 / mass;
            a[(n + i, first + n + i)] = -alpha * alpha * s2 / mass;
            a[(first + i, i)] = 1.0;
            a[(first + n + i, first + i)] = 1.0;
            for theta in [first + i, first + n + i] {
                a[(theta, theta)] = -alpha;
            }
        }
    }
    largest_real_part(a) / (problem.material.p_speed() / 20.0)
}

fn largest_real_part(mut a: Mat<f64>) -> f64 {
    // entries span ten orders of magnitude (stiffness over mass against rates): diagonal scaling by
    // powers of two makes the eigenvalues as accurate as the rest
    balance(&mut a);
    let eigenvalues = a
        .eigenvalues()
        .expect("a dense eigenproblem of finite numbers");
    eigenvalues
        .iter()
        .map(|z| z.re)
        .fold(f64::NEG_INFINITY, f64::max)
}

/// Osborne's balancing: similar rows and columns, eigenvalues unchanged to the last bit.
fn balance(a: &mut Mat<f64>) {
    let n = a.nrows();
    for _ in 0..20 {
        let mut quiet = true;
        for i in 0..n {
            let others = || (0..n).filter(|j| *j != i);
            let column: f64 = others().map(|j| a[(j, i)].abs()).sum();
            let row: f64 = others().map(|j| a[(i, j)].abs()).sum();
            if column == 0.0 || row == 0.0 {
                continue;
            }
            let factor = 2.0_f64.powf((0.5 * (row / column).log2()).round());
            if factor != 1.0 {
                quiet = false;
                for j in 0..n {
                    a[(i, j)] /= factor;
                    a[(j, i)] *= factor;
                }
            }
        }
        if quiet {
            return;
        }
    }
}

#[test]
fn the_true_layers_spectrum_does_not_grow() {
    for nu in [0.0, 0.25, 0.4] {
        let growth = growth_of_the_true_layer(nu, 0.0);
        println!("nu = {nu}: largest real part {growth:.1e} c_p/h");
        assert!(growth < 1e-10);
    }
    // one for a run of 20 s, and one far above what is of use
    for (nu, alpha) in [(0.25, 0.23), (0.4, 0.23), (0.25, 10.0)] {
        let growth = growth_of_the_true_layer(nu, alpha);
        println!("nu = {nu}, alpha = {alpha}/s: largest real part {growth:.1e} c_p/h");
        assert!(growth < 1e-10);
    }
}

/// Largest real part (1/s) of the published layer's spectrum without memory: M a + C v + K u = 0.
fn growth_of_the_published_layer(rayleigh: f64) -> f64 {
    let layer = SideMethod::new("pml-stretched")
        .with("rayleigh_per_s", rayleigh)
        .with("relaxed_modulus_ratio", 1.0);
    let (model, free, k) = probed(&tiny(layer));
    let n = free.len();
    let lumped = &model.nodes.lumped;
    let at =
        |values: &[Vector<2>], i: usize| values.get(free[i] / 2).map_or(0.0, |v| v[free[i] % 2]);
    let mut a = Mat::zeros(2 * n, 2 * n);
    for i in 0..n {
        a[(i, n + i)] = 1.0;
        a[(n + i, n + i)] = -at(&lumped.viscous, i) / at(&lumped.mass, i);
        for j in 0..n {
            a[(n + i, j)] = -k[(i, j)] / at(&lumped.mass, i);
        }
    }
    largest_real_part(a)
}

#[test]
fn the_published_layer_grows_without_damping_and_rests_with_it() {
    let (bare, damped) = (
        growth_of_the_published_layer(0.0),
        growth_of_the_published_layer(1.0),
    );
    println!("published layer, largest real part: bare {bare:.3} /s, alpha_M = 1/s {damped:.3} /s");
    assert!(bare > 1e-3);
    assert!(damped < bare);
}

/// Force of the published layer from its equation (11), point by point; `swapped` exchanges lambda
/// and G in the cross terms as (22) and (25) print them.
fn published_force(
    problem: &Problem<2>,
    model: &Model<2>,
    u: &[Vector<2>],
    swapped: bool,
) -> Vec<f64> {
    let (lambda, shear) = (problem.material.lambda(), problem.material.shear_modulus());
    let (cross, turn) = if swapped {
        (shear, lambda)
    } else {
        (lambda, shear)
    };
    let layer = model.regions.last().unwrap().range.clone();
    let mut force = vec![[0.0; 2]; u.len()];
    for p in 0..model.points.len() {
        let mut g = [[[0.0; 2]; 2]];
        model.disc.gradient(p..p + 1, u, &mut g);
        let [[[xx, xy], [yx, yy]]] = g;
        let x = model.points.place[p];
        let depth = |inwards: f64| {
            if layer.contains(&p) {
                inwards.max(0.0) / 60.0
            } else {
                0.0
            }
        };
        let c1 = 1.0 + 4.0 * depth((-x[0]).max(x[0] - 60.0));
        let c2 = 1.0 + 4.0 * depth(-40.0 - x[1]);
        let normal = lambda + 2.0 * shear;
        let plain = !layer.contains(&p);
        let (cross, turn) = if plain {
            (lambda, shear)
        } else {
            (cross, turn)
        };
        let stress = [
            [
                normal * xx + c1 * cross * yy,
                c1 * turn * yx + c1 * c1 * shear * xy,
            ],
            [
                c2 * turn * xy + c2 * c2 * shear * yx,
                normal * yy + c2 * cross * xx,
            ],
        ];
        model.disc.scatter_stress(
            p..p + 1,
            &model.points.volume[p..p + 1],
            &[stress],
            &mut force,
        );
    }
    force.as_flattened().to_vec()
}

#[test]
fn the_published_layer_has_its_constants_in_the_right_places() {
    // at nu = 0.25 lambda = G and the printed exchange is invisible: so at 0.4
    let mut problem = tiny(SideMethod::new("pml-stretched").with("relaxed_modulus_ratio", 1.0));
    problem.material.poissons_ratio = 0.4;
    let mut model = setup::model(&problem).unwrap();
    model.begin_step(
        [0.0, problem.dt],
        Moment {
            step: 1,
            time_s: problem.dt,
        },
    );
    let n = model.grid.node_count();
    let rest = vec![[0.0; 2]; n];
    let u: Vec<Vector<2>> = (0..n)
        .map(|k| [(1.3 * k as f64).sin(), (0.7 * k as f64).cos()])
        .collect();
    let mut force = rest.clone();
    model
        .residual(
            &Motion {
                increment: &u,
                v: &rest,
                a: &rest,
            },
            &mut force,
        )
        .unwrap();
    let distance = |swapped: bool| {
        let exact = published_force(&problem, &model, &u, swapped);
        let free = force
            .as_flattened()
            .iter()
            .zip(&exact)
            .filter(|(f, _)| **f != 0.0);
        let (mut off, mut size) = (0.0, 0.0);
        for (f, e) in free {
            off += (f + e) * (f + e);
            size += e * e;
        }
        f64::sqrt(off / size)
    };
    println!(
        "distance to (11): {:.1e}, to the printed (25): {:.2}",
        distance(false),
        distance(true)
    );
    assert!(distance(false) < 1e-12);
    assert!(distance(true) > 0.05);
}
