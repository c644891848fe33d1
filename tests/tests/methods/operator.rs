//! Gates of the true layer's semi-discrete operator on a mesh small enough for dense algebra: symmetry,
//! spectrum. Analytic: the exact value follows from the equations.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic::spectrum::{small, spectrum};
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::problem::{MassKind, Problem, SolverKind};
use anechoic_solver::tensor::Vector;
use anechoic_tests::dense::{largest_real_part, probed, tiny};
use anechoic_tests::twin::{Broken, Twin};
use faer::Mat;

/// Reflection aimed at.
const REFLECTION: f64 = 1e-4;

fn pml() -> SideMethod {
    SideMethod::new("pml").with("reflection", REFLECTION)
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
    growth_of_layers(nu, alpha, false)
}

/// The same, or with rollers left and right instead of the layer.
fn growth_of_layers(nu: f64, alpha: f64, rollers: bool) -> f64 {
    let on = |problem: Problem<2>| match rollers {
        true => between_rollers(problem),
        false => problem,
    };
    let mut problem = on(tiny(pml().with("alpha_per_s", alpha)));
    problem.material.poissons_ratio = nu;
    let (model, free, _) = probed(&problem);
    let own = model.regions.last().unwrap().range.clone();
    let x = if rollers {
        [f64::MIN, f64::MAX]
    } else {
        [0.0, 60.0]
    };
    let geometry = [x, [-40.0, 0.0]];
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
    let mut plain = on(tiny(SideMethod::new("extended")));
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
    largest_real_part(&a) / (problem.material.p_speed() / 20.0)
}

/// With rollers left and right.
fn between_rollers(mut problem: Problem<2>) -> Problem<2> {
    problem.sides[0] = ["roller", "roller"].map(SideMethod::new);
    problem
}

#[test]
fn the_true_layers_spectrum_does_not_grow() {
    for nu in [0.0, 0.25, 0.4, 0.45, 0.49] {
        let growth = growth_of_the_true_layer(nu, 0.0);
        println!("nu = {nu}: largest real part {growth:.1e} c_p/h");
        assert!(growth < 1e-10);
    }
    // nearly incompressible material is too much for it, and the gate must see that
    let growth = growth_of_the_true_layer(0.499, 0.0);
    println!("nu = 0.499: largest real part {growth:.1e} c_p/h");
    assert!(growth > 1e-3);
    // one for a run of 20 s, and one far above what is of use
    for (nu, alpha) in [(0.25, 0.23), (0.4, 0.23), (0.25, 10.0)] {
        let growth = growth_of_the_true_layer(nu, alpha);
        println!("nu = {nu}, alpha = {alpha}/s: largest real part {growth:.1e} c_p/h");
        assert!(growth < 1e-10);
    }
}

/// The same by the steps of the solver itself, as `stability` prints it.
fn growth_by_steps(layer: SideMethod, nu: f64) -> f64 {
    growth_of_steps(tiny(layer), nu)
}

fn growth_of_steps(mut problem: Problem<2>, nu: f64) -> f64 {
    problem.material.poissons_ratio = nu;
    problem.dt = 20.0 / problem.material.p_speed();
    (problem.solver, problem.rel_tol) = (SolverKind::Direct, 1e-13);
    let start = std::time::Instant::now();
    let found = spectrum(&problem).unwrap();
    println!(
        "nu = {nu}: {:.3e} c_p/h by steps, {} unknowns, {:.1} s",
        found.growth,
        found.unknowns,
        start.elapsed().as_secs_f64()
    );
    found.growth
}

#[test]
fn the_steps_of_the_solver_have_the_spectrum_of_the_equations() {
    // grows, and by what the layer's equations say on the same mesh, point by point
    let (steps, equations) = (
        growth_by_steps(pml(), 0.499),
        growth_of_the_true_layer(0.499, 0.0),
    );
    assert!(
        (steps / equations - 1.0).abs() < 1e-6,
        "{steps} {equations}"
    );
    let shifted = growth_by_steps(pml().with("alpha_per_s", 10.0), 0.25);
    let equations = growth_of_the_true_layer(0.25, 10.0);
    assert!(
        (shifted / equations - 1.0).abs() < 1e-6,
        "{shifted} {equations}"
    );
    // where nothing grows, rounding is what is left, of which doubled modes at rest have the root
    let damping = SideMethod::new("damping-layer").with("sigma_max_per_s", 10.0);
    for (layer, nu) in [(pml(), 0.25), (pml(), 0.49), (damping, 0.25)] {
        assert!(growth_by_steps(layer, nu) < 1e-6);
    }
    // the published equations are ill-posed beyond 0.396
    let stretched = || SideMethod::new("pml-stretched").with("rayleigh_per_s", 0.0);
    assert!(growth_by_steps(stretched(), 0.49) > 1e-2);
}

#[test]
fn one_layer_between_rollers_grows_a_little_in_material_that_does_not_bulge() {
    for nu in [0.0, 0.25] {
        let equations = growth_of_layers(nu, 0.0, true);
        let steps = growth_of_steps(between_rollers(tiny(pml())), nu);
        println!("nu = {nu}: {equations:.3e} by the equations, {steps:.3e} by steps");
        match nu {
            0.0 => assert!(equations > 1e-3 && (steps / equations - 1.0).abs() < 1e-6),
            _ => assert!(equations < 1e-10 && steps < 1e-6),
        }
    }
}

#[test]
fn a_small_mesh_has_the_sides_of_its_scene() {
    let large = anechoic_tests::half_space(
        pml(),
        anechoic_solver::problem::PointMode::Moving,
        anechoic_solver::problem::Transfer::Affine,
    );
    let found = small(&large);
    let sides = |problem: &Problem<2>| -> Vec<String> {
        let sides = problem.sides.iter().flatten();
        sides.map(|side| side.method.clone()).collect()
    };
    assert_eq!(sides(&found), sides(&large));
    assert_eq!(found.sides[0][0].given_number("thickness_m"), Some(60.0));
    assert!(spectrum(&found).unwrap().unknowns < 2000);
}
