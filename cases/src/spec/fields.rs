//! The fields of those parts, in the order in which they are shown.

use crate::field::{Field, Kind, Range};

const BASIS: Field = Field::new(
    "basis",
    Kind::Word(&["linear", "gimp", "bspline"]),
    "shape functions on the grid",
);

const CELL: Field = Field::new(
    "grid.h_m",
    Kind::Number(Range::POSITIVE),
    "largest edge of a cell (m); cells are fitted to the body",
);

/// Fields of discretisation of scenes whose points move in explicit steps and in no others.
pub const FLOW_NUMERICS: &[Field] = &[
    BASIS,
    CELL,
    Field::new("time.scheme", Kind::Word(&["explicit"]), "time integration"),
    Field::new(
        "time.courant",
        Kind::Number(Range::within(1e-3, 2.0)),
        "time step over the time that the fastest wave takes through a cell",
    ),
    Field::new(
        "points.mode",
        Kind::Word(&["moving"]),
        "do material points move?",
    ),
    Field::new(
        "points.transfer",
        Kind::Word(&["affine", "flip", "pic"]),
        "between points and nodes",
    ),
    Field::new(
        "points.per_cell",
        Kind::Whole(1, 100),
        "points in a cell, all directions together: a square",
    ),
];

/// Fields of explicit steps of moving points.
pub const FLOW: &[Field] = &[
    Field::new(
        "flow.update",
        Kind::Word(&["usl", "musl"]),
        "when the stress moves on: last, or last by velocities sent to the nodes once more",
    ),
    Field::new(
        "flow.pic_share",
        Kind::Number(Range::within(0.0, 1.0)),
        "share of the nodes' velocity that points take over in a step (flip, affine)",
    ),
    Field::new(
        "flow.volume",
        Kind::Word(&["cell", "point"]),
        "whose change of volume the stress follows: the cell's (F-bar), or each point's, which locks",
    ),
];

/// Fields of discretisation and solver.
pub const NUMERICS: &[Field] = &[
    BASIS,
    CELL,
    Field::new(
        "grid.aspect",
        Kind::OptionalNumber(ASPECT, "left out: 1, square cells"),
        "edge of a cell along x over that along y; the longer is grid.h_m",
    ),
    Field::new(
        "time.scheme",
        Kind::Word(&["newmark", "explicit", "quasi-static"]),
        "time integration",
    ),
    Field::new(
        "time.mass",
        Kind::Word(&["lumped", "consistent"]),
        "how the inertia of points reaches the nodes",
    ),
    Field::new(
        "time.dt_s",
        Kind::OptionalNumber(Range::POSITIVE, "left out: follows the cell size"),
        "time step (s)",
    ),
    Field::new(
        "time.end_s",
        Kind::Number(Range::POSITIVE),
        "end of the run (s)",
    ),
    Field::new(
        "points.mode",
        Kind::Word(&["moving", "frozen"]),
        "do material points move?",
    ),
    Field::new(
        "points.transfer",
        Kind::Word(&["keep", "affine", "flip", "pic"]),
        "between points and nodes; keep needs frozen points",
    ),
    Field::new(
        "points.per_cell",
        Kind::Whole(1, 100),
        "points in a cell, all directions together: a square, or a cube in three dimensions",
    ),
    Field::new(
        "points.face_gap",
        Kind::OptionalNumber(
            Range::inside(0.0, 0.5),
            "left out: points at the centres of equal parts",
        ),
        "distance of a cell's outermost points from its faces over its edges",
    ),
    Field::new(
        "solver.rel_tol",
        Kind::Number(TOLERANCE),
        "relative tolerance of the linear solver",
    ),
    Field::new(
        "solver.kind",
        Kind::Word(&["auto", "cg", "direct"]),
        "linear solver",
    ),
];

/// Cells thinner than this are no mesh for waves.
const ASPECT: Range = Range::within(0.01, 100.0);

/// Above a thousandth the solver's error is as large as the echoes that are looked for.
const TOLERANCE: Range = Range {
    max: 1e-3,
    max_open: false,
    ..Range::POSITIVE
};

/// Fields of a rectangular body.
pub const BODY: &[Field] = &[
    Field::new("body.width_m", Kind::Number(Range::POSITIVE), "width (m)"),
    Field::new("body.height_m", Kind::Number(Range::POSITIVE), "height (m)"),
];

/// Fields of a linear elastic material.
pub const ELASTIC: &[Field] = &[
    Field::new(
        "material.E_Pa",
        Kind::Number(Range::POSITIVE),
        "Young's modulus (Pa)",
    ),
    Field::new(
        "material.nu",
        Kind::Number(Range::inside(-1.0, 0.5)),
        "Poisson's ratio",
    ),
    Field::new(
        "material.rho_kg_m3",
        Kind::Number(Range::POSITIVE),
        "density (kg/m3)",
    ),
];

/// Field of a body of two stiffnesses.
pub const INCLUSION: &[Field] = &[Field::new(
    "material.inclusion",
    Kind::OptionalNumber(Range::POSITIVE, "left out: one stiffness"),
    "Young's modulus of the middle third of the body along each axis over that of all else",
)];

/// Receivers and sides of a 2D scene.
pub const PROBES_AND_SIDES: &[Field] = &[
    Field::new(
        "receivers",
        Kind::Receivers,
        "tracers whose motion is recorded",
    ),
    Field::new("boundary.left", Kind::Side, "x smallest"),
    Field::new("boundary.right", Kind::Side, "x largest"),
    Field::new("boundary.bottom", Kind::Side, "y smallest"),
    Field::new("boundary.top", Kind::Side, "y largest"),
];

/// Sides of a scene in three dimensions beside those.
pub const SIDES_IN_SPACE: &[Field] = &[
    Field::new("boundary.back", Kind::Side, "z smallest"),
    Field::new("boundary.front", Kind::Side, "z largest"),
];
