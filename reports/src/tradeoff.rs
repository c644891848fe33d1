//! Error against cost: which runs are worth their time, and what an echo of 10, 1 or 0.1 % takes.

mod texts;

pub use texts::{ADVICE, TRADES, advice_cells, trade_cells};

use crate::judge::{Measurement, RUN};
use crate::sweep::{Sweep, SweepEntry};
use anechoic_reference::claim::Evidence;
use serde::{Deserialize, Serialize};

/// Echoes that advice is given for.
pub const ECHOES: [f64; 4] = [0.1, 0.01, 0.005, 0.001];

/// The metric of what an echo costs, over the extended mesh.
pub const RELATIVE_COST: &str = "relative_cost";

/// The CPU time of a run, measured apart from the run that its echo is of.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Median (s).
    pub cpu_s: f64,
    /// Fastest (s).
    pub low_s: f64,
    /// Slowest (s).
    pub high_s: f64,
    /// How often it was run.
    pub repeats: usize,
}

impl Timing {
    /// The median of some times (s); `None` without any.
    pub fn of(mut times: Vec<f64>) -> Option<Self> {
        times.sort_by(f64::total_cmp);
        let (low, high) = (*times.first()?, *times.last()?);
        let n = times.len();
        Some(Timing {
            cpu_s: 0.5 * (times[(n - 1) / 2] + times[n / 2]),
            low_s: low,
            high_s: high,
            repeats: n,
        })
    }
}

/// What else is known of a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Known {
    /// Thickness of its layer or of the material that it adds (m).
    pub thickness_m: Option<f64>,
    /// Its time, where it was measured.
    pub timing: Option<Timing>,
    /// Why it did not end, if it did not.
    pub failed: Option<String>,
}

/// Whether a run is worth its time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Standing {
    /// No other leaves less echo in as little time.
    Front,
    /// Another leaves no more echo in less time, or less echo in no more time.
    Dominated,
    /// There is no echo or no time, for this reason.
    Failed(String),
}

/// One run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trade {
    /// Boundary method as in `--method`.
    pub method: String,
    /// Its parameters.
    pub label: String,
    /// Mean echo of the groups.
    pub echo: Option<f64>,
    /// Largest echo of all receivers.
    pub worst: Option<f64>,
    /// CPU time (s): timed apart, else of the run itself.
    pub cpu_s: Option<f64>,
    /// Unknowns times steps.
    pub unknown_steps: Option<f64>,
    /// Peak memory (bytes).
    pub peak_bytes: Option<f64>,
    /// Thickness, time, failure.
    pub known: Known,
    /// Its standing among all.
    pub standing: Standing,
}

/// What an echo takes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Advice {
    /// The echo.
    pub echo: f64,
    /// The cheapest run of each method that leaves no more, by its place among the trades.
    pub of_methods: Vec<(String, Option<usize>)>,
    /// The cheapest of all.
    pub best: Option<usize>,
    /// The reference itself is no better than this echo.
    pub below_floor: bool,
}

/// A study of accuracy against cost.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tradeoff {
    /// All runs.
    pub trades: Vec<Trade>,
    /// Floor of the reference.
    pub floor: Option<f64>,
    /// Lengths (m) of compressional and shear waves at the source's frequency.
    pub wavelengths_m: [f64; 2],
    /// Place of the run on the extended mesh, which leaves no echo.
    pub plain: Option<usize>,
    /// Share of that mesh's point-steps that the wave has reached.
    pub awake_share: Option<f64>,
    /// What each echo takes.
    pub advice: Vec<Advice>,
}

impl Tradeoff {
    /// The study of a sweep whose runs are `known`, in the order of points and their entries.
    pub fn new(
        sweep: &Sweep,
        known: &[Known],
        floor: Option<f64>,
        wavelengths_m: [f64; 2],
    ) -> Self {
        let entries = sweep.parts.iter().flat_map(|part| {
            let points = part.points.iter();
            points.flat_map(|point| point.entries.iter().map(|e| (point.label.as_str(), e)))
        });
        let mut trades: Vec<Trade> = entries
            .zip(known)
            .map(|((label, entry), known)| trade(label, entry, known))
            .collect();
        let standings: Vec<Standing> = (0..trades.len()).map(|i| standing(&trades, i)).collect();
        for (trade, standing) in trades.iter_mut().zip(standings) {
            trade.standing = standing;
        }
        let advice = ECHOES.iter().map(|echo| advise(&trades, *echo, floor));
        Tradeoff {
            advice: advice.collect(),
            trades,
            floor,
            wavelengths_m,
            plain: None,
            awake_share: None,
        }
    }

