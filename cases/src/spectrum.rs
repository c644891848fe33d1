//! Spectra of small meshes with the sides of a scene: a second opinion on stability beside runs.
//!
//! A few cells of material with a thin layer are small enough that the solver's own step can be asked
//! for its whole matrix, one unit state after the other: displacement, velocity, acceleration of the
//! nodes, and the memory of layers. Newmark's average acceleration and the layers' memories follow one
//! bilinear map, so that an eigenvalue z of the step is the eigenvalue `s = (2/dt) (z - 1)/(z + 1)` of
//! the semi-discrete operator. A run grows by the one with the largest real part, and may be over before
//! that shows; the spectrum waits for no mode. Points rest and nodes keep their motion.

use crate::error::CaseError;
use crate::judge::{CERTIFIER, RATIO_AXIS};
use crate::runner::{Run, pool};
use crate::store::{json, read_json, write_file};
use crate::sweep::Grid;
use crate::timing;
use anechoic_solver::boundary::{SideMethod, find};
use anechoic_solver::error::SolverError;
use anechoic_solver::linear::Moment;
use anechoic_solver::linear::dense::{NoEigenvalues, eigenvalues};
use anechoic_solver::physics::model::Model;
use anechoic_solver::problem::{Aabb, PointMode, Problem, Scheme, SolverKind, Transfer};
use anechoic_solver::setup;
use anechoic_solver::time::newmark::Newmark;
use anechoic_solver::time::{Integrator, Motion, System};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use thiserror::Error;

/// Cells of the body along x and y.
const BODY: [f64; 2] = [3.0, 2.0];
/// Cells of a layer outside the body, and of one inside.
const LAYER: [f64; 2] = [3.0, 1.0];

/// The tightest tolerance that rounding allows of steps.
const TOLERANCE: f64 = 1e-13;

/// Why there is no spectrum.
#[derive(Debug, Error)]
pub enum SpectrumError {
    /// The mesh cannot be set up, or a step cannot be made.
    #[error(transparent)]
    Solver(#[from] SolverError),
    /// No eigenvalues.
    #[error(transparent)]
    Dense(#[from] NoEigenvalues),
}

/// What a spectrum says.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Spectrum {
    /// Largest real part of the semi-discrete operator over c_p/h.
    pub growth: f64,
    /// How far rounding moves it: much for multiple eigenvalues without as many modes.
    pub rounding: f64,
    /// Unknowns of its state.
    pub unknowns: usize,
}

/// The scene's material, cells, basis and sides on a mesh small enough for dense algebra.
pub fn small(problem: &Problem<2>) -> Problem<2> {
    let [x, y] = problem.edges();
    let mut small = Problem {
        target: Aabb {
            lower: [0.0, -BODY[1] * y],
            upper: [BODY[0] * x, 0.0],
        },
        scheme: Scheme::Newmark,
        point_mode: PointMode::Frozen,
        transfer: Transfer::Keep,
        solver: SolverKind::Direct,
        rel_tol: TOLERANCE,
        drives: Vec::new(),
        probes: Default::default(),
        ..problem.clone()
    };
    small.dt = problem.cell_size / problem.material.p_speed();
    for (axis, sides) in small.sides.iter_mut().enumerate() {
        for side in sides {
            if has_thickness(side) {
                let inside = crate::checks::inner_thickness(side) > 0.0;
                let cells = LAYER[usize::from(inside)];
                *side = side.clone().with("thickness_m", cells * [x, y][axis]);
            }
        }
    }
    small
}

/// The spectrum of a small problem.
///
/// # Errors
/// [`SpectrumError`].
pub fn spectrum(problem: &Problem<2>) -> Result<Spectrum, SpectrumError> {
    let mut probe = Probe::new(problem)?;
    let n = probe.unknowns();
    let columns: Vec<Vec<f64>> = (0..n)
        .map(|unknown| probe.column(unknown))
        .collect::<Result<_, _>>()?;
    // the transposed matrix has the same eigenvalues and other rounding
    let growth = largest_real_part(&eigenvalues(n, |i, j| columns[j][i])?);
    let again = largest_real_part(&eigenvalues(n, |i, j| columns[i][j])?);
    Ok(Spectrum {
        growth,
        rounding: (growth - again).abs(),
        unknowns: n,
    })
}

/// Largest real part over c_p/h of the semi-discrete operator whose step of h/c_p has these eigenvalues.
fn largest_real_part(all: &[[f64; 2]]) -> f64 {
    let real = |[re, im]: &[f64; 2]| {
        let (size, far) = (re * re + im * im, (re + 1.0).powi(2) + im * im);
        2.0 * (size - 1.0) / far
    };
    all.iter().map(real).fold(f64::NEG_INFINITY, f64::max)
}

/// Name of the file in a study's folder.
const SPECTRA: &str = "spectra.json";

/// Spectra by the folder of the run whose sides they are of; or why there is none.
pub type Spectra = BTreeMap<String, Result<Spectrum, String>>;

/// The spectra of a study's folder; none where nobody asked for any.
///
/// # Errors
/// [`CaseError::BadRecord`] for a damaged file.
pub fn load(folder: &Path) -> Result<Spectra, CaseError> {
    let path = folder.join(SPECTRA);
    if path.is_file() {
        read_json(&path)
    } else {
        Ok(Spectra::new())
    }
}

/// Finds and stores the spectra of all runs with layers at a study's Poisson's ratios.
///
/// # Errors
/// [`CaseError::Storage`].
pub fn measure(runs: &[Run], grid: &Grid, folder: &Path, jobs: usize) -> Result<(), CaseError> {
    let parts = grid.parts.iter().filter(|part| part.axis == RATIO_AXIS);
    let points = parts.flat_map(|part| &part.points);
    let own = points.flat_map(|point| point.pick(runs).0);
    let wanted: Vec<&Run> = own.filter(|run| has_layer(run)).collect();
    let one = |run: &&Run| {
        let plane = run.prepared.scene.posed().plane();
        let plane = plane.ok_or_else(|| "spectra are found of plane scenes alone".to_owned());
        let found = plane.and_then(|problem| {
            let found = spectrum(&small(&problem));
            found.map_err(|error| error.to_string())
        });
        (timing::key(run), found)
    };
    let spectra: Spectra =
        pool(jobs)?.install(|| wanted.par_iter().with_max_len(1).map(one).collect());
    write_file(&folder.join(SPECTRA), &json(&spectra)?)
}

/// Has it a layer of a method's own, and not just more of the body?
fn has_layer(run: &Run) -> bool {
    let sides = run.prepared.scene.boundary().named();
    let mut sides = sides.into_iter();
    sides.any(|(_, side)| has_thickness(side) && side.method != CERTIFIER)
}

fn has_thickness(side: &SideMethod) -> bool {
    let params = find(&side.method).map_or(&[][..], |info| info.params);
    params.iter().any(|param| param.name == "thickness_m")
}

/// A model whose step is asked for its matrix.
struct Probe {
    model: Model<2>,
    newmark: Newmark<2>,
    dt: f64,
    /// Free unknowns, counted with x first at each node.
    free: Vec<usize>,
    /// Numbers in the memory of layers.
    memory: usize,
}

impl Probe {
    fn new(problem: &Problem<2>) -> Result<Self, SpectrumError> {
        let mut model = setup::model(problem)?;
        let nodes = model.grid.node_count();
        model.begin_step([0.0, problem.dt], first(problem.dt))?;
        let mut moved = vec![[1.0; 2]; nodes];
        model.impose(&mut moved);
        let active = &model.nodes.active;
        let free = moved.as_flattened().iter().enumerate();
        let free = free.filter(|(i, d)| **d != 0.0 && active[i / 2]);
        let free = free.map(|(i, _)| i).collect();
        let memory = memory(&mut model).iter().map(|part| part.len()).sum();
        Ok(Probe {
            newmark: Newmark::new(nodes),
            model,
            dt: problem.dt,
            free,
            memory,
        })
    }

