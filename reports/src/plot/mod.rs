//! Pictures: plain data in, an SVG string or PNG bytes out.
//!
//! | file | picture |
//! |---|---|
//! | [`traces`] | series of all methods over the reference |
//! | [`echo`] | echo against time, on a log axis |
//! | [`energy`] | energy in the target against time, on a log axis |
//! | [`bars`] | echo of each method with its cost beside it |
//! | [`space_time`] | a field over place and time, methods side by side |
//! | [`snapshots`] | fields on a lattice, methods by times |
//! | [`animation`] | the same as an animated GIF, one frame a time |
//! | [`map`] | outcomes of methods at extremes |
//! | [`points`] | numbers of methods over a parameter or their cost |
//! | [`curves`] | methods over any abscissa, log-log or half, closed forms dashed |
//! | [`convergence`] | error against cell size, log-log |
//!
//! Each has a `draw` that gives a [`Drawing`]: a list of marks, written by [`Drawing::to_svg`] and
//! [`Drawing::to_png`]. Shared parts: [`drawing`] (marks), `writer` (files), `axis`, `panels` (line
//! panels), `heat` (coloured fields), [`palette`].

pub mod animation;
pub mod bars;
pub mod convergence;
pub mod curves;
pub mod drawing;
pub mod echo;
pub mod energy;
pub mod map;
pub mod palette;
pub mod points;
pub mod snapshots;
pub mod space_time;
pub mod traces;
pub mod way;

mod axis;
mod heat;
mod panels;
mod writer;

pub use bars::{BarPlot, Bars};
pub use convergence::{ConvergencePlot, ConvergenceSeries};
pub use curves::{CurvePanel, CurvePlot};
pub use drawing::Drawing;
pub use echo::EchoPlot;
pub use energy::EnergyPlot;
pub use map::stability_map;
pub use panels::Line;
pub use points::{PointPanel, PointPlot, PointSeries, Style};
pub use snapshots::{Corners, Field, SnapshotPlot};
pub use space_time::{Guide, SpaceTimePlot};
pub use traces::{TracePanel, TracePlot};
pub use way::WayPlot;

use thiserror::Error;

/// Why a picture cannot be drawn.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum PlotError {
    /// There is nothing to draw.
    #[error("{picture}: there is nothing to draw: {reason}")]
    Empty {
        /// Which picture.
        picture: &'static str,
        /// What is missing.
        reason: String,
    },
    /// The data do not fit together.
    #[error("{picture}: {what} has {found} values where {expected} are needed")]
    Shape {
        /// Which picture.
        picture: &'static str,
        /// Which data.
        what: String,
        /// Needed number.
        expected: usize,
        /// Found number.
        found: usize,
    },
    /// A value is NaN or infinite.
    #[error("{picture}: {what} is not finite; leave a failed run out of the picture and say so")]
    NonFinite {
        /// Which picture.
        picture: &'static str,
        /// Which data.
        what: String,
    },
    /// The drawing library or the PNG encoder failed.
    #[error("the picture cannot be written: {0}")]
    Backend(String),
}

/// Refuses data that do not fit together or are not finite.
fn check(
    picture: &'static str,
    what: &str,
    values: &[f64],
    expected: usize,
) -> Result<(), PlotError> {
    if values.len() != expected {
        return Err(PlotError::Shape {
            picture,
            what: what.to_owned(),
            expected,
            found: values.len(),
        });
    }
    if values.iter().any(|v| !v.is_finite()) {
        return Err(PlotError::NonFinite {
            picture,
            what: what.to_owned(),
        });
    }
    Ok(())
}

fn empty(picture: &'static str, reason: &str) -> PlotError {
    PlotError::Empty {
        picture,
        reason: reason.to_owned(),
    }
}
