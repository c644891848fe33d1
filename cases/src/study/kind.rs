//! What studies are for, and how their runs are told apart.

use super::stored::Damage;
use crate::prepare::Prepared;
use crate::resume::folder;
use crate::runner::Run;
use crate::sweep::Grid;
use anechoic_reports::row::Row;
use serde::{Deserialize, Serialize};

/// What a study is for.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Methods side by side, ranked.
    #[default]
    Comparison,
    /// A method taken apart: what each part absorbs.
    Ablation,
    /// A scene on finer and finer levels of fields, coarse first: with which order errors fall; and what
    /// each cause contributes to them.
    Convergence(Grid),
    /// A scene at several points of its parameters, with several methods.
    Sweep(Grid),
    /// Each method over its own parameters: error against cost.
    Tradeoff(Grid),
    /// All methods at extremes: which stay stable.
    Stability(Grid),
}

impl Kind {
    /// The points of a sweep or of ladders.
    pub fn grid(&self) -> Option<&Grid> {
        match self {
            Kind::Convergence(grid)
            | Kind::Sweep(grid)
            | Kind::Tradeoff(grid)
            | Kind::Stability(grid) => Some(grid),
            _ => None,
        }
    }

    /// Are its runs compared with references?
    pub fn has_echoes(&self) -> bool {
        !matches!(self, Kind::Stability(_))
    }

    /// Is a run that fails an answer, as whole as any? At extremes it is.
    pub fn failure_is_answer(&self) -> bool {
        matches!(self, Kind::Stability(_))
    }

    /// Folder of a case's study of this kind.
    pub fn folder(&self, case: &str) -> String {
        match self {
            Kind::Comparison => case.to_owned(),
            Kind::Ablation => format!("{case}-ablation"),
            Kind::Convergence(grid)
            | Kind::Sweep(grid)
            | Kind::Tradeoff(grid)
            | Kind::Stability(grid) => format!("{case}-{}", grid.name),
        }
    }

    /// What tells a run from the others of its study, for people.
    pub fn name(&self, run: &Run) -> String {
        self.name_of(&run.manifest.method, &run.prepared)
    }

    /// The same of a scene's run.
    pub fn name_of_scene(&self, scene: &Prepared) -> String {
        self.name_of(&scene.method, scene)
    }

    /// The same of a run that cannot be read: nobody knows its level.
    pub fn name_of_damage(&self, damage: &Damage) -> String {
        match self {
            Kind::Comparison | Kind::Ablation => damage.method(),
            _ => damage.folder.display().to_string(),
        }
    }

    fn name_of(&self, method: &str, scene: &Prepared) -> String {
        if let Some(grid) = self.grid() {
            // A run at several points has the name of the first.
            let folder = folder(scene);
            let point = grid.points_of(&folder).next();
            return point.map_or(method.to_owned(), |p| format!("{method}, {}", p.label));
        }
        method.to_owned()
    }

    /// Is a row one of this run's?
    pub(super) fn owns(&self, run: &Run, row: &Row) -> bool {
        if let Some(grid) = self.grid() {
            let folder = run.manifest.folder();
            let at = |label: &str| row.place.ends_with(&format!("@{label}"));
            return row.method == run.manifest.method
                && grid.points_of(&folder).any(|point| at(&point.label));
        }
        row.method == run.manifest.method
    }
}
