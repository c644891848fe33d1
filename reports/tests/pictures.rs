//! Every kind of picture from plausible data: structure of the SVG, size of the PNG, refusals.
//!
//! With `ANECHOIC_PICTURES=DIR` in the environment the PNGs are also written there, to look at.

use anechoic_reports::plot::*;
use anechoic_solver::record::{Column, Snapshot, SpaceTime};
use std::f64::consts::PI;

const METHODS: [(&str, f64); 5] = [
    ("roller", -1.0),
    ("dashpot", 0.006),
    ("damping-layer", 0.05),
    ("extended", 0.0),
    ("pml", 0.0026),
];
const SPEED: f64 = 62.844;
const HEIGHT: f64 = 50.0;

fn pulse(t: f64) -> f64 {
    if (0.0..=0.5).contains(&t) {
        (2.0 * PI * t).sin()
    } else {
        0.0
    }
}

/// d'Alembert's velocity at height `y` over a base that reflects with `r` under a top that is free.
fn velocity(t: f64, y: f64, r: f64) -> f64 {
    let period = 2.0 * HEIGHT / SPEED;
    (0..5)
        .map(|n| {
            let down = pulse(t - f64::from(n) * period - (HEIGHT - y) / SPEED);
            let up = pulse(t - f64::from(n) * period - (HEIGHT + y) / SPEED);
            r.powi(n) * (down + r * up)
        })
        .sum()
}

fn times() -> Vec<f64> {
    (0..=1000).map(|i| f64::from(i) * 0.005).collect()
}

fn line(name: &str, f: impl Fn(f64) -> f64) -> Line {
    Line {
        name: name.to_owned(),
        x: times(),
        y: times().into_iter().map(f).collect(),
    }
}

fn traces() -> TracePlot {
    let panel = |title: &str, y: f64| TracePanel {
        title: title.to_owned(),
        reference: Some(line("d'Alembert (absorbing)", |t| velocity(t, y, 0.0))),
        lines: METHODS
            .iter()
            .map(|(name, r)| line(name, |t| velocity(t, y, *r)))
            .collect(),
    };
    TracePlot {
        quantity: "velocity".to_owned(),
        unit: "m/s".to_owned(),
        panels: vec![panel("A (height 50 m)", 50.0), panel("B (height 5 m)", 5.0)],
    }
}

fn many_traces() -> TracePlot {
    let receivers = [
        "A1", "A2", "A3", "A4", "B1", "B2", "B3", "B4", "C1", "C2", "C3",
    ];
    let panels = receivers
        .iter()
        .enumerate()
        .map(|(i, name)| {
            let y = 50.0 - 4.0 * i as f64;
            TracePanel {
                title: (*name).to_owned(),
                reference: Some(line("extended", |t| 2e-7 * velocity(t, y, 0.0))),
                lines: METHODS
                    .iter()
                    .filter(|(m, _)| *m != "extended")
                    .map(|(m, r)| line(m, |t| 2e-7 * velocity(t, y, *r)))
                    .collect(),
            }
        })
        .collect();
    TracePlot {
        quantity: "displacement".to_owned(),
        unit: "m".to_owned(),
        panels,
    }
}

fn echo() -> EchoPlot {
    let panel = |title: &str, y: f64| {
        let lines = METHODS
            .iter()
            .map(|(name, r)| {
                let noise = if *name == "extended" { 0.0 } else { 3e-6 };
                line(name, |t| {
                    (velocity(t, y, *r) - velocity(t, y, 0.0)).abs() / 2.0
                        + noise * (1.1 + (9.0 * t).sin()) * t
                })
            })
            .collect();
        (title.to_owned(), lines)
    };
    EchoPlot {
        panels: vec![panel("A (height 50 m)", 50.0), panel("B (height 5 m)", 5.0)],
        floor: Some(2e-4),
    }
}

fn energy() -> EnergyPlot {
    let energy = |t: f64, r: f64| {
        let sum: f64 = (0..50)
            .map(|i| velocity(t, f64::from(i) + 0.5, r).powi(2))
            .sum();
        325.0 * sum + 1e-9
    };
    EnergyPlot {
        unit: "J/m".to_owned(),
        reference: Some(line("d'Alembert (absorbing)", |t| energy(t, 0.0))),
        lines: METHODS
            .iter()
            .map(|(name, r)| line(name, |t| energy(t, *r)))
            .collect(),
    }
}

