//! What is promised of pipe-penetration (S21, section 3.3) at profile `gate`, cells of D/16.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic::commands::{self, Options, run};
use anechoic_reference::analytic::slip_line::{Interface, bearing_factor, merifield_smooth};
use anechoic_tests::study::{claims, compared, failing, print_claims, value};

/// The dynamic push against the soil that goes on (certified): the base's echo comes when its wave has run
/// to it and back (analytic, w/D = 0.168), the dashpot leaves 5 % and the true layer 2 % of the resistance.
///
/// S21's layer does not reach the paper's 5 % here: it leaves 22 %, where rollers leave 40 %. Its damping
/// grows over 1 m to 227/s, and what is longer than that comes back from the roller behind it. The window
/// says that it is this layer: a stronger or a weaker one leaves it.
#[test]
fn the_bases_echo_comes_in_time_and_absorbers_take_it() {
    let out = tempfile::tempdir().unwrap();
    let finished = compared(&Options::new("pipe-penetration", out.path()).profile("gate"));
    print_claims(&finished.rows);
    assert_eq!(failing(&finished.rows), ["damping-layer/fluctuation/pipe"]);
    let of = |method, metric| value(&finished.rows, method, metric, "pipe");
    let depth = of("fixed", "echo_depth");
    assert!((0.158..0.178).contains(&depth), "{depth}");
    assert!(of("dashpot", "fluctuation") < 0.05);
    assert!(of("pml", "fluctuation") < 0.02);
    let (layer, none) = (
        of("damping-layer", "fluctuation"),
        of("fixed", "fluctuation"),
    );
    println!("S21's layer leaves {layer:.3}, rollers {none:.3}");
    assert!((0.15..0.3).contains(&layer) && none > 1.3 * layer);
    for method in ["fixed", "dashpot", "damping-layer", "pml", "extended"] {
        let inside = of(method, "penetration_cells");
        assert!(inside < 0.2, "{method}: {inside} cells inside the pipe");
    }
}

/// What the paper's 5 % takes of a damping layer: four times its thickness, a free end. A sweep tells it
/// beside the extended run of each point (certified), and thinner ones leave more.
#[test]
fn a_damping_layer_of_four_metres_meets_five_per_cent() {
    let out = tempfile::tempdir().unwrap();
    let options = Options::new("pipe-penetration", out.path())
        .profile("gate")
        .method("damping-layer-thick");
    let over = ["damping-layer.thickness_m=1,2,4".to_owned()];
    let plan = commands::plan_sweep(&options, &over).unwrap();
    let finished = commands::execute(plan, &options).unwrap();
    let of = |metric: &str, metres: u32| {
        let place = format!("pipe@damping-layer.thickness_m={metres}");
        value(&finished.rows, "damping-layer-thick", metric, &place)
    };
    let left = [1, 2, 4].map(|metres| of("fluctuation", metres));
    println!("fluctuation behind 1, 2, 4 m: {left:.4?}");
    assert!(left[0] > 2.0 * left[1] && left[0] > 0.1 && left[2] < 0.05);
    assert!(of("echo_ratio", 1) > of("fluctuation", 1));
    // three layers beside one run of rollers and one of soil that goes on
    assert_eq!(finished.study.runs.len(), 5);
}

/// A push at 0.4 m/s, whose rho v^2 is 4 % of s_u, to w/D = 0.1, 0.2, 0.3: slip lines without heave below
/// (analytic), and a fit to finite elements with heave above (Merifield et al. 2009). The targets are 0.95 of
/// the one and 1.1 of the other: what lies below would be soil that is too weak.
///
/// With the points' own divergences it locks: more resistance, and pressures that alternate from cell to cell. The
/// mean over cells keeps a pressure's difference to its neighbours below a twelfth of it; 2 is a checkerboard.
#[test]
fn a_slow_push_meets_what_clay_can_bear() {
    let out = tempfile::tempdir().unwrap();
    let options = Options::new("pipe-penetration", out.path())
        .profile("gate")
        .method("fixed")
        .set("pipe.velocity_m_s=0.4");
    let finished = run(&options).unwrap();
    print_claims(&finished.rows);
    assert_eq!(claims(&finished.rows).count(), 6);
    assert!(failing(&finished.rows).is_empty());
    let locked = run(&options.set("flow.volume=point")).unwrap();
    let noise = [&finished, &locked].map(|f| value(&f.rows, "fixed", "checkerboard", "soil"));
    println!("alternating pressures over pressures: {noise:.3?}");
    assert!(noise[0] < 0.08 && noise[1] > 4.0 * noise[0]);
    for depth in [0.1, 0.2, 0.3] {
        let place = format!("w/D={depth}");
        let own = value(&finished.rows, "fixed", "resistance", &place);
        let stiff = value(&locked.rows, "fixed", "resistance", &place) / own;
        println!("w/D = {depth}: {stiff:.3} times as much where points keep their divergences");
        assert!((1.005..1.08).contains(&stiff), "{stiff}");
        let low = bearing_factor(Interface::Smooth, depth).unwrap();
        let high = merifield_smooth(depth).unwrap();
        println!("w/D = {depth}: {own:.3}, slip lines {low:.3}, fit {high:.3}");
        assert!(own > 0.95 * low && own < 1.1 * high, "{own}");
    }
}
