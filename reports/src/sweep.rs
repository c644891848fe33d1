//! One scene at several points of its parameters, each with several methods: echo, what is left late
//! in the run, and cost.

use crate::format;
use crate::judge::RUN;
use crate::norms::{group_of, group_worst};
use crate::row::Row;
use serde::{Deserialize, Serialize};

/// The metric by which points are compared.
pub const ECHO: &str = "echo_ratio";

/// Smallest, mean and largest displacement late in the run (m), as [`crate::norms::late_range`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Range {
    /// Smallest (m).
    pub min: f64,
    /// Mean over time (m).
    pub mean: f64,
    /// Largest (m).
    pub max: f64,
}

/// One run at one point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepEntry {
    /// Boundary method as in `--method`.
    pub method: String,
    /// Echo ratio of each group: mean over its receivers, or why there is none.
    pub echo: Vec<(String, Result<f64, String>)>,
    /// The largest echo ratio of all receivers.
    pub worst: Option<f64>,
    /// What is left late in the run at one receiver.
    pub late: Option<Range>,
    /// Numbers that the scene's claims are of, `METRIC PLACE`: what a scene without echoes is judged by.
    #[serde(default)]
    pub claimed: Vec<(String, Option<f64>)>,
    /// CPU time (s).
    pub cpu_s: Option<f64>,
    /// Steps made.
    pub steps: Option<f64>,
    /// Unknowns.
    pub unknowns: Option<f64>,
    /// Peak memory (bytes).
    pub peak_bytes: Option<f64>,
}

impl SweepEntry {
    /// The mean over the groups; `None` unless all have a number.
    pub fn mean(&self) -> Option<f64> {
        let all: Option<Vec<f64>> = self.echo.iter().map(|(_, e)| e.clone().ok()).collect();
        let all = all.filter(|all| !all.is_empty())?;
        Some(all.iter().sum::<f64>() / all.len() as f64)
    }

    /// CPU time (s) a thousand steps.
    pub fn cpu_s_per_1000(&self) -> Option<f64> {
        Some(1000.0 * self.cpu_s? / self.steps.filter(|n| *n > 0.0)?)
    }
}

/// A point of the parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepPoint {
    /// Name in rows.
    pub label: String,
    /// What it is drawn over.
    pub value: Option<f64>,
    /// The runs.
    pub entries: Vec<SweepEntry>,
    /// What the reference has late in the run at the same receiver.
    pub late_reference: Option<Range>,
}

/// Points along one axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SweepPart {
    /// Name in rows of the part as a whole.
    pub name: String,
    /// What is varied.
    pub title: String,
    /// What the points' numbers are.
    pub axis: String,
    /// The receiver at which [`SweepEntry::late`] is taken.
    pub late_at: String,
    /// The points.
    pub points: Vec<SweepPoint>,
}

/// A sweep.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Sweep {
    /// Its name, if it has one.
    pub name: String,
    /// Its parts.
    pub parts: Vec<SweepPart>,
}

impl SweepPart {
    /// The methods, in the order of their first appearance.
    pub fn methods(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for entry in self.points.iter().flat_map(|point| &point.entries) {
            if !names.contains(&entry.method.as_str()) {
                names.push(&entry.method);
            }
        }
        names
    }

    /// The groups of receivers.
    pub fn groups(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        let entries = self.points.iter().flat_map(|point| &point.entries);
        for (group, _) in entries.flat_map(|entry| &entry.echo) {
            if !names.contains(&group.as_str()) {
                names.push(group);
            }
        }
        names
    }

    /// Names of the numbers that the scene claims, of all entries that have one.
    fn claimed(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        let entries = self.points.iter().flat_map(|point| &point.entries);
        let known = entries.flat_map(|entry| &entry.claimed);
        for (name, _) in known.filter(|(_, value)| value.is_some()) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        names
    }

    /// Was anything looked at late in a run?
    fn has_late(&self) -> bool {
        let mut entries = self.points.iter().flat_map(|point| &point.entries);
        entries.any(|entry| entry.late.is_some())
    }

