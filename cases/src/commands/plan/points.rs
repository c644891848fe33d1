//! Points of a sweep: which runs they need, each once.

use super::{Plan, refuse_unused};
use crate::certified::key;
use crate::commands::Options;
use crate::error::{CaseError, Origin};
use crate::filter::Filter;
use crate::judge::CERTIFIER;
use crate::prepare::{Prepared, Request, Target};
use crate::resume::folder;
use crate::study::Kind;
use crate::sweep::axis::Axis;
use crate::sweep::{Grid, Part, Point, Setting, crossed, named};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// What becomes of `sweep`.
pub(super) fn sweep(options: &Options, over: &[String]) -> Result<Plan, CaseError> {
    let mut points = Points::default();
    let (name, parts) = match named::find(&options.request.target)? {
        Some(chosen) => {
            if let Some(first) = over.first() {
                return Err(CaseError::Usage(format!(
                    "--over {first}: {} says itself what is varied; sweep {} --over ... varies what you like",
                    chosen.sweep.name, chosen.info.name
                )));
            }
            let presets = chosen.sweep.presets.iter().map(|p| (*p).to_owned());
            let request = Request {
                target: chosen.info.name.to_owned(),
                presets: presets.chain(options.request.presets.clone()).collect(),
                ..options.request.clone()
            };
            let profile = Target::find(&request)?.profile.name;
            let usual = (chosen.sweep.methods)(profile);
            let mut parts = Vec::new();
            for part in chosen.parts {
                let about = Part {
                    name: part.name.to_owned(),
                    title: part.title.to_owned(),
                    axis: part.axis.to_owned(),
                    points: Vec::new(),
                };
                let methods = methods(options, usual);
                parts.push(points.part(about, &request, &methods, part.settings()?)?);
            }
            (chosen.sweep.name.to_owned(), parts)
        }
        None => {
            let axes = over.iter().map(|text| Axis::parse(text));
            let axes: Vec<Axis> = axes.collect::<Result<_, _>>()?;
            if axes.is_empty() {
                return Err(CaseError::Usage(
                    "sweep needs --over FIELD=VALUES, or the name of a sweep, such as appendix-a"
                        .into(),
                ));
            }
            let title: Vec<String> = axes.iter().map(Axis::name).collect();
            let about = Part {
                name: title.join(" x "),
                title: format!("over {}", title.join(" x ")),
                axis: title.join(" x "),
                points: Vec::new(),
            };
            let target = Target::find(&options.request)?;
            let wanted = wanted(&axes, &target);
            let wanted: Vec<&str> = wanted.iter().map(String::as_str).collect();
            let methods = methods(options, &wanted);
            let part = points.part(about, &options.request, &methods, crossed(&axes))?;
            points.refuse_unused()?;
            ("sweep".to_owned(), vec![part])
        }
    };
    points.plan(Kind::Sweep(Grid { name, parts }), options)
}

/// The methods that are named, or the usual ones.
fn methods(options: &Options, usual: &[&str]) -> Vec<String> {
    if options.methods.is_empty() {
        usual.iter().map(|name| (*name).to_owned()).collect()
    } else {
        options.methods.clone()
    }
}

/// Methods whose parameters an ad hoc sweep varies; all that apply where it varies the scene.
fn wanted(axes: &[Axis], target: &Target) -> Vec<String> {
    let fields: Vec<&str> = axes.iter().flat_map(Axis::fields).collect();
    let usual = target.info.methods.iter().filter(|m| !m.on_request);
    let usual: Vec<String> = usual.map(|m| m.name.to_owned()).collect();
    let varied = |name: &String| {
        let of_method = format!("{name}.");
        fields.iter().any(|field| field.starts_with(&of_method))
    };
    let of_methods: Vec<String> = usual.iter().filter(|name| varied(name)).cloned().collect();
    if of_methods.is_empty() {
        usual
    } else {
        of_methods
    }
}

/// Runs that points share.
#[derive(Debug, Default)]
pub(super) struct Points {
    scenes: Vec<Prepared>,
    left_out: Vec<(String, String)>,
    /// Are standard runs left out?
    alone: bool,
    /// Assignments that some run takes, and those that some does not.
    used: BTreeSet<String>,
    unused: BTreeSet<String>,
}

impl Points {
    /// Of a study that asks for no echoes, and so for no standard runs.
    pub(super) fn alone() -> Self {
        Points {
            alone: true,
            ..Points::default()
        }
    }

    /// The plan of all points that were added.
    pub(super) fn plan(self, kind: Kind, options: &Options) -> Result<Plan, CaseError> {
        if self.scenes.is_empty() {
            let why = self.left_out.first().map_or("", |(_, why)| why.as_str());
            return Err(CaseError::Usage(format!("nothing is left to solve: {why}")));
        }
        Ok(Plan {
            kind,
            scenes: self.scenes,
            filter: options.filter.clone().map(Filter),
            left_out: self.left_out,
        })
    }

