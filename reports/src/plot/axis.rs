//! Axes: range, ticks and their labels, and the frame of a panel.

use super::drawing::{Align, Drawing, Mark, Stroke};
use super::palette;

pub(super) const TICK_TEXT: f64 = 13.0;
pub(super) const LABEL_TEXT: f64 = 14.0;
pub(super) const TITLE_TEXT: f64 = 15.0;

/// A range of values along one direction of a panel.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Axis {
    min: f64,
    max: f64,
    log: bool,
    ticks: Vec<f64>,
    /// Power of ten taken out of the labels.
    exponent: i32,
    /// Digits after the point of the labels.
    decimals: usize,
}

impl Axis {
    /// `min..max` with about `count` round ticks; the range stays as it is.
    pub fn linear(min: f64, max: f64, count: usize) -> Axis {
        let (min, max) = if max > min {
            (min, max)
        } else {
            (min - 0.5 * (1.0 + min.abs()), max + 0.5 * (1.0 + max.abs()))
        };
        let step = nice_step((max - min) / count as f64);
        let first = (min / step - 1e-9).ceil() as i64;
        let last = (max / step + 1e-9).floor() as i64;
        let ticks = (first..=last).map(|i| i as f64 * step).collect();
        let largest = min.abs().max(max.abs());
        let exponent = engineering(largest);
        let digits = (step / 10f64.powi(exponent)).log10();
        Axis {
            min,
            max,
            log: false,
            ticks,
            exponent,
            decimals: (-(digits + 1e-9).floor()).max(0.0) as usize,
        }
    }

    /// Decades around `min..max` (both positive), thinned to about `count` labels.
    pub fn log(min: f64, max: f64, count: usize) -> Axis {
        let low = (min.log10() + 1e-9).floor() as i32;
        let high = ((max.log10() - 1e-9).ceil() as i32).max(low + 1);
        Self::log_range(10f64.powi(low), 10f64.powi(high), count)
    }

    /// Exactly `min..max` (both positive) with the decades inside as ticks; where fewer than three
    /// lie inside, also their doubles and fives.
    pub fn log_range(min: f64, max: f64, count: usize) -> Axis {
        let low = (min.log10() - 1e-9).ceil() as i32;
        let high = (max.log10() + 1e-9).floor() as i32;
        let every = ((high - low).max(0) as usize / count.max(1) + 1) as i32;
        let mut ticks: Vec<f64> = (low..=high)
            .filter(|e| (high - e) % every == 0)
            .map(|e| 10f64.powi(e))
            .collect();
        if ticks.len() < 3 {
            ticks = (low - 1..=high)
                .flat_map(|e| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(e)))
                .filter(|t| *t >= 0.999 * min && *t <= 1.001 * max)
                .collect();
        }
        Axis {
            min,
            max,
            log: true,
            ticks,
            exponent: 0,
            decimals: 0,
        }
    }

    /// Exactly `min..max` (both positive) on a logarithmic scale with the given ticks.
    pub fn log_at(min: f64, max: f64, ticks: Vec<f64>) -> Axis {
        Axis {
            ticks,
            ..Self::log_range(min, max, 1)
        }
    }

    /// Where `value` lies, 0 at the lower end and 1 at the upper; clamped.
    pub fn share(&self, value: f64) -> f64 {
        let share = if self.log {
            (value.max(self.min).ln() - self.min.ln()) / (self.max.ln() - self.min.ln())
        } else {
            (value - self.min) / (self.max - self.min)
        };
        share.clamp(0.0, 1.0)
    }

    /// Lower and upper end.
    pub fn range(&self) -> (f64, f64) {
        (self.min, self.max)
    }

    pub fn ticks(&self) -> &[f64] {
        &self.ticks
    }

    /// The label of a tick, without the power of ten that the axis's title carries.
    pub fn tick_label(&self, value: f64) -> String {
        if self.log {
            let decade = |t: &f64| (t.log10() - t.log10().round()).abs() < 1e-6;
            let decades = self.ticks.iter().all(decade);
            // Between doubles and fives a power of ten is a number like them.
            if !decades && (1e-3..1e4).contains(&value) {
                return crate::format::short(value);
            }
            return log_label(value);
        }
        let scaled = value / 10f64.powi(self.exponent);
        let text = format!("{scaled:.*}", self.decimals);
        // No minus before a zero, and a true minus sign before the rest.
        let text = if text.trim_matches(['-', '0', '.']).is_empty() {
            text.trim_start_matches('-').to_owned()
        } else {
            text
        };
        text.replace('-', "−")
    }

    /// `name (unit)` with the power of ten that the labels leave out.
    pub fn title(&self, name: &str, unit: &str) -> String {
        let factor = match self.exponent {
            0 => String::new(),
            e => format!("10{}", superscript(e)),
        };
        match (unit, factor.as_str()) {
            ("" | "1", "") => name.to_owned(),
            ("" | "1", _) => format!("{name} ({factor})"),
            (_, "") => format!("{name} ({unit})"),
            _ => format!("{name} ({factor} {unit})"),
        }
    }
}

fn log_label(value: f64) -> String {
    let exponent = value.log10();
    if (exponent - exponent.round()).abs() > 1e-6 {
        return crate::format::short(value);
    }
    match exponent.round() as i32 {
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        e => format!("10{}", superscript(e)),
    }
}

