//! Gates of the reflection atlas: the solver's harmonic states against closed forms and against runs in
//! time; broken methods must fail.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic::atlas::Side;
use anechoic::atlas::bloch::{modes, reflection};
use anechoic::atlas::strip::{Stiffness, Strip};
use anechoic::atlas::subject::Subject;
use anechoic::atlas::surface;
use anechoic::prepare::{Request, Target};
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_reference::analytic::oblique::matrix2::Matrix2;
use anechoic_reference::analytic::oblique::{Medium, Reflection, Wave};
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::probe::Receiver;
use anechoic_solver::problem::{BasisKind, Drive, PointMode, Problem, Transfer};
use anechoic_solver::wavelet::{Pulse, Wavelet};
use anechoic_tests::program::{anechoic, folder, read, rows};
use anechoic_tests::{half_space, solved};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Frequency of the waves (Hz); P is 27.4 and S 15.8 cells of 20 m long.
const FREQUENCY: f64 = 2.0;
const CELL: f64 = 20.0;
const ANGLES: [f64; 6] = [0.0, 30.0, 45.0, 60.0, 75.0, 85.0];

/// The material of K25 3.1 on cells of `h` metres, half a millisecond a metre.
fn rock(h: f64) -> Problem<2> {
    let mut problem = half_space(SideMethod::new("fixed"), PointMode::Frozen, Transfer::Keep);
    problem.cell_size = h;
    problem.dt = 5e-4 * h;
    problem
}

fn strip(h: f64, method: &SideMethod) -> Strip {
    Strip::new(&rock(h), method, h, 0.0).unwrap()
}

fn medium(wave: Wave, angle: f64) -> Medium {
    Medium::new(&Elastic::new(2e9, 0.25, 2000.0).unwrap(), wave, angle).unwrap()
}

fn pml(reflection: f64) -> SideMethod {
    let layer = SideMethod::new("pml").with("thickness_m", 200.0);
    layer.with("reflection", reflection)
}

/// Largest distance between what comes back and a closed form, over waves and angles.
fn worst(side: &Side, closed: impl Fn(&Medium) -> Reflection) -> f64 {
    let mut worst = 0.0_f64;
    for wave in Wave::BOTH {
        for angle in ANGLES {
            let own = side.reflection(wave, angle).unwrap().total(wave);
            let exact = closed(&medium(wave, angle)).total(wave);
            worst = worst.max((own - exact).abs());
        }
    }
    worst
}

/// Analytic: an elastic body dissipates nothing, whatever P and S become at its end.
#[test]
fn elastic_ends_return_all_energy() {
    let elastic = SideMethod::new("extended").with("thickness_m", 100.0);
    for method in ["fixed", "free", "roller"]
        .map(SideMethod::new)
        .iter()
        .chain([&elastic])
    {
        let side = Side::new(&strip(CELL, method), FREQUENCY).unwrap();
        for wave in Wave::BOTH {
            for angle in ANGLES {
                let total = side.reflection(wave, angle).unwrap().total(wave);
                assert!(
                    (total - 1.0).abs() < 1e-8,
                    "{method:?} {wave:?}@{angle}: {total}"
                );
            }
        }
    }
}

/// Analytic: the two conditions of dashpots, at all angles, with the P and S that they turn into each
/// other. A mesh's impedance is off by (k h)^2/8, which leaves (k h)^2/16 head-on.
#[test]
fn dashpots_follow_their_closed_form() {
    let turn = |h: f64| 2.0 * PI * FREQUENCY * h / (0.4 * 2e9 / 2000.0_f64).sqrt();
    let mut errors = Vec::new();
    for h in [CELL, 0.5 * CELL] {
        let side = Side::new(&strip(h, &SideMethod::new("dashpot")), FREQUENCY).unwrap();
        let head_on = side.reflection(Wave::S, 0.0).unwrap().total(Wave::S);
        let share = head_on / (turn(h).powi(2) / 16.0);
        assert!((share - 1.0).abs() < 0.05, "head-on at {h} m: {share}");
        let error = worst(&side, |medium| medium.dashpot(1.0));
        println!(
            "dashpot, {h} m: {error:.5}, bound {:.5}",
            turn(h).powi(2) / 8.0
        );
        assert!(error < turn(h).powi(2) / 8.0);
        errors.push(error);
    }
    let order = (errors[0] / errors[1]).log2();
    assert!((1.9..2.1).contains(&order), "order {order}");
}

