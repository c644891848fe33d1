//! Runs at extremes of their parameters: which stay stable, and how the others end.

use crate::format;
use crate::norms::{ROUNDING_GROWTH, Slope};
use serde::{Deserialize, Serialize};

/// The metric of a run's outcome: 1 where it is stable, 0 where it is not.
pub const STABLE: &str = "stable";

/// The metric of the largest step, over h/c_p, up to which all runs of a method are stable.
pub const LARGEST_STEP: &str = "largest_stable_step";

/// The metric of spectra: the largest real part of a small mesh's operator, over c_p/h.
pub const LARGEST_REAL_PART: &str = "largest_real_part";

/// Real parts below this (c_p/h) are rounding: doubled modes at rest have its root.
const SMALL: f64 = 1e-6;
/// A real part that rounding moves by more than this share of itself is rounding.
const SURE: f64 = 0.1;

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// Its energy does not grow after the load; growth rate with its interval (1/s), where measured.
    Stable(Option<[f64; 3]>),
    /// Its energy grows after the load, or ends far above what the load brought.
    Grows(Option<[f64; 3]>),
    /// A field became infinite, a point was inverted or left the grid; in the solver's words.
    Diverged(String),
    /// An iteration did not reach its tolerance; in the solver's words.
    NotConverged(String),
    /// The program refuses the scene, and says why.
    Refused(String),
    /// It was stopped, or its energy tells nothing.
    Open(String),
}

/// Rate and interval of a slope.
pub fn rate(slope: &Slope) -> [f64; 3] {
    let [low, high] = slope.interval.unwrap_or([slope.value; 2]);
    [slope.value, low, high]
}

impl Outcome {
    /// For people, in a word or a number.
    pub fn short(&self) -> String {
        let number = |rate: &Option<[f64; 3]>, word: &str| match rate {
            Some([value, ..]) if value.abs() > ROUNDING_GROWTH => {
                let sign = if *value > 0.0 { "+" } else { "−" };
                format!("{sign}{}/s", format::short(value.abs()))
            }
            _ => word.to_owned(),
        };
        match self {
            Outcome::Stable(rate) => number(rate, "0"),
            Outcome::Grows(rate) => number(rate, "grows"),
            Outcome::Diverged(_) => "diverged".to_owned(),
            Outcome::NotConverged(_) => "no convergence".to_owned(),
            Outcome::Refused(_) => "refused".to_owned(),
            Outcome::Open(_) => "open".to_owned(),
        }
    }

    /// What it is, at length.
    pub fn long(&self) -> String {
        let interval = |rate: &Option<[f64; 3]>| match rate {
            Some([value, low, high]) => {
                format!(" ({value:.2e} per second, {low:.2e} to {high:.2e})")
            }
            None => String::new(),
        };
        match self {
            Outcome::Stable(rate) => format!("stable{}", interval(rate)),
            Outcome::Grows(rate) => format!("grows{}", interval(rate)),
            Outcome::Diverged(why) => format!("diverged: {why}"),
            Outcome::NotConverged(why) => format!("not converged: {why}"),
            Outcome::Refused(why) => format!("refused: {why}"),
            Outcome::Open(why) => format!("open: {why}"),
        }
    }

    /// 1 stable, 0 not; why there is no number otherwise.
    ///
    /// # Errors
    /// The reason.
    pub fn number(&self) -> Result<f64, String> {
        match self {
            Outcome::Stable(_) => Ok(1.0),
            Outcome::Grows(_) | Outcome::Diverged(_) | Outcome::NotConverged(_) => Ok(0.0),
            Outcome::Refused(why) | Outcome::Open(why) => Err(why.clone()),
        }
    }
}

/// All methods at one extreme.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilityPoint {
    /// Name in rows.
    pub label: String,
    /// How each method ended.
    pub outcomes: Vec<(String, Outcome)>,
}

/// Extremes of one kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StabilityPart {
    /// What is driven to its extreme.
    pub title: String,
    /// The points.
    pub points: Vec<StabilityPoint>,
}

/// The largest step of a method's runs up to which all are stable.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LargestStep {
    /// The method.
    pub method: String,
    /// The step over h/c_p, or why there is none.
    pub value: Result<f64, String>,
    /// The largest that was tried.
    pub tried: f64,
}

/// What the spectrum of a small mesh says.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Opinion {
    /// Largest real part of the operator over c_p/h.
    pub growth: f64,
    /// How far rounding moves it.
    pub rounding: f64,
}

/// The opinions on all methods with a layer at one extreme.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpectrumPoint {
    /// Name of the extreme in rows.
    pub label: String,
    /// One entry a method: the opinion, or why there is none.
    pub entries: Vec<(String, Result<Opinion, String>)>,
}

/// A study of stability.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Stability {
    /// Its parts.
    pub parts: Vec<StabilityPart>,
    /// The largest stable step of each method.
    #[serde(default)]
    pub largest_steps: Vec<LargestStep>,
    /// What the spectra of small meshes say.
    #[serde(default)]
    pub spectra: Vec<SpectrumPoint>,
}

impl Stability {
    /// The methods, in the order of their first appearance.
    pub fn methods(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        let points = self.parts.iter().flat_map(|part| &part.points);
        for (name, _) in points.flat_map(|point| &point.outcomes) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        names
    }
}

impl Opinion {
    /// Is it rounding alone?
    pub fn is_rounding(&self) -> bool {
        self.growth.abs() < SMALL || self.rounding > SURE * self.growth.abs()
    }
}

impl StabilityPoint {
    /// How a method ended.
    pub fn outcome(&self, method: &str) -> Option<&Outcome> {
        let found = self.outcomes.iter().find(|(name, _)| name == method);
        found.map(|(_, outcome)| outcome)
    }
}

