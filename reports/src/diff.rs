//! What changed from one list of rows to another: numbers that moved, verdicts, bounds, rows that are
//! new or gone. What a run cost is listed apart, since it never comes out twice the same.

use crate::format;
use crate::judge::COSTS;
use crate::row::{Row, Verdict};
use crate::table::{align_right, finish, new_table, verdict_name};
use anechoic_reference::claim::Accept;
use serde::Serialize;

/// Numbers closer than this share of the larger one count as the same, by default.
///
/// The solver's tolerance is 1e-10 of the motion; an echo of 1e-4 of it is a difference of two
/// motions, and known to 1e-6 of itself. What moves by less, another build's rounding may move.
pub const REL_TOL: f64 = 1e-6;

/// A row and the study that it is from; empty where there is one study only.
#[derive(Clone, Debug, PartialEq)]
pub struct Filed {
    /// Name of the study.
    pub study: String,
    /// The row.
    pub row: Row,
}

/// What kind of change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The verdict is another.
    Verdict,
    /// What is accepted is another.
    Bound,
    /// The number moved, came or went.
    Moved,
    /// The row is not there any more.
    Gone,
    /// The row was not there.
    New,
    /// What it cost moved.
    Cost,
}

/// One change.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Change {
    /// Its kind.
    pub change: Kind,
    /// Study; empty where there is one only.
    pub study: String,
    /// Case.
    pub case: String,
    /// Profile.
    pub profile: String,
    /// Method.
    pub method: String,
    /// Metric id.
    pub metric: String,
    /// Receiver, group, or field.
    #[serde(rename = "where")]
    pub place: String,
    /// Unit of the numbers.
    pub unit: String,
    /// The number before.
    pub before: Option<f64>,
    /// The number after.
    pub after: Option<f64>,
    /// Difference over the larger of both; `None` where one is missing.
    pub relative: Option<f64>,
    /// The verdict before.
    pub verdict_before: Option<Verdict>,
    /// The verdict after.
    pub verdict_after: Option<Verdict>,
    /// What was accepted before.
    pub accept_before: Option<Accept>,
    /// What is accepted after.
    pub accept_after: Option<Accept>,
}

impl Change {
    fn new(change: Kind, before: Option<&Filed>, after: Option<&Filed>) -> Option<Self> {
        let named = after.or(before)?;
        let row = &named.row;
        let numbers = [before, after].map(|filed| filed.and_then(|filed| filed.row.value));
        let verdict = |filed: Option<&Filed>| filed.and_then(|filed| filed.row.verdict);
        let accept = |filed: Option<&Filed>| filed.and_then(|filed| filed.row.accept);
        Some(Change {
            change,
            study: named.study.clone(),
            case: row.case.clone(),
            profile: row.profile.clone(),
            method: row.method.clone(),
            metric: row.metric.clone(),
            place: row.place.clone(),
            unit: row.unit.clone(),
            before: numbers[0],
            after: numbers[1],
            relative: match numbers {
                [Some(before), Some(after)] => Some(relative(before, after)),
                _ => None,
            },
            verdict_before: verdict(before),
            verdict_after: verdict(after),
            accept_before: accept(before),
            accept_after: accept(after),
        })
    }
}

/// All changes; those of costs do not count.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diff {
    /// The changes, by kind and in the order of the rows.
    pub changes: Vec<Change>,
    /// Rows that both lists have.
    pub common: usize,
}

impl Diff {
    /// Changes that are results.
    pub fn results(&self) -> impl Iterator<Item = &Change> {
        self.changes.iter().filter(|c| c.change != Kind::Cost)
    }

    /// Did no result change?
    pub fn is_same(&self) -> bool {
        self.results().next().is_none()
    }

    /// How many changes of a kind there are.
    pub fn count(&self, kind: Kind) -> usize {
        self.changes.iter().filter(|c| c.change == kind).count()
    }
}

/// Compares two lists of rows; numbers are the same within the share `rel_tol` of the larger one.
pub fn diff(before: &[Filed], after: &[Filed], rel_tol: f64) -> Diff {
    let partners = partners(before, after);
    let mut diff = Diff::default();
    for (index, old) in before.iter().enumerate() {
        match partners[index] {
            None => diff
                .changes
                .extend(Change::new(Kind::Gone, Some(old), None)),
            Some(partner) => {
                diff.common += 1;
                let new = &after[partner];
                let kinds = kinds(&old.row, &new.row, rel_tol);
                let changes = kinds
                    .into_iter()
                    .map(|k| Change::new(k, Some(old), Some(new)));
                diff.changes.extend(changes.flatten());
            }
        }
    }
    for (index, new) in after.iter().enumerate() {
        if !partners.contains(&Some(index)) {
            diff.changes.extend(Change::new(Kind::New, None, Some(new)));
        }
    }
    diff.changes.sort_by_key(|change| change.change as u8);
    diff
}

