//! Fills a record while the model moves. Velocities and places are recorded as seen from the grid's place at the
//! start, whatever the model's frame; lines alone go along with it.

use crate::basis::Sample;
use crate::physics::flowing::Flowing;
use crate::physics::model::Model;
use crate::problem::Problem;
use crate::record::{Column, Record, SeriesTable, Snapshot, SpaceTime};
use crate::tensor::Vector;

const AXES: [&str; 3] = ["x", "y", "z"];

/// What is recorded of a rigid body.
const BODY: [(&str, &str); 5] = [
    ("fx", "N"),
    ("fy", "N"),
    ("wx", "m"),
    ("wy", "m"),
    ("in", "m"),
];

/// A tracer with its nodes.
struct Tracer<const D: usize> {
    place: Vector<D>,
    displacement: Vector<D>,
    sample: Sample,
}

/// Samples what the problem's probes ask for.
pub(crate) struct Sampler<const D: usize> {
    tracers: Vec<Tracer<D>>,
    lines: Vec<Vec<Sample>>,
    snapshots: Vec<f64>,
    /// The body's nodes: the first and how many along each axis, and what each place sees.
    first: [usize; D],
    counts: [usize; D],
    body: Vec<Sample>,
}

impl<const D: usize> Sampler<D> {
    /// Prepares `record` for the problem's probes.
    pub(crate) fn new(problem: &Problem<D>, model: &Model<D>, record: &mut Record) -> Self {
        let probes = &problem.probes;
        let samples = room(problem.steps());
        record.receivers.times.reserve(samples);
        let tracers = probes.receivers.iter().map(|r| Tracer {
            place: r.place,
            displacement: [0.0; D],
            sample: model.disc.sample(&r.place),
        });
        for receiver in &probes.receivers {
            for (quantity, unit) in [("u", "m"), ("v", "m/s")] {
                for axis in &AXES[..D] {
                    push(
                        &mut record.receivers,
                        format!("{}_{quantity}{axis}", receiver.name),
                        unit,
                        samples,
                    );
                }
            }
        }
        if let Some(every) = probes.energy_every {
            let samples = room(problem.steps() / every);
            record.energy.times.reserve(samples);
            for name in ["kinetic", "strain", "total"] {
                push(&mut record.energy, name.to_owned(), "J", samples);
            }
            for axis in &AXES[..D] {
                push(
                    &mut record.energy,
                    format!("momentum_{axis}"),
                    "kg m/s",
                    samples,
                );
            }
        }
        for reading in model.terms.iter().filter_map(|term| term.reading()) {
            for (quantity, unit) in BODY {
                let name = format!("{}_{quantity}", reading.name);
                push(&mut record.bodies, name, unit, samples);
            }
        }
        let lines = probes.lines.iter().map(|line| {
            let place = |k: usize| {
                let s = k as f64 / (line.samples - 1) as f64;
                std::array::from_fn(|a| line.from[a] + s * (line.to[a] - line.from[a]))
            };
            let axis = (0..D).max_by(|&a, &b| {
                let span = |a: usize| (line.to[a] - line.from[a]).abs();
                span(a).total_cmp(&span(b))
            });
            let axis = axis.unwrap_or(0);
            record.lines.push(SpaceTime {
                name: format!("v{}", AXES[line.component]),
                unit: "m/s".to_owned(),
                positions: (0..line.samples).map(|k| place(k)[axis]).collect(),
                axis: AXES[axis].to_owned(),
                times: Vec::with_capacity(room(problem.steps() / line.every)),
                values: Vec::with_capacity(line.samples * room(problem.steps() / line.every)),
            });
            (0..line.samples)
                .map(|k| model.disc.sample(&place(k)))
                .collect()
        });
        let grid = &model.grid;
        let index = |x: f64, a: usize| ((x - grid.origin[a]) / grid.h[a]).round() as usize;
        let first = std::array::from_fn(|a| index(problem.target.lower[a], a));
        let counts: [usize; D] =
            std::array::from_fn(|a| index(problem.target.upper[a], a) - first[a] + 1);
        let shown = match probes.snapshot_times.is_empty() || model.flow.is_some() {
            true => 0,
            false => counts.iter().product(),
        };
        let place = |k: usize| {
            let mut rest = k;
            std::array::from_fn(|a| {
                let along = rest % counts[a];
                rest /= counts[a];
                grid.origin[a] + grid.h[a] * (first[a] + along) as f64
            })
        };
        Sampler {
            body: (0..shown).map(|k| model.disc.sample(&place(k))).collect(),
            tracers: tracers.collect(),
            lines: lines.collect(),
            snapshots: probes.snapshot_times.clone(),
            first,
            counts,
        }
    }

