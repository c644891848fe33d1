//! What is true of the blow, and what is claimed of the boundaries.
//!
//! The pressure on the mudmat is the force on it over its exposed height. Waves are looked for in the
//! component of the velocity that the wave's way to the receiver has most of: what the front's own collapse
//! does is slow, and mostly in the other. A wave arrives when the velocity has departed from the slide's by
//! half of what it departs at most before the echo; an echo is what departs from a straight line while it
//! passes, over the same of the wave itself.

use super::Mudmat;
use crate::scene::{Beside, Curve, OwnNumber, OwnPicture, SceneClaim};
use crate::spec::ReceiverSpec;
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_reference::analytic::impact::{Impact, Slide};
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::norms::mean_around;
use anechoic_solver::record::Record;

/// Share of the largest departure at which a wave counts as there.
const THERE: f64 = 0.5;
/// Before and after a wave's due time (s), in which it passes.
const PASSING: [f64; 2] = [0.01, 0.09];
/// Half of the window (s) in which the pressure's fluctuation about its mean is looked for, around the
/// echo of the top.
const AROUND: f64 = 0.05;
/// Half of the window (s) of the mean pressure.
const MEAN: f64 = 0.01;

/// Closed forms of the slide.
fn slide(scene: &Mudmat) -> Result<(Impact, Slide), String> {
    let m = &scene.material.elastic;
    let soil = Elastic::new(m.youngs_modulus, m.nu, m.rho_kg_m3).map_err(|e| e.to_string())?;
    let impact = Impact::new(&soil, scene.slide.velocity_m_s).map_err(|e| e.to_string())?;
    let (length, height) = (scene.body.width_m, scene.body.height_m);
    let slide = Slide::new(impact, length, height, scene.mudmat.exposed_m);
    Ok((impact, slide.map_err(|e| e.to_string())?))
}

/// How far a receiver's velocity departs from the slide's (m/s), in the component of the wave's way.
fn departure(scene: &Mudmat, record: &Record, receiver: &ReceiverSpec) -> Option<Vec<f64>> {
    let above = (receiver.y_m - scene.mudmat.exposed_m).max(0.0);
    let (axis, own) = match above > receiver.x_m.abs() {
        true => ("y", 0.0),
        false => ("x", scene.slide.velocity_m_s),
    };
    let v = record
        .receivers
        .column(&format!("{}_v{axis}", receiver.name))?;
    Some(v.iter().map(|v| v - own).collect())
}

/// When it first departs by a share of what it does at most until `until` (s).
fn arrival(times: &[f64], values: &[f64], until: f64) -> Result<f64, String> {
    let seen = times.partition_point(|t| *t <= until);
    let largest = values[..seen].iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    let first = values.iter().position(|v| v.abs() > THERE * largest);
    first
        .map(|k| times[k])
        .ok_or_else(|| "nothing arrives".to_owned())
}

/// Pressure on the mudmat (Pa) with its times.
fn pressure(scene: &Mudmat, record: &Record) -> Option<(Vec<f64>, Vec<f64>)> {
    let force = record.bodies.column("mudmat_fx")?;
    let pressure = force.iter().map(|f| f / scene.mudmat.exposed_m).collect();
    Some((record.bodies.times.clone(), pressure))
}

/// Largest departure of the pressure's mean from a straight line around `at` (s): what an echo does.
fn fluctuation((times, p): &(Vec<f64>, Vec<f64>), at: f64) -> Result<f64, String> {
    off_line((times, p), [at - AROUND, at + 2.0 * AROUND], MEAN)
}