fn bars() -> BarPlot {
    let some = |values: &[f64]| values.iter().copied().map(Some).collect::<Vec<_>>();
    BarPlot {
        methods: ["pml", "dashpot", "damping-layer", "pml-stretched", "roller"]
            .map(str::to_owned)
            .to_vec(),
        echo: Bars {
            title: "Echo ratio".to_owned(),
            unit: String::new(),
            values: some(&[0.0021, 0.0061, 0.042, 0.11, 1.0]),
        },
        worst: some(&[0.0026, 0.0063, 0.089, 0.15, 1.19]),
        floor: Some(2e-4),
        costs: vec![
            Bars {
                title: "CPU time".to_owned(),
                unit: "s".to_owned(),
                values: vec![Some(1.42), Some(0.96), Some(1.2), None, Some(0.94)],
            },
            Bars {
                title: "Unknowns".to_owned(),
                unit: String::new(),
                values: some(&[142.0, 102.0, 102.0, 122.0, 60_700.0]),
            },
        ],
    }
}

fn space_time() -> SpaceTimePlot {
    let times: Vec<f64> = (0..=250).map(|i| f64::from(i) * 0.02).collect();
    // From top to bottom, as a line probe may run.
    let positions: Vec<f64> = (0..=50).map(|i| 50.0 - f64::from(i)).collect();
    let field = |r: f64| SpaceTime {
        name: "vy".to_owned(),
        unit: "m/s".to_owned(),
        positions: positions.clone(),
        axis: "height y".to_owned(),
        times: times.clone(),
        values: times
            .iter()
            .flat_map(|t| positions.iter().map(move |y| -velocity(*t, *y, r)))
            .collect(),
    };
    let guide = |position, label: &str| Guide {
        position,
        label: label.to_owned(),
        method: None,
    };
    SpaceTimePlot {
        quantity: "velocity".to_owned(),
        fields: METHODS
            .iter()
            .map(|(name, r)| ((*name).to_owned(), field(*r)))
            .collect(),
        guides: vec![guide(50.0, "A"), guide(5.0, "B"), guide(10.0, "layer")],
        limit: None,
    }
}

fn snapshot(time: f64, echo: f64) -> Snapshot {
    let counts = [81, 61, 1];
    let samples = || {
        (0..counts[1]).flat_map(move |iy| {
            (0..counts[0]).map(move |ix| (ix as f64 * 50.0, -3000.0 + iy as f64 * 50.0))
        })
    };
    let ring = move |(x, y): (f64, f64)| {
        let distance = (x - 1500.0).hypot(y);
        let back = (x - 2500.0).hypot(y);
        let wave = |d: f64, t: f64| (-((d - 1000.0 * t) / 150.0).powi(2)).exp() / (1.0 + d / 400.0);
        2e-6 * (wave(distance, time) + echo * wave(back, time - 1.0))
    };
    let column = |name: &str, share: f64| Column {
        name: name.to_owned(),
        unit: "m".to_owned(),
        values: samples().map(|p| share * ring(p)).collect(),
    };
    Snapshot {
        time,
        counts,
        origin: [0.0, -3000.0, 0.0],
        spacing: [50.0, 50.0, 1.0],
        columns: vec![column("ux", 0.6), column("uy", 0.8)],
    }
}

fn snapshots() -> SnapshotPlot {
    let methods = [("fixed", 0.8), ("pml-stretched", 0.2), ("pml", 0.01)];
    SnapshotPlot {
        quantity: "displacement |u|".to_owned(),
        unit: "m".to_owned(),
        methods: methods.iter().map(|(name, _)| (*name).to_owned()).collect(),
        rows: [0.8, 1.6, 2.4]
            .iter()
            .map(|t| {
                let fields = methods.iter().map(|(_, echo)| {
                    Field::magnitude(&snapshot(*t, *echo), &["ux", "uy"]).expect("whole")
                });
                (*t, fields.collect())
            })
            .collect(),
        meshes: vec![[[0.0, -3000.0], [4000.0, 0.0]]; 3],
        extent: [[800.0, -2200.0], [3200.0, 0.0]],
    }
}

