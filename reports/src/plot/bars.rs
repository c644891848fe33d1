//! Bars: the echo of each method on a log axis, with its cost beside it.

use super::axis::{Axis, LABEL_TEXT, Panel, TICK_TEXT};
use super::drawing::{Align, Drawing, Mark, Stroke};
use super::writer::text_width;
use super::{PlotError, check, empty, palette};
use crate::format;

const PICTURE: &str = "bars";
const WIDTH: f64 = 900.0;
const ROW: f64 = 26.0;
const TOP: f64 = 42.0;
const FOOT: f64 = 46.0;
const GAP: f64 = 26.0;
/// Echoes above this are of runs that grow: their bars end at the axis' end, with the number in them.
const LARGEST_ECHO: f64 = 30.0;
/// A floor this much below all echoes is told of instead of making all bars look alike.
const FAR_BELOW: f64 = 0.01;

/// One column of bars: a number for each method.
#[derive(Clone, Debug, PartialEq)]
pub struct Bars {
    /// Title, for example `CPU time`.
    pub title: String,
    /// Unit; empty for a mere number.
    pub unit: String,
    /// One value a method; `None` draws a dash.
    pub values: Vec<Option<f64>>,
}

/// Echo and cost of several methods.
#[derive(Clone, Debug, PartialEq)]
pub struct BarPlot {
    /// Methods from top to bottom.
    pub methods: Vec<String>,
    /// The echo, on a log axis.
    pub echo: Bars,
    /// The worst receiver's echo of each method, marked behind its bar.
    pub worst: Vec<Option<f64>>,
    /// The floor of the reference.
    pub floor: Option<f64>,
    /// What it costs, each on a linear axis from zero.
    pub costs: Vec<Bars>,
}

impl BarPlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        self.check()?;
        let height = ROW * self.methods.len() as f64;
        let mut drawing = Drawing::new(WIDTH as u32, (TOP + height + FOOT) as u32);
        let left = self.names(&mut drawing)?;
        // The echo gets twice the width of a cost.
        let parts = 2.0 + self.costs.len() as f64;
        let gaps = GAP * self.costs.len() as f64;
        let part = (WIDTH - left - 24.0 - gaps) / parts;
        let mut panel = Panel {
            left,
            top: TOP,
            width: 2.0 * part,
            height,
            x: self.echo_axis(),
            y: Axis::linear(0.0, self.methods.len() as f64, 1),
        };
        self.draw_column(&mut drawing, &panel, &self.echo, &self.worst);
        if let Some(floor) = self.floor.filter(|floor| *floor > 0.0) {
            draw_floor(&mut drawing, &panel, floor);
        }
        for cost in &self.costs {
            panel.left += panel.width + GAP;
            panel.width = part;
            panel.x = cost_axis(cost, part);
            self.draw_column(&mut drawing, &panel, cost, &[]);
        }
        Ok(drawing)
    }

    fn check(&self) -> Result<(), PlotError> {
        if self.methods.is_empty() {
            return Err(empty(PICTURE, "no method"));
        }
        let columns = self.costs.iter().chain([&self.echo]);
        let lists = columns
            .map(|c| (c.title.as_str(), &c.values))
            .chain([("the worst echo", &self.worst)]);
        for (title, values) in lists {
            let numbers: Vec<f64> = values.iter().map(|v| v.unwrap_or(0.0)).collect();
            check(PICTURE, title, &numbers, self.methods.len())?;
        }
        Ok(())
    }

    /// Writes the methods' names and gives the left end of the bars.
    fn names(&self, drawing: &mut Drawing) -> Result<f64, PlotError> {
        let mut widest = 0.0;
        for name in &self.methods {
            widest = f64::max(widest, text_width(name, LABEL_TEXT)?);
        }
        let left = widest + 20.0;
        for (i, name) in self.methods.iter().enumerate() {
            let at = (left - 10.0, TOP + (i as f64 + 0.5) * ROW);
            drawing.text(name, at, LABEL_TEXT, Align::End);
        }
        Ok(left)
    }

    /// From below the smallest positive value to above the largest, with room for the numbers.
    fn echo_axis(&self) -> Axis {
        let Some((low, high)) = self.echo_range() else {
            return Axis::log(1e-3, 1.0, 6);
        };
        let near = self.floor.filter(|floor| *floor >= FAR_BELOW * low);
        let low = near.map_or(low, |floor| low.min(floor));
        Axis::log_range(0.2 * low, (6.0 * high).min(LARGEST_ECHO), 7)
    }

    /// Smallest and largest positive echo.
    fn echo_range(&self) -> Option<(f64, f64)> {
        let values = self.echo.values.iter().chain(&self.worst).flatten();
        let mut positive = values.copied().filter(|v| *v > 0.0);
        let first = positive.next()?;
        Some(positive.fold((first, first), |(low, high), v| (low.min(v), high.max(v))))
    }

    fn draw_column(
        &self,
        drawing: &mut Drawing,
        panel: &Panel,
        bars: &Bars,
        worst: &[Option<f64>],
    ) {
        let rows = Panel {
            y: Axis::linear(0.0, 1.0, 1),
            ..panel.clone()
        };
        for tick in panel.x.ticks() {
            let x = rows.at(*tick, 0.0).0;
            let stroke = Stroke::solid(palette::GRID, 0.75);
            drawing.line((x, panel.top), (x, panel.bottom()), stroke);
        }
        for (i, value) in bars.values.iter().enumerate() {
            let middle = panel.top + (i as f64 + 0.5) * ROW;
            let colour = palette::method(&self.methods[i]);
            let Some(value) = value else {
                drawing.text("–", (panel.left + 6.0, middle), TICK_TEXT, Align::Start);
                continue;
            };
            let end = panel.at(*value, 0.0).0.min(panel.right());
            let corner = (end.max(panel.left + 1.0), middle + 0.36 * ROW);
            drawing.add(Mark::Fill(
                (panel.left, middle - 0.36 * ROW),
                corner,
                colour,
            ));
            let mut label_at = corner.0;
            if let Some(worst) = worst.get(i).copied().flatten() {
                let x = panel.at(worst, 0.0).0.min(panel.right());
                drawing.line((end, middle), (x, middle), Stroke::solid(palette::INK, 1.0));
                let (above, below) = ((x, middle - 5.0), (x, middle + 5.0));
                drawing.line(above, below, Stroke::solid(palette::INK, 1.5));
                label_at = label_at.max(x);
            }
            let text = shown(*value, &bars.unit);
            place_value(drawing, panel, &text, (label_at, corner.0), middle);
        }
        frame(drawing, panel);
        let at = (panel.left, panel.top - 26.0);
        drawing.text(&bars.title, at, LABEL_TEXT, Align::Start);
        panel.x_title(drawing, &panel.x.title("", &bars.unit));
    }
}

