//! Sweeps that belong to a scene and have a name: the appendix of a paper, part by part.

use super::axis::Axis;
use super::{Setting, crossed};
use crate::error::CaseError;
use crate::scene::SceneInfo;
use crate::scenes::SCENES;
use anechoic_reports::study::Finding;

/// A sweep with a name.
#[derive(Debug)]
pub struct NamedSweep {
    /// Name in `anechoic sweep NAME`.
    pub name: &'static str,
    /// What it varies, in a line.
    pub summary: &'static str,
    /// Presets of the scene that it takes.
    pub presets: &'static [&'static str],
    /// The methods that it compares under a profile.
    pub methods: fn(profile: &str) -> &'static [&'static str],
    /// Its parts.
    pub parts: &'static [NamedPart],
    /// What its source says and how it fares: finding, place, note.
    pub ledger: &'static [(Finding, &'static str, &'static str)],
}

/// One series of points of a named sweep.
#[derive(Debug)]
pub struct NamedPart {
    /// Name in `anechoic sweep SWEEP/PART` and in rows.
    pub name: &'static str,
    /// What is varied, for people.
    pub title: &'static str,
    /// What the points' numbers are.
    pub axis: &'static str,
    /// As `--over`, crossed.
    pub over: &'static [&'static str],
    /// Names of the points where their values do not tell; numbered from 1 then.
    pub names: &'static [&'static str],
    /// The method whose echo must not rise from point to point, if one is said to.
    pub falls: Option<&'static str>,
}

impl NamedPart {
    /// Its points.
    ///
    /// # Errors
    /// [`CaseError::Usage`] when an axis of the program is at fault, which its tests exclude.
    pub fn settings(&self) -> Result<Vec<Setting>, CaseError> {
        let axes = self.over.iter().map(|text| Axis::parse(text));
        let mut settings = crossed(&axes.collect::<Result<Vec<_>, _>>()?);
        for (i, (setting, name)) in settings.iter_mut().zip(self.names).enumerate() {
            (*name).clone_into(&mut setting.label);
            setting.value = Some((i + 1) as f64);
        }
        Ok(settings)
    }
}

/// The sweep called `name`, or `SWEEP/PART`, with its scene and the parts that are asked for; `None`
/// when no sweep has that name.
///
/// # Errors
/// [`CaseError::Unknown`] for a part that the sweep does not have.
pub fn find(name: &str) -> Result<Option<Chosen>, CaseError> {
    let (sweep, part) = match name.split_once('/') {
        Some((sweep, part)) => (sweep, Some(part)),
        None => (name, None),
    };
    let all = SCENES
        .iter()
        .flat_map(|info| info.sweeps.iter().map(move |sweep| (*info, sweep)));
    let Some((info, sweep)) = all.into_iter().find(|(_, named)| named.name == sweep) else {
        return Ok(None);
    };
    let parts = match part {
        None => sweep.parts.iter().collect(),
        Some(part) => {
            let found = sweep.parts.iter().find(|p| p.name == part);
            vec![found.ok_or_else(|| {
                CaseError::unknown("part", part, sweep.parts.iter().map(|p| p.name))
            })?]
        }
    };
    Ok(Some(Chosen { info, sweep, parts }))
}

/// A named sweep and the parts of it that are asked for.
#[derive(Debug)]
pub struct Chosen {
    /// The scene that it belongs to.
    pub info: &'static SceneInfo,
    /// The sweep.
    pub sweep: &'static NamedSweep,
    /// The parts.
    pub parts: Vec<&'static NamedPart>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn named_sweeps_are_in_order() {
        for sweep in SCENES.iter().flat_map(|info| info.sweeps) {
            for part in sweep.parts {
                let settings = part.settings().unwrap();
                assert!(part.names.is_empty() || part.names.len() == settings.len());
                assert!(settings.len() > 1, "{}/{}", sweep.name, part.name);
            }
        }
    }

    #[test]
    fn a_part_is_found_by_its_name() {
        assert!(find("point-source").unwrap().is_none());
        let chosen = find("appendix-a/thickness").unwrap().unwrap();
        assert_eq!((chosen.info.name, chosen.parts.len()), ("point-source", 1));
        let error = find("appendix-a/thicknes").unwrap_err().to_string();
        assert!(error.contains("thickness"), "{error}");
    }
}
