//! Gates of the reflection atlas.
#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic::atlas::Side;
use anechoic::atlas::strip::Strip;
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_reference::analytic::oblique::{Medium, Wave};
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::problem::{PointMode, Problem, Transfer};
use anechoic_tests::half_space;

#[test]
fn scratch() {
    for h in [20.0, 10.0, 5.0] {
        let mut like: Problem<2> = half_space(SideMethod::new("fixed"), PointMode::Frozen, Transfer::Keep);
        like.cell_size = h; like.dt = 0.01 * h / 20.0;
        let rock = Elastic::new(2e9, 0.25, 2000.0).unwrap();
        for (name, m) in [("fixed", SideMethod::new("fixed")), ("dashpot", SideMethod::new("dashpot")), ("damping", SideMethod::new("damping-layer").with("thickness_m", 600.0)),
            ("pml", SideMethod::new("pml").with("thickness_m", 200.0).with("reflection", 1e-4)), ("stretched", SideMethod::new("pml-stretched").with("thickness_m", 400.0))] {
            let t = std::time::Instant::now();
            let side = Side::new(&Strip::new(&like, &m, h, 0.0).unwrap(), 2.0).unwrap();
            println!("{h} {name} {:?}", t.elapsed());
            for wave in Wave::BOTH {
                for angle in [0.0, 30.0, 45.0, 60.0, 75.0, 85.0] {
                    let r = side.reflection(wave, angle).unwrap();
                    let medium = Medium::new(&rock, wave, angle).unwrap();
                    let c = match name {
                        "fixed" => medium.fixed(),
                        "dashpot" => medium.dashpot(1.0),
                        "pml" => medium.stretched(0.5 * rock.p_speed() * 1e4_f64.ln()),
                        _ => anechoic_reference::analytic::oblique::damping::Layer { thickness: 600.0, rate: |x: f64| 12.0 * (x / 600.0).powi(2) }.reflection(&medium, 2.0).unwrap(),
                    };
                    let all = |r: &anechoic_reference::analytic::oblique::Reflection| (r.total(wave), r.amplitude(wave, Wave::P), r.amplitude(wave, Wave::S));
                    println!("  {wave:?}@{angle} {:.6?}  {:.6?}", all(&r), all(&c));
                }
            }
        }
    }
}
