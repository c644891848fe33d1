//! Aligned tables for the terminal.

use crate::budget::{self, Budget};
use crate::convergence::{Convergence, Curve, Refinement};
use crate::format;
use crate::ranking::{Ranked, Ranking};
use crate::row::{Row, Verdict};
use crate::stability::{self, Stability};
use crate::study::Upshot;
use crate::sweep::{self, Sweep};
use crate::tradeoff::{ADVICE, TRADES, Tradeoff, advice_cells, trade_cells};
use anechoic_solver::Bill;
use comfy_table::{CellAlignment, LineStyle, Table, TableStyle};

/// The claims among `rows` with their verdicts; failures say why the bound is what it is.
pub fn verdict_table(rows: &[Row]) -> String {
    let mut table = new_table(&[
        "verdict",
        "method",
        "metric",
        "where",
        "value",
        "accepted",
        "evidence",
        "reference",
    ]);
    align_right(&mut table, &[4, 5]);
    let mut notes = String::new();
    for row in rows {
        let Some(verdict) = row.verdict else { continue };
        let accept = row.accept.as_ref().map_or_else(String::new, format::accept);
        table.add_row([
            verdict_name(verdict).to_owned(),
            row.method.clone(),
            row.metric.clone(),
            row.place.clone(),
            value_text(row),
            accept,
            row.evidence.clone(),
            row.reference.clone(),
        ]);
        if verdict != Verdict::Pass {
            notes += &format!(
                "{}: {} {} {}: {}\n",
                verdict_name(verdict),
                row.method,
                row.metric,
                row.place,
                row.why
            );
        }
    }
    finish(&table, &notes)
}

/// The measurements among `rows`: numbers that no claim asks for.
pub fn measurement_table(rows: &[Row]) -> String {
    let mut table = new_table(&["method", "metric", "where", "value"]);
    align_right(&mut table, &[3]);
    for row in rows.iter().filter(|row| row.verdict.is_none()) {
        let value = match row.value {
            Some(_) => value_text(row),
            None => row.why.clone(),
        };
        table.add_row([
            row.method.clone(),
            row.metric.clone(),
            row.place.clone(),
            value,
        ]);
    }
    finish(&table, "")
}

/// Methods by their echo with the cost beside it, and the floor below.
pub fn ranking_table(ranking: &Ranking) -> String {
    let mean = format!("{} (mean)", ranking.metric);
    let mut table = new_table(&[
        "rank", "method", &mean, "worst", "CPU s", "unknowns", "memory",
    ]);
    align_right(&mut table, &[0, 2, 3, 4, 5, 6]);
    for method in &ranking.methods {
        table.add_row(ranking_cells(ranking, method));
    }
    let note = match &ranking.floor {
        Some(floor) => format!(
            "floor of the reference {} ({}); methods at or below it tie\n",
            format::number(floor.value),
            floor.how
        ),
        None => "the floor of the reference is not known\n".to_owned(),
    };
    finish(&table, &note)
}

/// Cells of a line of the ranking: rank, method, mean, worst, CPU time, unknowns, memory.
pub fn ranking_cells(ranking: &Ranking, method: &Ranked) -> [String; 7] {
    let text = |value: Option<f64>, show: fn(f64) -> String| value.map_or("–".to_owned(), show);
    let tie = method.echo.is_some_and(|echo| ranking.below_floor(echo));
    [
        method.rank.map_or("–".to_owned(), |rank| {
            format!("{}{rank}", if tie { "=" } else { "" })
        }),
        method.method.clone(),
        text(method.echo, format::number),
        text(method.worst, format::number),
        text(method.cpu_s, format::number),
        text(method.unknowns, |v| format::count(v as usize)),
        text(method.peak_bytes, format::bytes),
    ]
}

/// What each feature of a scene costs, known before it is solved.
pub fn bill_table(bill: &Bill) -> String {
    let mut table = new_table(&[
        "feature",
        "keeps",
        "points",
        "B each",
        "B a node",
        "records",
        "ms a step",
    ]);
    align_right(&mut table, &[2, 3, 4, 5, 6]);
    let dash = |shown: bool, text: String| if shown { text } else { "–".to_owned() };
    for item in &bill.items {
        let has_points = item.points > 0;
        table.add_row([
            item.feature.clone(),
            item.holds.clone(),
            dash(has_points, format::count(item.points)),
            dash(
                item.bytes_per_point > 0 && has_points,
                item.bytes_per_point.to_string(),
            ),
            dash(item.bytes_per_node > 0, item.bytes_per_node.to_string()),
            dash(
                item.record_bytes > 0,
                format::bytes(item.record_bytes as f64),
            ),
            dash(item.step_s > 0.0, format::number(1e3 * item.step_s)),
        ]);
    }
    finish(&table, "")
}