fn shown(value: f64, unit: &str) -> String {
    match unit {
        "" => format::number(value),
        _ => format::with_unit(value, unit),
    }
}

/// Writes a bar's value beyond its end, or inside it where there is no room.
fn place_value(
    drawing: &mut Drawing,
    panel: &Panel,
    text: &str,
    (end, bar_end): (f64, f64),
    middle: f64,
) {
    // 0.64 em a character is what DejaVu's digits take.
    let needed = 0.64 * TICK_TEXT * text.chars().count() as f64 + 8.0;
    if end + needed < panel.right() {
        drawing.text(text, (end + 5.0, middle), TICK_TEXT, Align::Start);
    } else {
        let at = (bar_end - 5.0, middle);
        drawing.text_in(text, at, TICK_TEXT, Align::End, palette::PAPER);
    }
}

fn cost_axis(cost: &Bars, width: f64) -> Axis {
    let max = cost
        .values
        .iter()
        .flatten()
        .fold(0.0, |m, v| f64::max(m, *v));
    let max = if max > 0.0 { 1.35 * max } else { 1.0 };
    Axis::linear(0.0, max, (width / 48.0) as usize)
}

fn draw_floor(drawing: &mut Drawing, panel: &Panel, floor: f64) {
    let x = panel.at(floor, 0.0).0;
    // places beyond the axis are drawn at its end
    if x <= panel.left {
        let text = format!("floor {}, far to the left", format::number(floor));
        let at = (panel.left, panel.top - 8.0);
        drawing.text_in(&text, at, 11.0, Align::Start, palette::SOFT);
        return;
    }
    let stroke = Stroke::dashed(palette::INK, 1.2);
    drawing.line((x, panel.top), (x, panel.bottom()), stroke);
    let at = (x, panel.top - 8.0);
    drawing.text_in("floor", at, 11.0, Align::Middle, palette::SOFT);
}

/// The base line of the bars and the horizontal ticks.
fn frame(drawing: &mut Drawing, panel: &Panel) {
    let stroke = Stroke::solid(palette::INK, 0.75);
    let foot = panel.bottom();
    drawing.line((panel.left, panel.top), (panel.left, foot), stroke);
    drawing.line((panel.left, foot), (panel.right(), foot), stroke);
    for tick in panel.x.ticks() {
        let x = panel.at(*tick, 0.0).0;
        drawing.line((x, foot), (x, foot + 3.5), stroke);
        let at = (x, foot + 12.0);
        drawing.text(&panel.x.tick_label(*tick), at, TICK_TEXT, Align::Middle);
    }
}
