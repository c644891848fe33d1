//! What is true of the pipe's resistance, and what is claimed of the boundaries.
//!
//! The resistance is the force on the whole pipe over D s_u, twice what the half model gives, as the mean
//! over a window of its depth: the force of a single step is that of single nodes.

use super::PipePenetration;
use crate::scene::{Beside, Curve, OwnNumber, OwnPicture, SceneClaim};
use crate::spec::MaterialSpec;
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_reference::analytic::impact::Impact;
use anechoic_reference::analytic::slip_line::{Interface, bearing_factor, merifield_smooth};
use anechoic_reference::claim::{Accept, Claim, Evidence};
use anechoic_reports::norms::{first_departure, largest_departure, mean_around};
use anechoic_solver::record::{Record, Snapshot};

/// Depths w/D at which the resistance is stated.
const DEPTHS: [f64; 6] = [0.05, 0.1, 0.2, 0.3, 0.4, 0.5];
/// Half of the window of w/D over which the force is averaged.
const WINDOW: f64 = 0.01;
/// The same where two runs of one mesh are compared, whose roughness is the same until an echo comes.
const FINE: f64 = 0.002;
/// From this w/D on fluctuations are looked for: the impact itself is over.
const SETTLED: f64 = 0.1;
/// A resistance that has departed by this share of the undisturbed one has met an echo.
const DEPARTED: f64 = 0.05;

/// Depth w/D and resistance F/(D s_u) of a record.
struct Resistance {
    depth: Vec<f64>,
    force: Vec<f64>,
}

impl Resistance {
    fn of(scene: &PipePenetration, record: &Record) -> Option<Self> {
        let (way, force) = (
            record.bodies.column("pipe_wy")?,
            record.bodies.column("pipe_fy")?,
        );
        let unit = scene.pipe.diameter_m * scene.material.strength;
        Some(Resistance {
            depth: way.iter().map(|w| -w / scene.pipe.diameter_m).collect(),
            force: force.iter().map(|f| 2.0 * f / unit).collect(),
        })
    }

    fn at(&self, depth: f64) -> Result<f64, String> {
        mean_around(&self.depth, &self.force, depth, WINDOW).map_err(|error| error.to_string())
    }
}

/// Is the push slow enough for a plastic solution without inertia?
pub(super) fn is_slow(scene: &PipePenetration) -> bool {
    let v = scene.pipe.velocity_m_s;
    scene.material.elastic.rho_kg_m3 * v * v < 0.05 * scene.material.strength
}

/// Everything that is measured of the pipe.
pub(super) fn numbers(
    scene: &PipePenetration,
    run: &Record,
    beside: &Beside<'_>,
) -> Vec<OwnNumber> {
    let Some(own) = Resistance::of(scene, run) else {
        return Vec::new();
    };
    let mut numbers = Vec::new();
    let mut put = |metric: &'static str, place: String, value, against| {
        numbers.push(OwnNumber {
            metric,
            place,
            value,
            unit: "1",
            against,
        });
    };
    for depth in DEPTHS.into_iter().filter(|d| *d <= scene.pipe.depth) {
        let place = || format!("w/D={depth}");
        put("resistance", place(), own.at(depth), None);
        if !is_slow(scene) {
            continue;
        }
        let over = |truth: Result<f64, _>| {
            let truth = truth.map_err(
                |error: anechoic_reference::analytic::slip_line::EmbedmentError| error.to_string(),
            )?;
            Ok(own.at(depth)? / truth)
        };
        let slip_line = Some((Evidence::Analytic, "slip-line"));
        put(
            "resistance_ratio",
            place(),
            over(bearing_factor(Interface::Smooth, depth)),
            slip_line,
        );
        let fit = Some((Evidence::Paper, "Merifield 2009"));
        put(
            "resistance_ratio_fit",
            place(),
            over(merifield_smooth(depth)),
            fit,
        );
    }
    let h = scene.h();
    if let Some(inside) = run.bodies.column("pipe_in") {
        let deepest = inside.iter().copied().fold(0.0, f64::max) / h;
        put("penetration_cells", "pipe".to_owned(), Ok(deepest), None);
    }
    if let Some(last) = run.snapshots.last() {
        let top = -scene.pipe.depth * scene.pipe.diameter_m - h;
        let noise = checkerboard(
            last,
            [scene.body.width_m, top],
            scene.grid.cell(&scene.soil()),
        );
        put("checkerboard", "soil".to_owned(), noise, None);
    }
    if !is_slow(scene)
        && let Some(other) = beside.extended.and_then(|r| Resistance::of(scene, r))
    {
        let against = Some((Evidence::Certified, "extended-run"));
        let depths: Vec<f64> = own.depth.clone();
        let pair = (own.force.as_slice(), other.force.as_slice());
        let swing = |force: &[f64]| {
            let pair = (force, other.force.as_slice());
            largest_departure(&depths, pair, SETTLED, WINDOW).map_err(|e| e.to_string())
        };
        let largest = swing(&own.force);
        put("fluctuation", "pipe".to_owned(), largest.clone(), against);
        if let Some(standard) = beside.standard.and_then(|r| Resistance::of(scene, r)) {
            let echo = largest.and_then(|own| Ok(own / swing(&standard.force)?));
            put("echo_ratio", "pipe".to_owned(), echo, against);
        }
        let first = first_departure(&depths, pair, FINE, DEPARTED);
        if let Ok(Some(depth)) = first {
            put(
                "echo_depth",
                "pipe".to_owned(),
                Ok(depth),
                Some((Evidence::Analytic, "two ways at c_p")),
            );
        }
    }
    numbers
}

