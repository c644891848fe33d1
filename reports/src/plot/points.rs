//! Points and the lines that join them, several panels side by side, each with its own scale: numbers
//! of several methods over a parameter or over their cost.

use super::axis::{Axis, LABEL_TEXT, Panel};
use super::drawing::{Align, Drawing, Mark, Stroke};
use super::writer::text_width;
use super::{PlotError, check, empty, palette};
use plotters::style::RGBColor;

const PICTURE: &str = "points";
const WIDTH: f64 = 900.0;
const LEFT: f64 = 72.0;
const RIGHT: f64 = 20.0;
const GAP_X: f64 = 76.0;
const GAP_Y: f64 = 56.0;
const FOOT: f64 = 40.0;
/// Whiskers of methods at the same place stand this far apart (logical pixels).
const DODGE: f64 = 5.0;

/// How a series is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Dots, joined.
    #[default]
    Joined,
    /// Dots alone.
    Dots,
    /// A dashed line without dots.
    Dashed,
    /// Crosses: what is shown as failed.
    Crosses,
}

/// One method's numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointSeries {
    /// Name in the legend; a method's colour follows it.
    pub name: String,
    /// Abscissae.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
    /// Smallest and largest beside each ordinate; empty without.
    pub whiskers: Vec<[f64; 2]>,
    /// How it is drawn.
    pub style: Style,
    /// Words at the points; empty without.
    pub labels: Vec<String>,
}

/// Numbers of one kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointPanel {
    /// Title above the panel.
    pub title: String,
    /// What is drawn upwards.
    pub y_name: String,
    /// Its unit.
    pub unit: String,
    /// On a logarithmic scale; what is not positive is left out then.
    pub log: bool,
    /// A shaded range with its name.
    pub band: Option<([f64; 2], String)>,
    /// Ruled levels with their names.
    pub rules: Vec<(f64, String)>,
    /// The series.
    pub series: Vec<PointSeries>,
}

/// Panels over one abscissa.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointPlot {
    /// What is drawn to the right, with its unit.
    pub x_name: String,
    /// On a logarithmic scale.
    pub x_log: bool,
    /// The panels.
    pub panels: Vec<PointPanel>,
}