    fn unknowns(&self) -> usize {
        3 * self.free.len() + self.memory
    }

    /// The state after a step from a unit state. Velocities and accelerations are counted in steps, so
    /// that all entries are of one size.
    fn column(&mut self, unknown: usize) -> Result<Vec<f64>, SolverError> {
        self.rest()?;
        let n = self.free.len();
        let at = |unknown: usize| self.free[unknown % n];
        match unknown.checked_div(n) {
            Some(0) => {
                let mut unit = vec![[0.0; 2]; self.model.grid.node_count()];
                unit.as_flattened_mut()[at(unknown)] = 1.0;
                self.displace(&unit)?;
            }
            Some(1) => self.model.nodes.v.as_flattened_mut()[at(unknown)] = 1.0 / self.dt,
            Some(2) => self.model.nodes.a.as_flattened_mut()[at(unknown)] = self.dt.powi(-2),
            _ => self.remember(unknown - 3 * n),
        }
        let times = [0.0, self.dt];
        self.newmark.step(&mut self.model, times, first(self.dt))?;
        let nodes = &self.model.nodes;
        let parts = [
            (&nodes.u, 1.0),
            (&nodes.v, self.dt),
            (&nodes.a, self.dt * self.dt),
        ];
        let mut state = Vec::with_capacity(self.unknowns());
        for (field, scale) in parts {
            let values = field.as_flattened();
            state.extend(self.free.iter().map(|&i| scale * values[i]));
        }
        state.extend(
            memory(&mut self.model)
                .into_iter()
                .flat_map(|part| part.to_vec()),
        );
        Ok(state)
    }

    /// Takes everything back to rest.
    fn rest(&mut self) -> Result<(), SolverError> {
        let back: Vec<[f64; 2]> = self.model.nodes.u.iter().map(|u| u.map(|u| -u)).collect();
        self.displace(&back)
    }

    /// Displaces the nodes, which then rest, without a trace in the memory of layers.
    fn displace(&mut self, increment: &[[f64; 2]]) -> Result<(), SolverError> {
        let rest = vec![[0.0; 2]; increment.len()];
        self.model.begin_step([0.0, self.dt], first(self.dt))?;
        self.model.commit(&Motion {
            increment,
            v: &rest,
            a: &rest,
        })?;
        for part in memory(&mut self.model) {
            part.fill(0.0);
        }
        Ok(())
    }

    /// Sets one number of the memory to one.
    fn remember(&mut self, mut index: usize) {
        for part in memory(&mut self.model) {
            match part.get_mut(index) {
                Some(value) => {
                    *value = 1.0;
                    return;
                }
                None => index -= part.len(),
            }
        }
    }
}

fn first(dt: f64) -> Moment {
    Moment {
        step: 1,
        time_s: dt,
    }
}

/// The memories of all regions.
fn memory(model: &mut Model<2>) -> Vec<&mut [f64]> {
    let regions = model.regions.iter_mut();
    regions
        .flat_map(|region| region.kernel.memories())
        .collect()
}
