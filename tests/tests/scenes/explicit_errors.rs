//! What explicit steps refuse and how they fail: each by its field, or its step, time and place, with what
//! was recorded before; nothing wrong passes in silence.

#![allow(clippy::unwrap_used, reason = "a gate fails by panicking")]

use anechoic_solver::boundary::SideMethod;
use anechoic_solver::contact::body::{Motion, RigidBody};
use anechoic_solver::contact::shape::Shape;
use anechoic_solver::error::SolverError;
use anechoic_solver::probe::Receiver;
use anechoic_solver::problem::{
    BasisKind, Intruder, MassKind, PointMode, Problem, Scheme, StressUpdate, Transfer,
};
use anechoic_solver::record::Status;
use anechoic_tests::explicit::{FLOWS, flowing, leapfrog, plate};
use anechoic_tests::program::{anechoic, folder, narrow, read};
use anechoic_tests::{Unwatched, block, column};

/// The block in flight.
fn flying(kind: (BasisKind, StressUpdate)) -> Problem<2> {
    let block = block(Transfer::Affine, PointMode::Frozen);
    let mut problem = flowing(block, 0.4, kind, Transfer::Affine);
    problem.flow.velocity = [0.5, 0.0];
    problem.flow.room = [[0.0, 1.0], [0.0, 0.0]];
    problem.probes.receivers = vec![Receiver {
        name: "R".into(),
        place: [1.0, 1.0],
    }];
    problem
}

/// A block that flies at 0.5 m/s with 1 m of room ahead reaches the grid's end after 2 s, or two cells
/// later where functions are wide: the step, time and place of the point are told, what was recorded
/// before stands.
#[test]
fn a_point_that_leaves_the_grid_ends_the_run_with_its_step_time_and_place() {
    for kind in FLOWS {
        let problem = flying(kind);
        let outcome = anechoic_solver::solve(&problem, &Unwatched).unwrap();
        let Some(SolverError::LeftGrid {
            step,
            time_s,
            place,
        }) = &outcome.error
        else {
            panic!("{kind:?}: {:?}", outcome.error);
        };
        println!("{kind:?}: step {step}, t = {time_s:.3} s, at {place:?} m");
        assert!((1.9..4.1).contains(time_s) && (time_s / problem.dt - *step as f64).abs() < 1e-9);
        assert!(place[0] > 4.9 && place[1] > 0.0 && place[1] < 3.0);
        let record = &outcome.record;
        assert!(matches!(&record.status, Status::Failed(text) if text.contains("left the")));
        let kept = record.receivers.times.len();
        assert!(
            kept == *step || kept + 1 == *step,
            "{kept} samples before {step}"
        );
        let velocity = record.receivers.column("R_vx").unwrap();
        assert_eq!(velocity.len(), kept);
        assert!(velocity.iter().all(|v| (v - 0.5).abs() < 1e-9));
    }
}

/// The field at fault.
fn refused(problem: &Problem<2>) -> (String, String) {
    match anechoic_solver::solve(problem, &Unwatched) {
        Err(SolverError::Setup { field, reason }) => (field, reason),
        Err(error) => panic!("{error}"),
        Ok(outcome) => panic!("not refused: {:?}", outcome.error),
    }
}

#[test]
fn what_explicit_steps_do_not_have_is_refused_by_its_field() {
    let kind = (BasisKind::Gimp, StressUpdate::Usl);
    let side = |method: &str| {
        let mut problem = flying(kind);
        problem.sides[0][0] = SideMethod::new(method);
        problem
    };
    let mut towards = side("pml");
    towards.sides[0][1] = SideMethod::new("roller");
    let mut forced = side("pml");
    forced.sides[0][0] = SideMethod::new("pml").with_choice("with_flip", "force");
    forced.transfer = Transfer::Flip;
    let mut held = side("pml");
    held.sides[1][0] = SideMethod::new("fixed");
    let mut damped = side("pml");
    damped.sides[0][1] = SideMethod::new("damping-layer").with("thickness_m", 1.0);
    let mut loaded = side("pml");
    loaded.drives = column(1.0, SideMethod::new("roller")).drives;
    let mut still = side("pml");
    still.scheme = Scheme::Newmark;
    // the first comes by itself, the frame's own motion brings the second
    let mut met = side("pml");
    met.flow.intruders = vec![plate(3.1, -0.1, 0.5)];
    let mut waited = side("pml");
    waited.flow.intruders = vec![Intruder {
        name: "wall".to_owned(),
        body: RigidBody {
            shape: Shape::HalfPlane {
                place: [4.2, 0.0],
                normal: [-1.0, 0.0],
            },
            motion: Motion {
                velocity: [0.0; 2],
                rise: 0.0,
            },
        },
        contact: plate(3.1, -0.1, 0.5).contact,
    }];
    waited.end_time = 9.0;
    let mut wall = side("inflow");
    wall.sides[0][1] = SideMethod::new("roller");
    let mut backwards = side("inflow");
    backwards.flow.velocity = [-0.5, 0.0];
    let mut implicit = side("inflow");
    implicit.scheme = Scheme::Newmark;
    implicit.flow.velocity = [0.0; 2];
    let mut consistent = leapfrog(column(1.0, SideMethod::new("roller")), 0.4);
    consistent.mass = MassKind::Consistent;
    let printed = SideMethod::new("damping-layer")
        .with("thickness_m", 10.0)
        .with_choice("form", "printed");
    let mut negative = leapfrog(column(1.0, printed.clone()), 0.4);
    negative.sides[1][0] = printed.clone().with("alpha_per_m", 0.2);
    for (problem, at, word) in [
        (towards, "boundary.right.method", "not known to go along"),
        (forced, "boundary.left.method", "does not move"),
        (held, "boundary.bottom.method", "not known to go along"),
        (damped, "boundary.right.method", "not known to go along"),
        (loaded, "load", "loads stay"),
        (still, "material.velocity_m_s", "explicit"),
        (met, "plate", "comes to a layer"),
        (waited, "wall", "comes to a layer"),
        (wall, "boundary.left.method", "against the opposite side"),
        (backwards, "boundary.left.method", "needs more than 0"),
        (implicit, "boundary.left.method", "explicit steps"),
        (consistent, "time.mass", "lumped masses"),
        (column(1.0, printed), "boundary.bottom.form", "explicit"),
        (negative, "boundary.bottom.alpha_per_m", "changes its sign"),
    ] {
        let (field, reason) = refused(&problem);
        println!("{field}: {reason}");
        assert_eq!(field, at, "{reason}");
        assert!(reason.contains(word), "{reason}");
    }
}

