//! From the numbers of a run to its rows: the claims on its method, judged or with the reason why not.

use crate::runner::Run;
use crate::scene::SceneClaim;
use anechoic_reference::claim::Claim;
use anechoic_reports::judge::{Measurement, judge};
use anechoic_reports::row::{Row, Verdict};

/// The claims on a method whose run cannot be read, with the reason; `like` is another run of its study.
pub fn rows_unread(like: &Run, method: &str, reason: &str) -> Vec<Row> {
    let claims = like.prepared.scene.claims();
    let names = (method, Some(method));
    rows_of(like, names, &[], claims, Some(reason.to_owned()))
}

/// A run's method as in rows, and the one whose claims are its.
pub(super) fn names_of(run: &Run) -> (&str, Option<&str>) {
    (&run.manifest.method, run.manifest.judged_as())
}

/// Those of some claims that are on a run's method, judged or with the reason why not, and all other
/// numbers; the method as in rows, and the one whose claims they are.
pub(super) fn rows_of(
    run: &Run,
    (name, method): (&str, Option<&str>),
    numbers: &[Measurement],
    claims: Vec<SceneClaim>,
    obstacle: Option<String>,
) -> Vec<Row> {
    let (case, profile) = (&run.manifest.case, &run.manifest.profile);
    let mut apply: Vec<Claim> = Vec::new();
    let mut reasons: Vec<(Claim, String)> = Vec::new();
    for mut claim in claims {
        if method != Some(&claim.claim.method) {
            continue;
        }
        name.clone_into(&mut claim.claim.method);
        match obstacle.clone().or(claim.not_here) {
            None => apply.push(claim.claim),
            Some(reason) => reasons.push((claim.claim, reason)),
        }
    }
    let mut all = apply.clone();
    all.extend(reasons.iter().map(|(claim, _)| claim.clone()));
    let mut rows = judge(case, profile, numbers, &all);
    // Rows of claims come first and in their order.
    for (row, (_, reason)) in rows.iter_mut().skip(apply.len()).zip(&reasons) {
        row.verdict = Some(Verdict::NotEvaluated);
        row.why.clone_from(reason);
    }
    rows
}
