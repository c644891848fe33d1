//! Curves of methods over any abscissa on a log axis, panels side by side, closed forms dashed.

use super::axis::{Axis, LABEL_TEXT, Panel};
use super::drawing::{Align, Drawing, Mark, Stroke};
use super::writer::text_width;
use super::{Line, PlotError, check, empty, palette};

const PICTURE: &str = "curves";
const WIDTH: f64 = 900.0;
const HEIGHT: f64 = 330.0;
const LEFT: f64 = 68.0;
const GAP: f64 = 26.0;
const RIGHT: f64 = 16.0;
const ROW: f64 = 18.0;

/// A panel.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePanel {
    /// Title.
    pub title: String,
    /// Curves, a method each.
    pub lines: Vec<Line>,
    /// Closed forms, each named as its method.
    pub closed: Vec<Line>,
}

/// Panels that share their axes.
#[derive(Clone, Debug, PartialEq)]
pub struct CurvePlot {
    /// The panels, left to right.
    pub panels: Vec<CurvePanel>,
    /// Name and unit of the abscissae.
    pub x: (String, String),
    /// Are the abscissae on a log axis, each measured one marked?
    pub x_log: bool,
    /// Name of the ordinates.
    pub y: String,
    /// The ordinates' lower end: what lies below is not drawn.
    pub lowest: f64,
}

impl CurvePlot {
    /// Draws it.
    ///
    /// # Errors
    /// Data that do not fit together, are not finite, or of which nothing lies above the lower end.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        let (x, y) = self.axes()?;
        let legend = self.legend()?;
        let head = ROW * legend.last().map_or(0.0, |e| e.2 + 1.0) + 36.0;
        let mut drawing = Drawing::new(WIDTH as u32, (head + HEIGHT + 46.0) as u32);
        for (name, at, row) in &legend {
            let level = 14.0 + ROW * row;
            let stroke = match name.as_str() {
                CLOSED => Stroke::dashed(palette::INK, 1.4),
                method => Stroke::solid(palette::method(method), 2.4),
            };
            drawing.line((*at, level), (at + 24.0, level), stroke);
            drawing.text(name, (at + 30.0, level), LABEL_TEXT, Align::Start);
        }
        let count = self.panels.len() as f64;
        let width = (WIDTH - LEFT - RIGHT - GAP * (count - 1.0)) / count;
        for (i, content) in self.panels.iter().enumerate() {
            let panel = Panel {
                left: LEFT + i as f64 * (width + GAP),
                top: head,
                width,
                height: HEIGHT,
                x: x.clone(),
                y: y.clone(),
            };
            panel.grid(&mut drawing);
            // below the curves in their method's colour, above them as a black core
            for line in &content.closed {
                let stroke = Stroke::dashed(palette::method(&line.name), 2.4);
                draw_line(&mut drawing, &panel, line, stroke, false);
            }
            for line in &content.lines {
                let stroke = Stroke::solid(palette::method(&line.name), 2.4);
                draw_line(&mut drawing, &panel, line, stroke, self.x_log);
            }
            for line in &content.closed {
                let stroke = Stroke::dashed(palette::INK, 0.8);
                draw_line(&mut drawing, &panel, line, stroke, false);
            }
            panel.frame(&mut drawing, true, i == 0);
            panel.headline(&mut drawing, &content.title);
            panel.x_title(&mut drawing, &panel.x.title(&self.x.0, &self.x.1));
            if i == 0 {
                panel.y_title(&mut drawing, &self.y, 53.0);
            }
        }
        Ok(drawing)
    }

    fn lines(&self) -> impl Iterator<Item = &Line> {
        self.panels
            .iter()
            .flat_map(|p| p.lines.iter().chain(&p.closed))
    }

    fn axes(&self) -> Result<(Axis, Axis), PlotError> {
        let (mut x, mut top) = ((f64::INFINITY, f64::NEG_INFINITY), 0.0_f64);
        for line in self.lines() {
            check(PICTURE, &line.name, &line.x, line.y.len())?;
            check(PICTURE, &line.name, &line.y, line.x.len())?;
            x = line.x.iter().fold(x, |r, v| (r.0.min(*v), r.1.max(*v)));
            top = line.y.iter().copied().fold(top, f64::max);
        }
        if !(top > self.lowest && self.lowest > 0.0) {
            return Err(empty(PICTURE, "no curve above the lower end"));
        }
        if self.x_log && x.0 <= 0.0 {
            return Err(empty(
                PICTURE,
                "an abscissa that is not positive on a log axis",
            ));
        }
        let horizontal = if self.x_log {
            Axis::log_range(x.0 / 1.05, x.1 * 1.05, 6)
        } else {
            Axis::linear(x.0, x.1, 6)
        };
        Ok((horizontal, Axis::log_range(self.lowest, 1.3 * top, 12)))
    }

    /// Entries with their place and row.
    fn legend(&self) -> Result<Vec<(String, f64, f64)>, PlotError> {
        let mut entries: Vec<(String, f64, f64)> = Vec::new();
        let (mut x, mut row) = (LEFT, 0.0);
        let names = self
            .panels
            .iter()
            .flat_map(|p| &p.lines)
            .map(|l| l.name.as_str());
        let closed = self.panels.iter().any(|p| !p.closed.is_empty());
        for name in names.chain(closed.then_some(CLOSED)) {
            if entries.iter().any(|e| e.0 == name) {
                continue;
            }
            let width = 32.0 + text_width(name, LABEL_TEXT)? + 20.0;
            if x + width > WIDTH && x > LEFT {
                (x, row) = (LEFT, row + 1.0);
            }
            entries.push((name.to_owned(), x, row));
            x += width;
        }
        Ok(entries)
    }
}