/// Largest distance of the pressure's mean to that of the slide that goes on, around `at` (s): what comes from the
/// end alone.
fn distance(
    (times, p): &(Vec<f64>, Vec<f64>),
    (others, q): &(Vec<f64>, Vec<f64>),
    at: f64,
) -> Result<f64, String> {
    let steps = 60;
    let mut largest = 0.0_f64;
    for k in 0..=steps {
        let t = at - AROUND + 3.0 * AROUND * f64::from(k) / f64::from(steps);
        let own = mean_around(times, p, t, MEAN).map_err(|e| e.to_string())?;
        let other = mean_around(others, q, t, MEAN).map_err(|e| e.to_string())?;
        largest = largest.max((own - other).abs());
    }
    Ok(largest)
}

/// Largest departure from a straight line of the means over windows of twice `half` (s), between two times.
fn off_line(
    (times, values): (&[f64], &[f64]),
    [from, to]: [f64; 2],
    half: f64,
) -> Result<f64, String> {
    let mean = |t: f64| mean_around(times, values, t, half).map_err(|e| e.to_string());
    let (start, end) = (mean(from)?, mean(to)?);
    let steps = 30;
    let mut largest = 0.0_f64;
    for k in 0..=steps {
        let share = f64::from(k) / f64::from(steps);
        let line = start + share * (end - start);
        largest = largest.max((mean(from + share * (to - from))? - line).abs());
    }
    Ok(largest)
}

/// Everything that is measured of the slide.
pub(super) fn numbers(scene: &Mudmat, run: &Record, beside: &Beside<'_>) -> Vec<OwnNumber> {
    let Ok((_, slide)) = slide(scene) else {
        return Vec::new();
    };
    let mut numbers = Vec::new();
    let mut put = |metric: &'static str, place: &str, value, unit: &'static str, against| {
        numbers.push(OwnNumber {
            metric,
            place: place.to_owned(),
            value,
            unit,
            against,
        });
    };
    let analytic = Some((Evidence::Analytic, "wave paths at c_p"));
    let echo = slide.top_echo_at_step();
    for receiver in &scene.receivers {
        let Some(own) = departure(scene, run, receiver) else {
            continue;
        };
        let (upstream, height) = (-receiver.x_m, receiver.y_m);
        let back = slide.top_echo(upstream, height);
        let found = arrival(&run.receivers.times, &own, back);
        let late = found.map(|t| t - slide.direct(upstream, height));
        put("arrival_s", &receiver.name, late, "s", analytic);
        let [before, after] = PASSING;
        if back + after < scene.time.end_s {
            let passing = |at: f64| {
                let series = (run.receivers.times.as_slice(), own.as_slice());
                off_line(series, [at - before, at + after], 0.002)
            };
            let direct = slide.direct(upstream, height);
            let value = passing(back).and_then(|echo| Ok(echo / passing(direct)?));
            let paper = Some((Evidence::Paper, "S21 Fig. 8"));
            put("residual", &receiver.name, value, "1", paper);
        }
    }
    let Some(own) = pressure(scene, run) else {
        return numbers;
    };
    let rho_v2 = scene.material.elastic.rho_kg_m3 * scene.slide.velocity_m_s.powi(2);
    let first = own.1.iter().copied().fold(f64::NEG_INFINITY, f64::max) / rho_v2;
    put("peak_pressure", "mudmat", Ok(first), "rho v^2", None);
    for t in [0.2, 0.4, 0.5, 0.7, 0.9] {
        if t + MEAN <= scene.time.end_s {
            let value = mean_around(&own.0, &own.1, t, MEAN).map(|p| p / rho_v2);
            let value = value.map_err(|e| e.to_string());
            put("pressure", &format!("t={t}"), value, "rho v^2", None);
        }
    }
    if echo + 2.0 * AROUND + MEAN <= scene.time.end_s {
        let own_swing = fluctuation(&own, echo);
        put(
            "fluctuation",
            "mudmat",
            own_swing.clone().map(|f| f / rho_v2),
            "rho v^2",
            None,
        );
        let other = beside.standard.and_then(|s| pressure(scene, s));
        if let Some(other) = other {
            let ratio = fluctuation(&other, echo).and_then(|other| Ok(own_swing? / other));
            put(
                "fluctuation_ratio",
                "mudmat",
                ratio,
                "1",
                Some((Evidence::Paper, "S21 Fig. 6")),
            );
        }
    }
    let swing = |of: Option<&Record>, end: Option<&Record>| {
        let (of, end) = (pressure(scene, of?)?, pressure(scene, end?)?);
        Some(distance(&of, &end, echo))
    };
    if let Some(own) = swing(Some(run), beside.extended) {
        let against = Some((Evidence::Certified, "extended-run"));
        let over = own.clone().map(|own| own / rho_v2);
        put("echo", "mudmat", over, "rho v^2", against);
        if let Some(standard) = swing(beside.standard, beside.standard_extended) {
            let ratio = own.and_then(|own| Ok(own / standard?));
            put("echo_ratio", "mudmat", ratio, "1", against);
        }
    }
    if let Some(inside) = run.bodies.column("mudmat_in") {
        let deepest = inside.iter().copied().fold(0.0, f64::max) / scene.h();
        put("penetration_cells", "mudmat", Ok(deepest), "1", None);
    }
    numbers
}