    /// The methods, in the order of their first appearance.
    pub fn methods(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        for trade in &self.trades {
            if !names.contains(&trade.method.as_str()) {
                names.push(&trade.method);
            }
        }
        names
    }

    /// A run's time over that of the extended mesh.
    pub fn relative(&self, trade: &Trade) -> Option<f64> {
        Some(trade.cpu_s? / self.trades.get(self.plain?)?.cpu_s?)
    }

    /// The cost of each echo with each method over the extended mesh, times, and the awake share.
    pub fn measurements(&self) -> Vec<Measurement> {
        let mut all = Vec::new();
        for trade in &self.trades {
            if let Some(timing) = &trade.known.timing {
                let place = format!("{RUN}@{}", trade.label);
                let number = |metric: &str, value| Measurement {
                    place: place.clone(),
                    ..Measurement::of_run(&trade.method, metric, value, "s")
                };
                all.push(number("timed_cpu_s", timing.cpu_s));
                all.push(number("timed_cpu_low_s", timing.low_s));
                all.push(number("timed_cpu_high_s", timing.high_s));
            }
        }
        for advice in &self.advice {
            for (method, at) in &advice.of_methods {
                let value = match (advice.below_floor, at) {
                    (true, _) => Err("the reference's own floor is above this echo".to_owned()),
                    (false, None) => Err("none of its runs leaves so little".to_owned()),
                    (false, Some(at)) => self
                        .relative(&self.trades[*at])
                        .ok_or("the extended mesh was not timed".to_owned()),
                };
                all.push(Measurement {
                    method: method.clone(),
                    metric: RELATIVE_COST.to_owned(),
                    place: format!("echo<={}", advice.echo),
                    value,
                    unit: "1".to_owned(),
                    against: Some((Evidence::Certified, "extended-domain".to_owned())),
                });
            }
        }
        if let Some(share) = self.awake_share {
            all.push(Measurement::of_run("extended", "awake_share", share, "1"));
        }
        all
    }
}

fn trade(label: &str, entry: &SweepEntry, known: &Known) -> Trade {
    Trade {
        method: entry.method.clone(),
        label: label.to_owned(),
        echo: entry.mean(),
        worst: entry.worst,
        cpu_s: known.timing.map(|timing| timing.cpu_s).or(entry.cpu_s),
        unknown_steps: entry.unknowns.zip(entry.steps).map(|(n, steps)| n * steps),
        peak_bytes: entry.peak_bytes,
        known: known.clone(),
        standing: Standing::Dominated,
    }
}

fn standing(trades: &[Trade], i: usize) -> Standing {
    if let Some(why) = &trades[i].known.failed {
        return Standing::Failed(why.clone());
    }
    let numbers = |trade: &Trade| match &trade.known.failed {
        None => trade.echo.zip(trade.cpu_s),
        Some(_) => None,
    };
    let Some((echo, cpu)) = numbers(&trades[i]) else {
        return Standing::Failed("no echo was measured".to_owned());
    };
    let beaten = trades
        .iter()
        .filter_map(numbers)
        .any(|(e, c)| (e < echo && c <= cpu) || (e <= echo && c < cpu));
    if beaten {
        Standing::Dominated
    } else {
        Standing::Front
    }
}

