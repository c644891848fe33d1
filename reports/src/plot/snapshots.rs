//! Fields on a lattice: columns are methods, rows are times, one scale for all.

use super::axis::{Axis, Panel};
use super::drawing::{Drawing, Mark, Stroke};
use super::heat::{Colours, Raster, colour_bar};
use super::{PlotError, check, empty, palette};
use anechoic_solver::record::Snapshot;

const PICTURE: &str = "snapshots";
pub(super) const WIDTH: f64 = 900.0;
const LEFT: f64 = 98.0;
pub(super) const BAR: f64 = 92.0;
const GAP: f64 = 24.0;
const TOP: f64 = 26.0;
pub(super) const FOOT: f64 = 40.0;

/// Magnitude of a vector field on a lattice of the x-y plane.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Coordinates of the columns (m), increasing.
    pub x: Vec<f64>,
    /// Coordinates of the rows (m), increasing.
    pub y: Vec<f64>,
    /// Values, x fastest.
    pub values: Vec<f64>,
}

/// Share of all values, over all rows, within the scale.
const WITHIN: f64 = 0.99;

/// The scale ends above this share of the largest value.
const LEAST: f64 = 1e-3;

impl Field {
    /// Magnitude over the columns `names` (for example `ux`, `uy`) of a snapshot's first layer.
    pub fn magnitude(snapshot: &Snapshot, names: &[&str]) -> Result<Field, PlotError> {
        let [nx, ny, _] = snapshot.counts;
        let mut squares = vec![0.0; nx * ny];
        for name in names {
            let column = snapshot.columns.iter().find(|c| c.name == *name);
            let values = &column
                .ok_or_else(|| empty(PICTURE, &format!("the snapshot has no column {name}")))?
                .values;
            let samples = snapshot.counts.iter().product();
            check(PICTURE, &format!("column {name}"), values, samples)?;
            for (sum, v) in squares.iter_mut().zip(values) {
                *sum += v * v;
            }
        }
        let coordinates = |axis: usize| {
            (0..snapshot.counts[axis])
                .map(|i| snapshot.origin[axis] + i as f64 * snapshot.spacing[axis])
                .collect()
        };
        Ok(Field {
            x: coordinates(0),
            y: coordinates(1),
            values: squares.into_iter().map(f64::sqrt).collect(),
        })
    }
}