/// How far the pressures of cells with edges `h` (m) left of and below a corner (m) are from the means of the four
/// around them, over the pressures themselves, by root mean squares: 2 where they alternate, next to nothing where they are smooth.
fn checkerboard(snapshot: &Snapshot, corner: [f64; 2], h: [f64; 2]) -> Result<f64, String> {
    let column = snapshot.columns.iter().find(|column| column.name == "p");
    let p = &column.ok_or("the snapshot has no pressures")?.values;
    let [across, _, _] = snapshot.counts;
    if (0..2).any(|a| snapshot.spacing[a] > 1.5 * h[a]) {
        return Err("not every cell is recorded".to_owned());
    }
    // samples are the cells' lower corners
    let cells = |a: usize| (corner[a] - snapshot.origin[a]) / snapshot.spacing[a] + 1e-6;
    let [columns, rows] = [0, 1].map(|a| cells(a).floor() as usize);
    let columns = columns.min(across.saturating_sub(1));
    let (mut off, mut own) = (0.0, 0.0);
    for (i, j) in (1..rows.max(2) - 1).flat_map(|j| (1..columns.max(2) - 1).map(move |i| (i, j))) {
        let at = |i: usize, j: usize| p[j * across + i];
        let around = at(i - 1, j) + at(i + 1, j) + at(i, j - 1) + at(i, j + 1);
        off += (at(i, j) - 0.25 * around).powi(2);
        own += at(i, j).powi(2);
    }
    match own > 0.0 {
        true => Ok((off / own).sqrt()),
        false => Err("there is no pressure below the pipe".to_owned()),
    }
}

/// Depth w/D at which the pipe meets the echo of the base.
fn echo_depth(scene: &PipePenetration) -> Result<f64, String> {
    let MaterialSpec {
        youngs_modulus,
        nu,
        rho_kg_m3,
        ..
    } = scene.material.elastic;
    let soil = Elastic::new(youngs_modulus, nu, rho_kg_m3).map_err(|error| error.to_string())?;
    let impact = Impact::new(&soil, scene.pipe.velocity_m_s).map_err(|error| error.to_string())?;
    Ok(impact.way_to_echo(scene.body.height_m) / scene.pipe.diameter_m)
}

/// Resistance against depth.
pub(super) fn pictures(scene: &PipePenetration) -> Vec<OwnPicture> {
    let depths: Vec<f64> = (1..=50).map(|k| 0.01 * f64::from(k)).collect();
    let depths: Vec<f64> = depths
        .into_iter()
        .filter(|d| *d <= scene.pipe.depth)
        .collect();
    let factors = depths.iter().map(|d| bearing_factor(Interface::Smooth, *d));
    let truth = factors.collect::<Result<Vec<f64>, _>>().ok();
    let echo = echo_depth(scene).ok().filter(|_| !is_slow(scene));
    vec![OwnPicture {
        name: "resistance",
        title: "Resistance of the soil against the pipe",
        caption: "Force on the whole pipe over D s_u, as the mean over 0.01 D of its way. Grey: slip line, without inertia. Marked: when the echo of the base is due.",
        x: ("depth w/D", ""),
        y: ("F/(D s_u)", ""),
        truth: truth.map(|y| ("slip line", Curve { x: depths, y })),
        marks: echo
            .map(|d| (d, "echo of the base".to_owned()))
            .into_iter()
            .collect(),
    }]
}

/// The resistance of a run as the mean over windows that follow each other.
pub(super) fn curve(scene: &PipePenetration, run: &Record) -> Option<Curve> {
    let own = Resistance::of(scene, run)?;
    let windows = (scene.pipe.depth / WINDOW) as usize;
    let at = |k: usize| (k as f64 + 0.5) * WINDOW;
    let points = (0..windows).filter_map(|k| {
        let mean = mean_around(&own.depth, &own.force, at(k), 0.5 * WINDOW);
        Some((at(k), mean.ok()?))
    });
    let (x, y) = points.unzip();
    Some(Curve { x, y })
}

/// The claims, for the scene as run.
pub(super) fn claims(scene: &PipePenetration) -> Vec<SceneClaim> {
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
    if is_slow(scene) {
        for depth in DEPTHS
            .into_iter()
            .filter(|d| *d >= SETTLED && *d <= scene.pipe.depth)
        {
            let place = format!("w/D={depth}");
            claim(
                "fixed",
                "resistance_ratio",
                &place,
                Accept::at_least(0.95),
                Evidence::Analytic,
                "the slip line has no heave and no depth, which add",
            );
            claim(
                "fixed",
                "resistance_ratio_fit",
                &place,
                Accept::at_most(1.1),
                Evidence::Paper,
                "a fit to runs with heave, which lies above the slip line",
            );
        }
        return claims;
    }
    let certified = Evidence::Certified;
    for (method, most) in [
        ("dashpot", 0.05),
        ("damping-layer", 0.05),
        ("damping-layer-thick", 0.05),
        ("pml", 0.02),
    ] {
        claim(
            method,
            "fluctuation",
            "pipe",
            Accept::at_most(most),
            certified,
            "S21 section 3.3: local fluctuations within 5 % from w/D = 0.1 on; a true layer leaves less",
        );
    }
    if let Ok(depth) = echo_depth(scene)
        && depth < scene.pipe.depth
    {
        claim(
            "fixed",
            "echo_depth",
            "pipe",
            Accept::within(depth - 0.01, depth + 0.01),
            Evidence::Analytic,
            "the wave runs to the base and back at c_p while the pipe goes on",
        );
    }
    claims
}