    /// Samples lines, energies and fields at time `t` (s), after `step` steps.
    pub(crate) fn sample(
        &mut self,
        problem: &Problem<D>,
        model: &Model<D>,
        step: usize,
        t: f64,
        record: &mut Record,
    ) {
        if step > 0 {
            bodies(model, t, &mut record.bodies);
        }
        for ((line, samples), out) in problem
            .probes
            .lines
            .iter()
            .zip(&self.lines)
            .zip(&mut record.lines)
        {
            if step.is_multiple_of(line.every) {
                out.times.push(t);
                let i = line.component;
                let component = |s: &Sample| velocity(model, s)[i] + model.frame[i];
                out.values.extend(samples.iter().map(component));
            }
        }
        if problem
            .probes
            .energy_every
            .is_some_and(|every| step.is_multiple_of(every))
        {
            energy(model, t, &mut record.energy);
        }
        while self
            .snapshots
            .first()
            .is_some_and(|s| *s <= t + 0.5 * problem.dt)
        {
            self.snapshots.remove(0);
            record.snapshots.push(match &model.flow {
                Some(flow) => flowing_field(problem, model, flow, t),
                None => self.snapshot(model, t),
            });
        }
    }

    /// Receivers' velocities, on the nodes as they are.
    pub(crate) fn velocities(&self, model: &Model<D>, out: &mut SeriesTable) {
        let columns = out.columns.chunks_exact_mut(2 * D);
        for (tracer, columns) in self.tracers.iter().zip(columns) {
            let velocity = velocity(model, &tracer.sample);
            for (i, column) in columns[D..].iter_mut().enumerate() {
                column.values.push(velocity[i] + model.frame[i]);
            }
        }
    }

    /// Receivers' displacements at time `t` (s) after a step or at the start, by the step's increment.
    pub(crate) fn displacements(
        &mut self,
        model: &Model<D>,
        step: usize,
        t: f64,
        out: &mut SeriesTable,
    ) {
        out.times.push(t);
        let (nodes, moving) = (&model.nodes, model.moving);
        let columns = out.columns.chunks_exact_mut(2 * D);
        for (tracer, columns) in self.tracers.iter_mut().zip(columns) {
            if step > 0 {
                let increment = tracer.sample.interpolate(&nodes.increment, &nodes.active);
                for i in 0..D {
                    tracer.displacement[i] += increment[i];
                    tracer.place[i] += if moving { increment[i] } else { 0.0 };
                }
            }
            for (i, column) in columns[..D].iter_mut().enumerate() {
                let way = model.frame[i] * t;
                column.values.push(tracer.displacement[i] + way);
            }
            if moving {
                model.disc.sample_into(&tracer.place, &mut tracer.sample);
            }
        }
    }

    /// The displacement at the places of the body's nodes.
    fn snapshot(&self, model: &Model<D>, t: f64) -> Snapshot {
        let mut counts = [1; 3];
        let (mut origin, mut spacing) = ([0.0; 3], [0.0; 3]);
        for a in 0..D {
            counts[a] = self.counts[a];
            origin[a] = model.grid.origin[a] + model.grid.h[a] * self.first[a] as f64;
            spacing[a] = model.grid.h[a];
        }
        let nodes = &model.nodes;
        let shown = self.body.iter();
        let fields: Vec<Vector<D>> = shown
            .map(|sample| sample.interpolate(&nodes.u, &nodes.active))
            .collect();
        let columns = (0..D).map(|i| Column {
            name: format!("u{}", AXES[i]),
            unit: "m".to_owned(),
            values: fields.iter().map(|u| u[i]).collect(),
        });
        Snapshot {
            time: t,
            counts,
            origin,
            spacing,
            columns: columns.collect(),
        }
    }
}

/// Most samples along an axis of a velocity field: as many as a picture shows.
const MOST_ALONG: usize = 400;

