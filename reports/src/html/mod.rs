//! The report: one self-contained page that works offline.

mod tables;

use crate::budget::{self, Budget};
use crate::convergence::{Convergence, Refinement};
use crate::export::{summary_csv, summary_json};
use crate::format;
use crate::judge::{Tally, verifies};
use crate::row::Row;
use crate::stability::Stability;
use crate::stability::troubles;
use crate::study::{Figure, Image, Study, Upshot};
use crate::sweep::Sweep;
use crate::tradeoff::{ADVICE, TRADES, Tradeoff, advice_cells, trade_cells};
use anechoic_solver::record::Status;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};

const STYLE: &str = include_str!("style.css");

/// The page of a study.
pub fn report(study: &Study) -> String {
    page(study).into_string()
}

fn page(study: &Study) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (study.title) " – anechoic" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                main {
                    (header(study))
                    (unfinished(study))
                    (verdicts(study))
                    (ranking(study))
                    (upshot(study))
                    (figures(&study.figures, &study.command))
                    (notes(&study.notes))
                    (ledger(study))
                    (downloads(study))
                    (runs(study))
                    (measurements(study))
                }
            }
        }
    }
}

fn header(study: &Study) -> Markup {
    html! {
        header {
            h1 { (study.title) }
            ul.facts {
                li { "case " code { (study.case) } }
                li { "profile " code { (study.profile) } }
                li { (study.runs.len()) " runs" }
            }
            @if !study.summary.is_empty() { p { (study.summary) } }
            p.command { "Made by " code { (study.command) } }
        }
    }
}

/// Runs that failed or were stopped, before anything that was computed from the others.
fn unfinished(study: &Study) -> Markup {
    let runs: Vec<_> = study
        .runs
        .iter()
        .filter(|run| run.status != Status::Complete)
        .collect();
    html! {
        @if !runs.is_empty() {
            div.alarm role="alert" {
                p { strong { "Not all runs are complete." } }
                @for run in runs {
                    p { strong { (run.method) } ": " (tables::status_text(&run.status)) }
                }
            }
        }
    }
}

fn verdicts(study: &Study) -> Markup {
    let claims: Vec<&Row> = study.rows.iter().filter(|r| r.verdict.is_some()).collect();
    let (verification, other): (Vec<&Row>, Vec<&Row>) =
        claims.into_iter().partition(|row| verifies(row));
    html! {
        section {
            h2 { "Verdicts" }
            @if verification.is_empty() {
                p { "No claim of this study rests on a reference that verifies." }
            } @else {
                (tally(&verification))
                p.soft {
                    "Verification: against closed forms (analytic), other codes (independent), or the \
                     same scheme on a domain too large to echo (certified)."
                }
                (tables::verdicts(&verification))
            }
            @if !other.is_empty() {
                h3 { "Comparisons that do not verify" }
                p.soft {
                    "Against numbers printed in papers, or earlier results of this program."
                }
                (tables::verdicts(&other))
            }
        }
    }
}

fn tally(rows: &[&Row]) -> Markup {
    let tally = Tally::of(rows.iter().copied());
    html! {
        ul.tally {
            @if tally.pass > 0 { li.pass { (tally.pass) " pass" } }
            @if tally.fail > 0 { li.fail { (tally.fail) " fail" } }
            @if tally.not_evaluated > 0 { li.open { (tally.not_evaluated) " not evaluated" } }
        }
    }
}

fn ranking(study: &Study) -> Markup {
    html! {
        @if let Some(ranking) = &study.ranking {
            section {
                h2 { "Ranking by " code { (ranking.metric) } }
                @match &ranking.floor {
                    Some(floor) => p.soft {
                        "Floor of the reference: " (format::number(floor.value)) " (" (floor.how)
                        "). Methods at or below it tie (=)."
                    },
                    None => p.soft { "The floor of the reference is not known." },
                }
                (tables::ranking(ranking))
            }
        }
    }
}

fn upshot(study: &Study) -> Markup {
    match &study.upshot {
        None => html! {},
        Some(Upshot::Convergence(it)) => refinement(it),
        Some(Upshot::Sweep(it)) => sweep(it),
        Some(Upshot::Tradeoff(it)) => tradeoff(it),
        Some(Upshot::Stability(it)) => stable(it),
    }
}

fn refinement(refinement: &Refinement) -> Markup {
    html! {
        @for study in &refinement.studies { (convergence(study)) }
        @if let Some(budget) = &refinement.budget { (shares(budget)) }
    }
}

fn shares(budget: &Budget) -> Markup {
    html! {
        section {
            h2 { "Error budget" }
            p.soft {
                "What each cause contributes to the errors of " code { (budget.method) } " on the \
                 scene as it stands, over the true series: distances of runs that differ in one \
                 thing. Refinement says what a cause still changes, and does not verify."
            }
            (tables::texts(&budget::head(budget), &budget::cells(budget), 4))
        }
    }
}

fn convergence(convergence: &Convergence) -> Markup {
    html! {
        section {
            h2 { "Convergence over " code { (convergence.over) } }
            p.soft {
                "Errors of " code { (convergence.method) } " on each level, the order they fall \
                 with (least squares, with its 95 % interval), and between neighbours."
            }
            (tables::convergence(convergence))
            @for note in convergence.plateau_notes() { p { (note) } }
        }
    }
}