/// What the runs of a study make together.
pub fn upshot_table(upshot: &Upshot) -> String {
    match upshot {
        Upshot::Convergence(refinement) => refinement_table(refinement),
        Upshot::Sweep(sweep) => sweep_table(sweep),
        Upshot::Tradeoff(tradeoff) => tradeoff_table(tradeoff),
        Upshot::Stability(stability) => stability_table(stability),
    }
}

/// Convergence studies field by field, then the budget.
fn refinement_table(refinement: &Refinement) -> String {
    let mut text: Vec<String> = refinement.studies.iter().map(convergence_table).collect();
    text.extend(refinement.budget.as_ref().map(budget_table));
    text.join("\n")
}

/// What each cause contributes to the errors of a scene.
fn budget_table(own: &Budget) -> String {
    let head = budget::head(own);
    let mut table = new_table(&head.iter().map(String::as_str).collect::<Vec<_>>());
    align_right(&mut table, &(4..head.len()).collect::<Vec<_>>());
    for line in budget::cells(own) {
        table.add_row(line);
    }
    finish(&table, "share: over the true series\n")
}

/// Errors on all levels with the orders they fall with, and where they no longer fall.
pub fn convergence_table(convergence: &Convergence) -> String {
    let head = convergence_head(convergence);
    let mut table = new_table(&head.iter().map(String::as_str).collect::<Vec<_>>());
    let last = head.len() - 1;
    align_right(&mut table, &(2..=last).collect::<Vec<_>>());
    for curve in &convergence.curves {
        table.add_row(convergence_cells(curve));
    }
    let notes = convergence.plateau_notes();
    finish(
        &table,
        &notes
            .iter()
            .fold(String::new(), |text, note| text + note + "\n"),
    )
}

/// Echo and cost of all methods at all points, part by part.
pub fn sweep_table(sweep: &Sweep) -> String {
    let mut text = String::new();
    for part in &sweep.parts {
        let head = sweep::head(part);
        let mut table = new_table(&head.iter().map(String::as_str).collect::<Vec<_>>());
        align_right(&mut table, &(2..head.len()).collect::<Vec<_>>());
        for row in sweep::cells(part) {
            table.add_row(row);
        }
        let note = sweep::caption(part) + "\n\n";
        text += &format!("{}\n{}", part.title, finish(&table, &note));
    }
    text
}

/// What an echo takes, and all runs with their standing.
pub fn tradeoff_table(tradeoff: &Tradeoff) -> String {
    let mut advice = new_table(&ADVICE);
    align_right(&mut advice, &[0, 3, 4, 5, 6]);
    let mut last = String::new();
    for mut row in advice_cells(tradeoff) {
        // The echo stands once.
        if row[0] == last {
            row[0].clear();
        } else {
            last.clone_from(&row[0]);
        }
        advice.add_row(row);
    }
    let mut trades = new_table(&TRADES);
    align_right(&mut trades, &[3, 4, 5, 6, 7, 8]);
    for row in trade_cells(tradeoff) {
        trades.add_row(row);
    }
    let [p, s] = tradeoff.wavelengths_m.map(format::short);
    let notes = format!("L/wavelength: of compressional waves, {p} m; shear waves have {s} m\n");
    format!("{}\n{}", finish(&advice, ""), finish(&trades, &notes))
}

/// How methods end at extremes, part by part, and why some are not stable.
pub fn stability_table(study: &Stability) -> String {
    let mut text = String::new();
    let head = stability::head(study);
    for part in &study.parts {
        let mut table = new_table(&head.iter().map(String::as_str).collect::<Vec<_>>());
        align_right(&mut table, &(1..head.len()).collect::<Vec<_>>());
        for row in stability::cells(study, part) {
            table.add_row(row);
        }
        text += &format!("{}\n{}\n", part.title, finish(&table, ""));
    }
    text += &plain_table(&stability::STEP_HEAD, &stability::step_cells(study), "\n");
    if !study.spectra.is_empty() {
        let head = stability::spectrum_head(study);
        let note =
            "largest real part of the operator of a small mesh with the sides, over c_p/h\n\n";
        text += &plain_table(&head, &stability::spectrum_cells(study), note);
    }
    for [extreme, method, why] in stability::troubles(study) {
        text += &format!("{method} at {extreme}: {why}\n");
    }
    text
}

