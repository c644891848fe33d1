//! Fields on a lattice: columns are methods, rows are times, one scale for all.

use super::axis::{Axis, Panel};
use super::drawing::{Drawing, Mark, Stroke};
use super::heat::{Colours, Raster, colour_bar};
use super::{PlotError, check, empty, palette};
use anechoic_solver::record::Snapshot;

const PICTURE: &str = "snapshots";
const WIDTH: f64 = 900.0;
const LEFT: f64 = 98.0;
const BAR: f64 = 92.0;
const GAP: f64 = 24.0;
const TOP: f64 = 26.0;
const FOOT: f64 = 40.0;

/// Smallest and largest value.
type Range = (f64, f64);

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
    /// Outlines (m): lower left and upper right corner of the target or of layers.
    pub outlines: Vec<[[f64; 2]; 2]>,
}

impl SnapshotPlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        self.check()?;
        let across = self.methods.len() as f64;
        let width = (WIDTH - LEFT - BAR - 14.0 - GAP * (across - 1.0)) / across;
        let (x_range, y_range) = self.extent();
        let aspect = (y_range.1 - y_range.0) / (x_range.1 - x_range.0);
        let height = (width * aspect).clamp(40.0, 420.0);
        let total = TOP + self.rows.len() as f64 * (height + GAP) + FOOT;
        let mut drawing = Drawing::new(WIDTH as u32, total as u32);
        let colours = Colours::sequential(self.limit());
        for (row, (time, fields)) in self.rows.iter().enumerate() {
            for (column, field) in fields.iter().enumerate() {
                let panel = Panel {
                    left: LEFT + column as f64 * (width + GAP),
                    top: TOP + row as f64 * (height + GAP),
                    width,
                    height,
                    x: Axis::linear(x_range.0, x_range.1, (width / 60.0) as usize),
                    y: Axis::linear(y_range.0, y_range.1, (height / 30.0) as usize),
                };
                let raster = Raster {
                    x: &field.x,
                    y: &field.y,
                    value: &|ix, iy| field.values[iy * field.x.len() + ix],
                };
                raster.draw(&mut drawing, &panel, &colours);
                self.draw_outlines(&mut drawing, &panel);
                self.label(&mut drawing, &panel, (row, column), *time);
            }
        }
        let bar = (total - TOP - FOOT - GAP).min(260.0);
        let name = (self.quantity.as_str(), self.unit.as_str());
        colour_bar(&mut drawing, (WIDTH - BAR, TOP), bar, &colours, name);
        Ok(drawing)
    }

    fn check(&self) -> Result<(), PlotError> {
        if self.methods.is_empty() || self.rows.is_empty() {
            return Err(empty(PICTURE, "no method or no time"));
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

    fn fields(&self) -> impl Iterator<Item = &Field> {
        self.rows.iter().flat_map(|(_, fields)| fields)
    }

    fn extent(&self) -> (Range, Range) {
        let range = |pick: fn(&Field) -> &Vec<f64>| {
            self.fields()
                .flat_map(pick)
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                    (f64::min(low, *v), f64::max(high, *v))
                })
        };
        (range(|f| &f.x), range(|f| &f.y))
    }

    fn limit(&self) -> f64 {
        let largest = self
            .fields()
            .flat_map(|f| &f.values)
            .fold(0.0, |m, v| f64::max(m, *v));
        if largest > 0.0 { largest } else { 1.0 }
    }

    fn draw_outlines(&self, drawing: &mut Drawing, panel: &Panel) {
        for [lower, upper] in &self.outlines {
            let (a, b) = (panel.at(lower[0], lower[1]), panel.at(upper[0], upper[1]));
            let path = vec![a, (b.0, a.1), b, (a.0, b.1), a];
            drawing.add(Mark::Path(path, Stroke::dashed(palette::PAPER, 1.2)));
        }
    }

    fn label(
        &self,
        drawing: &mut Drawing,
        panel: &Panel,
        (row, column): (usize, usize),
        time: f64,
    ) {
        let last = row + 1 == self.rows.len();
        panel.frame(drawing, last, column == 0);
        if row == 0 {
            panel.headline(drawing, &self.methods[column]);
        }
        if last {
            panel.x_title(drawing, "x (m)");
        }
        if column == 0 {
            panel.y_title(drawing, "y (m)", 56.0);
            let text = format!("t = {} s", crate::format::short(time));
            panel.y_title(drawing, &text, 84.0);
        }
    }
}
