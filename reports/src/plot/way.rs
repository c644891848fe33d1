//! A number of all methods along the way of a body or over time, over what is true of it, with places on the
//! way marked.

use super::panels::{Content, Line, Panels, Vertical};
use super::{Drawing, PlotError};

/// Curves of one number.
#[derive(Clone, Debug, PartialEq)]
pub struct WayPlot {
    /// Title of the panel.
    pub title: String,
    /// Name and unit of the abscissae.
    pub x: (String, String),
    /// Name and unit of the ordinates.
    pub y: (String, String),
    /// What is true, drawn thick and grey under the methods.
    pub reference: Option<Line>,
    /// One line a method.
    pub lines: Vec<Line>,
    /// Places on the way with what happens there.
    pub marks: Vec<(f64, String)>,
}

impl WayPlot {
    /// Draws it.
    ///
    /// # Errors
    /// Lines that do not fit together or are not finite.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        Panels {
            picture: "way",
            panels: vec![Content {
                title: self.title.clone(),
                reference: self.reference.clone(),
                lines: self.lines.clone(),
                marks: self.marks.clone(),
            }],
            x_name: (&self.x.0, &self.x.1),
            y_name: (&self.y.0, &self.y.1),
            vertical: Vertical::Linear,
        }
        .draw()
    }
}
