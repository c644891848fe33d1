//! Envelope and phase misfits in the time-frequency plane, and the goodness of fit.
//!
//! Kristekova, Kristek, Moczo 2009 (Geophys. J. Int. 178, 813-825,
//! doi 10.1111/j.1365-246X.2009.04177.x): single-valued misfits against a reference, globally
//! normalised. With the continuous wavelet transforms W of a signal and R of the reference (Morlet
//! wavelet, omega0 = 6), summed over times, logarithmically spaced frequencies and components:
//!
//! ```text
//! EM^2 = sum (|W| - |R|)^2          / sum |R|^2        EG = 10 exp(-EM)
//! PM^2 = sum (|R| arg(W/R) / pi)^2  / sum |R|^2        PG = 10 (1 - PM)
//! ```
//!
//! Decided here, where the paper leaves a choice:
//! - **Components** of a vector are joined as above, by sums over them: one number a receiver, which
//!   does not depend on a component that hardly moves.
//! - **Frequencies** are those at which the reference's amplitude spectrum (root of the sum of squares
//!   over components) exceeds [`SHARE`] of its peak: what the reference has no energy in, no misfit can
//!   be normalised by. From below they are bounded by the record, in which the wavelet's range (to
//!   1/e of its middle, either way) must find room, from above by the sampling.
//! - **Before and after** the record both signals are taken to be at rest.
//! - **Goodness** is the smaller of EG and PG; the paper names both excellent from 8, good from 6, fair
//!   from 4, poor below.

use super::arrival::uniform_step;
use super::{NormError, Score, Trace, Traces};
use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};
use std::f64::consts::{PI, SQRT_2};
use std::sync::Arc;

/// Frequencies count whose amplitude exceeds this share of the spectrum's peak.
pub const SHARE: f64 = 0.05;

/// Angular frequency of the Morlet wavelet at unit scale.
const OMEGA0: f64 = 6.0;

/// Frequencies an octave: neighbours overlap, since a wavelet is a sixth of its frequency wide.
const VOICES: f64 = 12.0;

/// The spectrum of a wavelet is at round-off beyond this multiple of its frequency.
const REACH: f64 = 2.0;

/// Sampling allows frequencies up to this share of the Nyquist frequency: a wavelet is cut there four
/// of its widths away from its middle.
const BELOW_NYQUIST: f64 = 0.6;

/// How far a receiver's series is from its reference.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    /// Name of the receiver.
    pub receiver: String,
    /// Single-valued envelope misfit EM; 0 is perfect, a factor 1 + e in amplitude gives e.
    pub envelope: f64,
    /// Single-valued phase misfit PM, 0..1; 0 is perfect, a phase shift phi gives phi/pi.
    pub phase: f64,
}

impl Misfit {
    /// The smaller of EG and PG, 0..10; 10 is perfect.
    pub fn goodness(&self) -> f64 {
        let envelope = 10.0 * (-self.envelope).exp();
        let phase = 10.0 * (1.0 - self.phase);
        envelope.min(phase)
    }

    /// One of its numbers as a score.
    pub fn score(&self, of: impl Fn(&Misfit) -> f64) -> Score {
        Score::new(&self.receiver, of(self))
    }
}

/// Misfits of all receivers; times must be uniform.
pub fn misfits(method: &Traces, reference: &Traces) -> Result<Vec<Misfit>, NormError> {
    let pairs = method.pair(reference, "the reference")?;
    let transform = Transform::new(method.times().len(), uniform_step(method.times())?);
    pairs
        .into_iter()
        .map(|(mine, truth)| transform.misfit(mine, truth))
        .collect()
}

/// The transform of series of one length and step.
struct Transform {
    samples: usize,
    /// Length with the silence behind the record, a power of two.
    padded: usize,
    /// Distance between spectral lines (Hz).
    line: f64,
    forward: Arc<dyn Fft<f64>>,
}

impl Transform {
    fn new(samples: usize, step: f64) -> Self {
        // The longest wavelet is down to 1e-5 of its middle there.
        let padded = (3 * samples).next_power_of_two();
        Transform {
            samples,
            padded,
            line: 1.0 / (padded as f64 * step),
            forward: FftPlanner::new().plan_fft_forward(padded),
        }
    }

