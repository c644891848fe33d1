//! What is measured of each method: reflection against angle, against the layer's thickness, against
//! the cells in a wavelength.

use super::subject::Subject;
use super::{AtlasError, Side};
use crate::error::CaseError;
use crate::progress;
use anechoic_reference::analytic::oblique::{Reflection, Wave};
use rayon::prelude::*;

/// Largest angle (degrees).
pub const STEEPEST: usize = 85;
/// Angle of the pictures against thickness and cells (degrees).
pub const OBLIQUE: f64 = 45.0;
/// Angles at which levels of cells are extrapolated (degrees).
pub const EXTRAPOLATED: [f64; 4] = [30.0, 60.0, 75.0, 85.0];
/// Cells of a layer, where its thickness is varied.
const LAYERS: [f64; 13] = [
    2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0, 50.0, 60.0, 80.0,
];
/// Cells over those of the scene, itself included, the two finest last.
const LEVELS: [f64; 6] = [2.0, 1.25, 1.0, 0.625, 0.5, 0.25];
/// A level needs so many cells in the shorter wave.
const FEWEST_CELLS: f64 = 5.0;

/// A method's reflections.
#[derive(Clone, Debug)]
pub struct Measured {
    /// What was measured.
    pub subject: Subject,
    /// Against the angle, a degree apart from 0 on.
    pub angles: Vec<[Reflection; 2]>,
    /// Against the layer's thickness at [`OBLIQUE`]: thickness (m) and what comes back of P and S.
    pub thickness: Vec<(f64, [f64; 2])>,
    /// On other cells.
    pub levels: Vec<Level>,
    /// What comes back of a Rayleigh wave, where it was asked for.
    pub surface: Option<f64>,
}

/// What comes back on cells of one size.
#[derive(Clone, Copy, Debug)]
pub struct Level {
    /// Edge of a cell (m).
    pub h: f64,
    /// Of P and S at [`OBLIQUE`].
    pub oblique: [f64; 2],
    /// Of P and S at each of [`EXTRAPOLATED`].
    pub angles: [[f64; 2]; 4],
}

impl Measured {
    /// What comes back of a wave at a whole angle (degrees).
    pub fn total(&self, wave: Wave, angle: usize) -> f64 {
        self.angles[angle][wave as usize].total(wave)
    }

    /// What the two finest levels leave for cells of no size at an angle of [`EXTRAPOLATED`], whose
    /// error falls with the square of the size; and what is left of the error of fourth order, from how
    /// the scene's own cells and the coarser of the two would have it.
    pub fn extrapolated(&self, wave: Wave, angle: usize) -> Option<(f64, f64)> {
        let [.., fine, finest] = self.levels.as_slice() else {
            return None;
        };
        let own = self.levels.iter().find(|level| level.h == self.subject.h)?;
        let limit = |coarse: &Level, fine: &Level| {
            let at = |level: &Level| level.angles[angle][wave as usize];
            let ratio = (coarse.h / fine.h).powi(2);
            (ratio * at(fine) - at(coarse)) / (ratio - 1.0)
        };
        let value = limit(fine, finest);
        let ratio = (own.h / fine.h).powi(4);
        Some((value, (value - limit(own, fine)).abs() / (ratio - 1.0)))
    }
}

/// One response to measure.
enum Part {
    Angles,
    Thickness(f64),
    Level(f64),
}

/// A part's result.
enum Done {
    Angles(Vec<[Reflection; 2]>),
    Thickness(f64, [f64; 2]),
    Level(Level),
}

/// Measures all subjects, `jobs` responses at a time; the order is theirs. The thickness is varied once
/// for all that differ in nothing else.
///
/// # Errors
/// What cannot be measured; [`CaseError::Stopped`].
pub fn measure_all(subjects: Vec<Subject>, jobs: usize) -> Result<Vec<Measured>, CaseError> {
    let mut parts = Vec::new();
    let mut varied: Vec<&str> = Vec::new();
    for (index, subject) in subjects.iter().enumerate() {
        parts.push((index, Part::Angles));
        if subject.is_layer() && !varied.contains(&subject.side.method.as_str()) {
            varied.push(&subject.side.method);
            parts.extend(LAYERS.map(|cells| (index, Part::Thickness(cells))));
        }
        let short = subject.wavelength(Wave::S) / subject.h;
        let levels = LEVELS.iter().filter(|f| short / **f >= FEWEST_CELLS);
        parts.extend(levels.map(|factor| (index, Part::Level(*factor))));
    }
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs)
        .build()
        .map_err(|error| CaseError::Usage(format!("--jobs {jobs}: {error}")))?;
    let done: Vec<(usize, Done)> = pool.install(|| {
        let parts = parts.into_par_iter().with_max_len(1);
        parts
            .map(|(index, part)| {
                if progress::stopped() {
                    return Err(CaseError::Stopped("the reflection atlas".into()));
                }
                Ok((index, measure(&subjects[index], &part)?))
            })
            .collect::<Result<_, CaseError>>()
    })?;
    let blank = |subject| Measured {
        subject,
        angles: Vec::new(),
        thickness: Vec::new(),
        levels: Vec::new(),
        surface: None,
    };
    let mut all: Vec<Measured> = subjects.into_iter().map(blank).collect();
    for (index, done) in done {
        match done {
            Done::Angles(angles) => all[index].angles = angles,
            Done::Thickness(m, totals) => all[index].thickness.push((m, totals)),
            Done::Level(level) => all[index].levels.push(level),
        }
    }
    Ok(all)
}

fn measure(subject: &Subject, part: &Part) -> Result<Done, AtlasError> {
    Ok(match part {
        Part::Angles => {
            let side = subject.measure()?;
            let at = |angle: usize| both(|wave| side.reflection(wave, angle as f64));
            Done::Angles((0..=STEEPEST).map(at).collect::<Result<_, _>>()?)
        }
        Part::Thickness(cells) => {
            let layer = subject.of_cells(*cells);
            Done::Thickness(layer.thickness(), totals(&layer.measure()?, OBLIQUE)?)
        }
        Part::Level(factor) => {
            let level = subject.on_cells(*factor);
            let side = level.measure()?;
            let mut angles = [[0.0; 2]; 4];
            for (out, angle) in angles.iter_mut().zip(EXTRAPOLATED) {
                *out = totals(&side, angle)?;
            }
            Done::Level(Level {
                h: level.h,
                oblique: totals(&side, OBLIQUE)?,
                angles,
            })
        }
    })
}

fn totals(side: &Side, angle: f64) -> Result<[f64; 2], AtlasError> {
    both(|wave| Ok(side.reflection(wave, angle)?.total(wave)))
}

fn both<T>(of: impl Fn(Wave) -> Result<T, AtlasError>) -> Result<[T; 2], AtlasError> {
    Ok([of(Wave::P)?, of(Wave::S)?])
}
