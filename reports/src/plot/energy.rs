//! Energy in the target against time on a log axis.

use super::panels::{Content, Line, Panels, Vertical};
use super::{Drawing, PlotError};

/// Kinetic plus strain energy of the target against time.
#[derive(Clone, Debug, PartialEq)]
pub struct EnergyPlot {
    /// Unit, `J/m` in plane strain.
    pub unit: String,
    /// The reference, drawn thick and grey under the methods.
    pub reference: Option<Line>,
    /// One line a method; abscissae are times (s).
    pub lines: Vec<Line>,
}

impl EnergyPlot {
    /// Draws it.
    pub fn draw(&self) -> Result<Drawing, PlotError> {
        Panels {
            picture: "energy",
            panels: vec![Content {
                title: "Energy in the target".to_owned(),
                reference: self.reference.clone(),
                lines: self.lines.clone(),
                marks: Vec::new(),
            }],
            x_name: ("time", "s"),
            y_name: ("energy", &self.unit),
            vertical: Vertical::Log { floor: None },
        }
        .draw()
    }
}