/// The cheapest that leave at most `echo`, method by method.
fn advise(trades: &[Trade], echo: f64, floor: Option<f64>) -> Advice {
    let mut of_methods: Vec<(String, Option<usize>)> = Vec::new();
    let enough = |trade: &Trade| {
        !matches!(trade.standing, Standing::Failed(_)) && trade.echo.is_some_and(|e| e <= echo)
    };
    let cheaper = |a: usize, b: Option<usize>| {
        b.is_none_or(|b| {
            trades[a].cpu_s.unwrap_or(f64::INFINITY) < trades[b].cpu_s.unwrap_or(f64::INFINITY)
        })
    };
    let mut best = None;
    for (i, trade) in trades.iter().enumerate() {
        let at = of_methods
            .iter()
            .position(|(name, _)| *name == trade.method);
        let at = at.unwrap_or_else(|| {
            of_methods.push((trade.method.clone(), None));
            of_methods.len() - 1
        });
        if enough(trade) && cheaper(i, of_methods[at].1) {
            of_methods[at].1 = Some(i);
        }
        if enough(trade) && cheaper(i, best) {
            best = Some(i);
        }
    }
    Advice {
        echo,
        of_methods,
        best,
        below_floor: floor.is_some_and(|floor| floor >= echo),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::{SweepPart, SweepPoint};

    /// Method, echo, CPU time.
    fn study(runs: &[(&str, Option<f64>, f64)], floor: Option<f64>) -> Tradeoff {
        let point = |(method, echo, cpu): &(&str, Option<f64>, f64)| SweepPoint {
            label: format!("at {cpu}"),
            value: None,
            entries: vec![SweepEntry {
                method: (*method).to_owned(),
                echo: vec![("A".into(), echo.ok_or("it failed".to_owned()))],
                worst: *echo,
                late: None,
                claimed: Vec::new(),
                cpu_s: Some(*cpu),
                steps: Some(10.0),
                unknowns: Some(5.0),
                peak_bytes: None,
            }],
            late_reference: None,
        };
        let sweep = Sweep {
            name: String::new(),
            parts: vec![SweepPart {
                name: String::new(),
                title: String::new(),
                axis: String::new(),
                late_at: String::new(),
                points: runs.iter().map(point).collect(),
            }],
        };
        let known = vec![Known::default(); runs.len()];
        Tradeoff::new(&sweep, &known, floor, [100.0, 50.0])
    }

    const RUNS: [(&str, Option<f64>, f64); 6] = [
        ("pml", Some(0.05), 1.0),
        ("pml", Some(0.004), 2.0),
        ("damping", Some(0.06), 1.5),
        ("damping", Some(0.009), 8.0),
        ("flip", None, 1.0),
        ("extended", Some(0.0), 40.0),
    ];

    #[test]
    fn the_front_is_what_nothing_beats() {
        let study = study(&RUNS, None);
        let standing: Vec<&Standing> = study.trades.iter().map(|t| &t.standing).collect();
        assert_eq!(standing[0], &Standing::Front);
        assert_eq!(standing[1], &Standing::Front);
        assert_eq!(standing[2], &Standing::Dominated);
        assert_eq!(standing[3], &Standing::Dominated);
        assert!(matches!(standing[4], Standing::Failed(_)));
        assert_eq!(standing[5], &Standing::Front);
    }

    #[test]
    fn advice_is_the_cheapest_that_is_good_enough() {
        let mut study = study(&RUNS, Some(0.002));
        study.plain = Some(5);
        let [ten, one, half, tenth] = study.advice.as_slice() else {
            panic!("four echoes are asked for");
        };
        assert_eq!((ten.best, one.best, half.best), (Some(0), Some(1), Some(1)));
        assert!(tenth.below_floor && !one.below_floor);
        let damping = one.of_methods.iter().find(|(name, _)| name == "damping");
        assert_eq!(damping.unwrap().1, Some(3));
        let costs = study.measurements();
        let relative = |method: &str, place: &str| {
            let found = costs
                .iter()
                .find(|m| m.method == method && m.place == place);
            found.unwrap().value.clone()
        };
        assert_eq!(relative("pml", "echo<=0.01"), Ok(0.05));
        assert_eq!(relative("damping", "echo<=0.01"), Ok(0.2));
        assert!(relative("pml", "echo<=0.001").is_err());
        assert!(relative("flip", "echo<=0.1").is_err());
        assert_eq!(advice_cells(&study)[0][1], "pml");
        assert_eq!(trade_cells(&study).len(), 6);
    }

    #[test]
    fn a_median_of_times() {
        let timing = Timing::of(vec![3.0, 1.0, 2.0, 10.0]).unwrap();
        assert_eq!(
            (timing.cpu_s, timing.low_s, timing.high_s),
            (2.5, 1.0, 10.0)
        );
        assert_eq!(Timing::of(vec![]), None);
    }
}
