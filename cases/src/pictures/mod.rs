//! Pictures of a study. Only complete runs are drawn; the report says which are not.

pub mod animation;
mod fields;
mod levels;
mod points;
mod stability;
mod trades;

use crate::judge::references::References;
use crate::judge::{traces, traces_of};
use crate::runner::Run;
use crate::scene::{Curve, OwnPicture, Quantity, Reference, Role};
use crate::study::Kind;
use anechoic_reports::norms::{
    NormError, ROUNDING_GROWTH, Trace, Traces, echo_series, energy_left, growth_rate_per_s,
    target_energy,
};
use anechoic_reports::plot::{
    BarPlot, Bars, Drawing, EchoPlot, EnergyPlot, Line, PlotError, TracePanel, TracePlot, WayPlot,
};
use anechoic_reports::ranking::Ranking;
use anechoic_reports::study::Upshot;
use thiserror::Error;

/// The reference's name in pictures.
const NO_ECHO: &str = "no echo";

/// A picture of the report.
#[derive(Debug)]
pub struct Picture {
    /// File name without extension.
    pub name: String,
    /// Title.
    pub title: String,
    /// What it shows and how to read it.
    pub caption: String,
    /// The picture.
    pub drawing: Drawing,
    /// A coloured field, which is small as pixels and large as SVG.
    pub raster: bool,
}