    fn misfit(&self, mine: &Trace, truth: &Trace) -> Result<Misfit, NormError> {
        let spectra = |trace: &Trace| -> Vec<Vec<Complex<f64>>> {
            let components = trace.components.iter();
            components.map(|series| self.spectrum(series)).collect()
        };
        let (mine_lines, truth_lines) = (spectra(mine), spectra(truth));
        let what = format!("the reference at receiver {}", truth.name);
        let frequencies = self.frequencies(&truth_lines, &what)?;
        let plane = Plane::new(self, frequencies.last().copied().unwrap_or(0.0));
        let (mut envelope, mut phase, mut scale) = (0.0, 0.0, 0.0);
        for frequency in frequencies {
            let wavelet = plane.wavelet(frequency);
            for (mine, truth) in mine_lines.iter().zip(&truth_lines) {
                let (mine, truth) = (plane.row(mine, &wavelet), plane.row(truth, &wavelet));
                for (w, r) in mine.iter().zip(&truth) {
                    let amplitude = r.norm();
                    envelope += (w.norm() - amplitude).powi(2);
                    phase += (amplitude * (w * r.conj()).arg() / PI).powi(2);
                    scale += amplitude * amplitude;
                }
            }
        }
        Ok(Misfit {
            receiver: mine.name.clone(),
            envelope: (envelope / scale).sqrt(),
            phase: (phase / scale).sqrt(),
        })
    }

    /// Spectral lines at 0, 1, 2, ... times [`Self::line`] up to the Nyquist frequency.
    fn spectrum(&self, series: &[f64]) -> Vec<Complex<f64>> {
        let mut lines: Vec<Complex<f64>> = series.iter().map(|x| Complex::from(*x)).collect();
        lines.resize(self.padded, Complex::default());
        self.forward.process(&mut lines);
        lines.truncate(self.padded / 2);
        lines
    }

    /// Where the reference has energy, in steps of an octave's [`VOICES`]th.
    fn frequencies(
        &self,
        reference: &[Vec<Complex<f64>>],
        what: &str,
    ) -> Result<Vec<f64>, NormError> {
        let amplitude = |k: usize| {
            let squares = reference.iter().map(|lines| lines[k].norm_sqr());
            squares.sum::<f64>().sqrt()
        };
        let amplitudes: Vec<f64> = (0..self.padded / 2).map(amplitude).collect();
        let peak = amplitudes.iter().copied().fold(0.0, f64::max);
        if peak <= 0.0 {
            return Err(NormError::ZeroDenominator {
                what: what.to_owned(),
            });
        }
        let counts = |a: &f64| *a > SHARE * peak;
        let line = |k: Option<usize>| k.unwrap_or(0) as f64 * self.line;
        let duration = self.samples as f64 / (self.padded as f64 * self.line);
        let resolved = SQRT_2 * OMEGA0 / (PI * duration);
        let sampled = BELOW_NYQUIST * 0.5 * self.padded as f64 * self.line;
        let lowest = line(amplitudes.iter().position(counts)).max(resolved);
        let highest = line(amplitudes.iter().rposition(counts)).min(sampled);
        if highest < lowest {
            return Err(NormError::NoBand {
                what: what.to_owned(),
                lowest,
                highest,
            });
        }
        let octaves = (highest / lowest).log2();
        let steps = (octaves * VOICES).ceil().max(1.0);
        let at = |i: usize| lowest * (octaves * i as f64 / steps).exp2();
        Ok((0..=steps as usize).map(at).collect())
    }
}

/// Times by frequencies. Its rows are made from spectral lines, so that they can be sampled as
/// coarsely as the highest frequency allows, without aliasing.
struct Plane {
    line: f64,
    /// Spectral lines that a wavelet may reach.
    lines: usize,
    /// Samples of a row, silence included.
    length: usize,
    /// Samples of a row within the record.
    within: usize,
    inverse: Arc<dyn Fft<f64>>,
}

impl Plane {
    fn new(transform: &Transform, highest: f64) -> Self {
        let reached = (REACH * highest / transform.line).ceil() as usize + 1;
        let lines = reached.min(transform.padded / 2);
        let length = (2 * lines).next_power_of_two().min(transform.padded);
        Plane {
            line: transform.line,
            lines,
            length,
            within: (length * transform.samples).div_ceil(transform.padded),
            inverse: FftPlanner::new().plan_fft_inverse(length),
        }
    }

    /// The wavelet of a frequency (Hz) at the spectral lines, without the factors that cancel.
    fn wavelet(&self, frequency: f64) -> Vec<f64> {
        let scale = OMEGA0 / (2.0 * PI * frequency);
        let at = |k: usize| {
            let from_middle = OMEGA0 * (k as f64 * self.line / frequency - 1.0);
            scale.sqrt() * (-0.5 * from_middle * from_middle).exp()
        };
        (0..self.lines).map(at).collect()
    }

    /// The signal's part around the wavelet's frequency over the record's time.
    fn row(&self, lines: &[Complex<f64>], wavelet: &[f64]) -> Vec<Complex<f64>> {
        let mut row: Vec<Complex<f64>> = lines.iter().zip(wavelet).map(|(s, w)| s * w).collect();
        row.resize(self.length, Complex::default());
        self.inverse.process(&mut row);
        row.truncate(self.within);
        row
    }
}

#[cfg(test)]
mod tests;
