//! What is true of the runs of a study: closed forms of their scenes, and certified references.

use super::series::axes_of;
use crate::certified::{Certified, key, library::Library};
use crate::runner::Run;
use crate::scene::{Quantity, Reference, Role};
use anechoic_reference::claim::Evidence;
use std::collections::BTreeMap;

/// Name of certified references in rows.
const CERTIFIED: &str = "extended-domain";

/// Sampling times may differ by this share of a step, which is rounding.
const SAME_TIME: f64 = 1e-6;

/// References of a study's runs.
#[derive(Debug, Default)]
pub struct References {
    /// By hash: the reference, or why there is none.
    certified: BTreeMap<String, Result<Certified, String>>,
}

impl References {
    /// Looks up what the runs need.
    pub fn gather(runs: &[Run], library: &Library) -> Self {
        let mut references = References::default();
        for run in runs {
            let Some(problem) = run.prepared.scene.extended() else {
                continue;
            };
            let find = || match library.find(run.prepared.info.name, &problem) {
                Ok(Some(found)) => Ok(found),
                Ok(None) => Err(format!(
                    "there is no certified reference {} for this scene; `anechoic reference {}` with the same options computes it",
                    key::hash_of(&problem),
                    run.prepared.info.name
                )),
                Err(error) => Err(error.to_string()),
            };
            let hash = key::hash_of(&problem);
            references.certified.entry(hash).or_insert_with(find);
        }
        references
    }

    /// Everything that is true of a run, at its own times.
    ///
    /// # Errors
    /// Why there is no reference for it.
    pub fn of(&self, run: &Run) -> Result<Vec<Reference>, String> {
        let scene = run.prepared.scene.as_ref();
        let mut references = scene.references(&run.record.receivers.times)?;
        if let Some(hash) = hash(run) {
            let certified = self
                .certified
                .get(&hash)
                .ok_or("the study's references were not looked up")?
                .as_ref()
                .map_err(String::clone)?;
            references.push(at_times(certified, &run.record.receivers.times)?);
        }
        Ok(references)
    }

    /// The certified reference of a run, if it needs one and has it.
    pub fn certified(&self, run: &Run) -> Option<&Certified> {
        self.certified.get(&hash(run)?)?.as_ref().ok()
    }
}

/// The standard run that belongs to a run: of the standard method, or a variant of it, under the same
/// discretisation.
pub fn standard_of<'a>(run: &Run, runs: &[&'a Run]) -> Option<&'a Run> {
    let name = run.prepared.info.standard;
    let is_standard = |other: &Run| {
        let method = other.manifest.method.as_str();
        method == name
            || method
                .strip_prefix(name)
                .is_some_and(|rest| rest.starts_with('/'))
    };
    let own = hash(run);
    let mut runs = runs.iter().copied();
    runs.find(|other| other.complete() && is_standard(other) && hash(other) == own)
}

/// The hash of a run's certified reference, if it needs one.
fn hash(run: &Run) -> Option<String> {
    let problem = run.prepared.scene.extended()?;
    Some(key::hash_of(&problem))
}

/// The certified series up to the last of some times (s).
///
/// # Errors
/// Why it does not serve.
pub fn at_times(certified: &Certified, times: &[f64]) -> Result<Reference, String> {
    let (end, samples) = (times.last().copied().unwrap_or(0.0), times.len());
    certified.about.serves(end)?;
    let step = end / samples.max(2) as f64;
    let same = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME_TIME * step;
    let series = &certified.receivers;
    if series.times.len() < samples || !times.iter().zip(&series.times).all(same) {
        return Err("the certified reference is sampled at other times than the run".into());
    }
    let of = |name: &str, axis: &str| {
        let column = format!("{name}_{axis}");
        let values = series.column(&column);
        values
            .map(|values| values[..samples].to_vec())
            .ok_or(format!("the certified reference has no {column}"))
    };
    let receivers = series
        .columns
        .iter()
        .filter_map(|c| c.name.strip_suffix("_ux"));
    Ok(Reference {
        name: CERTIFIED,
        role: Role::NoEcho,
        evidence: Evidence::Certified,
        quantity: Quantity::Displacement,
        receivers: receivers
            .map(|name| {
                let axes = axes_of(series, 'u');
                let components = axes
                    .iter()
                    .map(|axis| of(name, axis))
                    .collect::<Result<_, _>>();
                Ok((name.to_owned(), components?))
            })
            .collect::<Result<_, String>>()?,
        pulses: false,
    })
}