/// 1, 2 or 5 times a power of ten, the nearest to `raw`.
fn nice_step(raw: f64) -> f64 {
    let power = 10f64.powf(raw.log10().floor());
    let lead = match raw / power {
        r if r < 1.5 => 1.0,
        r if r < 3.5 => 2.0,
        r if r < 7.5 => 5.0,
        _ => 10.0,
    };
    lead * power
}

/// The multiple of three that keeps labels of up to `largest` short; 0 where none is needed.
fn engineering(largest: f64) -> i32 {
    if largest == 0.0 || (0.05..1e4).contains(&largest) {
        return 0;
    }
    3 * (largest.log10() / 3.0).floor() as i32
}

fn superscript(exponent: i32) -> String {
    const DIGITS: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    exponent
        .to_string()
        .chars()
        .map(|c| c.to_digit(10).map_or('⁻', |d| DIGITS[d as usize]))
        .collect()
}

/// A panel: a rectangle of the drawing (logical pixels) with an axis along each direction.
#[derive(Clone, Debug)]
pub(super) struct Panel {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    pub x: Axis,
    pub y: Axis,
}

impl Panel {
    /// Where the values (x, y) lie on the drawing; clamped to the panel.
    pub fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + self.width * self.x.share(x),
            self.top + self.height * (1.0 - self.y.share(y)),
        )
    }

    pub fn right(&self) -> f64 {
        self.left + self.width
    }

    pub fn bottom(&self) -> f64 {
        self.top + self.height
    }

    /// Grid lines; to be drawn before the data.
    pub fn grid(&self, drawing: &mut Drawing) {
        let stroke = Stroke::solid(palette::GRID, 0.75);
        for tick in self.x.ticks() {
            let (x, _) = self.at(*tick, 0.0);
            drawing.line((x, self.top), (x, self.bottom()), stroke);
        }
        for tick in self.y.ticks() {
            let y = self.top + self.height * (1.0 - self.y.share(*tick));
            drawing.line((self.left, y), (self.right(), y), stroke);
        }
    }

    /// Frame and ticks; to be drawn after the data. Labels only where asked for.
    pub fn frame(&self, drawing: &mut Drawing, x_labels: bool, y_labels: bool) {
        let stroke = Stroke::solid(palette::INK, 0.75);
        let corners = [
            (self.left, self.top),
            (self.right(), self.top),
            (self.right(), self.bottom()),
            (self.left, self.bottom()),
            (self.left, self.top),
        ];
        drawing.add(Mark::Path(corners.to_vec(), stroke));
        for tick in self.x.ticks() {
            let (x, _) = self.at(*tick, 0.0);
            drawing.line((x, self.bottom()), (x, self.bottom() + 3.5), stroke);
            if x_labels {
                let at = (x, self.bottom() + 12.0);
                drawing.text(&self.x.tick_label(*tick), at, TICK_TEXT, Align::Middle);
            }
        }
        for tick in self.y.ticks() {
            let y = self.top + self.height * (1.0 - self.y.share(*tick));
            drawing.line((self.left - 3.5, y), (self.left, y), stroke);
            if y_labels {
                let at = (self.left - 6.0, y);
                drawing.text(&self.y.tick_label(*tick), at, TICK_TEXT, Align::End);
            }
        }
    }

    /// The title above the panel, at its left.
    pub fn headline(&self, drawing: &mut Drawing, text: &str) {
        let at = (self.left, self.top - 11.0);
        drawing.text(text, at, TITLE_TEXT, Align::Start);
    }

    /// The name of the horizontal axis below its labels.
    pub fn x_title(&self, drawing: &mut Drawing, text: &str) {
        let at = (self.left + 0.5 * self.width, self.bottom() + 30.0);
        drawing.text(text, at, LABEL_TEXT, Align::Middle);
    }

    /// The name of the vertical axis, `distance` left of the panel.
    pub fn y_title(&self, drawing: &mut Drawing, text: &str, distance: f64) {
        let at = (self.left - distance, self.top + 0.5 * self.height);
        drawing.text_upward(text, at, LABEL_TEXT);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(axis: &Axis) -> Vec<String> {
        axis.ticks().iter().map(|t| axis.tick_label(*t)).collect()
    }

    #[test]
    fn linear_ticks_are_round_and_inside() {
        let axis = Axis::linear(0.0, 5.0, 5);
        assert_eq!(labels(&axis), ["0", "1", "2", "3", "4", "5"]);
        let axis = Axis::linear(-1.04, 1.04, 4);
        assert_eq!(labels(&axis), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(axis.title("velocity", "m/s"), "velocity (m/s)");
    }

    #[test]
    fn small_values_leave_their_power_to_the_title() {
        let axis = Axis::linear(-2e-7, 4e-7, 3);
        assert_eq!(labels(&axis), ["−200", "0", "200", "400"]);
        assert_eq!(axis.title("u", "m"), "u (10⁻⁹ m)");
    }

    #[test]
    fn log_ticks_are_decades() {
        let axis = Axis::log(3e-5, 0.7, 10);
        assert_eq!(labels(&axis), ["10⁻⁵", "10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "1"]);
        assert!((axis.share(1e-3) - 0.4).abs() < 1e-12);
        assert_eq!(axis.share(0.0), 0.0);
        let narrow = Axis::log_range(0.45, 4.4, 5);
        assert_eq!(labels(&narrow), ["0.5", "1", "2"]);
    }

    #[test]
    fn a_constant_still_has_a_range() {
        let (min, max) = Axis::linear(3.0, 3.0, 4).range();
        assert!(min < 3.0 && max > 3.0);
    }
}