/// For each row of `before` the same row of `after`: of the same kind of evidence, else of any, so
/// that a number that became a claim is still found. Rows that are alike go in their order.
fn partners(before: &[Filed], after: &[Filed]) -> Vec<Option<usize>> {
    fn name(filed: &Filed) -> [&str; 6] {
        let row = &filed.row;
        [
            &filed.study,
            &row.case,
            &row.profile,
            &row.method,
            &row.metric,
            &row.place,
        ]
    }
    let mut partners = vec![None; before.len()];
    let mut taken = vec![false; after.len()];
    for any_evidence in [false, true] {
        for (index, old) in before.iter().enumerate() {
            if partners[index].is_some() {
                continue;
            }
            let found = (0..after.len()).find(|&i| {
                let new = &after[i];
                let alike = any_evidence || new.row.evidence == old.row.evidence;
                !taken[i] && alike && name(new) == name(old)
            });
            if let Some(i) = found {
                taken[i] = true;
                partners[index] = Some(i);
            }
        }
    }
    partners
}

/// In what a row changed.
fn kinds(old: &Row, new: &Row, rel_tol: f64) -> Vec<Kind> {
    let moved = match (old.value, new.value) {
        (Some(a), Some(b)) => relative(a, b).abs() > rel_tol || old.unit != new.unit,
        (None, None) => false,
        _ => true,
    };
    if COSTS.contains(&new.metric.as_str()) && new.verdict.is_none() && old.verdict.is_none() {
        return if moved { vec![Kind::Cost] } else { Vec::new() };
    }
    let changed = [
        (Kind::Verdict, old.verdict != new.verdict),
        (Kind::Bound, old.accept != new.accept),
        (Kind::Moved, moved),
    ];
    let changed = changed.into_iter().filter(|(_, is)| *is);
    changed.map(|(kind, _)| kind).collect()
}

/// Difference over the larger of both; zero for equal numbers.
fn relative(before: f64, after: f64) -> f64 {
    if before == after {
        return 0.0;
    }
    (after - before) / before.abs().max(after.abs())
}

/// The changes as tables: results, then costs; then how many there are.
pub fn diff_table(diff: &Diff, rel_tol: f64) -> String {
    let mut text = String::new();
    let (costs, results): (Vec<&Change>, Vec<&Change>) =
        diff.changes.iter().partition(|c| c.change == Kind::Cost);
    if !results.is_empty() {
        text += &table(&results);
        text.push('\n');
    }
    if !costs.is_empty() {
        text += "what it cost (not counted)\n\n";
        text += &table(&costs);
        text.push('\n');
    }
    let count = |kind| diff.count(kind);
    text + &format!(
        "{} rows in both: {} moved beyond {rel_tol:e}, {} verdicts and {} bounds changed; {} new, {} gone\n",
        diff.common,
        count(Kind::Moved),
        count(Kind::Verdict),
        count(Kind::Bound),
        count(Kind::New),
        count(Kind::Gone)
    )
}

fn table(changes: &[&Change]) -> String {
    // Of a single study or of two runs there is nothing to tell apart by it.
    let told = |name: fn(&Change) -> &str| changes.iter().any(|change| !name(change).is_empty());
    let study = told(|change| &change.study);
    let method = told(|change| &change.method);
    let mut head = vec!["change"];
    head.extend(study.then_some("study"));
    head.extend(method.then_some("method"));
    head.extend(["metric", "where", "before", "after", "by"]);
    let mut table = new_table(&head);
    let first = head.len() - 3;
    align_right(&mut table, &[first, first + 1, first + 2]);
    for change in changes {
        let mut cells = vec![word(change.change).to_owned()];
        cells.extend(study.then(|| change.study.clone()));
        cells.extend(method.then(|| change.method.clone()));
        cells.extend([change.metric.clone(), change.place.clone()]);
        cells.extend(numbers(change));
        table.add_row(cells);
    }
    finish(&table, "")
}

fn word(kind: Kind) -> &'static str {
    match kind {
        Kind::Verdict => "verdict",
        Kind::Bound => "bound",
        Kind::Moved => "moved",
        Kind::Gone => "gone",
        Kind::New => "new",
        Kind::Cost => "cost",
    }
}