/// Pressure against time.
pub(super) fn pictures(scene: &Mudmat) -> Vec<OwnPicture> {
    let mut marks = Vec::new();
    if let Ok((_, slide)) = slide(scene) {
        marks.push((slide.top_echo_at_step(), "echo of the top".to_owned()));
        marks.push((slide.far_echo_at_step(), "echo of the left end".to_owned()));
    }
    vec![OwnPicture {
        name: "pressure",
        title: "Pressure of the slide on the mudmat",
        caption: "Force over the exposed height and rho v^2, as the mean over 5 ms. Marked: when echoes are due.",
        x: ("time", "s"),
        y: ("p/(rho v^2)", ""),
        truth: None,
        marks,
    }]
}

/// The pressure of a run as the mean over windows that follow each other.
pub(super) fn curve(scene: &Mudmat, run: &Record) -> Option<Curve> {
    const SHOWN: f64 = 0.0025;
    let (times, p) = pressure(scene, run)?;
    let rho_v2 = scene.material.elastic.rho_kg_m3 * scene.slide.velocity_m_s.powi(2);
    let windows = (times.last()? / (2.0 * SHOWN)) as usize;
    let at = |k: usize| (2 * k + 1) as f64 * SHOWN;
    let points = (0..windows).filter_map(|k| {
        let mean = mean_around(&times, &p, at(k), SHOWN);
        Some((at(k), mean.ok()? / rho_v2))
    });
    let (x, y) = points.unzip();
    Some(Curve { x, y })
}

/// The claims, for the scene as run.
pub(super) fn claims(scene: &Mudmat) -> Vec<SceneClaim> {
    let mut claims = Vec::new();
    let mut claim = |method: &str, metric: &str, place: &str, accept, evidence, why: &str| {
        claims.push(SceneClaim {
            not_here: None,
            claim: Claim {
                method: method.to_owned(),
                metric: metric.to_owned(),
                place: place.to_owned(),
                accept,
                evidence,
                why: why.to_owned(),
            },
        });
    };
    for receiver in &scene.receivers {
        claim(
            "none",
            "arrival_s",
            &receiver.name,
            Accept::within(-0.03, 0.03),
            Evidence::Analytic,
            "the blow runs from the mudmat's face at c_p",
        );
    }
    claim(
        "dashpot",
        "residual",
        "B",
        Accept::at_most(0.1),
        Evidence::Paper,
        "S21 section 3.2.2: the echo of the top below 10 % of the wave itself",
    );
    for method in ["hybrid", "hybrid-rate"] {
        claim(
            method,
            "echo_ratio",
            "mudmat",
            Accept::at_most(0.2),
            Evidence::Certified,
            "a fifth of what the left end adds to the pressure of a slide that goes on",
        );
    }
    claims
}
