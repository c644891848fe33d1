//! Lamb's problem tests itself: arrivals, symmetry, decay, equation, surface, statics, quadrature, and
//! an independent transform.

mod field;
mod wavenumber;

use super::*;
use std::f64::consts::PI;

const BOTH: [Direction; 2] = [Direction::Vertical, Direction::Horizontal];

/// The scene's receivers (offset, depth).
const RECEIVERS: [(f64, f64); 4] = [(500.0, 0.0), (300.0, 100.0), (900.0, 300.0), (0.0, 600.0)];

fn rock() -> Elastic {
    Elastic::new(2e9, 0.25, 2000.0).unwrap()
}

/// Lambda differs from G, as it does not in [`rock`].
fn clay() -> Elastic {
    Elastic::new(2e9, 0.4, 2000.0).unwrap()
}

fn response(material: &Elastic, (offset, depth): (f64, f64), end: f64, panel: f64) -> Response {
    Response::new(material, offset, depth, end, panel).unwrap()
}

/// Ricker of 3 Hz at 0.5 s.
fn ricker(t: f64) -> f64 {
    let a = (3.0 * PI * (t - 0.5)).powi(2);
    (1.0 - 2.0 * a) * (-a).exp()
}

/// sin^2 of 0.02 s.
fn short(t: f64) -> f64 {
    if t < 0.02 {
        (50.0 * PI * t).sin().powi(2)
    } else {
        0.0
    }
}

/// Largest value of one component around `arrival`, and its time, on steps of 0.1 ms.
fn peak(
    material: &Elastic,
    place: (f64, f64),
    direction: Direction,
    component: usize,
    arrival: f64,
) -> (f64, f64) {
    let response = response(material, place, arrival + 0.1, 0.005);
    (-100..500)
        .map(|i| {
            let t = arrival + f64::from(i) * 1e-4;
            let u = response.displacement(direction, short, t).unwrap();
            (u[component].abs(), t)
        })
        .fold(
            (0.0, 0.0),
            |best, now| if now.0 > best.0 { now } else { best },
        )
}

#[test]
fn nothing_moves_before_p_arrives() {
    for place in RECEIVERS {
        let arrival = place.0.hypot(place.1) / rock().p_speed();
        let response = response(&rock(), place, 3.0, 0.02);
        let step = |_: f64| 1.0;
        for direction in BOTH {
            let before = response.displacement(direction, step, arrival * (1.0 - 1e-12));
            assert_eq!(before, Ok([0.0; 2]), "{place:?}");
            let after = response
                .displacement(direction, step, arrival + 0.01)
                .unwrap();
            assert!(after[0].hypot(after[1]) > 1e-13, "{place:?}: {after:?}");
        }
    }
}

#[test]
fn p_and_s_arrive_below_the_force_and_rayleigh_along_the_surface() {
    let (rock, below, along) = (rock(), (0.0, 1200.0), (1200.0, 0.0));
    let (p, s) = (1200.0 / rock.p_speed(), 1200.0 / rock.s_speed());
    // A pulse of 0.02 s behind an inverse square root peaks within itself.
    let (_, own) = peak(&rock, below, Direction::Vertical, 1, p);
    assert!((0.0..0.02).contains(&(own - p)), "{own} {p}");
    let (_, own) = peak(&rock, below, Direction::Horizontal, 0, s);
    assert!((0.0..0.02).contains(&(own - s)), "{own} {s}");
    // The horizontal motion under a vertical force repeats the pulse itself.
    let rayleigh = 1200.0 / rock.rayleigh_speed();
    let (_, own) = peak(&rock, along, Direction::Vertical, 0, rayleigh);
    assert!((own - 0.01 - rayleigh).abs() < 1e-3, "{own} {rayleigh}");
}

#[test]
fn body_waves_decay_with_the_root_of_distance_and_the_rayleigh_pulse_not_at_all() {
    let rock = rock();
    for (direction, component, speed) in [
        (Direction::Vertical, 1, rock.p_speed()),
        (Direction::Horizontal, 0, rock.s_speed()),
    ] {
        let at = |depth: f64| peak(&rock, (0.0, depth), direction, component, depth / speed).0;
        // Far, since directivity bends sharply about the vertical.
        let ratio = at(9600.0) / at(38_400.0);
        assert!((ratio - 2.0).abs() < 0.03, "{direction:?}: {ratio}");
    }
    let at = |x: f64| {
        let arrival = x / rock.rayleigh_speed();
        peak(&rock, (x, 0.0), Direction::Vertical, 0, arrival).0
    };
    let ratio = at(600.0) / at(2400.0);
    assert!((ratio - 1.0).abs() < 1e-3, "{ratio}");
}

