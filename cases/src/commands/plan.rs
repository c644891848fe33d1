//! Which scenes a command solves.

mod extremes;
mod ladders;
mod levels;
mod points;

use super::Options;
use crate::error::{CaseError, Complaint};
use crate::filter::Filter;
use crate::judge::CERTIFIER;
use crate::over::Over;
use crate::prepare::{Prepared, Target};
use crate::scene::SceneInfo;
use crate::scenes::SCENES;
use crate::study::Kind;
use anechoic_reference::claim::Evidence;
use anechoic_reports::norms::{group_of, group_worst};

/// Scenes ready to run.
#[derive(Debug)]
pub struct Plan {
    /// What they are solved for.
    pub kind: Kind,
    /// The scenes, in the order of the comparison.
    pub scenes: Vec<Prepared>,
    /// Which rows are asked for.
    pub filter: Option<Filter>,
    /// Methods that do not apply to the scene as it stands, and why.
    pub left_out: Vec<(String, String)>,
}

impl Plan {
    /// One scene.
    pub(super) fn run(options: &Options) -> Result<Self, CaseError> {
        let method = match options.methods.as_slice() {
            [] => None,
            [one] => Some(one.as_str()),
            _ => {
                return Err(CaseError::Usage(
                    "run takes one --method; compare takes several".into(),
                ));
            }
        };
        let scene = Target::find(&options.request)?.prepare(method)?;
        refuse_unused(&scene.unused)?;
        let filter = options.filter.clone().map(Filter);
        if let Some(filter) = &filter {
            filter.methods(&[&scene.method], &places(&scene))?;
        }
        Ok(Plan {
            kind: Kind::Comparison,
            scenes: vec![scene],
            filter,
            left_out: Vec::new(),
        })
    }

    /// All methods that apply or are named, and what the file describes.
    pub(super) fn compare(options: &Options) -> Result<Self, CaseError> {
        let target = Target::find(&options.request)?;
        let mut names: Vec<&str> = match options.methods.as_slice() {
            [] => {
                let usual = target.info.methods.iter().filter(|m| !m.on_request);
                usual.map(|m| m.name).collect()
            }
            some => some.iter().map(String::as_str).collect(),
        };
        let mut described = if target.names_sides() {
            Some(target.prepare(None)?)
        } else {
            None
        };
        let described_name = described.as_ref().map(|scene| scene.method.clone());
        if let Some(name) = described_name.as_deref()
            && options.methods.is_empty()
            && !names.contains(&name)
        {
            names.push(name);
        }
        let filter = options.filter.clone().map(Filter);
        if let Some(filter) = &filter {
            let any = target.prepare(None)?;
            let chosen = filter.methods(&names, &places(&any))?;
            // Ratios need the standard run. Certified claims need the extended one, unless the scene
            // has a reference that is stored.
            let certified = any.scene.extended().is_none()
                && any.scene.claims().iter().any(|claim| {
                    claim.claim.evidence == Evidence::Certified
                        && chosen.contains(&claim.claim.method.as_str())
                });
            names.retain(|name| {
                chosen.contains(name)
                    || *name == target.info.standard
                    || (certified && *name == CERTIFIER)
            });
        }
        if options.sampling.animation {
            // It shows the method between the standard run and the one without echo.
            for name in [target.info.standard, CERTIFIER] {
                if target.info.method(name).is_some() && !names.contains(&name) {
                    names.push(name);
                }
            }
        }
        let (mut scenes, mut left_out) = (Vec::new(), Vec::new());
        for name in names {
            let file_says = described_name.as_deref() == Some(name);
            if let Some(scene) = described.take_if(|_| file_says) {
                scenes.push(scene);
                continue;
            }
            match (target.prepare(Some(name)), refusal(options)) {
                (Ok(scene), _) => scenes.push(scene),
                (Err(CaseError::Scene(complaints)), Some(is_refusal))
                    if complaints.iter().all(is_refusal) =>
                {
                    let why = complaints.first().map_or("", |c| c.message.as_str());
                    left_out.push((name.to_owned(), why.to_owned()));
                }
                (Err(error), _) => return Err(error),
            }
        }
        // A file that writes out a method's own sides adds no run of its own.
        if let Some(name) = described_name
            .as_deref()
            .filter(|_| options.methods.is_empty())
            && let Some(at) = scenes.iter().position(|scene| scene.method == name)
            && let Some(same) = scenes.iter().enumerate().find_map(|(i, other)| {
                (i != at && other.hash() == scenes[at].hash()).then(|| other.method.clone())
            })
        {
            scenes.remove(at);
            left_out.push((
                name.to_owned(),
                format!("the file's sides are those of `{same}`"),
            ));
        }
        refuse_unused(&unused_everywhere(&scenes))?;
        Ok(Plan {
            kind: Kind::Comparison,
            scenes,
            filter,
            left_out,
        })
    }

