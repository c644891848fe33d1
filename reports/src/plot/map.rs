//! Outcomes as coloured cells: extremes downwards, methods to the right.

use super::axis::{LABEL_TEXT, TITLE_TEXT};
use super::drawing::{Align, Drawing, Mark};
use super::writer::text_width;
use super::{PlotError, empty, palette};
use crate::stability::{Outcome, Stability};
use plotters::style::RGBColor;

const PICTURE: &str = "stability";
const WIDTH: f64 = 900.0;
const ROW: f64 = 22.0;
const GAP: f64 = 34.0;
const TOP: f64 = 44.0;
const FOOT: f64 = 46.0;

const STABLE: RGBColor = RGBColor(0xb7, 0xe0, 0xc5);
const GROWS: RGBColor = RGBColor(0xf2, 0x8e, 0x7c);
const DIVERGED: RGBColor = RGBColor(0xc0, 0x6b, 0x9b);
const NOT_CONVERGED: RGBColor = RGBColor(0xf3, 0xc9, 0x74);
const REFUSED: RGBColor = RGBColor(0xdd, 0xdd, 0xdd);
const OPEN: RGBColor = RGBColor(0xff, 0xff, 0xff);

/// What colours mean, in the order of the legend.
const LEGEND: [(&str, RGBColor); 5] = [
    ("stable, growth rate of energy", STABLE),
    ("grows", GROWS),
    ("diverged", DIVERGED),
    ("not converged", NOT_CONVERGED),
    ("refused", REFUSED),
];

fn colour(outcome: &Outcome) -> RGBColor {
    match outcome {
        Outcome::Stable(_) => STABLE,
        Outcome::Grows(_) => GROWS,
        Outcome::Diverged(_) => DIVERGED,
        Outcome::NotConverged(_) => NOT_CONVERGED,
        Outcome::Refused(_) => REFUSED,
        Outcome::Open(_) => OPEN,
    }
}

/// Draws the map.
///
/// # Errors
/// [`PlotError::Empty`] without runs.
pub fn stability_map(stability: &Stability) -> Result<Drawing, PlotError> {
    let methods = stability.methods();
    if methods.is_empty() {
        return Err(empty(PICTURE, "no run"));
    }
    let rows: usize = stability.parts.iter().map(|part| part.points.len()).sum();
    let height = TOP + rows as f64 * ROW + stability.parts.len() as f64 * GAP + FOOT;
    let mut drawing = Drawing::new(WIDTH as u32, height.ceil() as u32);
    let mut left: f64 = 0.0;
    for point in stability.parts.iter().flat_map(|part| &part.points) {
        left = left.max(text_width(&point.label, LABEL_TEXT)?);
    }
    let left = (left + 24.0).min(0.5 * WIDTH);
    let width = (WIDTH - left - 12.0) / methods.len() as f64;
    for (i, method) in methods.iter().enumerate() {
        let at = (left + (i as f64 + 0.5) * width, TOP - 14.0);
        drawing.text(method, at, LABEL_TEXT, Align::Middle);
    }
    let mut y = TOP;
    for part in &stability.parts {
        drawing.text(&part.title, (12.0, y + 0.6 * GAP), TITLE_TEXT, Align::Start);
        y += GAP;
        for point in &part.points {
            let at = (left - 10.0, y + 0.5 * ROW);
            drawing.text(&point.label, at, LABEL_TEXT, Align::End);
            for (i, method) in methods.iter().enumerate() {
                let Some(outcome) = point.outcome(method) else {
                    continue;
                };
                let x = left + i as f64 * width;
                let corner = (x + width - 2.0, y + ROW - 2.0);
                drawing.add(Mark::Fill((x, y), corner, colour(outcome)));
                let middle = (x + 0.5 * width, y + 0.5 * ROW - 1.0);
                drawing.text(&outcome.short(), middle, 12.0, Align::Middle);
            }
            y += ROW;
        }
    }
    let mut x = 12.0;
    for (name, colour) in LEGEND {
        let top = y + 16.0;
        drawing.add(Mark::Fill((x, top), (x + 16.0, top + 14.0), colour));
        drawing.text_in(
            name,
            (x + 22.0, top + 7.0),
            12.0,
            Align::Start,
            palette::INK,
        );
        x += 22.0 + text_width(name, 12.0)? + 22.0;
    }
    Ok(drawing)
}
