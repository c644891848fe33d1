//! What to sample and when.

/// A massless tracer: sits at its exact place, moves with the material when points move.
#[derive(Clone, Debug, PartialEq)]
pub struct Receiver<const D: usize> {
    /// Name, for example `A1`.
    pub name: String,
    /// Place at the start (m).
    pub place: [f64; D],
}

/// Which component of a vector a line samples.
#[derive(Clone, Debug, PartialEq)]
pub struct LineProbe<const D: usize> {
    /// First sample (m).
    pub from: [f64; D],
    /// Last sample (m).
    pub to: [f64; D],
    /// Number of samples, at least 2.
    pub samples: usize,
    /// Sampled component of the velocity.
    pub component: usize,
    /// A sample in time every so many steps.
    pub every: usize,
}

/// All probes of a run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Probes<const D: usize> {
    /// Receivers, sampled every step.
    pub receivers: Vec<Receiver<D>>,
    /// Velocity along lines.
    pub lines: Vec<LineProbe<D>>,
    /// Times (s) at which the displacement is sampled on the nodes of the target.
    pub snapshot_times: Vec<f64>,
    /// Energies every so many steps; `None`: not at all.
    pub energy_every: Option<usize>,
}