    /// The numbers of a method over the points that have one: (value, number).
    pub fn curve(
        &self,
        method: &str,
        number: impl Fn(&SweepEntry) -> Option<f64>,
    ) -> Vec<(f64, f64)> {
        let mut curve = Vec::new();
        for point in &self.points {
            let entry = point.entries.iter().find(|entry| entry.method == method);
            if let (Some(x), Some(y)) = (point.value, entry.and_then(&number)) {
                curve.push((x, y));
            }
        }
        curve
    }

    /// The largest ratio of a method's echo in a group at a point to that at the point before it: not
    /// above one where the echo falls all along.
    ///
    /// # Errors
    /// Which point has no number.
    pub fn largest_rise(&self, method: &str, group: &str) -> Result<f64, String> {
        let mut echoes = Vec::new();
        for point in &self.points {
            let entry = point.entries.iter().find(|entry| entry.method == method);
            let echo = entry.and_then(|e| e.echo.iter().find(|(name, _)| name == group));
            match echo {
                Some((_, Ok(value))) => echoes.push(*value),
                Some((_, Err(why))) => return Err(format!("{}: {why}", point.label)),
                None => return Err(format!("{}: {method} has no echo in {group}", point.label)),
            }
        }
        let rises = echoes.windows(2).map(|pair| pair[1] / pair[0]);
        rises
            .reduce(f64::max)
            .ok_or_else(|| "a trend needs two points".to_owned())
    }
}

/// A run's entry, from its rows; `claims` are metrics and places.
pub fn entry(
    method: &str,
    rows: &[Row],
    claims: &[(String, String)],
    late: Option<Range>,
) -> SweepEntry {
    let own = || rows.iter().filter(|row| row.method == method);
    let cost = |metric: &str| {
        let mut found = own().filter(|row| row.metric == metric && row.place == RUN);
        found.next().and_then(|row| row.value)
    };
    let mut echo: Vec<(String, Result<f64, String>)> = Vec::new();
    let mut worst: Option<f64> = None;
    for row in own().filter(|row| row.metric == ECHO) {
        let group = group_of(&row.place);
        if row.place == group && !row.place.contains(':') {
            echo.push((group.to_owned(), row.value.ok_or_else(|| row.why.clone())));
        }
        // A receiver that is its own group has no row of its own for the worst.
        if row.place == group_worst(group) || row.place == group {
            worst = worst.into_iter().chain(row.value).reduce(f64::max);
        }
    }
    let claimed = claims.iter().map(|(metric, place)| {
        let mut found = own().filter(|row| row.metric == *metric && row.place == *place);
        let value = found.next().and_then(|row| row.value);
        (format!("{metric} {place}"), value)
    });
    SweepEntry {
        method: method.to_owned(),
        echo,
        worst,
        late,
        claimed: claimed.collect(),
        cpu_s: cost("cpu_s"),
        steps: cost("steps"),
        unknowns: cost("unknowns"),
        peak_bytes: cost("peak_bytes"),
    }
}

/// A column of a part's table: its head and what it shows of a run.
type Shown = (String, Box<dyn Fn(&SweepEntry) -> String>);

/// The columns behind point and method: echoes where there are some, else what the scene claims; then
/// what is left late, and cost.
fn columns(part: &SweepPart) -> Vec<Shown> {
    fn number(head: &str, of: impl Fn(&SweepEntry) -> Option<f64> + 'static) -> Shown {
        let text = move |entry: &SweepEntry| of(entry).map_or("–".to_owned(), format::number);
        (head.to_owned(), Box::new(text))
    }
    let groups = part.groups();
    let mut all: Vec<Shown> = Vec::new();
    for group in &groups {
        let name = (*group).to_owned();
        all.push(number(group, move |entry| {
            let echo = entry.echo.iter().find(|(own, _)| *own == name);
            echo.and_then(|(_, e)| e.clone().ok())
        }));
    }
    if groups.is_empty() {
        for head in part.claimed() {
            let name = head.to_owned();
            all.push(number(head, move |entry| {
                let own = entry.claimed.iter().find(|(own, _)| *own == name);
                own.and_then(|(_, value)| *value)
            }));
        }
    } else {
        all.push(number("mean", SweepEntry::mean));
        all.push(number("worst", |entry| entry.worst));
    }
    if part.has_late() {
        all.push(number("late mean", |entry| entry.late.map(|l| l.mean)));
        all.push(number("late max", |entry| entry.late.map(|l| l.max)));
    }
    all.push(number("CPU s", |entry| entry.cpu_s));
    let memory = |entry: &SweepEntry| entry.peak_bytes.map_or("–".to_owned(), format::bytes);
    all.push(("memory".to_owned(), Box::new(memory)));
    all
}

