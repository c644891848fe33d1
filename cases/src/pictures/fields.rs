//! Pictures of fields: over place and time, and at some times.

use super::{NO_ECHO, Picture, PictureError, receivers};
use crate::checks::inner_thickness;
use crate::judge::references::References;
use crate::posed::{Posed, either};
use crate::runner::Run;
use anechoic_reports::plot::{Corners, Field, Guide, PlotError, SnapshotPlot, SpaceTimePlot};
use anechoic_reports::ranking::Ranking;
use anechoic_solver::material_box;
use anechoic_solver::record::Snapshot;

/// The method whose fields are shown between standard and reference, where it was run; else the best.
pub(super) const SHOWN: &str = "pml";

/// Ground shown around the method's mesh, over its width.
pub(super) const AROUND: f64 = 0.04;

/// Velocity over place and time, methods side by side.
pub(super) fn space_time(runs: &[&Run]) -> Result<Option<Picture>, PictureError> {
    let fields: Vec<_> = runs
        .iter()
        .filter_map(|run| {
            let field = run.record.lines.first()?.clone();
            Some((run.manifest.method.clone(), field))
        })
        .collect();
    let Some((_, field)) = fields.first() else {
        return Ok(None);
    };
    let quantity = format!("velocity {}", field.name.trim_start_matches('v'));
    let mut guides: Vec<Guide> = receivers(runs[0])
        .into_iter()
        .map(|(label, place)| Guide {
            position: place[1],
            label,
            method: None,
        })
        .collect();
    // The edge of a layer that damps part of the body itself.
    guides.extend(runs.iter().filter_map(|run| {
        let thickness = inner_thickness(&run.prepared.scene.boundary().bottom);
        (thickness > 0.0).then(|| Guide {
            position: either!(run.prepared.scene.posed(), problem => problem.target.lower[1])
                + thickness,
            label: "layer".into(),
            method: Some(run.manifest.method.clone()),
        })
    }));
    let drawing = SpaceTimePlot {
        quantity,
        fields,
        guides,
        limit: None,
    }
    .draw()?;
    Ok(Some(Picture {
        name: "space-time".into(),
        title: "Waves in space and time".into(),
        caption: "Waves are slanted bands; a band that turns round at the base is echo. Dashed: receivers, and the upper edge of a layer inside the body. All methods share one scale.".into(),
        drawing,
        raster: true,
    }))
}

/// Displacement at the snapshots' times: standard, a method, the reference without echo.
pub(super) fn snapshots(
    runs: &[&Run],
    ranking: &Ranking,
    references: &References,
) -> Result<Option<Picture>, PictureError> {
    if let Some(picture) = flowing(runs, &VELOCITY)? {
        return Ok(Some(picture));
    }
    let named = |name: &str| {
        let mut runs = runs.iter().filter(|run| !run.record.snapshots.is_empty());
        runs.find(|run| run.manifest.method == name)
    };
    let standard = runs
        .first()
        .and_then(|run| named(run.prepared.info.standard));
    let best = ranking.methods.iter().find_map(|m| named(&m.method));
    let (Some(standard), Some(method)) = (standard, named(SHOWN).or(best)) else {
        return Ok(None);
    };
    let mut columns = vec![
        (standard.manifest.method.clone(), &standard.record.snapshots),
        (method.manifest.method.clone(), &method.record.snapshots),
    ];
    let mut meshes = vec![mesh(standard), mesh(method)];
    if let Some(certified) = references.certified(method)
        && !certified.snapshots.is_empty()
    {
        columns.push((NO_ECHO.to_owned(), &certified.snapshots));
        // It goes on far beyond the picture.
        meshes.push(around(mesh(standard), 1.0));
    }
    let rows = method.record.snapshots.iter().filter_map(|snapshot| {
        let fields: Option<Vec<_>> = columns
            .iter()
            .map(|(_, snapshots)| at(snapshots, snapshot.time).map(magnitude))
            .collect();
        Some(
            fields?
                .into_iter()
                .collect::<Result<_, _>>()
                .map(|f| (snapshot.time, f)),
        )
    });
    let drawing = SnapshotPlot {
        quantity: "|u|".into(),
        unit: "m".into(),
        methods: columns.iter().map(|(name, _)| name.clone()).collect(),
        rows: rows.collect::<Result<_, PlotError>>()?,
        extent: around(mesh(method), AROUND),
        meshes,
    }
    .draw()?;
    Ok(Some(Picture {
        name: "snapshots".into(),
        title: "Displacement in the target".into(),
        caption: format!(
            "Grey: material around the target, in the middle the method's layer with its outer edge. One scale for all but the largest hundredth.{}",
            match method.prepared.scene.posed() {
                Posed::Plane(_) => "",
                Posed::Space(_) =>
                    " Of the body in space its back side is shown, a plane of symmetry.",
            }
        ),
        drawing,
        raster: true,
    }))
}

