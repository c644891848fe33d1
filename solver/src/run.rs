//! The loop over the steps of a run.

use crate::error::SolverError;
use crate::flow::{Dimension, Space};
use crate::linear::Moment;
use crate::physics::model::Model;
use crate::problem::{Problem, Scheme};
use crate::record::{Cost, Record, SeriesTable, Status};
use crate::sampler::Sampler;
use crate::time::explicit::Explicit;
use crate::time::newmark::Newmark;
use crate::time::quasi_static::QuasiStatic;
use crate::time::{Integrator, System};
use crate::{Monitor, Outcome, setup};

pub(crate) fn run<const D: usize>(
    problem: &Problem<D>,
    monitor: &dyn Monitor,
) -> Result<Outcome, SolverError>
where
    Space: Dimension<D>,
{
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
        Scheme::Explicit => Box::new(Explicit::new(nodes)),
        Scheme::QuasiStatic => Box::new(QuasiStatic::new(nodes)),
    };
    let mut record = Record {
        status: Status::Complete,
        receivers: SeriesTable::default(),
        energy: SeriesTable::default(),
        bodies: SeriesTable::default(),
        lines: Vec::new(),
        snapshots: Vec::new(),
        cost: Cost {
            points: model.point_count(),
            ..Cost::default()
        },
    };
    let mut sampler = Sampler::new(problem, &model, &mut record);
    let total = problem.steps();
    let mut error = None;
    for step in 0..=total {
        let made = advance(
            problem,
            &mut model,
            integrator.as_mut(),
            &mut sampler,
            step,
            &mut record,
        );
        if let Err(failure) = made {
            let failure = failure.out_of_frame(&model.frame);
            record.status = Status::Failed(failure.to_string());
            error = Some(failure);
            break;
        }
        if step > 0 && !monitor.step(step, total) && step < total {
            record.status = Status::Cancelled;
            break;
        }
    }
    record.cost.unknowns = model.unknowns();
    record.cost.iterations = model.solver.iterations;
    record.cost.linear_solver = match problem.scheme {
        Scheme::Explicit => "none: explicit steps".to_owned(),
        _ => model.solver.describe(),
    };
    Outcome { record, error }
}

/// Makes the step with the number `step`, none for 0, and samples what it led to.
fn advance<const D: usize>(
    problem: &Problem<D>,
    model: &mut Model<D>,
    integrator: &mut dyn Integrator<D>,
    sampler: &mut Sampler<D>,
    step: usize,
    record: &mut Record,
) -> Result<(), SolverError> {
    let at = |step: usize| step as f64 * problem.dt;
    let moment = |step: usize| Moment {
        step,
        time_s: at(step),
    };
    if step > 0 {
        let times = [at(step - 1), at(step)];
        record.cost.newton_iterations += integrator.step(model, times, moment(step))?;
        record.cost.steps = step;
    }
    let receivers = &mut record.receivers;
    if problem.scheme == Scheme::Explicit {
        // velocities at the end of the step need the acceleration there
        sampler.displacements(model, step, at(step), receivers);
        let next = [at(step), at(step + 1)];
        if let Err(failure) = integrator.prepare(model, next, moment(step + 1)) {
            receivers.truncate(step);
            return Err(failure);
        }
        sampler.velocities(model, receivers);
    } else {
        sampler.velocities(model, receivers);
        sampler.displacements(model, step, at(step), receivers);
    }
    sampler.sample(problem, model, step, at(step), record);
    // squares overflow before what is squared does
    if record.energy.ends_finite() {
        return Ok(());
    }
    record.energy.truncate(record.energy.times.len() - 1);
    Err(SolverError::NonFinite {
        field: "the energy",
        step,
        time_s: at(step),
        place: model.place_of_largest(&model.nodes.v),
    })
}
