//! Levels of a convergence study and the runs of an error budget: what is no refinement is refused
//! before anything is solved.

use super::{Plan, places as places_of_run, refuse_unused};
use crate::commands::Options;
use crate::error::{CaseError, Complaint, Origin};
use crate::filter::Filter;
use crate::judge::{BUDGET, CAUSES, CERTIFIER, ERRORS, budget_label};
use crate::over::{CELLS, Over, POINTS, STEP, cause, level_in};
use crate::posed::either;
use crate::prepare::{Prepared, Target};
use crate::resume::folder;
use crate::study::Kind;
use crate::sweep::{Grid, Part, Point};
use anechoic_reports::convergence::Curve;
use anechoic_solver::problem::Transfer;

/// The error in time falls by sixteen over this: what is left of it does not count.
const FINER_STEP: f64 = 0.25;

/// Most points in a cell that a scene takes.
const MOST_POINTS: usize = 100;

/// What becomes of `converge`: a part of levels for each field, and one of the budget's runs.
pub(super) fn converge(options: &Options, over: &[Over], budget: bool) -> Result<Plan, CaseError> {
    let method = match options.methods.as_slice() {
        [] => None,
        [one] => Some(one.as_str()),
        _ => {
            return Err(CaseError::Usage(
                "converge takes one --method; refine others one by one".into(),
            ));
        }
    };
    if over.is_empty() && !budget {
        return Err(CaseError::Usage(format!(
            "converge needs something to refine, for example --over {CELLS}=20,10, or --budget"
        )));
    }
    let name = if over.is_empty() { BUDGET } else { "converge" };
    let mut runs = Runs::default();
    let mut parts = Vec::new();
    for one in over {
        if parts.iter().any(|part: &Part| part.name == one.field) {
            return Err(CaseError::Refinement {
                given: one.field.clone(),
                reason: "stands there twice; give all its values at once".into(),
            });
        }
        parts.push(runs.levels(options, method, one)?);
    }
    if budget {
        parts.push(runs.budget(options, method)?);
    }
    let filter = options.filter.clone().map(Filter);
    if let (Some(filter), Some(first)) = (&filter, runs.scenes.first()) {
        filter.methods(&[&first.method], &places(&places_of_run(first), &parts))?;
    }
    let grid = Grid {
        name: name.to_owned(),
        parts,
    };
    Ok(Plan {
        kind: Kind::Convergence(grid),
        scenes: runs.scenes,
        filter,
        left_out: Vec::new(),
    })
}

/// Runs that parts share, each once.
#[derive(Debug, Default)]
struct Runs {
    scenes: Vec<Prepared>,
}

impl Runs {
    fn add(&mut self, scene: Prepared, label: String, value: Option<f64>) -> Point {
        let own = folder(&scene);
        if !self.scenes.iter().any(|other| folder(other) == own) {
            self.scenes.push(scene);
        }
        Point {
            label,
            value,
            runs: vec![own],
            ..Point::default()
        }
    }

    /// The levels of one field, coarse to fine.
    fn levels(
        &mut self,
        options: &Options,
        method: Option<&str>,
        over: &Over,
    ) -> Result<Part, CaseError> {
        let level = |assignment: &String| {
            let sets = std::slice::from_ref(assignment);
            let scene =
                prepared(options, method, sets).map_err(|error| blame(error, assignment))?;
            refuse_unused(&scene.unused)?;
            Ok(scene)
        };
        let labels = over.assignments();
        let scenes: Vec<Prepared> = labels.iter().map(level).collect::<Result<_, CaseError>>()?;
        check(&scenes, over)?;
        let points = scenes.into_iter().zip(labels).zip(&over.values);
        let points = points.map(|((scene, label), value)| self.add(scene, label, Some(*value)));
        Ok(Part {
            name: over.field.clone(),
            title: format!("over {}", over.field),
            axis: over.field.clone(),
            points: points.collect(),
        })
    }

