//! Computing a certified reference, and its floor: its own change under a larger buffer and a tenth
//! of the solver's tolerance.

use super::causality::{EXTENDED, buffered, serves_until, sides};
use super::{About, Certified, key};
use crate::error::CaseError;
use crate::posed::{Posed, either};
use crate::progress::Progress;
use crate::provenance;
use anechoic_solver::problem::Problem;
use anechoic_solver::record::{Column, Record, SeriesTable, Status};
use cpu_time::ThreadTime;
use std::collections::BTreeMap;
use std::time::Instant;

/// The control run's buffer over that of the reference.
const LARGER: f64 = 1.1;

/// How names of the receivers' columns end; the last in three dimensions alone.
const DISPLACEMENTS: [&str; 3] = ["_ux", "_uy", "_uz"];

/// The control run's tolerance over that of the reference.
const FINER: f64 = 0.1;

/// Solves the extended problem.
///
/// # Errors
/// [`CaseError::Solver`] when it cannot be set up or fails, [`CaseError::Stopped`].
pub fn compute(case: &str, problem: &Posed) -> Result<Certified, CaseError> {
    let extended = buffered(problem, 1.0);
    let mut record = run(&extended)?;
    let table = key::table(&extended);
    let hash = key::hash(&table);
    let snapshots = std::mem::take(&mut record.snapshots);
    Ok(Certified {
        about: About {
            case: case.to_owned(),
            end_s: record.receivers.times.last().copied().unwrap_or(0.0),
            serves_until_s: either!(&extended, problem => serves_until(problem)).unwrap_or(0.0),
            buffer_m: either!(&extended, problem => buffers(problem)),
            floor_m: None,
            provenance: provenance::of(&hash),
            cost: record.cost,
            problem: table,
            hash,
        },
        receivers: columns(&record.receivers, |name| {
            DISPLACEMENTS.iter().any(|end| name.ends_with(end))
        }),
        energy: columns(&record.energy, |name| ["kinetic", "strain"].contains(&name)),
        snapshots,
    })
}

/// Solves the problem once more with a larger buffer and a finer tolerance, and notes by how much
/// the receivers' displacements change.
///
/// # Errors
/// As [`compute`].
pub fn measure_floor(reference: &mut Certified, problem: &Posed) -> Result<(), CaseError> {
    let mut finer = buffered(problem, LARGER);
    either!(&mut finer, problem => problem.rel_tol *= FINER);
    let control = run(&finer)?;
    let mut floor = BTreeMap::new();
    for (receiver, _) in problem.receivers() {
        let samples = reference.receivers.times.len();
        let mut squares = vec![0.0; samples.min(control.receivers.times.len())];
        for end in DISPLACEMENTS {
            let name = format!("{receiver}{end}");
            let columns = [&reference.receivers, &control.receivers].map(|t| t.column(&name));
            let [Some(mine), Some(other)] = columns else {
                continue;
            };
            for (sum, (a, b)) in squares.iter_mut().zip(mine.iter().zip(other)) {
                *sum += (a - b).powi(2);
            }
        }
        let change = squares.into_iter().fold(0.0, f64::max).sqrt();
        floor.insert(receiver, change);
    }
    reference.about.floor_m = Some(floor);
    Ok(())
}

/// The largest relative difference of two references' displacements, each receiver over its own
/// peak; `None` when they are not of the same shape. The shorter one decides how far is looked.
pub fn difference(a: &Certified, b: &Certified) -> Option<f64> {
    let mut largest = 0.0_f64;
    for column in &a.receivers.columns {
        let other = b.receivers.column(&column.name)?;
        let receiver = column.name.split('_').next()?;
        let peak = peak(&a.receivers, receiver);
        for (x, y) in column.values.iter().zip(other) {
            largest = largest.max((x - y).abs() / peak);
        }
    }
    Some(largest)
}

/// Largest component of a receiver's displacement (m).
fn peak(series: &SeriesTable, receiver: &str) -> f64 {
    let own = series
        .columns
        .iter()
        .filter(|column| column.name.split('_').next() == Some(receiver));
    own.flat_map(|column| &column.values)
        .fold(0.0, |m, v| m.max(v.abs()))
}

fn run(problem: &Posed) -> Result<Record, CaseError> {
    let bill = problem.bill()?;
    let progress = Progress::new(bill.points as u64 * bill.steps as u64);
    let monitor = progress.monitor(bill.points);
    let (wall, cpu) = (Instant::now(), ThreadTime::now());
    let mut outcome = None;
    let memory = allocation_counter::measure(|| outcome = Some(problem.solve(&monitor)));
    progress.finish();
    let outcome = outcome.expect("measure calls its closure once")?;
    if let Some(error) = outcome.error {
        return Err(error.into());
    }
    let mut record = outcome.record;
    record.cost.wall_s = wall.elapsed().as_secs_f64();
    record.cost.cpu_s = cpu.elapsed().as_secs_f64();
    record.cost.peak_bytes = memory.bytes_max;
    match record.status {
        Status::Complete => Ok(record),
        _ => Err(CaseError::Stopped("the certified reference".into())),
    }
}

fn columns(table: &SeriesTable, keep: impl Fn(&str) -> bool) -> SeriesTable {
    let kept = table.columns.iter().filter(|column| keep(&column.name));
    SeriesTable {
        times: table.times.clone(),
        columns: kept.map(Column::clone).collect(),
    }
}

fn buffers<const D: usize>(problem: &Problem<D>) -> BTreeMap<String, f64> {
    sides::<D>()
        .filter_map(|side| {
            let method = &problem.sides[side.axis][usize::from(side.upper)];
            let thickness = method.given_number("thickness_m");
            let thickness = thickness.filter(|_| method.method == EXTENDED)?;
            Some((side.name().to_owned(), thickness))
        })
        .collect()
}
