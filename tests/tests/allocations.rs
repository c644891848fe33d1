//! Memory: steps allocate nothing, the bill is what a run takes, and a scene pays only for what it names.

use allocation_counter::{AllocationInfo, measure};
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::contact::Contact;
use anechoic_solver::contact::body::{Motion, RigidBody};
use anechoic_solver::contact::shape::Shape;
use anechoic_solver::probe::Probes;
use anechoic_solver::problem::{
    BasisKind, Intruder, PointMode, Problem, SolverKind, StressUpdate, Transfer,
};
use anechoic_tests::explicit::{FLOWS, flowing, leapfrog};
use anechoic_tests::{block, column, solved};

/// A column that records nothing but the times of its steps.
fn silent(h: f64, base: SideMethod) -> Problem<2> {
    Problem {
        probes: Probes::default(),
        // A factor is not part of the bill.
        solver: SolverKind::Cg,
        end_time: 20.0 * 0.005 * h,
        ..column(h, base)
    }
}

fn allocations(problem: &Problem<2>) -> AllocationInfo {
    measure(|| {
        solved(problem);
    })
}

#[test]
fn steps_allocate_nothing() {
    let bases = [
        SideMethod::new("roller"),
        SideMethod::new("dashpot"),
        SideMethod::new("damping-layer").with("thickness_m", 10.0),
        SideMethod::new("pml").with("thickness_m", 10.0),
        SideMethod::new("pml")
            .with("thickness_m", 10.0)
            .with("alpha_per_s", 1.0),
    ];
    for base in bases {
        let name = base.method.clone();
        let after = |steps: f64| {
            let mut problem = silent(1.0, base.clone());
            problem.end_time = steps * problem.dt;
            allocations(&problem).count_total
        };
        // The pulse is over after 100 steps.
        let (short, long) = (after(150.0), after(250.0));
        println!("{name}: {short} allocations in 150 steps, {long} in 250");
        // The column of times holds 256 of them after both.
        assert!(short > 0);
        assert_eq!(short, long, "{name}");
    }
}

#[test]
fn a_layer_without_a_frequency_shift_pays_nothing_for_it() {
    let memory = |alpha: f64| {
        let layer = SideMethod::new("pml")
            .with("thickness_m", 10.0)
            .with("alpha_per_s", alpha);
        allocations(&silent(1.0, layer)).bytes_max
    };
    let plain = SideMethod::new("pml").with("thickness_m", 10.0);
    let plain = allocations(&silent(1.0, plain)).bytes_max;
    println!("{plain} B plain, {} B with a shift", memory(1.0));
    // the parameter's own name and number
    assert!(memory(0.0) < plain + 512 && memory(1.0) > plain + 4096);
}

/// Growth of the largest memory from one problem to another, as measured and as billed (bytes).
fn growth(from: &Problem<2>, to: &Problem<2>) -> [f64; 2] {
    let measured = |problem| allocations(problem).bytes_max as f64;
    let billed = |problem| {
        let bill = anechoic_solver::bill(problem).expect("the problem is well put");
        bill.bytes() as f64
    };
    [measured(to) - measured(from), billed(to) - billed(from)]
}

#[test]
fn the_bill_is_what_a_run_takes() {
    let small = silent(1.0, SideMethod::new("roller"));
    let more_points = Problem {
        points_per_cell: 16,
        ..small.clone()
    };
    let larger = silent(0.25, SideMethod::new("roller"));
    for (what, other) in [("points in the same cells", more_points), ("cells", larger)] {
        let [measured, billed] = growth(&small, &other);
        println!("more {what}: {measured} B measured, {billed} B billed");
        assert!(
            (billed / measured - 1.0).abs() < 0.25,
            "{what}: {measured} B, billed {billed} B"
        );
    }
}

#[test]
fn a_scene_without_a_layer_pays_nothing_for_it() {
    // The same material below the base, once as a layer and once plain, with 4 and with 16 points in the
    // same cells: what the points of the layer take on top is the same below a column of 50 m and of
    // 100 m, so the points of the column carry nothing of it.
    let extra = |height: f64| {
        let memory = |method: &str, points_per_cell: usize| {
            let mut problem = Problem {
                points_per_cell,
                ..silent(1.0, SideMethod::new(method).with("thickness_m", 20.0))
            };
            problem.target.upper[1] = height;
            allocations(&problem).bytes_max as f64
        };
        let of_points = |method| memory(method, 16) - memory(method, 4);
        of_points("pml") - of_points("extended")
    };
    let (short, tall) = (extra(50.0), extra(100.0));
    println!("points of a layer of 20 m: {short} B below 50 m, {tall} B below 100 m");
    assert!(
        short > 0.0 && (tall / short - 1.0).abs() < 0.05,
        "{short} {tall}"
    );
}

/// The block that a disc is pushed into, in leapfrog steps of points that move.
fn flowing_block(kind: (BasisKind, StressUpdate), transfer: Transfer) -> Problem<2> {
    let block = block(transfer, PointMode::Frozen);
    let mut problem = flowing(block, 0.4, kind, transfer);
    problem.probes = Probes::default();
    problem.flow.room = [[2.0; 2]; 2];
    problem.flow.intruders = vec![Intruder {
        name: "disc".into(),
        body: RigidBody {
            shape: Shape::Circle {
                centre: [-0.55, 1.3],
                radius: 0.5,
            },
            motion: Motion {
                velocity: [0.005, 0.0],
                rise: 0.0,
            },
        },
        contact: Contact {
            friction: 0.3,
            reach: 0.5,
        },
    }];
    problem
}

#[test]
fn explicit_steps_allocate_nothing() {
    let layers = [
        SideMethod::new("dashpot"),
        SideMethod::new("damping-layer").with("thickness_m", 10.0),
        SideMethod::new("pml").with("thickness_m", 10.0),
        SideMethod::new("pml")
            .with("thickness_m", 10.0)
            .with("alpha_per_s", 1.0),
    ];
    let frozen = layers.map(|base| (base.method.clone(), leapfrog(silent(1.0, base), 0.4)));
    let moving = FLOWS.into_iter().flat_map(|kind| {
        [Transfer::Affine, Transfer::Flip].map(|t| {
            let name = format!("{kind:?}, {t:?}, disc");
            (name, flowing_block(kind, t))
        })
    });
    for (name, problem) in frozen.into_iter().chain(moving) {
        let after = |steps: f64| {
            let mut problem = problem.clone();
            problem.end_time = steps * problem.dt;
            allocations(&problem).count_total
        };
        // points are sorted every few dozens of steps, among them
        let (short, long) = (after(150.0), after(250.0));
        println!("{name}: {short} allocations in 150 steps, {long} in 250");
        assert!(short > 0);
        assert_eq!(short, long, "{name}");
    }
}
