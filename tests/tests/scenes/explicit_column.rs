//! What is promised of compression-1d (S21, section 3.1) in explicit steps: the claims of the implicit
//! column, the same solution, and the same order of convergence in frozen and in moving points.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic::commands::{Options, converge};
use anechoic::error::exit;
use anechoic::over::Over;
use anechoic_reference::analytic::dalembert::{Base, Dalembert, Top};
use anechoic_reports::norms::order;
use anechoic_reports::row::Verdict;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::problem::{BasisKind, Drive, Problem, StressUpdate, Transfer};
use anechoic_tests::column;
use anechoic_tests::explicit::{FLOWS, flowing};
use anechoic_tests::solved;
use anechoic_tests::study::{claims, compared, failing, narrow_column, print_claims, value};

#[test]
fn the_claims_of_the_column_hold_in_explicit_steps() {
    let out = tempfile::tempdir().unwrap();
    for profile in ["gate", "quick"] {
        let mut options = narrow_column(out.path()).profile(profile);
        options.request.presets = vec!["explicit".to_owned()];
        let finished = compared(&options);
        print_claims(&finished.rows);
        assert_eq!(failing(&finished.rows), [""; 0]);
        assert_eq!(finished.exit_code(), exit::PASS);
        let passed = claims(&finished.rows).filter(|row| row.verdict == Some(Verdict::Pass));
        // of 14, B's peaks and B inside the damping layer are not evaluated
        assert_eq!(passed.count(), 12);
    }
}

/// Two integrators on one mesh: each is off the exact solution by what the mesh's kinks leave, and no
/// base tells one from the other.
#[test]
fn explicit_and_implicit_columns_stand_side_by_side() {
    let out = tempfile::tempdir().unwrap();
    let implicit = compared(&narrow_column(out.path()));
    let mut options = narrow_column(out.path());
    options.request.presets = vec!["explicit".to_owned()];
    let explicit = compared(&options);
    for method in ["fixed", "dashpot", "extended"] {
        for at in ["A", "B"] {
            let [one, two] = [&implicit, &explicit].map(|f| value(&f.rows, method, "rel_l2", at));
            println!("{method} {at}: rel_l2 implicit {one:.4}, explicit {two:.4}");
            assert!((0.7..1.2).contains(&(two / one)), "{method} {at}");
        }
    }
    let residual = |rows| value(rows, "pml", "residual", "A");
    let (one, two) = (residual(&implicit.rows), residual(&explicit.rows));
    println!("pml: residual implicit {one:.5}, explicit {two:.5}");
    assert!((two / one - 1.0).abs() < 0.5, "{one} {two}");
}

#[test]
fn a_smooth_pulse_converges_with_second_order_in_explicit_steps() {
    for method in ["fixed", "dashpot"] {
        let out = tempfile::tempdir().unwrap();
        let mut options = Options::new("compression-1d", out.path())
            .profile("quick")
            .method(method)
            .set("source.wavelet=sine-squared")
            .set("body.width_m=4")
            .set("receivers.A.x_m=2")
            .set("receivers.B.x_m=2");
        options.request.presets = vec!["explicit".to_owned()];
        let over = Over::parse("grid.h_m=4,2,1,0.5").unwrap();
        let finished = converge(&options, &[over], false).unwrap();
        for run in &finished.study.runs {
            let problem = run.prepared.scene.posed().plane().unwrap();
            let h = run.prepared.scene.cell_m();
            let courant = problem.dt * problem.material.p_speed() / h;
            assert!((courant - 0.4).abs() < 1e-12, "{courant}");
        }
        print_claims(&finished.rows);
        let orders: Vec<_> = claims(&finished.rows).collect();
        assert_eq!(orders.len(), 2);
        for row in orders {
            let at = (row.metric.as_str(), row.verdict);
            assert_eq!(at, ("order", Some(Verdict::Pass)), "{row:?}");
        }
    }
}

/// Root of the summed squares of the distance of A's velocity to d'Alembert's, over his.
fn distance(problem: &Problem<2>, base: Base) -> f64 {
    let record = solved(problem);
    let Drive::SideVelocity { pulse, .. } = &problem.drives[0] else {
        panic!("the column is driven at its top");
    };
    let (height, speed) = (problem.target.upper[1], problem.material.p_speed());
    let exact = Dalembert::new(height, speed, base, Top::Free, pulse.end()).unwrap();
    let (mut apart, mut whole) = (0.0, 0.0);
    for (t, v) in record
        .receivers
        .times
        .iter()
        .zip(record.receivers.column("A_vy").unwrap())
    {
        let truth = exact.velocity(|t| pulse.value(t), height, *t).unwrap();
        apart += (v - truth).powi(2);
        whole += truth * truth;
    }
    (apart / whole).sqrt()
}

/// Order of the distance over cells of 4, 2, 1, 0.5 m.
fn order_of(kind: (BasisKind, StressUpdate), base: &str, exact: Base) -> f64 {
    // 4 m do not divide 50 m
    let sizes = [50.0 / 13.0, 2.0, 1.0, 0.5];
    let errors = sizes.map(|h| {
        let problem = column(h, SideMethod::new(base));
        let mut problem = flowing(problem, 0.4, kind, Transfer::Affine);
        problem.probes.energy_every = None;
        distance(&problem, exact)
    });
    let order = order(&sizes, &errors).unwrap();
    println!(
        "{kind:?} over {base}: {errors:.5?}, order {:.2}, pairwise {:.2?}",
        order.fit.value, order.pairwise
    );
    order.fit.value
}

/// Analytic: d'Alembert. Flowing points of small strain are of second order as frozen ones are. Quadratic
/// B-splines, which the body's ends cut off without a change of their form, have errors of the first order
/// there: 1.45 to 2.0 over these cells.
#[test]
fn moving_points_converge_with_second_order() {
    let absorbing = Base::Absorbing;
    for kind in FLOWS {
        for (base, exact) in [("roller", Base::Roller), ("dashpot", absorbing)] {
            let order = order_of(kind, base, exact);
            let least = match kind.0 {
                BasisKind::Bspline => 1.3,
                _ => 1.6,
            };
            assert!(
                (least..2.2).contains(&order),
                "{kind:?} over {base}: {order}"
            );
        }
    }
}