/// Methods beside which the standard run's velocities are shown, those that there are.
const BESIDE: [&str; 3] = ["dashpot", "pml", "hybrid"];

/// A field of flowing material and how it is shown.
struct Shown {
    /// Columns of a snapshot.
    columns: &'static [&'static str],
    /// Is it one of cells?
    cells: bool,
    quantity: &'static str,
    unit: &'static str,
    name: &'static str,
    title: &'static str,
    caption: &'static str,
}

const VELOCITY: Shown = Shown {
    columns: &["vx", "vy"],
    cells: false,
    quantity: "|v|",
    unit: "m/s",
    name: "snapshots",
    title: "Velocity of the soil",
    caption: "One scale for all but the largest hundredth; where nothing moves or there is no soil the field is dark.",
};

const PRESSURE: Shown = Shown {
    columns: &["p"],
    cells: true,
    quantity: "|p|",
    unit: "Pa",
    name: "pressures",
    title: "Pressure in the soil",
    caption: "Means over cells, in the plane. One scale for all but the largest hundredth. Cells that are darker and lighter in turn are not physics: soil that hardly changes its volume has more constraints than nodes to meet them.",
};

/// Pressures of flowing material; `None` where nothing flows.
pub(super) fn pressures(runs: &[&Run]) -> Result<Option<Picture>, PictureError> {
    flowing(runs, &PRESSURE)
}

/// A field of flowing material at the snapshots' times: standard run and others; `None` where nothing flows.
fn flowing(runs: &[&Run], field: &Shown) -> Result<Option<Picture>, PictureError> {
    let flows = |run: &&&Run| run.record.snapshots.iter().any(flows);
    let Some(first) = runs.iter().find(flows) else {
        return Ok(None);
    };
    let shown = |run: &&&Run| {
        let name = run.manifest.method.as_str();
        name == run.prepared.info.standard || BESIDE.contains(&name)
    };
    let mut columns: Vec<&&Run> = runs.iter().filter(flows).filter(shown).collect();
    if columns.is_empty() {
        columns.push(first);
    }
    columns.truncate(3);
    let size = |snapshot: &Snapshot| {
        let size = Field::magnitude(snapshot, field.columns)?;
        Ok(if field.cells { of_cells(size) } else { size })
    };
    let rows = first.record.snapshots.iter().filter_map(|snapshot| {
        let fields: Option<Vec<_>> = columns
            .iter()
            .map(|run| at(&run.record.snapshots, snapshot.time).map(size))
            .collect();
        let fields: Result<Vec<Field>, PlotError> = fields?.into_iter().collect();
        Some(fields.map(|f| (snapshot.time, f)))
    });
    let rows: Vec<(f64, Vec<Field>)> = rows.collect::<Result<_, _>>()?;
    let Some((meshes, extent)) = windows(&rows) else {
        return Ok(None);
    };
    let drawing = SnapshotPlot {
        quantity: field.quantity.into(),
        unit: field.unit.into(),
        methods: columns.iter().map(|r| r.manifest.method.clone()).collect(),
        rows,
        extent,
        meshes,
    }
    .draw()?;
    Ok(Some(Picture {
        name: field.name.into(),
        title: field.title.into(),
        caption: field.caption.into(),
        drawing,
        raster: true,
    }))
}

