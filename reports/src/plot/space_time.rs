//! A field over place and time: waves and their echoes as slanted bands, methods side by side.

use super::axis::{Axis, Panel};
use super::drawing::{Align, Drawing, Mark, Stroke};
use super::heat::{Colours, Raster, colour_bar};
use super::writer::text_width;
use super::{PlotError, check, empty, palette};
use anechoic_solver::record::SpaceTime;

const PICTURE: &str = "space-time";
const WIDTH: f64 = 900.0;
const LEFT: f64 = 62.0;
const BAR: f64 = 92.0;
const GAP: f64 = 24.0;
const HEIGHT: f64 = 230.0;
const ROW: f64 = HEIGHT + 50.0;
const FOOT: f64 = 34.0;
const GUIDE_TEXT: f64 = 11.0;
/// Most panels in a row; four stand two by two.
const ACROSS: usize = 3;

/// A horizontal line over the field: a receiver, the edge of a layer.
#[derive(Clone, Debug, PartialEq)]
pub struct Guide {
    /// Coordinate along the line of samples (m).
    pub position: f64,
    /// What lies there.
    pub label: String,
    /// The method in whose panel alone it is drawn; `None`: in all.
    pub method: Option<String>,
}

/// Space-time pictures of several methods with one scale.
#[derive(Clone, Debug, PartialEq)]
pub struct SpaceTimePlot {
    /// What is drawn, for example `velocity`.
    pub quantity: String,
    /// Methods and their fields.
    pub fields: Vec<(String, SpaceTime)>,
    /// Lines over the fields.
    pub guides: Vec<Guide>,
    /// Largest absolute value of the colours; `None`: that of all fields.
    pub limit: Option<f64>,
}

impl SpaceTimePlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        let first = self.check()?;
        let across = match self.fields.len() {
            4 => 2,
            n => n.min(ACROSS),
        };
        let rows = self.fields.len().div_ceil(across);
        let width = (WIDTH - LEFT - BAR - GAP * (across - 1) as f64 - 14.0) / across as f64;
        let mut drawing = Drawing::new(WIDTH as u32, (rows as f64 * ROW + FOOT) as u32);
        let colours = Colours::diverging(self.limit());
        for (i, (method, field)) in self.fields.iter().enumerate() {
            let (column, row) = (i % across, i / across);
            let panel = Panel {
                left: LEFT + column as f64 * (width + GAP),
                top: 28.0 + row as f64 * ROW,
                width,
                height: HEIGHT,
                x: range(self.fields.iter().flat_map(|(_, f)| &f.times), width / 50.0),
                y: range(self.fields.iter().flat_map(|(_, f)| &f.positions), 6.0),
            };
            draw_field(&mut drawing, &panel, field, &colours);
            self.draw_guides(&mut drawing, &panel, method)?;
            panel.frame(&mut drawing, true, column == 0);
            panel.headline(&mut drawing, method);
            if i + across >= self.fields.len() {
                panel.x_title(&mut drawing, "time (s)");
            }
            if column == 0 {
                panel.y_title(&mut drawing, &panel.y.title(&field.axis, "m"), 42.0);
            }
        }
        let corner = (WIDTH - BAR, 28.0);
        let name = (self.quantity.as_str(), first.unit.as_str());
        colour_bar(&mut drawing, corner, HEIGHT, &colours, name);
        Ok(drawing)
    }

    fn check(&self) -> Result<&SpaceTime, PlotError> {
        for (method, field) in &self.fields {
            let (nt, nx) = (field.times.len(), field.positions.len());
            if nt < 2 || nx < 2 {
                let reason = format!("the field of {method} needs two places and two times");
                return Err(empty(PICTURE, &reason));
            }
            check(
                PICTURE,
                &format!("the field of {method}"),
                &field.values,
                nt * nx,
            )?;
            check(PICTURE, &format!("the times of {method}"), &field.times, nt)?;
            check(
                PICTURE,
                &format!("the places of {method}"),
                &field.positions,
                nx,
            )?;
        }
        match self.fields.first() {
            Some((_, field)) => Ok(field),
            None => Err(empty(PICTURE, "no method")),
        }
    }

    fn limit(&self) -> f64 {
        let largest = || {
            let values = self.fields.iter().flat_map(|(_, f)| &f.values);
            values.fold(0.0, |m, v| f64::max(m, v.abs()))
        };
        let limit = self.limit.unwrap_or_else(largest);
        if limit > 0.0 { limit } else { 1.0 }
    }

    fn draw_guides(
        &self,
        drawing: &mut Drawing,
        panel: &Panel,
        method: &str,
    ) -> Result<(), PlotError> {
        let here = |guide: &&Guide| guide.method.as_deref().is_none_or(|m| m == method);
        for guide in self.guides.iter().filter(here) {
            let y = panel.at(0.0, guide.position).1;
            let stroke = Stroke::dashed(palette::SOFT, 0.8);
            drawing.line((panel.left, y), (panel.right(), y), stroke);
            // Above its line, but inside the panel for a line at its top.
            let offset = if y - panel.top < 14.0 { 7.0 } else { -7.0 };
            let (right, middle) = (panel.right() - 4.0, y + offset);
            let width = text_width(&guide.label, GUIDE_TEXT)?;
            let box_from = (right - width - 2.0, middle - 5.5);
            drawing.add(Mark::Fill(
                box_from,
                (right + 2.0, middle + 5.5),
                palette::PAPER,
            ));
            drawing.text(&guide.label, (right, middle), GUIDE_TEXT, Align::End);
        }
        Ok(())
    }
}

fn draw_field(drawing: &mut Drawing, panel: &Panel, field: &SpaceTime, colours: &Colours) {
    let across = field.positions.len();
    // A line may be sampled from top to bottom; the raster wants rising coordinates.
    let mut order: Vec<usize> = (0..across).collect();
    order.sort_by(|a, b| field.positions[*a].total_cmp(&field.positions[*b]));
    let places: Vec<f64> = order.iter().map(|i| field.positions[*i]).collect();
    Raster {
        x: &field.times,
        y: &places,
        value: &|it, ix| field.values[it * across + order[ix]],
    }
    .draw(drawing, panel, colours);
}

fn range<'a>(values: impl Iterator<Item = &'a f64>, ticks: f64) -> Axis {
    let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(*v), high.max(*v))
    });
    Axis::linear(low, high, ticks as usize)
}