/// The velocity of flowing material on the nodes of the body and the room around it, or every so many of
/// them, and the pressure of the cell beyond each; zero where there is none.
fn flowing_field<const D: usize>(
    problem: &Problem<D>,
    model: &Model<D>,
    flow: &Flowing<D>,
    t: f64,
) -> Snapshot {
    let grid = &model.grid;
    let index = |x: f64, a: usize| ((x - grid.origin[a]) / grid.h[a]).round().max(0.0) as usize;
    let (body, room) = (&problem.target, &problem.flow.room);
    let first: [usize; D] = std::array::from_fn(|a| index(body.lower[a] - room[a][0], a));
    let nodes_along = |a: usize| {
        let last = index(body.upper[a] + room[a][1], a);
        last.min(grid.cells[a]) - first[a] + 1
    };
    // whole cells that the frame has gone, so that the window stays
    let gone: [i64; D] = std::array::from_fn(|a| (model.frame[a] * t / grid.h[a]).round() as i64);
    let most = (0..D).map(nodes_along).max().unwrap_or(1);
    let stride = most.div_ceil(MOST_ALONG);
    let (mut counts, mut origin, mut spacing) = ([1; 3], [0.0; 3], [0.0; 3]);
    for a in 0..D {
        counts[a] = (nodes_along(a) - 1) / stride + 1;
        origin[a] =
            grid.origin[a] + grid.h[a] * (first[a] as f64 - gone[a] as f64) + model.frame[a] * t;
        spacing[a] = grid.h[a] * stride as f64;
    }
    let node = |k: usize| {
        let mut rest = k;
        let index: [Option<usize>; D] = std::array::from_fn(|a| {
            let i = rest % counts[a];
            rest /= counts[a];
            let i = usize::try_from((first[a] + i * stride) as i64 - gone[a]).ok()?;
            (i <= grid.cells[a]).then_some(i)
        });
        let within = index.iter().all(Option::is_some);
        within.then(|| grid.node(index.map(Option::unwrap_or_default)))
    };
    let total = counts.iter().product();
    let (nodes, lag) = (&model.nodes, model.velocity_lag());
    let value = |n: Option<usize>, i: usize| match n.filter(|&n| nodes.active[n]) {
        Some(n) => nodes.v[n][i] + lag * nodes.a[n][i] + model.frame[i],
        None => 0.0,
    };
    let pressures = flow.pressures(grid);
    let pressure = Column {
        name: "p".to_owned(),
        unit: "Pa".to_owned(),
        values: (0..total)
            .map(|k| node(k).map_or(0.0, |n| pressures[n]))
            .collect(),
    };
    let columns = (0..D).map(|i| Column {
        name: format!("v{}", AXES[i]),
        unit: "m/s".to_owned(),
        values: (0..total).map(|k| value(node(k), i)).collect(),
    });
    Snapshot {
        time: t,
        counts,
        origin,
        spacing,
        columns: columns.chain([pressure]).collect(),
    }
}

/// The velocity at the end of the step: where nodal velocities stand before it, they are carried on by
/// the step's acceleration.
fn velocity<const D: usize>(model: &Model<D>, sample: &Sample) -> Vector<D> {
    let nodes = &model.nodes;
    let mut v = sample.interpolate(&nodes.v, &nodes.active);
    let lag = model.velocity_lag();
    if lag > 0.0 {
        let a = sample.interpolate(&nodes.a, &nodes.active);
        for i in 0..D {
            v[i] += lag * a[i];
        }
    }
    v
}

/// More samples than this get their room as they come: not all long runs end.
const MOST_ROOM: usize = 1 << 16;

/// Room for the samples after so many steps and that of the start.
fn room(steps: usize) -> usize {
    (steps + 1).min(MOST_ROOM)
}

fn push(table: &mut SeriesTable, name: String, unit: &str, samples: usize) {
    table.columns.push(Column {
        name,
        unit: unit.to_owned(),
        values: Vec::with_capacity(samples),
    });
}

/// What bodies have to say of the step that ended at `t` (s).
fn bodies<const D: usize>(model: &Model<D>, t: f64, out: &mut SeriesTable) {
    let readings = model.terms.iter().filter_map(|term| term.reading());
    let columns = out.columns.chunks_exact_mut(BODY.len());
    for (reading, columns) in readings.zip(columns) {
        let ([fx, fy], [wx, wy]) = (reading.force, reading.way);
        for (column, value) in columns
            .iter_mut()
            .zip([fx, fy, wx, wy, reading.penetration])
        {
            column.values.push(value);
        }
    }
    if !out.columns.is_empty() {
        out.times.push(t);
    }
}

fn energy<const D: usize>(model: &Model<D>, t: f64, out: &mut SeriesTable) {
    let total = model.kinetic_energy(false) + model.strain_energy(false);
    let energies = [model.kinetic_energy(true), model.strain_energy(true), total];
    let values = energies.into_iter().chain(model.momentum());
    out.times.push(t);
    for (column, value) in out.columns.iter_mut().zip(values) {
        column.values.push(value);
    }
}
