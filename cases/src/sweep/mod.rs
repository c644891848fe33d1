//! Sweeps: one scene at several points of its parameters, each with several methods.
//!
//! - [`axis`]: `--over FIELD=VALUES`: one field, or several that advance together; several axes are
//!   crossed.
//! - [`named`]: sweeps that belong to a scene, such as the appendix of a paper.

pub mod axis;
pub mod named;

use crate::runner::Run;
use axis::Axis;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Assignments that make a point of a sweep out of a scene, with the point's name and number.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Name in rows.
    pub label: String,
    /// What it is drawn over; `None` where the point is no number.
    pub value: Option<f64>,
    /// Assignments `field=value`.
    pub sets: Vec<String>,
}

/// All combinations of the axes' entries, the last axis fastest.
pub fn crossed(axes: &[Axis]) -> Vec<Setting> {
    let mut settings = vec![Setting {
        label: String::new(),
        value: None,
        sets: Vec::new(),
    }];
    for axis in axes {
        let mut next = Vec::new();
        for setting in &settings {
            next.extend(axis.settings().into_iter().map(|own| {
                let mut label = setting.label.clone();
                if !label.is_empty() {
                    label.push(',');
                }
                label += &own.label;
                Setting {
                    label,
                    value: own.value,
                    sets: [setting.sets.clone(), own.sets].concat(),
                }
            }));
        }
        settings = next;
    }
    if let [_, _, ..] = axes {
        // Of a product no single number tells.
        for setting in &mut settings {
            setting.value = None;
        }
    }
    settings
}

/// Which runs are at which points; stored with the study.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Name of the sweep, for example `appendix-a`; that of its command where it has none.
    pub name: String,
    /// Its parts; each has a picture of its own.
    pub parts: Vec<Part>,
}

/// Points along one axis, or of one product of axes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Name in rows of the part as a whole.
    pub name: String,
    /// What is varied, for people.
    pub title: String,
    /// What the points' numbers are, with their unit.
    pub axis: String,
    /// The points.
    pub points: Vec<Point>,
}

/// A point with its runs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Name in rows: a number there stands at `PLACE@LABEL`.
    pub label: String,
    /// What it is drawn over.
    pub value: Option<f64>,
    /// Folders of the methods' runs below that of the study.
    pub runs: Vec<PathBuf>,
    /// Methods that the program refuses there, and why.
    #[serde(default)]
    pub refused: Vec<(String, String)>,
    /// Folders of the runs that these are set beside: the standard ones, over which echoes are taken.
    pub standards: Vec<PathBuf>,
}

impl Grid {
    /// All points that a run belongs to.
    pub fn points_of<'a>(&'a self, folder: &'a PathBuf) -> impl Iterator<Item = &'a Point> {
        let points = self.parts.iter().flat_map(|part| &part.points);
        points.filter(move |point| point.runs.contains(folder) || point.standards.contains(folder))
    }
}

impl Point {
    /// The runs of the methods, and those with the standard runs that go with them.
    pub fn pick<'a>(&self, runs: &'a [Run]) -> (Vec<&'a Run>, Vec<&'a Run>) {
        let of = |folders: &[PathBuf]| -> Vec<&'a Run> {
            let find = |folder: &PathBuf| runs.iter().find(|run| run.manifest.folder() == *folder);
            folders.iter().filter_map(find).collect()
        };
        let own = of(&self.runs);
        let mut all = own.clone();
        for standard in of(&self.standards) {
            if !all.iter().any(|run| std::ptr::eq(*run, standard)) {
                all.push(standard);
            }
        }
        (own, all)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_crossed_and_the_last_is_fastest() {
        let axes = ["grid.h_m=20,10", "pml.thickness_m=100..300:100"];
        let axes: Vec<Axis> = axes.iter().map(|text| Axis::parse(text).unwrap()).collect();
        let settings = crossed(&axes);
        assert_eq!(settings.len(), 6);
        assert_eq!(settings[1].label, "grid.h_m=20,pml.thickness_m=200");
        assert_eq!(settings[1].sets, ["grid.h_m=20", "pml.thickness_m=200"]);
        assert_eq!(settings[1].value, None);
        assert_eq!(crossed(&axes[..1])[1].value, Some(10.0));
    }
}
