//! The dynamic stiffness of a strip, asked of the solver's own step.
//!
//! Nodes are made to move as `w_n Re(d z^n)` with a switch-on `w_n` from 0 to 1, step after step through
//! [`System`], and the forces that the solver misses for that motion are the response. Whatever a
//! method is made of (masses, terms on nodes, kernels with memory of any kind) takes part as it does in
//! a run. Two steps give the real and imaginary part of the stiffness at z, a third one proves that
//! the memory has settled.
//!
//! The switch-on is the integral of a Kaiser window: what it excites of a memory that fades as A^n goes
//! with the window's spectrum at |z - A|, however slowly A^n fades, and that is below 1e-11 from eight
//! periods on.

use super::AtlasError;
use anechoic_reference::analytic::oblique::matrix2::Matrix2;
use anechoic_solver::boundary::SideMethod;
use anechoic_solver::linear::Moment;
use anechoic_solver::physics::model::Model;
use anechoic_solver::problem::{Aabb, BasisKind, PointMode, Problem, Transfer};
use anechoic_solver::setup;
use anechoic_solver::tensor::Vector;
use anechoic_solver::time::{Motion, System};
use num_complex::Complex64;
use std::f64::consts::PI;

/// Columns of cells of plain material before the layer.
const PLAIN_CELLS: usize = 4;
/// Periods of the switch-on, and the shape of its window.
const PERIODS: f64 = 12.0;
const KAISER: f64 = 28.0;
/// Relative size of what the third step may miss of the other two.
const SETTLED: f64 = 1e-7;

/// A strip two cells high whose right side has a method, cut out of a body that is endless along the
/// side: only the middle row of its nodes counts, whose cells are whole.
#[derive(Clone, Debug)]
pub struct Strip {
    /// The problem that the solver sets up.
    pub problem: Problem<2>,
}

impl Strip {
    /// Cells of `h` (m) of the material of `like`, with its step, points and masses; `inside` (m) of it
    /// belong to the method.
    ///
    /// # Errors
    /// A basis whose functions reach beyond the next node.
    pub fn new(
        like: &Problem<2>,
        method: &SideMethod,
        h: f64,
        inside: f64,
    ) -> Result<Self, AtlasError> {
        if like.basis == BasisKind::Bspline {
            return Err(AtlasError::Unsupported {
                field: "basis",
                reason: "the modes of a strip are those of functions one cell wide; use \"linear\" or \"gimp\"",
            });
        }
        let free = || SideMethod::new("free");
        let cells = PLAIN_CELLS as f64 + (inside / h - 1e-6).ceil();
        Ok(Strip {
            problem: Problem {
                target: Aabb {
                    lower: [0.0, -h],
                    upper: [cells * h, h],
                },
                cell_size: h,
                aspect: 1.0,
                inclusion: None,
                point_mode: PointMode::Frozen,
                transfer: Transfer::Keep,
                sides: [[free(), method.clone()], [free(), free()]],
                drives: Vec::new(),
                probes: Default::default(),
                ..like.clone()
            },
        })
    }

    /// The dynamic stiffness at `z`, by which a harmonic motion grows and turns in a step.
    ///
    /// # Errors
    /// A strip that cannot be set up, a solver that fails, a memory that does not settle.
    pub fn stiffness(&self, z: Complex64) -> Result<Stiffness, AtlasError> {
        let columns = setup::model(&self.problem)?.grid.nodes_along(0);
        let mut out = Stiffness {
            blocks: vec![[[Matrix2::zero(); 3]; 3]; columns],
        };
        // Columns three apart do not feel each other.
        for (first, row, component) in (0..18).map(|n| (n % 3, n / 3 % 3, n / 9)) {
            let moved: Vec<usize> = (first..columns).step_by(3).collect();
            let force = self.response(z, &moved, row, component)?;
            for &column in &moved {
                for at in column.saturating_sub(1)..(column + 2).min(columns) {
                    let block = &mut out.blocks[at][column + 1 - at][row];
                    for i in 0..2 {
                        block.0[i][component] = force[at][i];
                    }
                }
            }
        }
        Ok(out)
    }