/// A dashpot on half the mass, the classic slip: what it leaves is its own closed form and not that of
/// the whole impedance.
#[test]
fn half_the_impedance_is_found_out() {
    let half = SideMethod::new("dashpot").with("impedance", 0.5);
    let side = Side::new(&strip(CELL, &half), FREQUENCY).unwrap();
    let bound = (0.4_f64).powi(2) / 8.0;
    assert!(worst(&side, |medium| medium.dashpot(1.0)) > 10.0 * bound);
    assert!(worst(&side, |medium| medium.dashpot(0.5)) < bound);
    let head_on = side.reflection(Wave::P, 0.0).unwrap().total(Wave::P);
    assert!((head_on - 1.0 / 3.0).abs() < bound, "{head_on}");
}

/// What halving the cells leaves in the limit, whose error falls with the square.
fn limit(levels: &[Side; 2], wave: Wave, angle: f64) -> f64 {
    let at = |side: &Side| side.reflection(wave, angle).unwrap().total(wave);
    let [coarse, fine] = levels;
    (4.0 * at(fine) - at(coarse)) / 3.0
}

/// Analytic: where the layer is what reflects, it reflects as it does in the continuum.
#[test]
fn the_true_layer_follows_the_law_of_the_cosine() {
    let strength = 0.5 * (1.2 * 2e9 / 2000.0_f64).sqrt() * 100_f64.ln();
    let levels = |aim: f64| {
        [0.5 * CELL, 0.25 * CELL].map(|h| Side::new(&strip(h, &pml(aim)), FREQUENCY).unwrap())
    };
    let (layer, other) = (levels(1e-2), levels(1e-3));
    for (wave, angle) in [
        (Wave::P, 0.0),
        (Wave::P, 30.0),
        (Wave::P, 75.0),
        (Wave::S, 75.0),
    ] {
        let exact = medium(wave, angle).stretched(strength).total(wave);
        let own = limit(&layer, wave, angle);
        println!("pml R = 1e-2, {wave:?}@{angle}: {own:.5} for {exact:.5}");
        assert!((own / exact - 1.0).abs() < 0.005, "{wave:?}@{angle}");
        // a layer that aims at ten times less is another one
        let share = limit(&other, wave, angle) / exact;
        assert!((share - 1.0).abs() > 0.3, "{wave:?}@{angle}: {share}");
    }
}

/// Steps of a run in time, and the rate (1/s) at which its record is damped: what is left at its end
/// is exp(-18) of a wave.
const STEPS: usize = 2000;
const DAMPING: f64 = 0.9;
/// Cells up the strip of a run in time: half a wave along the side.
const ROWS: usize = 16;
/// Columns of a run in time: the forces, two in which waves are told apart, the side; and the side's in
/// the atlas, whose waves are told apart in the same places.
const FORCED: usize = 6;
const TOLD: [usize; 2] = [14, 18];
const SIDE: [usize; 2] = [24, 4];

