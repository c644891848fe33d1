mod column;

use super::*;

const MASS: f64 = 2.0;
const BODY: Vector<2> = [0.5, -5.0];
/// Down and to the right, out of a body that moves down.
const NORMAL: Vector<2> = [0.6, -0.8];

/// Normal and tangential part of `velocity` less the body's.
fn parts(velocity: &Vector<2>) -> (f64, f64) {
    let w = [velocity[0] - BODY[0], velocity[1] - BODY[1]];
    (dot(&w, &NORMAL), w[0] * 0.8 + w[1] * 0.6)
}

fn contact(friction: f64) -> Contact {
    Contact {
        friction,
        reach: 1.0,
    }
}

/// Velocities that approach and part, slow and fast along the surface.
fn velocities() -> impl Iterator<Item = Vector<2>> {
    (0..200).map(|n| {
        let (a, b) = (0.7 * f64::from(n), 1.9 * f64::from(n));
        [BODY[0] + 3.0 * a.sin(), BODY[1] + 4.0 * b.cos()]
    })
}

#[test]
fn without_friction_only_the_approach_is_taken() {
    let velocity = [0.5, 1.0];
    let (approach, slide) = parts(&velocity);
    assert!(approach < 0.0);
    let response = contact(0.0)
        .respond(MASS, &velocity, &BODY, &NORMAL, 1.0)
        .expect("it is touched");
    let (after, slide_after) = parts(&response.velocity);
    assert!(after.abs() < 1e-14);
    assert!((slide_after - slide).abs() < 1e-14);
    // 2 kg that approach at 0.8 * 6 m/s.
    assert!((dot(&response.impulse, &NORMAL) - 9.6).abs() < 1e-14);
}

#[test]
fn what_parts_is_not_pulled() {
    let mut parting = 0;
    for velocity in velocities() {
        let response = contact(0.3).respond(MASS, &velocity, &BODY, &NORMAL, 1.0);
        assert_eq!(response.is_none(), parts(&velocity).0 >= 0.0);
        if let Some(response) = response {
            assert!(dot(&response.impulse, &NORMAL) > 0.0);
        } else {
            parting += 1;
        }
    }
    assert!((50..150).contains(&parting), "{parting}");
}

#[test]
fn impulse_is_the_change_of_momentum() {
    for velocity in velocities() {
        if let Some(response) = contact(0.3).respond(MASS, &velocity, &BODY, &NORMAL, 1.0) {
            for i in 0..2 {
                let change = MASS * (response.velocity[i] - velocity[i]);
                assert!((change - response.impulse[i]).abs() < 1e-13);
            }
        }
    }
}

#[test]
fn friction_stays_in_the_cone_and_against_the_motion() {
    let (mut sticking, mut sliding) = (0, 0);
    for velocity in velocities() {
        let Some(response) = contact(0.3).respond(MASS, &velocity, &BODY, &NORMAL, 1.0) else {
            continue;
        };
        let along = response.impulse[0] * 0.8 + response.impulse[1] * 0.6;
        let across = dot(&response.impulse, &NORMAL);
        let (before, after) = (parts(&velocity).1, parts(&response.velocity).1);
        assert!(along * before <= 0.0);
        assert!(along.abs() <= 0.3 * across * (1.0 + 1e-12));
        if after.abs() < 1e-13 {
            sticking += 1;
        } else {
            // What slides does so on the cone, and on in its direction.
            assert!((along.abs() - 0.3 * across).abs() < 1e-12);
            assert!(after * before > 0.0);
            sliding += 1;
        }
    }
    assert!(sticking > 5 && sliding > 20, "{sticking} {sliding}");
}

#[test]
fn sticking_turns_to_sliding_at_the_coefficient() {
    // Approach 1, slide 0.5: the ratio is the coefficient that just holds.
    let velocity = [
        BODY[0] - NORMAL[0] + 0.5 * 0.8,
        BODY[1] - NORMAL[1] + 0.5 * 0.6,
    ];
    let left = |friction| {
        let response = contact(friction).respond(MASS, &velocity, &BODY, &NORMAL, 1.0);
        parts(&response.expect("it is touched").velocity).1
    };
    assert!(left(0.5001).abs() < 1e-14);
    assert!((left(0.4) - 0.1).abs() < 1e-14);
    assert!((left(0.0) - 0.5).abs() < 1e-14);
}

