//! What must hold between the fields of a scene. Complaints are collected, so that all come at once.

use crate::draft::Origins;
use crate::error::{Complaint, Origin};
use crate::spec::{BoundarySpec, PointsSpec, ReceiverSpec, TimeSpec};
use anechoic_solver::boundary::{SideMethod, Value};
use anechoic_solver::problem::{Aabb, MassKind, PointMode, Scheme, Transfer};
use anechoic_solver::wavelet::{Pulse, Wavelet};

/// Steps that a pulse takes at least: fewer can fall on its zeros, and nothing would move.
const LEAST_STEPS: f64 = 4.0;

/// Collects what is wrong.
#[derive(Debug)]
pub struct Checks<'a> {
    origins: &'a Origins,
    complaints: Vec<Complaint>,
}

impl<'a> Checks<'a> {
    /// Checks of values that come from `origins`.
    pub fn new(origins: &'a Origins) -> Self {
        Checks {
            origins,
            complaints: Vec::new(),
        }
    }

    /// What was found.
    pub fn into_complaints(self) -> Vec<Complaint> {
        self.complaints
    }

    /// Complains about `field` unless `holds`.
    pub fn require(&mut self, holds: bool, field: &str, message: impl FnOnce() -> String) {
        if !holds {
            self.complaints.push(Complaint {
                origin: self.origins.of(field),
                field: field.to_owned(),
                message: message(),
            });
        }
    }

    /// Did a file or the command line give the field?
    fn by_user(&self, field: &str) -> bool {
        matches!(self.origins.of(field), Origin::Set(_) | Origin::File { .. })
    }

    /// Points in a cell and how they exchange motion with the nodes.
    pub fn points(&mut self, points: &PointsSpec) {
        let n = points.per_cell;
        self.require(n.isqrt().pow(2) == n, "points.per_cell", || {
            format!("{n} is not a square; allowed: 1, 4, 9, 16, ...")
        });
        self.transfer(points);
    }

    /// The same in three dimensions.
    pub fn points_in_space(&mut self, points: &PointsSpec) {
        let n = points.per_cell;
        let along = (n as f64).cbrt().round() as usize;
        self.require(along.pow(3) == n, "points.per_cell", || {
            format!("{n} is not a cube; allowed: 1, 8, 27, 64")
        });
        self.transfer(points);
    }

    fn transfer(&mut self, points: &PointsSpec) {
        let keeps = points.transfer == Transfer::Keep && points.mode == PointMode::Moving;
        // Blame what the user wrote, not what stood there before.
        let other = self.origins.of("points.transfer");
        let (field, message) = if self.by_user("points.mode") && !self.by_user("points.transfer") {
            (
                "points.mode",
                format!(
                    "\"moving\" does not go with points.transfer = \"keep\" ({other}), which needs frozen points; set points.transfer as well, allowed: \"affine\", \"flip\", \"pic\""
                ),
            )
        } else {
            ("points.transfer", "\"keep\" needs frozen points; with points.mode = \"moving\" allowed: \"affine\", \"flip\", \"pic\"".into())
        };
        self.require(!keeps, field, || message);
    }

    /// Receivers with names of their own, inside the body.
    pub fn receivers<const D: usize>(&mut self, receivers: &[ReceiverSpec], body: &Aabb<D>) {
        self.require(!receivers.is_empty(), "receivers", || {
            "the list is empty; a scene needs a receiver at least".into()
        });
        for (index, receiver) in receivers.iter().enumerate() {
            let what = format!("receiver {}", receiver.name);
            let place = [
                ("x_m", receiver.x_m),
                ("y_m", receiver.y_m),
                ("z_m", receiver.z_m),
            ];
            for (axis, (key, at)) in place.into_iter().enumerate() {
                let field = format!("receivers[{index}].{key}");
                if axis < D {
                    self.inside(&field, &what, at, body, axis);
                } else {
                    self.require(at == 0.0, &field, || {
                        "the scene is plane; a receiver has name, x_m, y_m".into()
                    });
                }
            }
            let before = receivers[..index].iter().any(|r| r.name == receiver.name);
            self.require(!before, &format!("receivers[{index}].name"), || {
                format!("a second receiver is called {}", receiver.name)
            });
        }
    }

