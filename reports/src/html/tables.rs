//! Tables of the report.
//!
//! Cells carry their column's name, so that narrow screens can show each row as a card.

use crate::convergence::Convergence;
use crate::format;
use crate::ranking::Ranking;
use crate::row::{Row, Verdict};
use crate::study::{Finding, LedgerEntry, RunSummary};
use crate::table::{convergence_cells, convergence_head, ranking_cells, value_text, verdict_name};
use anechoic_solver::record::Status;
use maud::{Markup, html};

pub(super) fn verdicts(rows: &[&Row]) -> Markup {
    html! {
        div.scroll {
            table.cards {
                thead {
                    tr {
                        th { "verdict" }
                        th { "method" }
                        th { "metric" }
                        th { "where" }
                        th.number { "value" }
                        th.number { "accepted" }
                        th { "evidence" }
                        th { "why" }
                    }
                }
                tbody { @for row in rows { (verdict_row(row)) } }
            }
        }
    }
}

fn verdict_row(row: &Row) -> Markup {
    let accept = row.accept.as_ref().map_or_else(String::new, format::accept);
    html! {
        tr {
            td data-label="verdict" {
                @if let Some(verdict) = row.verdict {
                    span class={ "badge " (verdict_class(verdict)) } { (verdict_name(verdict)) }
                }
            }
            td data-label="method" { (row.method) }
            td data-label="metric" { code { (row.metric) } }
            td data-label="where" { (row.place) }
            td.number data-label="value" { (value_text(row)) }
            td.number data-label="accepted" { (accept) }
            td data-label="evidence" {
                span {
                    (row.evidence)
                    @if !row.reference.is_empty() { span.soft { ": " (row.reference) } }
                }
            }
            td.why data-label="why" { (row.why) }
        }
    }
}

fn verdict_class(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "fail",
        Verdict::NotEvaluated => "open",
    }
}

pub(super) fn ranking(ranking: &Ranking) -> Markup {
    const HEAD: [&str; 7] = [
        "rank",
        "method",
        "mean echo",
        "worst",
        "CPU s",
        "unknowns",
        "memory",
    ];
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        @for (i, head) in HEAD.iter().enumerate() {
                            th.number[i != 1] { (head) }
                        }
                    }
                }
                tbody {
                    @for method in &ranking.methods {
                        tr {
                            @for (i, cell) in ranking_cells(ranking, method).iter().enumerate() {
                                td.number[i != 1].name[i == 1] { (cell) }
                            }
                        }
                    }
                }
            }
        }
    }
}

pub(super) fn convergence(convergence: &Convergence) -> Markup {
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        @for (i, head) in convergence_head(convergence).iter().enumerate() {
                            th.number[i > 1] { (head) }
                        }
                    }
                }
                tbody {
                    @for curve in &convergence.curves {
                        tr {
                            @for (i, cell) in convergence_cells(curve).iter().enumerate() {
                                td.number[i > 1].name[i < 2] { (cell) }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// A table of texts; columns from `numbers` on are aligned as numbers.
pub(super) fn texts<R: AsRef<[String]>>(
    head: &[impl AsRef<str>],
    rows: &[R],
    numbers: usize,
) -> Markup {
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        @for (i, head) in head.iter().enumerate() {
                            th.number[i >= numbers] { (head.as_ref()) }
                        }
                    }
                }
                tbody {
                    @for row in rows {
                        tr {
                            @for (i, cell) in row.as_ref().iter().enumerate() {
                                td.number[i >= numbers].name[i < numbers] { (cell) }
                            }
                        }
                    }
                }
            }
        }
    }
}

pub(super) fn ledger(entries: &[LedgerEntry]) -> Markup {
    html! {
        div.scroll {
            table.cards {
                thead { tr { th { "finding" } th { "place" } th { "note" } } }
                tbody {
                    @for entry in entries {
                        tr {
                            td data-label="finding" {
                                span class={ "badge " (finding_class(entry.finding)) } {
                                    (entry.finding.name())
                                }
                            }
                            td data-label="place" { (entry.place) }
                            td data-label="note" { span { (entry.note) } }
                        }
                    }
                }
            }
        }
    }
}

fn finding_class(finding: Finding) -> &'static str {
    match finding {
        Finding::Reproduced => "pass",
        Finding::Differs => "fail",
        Finding::UnderSpecified => "open",
    }
}

pub(super) fn cost(runs: &[RunSummary]) -> Markup {
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        th { "method" }
                        th { "status" }
                        th.number { "steps" }
                        th.number { "points" }
                        th.number { "unknowns" }
                        th.number { "iterations" }
                        th.number { "CPU s" }
                        th.number { "wall s" }
                        th.number { "memory" }
                        th { "linear solver" }
                    }
                }
                tbody {
                    @for run in runs {
                        tr {
                            td.name { (run.method) }
                            td { (status_badge(&run.status)) }
                            @for number in cost_cells(run) { td.number { (number) } }
                            td { (run.cost.as_ref().map_or("", |cost| &cost.linear_solver)) }
                        }
                    }
                }
            }
        }
    }
}

/// Steps, points, unknowns, iterations, times, memory; a dash each where nobody knows.
fn cost_cells(run: &RunSummary) -> [String; 7] {
    match &run.cost {
        None => std::array::from_fn(|_| "–".to_owned()),
        Some(cost) => [
            format::count(cost.steps),
            format::count(cost.points),
            format::count(cost.unknowns),
            format::count(cost.iterations),
            format::number(cost.cpu_s),
            format::number(cost.wall_s),
            format::bytes(cost.peak_bytes as f64),
        ],
    }
}

pub(super) fn provenance(runs: &[RunSummary]) -> Markup {
    html! {
        div.scroll {
            table {
                thead {
                    tr {
                        th { "method" }
                        th { "version" }
                        th { "revision" }
                        th { "compiler" }
                        th.number { "threads" }
                        th { "input hash" }
                    }
                }
                tbody {
                    @for run in runs {
                        tr {
                            td.name { (run.method) }
                            td { (run.provenance.version) }
                            td.hash {
                                (run.provenance.revision)
                                @if run.provenance.dirty { " " span.badge.open { "dirty" } }
                            }
                            td.name { (run.provenance.compiler) }
                            td.number { (run.provenance.threads) }
                            td.hash { (run.provenance.input_hash) }
                        }
                    }
                }
            }
        }
    }
}

pub(super) fn measurements(rows: &[&Row]) -> Markup {
    html! {
        div.scroll {
            table {
                thead {
                    tr { th { "method" } th { "metric" } th { "where" } th.number { "value" } }
                }
                tbody {
                    @for row in rows {
                        tr {
                            td.name { (row.method) }
                            td { code { (row.metric) } }
                            td { (row.place) }
                            @match row.value {
                                Some(_) => td.number { (value_text(row)) },
                                None => td.why { (row.why) },
                            }
                        }
                    }
                }
            }
        }
    }
}

/// How a run ended, with the error of a failed one.
pub(super) fn status_text(status: &Status) -> String {
    match status {
        Status::Complete => "complete".to_owned(),
        Status::Cancelled => "incomplete: it was stopped before its end".to_owned(),
        Status::Failed(error) => format!("failed: {error}"),
    }
}

fn status_badge(status: &Status) -> Markup {
    let (class, text) = match status {
        Status::Complete => ("pass", "complete"),
        Status::Cancelled => ("open", "incomplete"),
        Status::Failed(_) => ("fail", "failed"),
    };
    html! { span class={ "badge " (class) } { (text) } }
}
