//! From reflections to rows: numbers, and the claims that closed forms make.
//!
//! `where` is `P@30deg` for all that comes back of P at 30 degrees (square root of the energy),
//! `P-S@30deg` for the amplitude of S that P becomes, with `:thickness=200m` or `:h=10m` behind it where
//! these were varied, and `:h=0` for what levels of cells extrapolate to; `Rayleigh` for surface waves.

use super::measure::{EXTRAPOLATED, Measured, OBLIQUE, STEEPEST};
use anechoic_reference::analytic::oblique::{ObliqueError, Wave};
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::judge::{Measurement, judge};
use anechoic_reports::row::Row;

/// The metric.
const METRIC: &str = "reflection";
/// Name of the reference in rows.
const REFERENCE: &str = "plane waves in the continuum";
/// Angles of rows and of those that tell P and S apart (degrees).
const EVERY: usize = 5;
const CONVERTED: usize = 15;
/// Angles at which the scene's own cells are judged (degrees).
const JUDGED: [usize; 3] = [0, 30, 60];
/// A closed form smaller than this is below what cells leave, and judges nothing.
const CLEAR: f64 = 0.01;

/// Rows of all methods, and notes on what could not be judged.
pub fn rows(case: &str, profile: &str, all: &[Measured]) -> (Vec<Row>, Vec<String>) {
    let (mut numbers, mut claims, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    for measured in all {
        numbers.extend(numbers_of(measured));
        for wave in Wave::BOTH {
            let mut add = |made: Result<Option<Claim>, String>| match made {
                Ok(claim) => claims.extend(claim),
                Err(error) => notes.push(format!("{}: {error}", measured.subject.name)),
            };
            for angle in JUDGED {
                add(on_cells(measured, wave, angle).map_err(|e| e.to_string()));
            }
            for index in 0..EXTRAPOLATED.len() {
                add(extrapolated(measured, wave, index));
            }
        }
    }
    (judge(case, profile, &numbers, &claims), notes)
}

fn place(wave: Wave, angle: f64) -> String {
    format!("{}@{angle}deg", wave.letter())
}

/// A length (m) without what rounding left.
fn metres(length: f64) -> f64 {
    (length * 1e6).round() / 1e6
}

fn numbers_of(measured: &Measured) -> Vec<Measurement> {
    let number = |place: String, value: f64| Measurement {
        method: measured.subject.name.clone(),
        metric: METRIC.to_owned(),
        place,
        value: Ok(value),
        unit: "1".to_owned(),
        against: Some((Evidence::Analytic, REFERENCE.to_owned())),
    };
    let mut out = Vec::new();
    let surface = measured.surface.iter();
    out.extend(surface.map(|value| number("Rayleigh".to_owned(), *value)));
    for wave in Wave::BOTH {
        for angle in (0..=STEEPEST).step_by(EVERY) {
            let at = place(wave, angle as f64);
            out.push(number(at, measured.total(wave, angle)));
            let reflection = &measured.angles[angle][wave as usize];
            for back in Wave::BOTH {
                let travels = reflection.flux[back as usize] > 0.0;
                if angle.is_multiple_of(CONVERTED) && travels {
                    let at = format!("{}-{}@{angle}deg", wave.letter(), back.letter());
                    out.push(number(at, reflection.amplitude(wave, back)));
                }
            }
        }
        let at = place(wave, OBLIQUE);
        for (thickness, totals) in &measured.thickness {
            let at = format!("{at}:thickness={}m", metres(*thickness));
            out.push(number(at, totals[wave as usize]));
        }
        for level in &measured.levels {
            let at = format!("{at}:h={}m", metres(level.h));
            out.push(number(at, level.oblique[wave as usize]));
        }
        for (index, angle) in EXTRAPOLATED.into_iter().enumerate() {
            if let Some((value, _)) = measured.extrapolated(wave, index) {
                out.push(number(format!("{}:h=0", place(wave, angle)), value));
            }
        }
    }
    out
}

/// On the scene's own cells: what ends the body is as exact as its mesh.
fn on_cells(measured: &Measured, wave: Wave, angle: usize) -> Result<Option<Claim>, ObliqueError> {
    let subject = &measured.subject;
    let turn = 2.0 * std::f64::consts::PI * subject.h / subject.wavelength(Wave::S);
    let (bound, why) = match subject.side.method.as_str() {
        "dashpot" | "damping-layer" => (
            turn * turn / 8.0,
            format!(
                "the mesh's own impedance is off by a share of (k h)²/8, k that of S, which leaves half of it head-on; twice that at any angle; k h = {turn:.3}"
            ),
        ),
        "fixed" | "free" | "roller" | "extended" => (
            1e-6,
            "an elastic body dissipates nothing, on any mesh".to_owned(),
        ),
        _ => return Ok(None),
    };
    let Some(closed) = subject.closed(wave, angle as f64).transpose()? else {
        return Ok(None);
    };
    Ok(Some(claim(
        measured,
        place(wave, angle as f64),
        closed,
        bound,
        why,
    )))
}

/// In the limit of fine cells, where a closed form is large enough to be told from what they leave, and
/// the limit is known to half the bound; otherwise a note says that it is not.
fn extrapolated(measured: &Measured, wave: Wave, index: usize) -> Result<Option<Claim>, String> {
    let (subject, angle) = (&measured.subject, EXTRAPOLATED[index]);
    let elastic = ["fixed", "free", "roller", "extended"].contains(&subject.side.method.as_str());
    let Some((_, uncertain)) = measured.extrapolated(wave, index).filter(|_| !elastic) else {
        return Ok(None);
    };
    let closed = subject.closed(wave, angle).transpose();
    let Some(closed) = closed.map_err(|e| e.to_string())?.filter(|r| *r >= CLEAR) else {
        return Ok(None);
    };
    let (place, bound) = (format!("{}:h=0", place(wave, angle)), 0.02 * closed);
    if uncertain > 0.5 * bound {
        return Err(format!(
            "{place} is not judged: the scene's cells are too coarse to tell its limit (some {uncertain:.1e} are open, and the closed form is {closed:.1e}); use a smaller grid.h_m"
        ));
    }
    let why = "halved cells leave a quarter of the error; what remains after extrapolation is of the fourth order, and three levels show it to be less than half of the 2 % accepted".to_owned();
    Ok(Some(claim(measured, place, closed, bound, why)))
}

fn claim(measured: &Measured, place: String, closed: f64, bound: f64, why: String) -> Claim {
    Claim {
        method: measured.subject.name.clone(),
        metric: METRIC.to_owned(),
        place,
        accept: Accept::within((closed - bound).max(0.0), closed + bound),
        evidence: Evidence::Analytic,
        why: format!("closed form {closed:.4}; {why}"),
    }
}