    /// A coordinate (m) that must lie within the body along an axis.
    pub fn inside<const D: usize>(
        &mut self,
        field: &str,
        what: &str,
        at: f64,
        body: &Aabb<D>,
        axis: usize,
    ) {
        let (lower, upper) = (body.lower[axis], body.upper[axis]);
        self.require((lower..=upper).contains(&at), field, || {
            format!("{what} at {at} m lies outside the mesh; allowed: {lower} <= value <= {upper}")
        });
    }

    /// A pulse that must be over, or have risen if it stays on, before the run is over, and that steps
    /// of `dt` (s) must see.
    pub fn pulse(&mut self, pulse: &Pulse, dt: f64, end_s: f64) {
        let lasting = match pulse.wavelet {
            Wavelet::Ricker => "source.t0_s",
            _ => "source.frequency_Hz",
        };
        let end = pulse.settled();
        // Blame what the user wrote, not what stood there before.
        let short = self.by_user("time.end_s") && !self.by_user(lasting);
        let field = if short { "time.end_s" } else { lasting };
        self.require(end <= end_s, field, || match short {
            true => format!(
                "{end_s} s is shorter than the pulse, which lasts {end} s ({lasting}); allowed: value >= {end}"
            ),
            false => format!(
                "the pulse lasts {end} s, longer than the run (time.end_s = {end_s} s)"
            ),
        });
        let longest = end.min(1.0 / pulse.frequency) / LEAST_STEPS;
        // where the step follows from the cells, these may be what was written
        let fields = ["time.dt_s", "source.frequency_Hz", "grid.h_m"];
        let field = fields.into_iter().find(|field| self.by_user(field));
        let field = field.unwrap_or("time.dt_s");
        self.require(dt <= longest, field, || {
            format!(
                "steps of {dt} s do not see a pulse of {} Hz; allowed: time.dt_s <= {longest}",
                pulse.frequency
            )
        });
    }

    /// Cells (m) that must fit into the body, whose size is given (m).
    pub fn cells(&mut self, h_m: f64, size: [f64; 2]) {
        let least = size[0].min(size[1]);
        self.require(h_m <= least, "grid.h_m", || {
            format!("a cell of {h_m} m is larger than the body's {least} m")
        });
    }

    /// A step that must fit into the run.
    pub fn step(&mut self, dt_s: f64, end_s: f64) {
        self.require(dt_s <= end_s, "time.dt_s", || {
            format!("{dt_s} s is longer than the run (time.end_s = {end_s} s)")
        });
    }

    /// A scheme with inertia, and masses that it can take.
    pub fn inertia(&mut self, time: &TimeSpec) {
        self.require(time.scheme != Scheme::QuasiStatic, "time.scheme", || {
            "a pulse is lost without inertia; allowed: \"newmark\", \"explicit\"".into()
        });
        let divided = time.scheme != Scheme::Explicit || time.mass == MassKind::Lumped;
        self.require(divided, "time.mass", || {
            "explicit steps divide by the masses of nodes; allowed: \"lumped\"".into()
        });
    }

    /// Layers that leave something of the body, whose size is given (m).
    pub fn layers<const D: usize>(&mut self, boundary: &BoundarySpec, size: [f64; D]) {
        for (index, (side, method)) in boundary.named().into_iter().enumerate() {
            let axis = index / 2;
            let field = format!("boundary.{side}.thickness_m");
            let opposite = boundary.named()[index ^ 1].1;
            let (inner, other) = (inner_thickness(method), inner_thickness(opposite));
            self.require(inner == 0.0 || inner + other < size[axis], &field, || {
                format!(
                    "an inner layer of {inner} m{} leaves nothing of the body ({} m)",
                    if other > 0.0 {
                        " with the opposite one"
                    } else {
                        ""
                    },
                    size[axis]
                )
            });
        }
    }
}

/// The number that a side gives for a parameter.
pub fn number(method: &SideMethod, key: &str) -> Option<f64> {
    match method.params.get(key) {
        Some(Value::Number(x)) => Some(*x),
        _ => None,
    }
}

/// Thickness of a layer inside the body (m); zero when there is none.
pub fn inner_thickness(method: &SideMethod) -> f64 {
    match method.params.get("placement") {
        Some(Value::Text(word)) if word == "inside" => number(method, "thickness_m").unwrap_or(0.0),
        _ => 0.0,
    }
}