impl PointPlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        self.check()?;
        let columns = if self.panels.len() == 1 { 1 } else { 2 };
        let rows = self.panels.len().div_ceil(columns);
        let height = if columns == 1 { 400.0 } else { 210.0 };
        let legend = self.legend()?;
        let head = 18.0
            * legend
                .last()
                .map_or(0.0, |(_, _, row)| f64::from(*row) + 1.0)
            + 14.0;
        let total = head + rows as f64 * (height + GAP_Y) + FOOT;
        let mut drawing = Drawing::new(WIDTH as u32, total.ceil() as u32);
        for (name, x, row) in &legend {
            self.entry(&mut drawing, name, (*x, 14.0 + 18.0 * f64::from(*row)));
        }
        let width = (WIDTH - LEFT - RIGHT - GAP_X * (columns - 1) as f64) / columns as f64;
        let x = self.x_axis(width);
        for (i, content) in self.panels.iter().enumerate() {
            let (column, row) = (i % columns, i / columns);
            let panel = Panel {
                left: LEFT + column as f64 * (width + GAP_X),
                top: head + row as f64 * (height + GAP_Y) + 24.0,
                width,
                height,
                x: x.clone(),
                y: y_axis(content, height),
            };
            self.panel(&mut drawing, &panel, content);
        }
        Ok(drawing)
    }

    fn check(&self) -> Result<(), PlotError> {
        if !self
            .panels
            .iter()
            .any(|p| p.series.iter().any(|s| !s.x.is_empty()))
        {
            return Err(empty(PICTURE, "no point"));
        }
        for series in self.panels.iter().flat_map(|panel| &panel.series) {
            check(PICTURE, &series.name, &series.x, series.y.len())?;
            check(PICTURE, &series.name, &series.y, series.x.len())?;
            let ends: Vec<f64> = series.whiskers.concat();
            if !ends.is_empty() {
                check(PICTURE, &series.name, &ends, 2 * series.x.len())?;
            }
        }
        Ok(())
    }

    fn x_axis(&self, width: f64) -> Axis {
        let mut at: Vec<f64> = self
            .panels
            .iter()
            .flat_map(|panel| panel.series.iter().flat_map(|s| s.x.iter().copied()))
            .filter(|x| !self.x_log || *x > 0.0)
            .collect();
        at.sort_by(f64::total_cmp);
        at.dedup();
        let (min, max) = (at.first().copied(), at.last().copied());
        let (min, max) = (min.unwrap_or(0.1), max.unwrap_or(1.0));
        if self.x_log {
            return Axis::log_range(min / 1.6, max * 1.6, (width / 60.0) as usize);
        }
        let margin = 0.05 * (max - min);
        Axis::linear(min - margin, max + margin, (width / 70.0) as usize)
    }

    fn panel(&self, drawing: &mut Drawing, panel: &Panel, content: &PointPanel) {
        if let Some(([low, high], name)) = &content.band {
            let corners = [
                panel.at(panel.x.range().0, *low),
                panel.at(panel.x.range().1, *low),
                panel.at(panel.x.range().1, *high),
                panel.at(panel.x.range().0, *high),
            ];
            drawing.add(Mark::Area(corners.to_vec(), palette::BAND));
            let at = (panel.right() - 5.0, corners[2].1 - 7.0);
            drawing.text_in(name, at, 11.0, Align::End, palette::SOFT);
        }
        panel.grid(drawing);
        for (level, name) in &content.rules {
            let y = panel.at(0.0, *level).1;
            let stroke = Stroke::dashed(palette::SOFT, 1.0);
            drawing.line((panel.left, y), (panel.right(), y), stroke);
            let at = (panel.right() - 5.0, y - 7.0);
            drawing.text_in(name, at, 11.0, Align::End, palette::SOFT);
        }
        let count = content.series.len();
        for (i, series) in content.series.iter().enumerate() {
            let aside = DODGE * (i as f64 - 0.5 * (count.max(1) - 1) as f64);
            let aside = if series.whiskers.is_empty() {
                0.0
            } else {
                aside
            };
            draw_series(
                drawing,
                panel,
                series,
                content.log,
                (self.colour(&series.name), aside),
            );
        }
        panel.frame(drawing, true, true);
        panel.headline(drawing, &content.title);
        panel.x_title(drawing, &panel.x.title(&self.x_name, ""));
        let name = panel.y.title(&content.y_name, &content.unit);
        panel.y_title(drawing, &name, 55.0);
    }

    fn names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for series in self.panels.iter().flat_map(|panel| &panel.series) {
            if !names.contains(&series.name.as_str()) {
                names.push(&series.name);
            }
        }
        names
    }

    fn colour(&self, name: &str) -> RGBColor {
        let own = name.split(['/', ',']).next().unwrap_or(name);
        let index = self.names().iter().position(|n| *n == name).unwrap_or(0);
        palette::series(own, index)
    }

    /// Names with their places: left end and row.
    fn legend(&self) -> Result<Vec<(String, f64, u32)>, PlotError> {
        let (mut x, mut row) = (LEFT, 0);
        let mut entries = Vec::new();
        for name in self.names() {
            let width = 34.0 + text_width(name, LABEL_TEXT)? + 20.0;
            if x + width > WIDTH && x > LEFT {
                (x, row) = (LEFT, row + 1);
            }
            entries.push((name.to_owned(), x, row));
            x += width;
        }
        Ok(entries)
    }

    fn entry(&self, drawing: &mut Drawing, name: &str, at: (f64, f64)) {
        let mut all = self.panels.iter().flat_map(|panel| &panel.series);
        let style = all
            .find(|s| s.name == name)
            .map(|s| s.style)
            .unwrap_or_default();
        let colour = self.colour(name);
        let (x, y) = at;
        match style {
            Style::Joined => drawing.line((x, y), (x + 24.0, y), Stroke::solid(colour, 2.0)),
            Style::Dashed => drawing.line((x, y), (x + 24.0, y), Stroke::dashed(colour, 1.6)),
            Style::Dots | Style::Crosses => {}
        }
        match style {
            Style::Joined | Style::Dots => drawing.add(Mark::Dot((x + 12.0, y), 4.0, colour)),
            Style::Crosses => cross(drawing, (x + 12.0, y), colour),
            Style::Dashed => {}
        }
        drawing.text(name, (x + 30.0, y), LABEL_TEXT, Align::Start);
    }
}