/// Values of the cells that go up from nodes, of which the last nodes have none, at the cells' centres.
fn of_cells(mut field: Field) -> Field {
    let across = field.x.len();
    for axis in [&mut field.x, &mut field.y] {
        let half = axis
            .windows(2)
            .next()
            .map_or(0.0, |two| 0.5 * (two[1] - two[0]));
        axis.iter_mut().for_each(|x| *x += half);
    }
    field.x.pop();
    field.y.pop();
    let rows = field.values.chunks_exact(across).take(field.y.len());
    field.values = rows
        .flat_map(|row| &row[..field.x.len()])
        .copied()
        .collect();
    field
}

/// The box of each column of fields, whatever the row, and the box around all.
pub(super) fn windows(rows: &[(f64, Vec<Field>)]) -> Option<(Vec<Corners>, Corners)> {
    let corners = |field: &Field| -> Option<Corners> {
        let (x, y) = (&field.x, &field.y);
        Some([[*x.first()?, *y.first()?], [*x.last()?, *y.last()?]])
    };
    let around = |[low, high]: Corners, [lower, upper]: &Corners| {
        let pick =
            |of: fn(f64, f64) -> f64, a: [f64; 2], b: &[f64; 2]| [0, 1].map(|i| of(a[i], b[i]));
        [pick(f64::min, low, lower), pick(f64::max, high, upper)]
    };
    let of_row = |(_, fields): &(f64, Vec<Field>)| fields.iter().map(corners).collect();
    let mut all_rows = rows.iter().map(of_row);
    let first: Option<Vec<Corners>> = all_rows.next()?;
    let join = |mut boxes: Vec<Corners>, row: Option<Vec<Corners>>| {
        for (own, other) in boxes.iter_mut().zip(row?) {
            *own = around(*own, &other);
        }
        Some(boxes)
    };
    let boxes = all_rows.try_fold(first?, join)?;
    let all = boxes.iter().fold(*boxes.first()?, around);
    Some((boxes, all))
}

/// The snapshot of a time.
pub(super) fn at(snapshots: &[Snapshot], time: f64) -> Option<&Snapshot> {
    snapshots.iter().find(|s| (s.time - time).abs() < 1e-6)
}

/// Does a snapshot show material that flows?
pub(super) fn flows(snapshot: &Snapshot) -> bool {
    let mut columns = snapshot.columns.iter();
    columns.any(|column| column.name == "vx")
}

/// What a snapshot's vector is, and its unit: of material that flows the velocity.
pub(super) fn quantity(snapshot: &Snapshot) -> [&'static str; 2] {
    match flows(snapshot) {
        true => [VELOCITY.quantity, VELOCITY.unit],
        false => ["|u|", "m"],
    }
}

/// The size of the displacement, or of the velocity of material that flows; of a body in space it is shown on
/// the back side, a plane of symmetry, which nothing crosses.
pub(super) fn magnitude(snapshot: &Snapshot) -> Result<Field, PlotError> {
    let columns: &[&str] = match flows(snapshot) {
        true => VELOCITY.columns,
        false => &["ux", "uy"],
    };
    Field::magnitude(snapshot, columns)
}

/// All material of a run (m), across and up.
pub(super) fn mesh(run: &Run) -> Corners {
    // What was run was set up before.
    either!(run.prepared.scene.posed(), problem => {
        let all = material_box(&problem).unwrap_or(problem.target);
        [all.lower, all.upper].map(|corner| [corner[0], corner[1]])
    })
}

/// A box grown by a share of its width, but not beyond its top, where nothing is.
pub(super) fn around([lower, upper]: Corners, share: f64) -> Corners {
    let margin = share * (upper[0] - lower[0]);
    [
        [lower[0] - margin, lower[1] - margin],
        [upper[0] + margin, upper[1]],
    ]
}