/// What dashed lines are, in the legend.
const CLOSED: &str = "closed form";

/// Draws a line, interrupted where it runs below the panel.
fn draw_line(drawing: &mut Drawing, panel: &Panel, line: &Line, stroke: Stroke, dots: bool) {
    let foot = panel.bottom() - 1e-9;
    let points: Vec<(f64, f64)> = line
        .x
        .iter()
        .zip(&line.y)
        .map(|(x, y)| panel.at(*x, *y))
        .collect();
    for run in points.chunk_by(|a, b| a.1 < foot || b.1 < foot) {
        if run.len() > 1 {
            drawing.add(Mark::Path(run.to_vec(), stroke));
        }
    }
    for point in points.iter().filter(|p| dots && p.1 < foot) {
        drawing.add(Mark::Dot(*point, 3.0, stroke.colour));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot() -> CurvePlot {
        let line = |name: &str, y: [f64; 3]| Line {
            name: name.to_owned(),
            x: vec![1.0, 10.0, 100.0],
            y: y.to_vec(),
        };
        let panel = |title: &str| CurvePanel {
            title: title.to_owned(),
            lines: vec![
                line("dashpot", [0.1, 0.2, 0.4]),
                line("pml", [1e-9, 1e-3, 0.1]),
            ],
            closed: vec![line("dashpot", [0.1, 0.2, 0.4])],
        };
        CurvePlot {
            panels: vec![panel("P"), panel("S")],
            x: ("cells".into(), String::new()),
            x_log: true,
            y: "reflection".into(),
            lowest: 1e-5,
        }
    }

    #[test]
    fn methods_are_named_once_and_what_lies_below_is_not_marked() {
        let drawing = plot().draw().unwrap();
        let svg = drawing.to_svg().unwrap();
        for name in ["dashpot", "pml", CLOSED] {
            assert_eq!(svg.matches(&format!(">\n{name}\n")).count(), 1, "{name}");
        }
        let dots = |m: &&Mark| matches!(m, Mark::Dot(..));
        assert_eq!(drawing.marks.iter().filter(dots).count(), 2 * 5);
    }

    #[test]
    fn what_cannot_be_drawn_is_refused() {
        let mut bad = plot();
        bad.panels[0].lines[0].y.pop();
        assert!(matches!(bad.draw(), Err(PlotError::Shape { .. })));
        let mut bad = plot();
        bad.panels[1].closed[0].y[0] = f64::NAN;
        assert!(matches!(bad.draw(), Err(PlotError::NonFinite { .. })));
        let mut bad = plot();
        bad.panels[0].lines[0].x[0] = 0.0;
        assert!(matches!(bad.draw(), Err(PlotError::Empty { .. })));
        bad.lowest = 1.0;
        assert!(matches!(bad.draw(), Err(PlotError::Empty { .. })));
    }
}