impl Field {
    /// Gives the field as a raster.
    pub(super) fn raster_with<T>(&self, use_it: impl FnOnce(&Raster<'_>) -> T) -> T {
        use_it(&Raster {
            x: &self.x,
            y: &self.y,
            value: &|ix, iy| self.values[iy * self.x.len() + ix],
        })
    }
}

/// Small multiples of fields.
#[derive(Clone, Debug, PartialEq)]
pub struct SnapshotPlot {
    /// What is drawn, for example `displacement |u|`.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// Methods, from left to right.
    pub methods: Vec<String>,
    /// Times (s) from top to bottom, each with one field a method.
    pub rows: Vec<(f64, Vec<Field>)>,
    /// All material of each method (m): what lies around its fields is drawn as ground.
    pub meshes: Vec<Corners>,
    /// What the panels show (m).
    pub extent: Corners,
}

/// Lower left and upper right corner (m).
pub type Corners = [[f64; 2]; 2];

impl SnapshotPlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        self.check()?;
        let (_, height) = self.panel_size();
        let total = TOP + self.rows.len() as f64 * (height + GAP) + FOOT;
        let mut drawing = Drawing::new(WIDTH as u32, total as u32);
        let colours = Colours::sequential(self.scale());
        for (row, (time, fields)) in self.rows.iter().enumerate() {
            for (column, field) in fields.iter().enumerate() {
                let panel = self.panel(column, TOP + row as f64 * (height + GAP));
                draw_ground(&mut drawing, &panel, &self.meshes[column]);
                draw_field(&mut drawing, &panel, field, &colours);
                let ends = (row == 0, row + 1 == self.rows.len());
                self.label(&mut drawing, &panel, column, ends);
                if column == 0 {
                    let text = format!("t = {} s", crate::format::short(*time));
                    panel.y_title(&mut drawing, &text, 84.0);
                }
            }
        }
        let bar = (total - TOP - FOOT - GAP).min(260.0);
        let name = (self.quantity.as_str(), self.unit.as_str());
        colour_bar(&mut drawing, (WIDTH - BAR, TOP), bar, &colours, name);
        Ok(drawing)
    }

    /// Width and height of a panel (logical pixels).
    pub(super) fn panel_size(&self) -> (f64, f64) {
        let across = self.methods.len() as f64;
        let width = (WIDTH - LEFT - BAR - 14.0 - GAP * (across - 1.0)) / across;
        let [lower, upper] = self.extent;
        let aspect = (upper[1] - lower[1]) / (upper[0] - lower[0]);
        (width, (width * aspect).clamp(40.0, 420.0))
    }

    /// The panel of a method.
    pub(super) fn panel(&self, column: usize, top: f64) -> Panel {
        let (width, height) = self.panel_size();
        let [lower, upper] = self.extent;
        Panel {
            left: LEFT + column as f64 * (width + GAP),
            top,
            width,
            height,
            x: Axis::linear(lower[0], upper[0], (width / 60.0) as usize),
            y: Axis::linear(lower[1], upper[1], (height / 30.0) as usize),
        }
    }

    pub(super) fn check(&self) -> Result<(), PlotError> {
        if self.methods.is_empty() || self.rows.is_empty() {
            return Err(empty(PICTURE, "no method or no time"));
        }
        if self.meshes.len() != self.methods.len() {
            return Err(PlotError::Shape {
                picture: PICTURE,
                what: "the meshes".to_owned(),
                expected: self.methods.len(),
                found: self.meshes.len(),
            });
        }
        for (time, fields) in &self.rows {
            if fields.len() != self.methods.len() {
                return Err(PlotError::Shape {
                    picture: PICTURE,
                    what: format!("the row of {time} s"),
                    expected: self.methods.len(),
                    found: fields.len(),
                });
            }
            for (field, method) in fields.iter().zip(&self.methods) {
                if field.x.len() < 2 || field.y.len() < 2 {
                    return Err(empty(PICTURE, &format!("the lattice of {method}")));
                }
                let expected = field.x.len() * field.y.len();
                check(
                    PICTURE,
                    &format!("the field of {method}"),
                    &field.values,
                    expected,
                )?;
            }
        }
        Ok(())
    }

    /// End of the scale: a hundredth of all values is beyond it and has its last colour, else the surroundings of a
    /// source or a splash would leave nothing to see of the waves. The largest value where hardly more than that
    /// hundredth moves; 1 where nothing does.
    pub(super) fn scale(&self) -> f64 {
        let fields = self.rows.iter().flat_map(|(_, fields)| fields);
        let mut values: Vec<f64> = fields.flat_map(|field| &field.values).copied().collect();
        let largest = values.iter().copied().fold(0.0, f64::max);
        let at = (WITHIN * values.len() as f64) as usize;
        let (_, end, _) = values.select_nth_unstable_by(at, f64::total_cmp);
        match (*end > LEAST * largest, largest > 0.0) {
            (true, _) => *end,
            (false, true) => largest,
            (false, false) => 1.0,
        }
    }

    /// Frame and axes of a method's panel; headlines stand on the first row, the names of the axis
    /// below the last.
    pub(super) fn label(
        &self,
        drawing: &mut Drawing,
        panel: &Panel,
        column: usize,
        (first, last): (bool, bool),
    ) {
        panel.frame(drawing, last, column == 0);
        if first {
            panel.headline(drawing, &self.methods[column]);
        }
        if last {
            panel.x_title(drawing, "x (m)");
        }
        if column == 0 {
            panel.y_title(drawing, "y (m)", 56.0);
        }
    }
}

/// The panel's pixels of a rectangle, cut at the panel's edges.
fn inside(panel: &Panel, [lower, upper]: &Corners) -> ((f64, f64), (f64, f64)) {
    let (a, b) = (panel.at(lower[0], upper[1]), panel.at(upper[0], lower[1]));
    (a, b)
}

/// Material around the field, with its outer edge.
pub(super) fn draw_ground(drawing: &mut Drawing, panel: &Panel, mesh: &Corners) {
    let (a, b) = inside(panel, mesh);
    drawing.add(Mark::Fill(a, b, palette::GRID));
    let outline = vec![a, (a.0, b.1), b, (b.0, a.1)];
    drawing.add(Mark::Path(outline, Stroke::solid(palette::SOFT, 1.0)));
}

/// The field in its own part of the panel, outlined.
fn draw_field(drawing: &mut Drawing, panel: &Panel, field: &Field, colours: &Colours) {
    let part = field_part(panel, field);
    field.raster_with(|raster| raster.draw(drawing, &part, colours));
    outline(drawing, &part);
}

/// The part of a panel that a field takes.
pub(super) fn field_part(panel: &Panel, field: &Field) -> Panel {
    let ends = |values: &[f64]| (values[0], values[values.len() - 1]);
    let ((x0, x1), (y0, y1)) = (ends(&field.x), ends(&field.y));
    let (a, b) = inside(panel, &[[x0, y0], [x1, y1]]);
    Panel {
        left: a.0,
        top: a.1,
        width: b.0 - a.0,
        height: b.1 - a.1,
        x: Axis::linear(x0, x1, 1),
        y: Axis::linear(y0, y1, 1),
    }
}

/// The edge between the target and what lies around it.
pub(super) fn outline(drawing: &mut Drawing, part: &Panel) {
    let (a, b) = ((part.left, part.top), (part.right(), part.bottom()));
    let corners = vec![a, (a.0, b.1), b, (b.0, a.1)];
    drawing.add(Mark::Path(corners, Stroke::solid(palette::INK, 1.0)));
}