/// Why a picture cannot be made.
#[derive(Debug, Error)]
pub enum PictureError {
    /// The record does not serve.
    #[error(transparent)]
    Norm(#[from] NormError),
    /// The drawing fails.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// Runs are missing.
    #[error("{0}")]
    Incomplete(&'static str),
}

/// The pictures that could be made, and why others could not.
#[derive(Debug, Default)]
pub struct Gallery {
    /// The pictures.
    pub pictures: Vec<Picture>,
    /// What is missing from them, and why.
    pub notes: Vec<String>,
}

impl Gallery {
    /// Takes a picture in, or says which one is missing.
    fn add(&mut self, name: &str, made: Result<Option<Picture>, PictureError>) {
        match made {
            Ok(picture) => self.pictures.extend(picture),
            Err(error) => self.notes.push(missing(name, &error)),
        }
    }
}

/// The note of a picture that could not be made.
pub fn missing(name: &str, reason: &dyn std::fmt::Display) -> String {
    format!("the picture `{name}` could not be made: {reason}")
}

/// The pictures of what the runs of a study make together.
pub fn draw_upshot(upshot: &Upshot) -> Gallery {
    match upshot {
        Upshot::Convergence(refinement) => levels::draw_convergence(refinement),
        Upshot::Sweep(sweep) => points::draw_sweep(sweep),
        Upshot::Tradeoff(tradeoff) => trades::draw_tradeoff(tradeoff),
        Upshot::Stability(stability) => stability::draw_stability(stability),
    }
}

/// All pictures that the runs allow. One that cannot be made costs a note, not the others: the runs
/// are finished, and their numbers stand.
pub fn draw(runs: &[Run], kind: &Kind, ranking: &Ranking, references: &References) -> Gallery {
    let mut gallery = Gallery::default();
    let runs: Vec<&Run> = runs.iter().filter(|run| run.complete()).collect();
    let Some(first) = runs.first() else {
        return gallery;
    };
    if *kind == Kind::Ablation {
        gallery.add("ablation", parts(&runs, ranking));
        return gallery;
    }
    let reference = references
        .of(first)
        .ok()
        .and_then(|all| all.into_iter().find(|r| r.role == Role::NoEcho));
    gallery.add("receivers", series(&runs, reference.as_ref()).map(Some));
    if let Some(reference) = &reference {
        let echo = echo(&runs, reference, ranking, &mut gallery.notes);
        gallery.add("echo", echo);
    }
    for own in first.prepared.scene.pictures() {
        gallery.add(own.name, curves(&runs, &own));
    }
    gallery.add("ranking", bars(ranking));
    gallery.add("space-time", fields::space_time(&runs));
    gallery.add("snapshots", fields::snapshots(&runs, ranking, references));
    gallery.add("pressures", fields::pressures(&runs));
    gallery.add("energy", energy(&runs, references));
    gallery
}

/// A scene's own number, all methods over what is true.
fn curves(runs: &[&Run], own: &OwnPicture) -> Result<Option<Picture>, PictureError> {
    let line = |name: &str, curve: Curve| Line {
        name: name.to_owned(),
        x: curve.x,
        y: curve.y,
    };
    let of = |run: &&Run| {
        let curve = run.prepared.scene.curve(own.name, &run.record)?;
        Some(line(&run.manifest.method, curve))
    };
    let lines: Vec<Line> = runs.iter().filter_map(of).collect();
    if lines.is_empty() {
        return Ok(None);
    }
    let owned = |(name, unit): (&str, &str)| (name.to_owned(), unit.to_owned());
    let drawing = WayPlot {
        title: own.title.to_owned(),
        x: owned(own.x),
        y: owned(own.y),
        reference: own.truth.clone().map(|(name, curve)| line(name, curve)),
        lines,
        marks: own.marks.clone(),
    }
    .draw()?;
    Ok(Some(Picture {
        name: own.name.to_owned(),
        title: own.title.to_owned(),
        caption: own.caption.to_owned(),
        drawing,
        raster: false,
    }))
}

/// Receivers' series over the reference: velocities in the component that moves most, displacements
/// by their magnitude, as the papers show them.
fn series(runs: &[&Run], reference: Option<&Reference>) -> Result<Picture, PictureError> {
    let quantity = reference.map_or(Quantity::Velocity, |r| r.quantity);
    let unit = match quantity {
        Quantity::Displacement => "m",
        Quantity::Velocity => "m/s",
    };
    let truth = match reference {
        Some(reference) => Some(traces_of(reference, &runs[0].record)?),
        None => None,
    };
    let all = traces_of_runs(runs, quantity)?;
    let axis = strongest(&all[0].1);
    let shown = |trace: &Trace| match quantity {
        Quantity::Displacement => trace.magnitude(),
        Quantity::Velocity => trace.components[axis].clone(),
    };
    let line = |name: &str, traces: &Traces, receiver: usize| Line {
        name: name.to_owned(),
        x: traces.times().to_vec(),
        y: shown(&traces.receivers()[receiver]),
    };
    let panels = all[0]
        .1
        .receivers()
        .iter()
        .enumerate()
        .map(|(i, receiver)| TracePanel {
            title: place(runs[0], &receiver.name),
            reference: truth.as_ref().map(|t| line(NO_ECHO, t, i)),
            lines: all.iter().map(|(m, t)| line(m, t, i)).collect(),
        })
        .collect();
    let drawing = TracePlot {
        quantity: match quantity {
            Quantity::Displacement => "|u|".to_owned(),
            Quantity::Velocity => format!("velocity {}", ["x", "y", "z"][axis.min(2)]),
        },
        unit: unit.to_owned(),
        panels,
    }
    .draw()?;
    Ok(Picture {
        name: "receivers".into(),
        title: "Motion of the receivers".into(),
        caption: "All methods over the reference without echo; what departs from it is echo."
            .into(),
        drawing,
        raster: false,
    })
}

/// Echo against time; needs the standard run, and leaves receivers out where that one is silent.
fn echo(
    runs: &[&Run],
    reference: &Reference,
    ranking: &Ranking,
    notes: &mut Vec<String>,
) -> Result<Option<Picture>, PictureError> {
    let standard = runs
        .iter()
        .find(|run| run.manifest.method == run.prepared.info.standard);
    let Some(standard) = standard else {
        return Ok(None);
    };
    let standard = traces(&standard.record, reference.quantity)?;
    let (standard, silent) = without_silent(&standard)?;
    notes.extend(silent.iter().map(|receiver| {
        format!("the picture `echo` leaves out receiver {receiver}: the standard run is silent there, so that there is no ratio")
    }));
    if standard.receivers().is_empty() {
        return Ok(None);
    }
    let mut panels: Vec<(String, Vec<Line>)> = Vec::new();
    for run in runs {
        let truth = traces_of(reference, &run.record)?;
        let mine = traces(&run.record, reference.quantity)?;
        let (mine, truth) = (without(&mine, &silent)?, without(&truth, &silent)?);
        for (receiver, y) in echo_series(&mine, &truth, &standard)? {
            let title = place(run, &receiver);
            let line = Line {
                name: run.manifest.method.clone(),
                x: truth.times().to_vec(),
                y: envelope(&y),
            };
            match panels.iter_mut().find(|(name, _)| *name == title) {
                Some((_, lines)) => lines.push(line),
                None => panels.push((title, vec![line])),
            }
        }
    }
    let floor = ranking.floor.as_ref().map(|floor| floor.value);
    Ok(Some(Picture {
        name: "echo".into(),
        title: "Echo against time".into(),
        caption: "Distance to the reference without echo, over the standard run's peak, as the largest value of a fiftieth of the run. The line is the floor of the reference.".into(),
        drawing: EchoPlot { panels, floor }.draw()?,
        raster: false,
    }))
}

/// The receivers that move in the standard run, and the names of those that do not.
fn without_silent(standard: &Traces) -> Result<(Traces, Vec<String>), NormError> {
    let still = |trace: &&Trace| trace.magnitude().iter().all(|v| *v == 0.0);
    let silent = standard.receivers().iter().filter(still);
    let silent: Vec<String> = silent.map(|trace| trace.name.clone()).collect();
    Ok((without(standard, &silent)?, silent))
}

/// All receivers but some.
fn without(traces: &Traces, names: &[String]) -> Result<Traces, NormError> {
    let others = traces.receivers().iter();
    let others = others.filter(|trace| !names.contains(&trace.name));
    Traces::new(traces.times().to_vec(), others.cloned().collect())
}

/// The largest value of a fiftieth of the series around each sample: an echo that swings through zero
/// is not gone.
fn envelope(values: &[f64]) -> Vec<f64> {
    let reach = values.len() / 100;
    let around = |i: usize| {
        let window = &values[i.saturating_sub(reach)..(i + reach + 1).min(values.len())];
        window.iter().copied().fold(0.0, f64::max)
    };
    (0..values.len()).map(around).collect()
}

/// Echo of each method with its cost.
fn bars(ranking: &Ranking) -> Result<Option<Picture>, PictureError> {
    let ranked: Vec<_> = ranking
        .methods
        .iter()
        .filter(|m| m.echo.is_some())
        .collect();
    if ranked.is_empty() {
        return Ok(None);
    }
    let column = |title: &str, unit: &str, values: Vec<Option<f64>>| Bars {
        title: title.to_owned(),
        unit: unit.to_owned(),
        values,
    };
    let drawing = BarPlot {
        methods: ranked.iter().map(|m| m.method.clone()).collect(),
        echo: column("echo ratio", "", ranked.iter().map(|m| m.echo).collect()),
        worst: ranked.iter().map(|m| m.worst).collect(),
        floor: ranking.floor.as_ref().map(|floor| floor.value),
        costs: vec![
            column("CPU time", "s", ranked.iter().map(|m| m.cpu_s).collect()),
            column("unknowns", "", ranked.iter().map(|m| m.unknowns).collect()),
        ],
    }
    .draw()?;
    Ok(Some(Picture {
        name: "ranking".into(),
        title: "Echo and cost".into(),
        caption: "Echo ratio of each method (log axis; zero is perfect) with what it costs. Methods at or below the floor cannot be told apart.".into(),
        drawing,
        raster: false,
    }))
}

/// What each variant of a method leaves, in the order of the study: echo, and energy that stays.
fn parts(runs: &[&Run], ranking: &Ranking) -> Result<Option<Picture>, PictureError> {
    let ranked = |run: &Run| {
        let mut methods = ranking.methods.iter();
        methods.find(|m| m.method == run.manifest.method && m.echo.is_some())
    };
    let shown: Vec<_> = runs
        .iter()
        .filter_map(|run| Some((*run, ranked(run)?)))
        .collect();
    if shown.is_empty() {
        return Ok(None);
    }
    let left = |run: &Run| -> Option<f64> {
        let energy = &run.record.energy;
        let t1 = run.prepared.scene.windows().first()?.from_s;
        energy_left(&energy.times, &target_energy(energy).ok()?, t1).ok()
    };
    // Only growth that the rest of the run does not explain away; what decays has no bar.
    let growth = |run: &Run| -> Option<f64> {
        let energy = &run.record.energy;
        let slope = growth_rate_per_s(&energy.times, energy.column("total")?).ok()?;
        let sure = slope.interval.is_some_and(|[low, _]| low > ROUNDING_GROWTH);
        sure.then_some(slope.value)
    };
    let drawing = BarPlot {
        methods: shown.iter().map(|(_, m)| m.method.clone()).collect(),
        echo: Bars {
            title: "echo ratio".into(),
            unit: String::new(),
            values: shown.iter().map(|(_, m)| m.echo).collect(),
        },
        worst: shown.iter().map(|(_, m)| m.worst).collect(),
        floor: ranking.floor.as_ref().map(|floor| floor.value),
        costs: vec![
            Bars {
                title: "energy left".into(),
                unit: String::new(),
                values: shown.iter().map(|(run, _)| left(run)).collect(),
            },
            Bars {
                title: "energy grows by".into(),
                unit: "1/s".into(),
                values: shown.iter().map(|(run, _)| growth(run)).collect(),
            },
        ],
    }
    .draw()?;
    Ok(Some(Picture {
        name: "ablation".into(),
        title: "What each part absorbs".into(),
        caption: "Echo ratio of each variant (log axis; one is a fixed edge), the energy left in the target after t1, and how fast the total energy grows in the second half of the run, where it does.".into(),
        drawing,
        raster: false,
    }))
}

/// Energy in the target.
fn energy(runs: &[&Run], references: &References) -> Result<Option<Picture>, PictureError> {
    let runs: Vec<&&Run> = runs
        .iter()
        .filter(|run| !run.record.energy.times.is_empty())
        .collect();
    if runs.is_empty() {
        return Ok(None);
    }
    let lines = runs
        .iter()
        .map(|run| {
            Ok(Line {
                name: run.manifest.method.clone(),
                x: run.record.energy.times.clone(),
                y: target_energy(&run.record.energy)?,
            })
        })
        .collect::<Result<_, NormError>>()?;
    let truth = references
        .certified(runs[0])
        .map(|certified| &certified.energy);
    let reference = truth.filter(|table| !table.times.is_empty()).map(|table| {
        // A longer reference serves a shorter run.
        let end = runs[0].record.energy.times.last().copied().unwrap_or(0.0);
        let samples = table.times.partition_point(|t| *t <= end);
        let mut y = target_energy(table)?;
        y.truncate(samples);
        Ok::<_, NormError>(Line {
            name: NO_ECHO.to_owned(),
            x: table.times[..samples].to_vec(),
            y,
        })
    });
    let drawing = EnergyPlot {
        unit: "J/m".into(),
        reference: reference.transpose()?,
        lines,
    }
    .draw()?;
    Ok(Some(Picture {
        name: "energy".into(),
        title: "Energy in the body".into(),
        caption: "Kinetic and strain energy of the body; what a method absorbs is gone.".into(),
        drawing,
        raster: false,
    }))
}

fn traces_of_runs(runs: &[&Run], quantity: Quantity) -> Result<Vec<(String, Traces)>, NormError> {
    runs.iter()
        .map(|run| Ok((run.manifest.method.clone(), traces(&run.record, quantity)?)))
        .collect()
}

/// The component that moves most.
fn strongest(traces: &Traces) -> usize {
    let peak = |axis: usize| {
        traces
            .receivers()
            .iter()
            .flat_map(|trace| trace.components.get(axis).into_iter().flatten())
            .fold(0.0_f64, |m, v| m.max(v.abs()))
    };
    let axes = traces.receivers().first().map_or(1, |t| t.components.len());
    (0..axes)
        .max_by(|&a, &b| peak(a).total_cmp(&peak(b)))
        .unwrap_or(0)
}

/// Names and places (m) of the receivers.
fn receivers(run: &Run) -> Vec<(String, Vec<f64>)> {
    run.prepared.scene.posed().receivers()
}

/// A receiver's title.
fn place(run: &Run, name: &str) -> String {
    receivers(run)
        .into_iter()
        .find(|(receiver, _)| receiver == name)
        .map_or_else(
            || name.to_owned(),
            |(name, place)| {
                let along = ["x", "y", "z"].iter().zip(&place);
                let along: Vec<String> = along.map(|(axis, x)| format!("{axis} = {x} m")).collect();
                format!("{name} ({})", along.join(", "))
            },
        )
}
