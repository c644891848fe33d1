//! Echo against time on a log axis, one panel a receiver.

use super::panels::{Content, Line, Panels, Vertical};
use super::{Drawing, PlotError};

/// Distance to the reference over the standard run's peak, against time.
#[derive(Clone, Debug, PartialEq)]
pub struct EchoPlot {
    /// Receivers: title and one line a method; abscissae are times (s), ordinates as
    /// [`crate::norms::echo_series`] gives them.
    pub panels: Vec<(String, Vec<Line>)>,
    /// The floor of the reference, ruled across the panels.
    pub floor: Option<f64>,
}

impl EchoPlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        let content = |(title, lines): &(String, Vec<Line>)| Content {
            title: title.clone(),
            reference: None,
            lines: lines.clone(),
            marks: Vec::new(),
        };
        Panels {
            picture: "echo",
            panels: self.panels.iter().map(content).collect(),
            x_name: ("time", "s"),
            y_name: ("echo / peak", ""),
            vertical: Vertical::Log { floor: self.floor },
        }
        .draw()
    }
}
