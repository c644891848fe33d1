//! The study as texts, for tables on the terminal and in the report.

use super::{Standing, Trade, Tradeoff};
use crate::format;

/// Heads of the advice.
pub const ADVICE: [&str; 7] = [
    "echo at most",
    "method",
    "parameters",
    "echo",
    "CPU s",
    "over extended",
    "memory",
];

/// The advice as texts under [`ADVICE`]: for each echo the cheapest first, then each method's own.
pub fn advice_cells(tradeoff: &Tradeoff) -> Vec<[String; 7]> {
    let mut rows = Vec::new();
    let text = |value: Option<f64>| value.map_or("–".to_owned(), format::number);
    for advice in &tradeoff.advice {
        let wanted = format!("{} %", format::short(100.0 * advice.echo));
        if advice.below_floor {
            let why = "the reference's floor is above it: the question has no meaning here";
            let blank = String::new;
            rows.push([
                wanted,
                "–".into(),
                why.into(),
                blank(),
                blank(),
                blank(),
                blank(),
            ]);
            continue;
        }
        let mut found: Vec<(&str, Option<&Trade>)> = advice
            .of_methods
            .iter()
            .map(|(method, at)| (method.as_str(), at.map(|at| &tradeoff.trades[at])))
            .collect();
        let cost = |trade: &Option<&Trade>| trade.and_then(|t| t.cpu_s).unwrap_or(f64::INFINITY);
        found.sort_by(|a, b| cost(&a.1).total_cmp(&cost(&b.1)));
        for (method, trade) in found {
            let Some(trade) = trade else {
                let none = "none of its runs leaves so little".to_owned();
                let dash = || "–".to_owned();
                rows.push([
                    wanted.clone(),
                    method.to_owned(),
                    none,
                    dash(),
                    dash(),
                    dash(),
                    dash(),
                ]);
                continue;
            };
            rows.push([
                wanted.clone(),
                method.to_owned(),
                trade.label.clone(),
                text(trade.echo),
                text(trade.cpu_s),
                text(tradeoff.relative(trade)),
                trade.peak_bytes.map_or("–".to_owned(), format::bytes),
            ]);
        }
    }
    rows
}

/// Heads of the runs.
pub const TRADES: [&str; 9] = [
    "standing",
    "method",
    "parameters",
    "L/wavelength",
    "mean echo",
    "worst",
    "CPU s (range)",
    "unknown-steps",
    "memory",
];

/// All runs as texts under [`TRADES`], cheapest first.
pub fn trade_cells(tradeoff: &Tradeoff) -> Vec<[String; 9]> {
    let text = |value: Option<f64>| value.map_or("–".to_owned(), format::number);
    let mut order: Vec<&Trade> = tradeoff.trades.iter().collect();
    let cost = |trade: &Trade| trade.cpu_s.unwrap_or(f64::INFINITY);
    order.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    let rows = order.into_iter().map(|trade| {
        let time = match &trade.known.timing {
            Some(t) if t.repeats > 1 => format!(
                "{} ({} to {})",
                format::number(t.cpu_s),
                format::number(t.low_s),
                format::number(t.high_s)
            ),
            _ => text(trade.cpu_s),
        };
        [
            match &trade.standing {
                Standing::Front => "front".to_owned(),
                Standing::Dominated => "dominated".to_owned(),
                Standing::Failed(why) => format!("failed: {why}"),
            },
            trade.method.clone(),
            trade.label.clone(),
            text(
                trade
                    .known
                    .thickness_m
                    .map(|l| l / tradeoff.wavelengths_m[0]),
            ),
            text(trade.echo),
            text(trade.worst),
            time,
            text(trade.unknown_steps),
            trade.peak_bytes.map_or("–".to_owned(), format::bytes),
        ]
    });
    rows.collect()
}
