//! A picture as a list of marks.
//!
//! Marks are in logical pixels with the origin at the top left; `writer` turns them into
//! files.

use super::palette;
use plotters::style::RGBColor;

/// Where the anchor of a text lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// The anchor is its left end.
    Start,
    /// The anchor is its middle.
    Middle,
    /// The anchor is its right end.
    End,
}

/// How a line is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Colour.
    pub colour: RGBColor,
    /// Width (logical pixels).
    pub width: f64,
    /// Dashed?
    pub dashed: bool,
}

impl Stroke {
    /// An unbroken line.
    pub const fn solid(colour: RGBColor, width: f64) -> Self {
        Stroke {
            colour,
            width,
            dashed: false,
        }
    }

    /// A dashed line.
    pub const fn dashed(colour: RGBColor, width: f64) -> Self {
        Stroke {
            colour,
            width,
            dashed: true,
        }
    }
}

/// One mark. Coordinates in logical pixels.
#[derive(Clone, Debug, PartialEq)]
pub enum Mark {
    /// A polyline.
    Path(Vec<(f64, f64)>, Stroke),
    /// A filled polygon.
    Area(Vec<(f64, f64)>, RGBColor),
    /// A filled box: corner and opposite corner.
    Fill((f64, f64), (f64, f64), RGBColor),
    /// A filled circle: centre and radius.
    Dot((f64, f64), f64, RGBColor),
    /// A text, centred vertically at its anchor.
    Text(Label),
}

/// A text.
#[derive(Clone, Debug, PartialEq)]
pub struct Label {
    /// What it says.
    pub text: String,
    /// Anchor.
    pub at: (f64, f64),
    /// Height of the letters (logical pixels).
    pub size: f64,
    /// Colour.
    pub colour: RGBColor,
    /// Horizontal place of the anchor.
    pub align: Align,
    /// Turned to read upward?
    pub upward: bool,
}

/// A picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) marks: Vec<Mark>,
}

impl Drawing {
    /// An empty sheet (logical pixels).
    pub(super) fn new(width: u32, height: u32) -> Self {
        Drawing {
            width,
            height,
            marks: Vec::new(),
        }
    }

    /// Logical width and height.
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    /// Adds a mark on top of the others.
    pub(super) fn add(&mut self, mark: Mark) {
        self.marks.push(mark);
    }

    /// Adds a straight line.
    pub(super) fn line(&mut self, from: (f64, f64), to: (f64, f64), stroke: Stroke) {
        self.add(Mark::Path(vec![from, to], stroke));
    }

    /// Adds a text in ink.
    pub(super) fn text(&mut self, text: &str, at: (f64, f64), size: f64, align: Align) {
        self.text_in(text, at, size, align, palette::INK);
    }

    /// Adds a text in a colour.
    pub(super) fn text_in(
        &mut self,
        text: &str,
        at: (f64, f64),
        size: f64,
        align: Align,
        colour: RGBColor,
    ) {
        self.add(Mark::Text(Label {
            text: text.to_owned(),
            at,
            size,
            colour,
            align,
            upward: false,
        }));
    }

    /// Adds a text that reads upward, centred at its anchor.
    pub(super) fn text_upward(&mut self, text: &str, at: (f64, f64), size: f64) {
        self.add(Mark::Text(Label {
            text: text.to_owned(),
            at,
            size,
            colour: palette::INK,
            align: Align::Middle,
            upward: true,
        }));
    }
}