    /// An assignment that no run takes is a mistake.
    fn refuse_unused(&self) -> Result<(), CaseError> {
        let first = self.unused.difference(&self.used).next();
        match first.filter(|_| !self.scenes.is_empty()) {
            Some(set) => refuse_unused(&[format!("--over {set}")]),
            None => Ok(()),
        }
    }

    /// A part with its points' runs.
    pub(super) fn part(
        &mut self,
        about: Part,
        request: &Request,
        methods: &[String],
        settings: Vec<Setting>,
    ) -> Result<Part, CaseError> {
        let mut part = about;
        for setting in &settings {
            let mut point = Point {
                label: setting.label.clone(),
                value: setting.value,
                ..Point::default()
            };
            for method in methods {
                self.member(&mut point, request, method, setting)?;
            }
            part.points.push(point);
        }
        Ok(part)
    }

    /// Adds a method's run to a point, and what it is set beside.
    fn member(
        &mut self,
        point: &mut Point,
        request: &Request,
        method: &str,
        setting: &Setting,
    ) -> Result<(), CaseError> {
        let mut own = request.clone();
        own.sets.extend(setting.sets.iter().cloned());
        let target = Target::find(&own)?;
        let scene = match target.prepare(Some(method)) {
            Ok(scene) => scene,
            Err(error) => {
                let name = format!("{method}, {}", setting.label);
                let why = self.leave_out(&name, error)?;
                point.refused.push((method.to_owned(), why));
                return Ok(());
            }
        };
        for set in &setting.sets {
            if scene.unused.contains(&Origin::Set(set.clone()).to_string()) {
                self.unused.insert(set.clone());
            } else {
                self.used.insert(set.clone());
            }
        }
        let beside = match self.alone {
            true => [None, None],
            false => [
                standard(&target, &scene),
                judge_of(&scene, request, setting)?,
            ],
        };
        point.runs.push(self.add(scene));
        for other in beside.into_iter().flatten() {
            let other = self.add(other);
            if !point.standards.contains(&other) {
                point.standards.push(other);
            }
        }
        Ok(())
    }

    /// Leaves a run out whose sides are refused; the error of any other fault.
    pub(super) fn leave_out(&mut self, name: &str, error: CaseError) -> Result<String, CaseError> {
        let why = match (&error, self.alone) {
            // At an extreme every refusal is an answer.
            (CaseError::Scene(complaints), true) => complaints
                .first()
                .map_or(String::new(), ToString::to_string),
            _ => refused(&error).ok_or(error)?,
        };
        self.left_out.push((name.to_owned(), why.clone()));
        Ok(why)
    }

    /// Takes a scene in unless it is there; its folder.
    fn add(&mut self, scene: Prepared) -> PathBuf {
        let own = folder(&scene);
        if !self.scenes.iter().any(|other| folder(other) == own) {
            self.scenes.push(scene);
        }
        own
    }
}

/// Why a method or its parameters do not apply at a point: all that is wrong is about its sides.
fn refused(error: &CaseError) -> Option<String> {
    let CaseError::Scene(complaints) = error else {
        return None;
    };
    let of_method = complaints.iter().all(|c| c.field.starts_with("boundary."));
    let first = complaints.first().filter(|_| of_method)?;
    Some(first.message.clone())
}

/// The extended run of a point, where the scene's own norms need it. What the point varies of extended
/// sides is the business of the run that is judged, not of its judge.
fn judge_of(
    scene: &Prepared,
    request: &Request,
    setting: &Setting,
) -> Result<Option<Prepared>, CaseError> {
    if !scene.scene.needs_extended() {
        return Ok(None);
    }
    let mut request = request.clone();
    let own = format!("{CERTIFIER}.");
    let others = setting.sets.iter().filter(|set| !set.starts_with(&own));
    request.sets.extend(others.cloned());
    Ok(Target::find(&request)?.prepare(Some(CERTIFIER)).ok())
}

/// The standard run of the same discretisation: of the standard method, or of a variant of it.
fn standard(target: &Target, scene: &Prepared) -> Option<Prepared> {
    let hash = |scene: &Prepared| {
        let problem = scene.scene.extended()?;
        Some(key::hash_of(&problem))
    };
    let of_variants = format!("{}/", target.info.standard);
    let variants = target.info.ablation.iter().map(|variant| variant.name);
    let names = std::iter::once(target.info.standard)
        .chain(variants.filter(|name| name.starts_with(&of_variants)));
    names
        .filter_map(|name| target.prepare(Some(name)).ok())
        .find(|standard| hash(standard) == hash(scene))
}