    /// Forces that hold the middle row of a strip in which one row of some columns moves as z^n, over
    /// that motion.
    fn response(
        &self,
        z: Complex64,
        moved: &[usize],
        row: usize,
        component: usize,
    ) -> Result<Vec<[Complex64; 2]>, AtlasError> {
        let mut model = setup::model(&self.problem)?;
        let tone = Tone::new(z, self.problem.dt);
        let nodes: Vec<usize> = moved.iter().map(|c| model.grid.node([*c, row])).collect();
        let middle: Vec<usize> = (0..model.grid.nodes_along(0))
            .map(|c| model.grid.node([c, 1]))
            .collect();
        let mut motion = Fields::at_rest(model.grid.node_count());
        let mut asked = Vec::new();
        for step in 1..=tone.last_step() {
            let states = tone.states(step);
            motion.set(&nodes, component, states);
            let moment = Moment {
                step,
                time_s: step as f64 * self.problem.dt,
            };
            let start = (step - 1) as f64 * self.problem.dt;
            model.begin_step([start, moment.time_s], moment)?;
            if tone.asks(step) {
                asked.push((tone.phase(step), motion.force(&mut model, &middle)?));
            }
            model.commit(&motion.as_motion())?;
        }
        let [first, second, third] = asked.as_slice() else {
            return Err(AtlasError::Degenerate("the steps of a probe"));
        };
        settle(first, second, third)
    }
}

/// The phase z^n of a step and the forces in it.
type Asked = (Complex64, Vec<Vector<2>>);

/// Stiffness of each component from two steps, after a third one that it must predict.
fn settle(first: &Asked, second: &Asked, third: &Asked) -> Result<Vec<[Complex64; 2]>, AtlasError> {
    let ((a, fa), (b, fb), (c, fc)) = (first, second, third);
    let determinant = a.im * b.re - a.re * b.im;
    let mut largest = 0.0_f64;
    let mut missed = 0.0_f64;
    let mut out = Vec::with_capacity(fa.len());
    for ((x, y), z) in fa.iter().zip(fb).zip(fc) {
        // f = Re(Z phase)
        out.push([0, 1].map(|i| {
            let re = (y[i] * a.im - x[i] * b.im) / determinant;
            let im = (y[i] * a.re - x[i] * b.re) / determinant;
            let stiffness = Complex64::new(re, im);
            largest = largest.max(stiffness.norm() * c.norm());
            missed = missed.max(((stiffness * c).re - z[i]).abs());
            stiffness
        }));
    }
    if missed <= SETTLED * largest {
        Ok(out)
    } else {
        Err(AtlasError::NotSettled {
            missed: missed / largest,
        })
    }
}

/// A harmonic motion that is switched on.
struct Tone {
    z: Complex64,
    dt: f64,
    /// w_n from step 0 on; 1 after its end.
    ramp: Vec<f64>,
    /// Steps of a quarter of a period, about.
    quarter: usize,
}

impl Tone {
    fn new(z: Complex64, dt: f64) -> Self {
        let steps = (PERIODS * 2.0 * PI / z.arg()).ceil() as usize;
        let window = (0..steps).map(|n| {
            let x = 2.0 * (n as f64 + 0.5) / steps as f64 - 1.0;
            bessel_i0(KAISER * (1.0 - x * x).sqrt())
        });
        let mut sum = 0.0;
        let mut ramp: Vec<f64> = std::iter::once(0.0)
            .chain(window.map(|w| {
                sum += w;
                sum
            }))
            .collect();
        for w in &mut ramp {
            *w /= sum;
        }
        Tone {
            z,
            dt,
            ramp,
            quarter: ((0.5 * PI / z.arg()).round() as usize).max(1),
        }
    }

    fn last_step(&self) -> usize {
        self.ramp.len() + 2 * self.quarter
    }

    /// Three steps a quarter of a period apart (about) in which the forces are asked for.
    fn asks(&self, step: usize) -> bool {
        [0, 1, 2]
            .map(|n| self.ramp.len() + n * self.quarter)
            .contains(&step)
    }

    /// z^n, from the end of the switch-on.
    fn phase(&self, step: usize) -> Complex64 {
        let n = step as f64 - self.ramp.len() as f64;
        Complex64::from_polar((n * self.z.norm().ln()).exp(), n * self.z.arg())
    }