/// A table of texts whose columns but the first are numbers.
fn plain_table<R: AsRef<[String]>>(head: &[impl AsRef<str>], rows: &[R], note: &str) -> String {
    let mut table = new_table(&head.iter().map(AsRef::as_ref).collect::<Vec<_>>());
    align_right(&mut table, &(1..head.len()).collect::<Vec<_>>());
    for row in rows {
        table.add_row(row.as_ref());
    }
    finish(&table, note)
}

/// Head of the table of a convergence study.
pub fn convergence_head(convergence: &Convergence) -> Vec<String> {
    let mut head = vec!["metric".to_owned(), "where".to_owned()];
    head.extend(convergence.labels());
    head.extend(["order (95 %)", "between neighbours"].map(str::to_owned));
    head
}

/// Cells of its line: metric, place, errors, order with its interval, orders between neighbours.
pub fn convergence_cells(curve: &Curve) -> Vec<String> {
    let mut cells = vec![curve.metric.clone(), curve.place.clone()];
    cells.extend(curve.errors.iter().map(|error| match error {
        Ok(error) => format::number(*error),
        Err(_) => "–".to_owned(),
    }));
    match &curve.order {
        Ok(order) => {
            let fit = format!("{:.2}", order.fit.value);
            cells.push(match order.fit.interval {
                Some([low, high]) => format!("{fit} ({low:.2} to {high:.2})"),
                None => fit,
            });
            let pairs: Vec<String> = order.pairwise.iter().map(|p| format!("{p:.2}")).collect();
            cells.push(pairs.join(", "));
        }
        Err(reason) => cells.extend([reason.clone(), "–".to_owned()]),
    }
    cells
}

/// The verdict as rows spell it.
pub fn verdict_name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "fail",
        Verdict::NotEvaluated => "not evaluated",
    }
}

/// The value with its unit, or a dash.
pub fn value_text(row: &Row) -> String {
    row.value
        .map_or("–".to_owned(), |v| format::with_unit(v, &row.unit))
}

/// A rule under the header and nothing else.
const STYLE: TableStyle =
    TableStyle::new().header_separator(LineStyle::none().fill('─').junction('─'));

pub(crate) fn new_table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(STYLE);
    table.set_header(header.iter().copied());
    table
}

pub(crate) fn align_right(table: &mut Table, columns: &[usize]) {
    for index in columns {
        if let Some(column) = table.column_mut(*index) {
            column.set_cell_alignment(CellAlignment::Right);
        }
    }
}

pub(crate) fn finish(table: &Table, notes: &str) -> String {
    format!("{}\n{notes}", table.trim_fmt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::{Measurement, judge};
    use crate::ranking::Floor;
    use anechoic_reference::claim::{Accept, Claim, Evidence};

    fn rows() -> Vec<Row> {
        let claim = |metric: &str| Claim {
            method: "dashpot".to_owned(),
            metric: metric.to_owned(),
            place: "run".to_owned(),
            accept: Accept::at_most(0.01),
            evidence: Evidence::Analytic,
            why: "exact in one dimension".to_owned(),
        };
        let measured = [
            Measurement::of_run("dashpot", "residual", 0.02, "1"),
            Measurement::of_run("dashpot", "echo_ratio", 0.5, "1"),
        ];
        let measured = measured.map(|m| Measurement {
            place: if m.metric == "echo_ratio" { "A" } else { "run" }.to_owned(),
            ..m
        });
        judge("c", "gate", &measured, &[claim("residual"), claim("order")])
    }

    #[test]
    fn failures_and_gaps_say_why() {
        let text = verdict_table(&rows());
        assert!(text.contains("0.0200") && text.contains("≤ 0.0100"));
        assert!(text.contains("fail: dashpot residual run: exact in one dimension"));
        assert!(text.contains("not evaluated: dashpot order run: order of dashpot"));
        assert!(!text.contains("echo_ratio"));
        assert!(measurement_table(&rows()).contains("echo_ratio"));
    }

    #[test]
    fn columns_are_aligned() {
        let text = verdict_table(&rows());
        let at: Vec<usize> = text
            .lines()
            .filter(|line| line.contains("dashpot") && !line.contains(':'))
            .filter_map(|line| line.find("dashpot"))
            .collect();
        assert_eq!(at.len(), 2);
        assert_eq!(at[0], at[1]);
    }

    #[test]
    fn the_ranking_shows_its_floor() {
        let floor = Floor {
            value: 0.6,
            how: "larger buffer".to_owned(),
        };
        let text = ranking_table(&Ranking::from_rows(&rows(), "echo_ratio", Some(floor)));
        assert!(text.contains("=1") && text.contains("larger buffer"));
    }
}
