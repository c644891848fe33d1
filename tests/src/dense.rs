//! Semi-discrete operators of layers as dense matrices, and their spectra.

use crate::half_space;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::linear::Moment;
use anechoic_solver::linear::dense::eigenvalues;
use anechoic_solver::physics::model::Model;
use anechoic_solver::problem::{PointMode, Problem, Transfer};
use anechoic_solver::setup;
use anechoic_solver::tensor::Vector;
use anechoic_solver::time::{Motion, System};
use faer::Mat;

/// Force on free unknowns for a displacement, at rest: a column of minus the stiffness.
fn column(model: &mut Model<2>, unknown: usize) -> Vec<f64> {
    let n = model.grid.node_count();
    let rest = vec![[0.0; 2]; n];
    let mut unit: Vec<Vector<2>> = rest.clone();
    unit[unknown / 2][unknown % 2] = 1.0;
    let mut force = rest.clone();
    let trial = Motion {
        increment: &unit,
        v: &rest,
        a: &rest,
    };
    model
        .residual(&trial, &mut force)
        .expect("forces of a unit displacement are finite");
    force.as_flattened().to_vec()
}

/// A mesh small enough for dense algebra: 60 x 40 m, layers of three cells left, right and below.
pub fn tiny(layer: SideMethod) -> Problem<2> {
    let layer = layer.with("thickness_m", 60.0);
    let mut problem = half_space(layer, PointMode::Frozen, Transfer::Keep);
    problem.target.lower = [0.0, -40.0];
    problem.target.upper = [60.0, 0.0];
    problem.drives.clear();
    problem.probes.receivers.clear();
    problem
}

/// Free unknowns and the stiffness on them, probed column by column from rest.
///
/// # Panics
/// When the problem cannot be set up.
pub fn probed(problem: &Problem<2>) -> (Model<2>, Vec<usize>, Mat<f64>) {
    let mut model = setup::model(problem).expect("the problem is well put");
    let begun = model.begin_step(
        [0.0, problem.dt],
        Moment {
            step: 1,
            time_s: problem.dt,
        },
    );
    begun.expect("points lie on the grid");
    // what is held has no force at all
    let free: Vec<usize> = (0..2 * model.grid.node_count())
        .filter(|&i| column(&mut model, i)[i] != 0.0)
        .collect();
    let columns: Vec<Vec<f64>> = free.iter().map(|&j| column(&mut model, j)).collect();
    let k = Mat::from_fn(free.len(), free.len(), |i, j| -columns[j][free[i]]);
    (model, free, k)
}

/// Largest real part of the spectrum of a matrix.
///
/// # Panics
/// When the eigenvalues cannot be computed.
pub fn largest_real_part(a: &Mat<f64>) -> f64 {
    let all = eigenvalues(a.nrows(), |i, j| a[(i, j)]).expect("a matrix of finite numbers");
    all.iter()
        .map(|[re, _]| *re)
        .fold(f64::NEG_INFINITY, f64::max)
}