#[test]
fn force_and_receiver_change_places_on_the_surface() {
    for material in [rock(), clay()] {
        let right = response(&material, (500.0, 0.0), 3.0, 0.05);
        let left = response(&material, (-500.0, 0.0), 3.0, 0.05);
        for i in 0..300 {
            let t = 0.01 * f64::from(i);
            let down = right.displacement(Direction::Vertical, ricker, t).unwrap();
            let across = left.displacement(Direction::Horizontal, ricker, t).unwrap();
            // To the right at +x under a force downward = downward at -x under a force to the right.
            assert!((down[0] + across[1]).abs() < 1e-22, "{t}");
        }
    }
}

#[test]
fn mirrored_receivers_mirror_the_motion() {
    let right = response(&rock(), (300.0, 100.0), 2.0, 0.05);
    let left = response(&rock(), (-300.0, 100.0), 2.0, 0.05);
    for (direction, sign) in [(Direction::Vertical, 1.0), (Direction::Horizontal, -1.0)] {
        let one = right.displacement(direction, ricker, 1.1).unwrap();
        let other = left.displacement(direction, ricker, 1.1).unwrap();
        assert_eq!([-sign * one[0], sign * one[1]], other);
    }
    let below = response(&rock(), (0.0, 600.0), 2.0, 0.05);
    let vertical = below
        .displacement(Direction::Vertical, ricker, 1.1)
        .unwrap();
    let horizontal = below
        .displacement(Direction::Horizontal, ricker, 1.5)
        .unwrap();
    assert!(vertical[0].abs() < 1e-12 * vertical[1].abs());
    assert!(horizontal[1].abs() < 1e-12 * horizontal[0].abs());
}

#[test]
fn quadrature_has_converged() {
    for place in [
        RECEIVERS[0],
        RECEIVERS[1],
        RECEIVERS[2],
        RECEIVERS[3],
        (700.0, 1.0),
        (3.0, 2.0),
    ] {
        let coarse = response(&rock(), place, 5.0, 0.08);
        let fine = response(&rock(), place, 5.0, 0.03);
        for direction in BOTH {
            let (mut largest, mut change) = (0.0f64, 0.0f64);
            for i in 0..500 {
                let t = 0.01 * f64::from(i);
                let one = coarse.displacement(direction, ricker, t).unwrap();
                let other = fine.displacement(direction, ricker, t).unwrap();
                largest = largest.max(one[0].hypot(one[1]));
                change = change.max((one[0] - other[0]).hypot(one[1] - other[1]));
            }
            // The force starts with a jump of 1e-8 of its peak.
            assert!(
                change < 1e-8 * largest,
                "{place:?} {direction:?}: {:e}",
                change / largest
            );
        }
    }
}

#[test]
fn depth_zero_is_the_limit_of_small_depth() {
    let surface = response(&clay(), (500.0, 0.0), 3.0, 0.05);
    let change = |depth: f64| {
        let buried = response(&clay(), (500.0, depth), 3.0, 0.05);
        let (mut change, mut largest) = (0.0f64, 0.0f64);
        for i in 0..300 {
            let t = 0.01 * f64::from(i);
            for direction in BOTH {
                let one = surface.displacement(direction, ricker, t).unwrap();
                let other = buried.displacement(direction, ricker, t).unwrap();
                change = change.max((one[0] - other[0]).hypot(one[1] - other[1]));
                largest = largest.max(one[0].hypot(one[1]));
            }
        }
        change / largest
    };
    let (shallow, shallower) = (change(0.1), change(0.001));
    assert!(shallow < 0.01, "{shallow}");
    // Linear in depth: the strain at the surface times the depth.
    let ratio = shallow / shallower;
    assert!((ratio / 100.0 - 1.0).abs() < 0.01, "{ratio}");
}

#[test]
fn refuses_what_it_cannot_serve() {
    let of = |offset, depth, end, panel| Response::new(&rock(), offset, depth, end, panel);
    assert!(of(0.0, 0.0, 1.0, 0.01).is_err());
    assert!(of(0.0, 0.005, 1.0, 0.01).is_err());
    assert!(of(f64::NAN, 1.0, 1.0, 0.01).is_err());
    assert!(of(10.0, -1.0, 1.0, 0.01).is_err());
    assert!(of(10.0, 0.0, 1.0, 0.0).is_err());
    let response = of(10.0, 0.0, 1.0, 0.01).unwrap();
    let late = response.series(Direction::Vertical, ricker, &[0.5, 1.5]);
    assert_eq!(
        late,
        Err(LambError::TooLate {
            time_s: 1.5,
            end_s: 1.0
        })
    );
}
