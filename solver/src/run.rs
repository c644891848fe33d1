//! The loop over the steps of a run.

use crate::error::SolverError;
use crate::linear::Moment;
use crate::physics::model::Model;
use crate::problem::{Problem, Scheme};
use crate::record::{Cost, Record, SeriesTable, Status};
use crate::sampler::Sampler;
use crate::time::Integrator;
use crate::time::newmark::Newmark;
use crate::time::quasi_static::QuasiStatic;
use crate::{Monitor, Outcome, setup};

pub(crate) fn run<const D: usize>(
    problem: &Problem<D>,
    monitor: &dyn Monitor,
) -> Result<Outcome, SolverError> {
    Ok(run_model(problem, setup::model(problem)?, monitor))
}

pub(crate) fn run_model<const D: usize>(
    problem: &Problem<D>,
    mut model: Model<D>,
    monitor: &dyn Monitor,
) -> Outcome {
    let nodes = model.grid.node_count();
    let mut integrator: Box<dyn Integrator<D>> = match problem.scheme {
        Scheme::Newmark => Box::new(Newmark::new(nodes)),
        Scheme::QuasiStatic => Box::new(QuasiStatic::new(nodes)),
    };
    let mut record = Record {
        status: Status::Complete,
        receivers: SeriesTable::default(),
        energy: SeriesTable::default(),
        lines: Vec::new(),
        snapshots: Vec::new(),
        cost: Cost {
            points: model.points.len(),
            ..Cost::default()
        },
    };
    let mut sampler = Sampler::new(problem, &model, &mut record);
    sampler.sample(problem, &model, 0, 0.0, &mut record);
    let total = problem.steps();
    let mut error = None;
    for step in 1..=total {
        let times = [(step - 1) as f64, step as f64].map(|n| n * problem.dt);
        match integrator.step(
            &mut model,
            times,
            Moment {
                step,
                time_s: times[1],
            },
        ) {
            Ok(iterations) => record.cost.newton_iterations += iterations,
            Err(failure) => {
                record.status = Status::Failed(failure.to_string());
                error = Some(failure);
                break;
            }
        }
        record.cost.steps = step;
        sampler.sample(problem, &model, step, times[1], &mut record);
        if !monitor.step(step, total) && step < total {
            record.status = Status::Cancelled;
            break;
        }
    }
    record.cost.unknowns = model.unknowns();
    record.cost.iterations = model.solver.iterations;
    record.cost.linear_solver = model.solver.describe();
    Outcome { record, error }
}