fn y_axis(content: &PointPanel, height: f64) -> Axis {
    let mut all: Vec<f64> = Vec::new();
    for series in &content.series {
        all.extend(&series.y);
        all.extend(series.whiskers.concat());
    }
    all.extend(content.band.iter().flat_map(|(ends, _)| ends));
    all.extend(content.rules.iter().map(|(level, _)| *level));
    all.retain(|v| !content.log || *v > 0.0);
    let low = all.iter().copied().fold(f64::INFINITY, f64::min);
    let high = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if content.log {
        if low > high {
            return Axis::log(1e-3, 1.0, 4);
        }
        return Axis::log_range(low / 1.6, high * 1.6, (height / 30.0) as usize);
    }
    let (low, high) = if low > high {
        (0.0, 1.0)
    } else {
        (low.min(0.0), high.max(0.0))
    };
    let margin = 0.06 * (high - low);
    Axis::linear(low - margin, high + margin, (height / 36.0) as usize)
}

fn draw_series(
    drawing: &mut Drawing,
    panel: &Panel,
    series: &PointSeries,
    log: bool,
    (colour, aside): (RGBColor, f64),
) {
    let shown = |i: &usize| !log || series.y[*i] > 0.0;
    let kept: Vec<usize> = (0..series.x.len()).filter(shown).collect();
    let place = |i: usize| {
        let (x, y) = panel.at(series.x[i], series.y[i]);
        (x + aside, y)
    };
    let path: Vec<(f64, f64)> = kept.iter().map(|i| place(*i)).collect();
    for &i in &kept {
        let Some([low, high]) = series.whiskers.get(i) else {
            continue;
        };
        let [foot, top] = [low, high].map(|v| panel.at(series.x[i], *v).1);
        let x = path.first().map_or(0.0, |_| place(i).0);
        drawing.line((x, foot), (x, top), Stroke::solid(colour, 2.0));
    }
    match series.style {
        Style::Joined if path.len() > 1 && series.whiskers.is_empty() => {
            drawing.add(Mark::Path(path.clone(), Stroke::solid(colour, 1.8)));
        }
        Style::Dashed => drawing.add(Mark::Path(path.clone(), Stroke::dashed(colour, 1.4))),
        _ => {}
    }
    for (point, &i) in path.iter().zip(&kept) {
        match series.style {
            Style::Joined | Style::Dots => drawing.add(Mark::Dot(*point, 4.0, colour)),
            Style::Crosses => cross(drawing, *point, colour),
            Style::Dashed => {}
        }
        if let Some(label) = series.labels.get(i) {
            let at = (point.0 + 7.0, point.1 - 8.0);
            drawing.text_in(label, at, 11.0, Align::Start, palette::SOFT);
        }
    }
}

fn cross(drawing: &mut Drawing, (x, y): (f64, f64), colour: RGBColor) {
    let stroke = Stroke::solid(colour, 1.8);
    drawing.line((x - 4.0, y - 4.0), (x + 4.0, y + 4.0), stroke);
    drawing.line((x - 4.0, y + 4.0), (x + 4.0, y - 4.0), stroke);
}
