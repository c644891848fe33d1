//! Panels of lines with a shared legend: the body of all pictures over time.

use super::axis::{Axis, LABEL_TEXT, Panel};
use super::drawing::{Align, Drawing, Mark, Stroke};
use super::writer::text_width;
use super::{PlotError, check, empty, palette};

const WIDTH: u32 = 900;
const LEFT: f64 = 68.0;
const RIGHT: f64 = 16.0;
const GAP_X: f64 = 68.0;
const GAP_Y: f64 = 48.0;
const FOOT: f64 = 30.0;

/// One named line, usually a method.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Name in the legend; the colour follows it.
    pub name: String,
    /// Abscissae, increasing.
    pub x: Vec<f64>,
    /// Values.
    pub y: Vec<f64>,
}

/// A panel's content.
#[derive(Clone, Debug)]
pub(super) struct Content {
    pub title: String,
    /// Drawn under the others, thick and grey.
    pub reference: Option<Line>,
    pub lines: Vec<Line>,
    /// Abscissae that are ruled and labelled.
    pub marks: Vec<(f64, String)>,
}

/// Vertical axis of the panels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Vertical {
    /// Each panel has its own range with zero inside.
    Linear,
    /// Decades, the same for all panels; the optional level is ruled and labelled.
    Log { floor: Option<f64> },
}

/// Line panels with their names.
pub(super) struct Panels<'a> {
    pub picture: &'static str,
    pub panels: Vec<Content>,
    pub x_name: (&'a str, &'a str),
    pub y_name: (&'a str, &'a str),
    pub vertical: Vertical,
}

impl Panels<'_> {
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        self.check()?;
        let columns = match self.panels.len() {
            0..=3 => 1,
            4..=8 => 2,
            _ => 3,
        };
        let rows = self.panels.len().div_ceil(columns);
        let height = match columns {
            1 if rows == 1 => 300.0,
            1 => 190.0,
            _ => 150.0,
        };
        let legend = self.legend()?;
        let head = 18.0 * legend.last().map_or(0.0, |e| e.row as f64 + 1.0) + 14.0;
        let total = head + rows as f64 * (height + GAP_Y) + FOOT;
        let mut drawing = Drawing::new(WIDTH, total.ceil() as u32);
        draw_legend(&mut drawing, &legend);
        let gaps = GAP_X * (columns - 1) as f64;
        let width = (f64::from(WIDTH) - LEFT - RIGHT - gaps) / columns as f64;
        let x = self.x_axis(width);
        for (i, content) in self.panels.iter().enumerate() {
            let (column, row) = (i % columns, i / columns);
            let panel = Panel {
                left: LEFT + column as f64 * (width + GAP_X),
                top: head + row as f64 * (height + GAP_Y) + 22.0,
                width,
                height,
                x: x.clone(),
                y: self.y_axis(content, height),
            };
            let last = i + columns >= self.panels.len();
            self.draw_panel(&mut drawing, &panel, content, last);
        }
        Ok(drawing)
    }

    fn check(&self) -> Result<(), PlotError> {
        if self.panels.is_empty() {
            return Err(empty(self.picture, "no panel"));
        }
        for content in &self.panels {
            if content.lines.is_empty() && content.reference.is_none() {
                return Err(empty(
                    self.picture,
                    &format!("no line in {}", content.title),
                ));
            }
            for line in content.lines.iter().chain(&content.reference) {
                let what = format!("{} in {}", line.name, content.title);
                check(self.picture, &what, &line.x, line.y.len())?;
                check(self.picture, &what, &line.y, line.x.len())?;
                if line.x.is_empty() {
                    return Err(empty(self.picture, &what));
                }
            }
        }
        Ok(())
    }

    fn all_lines(&self) -> impl Iterator<Item = &Line> {
        self.panels
            .iter()
            .flat_map(|p| p.lines.iter().chain(&p.reference))
    }

    fn x_axis(&self, width: f64) -> Axis {
        let (min, max) = bounds(self.all_lines().flat_map(|l| &l.x));
        Axis::linear(min, max, (width / 70.0) as usize)
    }

    fn y_axis(&self, content: &Content, height: f64) -> Axis {
        match self.vertical {
            Vertical::Linear => {
                let lines = content.lines.iter().chain(&content.reference);
                let (min, max) = bounds(lines.flat_map(|l| &l.y));
                let (min, max) = (min.min(0.0), max.max(0.0));
                let margin = 0.05 * (max - min);
                Axis::linear(min - margin, max + margin, (height / 34.0) as usize)
            }
            Vertical::Log { floor } => {
                let peaks = self.all_lines().map(|l| bounds(&l.y).1);
                let top = peaks.fold(floor.unwrap_or(0.0), f64::max);
                let top = if top > 0.0 { top } else { 1.0 };
                // A decade below what the quietest line ends at or the floor; at most ten in all.
                let ends = self.all_lines().map(final_peak).filter(|p| *p > 0.0);
                let quiet = ends.chain(floor).fold(top, f64::min);
                let bottom = f64::max(0.1 * quiet, 1e-10 * top);
                Axis::log(bottom, top, (height / 26.0) as usize)
            }
        }
    }

    fn draw_panel(&self, drawing: &mut Drawing, panel: &Panel, content: &Content, last: bool) {
        panel.grid(drawing);
        if let Some(reference) = &content.reference {
            let stroke = Stroke::solid(palette::REFERENCE, 4.5);
            draw_line(drawing, panel, reference, stroke);
        }
        // Later lines are thinner, so that lines that coincide all stay visible.
        let count = content.lines.len();
        for (i, line) in content.lines.iter().enumerate() {
            let share = i as f64 / (count.max(2) - 1) as f64;
            let stroke = Stroke::solid(palette::method(&line.name), 3.0 - 1.5 * share);
            draw_line(drawing, panel, line, stroke);
        }
        for (i, (x, label)) in content.marks.iter().enumerate() {
            let at = panel.at(*x, 0.0).0;
            if !(panel.left..=panel.right()).contains(&at) {
                continue;
            }
            let stroke = Stroke::dashed(palette::SOFT, 1.0);
            drawing.line((at, panel.top), (at, panel.bottom()), stroke);
            // one below the other, so that near ones can be read
            let place = (at + 5.0, panel.top + 10.0 + 13.0 * (i % 4) as f64);
            drawing.text_in(label, place, 11.0, Align::Start, palette::SOFT);
        }
        if let Vertical::Log { floor: Some(floor) } = self.vertical {
            let y = panel.at(0.0, floor).1;
            let stroke = Stroke::dashed(palette::SOFT, 1.0);
            drawing.line((panel.left, y), (panel.right(), y), stroke);
            let at = (panel.right() - 5.0, y - 7.0);
            drawing.text_in("floor", at, 11.0, Align::End, palette::SOFT);
        }
        panel.frame(drawing, true, true);
        panel.headline(drawing, &content.title);
        if last {
            panel.x_title(drawing, &panel.x.title(self.x_name.0, self.x_name.1));
        }
        let name = panel.y.title(self.y_name.0, self.y_name.1);
        panel.y_title(drawing, &name, 53.0);
    }

    fn legend(&self) -> Result<Vec<Entry>, PlotError> {
        let mut entries: Vec<Entry> = Vec::new();
        let references = self.panels.iter().filter_map(|p| p.reference.as_ref());
        let lines = self.panels.iter().flat_map(|p| &p.lines);
        let strokes = references
            .map(|l| (l, Stroke::solid(palette::REFERENCE, 4.5)))
            .chain(lines.map(|l| (l, Stroke::solid(palette::method(&l.name), 2.4))));
        let (mut x, mut row) = (LEFT, 0);
        for (line, stroke) in strokes {
            if entries.iter().any(|e| e.name == line.name) {
                continue;
            }
            let width = 32.0 + text_width(&line.name, LABEL_TEXT)? + 20.0;
            if x + width > f64::from(WIDTH) && x > LEFT {
                (x, row) = (LEFT, row + 1);
            }
            entries.push(Entry {
                name: line.name.clone(),
                stroke,
                x,
                row,
            });
            x += width;
        }
        Ok(entries)
    }
}

