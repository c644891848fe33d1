//! Material points as a structure of arrays. Columns exist only where the run needs them.

use crate::tensor::{Matrix, Vector};
use std::ops::Range;

/// Material points, ordered by region and within it by cell.
#[derive(Clone, Debug, Default)]
pub struct Points<const D: usize> {
    /// Places (m).
    pub place: Vec<Vector<D>>,
    /// Volumes at the start (m3, per metre of thickness in 2D).
    pub volume: Vec<f64>,
    /// Masses (kg, per metre of thickness in 2D).
    pub mass: Vec<f64>,
    /// Factors of inertia in each direction (K25 (16)); absent when all are 1.
    pub inertia: Option<Vec<Vector<D>>>,
    /// What points carry when they, and not the nodes, hold the motion.
    pub motion: Option<Motion<D>>,
}

/// Motion carried by the first points; those behind them rest.
#[derive(Clone, Debug)]
pub struct Motion<const D: usize> {
    /// Velocities (m/s).
    pub v: Vec<Vector<D>>,
    /// Accelerations (m/s2), where the rule of steps asks for those of the step before; else empty.
    pub a: Vec<Vector<D>>,
    /// Gradients of both, for the affine transfer alone.
    pub gradients: Option<Gradients<D>>,
    /// Displacements (m), where a layer asks for them.
    pub u: Option<Vec<Vector<D>>>,
}

/// Gradients of velocity and acceleration carried by points.
#[derive(Clone, Debug)]
pub struct Gradients<const D: usize> {
    /// `L_v` (1/s).
    pub v: Vec<Matrix<D>>,
    /// `L_a` (1/s2); empty where `a` is.
    pub a: Vec<Matrix<D>>,
}

impl<const D: usize> Points<D> {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.place.len()
    }

    /// Are there none?
    pub fn is_empty(&self) -> bool {
        self.place.is_empty()
    }

    /// Adds columns for the first `n` points to carry the motion, at rest; `accelerations` with those
    /// of the step before, which an explicit rule does not ask for.
    pub fn carry_motion(&mut self, n: usize, affine: bool, accelerations: bool) {
        let old = if accelerations { n } else { 0 };
        let gradients = affine.then(|| Gradients {
            v: vec![[[0.0; D]; D]; n],
            a: vec![[[0.0; D]; D]; old],
        });
        self.motion = Some(Motion {
            v: vec![[0.0; D]; n],
            a: vec![[0.0; D]; old],
            gradients,
            u: None,
        });
    }

    /// Place, volume and mass of a point in bytes.
    pub(crate) const BYTES: usize = size_of::<Vector<D>>() + 2 * size_of::<f64>();

    /// Fills a cell with `per_axis`^D points at the centres of its equal parts, or, with a `face_gap`, at
    /// equal distances between its faces but for that share of its edges.
    pub fn fill_cell(
        &mut self,
        lower: &Vector<D>,
        h: &Vector<D>,
        per_axis: usize,
        face_gap: Option<f64>,
        density: f64,
    ) {
        let part = h.map(|h| h / per_axis as f64);
        let volume = part.iter().product();
        let local = |a: usize, i: usize| match face_gap {
            None => part[a] * (i as f64 + 0.5),
            Some(gap) => h[a] * (gap + (1.0 - 2.0 * gap) * i as f64 / (per_axis - 1) as f64),
        };
        for k in 0..per_axis.pow(D as u32) {
            let mut rest = k;
            let place = std::array::from_fn(|a| {
                let i = rest % per_axis;
                rest /= per_axis;
                lower[a] + local(a, i)
            });
            self.place.push(place);
            self.volume.push(volume);
            self.mass.push(density * volume);
        }
    }
}

/// Points handled at once by the kernels: small enough for the first cache.
pub const BLOCK: usize = 64;

/// The blocks of a range of points.
pub fn blocks(range: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    let end = range.end;
    range
        .step_by(BLOCK)
        .map(move |start| start..(start + BLOCK).min(end))
}