    /// The published parts of a method, one by one, with the standard runs that they need.
    pub(super) fn ablation(options: &Options) -> Result<Self, CaseError> {
        let target = Target::find(&options.request)?;
        let variants = target.info.ablation;
        if variants.is_empty() {
            return Err(CaseError::Usage(format!(
                "{} has no method that is taken apart; cases that have: {}",
                target.info.name,
                names_of(SCENES.iter().filter(|scene| !scene.ablation.is_empty()))
            )));
        }
        let mut names: Vec<&str> = variants.iter().map(|variant| variant.name).collect();
        let filter = options.filter.clone().map(Filter);
        if let Some(filter) = &filter {
            let chosen = filter.methods(&names, &places(&target.prepare(None)?))?;
            let standard = format!("{}/", target.info.standard);
            names.retain(|name| chosen.contains(name) || name.starts_with(&standard));
        }
        let scenes = names
            .into_iter()
            .map(|name| target.prepare(Some(name)))
            .collect::<Result<Vec<_>, _>>()?;
        refuse_unused(&unused_everywhere(&scenes))?;
        Ok(Plan {
            kind: Kind::Ablation,
            scenes,
            filter,
            left_out: Vec::new(),
        })
    }

    /// One scene on all levels of refinements, coarse to fine, and the runs of its budget.
    pub(super) fn converge(
        options: &Options,
        over: &[Over],
        budget: bool,
    ) -> Result<Self, CaseError> {
        levels::converge(options, over, budget)
    }

    /// One scene at the points of a sweep, with several methods.
    pub(super) fn sweep(options: &Options, over: &[String]) -> Result<Self, CaseError> {
        points::sweep(options, over)
    }

    /// One scene with each method on its ladder.
    pub(super) fn tradeoff(options: &Options) -> Result<Self, CaseError> {
        ladders::tradeoff(options)
    }

    /// One scene with all methods at extremes.
    pub(super) fn stability(options: &Options) -> Result<Self, CaseError> {
        extremes::stability(options)
    }

    /// Folder of the study in a results folder.
    pub fn folder(&self) -> String {
        let first = self.scenes.first();
        self.kind.folder(first.map_or("", |scene| scene.info.name))
    }
}

/// What tells that a method does not apply to a scene, where methods were not named one by one.
fn refusal(options: &Options) -> Option<fn(&Complaint) -> bool> {
    let of_method = |complaint: &Complaint| {
        complaint.field.starts_with("boundary.") && complaint.field.ends_with(".method")
    };
    options.methods.is_empty().then_some(of_method)
}

fn names_of<'a>(scenes: impl Iterator<Item = &'a &'static SceneInfo>) -> String {
    let names: Vec<&str> = scenes.map(|scene| scene.name).collect();
    names.join(", ")
}

/// Assignments that reached no side in any scene.
fn unused_everywhere(scenes: &[Prepared]) -> Vec<String> {
    let Some((first, others)) = scenes.split_first() else {
        return Vec::new();
    };
    first
        .unused
        .iter()
        .filter(|set| others.iter().all(|scene| scene.unused.contains(set)))
        .cloned()
        .collect()
}

/// An assignment to a method that no side uses is a mistake.
pub(super) fn refuse_unused(unused: &[String]) -> Result<(), CaseError> {
    match unused.first() {
        Some(set) => Err(CaseError::Usage(format!(
            "{set}: no side uses that method here; choose it with --method"
        ))),
        None => Ok(()),
    }
}

/// Places that rows of the scene may have.
fn places(scene: &Prepared) -> Vec<String> {
    let mut places = vec!["run".to_owned(), "target".to_owned()];
    for window in scene.scene.windows() {
        let group = group_of(&window.receiver);
        places.extend([group.to_owned(), group_worst(group), window.place()]);
    }
    places
}
