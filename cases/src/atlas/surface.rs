//! Reflection of surface waves, from runs in time: a Rayleigh wave has a depth of its own, so that no
//! strip of one row says all.
//!
//! A force on the surface of a half-space, in the plane of mirror symmetry, sends a Ricker pulse to the
//! right; after four wavelengths the surface moves by the Rayleigh wave and little else. A receiver
//! there, one wavelength before the side, sees it pass and come back. The same run with so much material
//! beyond the side that nothing returns is what passes; the difference is what comes back. The body is
//! so deep that its bottom is not heard of.

use super::AtlasError;
use super::subject::Subject;
use crate::error::CaseError;
use crate::progress;
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::probe::{Probes, Receiver};
use anechoic_solver::problem::{Aabb, Drive, Problem};
use anechoic_solver::record::Record;
use anechoic_solver::wavelet::{Pulse, Wavelet};
use anechoic_solver::{Monitor, solve};
use rayon::prelude::*;

/// Wavelengths from the force to the side and to the receiver.
const SIDE: f64 = 5.0;
const RECEIVER: f64 = 4.0;
/// Periods from the start of the pulse to its middle.
const MIDDLE: f64 = 1.2;
const NAME: &str = "R";

/// Geometry and times that all runs share.
#[derive(Clone, Copy, Debug)]
struct Layout {
    /// Length of the Rayleigh wave (m).
    wavelength: f64,
    /// From when on (s) it can be back.
    back: f64,
    /// End of the runs (s): it is back from the end of the thickest layer.
    end: f64,
    /// Distance that P makes in a run (m).
    reach: f64,
}

impl Layout {
    fn new(subjects: &[Subject], solid: &Elastic, frequency: f64) -> Self {
        let speed = solid.rayleigh_speed();
        let wavelength = speed / frequency;
        let thickest = subjects.iter().map(Subject::thickness).fold(0.0, f64::max);
        let back = (2.0 * SIDE - RECEIVER) * wavelength / speed;
        let end = back + 2.0 * thickest / speed + 2.0 * MIDDLE / frequency;
        Layout {
            wavelength,
            back,
            end,
            reach: solid.p_speed() * end,
        }
    }

    /// The half-space with `side` at its right.
    fn problem(&self, subject: &Subject, side: SideMethod) -> Problem<2> {
        let h = subject.h;
        let whole = |length: f64| h * (length / h).ceil();
        let [name, fixed, roller, free] = [NAME, "fixed", "roller", "free"];
        let below = whole(0.5 * self.reach) + 10.0 * h;
        Problem {
            target: Aabb {
                lower: [0.0, -below],
                upper: [whole(SIDE * self.wavelength), 0.0],
            },
            end_time: self.end,
            sides: [
                [SideMethod::new(roller), side],
                [SideMethod::new(fixed), SideMethod::new(free)],
            ],
            drives: vec![Drive::PointForce {
                place: [0.0; 2],
                direction: [0.0, -1.0],
                pulse: Pulse {
                    wavelet: Wavelet::Ricker,
                    amplitude: 1.0,
                    frequency: subject.frequency,
                    t0: MIDDLE / subject.frequency,
                },
            }],
            probes: Probes {
                receivers: vec![Receiver {
                    name: name.into(),
                    place: [RECEIVER * self.wavelength, 0.0],
                }],
                ..Probes::default()
            },
            ..subject.resting()
        }
    }

    /// So much material beyond the side that not even P is back.
    fn without_echo(&self, subject: &Subject) -> Problem<2> {
        let way = (2.0 * SIDE - RECEIVER) * self.wavelength;
        let beyond = (0.5 * (self.reach - way)).max(0.0) + 10.0 * subject.h;
        self.problem(
            subject,
            SideMethod::new("extended").with("thickness_m", beyond),
        )
    }
}

/// What comes back of a Rayleigh wave from each subject's side: the largest displacement once it can be
/// back, over that of the wave that passed. `jobs` runs at a time.
///
/// # Errors
/// A run that cannot be set up or fails; [`CaseError::Stopped`].
pub fn measure(subjects: &[Subject], jobs: usize) -> Result<Vec<f64>, CaseError> {
    let Some(first) = subjects.first() else {
        return Ok(Vec::new());
    };
    let layout = Layout::new(subjects, &first.solid(), first.frequency);
    let sides = subjects.iter().map(|s| layout.problem(s, s.side.clone()));
    let problems: Vec<Problem<2>> = std::iter::once(layout.without_echo(first))
        .chain(sides)
        .collect();
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(jobs)
        .build()
        .map_err(|error| CaseError::Usage(format!("--jobs {jobs}: {error}")))?;
    let records = pool.install(|| {
        let problems = problems.par_iter().with_max_len(1);
        problems.map(run).collect::<Result<Vec<_>, _>>()
    })?;
    let [passed, others @ ..] = records.as_slice() else {
        return Ok(Vec::new());
    };
    let reflections = others
        .iter()
        .map(|record| returned(record, passed, layout.back));
    Ok(reflections.collect::<Result<_, _>>()?)
}

/// Lets a run go on until a stop is asked for.
struct UntilStopped;

impl Monitor for UntilStopped {
    fn step(&self, _done: usize, _total: usize) -> bool {
        !progress::stopped()
    }
}

fn run(problem: &Problem<2>) -> Result<Record, CaseError> {
    let outcome = solve(problem, &UntilStopped)?;
    match outcome.error {
        Some(error) => Err(error.into()),
        None if progress::stopped() => Err(CaseError::Stopped("the reflection atlas".into())),
        None => Ok(outcome.record),
    }
}

/// Largest distance of two records from `back` (s) on, over the largest displacement of the second.
fn returned(record: &Record, passed: &Record, back: f64) -> Result<f64, AtlasError> {
    let columns = |record: &Record| {
        let column = |c: &str| {
            record
                .receivers
                .column(&format!("{NAME}_{c}"))
                .map(<[f64]>::to_vec)
        };
        column("ux").zip(column("uy"))
    };
    let missing = AtlasError::Degenerate("the surface's motion");
    let (Some((x, y)), Some((px, py))) = (columns(record), columns(passed)) else {
        return Err(missing);
    };
    let (mut echo, mut peak) = (0.0_f64, 0.0_f64);
    for (n, time) in record.receivers.times.iter().enumerate() {
        peak = peak.max(px[n].hypot(py[n]));
        if *time >= back {
            echo = echo.max((x[n] - px[n]).hypot(y[n] - py[n]));
        }
    }
    if peak > 0.0 {
        Ok(echo / peak)
    } else {
        Err(missing)
    }
}