struct Entry {
    name: String,
    stroke: Stroke,
    x: f64,
    row: usize,
}

fn draw_legend(drawing: &mut Drawing, entries: &[Entry]) {
    for entry in entries {
        let y = 14.0 + 18.0 * entry.row as f64;
        drawing.line((entry.x, y), (entry.x + 24.0, y), entry.stroke);
        let at = (entry.x + 30.0, y);
        drawing.text(&entry.name, at, LABEL_TEXT, Align::Start);
    }
}

/// Largest value over the last quarter of a line.
fn final_peak(line: &Line) -> f64 {
    bounds(&line.y[3 * line.y.len() / 4..]).1
}

fn bounds<'a>(values: impl IntoIterator<Item = &'a f64>) -> (f64, f64) {
    values
        .into_iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(*v), high.max(*v))
        })
}

/// Draws a line, interrupted where it runs below the panel.
fn draw_line(drawing: &mut Drawing, panel: &Panel, line: &Line, stroke: Stroke) {
    let foot = panel.bottom() - 1e-9;
    let points = place(panel, line);
    // Joined are neighbours of which at least one is inside: the line is seen to leave and return.
    for run in points.chunk_by(|a, b| a.1 < foot || b.1 < foot) {
        if run.len() > 1 {
            drawing.add(Mark::Path(run.to_vec(), stroke));
        }
    }
}

/// The line on the panel, thinned to the extremes of each half pixel.
fn place(panel: &Panel, line: &Line) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = line
        .x
        .iter()
        .zip(&line.y)
        .map(|(x, y)| panel.at(*x, *y))
        .collect();
    if points.len() < (4.0 * panel.width) as usize {
        return points;
    }
    let bucket = |p: &(f64, f64)| (2.0 * p.0).floor() as i64;
    let mut thin = Vec::new();
    for chunk in points.chunk_by(|a, b| bucket(a) == bucket(b)) {
        let key = |i: &usize| chunk[*i].1;
        let low = (0..chunk.len()).min_by(|a, b| key(a).total_cmp(&key(b)));
        let high = (0..chunk.len()).max_by(|a, b| key(a).total_cmp(&key(b)));
        let mut kept = vec![0, chunk.len() - 1];
        kept.extend(low);
        kept.extend(high);
        kept.sort_unstable();
        kept.dedup();
        thin.extend(kept.into_iter().map(|i| chunk[i]));
    }
    thin
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_the_extremes() {
        let panel = Panel {
            left: 0.0,
            top: 0.0,
            width: 100.0,
            height: 100.0,
            x: Axis::linear(0.0, 1.0, 5),
            y: Axis::linear(-1.0, 1.0, 5),
        };
        let x: Vec<f64> = (0..=20_000).map(|i| f64::from(i) / 20_000.0).collect();
        let mut y = vec![0.0; x.len()];
        y[7001] = 1.0;
        y[7003] = -1.0;
        let line = Line {
            name: "spike".to_owned(),
            x,
            y,
        };
        let thin = place(&panel, &line);
        assert!(thin.len() < 1000);
        assert!(thin.iter().any(|p| p.1 == 0.0) && thin.iter().any(|p| p.1 == 100.0));
        assert_eq!(thin.last().map(|p| p.0), Some(100.0));
    }
}
