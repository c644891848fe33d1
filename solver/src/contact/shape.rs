//! Outlines of rigid bodies by signed distance: negative inside, with the unit normal out of the body.
//!
//! The rectangle's corners are arcs, so that the normal turns with the place; the distance is that of
//! the smaller rectangle inside, less the radius (the usual construction of implicit modelling).

use crate::error::SolverError;
use crate::tensor::{Vector, dot};

/// A body's outline in the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// A pipe.
    Circle {
        /// Centre (m).
        centre: Vector<2>,
        /// Radius (m).
        radius: f64,
    },
    /// A plate or mudmat.
    Rectangle {
        /// Centre (m).
        centre: Vector<2>,
        /// Half of the edges (m).
        half: Vector<2>,
        /// Radius of the corners (m), at most the smaller half edge.
        corner_radius: f64,
    },
    /// A base: all that lies behind a plane.
    HalfPlane {
        /// A point of the plane (m).
        place: Vector<2>,
        /// Unit normal out of the body.
        normal: Vector<2>,
    },
}

/// Where a place lies to a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Distance {
    /// Signed distance (m), negative inside.
    pub gap: f64,
    /// Unit normal out of the body.
    pub normal: Vector<2>,
}

impl Shape {
    /// Distance and normal at `x` (m). At a circle's very centre, where all normals serve, it is up.
    #[inline]
    pub fn distance(&self, x: &Vector<2>) -> Distance {
        match *self {
            Shape::Circle { centre, radius } => {
                let (length, normal) = direction([x[0] - centre[0], x[1] - centre[1]]);
                let gap = length - radius;
                Distance { gap, normal }
            }
            Shape::Rectangle {
                centre,
                half,
                corner_radius,
            } => rectangle([x[0] - centre[0], x[1] - centre[1]], half, corner_radius),
            Shape::HalfPlane { place, normal } => Distance {
                gap: dot(&[x[0] - place[0], x[1] - place[1]], &normal),
                normal,
            },
        }
    }

    /// Checks sizes.
    ///
    /// # Errors
    /// [`SolverError::Setup`] with the field under `body` and what it allows.
    pub fn check(&self) -> Result<(), SolverError> {
        let demand = |holds: bool, field: &str, reason: &str| {
            if holds {
                return Ok(());
            }
            Err(SolverError::Setup {
                field: format!("body.{field}"),
                reason: reason.to_owned(),
            })
        };
        let finite = |x: Vector<2>| x.iter().all(|c| c.is_finite());
        let positive = |x: f64| x.is_finite() && x > 0.0;
        match *self {
            Shape::Circle { centre, radius } => {
                demand(finite(centre), "centre_m", "use finite numbers")?;
                demand(positive(radius), "radius_m", "use a finite number above 0")
            }
            Shape::Rectangle {
                centre,
                half,
                corner_radius,
            } => {
                demand(finite(centre), "centre_m", "use finite numbers")?;
                let sizes = half.iter().all(|&x| positive(x));
                demand(sizes, "half_m", "use finite numbers above 0")?;
                demand(
                    (0.0..=half[0].min(half[1])).contains(&corner_radius),
                    "corner_radius_m",
                    "use 0 up to the smaller of body.half_m",
                )
            }
            Shape::HalfPlane { place, normal } => {
                demand(finite(place), "place_m", "use finite numbers")?;
                let unit = (dot(&normal, &normal) - 1.0).abs() < 1e-12;
                demand(unit, "normal", "use a vector of length 1")
            }
        }
    }
}

/// Length and unit vector of `x`.
#[inline]
fn direction(x: Vector<2>) -> (f64, Vector<2>) {
    let length = x[0].hypot(x[1]);
    if length > 0.0 {
        (length, [x[0] / length, x[1] / length])
    } else {
        (0.0, [0.0, 1.0])
    }
}

