//! `--filter`: rows whose METHOD/METRIC/WHERE contains a text.

use crate::error::{CaseError, nearest};
use anechoic_reports::judge::COSTS;
use anechoic_reports::row::Row;

/// Metrics that rows may hold, costs aside.
const METRICS: &[&str] = &[
    "residual",
    "reflection",
    "echo_ratio",
    "amplitude_ratio",
    "echo_level_db",
    "rel_l2",
    "peak_error",
    "envelope_misfit",
    "phase_misfit",
    "goodness",
    "settlement_error",
    "drift_error",
    "peak_deviation",
    "arrival_s",
    "order",
    "plateau",
    "share",
    "largest_rise",
    "stable",
    "largest_stable_step",
    "largest_real_part",
    "relative_cost",
    "timed_cpu_s",
    "awake_share",
    "energy_left",
    "growth_rate_per_s",
    "serves_until_s",
];

fn metrics<'a>() -> impl Iterator<Item = &'a str> {
    METRICS.iter().copied().chain(COSTS)
}

/// A text that rows are chosen by.
#[derive(Clone, Debug)]
pub struct Filter(pub String);

impl Filter {
    /// Is the row chosen?
    pub fn matches(&self, row: &Row) -> bool {
        self.matches_parts(&row.method, &row.metric, &row.place)
    }

    fn matches_parts(&self, method: &str, metric: &str, place: &str) -> bool {
        format!("{method}/{metric}/{place}").contains(&self.0)
    }

    /// The methods to solve: those that the filter names, or all when it names metrics or places.
    ///
    /// # Errors
    /// [`CaseError::Filter`] when no row can match.
    pub fn methods<'a>(
        &self,
        methods: &[&'a str],
        places: &[String],
    ) -> Result<Vec<&'a str>, CaseError> {
        let named =
            |method: &&&str| method.contains(&self.0) || self.0.starts_with(&format!("{method}/"));
        let chosen: Vec<&str> = methods.iter().filter(named).copied().collect();
        if !chosen.is_empty() && !chosen.iter().any(|m| self.0.starts_with(&format!("{m}/"))) {
            return Ok(chosen);
        }
        let can_match = |method: &str| {
            metrics().any(|metric| {
                places
                    .iter()
                    .any(|place| self.matches_parts(method, metric, place))
            })
        };
        let chosen: Vec<&str> = methods.iter().copied().filter(|m| can_match(m)).collect();
        if chosen.is_empty() {
            return Err(self.nothing(methods));
        }
        Ok(chosen)
    }

    /// The chosen rows.
    ///
    /// # Errors
    /// [`CaseError::Filter`] when there is none.
    pub fn choose(&self, rows: &[Row]) -> Result<Vec<Row>, CaseError> {
        let chosen: Vec<Row> = rows
            .iter()
            .filter(|row| self.matches(row))
            .cloned()
            .collect();
        if chosen.is_empty() {
            let methods: Vec<&str> = rows.iter().map(|row| row.method.as_str()).collect();
            return Err(self.nothing(&methods));
        }
        Ok(chosen)
    }

    fn nothing(&self, methods: &[&str]) -> CaseError {
        let words = methods.iter().copied().chain(metrics());
        CaseError::Filter {
            given: self.0.clone(),
            nearest: nearest(&self.0, words),
            example: format!("{}/residual/A", methods.first().unwrap_or(&"dashpot")),
        }
    }
}
