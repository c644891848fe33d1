//! Coloured fields and their colour bar.

use super::axis::{Axis, LABEL_TEXT, Panel, TICK_TEXT};
use super::drawing::{Align, Drawing, Mark, Stroke};
use super::palette;
use plotters::style::RGBColor;

/// Edge of a drawn cell (logical pixels).
const CELL: f64 = 1.0;
/// Steps of the colour map: equal neighbours are drawn as one.
const LEVELS: f64 = 200.0;

/// A map from values to colours over a range.
#[derive(Clone, Copy, Debug)]
pub(super) struct Colours {
    /// Range of the values.
    pub range: (f64, f64),
    /// Colour of a share of the range, 0..1.
    pub map: fn(f64) -> RGBColor,
}

impl Colours {
    /// Blue over white to red for `-limit..limit`.
    pub fn diverging(limit: f64) -> Self {
        Colours {
            range: (-limit, limit),
            map: |share| palette::diverging(2.0 * share - 1.0),
        }
    }

    /// Viridis for `0..limit`.
    pub fn sequential(limit: f64) -> Self {
        Colours {
            range: (0.0, limit),
            map: palette::sequential,
        }
    }

    /// All colours of the map, from the lower end of the range to the upper.
    pub fn levels(&self) -> impl Iterator<Item = RGBColor> {
        (0..=LEVELS as u32).map(|level| (self.map)(f64::from(level) / LEVELS))
    }

    /// Which of [`Self::levels`] a value has.
    pub fn level(&self, value: f64) -> f64 {
        let share = (value - self.range.0) / (self.range.1 - self.range.0);
        (share.clamp(0.0, 1.0) * LEVELS).round()
    }
}

/// A field on a raster of samples with increasing coordinates: `value(ix, iy)`.
pub(super) struct Raster<'a> {
    pub x: &'a [f64],
    pub y: &'a [f64],
    pub value: &'a dyn Fn(usize, usize) -> f64,
}

impl Raster<'_> {
    /// Bilinear between the samples, constant beyond them.
    pub fn at(&self, x: f64, y: f64) -> f64 {
        let (ix, sx) = bracket(self.x, x);
        let (iy, sy) = bracket(self.y, y);
        let jx = (ix + 1).min(self.x.len() - 1);
        let jy = (iy + 1).min(self.y.len() - 1);
        let value = self.value;
        (1.0 - sy) * ((1.0 - sx) * value(ix, iy) + sx * value(jx, iy))
            + sy * ((1.0 - sx) * value(ix, jy) + sx * value(jx, jy))
    }

    /// Fills the panel, whose axes are linear.
    pub fn draw(&self, drawing: &mut Drawing, panel: &Panel, colours: &Colours) {
        let (columns, rows) = (
            (panel.width / CELL) as usize,
            (panel.height / CELL) as usize,
        );
        let (dx, dy) = (panel.width / columns as f64, panel.height / rows as f64);
        let (x_range, y_range) = (panel.x.range(), panel.y.range());
        for row in 0..rows {
            let y_share = 1.0 - (row as f64 + 0.5) / rows as f64;
            let y = y_range.0 + y_share * (y_range.1 - y_range.0);
            let level = |column: usize| {
                let share = (column as f64 + 0.5) / columns as f64;
                colours.level(self.at(x_range.0 + share * (x_range.1 - x_range.0), y))
            };
            let top = panel.top + row as f64 * dy;
            let mut start = 0;
            let mut current = level(0);
            for column in 1..=columns {
                let next = if column < columns {
                    level(column)
                } else {
                    f64::NAN
                };
                if next == current {
                    continue;
                }
                let from = (panel.left + start as f64 * dx, top);
                let to = (panel.left + column as f64 * dx, top + dy);
                drawing.add(Mark::Fill(from, to, (colours.map)(current / LEVELS)));
                (start, current) = (column, next);
            }
        }
    }
}

/// Index of the sample at or before `at`, and the share of the way to the next.
fn bracket(samples: &[f64], at: f64) -> (usize, f64) {
    let after = samples.partition_point(|s| *s <= at);
    if after == 0 {
        return (0, 0.0);
    }
    if after == samples.len() {
        return (after - 1, 0.0);
    }
    let (low, high) = (samples[after - 1], samples[after]);
    (after - 1, (at - low) / (high - low))
}

/// A vertical colour bar with ticks at its right and its name upward beside them.
pub(super) fn colour_bar(
    drawing: &mut Drawing,
    (left, top): (f64, f64),
    height: f64,
    colours: &Colours,
    (name, unit): (&str, &str),
) {
    let axis = Axis::linear(colours.range.0, colours.range.1, (height / 34.0) as usize);
    let panel = Panel {
        left,
        top,
        width: 14.0,
        height,
        x: Axis::linear(0.0, 1.0, 1),
        y: axis,
    };
    let samples = [colours.range.0, colours.range.1];
    Raster {
        x: &[0.0],
        y: &samples,
        value: &|_, iy| samples[iy],
    }
    .draw(drawing, &panel, colours);
    let stroke = Stroke::solid(palette::INK, 0.75);
    let corners = [
        (left, top),
        (panel.right(), top),
        (panel.right(), panel.bottom()),
        (left, panel.bottom()),
        (left, top),
    ];
    drawing.add(Mark::Path(corners.to_vec(), stroke));
    for tick in panel.y.ticks() {
        let y = panel.at(0.0, *tick).1;
        drawing.line((panel.right(), y), (panel.right() + 3.0, y), stroke);
        let at = (panel.right() + 6.0, y);
        drawing.text(&panel.y.tick_label(*tick), at, TICK_TEXT, Align::Start);
    }
    let at = (panel.right() + 56.0, top + 0.5 * height);
    drawing.text_upward(&panel.y.title(name, unit), at, LABEL_TEXT);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rasters_interpolate_between_their_samples() {
        let values = [0.0, 2.0, 4.0, 6.0];
        let raster = Raster {
            x: &[0.0, 1.0],
            y: &[0.0, 1.0],
            value: &|ix, iy| values[2 * iy + ix],
        };
        assert_eq!(raster.at(0.5, 0.5), 3.0);
        assert_eq!(raster.at(1.0, 0.0), 2.0);
        assert_eq!(raster.at(-7.0, 9.0), 4.0);
    }

    #[test]
    fn equal_cells_are_drawn_as_one() {
        let panel = Panel {
            left: 0.0,
            top: 0.0,
            width: 50.0,
            height: 10.0,
            x: Axis::linear(0.0, 1.0, 1),
            y: Axis::linear(0.0, 1.0, 1),
        };
        let raster = Raster {
            x: &[0.0, 1.0],
            y: &[0.0, 1.0],
            value: &|_, _| 0.3,
        };
        let mut drawing = Drawing::new(50, 10);
        raster.draw(&mut drawing, &panel, &Colours::sequential(1.0));
        let mut expected = Drawing::new(50, 10);
        for row in 0..10 {
            let top = f64::from(row);
            let colour = palette::sequential(0.3);
            expected.add(Mark::Fill((0.0, top), (50.0, top + 1.0), colour));
        }
        assert_eq!(drawing, expected);
    }
}