#[test]
fn in_the_bodys_frame_energy_never_grows() {
    for friction in [0.0, 0.3, 2.0] {
        for velocity in velocities() {
            if let Some(response) = contact(friction).respond(MASS, &velocity, &BODY, &NORMAL, 1.0)
            {
                let energy = |v: &Vector<2>| {
                    let (n, t) = parts(v);
                    n * n + t * t
                };
                assert!(energy(&response.velocity) < energy(&velocity));
            }
        }
    }
}

#[test]
fn friction_in_three_dimensions_is_against_the_slide() {
    let contact = contact(0.5);
    let response = contact
        .respond(1.0, &[3.0, 4.0, -2.0], &[0.0; 3], &[0.0, 0.0, 1.0], 1.0)
        .expect("it is touched");
    // Normal impulse 2, so 1 along the slide of 5 in the direction (0.6, 0.8).
    let expected = [-0.6, -0.8, 2.0];
    for (own, other) in response.impulse.iter().zip(expected) {
        assert!((own - other).abs() < 1e-14);
    }
}

#[test]
fn part_of_a_touch_takes_part_of_the_approach_and_less_friction() {
    let velocity = [BODY[0] - 0.6 + 0.8, BODY[1] + 0.8 + 0.6];
    assert!((parts(&velocity).0 + 1.0).abs() < 1e-14 && (parts(&velocity).1 - 1.0).abs() < 1e-14);
    let response = contact(0.5)
        .respond(MASS, &velocity, &BODY, &NORMAL, 0.4)
        .expect("it is touched");
    let (normal, slide) = parts(&response.velocity);
    // 0.4 of the approach of 1, and half of that off the slide of 1.
    assert!((normal + 0.6).abs() < 1e-14);
    assert!((slide - 0.8).abs() < 1e-14);
    assert_eq!(
        contact(0.5).respond(MASS, &velocity, &BODY, &NORMAL, 0.0),
        None
    );
}

#[test]
fn a_node_counts_when_points_touch_and_it_is_near() {
    let share = |distance, gap| contact(0.0).share(distance, gap, 0.1, 0.2);
    assert_eq!(share(-0.05, 0.0), 1.0);
    assert_eq!(share(0.0, -0.01), 1.0);
    assert_eq!(share(-0.05, 0.001), 0.0);
    // A tenth of the reach left: 4 * 0.2 * 0.01; none left beyond.
    assert!((share(0.09, -0.001) - 0.008).abs() < 1e-15);
    assert_eq!(share(0.1, -0.001), 0.0);
    assert_eq!(share(0.11, -0.001), 0.0);
    let narrow = Contact {
        friction: 0.0,
        reach: 0.0,
    };
    assert_eq!(narrow.share(1e-9, -0.001, 0.1, 0.4), 0.0);
    assert_eq!(narrow.share(0.0, -0.001, 0.1, 0.4), 1.0);
    // Steps that are long for the dashpot stop at the body's velocity.
    assert_eq!(contact(0.0).share(0.001, -0.001, 0.1, 0.9), 1.0);
}

#[test]
fn a_point_reaches_out_by_its_box() {
    assert!((point_gap(1.0, &[0.1, 0.2], &[0.0, -1.0]) - 0.8).abs() < 1e-15);
    assert!((point_gap(1.0, &[0.1, 0.2], &[-0.6, 0.8]) - 0.78).abs() < 1e-15);
}

#[test]
fn the_reaction_is_the_opposite_of_the_impulses_over_the_step() {
    let force = reaction(&[[1.0, -2.0], [0.5, 3.0]], 0.25);
    assert_eq!(force, [-6.0, -4.0]);
}
