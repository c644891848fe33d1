//! The runs of a sweep: what is measured at each point, and how echoes go from point to point.

use super::references::References;
use super::rows::{names_of, rows_of};
use super::{Judged, traces, traces_of};
use crate::runner::Run;
use crate::scene::{Quantity, Role};
use crate::sweep::named::{self, NamedPart};
use crate::sweep::{Grid, Part, Point};
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::judge::{Measurement, judge};
use anechoic_reports::norms::{group_of, late_range};
use anechoic_reports::row::Row;
use anechoic_reports::sweep::{Range, Sweep, SweepPart, SweepPoint, entry};

/// The metric of trends: the largest ratio of an echo to that at the point before.
const RISE: &str = "largest_rise";

/// Judges the runs of a sweep. Claims on single runs are the business of other studies: a point has
/// numbers alone, of groups and of runs as a whole.
pub fn judge_points(runs: &[Run], grid: &Grid, references: &References) -> (Judged, Sweep) {
    let mut judged = Judged::default();
    let mut sweep = Sweep {
        name: grid.name.clone(),
        parts: Vec::new(),
    };
    let named = named::find(&grid.name).ok().flatten();
    for part in &grid.parts {
        let shown = judge_part(part, runs, references, &mut judged);
        let stated = named.iter().flat_map(|chosen| &chosen.parts);
        let stated = stated.into_iter().find(|own| own.name == part.name);
        trends(&shown, stated.copied(), runs, &mut judged.rows);
        sweep.parts.push(shown);
    }
    (judged, sweep)
}

fn judge_part(
    part: &Part,
    runs: &[Run],
    references: &References,
    judged: &mut Judged,
) -> SweepPart {
    let mut late_at = String::new();
    let points = part.points.iter().map(|point| {
        let (own, all) = point.pick(runs);
        let mut shown = SweepPoint {
            label: point.label.clone(),
            value: point.value,
            entries: Vec::new(),
            late_reference: None,
        };
        for run in own {
            let measured = super::measured(run, &all, references);
            if let Some(why) = &measured.obstacle {
                let name = &run.manifest.method;
                judged.notes.push(format!("{name}, {}: {why}", point.label));
            }
            let grows = super::growth::unstable(run, &mut []);
            judged
                .notes
                .extend(grows.map(|why| format!("{}: {why}", point.label)));
            let claimed = claimed(run);
            let is_claimed = |n: &Measurement| {
                let mut claims = claimed.iter();
                claims.any(|(metric, place)| n.metric == *metric && n.place == *place)
            };
            let mut numbers = measured.numbers;
            numbers.retain(|n| of_a_group(n) || is_claimed(n));
            let rows = rows_of(run, names_of(run), &numbers, Vec::new(), None);
            let late = late(run, references);
            if let Some((at, _, reference)) = &late {
                late_at.clone_from(at);
                shown.late_reference = shown.late_reference.or(*reference);
            }
            let own_late = late.map(|(_, own, _)| own);
            shown
                .entries
                .push(entry(&run.manifest.method, &rows, &claimed, own_late));
            judged.rows.extend(rows.into_iter().map(|row| Row {
                place: at_point(&row.place, point),
                ..row
            }));
        }
        shown
    });
    let points = points.collect();
    SweepPart {
        name: part.name.clone(),
        title: part.title.clone(),
        axis: part.axis.clone(),
        late_at,
        points,
    }
}

/// Metrics and places of the scene's claims on a run's method.
fn claimed(run: &Run) -> Vec<(String, String)> {
    let claims = run.prepared.scene.claims().into_iter().map(|c| c.claim);
    let own = claims.filter(|claim| run.manifest.judged_as() == Some(&claim.method));
    own.map(|claim| (claim.metric, claim.place)).collect()
}

/// The place of a number at a point.
pub fn at_point(place: &str, point: &Point) -> String {
    format!("{place}@{}", point.label)
}

/// Numbers of single receivers are left to studies of one scene.
fn of_a_group(number: &Measurement) -> bool {
    let place = number.place.as_str();
    let receiver = place.split(':').next().unwrap_or(place);
    group_of(receiver) == receiver
}

/// What the first receiver does once echoes are looked for, and what the reference does there.
fn late(run: &Run, references: &References) -> Option<(String, Range, Option<Range>)> {
    if !run.complete() {
        return None;
    }
    let window = run.prepared.scene.windows().into_iter().next()?;
    let own = traces(&run.record, Quantity::Displacement).ok()?;
    let own = late_range(&own, &window.receiver, window.from_s).ok()?;
    let truths = references.of(run).unwrap_or_default();
    let truth = truths
        .iter()
        .find(|t| t.role == Role::NoEcho && t.quantity == Quantity::Displacement);
    let truth = truth.and_then(|truth| {
        let series = traces_of(truth, &run.record).ok()?;
        late_range(&series, &window.receiver, window.from_s).ok()
    });
    Some((window.receiver, own, truth))
}

/// How each method's echo goes from point to point, with the claim of a named sweep.
fn trends(part: &SweepPart, stated: Option<&NamedPart>, runs: &[Run], rows: &mut Vec<Row>) {
    let Some(first) = runs.first() else {
        return;
    };
    if part.points.len() < 2 || part.points.iter().any(|point| point.value.is_none()) {
        return;
    }
    for method in part.methods() {
        let number = |group: &&str| Measurement {
            method: method.to_owned(),
            metric: RISE.to_owned(),
            place: format!("{group}@{}", part.name),
            value: part.largest_rise(method, group),
            unit: "1".to_owned(),
            against: Some((Evidence::Certified, "extended-domain".to_owned())),
        };
        let numbers: Vec<Measurement> = part.groups().iter().map(number).collect();
        let claimed = stated.and_then(|stated| stated.falls) == Some(method);
        let claims = numbers.iter().filter(|_| claimed).map(|number| Claim {
            method: method.to_owned(),
            metric: RISE.to_owned(),
            place: number.place.clone(),
            accept: Accept::at_most(1.0),
            evidence: Evidence::Certified,
            why: "more of what absorbs leaves less echo, from point to point".to_owned(),
        });
        let claims: Vec<Claim> = claims.collect();
        let (case, profile) = (&first.manifest.case, &first.manifest.profile);
        rows.extend(judge(case, profile, &numbers, &claims));
    }
}