fn convergence() -> ConvergencePlot {
    let series = |name: &str, scale: f64, order: f64| ConvergenceSeries {
        name: name.to_owned(),
        h: vec![4.0, 2.0, 1.0, 0.5],
        errors: [4.0f64, 2.0, 1.0, 0.5]
            .map(|h| scale * h.powf(order))
            .to_vec(),
        order: Some(order),
    };
    ConvergencePlot {
        quantity: "rel_l2".to_owned(),
        series: vec![
            series("sin² pulse", 0.01, 1.97),
            series("half sine", 0.03, 1.03),
        ],
        refined: "cell size h (m)".to_owned(),
        slope: 2.0,
    }
}

/// Checks both forms of a drawing, and that the SVG shows the `texts`.
fn look(name: &str, drawing: Result<Drawing, PlotError>, texts: &[&str]) {
    let drawing = drawing.unwrap_or_else(|e| panic!("{name}: {e}"));
    let svg = drawing.to_svg().expect("drawable");
    for text in texts {
        assert!(svg.contains(text), "{name} does not show {text}");
    }
    let bytes = drawing.to_png().expect("drawable");
    let mut reader = png::Decoder::new(bytes.as_slice())
        .read_info()
        .expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size()];
    let info = reader.next_frame(&mut pixels).expect("one frame");
    let (width, height) = drawing.size();
    assert_eq!((info.width, info.height), (2 * width, 2 * height));
    assert!(pixels.iter().any(|p| *p < 0x40), "{name} shows no ink");
    if let Ok(folder) = std::env::var("ANECHOIC_PICTURES") {
        std::fs::write(format!("{folder}/{name}.png"), bytes).expect("the folder exists");
        std::fs::write(format!("{folder}/{name}.svg"), svg).expect("the folder exists");
    }
}

#[test]
fn traces_show_every_receiver_and_method() {
    let texts = [
        "A (height 50 m)",
        "B (height 5 m)",
        "velocity (m/s)",
        "time (s)",
        "damping-layer",
        "d&apos;Alembert (absorbing)",
    ];
    look("traces", traces().draw(), &texts);
    look("many_traces", many_traces().draw(), &["A1", "C3", "10⁻⁹ m"]);
}

#[test]
fn echo_has_decades_and_its_floor() {
    look("echo", echo().draw(), &["10⁻⁴", "echo / peak", "floor"]);
    look("energy", energy().draw(), &["energy (J/m)", "time (s)"]);
}

#[test]
fn bars_show_values_and_costs() {
    let texts = ["Echo ratio", "CPU time", "0.00210", "1.42 s", "floor", "–"];
    look("bars", bars().draw(), &texts);
}

#[test]
fn fields_share_a_scale() {
    let texts = ["height y (m)", "velocity (m/s)", "layer", "dashpot"];
    look("space_time", space_time().draw(), &texts);
    let texts = ["t = 0.8 s", "pml-stretched", "displacement |u| (10⁻⁹ m)"];
    look("snapshots", snapshots().draw(), &texts);
}

#[test]
fn convergence_states_its_orders() {
    let texts = ["sin² pulse, order 1.97", "cell size h (m)", "rel_l2"];
    look("convergence", convergence().draw(), &texts);
}

#[test]
fn pictures_are_deterministic() {
    let bytes = |plot: SpaceTimePlot| {
        let drawing = plot.draw().expect("drawable");
        (drawing.to_svg(), drawing.to_png())
    };
    assert_eq!(bytes(space_time()), bytes(space_time()));
}

#[test]
fn damaged_data_are_refused() {
    let mut nan = traces();
    nan.panels[1].lines[0].y[3] = f64::NAN;
    assert!(matches!(nan.draw(), Err(PlotError::NonFinite { .. })));
    let mut short = traces();
    short.panels[0].lines[2].y.pop();
    assert!(matches!(short.draw(), Err(PlotError::Shape { .. })));
    let mut field = space_time();
    field.fields[0].1.values.pop();
    assert!(matches!(field.draw(), Err(PlotError::Shape { .. })));
    let mut none = bars();
    none.methods.clear();
    assert!(matches!(none.draw(), Err(PlotError::Empty { .. })));
    let mut few = bars();
    few.worst.pop();
    assert!(matches!(few.draw(), Err(PlotError::Shape { .. })));
    let mut zero = convergence();
    zero.series[0].errors[0] = 0.0;
    assert!(matches!(zero.draw(), Err(PlotError::Empty { .. })));
    let mut rows = snapshots();
    rows.rows[0].1.pop();
    assert!(matches!(rows.draw(), Err(PlotError::Shape { .. })));
    let missing = Field::magnitude(&snapshot(1.0, 0.0), &["vx"]);
    assert!(matches!(missing, Err(PlotError::Empty { .. })));
}

