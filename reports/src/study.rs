//! Everything that a report shows, as data.

use crate::convergence::Refinement;
use crate::plot::{Drawing, PlotError};
use crate::provenance::Provenance;
use crate::ranking::Ranking;
use crate::row::Row;
use crate::stability::Stability;
use crate::sweep::Sweep;
use crate::tradeoff::Tradeoff;
use anechoic_solver::record::{Cost, Status};
use serde::{Deserialize, Serialize};

/// One case with the methods that were run on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Study {
    /// Case, for example `compression-1d`.
    pub case: String,
    /// Title for people.
    pub title: String,
    /// What the scene is, in a few sentences; may be empty.
    pub summary: String,
    /// Profile: `gate`, `quick`, `paper`.
    pub profile: String,
    /// The command that made it.
    pub command: String,
    /// Claims and measurements.
    pub rows: Vec<Row>,
    /// The ranking, where methods were compared.
    pub ranking: Option<Ranking>,
    /// What its runs make together, where that is more than a ranking.
    #[serde(default)]
    pub upshot: Option<Upshot>,
    /// The runs, complete or not.
    pub runs: Vec<RunSummary>,
    /// What the case says about its source.
    pub ledger: Vec<LedgerEntry>,
    /// What is missing here and why, and what was done to series; may be empty.
    #[serde(default)]
    pub notes: Vec<String>,
    /// Pictures; drawn anew from the records, so not stored.
    #[serde(skip)]
    pub figures: Vec<Figure>,
}

/// What the runs of a study make together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Upshot {
    /// Errors on several levels, where a scene was refined.
    Convergence(Refinement),
    /// Methods at several points, where parameters were varied.
    Sweep(Sweep),
    /// Error against cost.
    Tradeoff(Tradeoff),
    /// How runs at extremes end.
    Stability(Stability),
}

/// One run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunSummary {
    /// Boundary method as in `--method`.
    pub method: String,
    /// How it ended.
    pub status: Status,
    /// What it cost; `None` where nobody knows.
    pub cost: Option<Cost>,
    /// Where it comes from.
    pub provenance: Provenance,
}

/// How a statement of the source fared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Finding {
    /// It was reproduced.
    Reproduced,
    /// This program finds something else.
    Differs,
    /// The source does not say enough.
    UnderSpecified,
}

impl Finding {
    /// Name for people.
    pub fn name(self) -> &'static str {
        match self {
            Finding::Reproduced => "reproduced",
            Finding::Differs => "differs",
            Finding::UnderSpecified => "under-specified",
        }
    }
}

/// One statement of the source and what became of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LedgerEntry {
    /// What became of it.
    pub finding: Finding,
    /// Where it stands, for example `section 3.1, Fig. 5`.
    pub place: String,
    /// The statement and the finding in words.
    pub note: String,
}

/// A picture with its words.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Title.
    pub title: String,
    /// What to see in it.
    pub caption: String,
    /// The picture itself.
    pub image: Image,
}

/// The form in which a picture enters the report.
#[derive(Clone, Debug, PartialEq)]
pub enum Image {
    /// Lines and text, inline.
    Svg(String),
    /// Raster-like fields, embedded.
    Png {
        /// The file's bytes.
        bytes: Vec<u8>,
        /// Width at which it is shown (logical pixels).
        width: u32,
    },
}

impl Figure {
    /// A picture made of lines.
    pub fn of_lines(title: &str, caption: &str, drawing: &Drawing) -> Result<Self, PlotError> {
        Ok(Figure {
            title: title.to_owned(),
            caption: caption.to_owned(),
            image: Image::Svg(drawing.to_svg()?),
        })
    }

    /// A picture made of coloured fields.
    pub fn of_field(title: &str, caption: &str, drawing: &Drawing) -> Result<Self, PlotError> {
        Ok(Figure {
            title: title.to_owned(),
            caption: caption.to_owned(),
            image: Image::Png {
                bytes: drawing.to_png()?,
                width: drawing.size().0,
            },
        })
    }
}