/// The program refuses with exit code 2 and names the field.
#[test]
fn the_program_refuses_the_same_with_exit_code_2() {
    for (case, sets, words) in [
        (
            "mudmat",
            &["boundary.right.method=roller"][..],
            &["boundary.left.method", "free"][..],
        ),
        (
            "mudmat",
            &["boundary.top.method=pml"],
            &["boundary.left.method", "inflow", "not known to go along"],
        ),
        (
            "mudmat",
            &["time.scheme=newmark"],
            &["time.scheme", "explicit"],
        ),
        (
            "pipe-penetration",
            &["points.mode=frozen"],
            &["points.mode", "moving"],
        ),
        (
            "compression-1d",
            &["boundary.bottom.method=inflow"],
            &["boundary.bottom.method", "inflow needs explicit steps"],
        ),
        (
            "compression-1d",
            &["time.scheme=explicit", "time.mass=consistent"],
            &["time.mass", "lumped"],
        ),
        (
            "compression-1d",
            &["boundary.bottom={method=\"damping-layer\",thickness_m=10,form=\"printed\"}"],
            &["boundary.bottom.form", "printed", "explicit"],
        ),
    ] {
        let folder = folder();
        let mut arguments = vec!["run", case];
        for set in sets {
            arguments.extend(["--set", set]);
        }
        let output = anechoic(folder.path(), &arguments);
        assert_eq!(output.code, 2, "{arguments:?}: {}", output.err);
        for word in words {
            assert!(
                output.err.contains(word),
                "`{word}` is missing in {}",
                output.err
            );
        }
        assert!(!folder.path().join("results").exists());
    }
}

/// A step above the limit of the mesh is no input error, but never passes: a linear run grows and is
/// called unstable, and no claim is judged of it; points that move are turned inside out, with exit code 3.
#[test]
fn a_step_that_is_too_long_is_told() {
    let long = [
        "run",
        "compression-1d",
        "--preset",
        "explicit",
        "--set",
        "time.dt_s=0.017",
    ];
    let folder = folder();
    let output = anechoic(folder.path(), &narrow(&long));
    assert_ne!(output.code, 0, "{}", output.out);
    let told = format!("{}{}", output.out, output.err);
    assert!(
        told.contains("its energy grows by") && told.contains("unstable"),
        "{told}"
    );
    assert!(told.contains("0 pass"), "{told}");
    let moving = [
        "--set",
        "points.mode=moving",
        "--set",
        "points.transfer=affine",
    ];
    let output = anechoic(folder.path(), &narrow(&[&long[..], &moving].concat()));
    assert_eq!(output.code, 3, "{}", output.err);
    for word in ["in step ", "t = ", "time.dt_s", "m is inverted"] {
        assert!(
            output.err.contains(word),
            "{word} is missing in {}",
            output.err
        );
    }
}

/// Soil that heaps up before a mat higher than the room above the slide leaves the grid: exit code 3, and
/// the records until then are on disk.
#[test]
fn the_program_keeps_what_stands_when_points_leave() {
    let folder = folder();
    let output = anechoic(
        folder.path(),
        &[
            "run",
            "mudmat",
            "--profile",
            "gate",
            "--set",
            "mudmat.exposed_m=9",
            "--set",
            "time.end_s=2",
        ],
    );
    assert_eq!(output.code, 3, "{}", output.err);
    for word in [
        "left the background grid",
        "in step ",
        "t = ",
        "what stands is stored",
    ] {
        assert!(
            output.err.contains(word),
            "{word} is missing in {}",
            output.err
        );
    }
    let runs = folder.path().join("results/mudmat/none");
    let run = std::fs::read_dir(runs).unwrap().next().unwrap().unwrap();
    let series = read(&run.path().join("receivers.csv"));
    let steps = series.lines().count();
    println!("{steps} lines of series");
    assert!(steps > 50 && !series.contains("NaN"), "{steps}");
    assert!(read(&run.path().join("manifest.json")).contains("left the background grid"));
}
