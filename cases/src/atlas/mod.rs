//! The reflection atlas: what each boundary method sends back of plane P and S waves, against their
//! angle, the layer's thickness and the cells in a wavelength.
//!
//! **How it is measured.** A plane wave on an endless side of a mesh is the same on every row of nodes
//! but for a phase, so that one row says all. [`strip`] asks the solver for the forces of harmonic
//! motion on a strip two cells high, by its own steps: the dynamic stiffness of the middle row. [`bloch`]
//! joins the rows by their phase, finds the mesh's own P and S waves in the plain columns (so that the
//! dispersion of mesh and time step is no echo) and what comes back from the others. There is no
//! window, no beam and no other wave in the way: at any angle the result is the solver's own reflection
//! in a harmonic state, to rounding. A run of the solver in time, with mirror-symmetric sides and forces
//! along a line, must find the same (`tests/tests/methods/atlas.rs`).
//!
//! Points rest and nodes keep their motion, whatever the scene says: a harmonic state belongs to a
//! linear system.
//!
//! **What it is judged by.** Closed forms of the continuum ([`anechoic_reference::analytic::oblique`]),
//! where a method has one.
//!
//! [`subject`] takes a method out of a scene, [`measure`] says what is measured of it, [`rows`] judges,
//! [`pictures`] draws; [`surface`] measures Rayleigh waves, by runs in time.

pub mod bloch;
pub mod measure;
pub mod pictures;
pub mod rows;
pub mod strip;
pub mod subject;
pub mod surface;

use anechoic_reference::analytic::oblique::{Reflection, Wave};
use anechoic_solver::error::SolverError;
use num_complex::Complex64;
use strip::{Stiffness, Strip};
use thiserror::Error;

/// Why a reflection cannot be measured.
#[derive(Debug, Error)]
pub enum AtlasError {
    /// A scene that harmonic states do not describe.
    #[error("{field}: the atlas cannot measure this: {reason}")]
    Unsupported {
        /// The field.
        field: &'static str,
        /// Why, and what works.
        reason: &'static str,
    },
    /// A memory of a layer that has not settled, or grows.
    #[error(
        "the forces of a harmonic motion had not settled to a harmonic state ({missed:.1e} of them differ): the layer's memory grows or is longer than the switch-on; try a smaller time.dt_s"
    )]
    NotSettled {
        /// Share of the forces.
        missed: f64,
    },
    /// Equations without a solution.
    #[error(
        "{0} cannot be found at this frequency: choose another source.frequency_Hz or smaller cells (grid.h_m)"
    )]
    Degenerate(&'static str),
    /// The solver refuses or fails.
    #[error(transparent)]
    Solver(#[from] SolverError),
}

/// A side with its method at one frequency, ready to be asked at any angle.
#[derive(Clone, Debug)]
pub struct Side {
    stiffness: Stiffness,
}

impl Side {
    /// The strip's response to `frequency` (Hz).
    ///
    /// # Errors
    /// A strip that cannot be set up, a frequency that the step does not resolve.
    pub fn new(strip: &Strip, frequency: f64) -> Result<Self, AtlasError> {
        let turn = 2.0 * std::f64::consts::PI * frequency * strip.problem.dt;
        if turn > std::f64::consts::FRAC_PI_2 {
            return Err(AtlasError::Unsupported {
                field: "source.frequency_Hz",
                reason: "a period has less than four steps; use a smaller time.dt_s or frequency",
            });
        }
        let stiffness = strip.stiffness(Complex64::from_polar(1.0, turn))?;
        Ok(Side { stiffness })
    }

    /// What comes back of a `wave` at `angle` from the side's normal (degrees).
    ///
    /// # Errors
    /// A mesh that carries no such wave.
    pub fn reflection(&self, wave: Wave, angle: f64) -> Result<Reflection, AtlasError> {
        let turn = bloch::turn_of(&self.stiffness, wave, angle)?;
        bloch::reflection(&self.stiffness, turn)
    }
}
