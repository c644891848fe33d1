//! Series of all methods over the reference, one panel a receiver.

use super::panels::{Content, Line, Panels, Vertical};
use super::{Drawing, PlotError};

/// One receiver.
#[derive(Clone, Debug, PartialEq)]
pub struct TracePanel {
    /// Title, for example `A (height 50 m)`.
    pub title: String,
    /// The reference, drawn thick and grey under the methods.
    pub reference: Option<Line>,
    /// One line a method; abscissae are times (s).
    pub lines: Vec<Line>,
}

/// Series against time.
#[derive(Clone, Debug, PartialEq)]
pub struct TracePlot {
    /// What is drawn, for example `velocity`.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// One panel a receiver.
    pub panels: Vec<TracePanel>,
}

impl TracePlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        let content = |panel: &TracePanel| Content {
            title: panel.title.clone(),
            reference: panel.reference.clone(),
            lines: panel.lines.clone(),
            marks: Vec::new(),
        };
        Panels {
            picture: "traces",
            panels: self.panels.iter().map(content).collect(),
            x_name: ("time", "s"),
            y_name: (&self.quantity, &self.unit),
            vertical: Vertical::Linear,
        }
        .draw()
    }
}