    /// The scene as it stands, and beside it with one thing changed at a time.
    fn budget(&mut self, options: &Options, method: Option<&str>) -> Result<Part, CaseError> {
        let base = prepared(options, method, &[])?;
        refuse_unused(&base.unused)?;
        let wanted = varied(&base);
        let mut points = vec![self.add(base, budget_label("base"), None)];
        for (name, own, sets) in wanted {
            let scene = prepared(options, own.or(method), &sets)?;
            points.push(self.add(scene, budget_label(name), None));
        }
        Ok(Part {
            name: BUDGET.to_owned(),
            title: "error budget".to_owned(),
            axis: String::new(),
            points,
        })
    }
}

/// A cause with the method of its run, if that is another, and its assignments.
type Varied = (&'static str, Option<&'static str>, Vec<String>);

/// What is varied for a budget, one thing at a time; the step stays where it would follow the cells.
fn varied(base: &Prepared) -> Vec<Varied> {
    let posed = base.scene.posed();
    let dt = posed.dt();
    let mut all = vec![
        (
            cause(CELLS),
            None,
            vec![
                format!("{CELLS}={}", 0.5 * base.scene.cell_m()),
                format!("{STEP}={dt}"),
            ],
        ),
        (
            cause(STEP),
            None,
            vec![format!("{STEP}={}", FINER_STEP * dt)],
        ),
    ];
    let more = posed.with_points_more();
    if more <= MOST_POINTS {
        all.push((cause(POINTS), None, vec![format!("{POINTS}={more}")]));
    }
    if either!(&posed, problem => problem.transfer) != Transfer::Keep {
        let kept = ["points.mode=frozen", "points.transfer=keep"].map(str::to_owned);
        all.push(("transfer", None, kept.to_vec()));
    }
    // sides that nothing comes back from have no share, and a stored reference knows it of all others
    let extended = base.scene.serves_until_s().is_some() || base.scene.extended().is_some();
    if !extended && base.info.method(CERTIFIER).is_some() {
        all.push(("boundary", Some(CERTIFIER), Vec::new()));
    }
    all
}

/// The scene with some more assignments.
fn prepared(
    options: &Options,
    method: Option<&str>,
    sets: &[String],
) -> Result<Prepared, CaseError> {
    let mut request = options.request.clone();
    request.sets.extend_from_slice(sets);
    Target::find(&request)?.prepare(method)
}

/// The error with the flag that its assignment comes from.
fn blame(error: CaseError, assignment: &str) -> CaseError {
    let own = |complaint: Complaint| match &complaint.origin {
        Origin::Set(text) if text == assignment => Complaint {
            origin: Origin::Over(assignment.to_owned()),
            ..complaint
        },
        _ => complaint,
    };
    match error {
        CaseError::Scene(complaints) => CaseError::Scene(complaints.into_iter().map(own).collect()),
        other => other,
    }
}

/// Each level must be what was asked for, and cells that were asked for finer must be finer.
fn check(scenes: &[Prepared], over: &Over) -> Result<(), CaseError> {
    let wrong = |reason: String| {
        Err(CaseError::Refinement {
            given: over.field.clone(),
            reason,
        })
    };
    for (scene, value) in scenes.iter().zip(&over.values) {
        if level_in(&scene.table, &over.field) != Some(*value) {
            return wrong(format!("the scene does not take {value}"));
        }
    }
    if over.field != CELLS {
        return Ok(());
    }
    for (pair, values) in scenes.windows(2).zip(over.values.windows(2)) {
        let [coarse, fine] = [&pair[0], &pair[1]].map(|scene| scene.scene.cell_m());
        if fine >= coarse {
            return wrong(format!(
                "{} and {} give the same cells of {coarse} m, since cells are fitted to the body",
                values[0], values[1]
            ));
        }
    }
    Ok(())
}

/// Places that rows of the study may have, given those of one run.
fn places(of_run: &[String], parts: &[Part]) -> Vec<String> {
    let mut places = Vec::new();
    for place in of_run {
        let labels = parts.iter().flat_map(|part| &part.points);
        places.extend(labels.map(|point| format!("{place}@{}", point.label)));
        for metric in ERRORS {
            places.push(Curve::order_place(place, metric));
            let causes = CAUSES.iter();
            places.extend(causes.map(|cause| format!("{place}:{cause}:{metric}")));
        }
    }
    places
}