/// The strip in time: `SIDE` long, `ROWS` high between mirrors, forces along a line. Standing along
/// the side, u_x goes as cos and u_y as sin of pi y/H.
fn in_time(method: &SideMethod, component: usize) -> Problem<2> {
    let like = strip(CELL, method).problem;
    let height = ROWS as f64 * CELL;
    let turn = |row: usize| PI * row as f64 / ROWS as f64;
    let mut direction = [0.0; 2];
    direction[component] = 1.0;
    let force = |row: usize| {
        // nodes on the mirrors have half the mass
        let shape = match component {
            0 if row == 0 || row == ROWS => 0.5 * turn(row).cos(),
            0 => turn(row).cos(),
            _ => turn(row).sin(),
        };
        Drive::PointForce {
            place: [FORCED as f64 * CELL, row as f64 * CELL],
            direction,
            pulse: Pulse {
                wavelet: Wavelet::Ricker,
                amplitude: 1e6 * shape,
                frequency: FREQUENCY,
                t0: 0.6,
            },
        }
    };
    let mut problem = like;
    problem.target.lower = [0.0, 0.0];
    problem.target.upper = [SIDE[0] as f64 * CELL, height];
    problem.sides[0][0] = SideMethod::new("dashpot");
    problem.sides[1] = [SideMethod::new("roller"), SideMethod::new("roller")];
    problem.drives = (0..=ROWS).map(force).collect();
    problem.end_time = STEPS as f64 * problem.dt;
    let receiver = |name: &str, column: usize, y: f64| Receiver {
        name: name.into(),
        place: [TOLD[column] as f64 * CELL, y],
    };
    problem.probes.receivers = vec![
        receiver("x0", 0, 0.0),
        receiver("x1", 1, 0.0),
        receiver("y0", 0, 0.5 * height),
        receiver("y1", 1, 0.5 * height),
    ];
    problem.rel_tol = 1e-12;
    problem
}

/// Amplitudes of the waves in a run, to the right and to the left in P and S each, at the growth `z` of
/// a step: displacements of two columns are four numbers for four waves.
fn waves_in_time(problem: &Problem<2>, stiffness: &Stiffness, z: Complex64) -> [[Complex64; 2]; 2] {
    let record = solved(problem);
    let transform = |name: &str| -> Complex64 {
        let series = record.receivers.column(name).unwrap().iter().enumerate();
        series.map(|(n, u)| z.powi(-(n as i32)) * u).sum()
    };
    // u_y = i times the amplitude of the wave that goes up: the other one is its mirror image
    let column = |c: usize| {
        let y = transform(&format!("y{c}_uy"));
        [transform(&format!("x{c}_ux")), Complex64::I * y]
    };
    let turn = PI / ROWS as f64;
    let [p, s] = modes(stiffness.turned(1, turn)).unwrap();
    // columns as the atlas counts them, from its own column 0 on
    let at = |column: usize| {
        let c = (column + SIDE[1]) as i32 - SIDE[0] as i32;
        let right = Matrix2::columns(
            p.right.map(|x| x * p.step.powi(c)),
            s.right.map(|x| x * s.step.powi(c)),
        );
        let left = Matrix2::columns(
            p.left.map(|x| x * p.step.powi(-c)),
            s.left.map(|x| x * s.step.powi(-c)),
        );
        (right, left)
    };
    let ((r0, l0), (r1, l1)) = (at(TOLD[0]), at(TOLD[1]));
    let (u0, u1) = (column(0), column(1));
    // r0 a + l0 b = u0, r1 a + l1 b = u1
    let across = l1 * l0.inverse();
    let moved = across.apply(u0);
    let a = (r1 - across * r0)
        .inverse()
        .apply([u1[0] - moved[0], u1[1] - moved[1]]);
    let known = r0.apply(a);
    let b = l0.inverse().apply([u0[0] - known[0], u0[1] - known[1]]);
    [a, b]
}

/// Runs of the solver in time and its harmonic state reflect alike, for P and S at once: two runs with
/// forces across and along the side give the whole matrix. Their records are damped, which makes the
/// frequency complex and the run's end harmless.
#[test]
fn runs_in_time_reflect_as_the_atlas_says() {
    let methods = [
        SideMethod::new("dashpot"),
        pml(1e-2),
        SideMethod::new("damping-layer").with("thickness_m", 200.0),
        SideMethod::new("pml-stretched").with("thickness_m", 200.0),
    ];
    for method in &methods {
        let dt = rock(CELL).dt;
        let z = (Complex64::new(DAMPING, 2.0 * PI * FREQUENCY) * dt).exp();
        let stiffness = strip(CELL, method).stiffness(z).unwrap();
        let [x, y] = [0, 1].map(|c| waves_in_time(&in_time(method, c), &stiffness, z));
        let incident = Matrix2::columns(x[0], y[0]);
        let back = Matrix2::columns(x[1], y[1]);
        let measured = back * incident.inverse();
        let atlas = reflection(&stiffness, PI / ROWS as f64).unwrap().amplitudes;
        let difference = (measured - atlas).largest();
        println!(
            "{}: {:.4}, differs by {difference:.1e}",
            method.method,
            atlas.largest()
        );
        assert!(atlas.largest() > 1e-3);
        assert!(difference < 1e-9, "{method:?}");
    }
}