fn tradeoff(tradeoff: &Tradeoff) -> Markup {
    html! {
        section {
            h2 { "What an echo takes" }
            p.soft {
                "The cheapest run of each method whose mean echo is small enough, the cheapest \
                 method first. CPU time was measured apart from the runs for accuracy; over \
                 extended: over that of the same mesh extended until nothing comes back."
            }
            (tables::texts(&ADVICE, &advice_cells(tradeoff), 3))
            @if let Some(share) = tradeoff.awake_share {
                p.soft {
                    "Waves reach " (format::number(100.0 * share)) " % of the extended mesh's \
                     cell-steps; a solver whose cells sleep until then could save the rest, so \
                     that all ratios above would be larger by up to "
                    (format::number(1.0 / share)) ". This is counted, not timed."
                }
            }
            h3 { "All runs" }
            p.soft {
                "On the front no other run leaves less echo in as little time. L/wavelength: \
                 thickness over the length of compressional waves, "
                (format::short(tradeoff.wavelengths_m[0])) " m; shear waves have "
                (format::short(tradeoff.wavelengths_m[1])) " m."
            }
            (tables::texts(&TRADES, &trade_cells(tradeoff), 3))
        }
    }
}

fn stable(stability: &Stability) -> Markup {
    html! {
        section {
            h2 { "Which methods stay stable" }
            p.soft {
                "Growth rate of the total energy over the second half of each run; 0 is within \
                 rounding."
            }
            @for part in &stability.parts {
                h3 { (part.title) }
                (tables::texts(&crate::stability::head(stability), &crate::stability::cells(stability, part), 1))
            }
            h3 { "Largest stable step" }
            p.soft { "The largest that was tried up to which all runs are stable." }
            (tables::texts(&crate::stability::STEP_HEAD, &crate::stability::step_cells(stability), 1))
            @if !stability.spectra.is_empty() {
                h3 { "Spectra" }
                p.soft {
                    "A second opinion without runs: the largest real part of the operator of a mesh of a \
                     few cells with the method's sides, over c_p/h. What is positive grows; 0 is within \
                     rounding."
                }
                (tables::texts(&crate::stability::spectrum_head(stability), &crate::stability::spectrum_cells(stability), 1))
            }
            @let unstable = troubles(stability);
            @if !unstable.is_empty() {
                h3 { "What is not stable, and why" }
                (tables::texts(&["extreme", "method", "outcome"], &unstable, 3))
            }
        }
    }
}

fn sweep(sweep: &Sweep) -> Markup {
    html! {
        section {
            h2 { "Points" }
            @for part in &sweep.parts {
                h3 { (part.title) }
                p.soft { (crate::sweep::caption(part)) }
                (tables::texts(&crate::sweep::head(part), &crate::sweep::cells(part), 2))
            }
        }
    }
}

fn figures(figures: &[Figure], command: &str) -> Markup {
    html! {
        @if !figures.is_empty() {
            section {
                h2 { "Pictures" }
                @for figure in figures { (picture(figure, command)) }
            }
        }
    }
}

fn notes(notes: &[String]) -> Markup {
    html! {
        @if !notes.is_empty() {
            section {
                h2 { "Notes" }
                ul { @for note in notes { li { (note) } } }
            }
        }
    }
}

/// A picture with its words and the command that makes it, which a click selects as a whole.
fn picture(figure: &Figure, command: &str) -> Markup {
    html! {
        figure {
            @match &figure.image {
                Image::Svg(svg) => div.picture role="img" aria-label=(figure.title) {
                    (PreEscaped(svg))
                },
                Image::Png { bytes, width } => div.picture {
                    img alt=(figure.title) width=(width)
                        src={ "data:image/png;base64," (STANDARD.encode(bytes)) };
                },
            }
            figcaption {
                strong { (figure.title) "." } " " (figure.caption)
                div.command { "Made by " code { (command) } }
            }
        }
    }
}

fn ledger(study: &Study) -> Markup {
    html! {
        @if !study.ledger.is_empty() {
            section {
                h2 { "Against the source" }
                (tables::ledger(&study.ledger))
            }
        }
    }
}

/// All rows as files, inside the page: they stay with it wherever it goes.
fn downloads(study: &Study) -> Markup {
    let files = [
        ("summary.csv", "text/csv", summary_csv(&study.rows).ok()),
        (
            "summary.json",
            "application/json",
            summary_json(&study.rows).ok(),
        ),
    ];
    html! {
        @if !study.rows.is_empty() {
            section {
                h2 { "Downloads" }
                p {
                    "All rows: "
                    @for (name, kind, text) in files {
                        @if let Some(text) = text {
                            a download=(name) href={
                                "data:" (kind) ";base64," (STANDARD.encode(text))
                            } { (name) }
                            " "
                        }
                    }
                }
            }
        }
    }
}

fn runs(study: &Study) -> Markup {
    html! {
        @if !study.runs.is_empty() {
            section {
                h2 { "Runs" }
                h3 { "Cost" }
                (tables::cost(&study.runs))
                h3 { "Provenance" }
                (tables::provenance(&study.runs))
            }
        }
    }
}

fn measurements(study: &Study) -> Markup {
    let rows: Vec<&Row> = study.rows.iter().filter(|r| r.verdict.is_none()).collect();
    html! {
        @if !rows.is_empty() {
            details {
                summary { (rows.len()) " more numbers that no claim asks for" }
                (tables::measurements(&rows))
            }
        }
    }
}