/// With q = |x| - (half - r) by axis: beyond both edges |q| - r, else max(q) - r.
#[inline]
fn rectangle(x: Vector<2>, half: Vector<2>, radius: f64) -> Distance {
    let q = [
        x[0].abs() - (half[0] - radius),
        x[1].abs() - (half[1] - radius),
    ];
    if q[0] > 0.0 && q[1] > 0.0 {
        let (length, n) = direction(q);
        return Distance {
            gap: length - radius,
            normal: [n[0].copysign(x[0]), n[1].copysign(x[1])],
        };
    }
    let axis = usize::from(q[1] >= q[0]);
    let mut normal = [0.0; 2];
    normal[axis] = 1f64.copysign(x[axis]);
    Distance {
        gap: q[axis] - radius,
        normal,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PIPE: Shape = Shape::Circle {
        centre: [0.5, 1.0],
        radius: 0.4,
    };
    const MAT: Shape = Shape::Rectangle {
        centre: [5.0, 0.5],
        half: [5.0, 0.5],
        corner_radius: 0.1,
    };
    const BASE: Shape = Shape::HalfPlane {
        place: [3.0, -1.0],
        normal: [-0.6, 0.8],
    };

    #[test]
    fn distances_are_those_measured_by_hand() {
        let gap = |shape: Shape, x| shape.distance(&x).gap;
        assert!((gap(PIPE, [0.5, 0.2]) - 0.4).abs() < 1e-15);
        assert!((gap(PIPE, [0.8, 1.4]) - 0.1).abs() < 1e-15);
        assert!((gap(PIPE, [0.5, 0.9]) + 0.3).abs() < 1e-15);
        assert!((gap(MAT, [-1.0, 0.5]) - 1.0).abs() < 1e-15);
        assert!((gap(MAT, [4.0, 3.0]) - 2.0).abs() < 1e-15);
        assert!((gap(MAT, [4.0, 0.8]) + 0.2).abs() < 1e-15);
        assert!((gap(MAT, [0.1, 0.5]) + 0.1).abs() < 1e-15);
        // The arc about (0.1, 0.9): the corner of the full rectangle lies outside it.
        assert!((gap(MAT, [0.0, 1.0]) - 0.1 * (2f64.sqrt() - 1.0)).abs() < 1e-15);
        assert!((gap(MAT, [-0.2, 1.3]) - 0.4).abs() < 1e-14);
        assert!((gap(BASE, [3.0, 0.0]) - 0.8).abs() < 1e-15);
        assert!((gap(BASE, [4.0, -1.0]) + 0.6).abs() < 1e-15);
    }

    /// The normal is the gradient of the distance, and going back by the distance meets the outline.
    #[test]
    fn normals_are_gradients_of_unit_length() {
        let step = 1e-6;
        for shape in [PIPE, MAT, BASE] {
            for n in 0..400 {
                let x = [
                    11.0 * (0.618 * f64::from(n)).fract() - 0.7,
                    3.0 * (0.414 * f64::from(n)).fract() - 0.8,
                ];
                let Distance { gap, normal } = shape.distance(&x);
                assert!((dot(&normal, &normal) - 1.0).abs() < 1e-14);
                for axis in 0..2 {
                    let moved = |s: f64| {
                        let mut y = x;
                        y[axis] += s;
                        shape.distance(&y).gap
                    };
                    let slope = (moved(step) - moved(-step)) / (2.0 * step);
                    assert!((slope - normal[axis]).abs() < 1e-4, "{shape:?} {x:?}");
                }
                let foot = [x[0] - gap * normal[0], x[1] - gap * normal[1]];
                assert!(shape.distance(&foot).gap.abs() < 1e-13, "{shape:?} {x:?}");
            }
        }
    }

    #[test]
    fn the_centre_has_a_normal_too() {
        let Distance { gap, normal } = PIPE.distance(&[0.5, 1.0]);
        assert_eq!((gap, normal), (-0.4, [0.0, 1.0]));
        let sharp = Shape::Rectangle {
            centre: [0.0; 2],
            half: [1.0, 1.0],
            corner_radius: 0.0,
        };
        let corner = sharp.distance(&[1.0, 1.0]);
        assert_eq!(corner.gap, 0.0);
        assert!(corner.normal.iter().all(|n| n.is_finite()));
    }

    #[test]
    fn sizes_out_of_range_are_named() {
        for shape in [PIPE, MAT, BASE] {
            assert_eq!(shape.check(), Ok(()));
        }
        let circle = |radius| Shape::Circle {
            centre: [0.0; 2],
            radius,
        };
        let plate = |half, corner_radius| Shape::Rectangle {
            centre: [0.0; 2],
            half,
            corner_radius,
        };
        let tilted = Shape::HalfPlane {
            place: [0.0; 2],
            normal: [1.0, 1.0],
        };
        for (shape, wanted) in [
            (circle(0.0), "body.radius_m"),
            (circle(f64::NAN), "body.radius_m"),
            (plate([1.0, -1.0], 0.0), "body.half_m"),
            (plate([1.0, 0.5], 0.6), "body.corner_radius_m"),
            (tilted, "body.normal"),
        ] {
            match shape.check() {
                Err(SolverError::Setup { field, .. }) => assert_eq!(field, wanted),
                other => panic!("{shape:?}: {other:?}"),
            }
        }
    }
}
