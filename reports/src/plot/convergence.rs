//! Error against cell size, log-log, with the slope of a stated order.

use super::axis::{Axis, LABEL_TEXT, Panel, TICK_TEXT};
use super::drawing::{Align, Drawing, Mark, Stroke};
use super::{PlotError, check, empty, palette};
use crate::format;

const PICTURE: &str = "convergence";
const WIDTH: u32 = 900;
const HEIGHT: u32 = 440;
const LEGEND: f64 = 250.0;

/// Smallest and largest value.
type Range = (f64, f64);

/// One method, scene or receiver on several levels.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvergenceSeries {
    /// Name in the legend; a method's colour follows it.
    pub name: String,
    /// Cell sizes (m), or other values that were refined.
    pub h: Vec<f64>,
    /// Errors, positive.
    pub errors: Vec<f64>,
    /// Observed order, shown in the legend.
    pub order: Option<f64>,
}

/// Convergence of several series.
#[derive(Clone, Debug, PartialEq)]
pub struct ConvergencePlot {
    /// Name of the error, for example `rel_l2`.
    pub quantity: String,
    /// The series.
    pub series: Vec<ConvergenceSeries>,
    /// What was refined, for example `cell size h (m)`.
    pub refined: String,
    /// Order of the slope triangle.
    pub slope: f64,
}

impl ConvergencePlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        let (h, errors) = self.ranges()?;
        let mut drawing = Drawing::new(WIDTH, HEIGHT);
        let panel = Panel {
            left: 76.0,
            top: 16.0,
            width: f64::from(WIDTH) - 76.0 - LEGEND,
            height: f64::from(HEIGHT) - 16.0 - 48.0,
            x: Axis::log_at(h.0 / 1.5, h.1 * 1.5, self.levels()),
            y: Axis::log_range(errors.0 / 2.5, errors.1 * 1.8, 8),
        };
        panel.grid(&mut drawing);
        self.draw_triangle(&mut drawing, &panel, h, errors);
        for (i, series) in self.series.iter().enumerate() {
            draw_series(&mut drawing, &panel, series, i);
        }
        panel.frame(&mut drawing, true, true);
        panel.x_title(&mut drawing, &self.refined);
        panel.y_title(&mut drawing, &self.quantity, 58.0);
        Ok(drawing)
    }

    /// The distinct cell sizes.
    fn levels(&self) -> Vec<f64> {
        let mut levels: Vec<f64> = self.series.iter().flat_map(|s| s.h.clone()).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup();
        levels
    }

    /// Smallest and largest h and error, after a check of the data.
    fn ranges(&self) -> Result<(Range, Range), PlotError> {
        let mut h = (f64::INFINITY, 0.0);
        let mut errors = (f64::INFINITY, 0.0);
        for series in &self.series {
            check(PICTURE, &series.name, &series.errors, series.h.len())?;
            check(PICTURE, &series.name, &series.h, series.errors.len())?;
            if series.h.iter().chain(&series.errors).any(|v| *v <= 0.0) {
                let reason = format!("{} has a value that is not positive", series.name);
                return Err(empty(PICTURE, &reason));
            }
            h = series
                .h
                .iter()
                .fold(h, |r, v| (f64::min(r.0, *v), f64::max(r.1, *v)));
            errors = series
                .errors
                .iter()
                .fold(errors, |r, v| (f64::min(r.0, *v), f64::max(r.1, *v)));
        }
        if h.1 > h.0 {
            Ok((h, errors))
        } else {
            Err(empty(PICTURE, "fewer than two levels"))
        }
    }

    /// A right-angled triangle with the stated slope, low at the right where curves that fall
    /// towards small h leave room.
    fn draw_triangle(&self, drawing: &mut Drawing, panel: &Panel, h: Range, errors: Range) {
        let reach = (h.1 / h.0).sqrt().min(2.0);
        let (right, low) = (h.1, errors.0);
        let left = right / reach;
        let rise = reach.powf(self.slope);
        let corners = [
            panel.at(left, low),
            panel.at(right, low),
            panel.at(right, low * rise),
        ];
        drawing.add(Mark::Area(corners.to_vec(), palette::GRID));
        let outline = [corners[0], corners[1], corners[2], corners[0]];
        let stroke = Stroke::solid(palette::SOFT, 0.8);
        drawing.add(Mark::Path(outline.to_vec(), stroke));
        let under = (0.5 * (corners[0].0 + corners[1].0), corners[0].1 + 9.0);
        drawing.text_in("1", under, TICK_TEXT, Align::Middle, palette::SOFT);
        let beside = (corners[1].0 + 5.0, 0.5 * (corners[1].1 + corners[2].1));
        let text = format!("{}", self.slope);
        drawing.text_in(&text, beside, TICK_TEXT, Align::Start, palette::SOFT);
    }
}

fn draw_series(drawing: &mut Drawing, panel: &Panel, series: &ConvergenceSeries, index: usize) {
    let colour = palette::series(&series.name, index);
    let points = series.h.iter().zip(&series.errors);
    let path: Vec<(f64, f64)> = points.map(|(h, e)| panel.at(*h, *e)).collect();
    for point in &path {
        drawing.add(Mark::Dot(*point, 4.0, colour));
    }
    drawing.add(Mark::Path(path, Stroke::solid(colour, 1.8)));
    let y = panel.top + 12.0 + 22.0 * index as f64;
    let x = panel.right() + 18.0;
    drawing.line((x, y), (x + 24.0, y), Stroke::solid(colour, 1.8));
    drawing.add(Mark::Dot((x + 12.0, y), 4.0, colour));
    let text = match series.order {
        Some(order) => format!("{}, order {}", series.name, format::number(order)),
        None => series.name.clone(),
    };
    drawing.text(&text, (x + 30.0, y), LABEL_TEXT, Align::Start);
}