/// A frame as it is shown: what it changes on top of what was shown before.
fn play(file: &[u8]) -> (Vec<Vec<u8>>, usize, Vec<u8>) {
    let mut decoder = gif::DecodeOptions::new();
    decoder.set_color_output(gif::ColorOutput::Indexed);
    let mut decoder = decoder.read_info(file).expect("a GIF");
    let table = decoder.global_palette().expect("one table").to_vec();
    let width = usize::from(decoder.width());
    let mut shown = vec![255; width * usize::from(decoder.height())];
    let mut frames = Vec::new();
    while let Some(frame) = decoder.read_next_frame().expect("whole") {
        let across = usize::from(frame.width);
        for (row, values) in frame.buffer.chunks_exact(across).enumerate() {
            let start = (usize::from(frame.top) + row) * width + usize::from(frame.left);
            shown[start..start + across].copy_from_slice(values);
        }
        frames.push(shown.clone());
    }
    (frames, width, table)
}

#[test]
fn an_animation_has_a_frame_a_time_and_one_scale() {
    // The same field three times, the last time weaker.
    let mut plot = snapshots();
    let fields = plot.rows[0].1.clone();
    for ((_, row), factor) in plot.rows.iter_mut().zip([1.0, 1.0, 0.1]) {
        *row = fields.clone();
        let values = row.iter_mut().flat_map(|field| &mut field.values);
        values.for_each(|v| *v *= factor);
    }
    let file = plot.to_gif().expect("drawable");
    let (frames, width, table) = play(&file);
    assert_eq!(frames.len(), 3);
    assert_eq!(table[..3], [0x44, 0x01, 0x54], "viridis starts dark");
    // 201 colours of the map, then greys. Left of the colour bar, below the headlines, above the axis:
    let height = frames[0].len() / width;
    let largest = |frame: &[u8]| {
        let rows = (40..height - 45).flat_map(|row| &frame[row * width + 98..row * width + 790]);
        rows.copied().filter(|level| *level <= 200).max()
    };
    // A hundredth of all values is beyond the scale; pixels lie between nodes, where the field is a
    // little smaller.
    let fields = plot.rows.iter().flat_map(|(_, fields)| fields);
    let mut values: Vec<f64> = fields.flat_map(|f| &f.values).copied().collect();
    values.sort_by(f64::total_cmp);
    let (end, peak) = (values[values.len() * 99 / 100], values[values.len() - 1]);
    assert!(end < peak && peak < 10.0 * end);
    assert_eq!(largest(&frames[0]), Some(200));
    let level = 200.0 * 0.1 * peak / end;
    let weak = f64::from(largest(&frames[2]).expect("a field"));
    assert!(
        weak <= level.round() && weak > 0.85 * level,
        "{weak} {level}"
    );
    // Frames of the same field differ in their time alone, which stands above the colour bar.
    let differ = |at: usize| frames[0][at] != frames[1][at];
    let changed: Vec<usize> = (0..width * height).filter(|at| differ(*at)).collect();
    assert!(!changed.is_empty());
    assert!(
        changed
            .iter()
            .all(|at| at / width < 22 && at % width >= 808)
    );
    if let Ok(folder) = std::env::var("ANECHOIC_PICTURES") {
        let path = std::path::Path::new(&folder).join("animation.gif");
        std::fs::write(path, file).expect("writable");
    }
}

#[test]
fn an_animation_of_damaged_fields_is_refused() {
    let mut damaged = snapshots();
    damaged.rows[1].1[2].values[7] = f64::NAN;
    assert!(matches!(damaged.to_gif(), Err(PlotError::NonFinite { .. })));
    damaged.rows.clear();
    assert!(matches!(damaged.to_gif(), Err(PlotError::Empty { .. })));
}