    fn displacement(&self, step: usize) -> f64 {
        self.ramp.get(step).unwrap_or(&1.0) * self.phase(step).re
    }

    /// Increment, velocity and acceleration of a step: those of z^n under Newmark's rule, where d/dt is
    /// W = (2/dt)(z - 1)/(z + 1).
    fn states(&self, step: usize) -> [f64; 3] {
        let rate = 2.0 / self.dt * (self.z - 1.0) / (self.z + 1.0);
        let phase = self.phase(step);
        [
            self.displacement(step) - self.displacement(step - 1),
            (rate * phase).re,
            (rate * rate * phase).re,
        ]
    }
}

/// Modified Bessel function of order zero, by its series.
fn bessel_i0(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let (mut term, mut sum, mut k) = (1.0, 1.0, 1.0);
    while term > 1e-17 * sum {
        term *= quarter / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

/// Nodal motion.
struct Fields {
    increment: Vec<Vector<2>>,
    v: Vec<Vector<2>>,
    a: Vec<Vector<2>>,
}

impl Fields {
    fn at_rest(nodes: usize) -> Self {
        let rest = || vec![[0.0; 2]; nodes];
        Fields {
            increment: rest(),
            v: rest(),
            a: rest(),
        }
    }

    fn set(&mut self, nodes: &[usize], component: usize, [increment, v, a]: [f64; 3]) {
        for &n in nodes {
            self.increment[n][component] = increment;
            self.v[n][component] = v;
            self.a[n][component] = a;
        }
    }

    fn as_motion(&self) -> Motion<'_, 2> {
        Motion {
            increment: &self.increment,
            v: &self.v,
            a: &self.a,
        }
    }

    /// The forces on some nodes that the motion asks for.
    fn force(&self, model: &mut Model<2>, nodes: &[usize]) -> Result<Vec<Vector<2>>, AtlasError> {
        let mut missing = vec![[0.0; 2]; model.grid.node_count()];
        model.residual(&self.as_motion(), &mut missing)?;
        Ok(nodes.iter().map(|n| missing[*n].map(|f| -f)).collect())
    }
}

/// Dynamic stiffness of the nodes of one row (N/m, per metre of thickness).
#[derive(Clone, Debug)]
pub struct Stiffness {
    /// For each column, its coupling to the columns before, at and after it, and there to the rows
    /// below, at and above it. Rows of held directions are zero.
    blocks: Vec<[[Matrix2; 3]; 3]>,
}

impl Stiffness {
    /// Columns of nodes.
    pub fn columns(&self) -> usize {
        self.blocks.len()
    }

    /// For motion that goes along the side as exp(-i k y), `turn` = k h: the coupling of a column to
    /// the columns before, at and after it.
    pub fn turned(&self, column: usize, turn: f64) -> [Matrix2; 3] {
        let up = Complex64::from_polar(1.0, -turn);
        let phases = [up.conj(), Complex64::ONE, up];
        let sum = |rows: &[Matrix2; 3]| {
            let [a, b, c] = [0, 1, 2].map(|r| rows[r].scale(phases[r]));
            a + b + c
        };
        let blocks = &self.blocks[column];
        [0, 1, 2].map(|c| sum(&blocks[c]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_window_is_quiet_at_the_tone() {
        // the spectrum of the switch-on at the tone's own frequency, and at a fifth less
        for share in [1.0, 0.8] {
            let z = Complex64::from_polar(1.0, 0.1);
            let tone = Tone::new(z, 0.01);
            let steps = tone.ramp.windows(2).enumerate();
            let spectrum: Complex64 = steps
                .map(|(n, w)| (w[1] - w[0]) * Complex64::from_polar(1.0, 0.1 * share * n as f64))
                .sum();
            assert!(spectrum.norm() < 1e-11, "{share}: {}", spectrum.norm());
        }
    }

    #[test]
    fn bessel_matches_tables() {
        // Abramowitz and Stegun, table 9.8
        assert!((bessel_i0(1.0) - 1.266_065_877_752_008).abs() < 1e-14);
        assert!((bessel_i0(5.0) / 27.239_871_823_604_44 - 1.0).abs() < 1e-14);
    }
}