/// Surface waves, by runs in time: a wall returns most of them (the rest goes down as P and S), a dashpot
/// of body waves' impedances an eighth, a true layer next to nothing.
#[test]
fn surface_waves_come_back_from_what_is_not_made_for_them() {
    let request = Request {
        target: "point-source".to_owned(),
        ..Request::default()
    };
    let target = Target::find(&request).unwrap();
    let subjects = ["fixed-at-target", "dashpot", "pml"]
        .map(|method| Subject::of(&target.prepare(Some(method)).unwrap()).unwrap());
    let returned = surface::measure(&subjects, 1).unwrap();
    println!("Rayleigh: {returned:?}");
    let [wall, dashpot, layer] = returned.try_into().unwrap();
    assert!((0.5..1.0).contains(&wall), "{wall}");
    assert!((0.05..0.25).contains(&dashpot), "{dashpot}");
    assert!(layer < 0.01 && layer < 0.05 * dashpot, "{layer}");
}

/// The command on a small scale: rows, verdicts, files.
#[test]
fn the_command_measures_and_judges() {
    let folder = folder();
    let arguments = [
        "atlas",
        "point-source",
        "--method",
        "dashpot",
        "--method",
        "pml",
    ];
    let call = |more: &[&str]| anechoic(folder.path(), &[&arguments[..], more].concat());
    let done = call(&["--format", "json"]);
    assert_eq!(done.code, 0, "{}", done.err);
    let all = rows(&done.out);
    let value = |place: &str, method: &str| {
        let of = |key: &str, row: &serde_json::Value| row[key].as_str().map(str::to_owned);
        all.iter()
            .find(|r| {
                of("where", r).as_deref() == Some(place)
                    && of("method", r).as_deref() == Some(method)
            })
            .and_then(|r| r["value"].as_f64())
            .unwrap_or_else(|| panic!("no row {method} {place}"))
    };
    assert!(value("P@30deg", "dashpot") > 5.0 * value("P@30deg", "pml"));
    assert!(value("P@45deg:thickness=1000m", "pml") < value("P@45deg:thickness=200m", "pml"));
    assert!(value("P@45deg:h=5m", "pml") < value("P@45deg:h=40m", "pml"));
    assert!(value("P-S@30deg", "dashpot") > 0.0);
    let study = folder.path().join("results/point-source-atlas");
    assert!(read(&study.join("report.html")).contains("Reflection against the angle"));
    for picture in [
        "reflection-angle",
        "reflection-thickness",
        "reflection-cells",
    ] {
        assert!(
            study.join(picture).with_extension("svg").is_file(),
            "{picture}"
        );
    }
    // the same bits with two jobs
    let again = call(&["--format", "json", "--jobs", "2"]);
    assert_eq!(done.out, again.out);
    // what harmonic states do not describe is refused
    let refused = call(&["--set", "basis=bspline"]);
    assert_eq!(refused.code, 2, "{}", refused.err);
    assert!(refused.err.contains("basis"), "{}", refused.err);
}

#[test]
fn wide_functions_are_refused() {
    let mut like = rock(CELL);
    like.basis = BasisKind::Bspline;
    let refused = Strip::new(&like, &SideMethod::new("dashpot"), CELL, 0.0);
    assert!(refused.unwrap_err().to_string().contains("basis"));
    let slow = strip(CELL, &SideMethod::new("dashpot"));
    let refused = Side::new(&slow, 40.0).unwrap_err().to_string();
    assert!(refused.contains("four steps"), "{refused}");
}