/// Heads of the map as a table.
pub fn head(stability: &Stability) -> Vec<String> {
    let mut head = vec!["extreme".to_owned()];
    head.extend(stability.methods().iter().map(|m| (*m).to_owned()));
    head
}

/// A part as texts under [`head`].
pub fn cells(stability: &Stability, part: &StabilityPart) -> Vec<Vec<String>> {
    let methods = stability.methods();
    let row = |point: &StabilityPoint| {
        let mut row = vec![point.label.clone()];
        row.extend(methods.iter().map(|method| {
            let outcome = point.outcome(method);
            outcome.map_or("–".to_owned(), Outcome::short)
        }));
        row
    };
    part.points.iter().map(row).collect()
}

/// Heads of the table of largest steps.
pub const STEP_HEAD: [&str; 3] = ["method", "largest stable step over h/c_p", "largest tried"];

/// Its lines.
pub fn step_cells(stability: &Stability) -> Vec<[String; 3]> {
    let line = |step: &LargestStep| {
        let value = match &step.value {
            Ok(value) => format::short(*value),
            Err(why) => why.clone(),
        };
        [step.method.clone(), value, format::short(step.tried)]
    };
    stability.largest_steps.iter().map(line).collect()
}

/// Methods of the spectra, in the order of their first appearance.
fn layers(stability: &Stability) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for (name, _) in stability.spectra.iter().flat_map(|point| &point.entries) {
        if !names.contains(&name.as_str()) {
            names.push(name);
        }
    }
    names
}

/// Heads of the table of spectra.
pub fn spectrum_head(stability: &Stability) -> Vec<String> {
    let mut head = vec!["extreme".to_owned()];
    head.extend(layers(stability).into_iter().map(str::to_owned));
    head
}

/// Its lines under [`spectrum_head`]: 0 where nothing grows but rounding.
pub fn spectrum_cells(stability: &Stability) -> Vec<Vec<String>> {
    let layers = layers(stability);
    let text = |value: &Result<Opinion, String>| match value {
        Ok(opinion) if opinion.is_rounding() => "0".to_owned(),
        Ok(opinion) if opinion.growth < 0.0 => format!("−{}", format::number(-opinion.growth)),
        Ok(opinion) => format!("+{}", format::number(opinion.growth)),
        Err(why) => why.clone(),
    };
    let line = |point: &SpectrumPoint| {
        let mut line = vec![point.label.clone()];
        line.extend(layers.iter().map(|method| {
            let found = point.entries.iter().find(|(name, _)| name == method);
            found.map_or("–".to_owned(), |(_, value)| text(value))
        }));
        line
    };
    stability.spectra.iter().map(line).collect()
}

/// Why runs are not stable: extreme, method, outcome at length.
pub fn troubles(stability: &Stability) -> Vec<[String; 3]> {
    let points = stability.parts.iter().flat_map(|part| &part.points);
    let all = points.flat_map(|point| {
        let bad = |(_, outcome): &&(String, Outcome)| !matches!(outcome, Outcome::Stable(_));
        let text = |(method, outcome): &(String, Outcome)| {
            [point.label.clone(), method.clone(), outcome.long()]
        };
        point
            .outcomes
            .iter()
            .filter(bad)
            .map(text)
            .collect::<Vec<_>>()
    });
    all.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_in_words_and_numbers() {
        let stable = Outcome::Stable(Some([-0.25, -0.3, -0.2]));
        assert_eq!(
            (stable.short().as_str(), stable.number()),
            ("−0.25/s", Ok(1.0))
        );
        assert_eq!(Outcome::Stable(Some([1e-9, 0.0, 2e-9])).short(), "0");
        let grows = Outcome::Grows(Some([7.0, 6.9, 7.1]));
        assert_eq!((grows.short().as_str(), grows.number()), ("+7/s", Ok(0.0)));
        assert!(grows.long().contains("6.90e0 to 7.10e0"));
        assert!(Outcome::Refused("flip".into()).number().is_err());
    }

    #[test]
    fn spectra_tell_growth_from_rounding() {
        let opinion = |growth, rounding| Ok(Opinion { growth, rounding });
        let entries = [
            ("pml", opinion(0.013, 1e-9)),
            ("damping-layer", opinion(-0.25, 0.0)),
            ("a", opinion(3e-9, 0.0)),
            ("b", opinion(7e-4, 2e-4)),
        ];
        let stability = Stability {
            spectra: vec![SpectrumPoint {
                label: "nu=0.499".into(),
                entries: entries.map(|(name, x)| (name.to_owned(), x)).to_vec(),
            }],
            ..Stability::default()
        };
        assert_eq!(
            spectrum_head(&stability)[1..],
            ["pml", "damping-layer", "a", "b"]
        );
        assert_eq!(
            spectrum_cells(&stability)[0][1..],
            ["+0.0130", "−0.250", "0", "0"]
        );
    }

    #[test]
    fn every_method_has_a_column() {
        let point = |label: &str, method: &str| StabilityPoint {
            label: label.into(),
            outcomes: vec![(method.into(), Outcome::Diverged("at step 3".into()))],
        };
        let stability = Stability {
            parts: vec![StabilityPart {
                title: "step".into(),
                points: vec![point("a", "pml"), point("b", "dashpot")],
            }],
            ..Stability::default()
        };
        assert_eq!(head(&stability), ["extreme", "pml", "dashpot"]);
        let cells = cells(&stability, &stability.parts[0]);
        assert_eq!(cells[1], ["b", "–", "diverged"]);
        assert_eq!(troubles(&stability).len(), 2);
    }
}