/// Heads of a part's table.
pub fn head(part: &SweepPart) -> Vec<String> {
    let fixed = ["point", "method"].map(str::to_owned);
    let columns = columns(part).into_iter().map(|(head, _)| head);
    fixed.into_iter().chain(columns).collect()
}

/// Cells of a part's table, as texts under [`head`].
pub fn cells(part: &SweepPart) -> Vec<Vec<String>> {
    let columns = columns(part);
    let mut rows = Vec::new();
    for point in &part.points {
        for entry in &point.entries {
            let mut row = vec![point.label.clone(), entry.method.clone()];
            row.extend(columns.iter().map(|(_, text)| text(entry)));
            rows.push(row);
        }
    }
    rows
}

/// What a part's table shows.
pub fn caption(part: &SweepPart) -> String {
    let mut said: Vec<String> = Vec::new();
    if !part.groups().is_empty() {
        said.push("echo ratio of each group (mean), and of all".to_owned());
    } else if !part.claimed().is_empty() {
        said.push("what the scene's claims are of: metric and place".to_owned());
    }
    if part.has_late() {
        said.push(format!(
            "late: displacement at {} after t1 (m)",
            part.late_at
        ));
    }
    said.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(echoes: &[f64]) -> SweepPart {
        let point = |(i, echo): (usize, &f64)| SweepPoint {
            label: format!("L={i}"),
            value: Some(i as f64),
            entries: vec![SweepEntry {
                method: "pml".into(),
                echo: vec![("A".into(), Ok(*echo)), ("B".into(), Ok(2.0 * echo))],
                worst: None,
                late: None,
                claimed: Vec::new(),
                cpu_s: Some(2.0),
                steps: Some(500.0),
                unknowns: None,
                peak_bytes: None,
            }],
            late_reference: None,
        };
        SweepPart {
            name: "thickness".into(),
            title: String::new(),
            axis: String::new(),
            late_at: "A1".into(),
            points: echoes.iter().enumerate().map(point).collect(),
        }
    }

    #[test]
    fn a_rise_is_found_wherever_it_is() {
        assert_eq!(part(&[0.8, 0.4, 0.1]).largest_rise("pml", "A"), Ok(0.5));
        assert_eq!(part(&[0.8, 0.1, 0.2]).largest_rise("pml", "B"), Ok(2.0));
        assert!(part(&[0.8]).largest_rise("pml", "A").is_err());
        assert!(part(&[0.8, 0.4]).largest_rise("dashpot", "A").is_err());
    }

    #[test]
    fn a_scene_without_echoes_shows_what_it_claims() {
        let mut part = part(&[0.2, 0.1]);
        assert!(!head(&part).contains(&"resistance w".to_owned()));
        for entry in part.points.iter_mut().flat_map(|p| &mut p.entries) {
            entry.echo.clear();
            let known = ("resistance w".to_owned(), Some(2.5));
            entry.claimed = vec![known, ("unknown w".to_owned(), None)];
        }
        let shown = ["point", "method", "resistance w", "CPU s", "memory"];
        assert_eq!(head(&part), shown);
        assert_eq!(cells(&part)[0][2], "2.50");
        assert!(caption(&part).contains("claims"));
    }

    #[test]
    fn means_and_costs() {
        let part = part(&[0.2, 0.1]);
        let entry = &part.points[0].entries[0];
        assert!((entry.mean().unwrap() - 0.3).abs() < 1e-15);
        assert_eq!(entry.cpu_s_per_1000(), Some(4.0));
        assert_eq!(part.curve("pml", |e| e.cpu_s), [(0.0, 2.0), (1.0, 2.0)]);
        assert_eq!(head(&part).len(), cells(&part)[0].len());
    }
}