/// Before, after, and by how much.
fn numbers(change: &Change) -> [String; 3] {
    let verdict = |verdict: Option<Verdict>| verdict.map_or("–", verdict_name).to_owned();
    let accept = |accept: &Option<Accept>| accept.as_ref().map_or("–".into(), format::accept);
    match change.change {
        Kind::Verdict => [
            verdict(change.verdict_before),
            verdict(change.verdict_after),
            String::new(),
        ],
        Kind::Bound => [
            accept(&change.accept_before),
            accept(&change.accept_after),
            String::new(),
        ],
        _ => {
            let number = |value: Option<f64>| {
                value.map_or("–".to_owned(), |v| format::with_unit(v, &change.unit))
            };
            let by = change.relative.map(|by| format!("{by:+.1e}"));
            [
                number(change.before),
                number(change.after),
                by.unwrap_or_default(),
            ]
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::{Measurement, judge};
    use anechoic_reference::claim::{Claim, Evidence};

    fn filed(residual: f64, echo: f64, cpu_s: f64, max: f64) -> Vec<Filed> {
        let claim = Claim {
            method: "pml".into(),
            metric: "residual".into(),
            place: "run".into(),
            accept: Accept::at_most(max),
            evidence: Evidence::Analytic,
            why: String::new(),
        };
        let measured = [
            Measurement::of_run("pml", "residual", residual, "1"),
            Measurement::of_run("pml", "echo_ratio", echo, "1"),
            Measurement::of_run("pml", "cpu_s", cpu_s, "s"),
        ];
        let rows = judge("c", "gate", &measured, &[claim]);
        let filed = |row| Filed {
            study: String::new(),
            row,
        };
        rows.into_iter().map(filed).collect()
    }

    fn kinds_of(diff: &Diff) -> Vec<Kind> {
        diff.changes.iter().map(|change| change.change).collect()
    }

    #[test]
    fn the_same_rows_do_not_differ_whatever_they_cost() {
        let before = filed(0.01, 0.5, 1.0, 0.02);
        assert!(diff(&before, &before, 0.0).changes.is_empty());
        let after = filed(0.01, 0.5, 3.0, 0.02);
        let costly = diff(&before, &after, REL_TOL);
        assert_eq!(kinds_of(&costly), [Kind::Cost]);
        assert!(costly.is_same());
    }

    #[test]
    fn numbers_move_beyond_the_tolerance_of_the_larger_one() {
        let before = filed(0.01, 0.5, 1.0, 0.02);
        let after = filed(0.01, 0.5 * (1.0 + 1e-5), 1.0, 0.02);
        let moved = diff(&before, &after, REL_TOL);
        assert_eq!(kinds_of(&moved), [Kind::Moved]);
        assert!((moved.changes[0].relative.unwrap() - 1e-5).abs() < 1e-9);
        assert!(diff(&before, &after, 1e-4).is_same());
        // From nothing to something is all of it.
        let zero = filed(0.01, 0.0, 1.0, 0.02);
        assert_eq!(diff(&zero, &before, 0.5).changes[0].relative, Some(1.0));
    }

    #[test]
    fn verdicts_and_bounds_are_told_apart() {
        let before = filed(0.01, 0.5, 1.0, 0.02);
        let failed = diff(&before, &filed(0.03, 0.5, 1.0, 0.02), REL_TOL);
        assert_eq!(kinds_of(&failed), [Kind::Verdict, Kind::Moved]);
        assert_eq!(failed.changes[0].verdict_after, Some(Verdict::Fail));
        let loosened = diff(&before, &filed(0.01, 0.5, 1.0, 0.5), REL_TOL);
        assert_eq!(kinds_of(&loosened), [Kind::Bound]);
        assert!(!loosened.is_same());
    }

    #[test]
    fn rows_and_numbers_that_come_and_go_are_changes() {
        let before = filed(0.01, 0.5, 1.0, 0.02);
        let mut fewer = before.clone();
        fewer.remove(1);
        assert_eq!(kinds_of(&diff(&before, &fewer, 1.0)), [Kind::Gone]);
        assert_eq!(kinds_of(&diff(&fewer, &before, 1.0)), [Kind::New]);
        let mut lost = before.clone();
        lost[1].row.value = None;
        assert_eq!(kinds_of(&diff(&before, &lost, 1.0)), [Kind::Moved]);
    }

    #[test]
    fn a_number_that_became_a_claim_is_the_same_row() {
        let claimed = filed(0.01, 0.5, 1.0, 0.02);
        let mut plain = claimed.clone();
        let row = &mut plain[0].row;
        (row.evidence, row.accept, row.verdict) = (String::new(), None, None);
        let changed = diff(&plain, &claimed, REL_TOL);
        assert_eq!(kinds_of(&changed), [Kind::Verdict, Kind::Bound]);
        // Two rows of one name: each finds its like.
        let twice = [plain.clone(), claimed].concat();
        assert!(diff(&twice, &twice, 0.0).changes.is_empty());
    }

    #[test]
    fn the_table_says_by_how_much() {
        let before = filed(0.01, 0.5, 1.0, 0.02);
        let text = diff_table(&diff(&before, &filed(0.03, 0.5, 2.0, 0.02), 1e-6), 1e-6);
        for word in [
            "pass",
            "fail",
            "+6.7e-1",
            "not counted",
            "1 moved beyond 1e-6",
        ] {
            assert!(text.contains(word), "{word} is missing in {text}");
        }
    }
}
