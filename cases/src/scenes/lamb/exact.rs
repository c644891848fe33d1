//! What is true of the half-space at the receivers.

use super::Lamb;
use crate::half_space::Direction;
use crate::scene::{Quantity, Reference, Role, Scene};
use crate::spec::ReceiverSpec;
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_reference::analytic::lamb::{self, Response};
use anechoic_reference::claim::Evidence;
use anechoic_solver::wavelet::{Pulse, Wavelet};

/// Name in rows.
const NAME: &str = "lamb";

/// A Ricker wavelet that starts with a larger share of its peak than this has a jump.
const SILENT_START: f64 = 1e-6;

/// One that starts with more than this is refused: where a jump passes, the surface's displacement has
/// no limit, and neither quadrature nor mesh has a value for it.
pub(super) const LARGEST_START: f64 = 1e-3;

/// How smooth a force is on its whole line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Smoothness {
    /// For every purpose: a Ricker wavelet that starts in silence.
    Smooth,
    /// Its second derivative jumps: sin^2, and what rises like it.
    Bent,
    /// Its first derivative jumps: sine, half a sine; or itself does a little: a Ricker wavelet that is
    /// cut at its start.
    Kinked,
}

impl Smoothness {
    pub(super) fn of(pulse: &Pulse) -> Self {
        match pulse.wavelet {
            Wavelet::Ricker if pulse.value(0.0).abs() <= SILENT_START * pulse.amplitude => {
                Smoothness::Smooth
            }
            Wavelet::SineSquared | Wavelet::Step => Smoothness::Bent,
            Wavelet::Ricker | Wavelet::Sine | Wavelet::HalfSine => Smoothness::Kinked,
        }
    }
}

/// What the half-space does: it judges the method, and, as long as nothing can come back from an
/// extended end, the solver. Panels of the quadrature are `finer` times as long as usual.
pub(super) fn references(
    scene: &Lamb,
    times: &[f64],
    finer: f64,
) -> Result<Vec<Reference>, String> {
    if scene.boundary.top.method != "free" {
        return Err(format!(
            "Lamb's half-space has boundary.top = free, here it is {}",
            scene.boundary.top.method
        ));
    }
    if let Some(ratio) = scene.material.inclusion {
        return Err(format!(
            "Lamb's half-space has one stiffness, here material.inclusion is {ratio}"
        ));
    }
    let no_echo = Reference {
        name: NAME,
        role: Role::NoEcho,
        evidence: Evidence::Analytic,
        quantity: Quantity::Displacement,
        receivers: scene
            .receivers
            .iter()
            .map(|receiver| {
                let motion = motion(scene, receiver, times, finer * panel(&scene.source.pulse()))
                    .map_err(|reason| format!("receiver {}: {reason}", receiver.name))?;
                Ok((receiver.name.clone(), motion.to_vec()))
            })
            .collect::<Result<_, String>>()?,
        // P, S and Rayleigh waves overlap.
        pulses: false,
    };
    if !is_half_space(scene) {
        return Ok(vec![no_echo]);
    }
    let modelled = Reference {
        role: Role::Modelled,
        ..no_echo.clone()
    };
    Ok(vec![no_echo, modelled])
}

/// Is the mesh a half-space until the end of the run?
fn is_half_space(scene: &Lamb) -> bool {
    let sides = &scene.boundary;
    let extended = [&sides.left, &sides.right, &sides.bottom].map(|side| side.method == "extended");
    extended == [true; 3]
        && scene
            .serves_until_s()
            .is_some_and(|until| scene.time.end_s <= until)
}

/// Displacement (m) of a receiver, x and y, by panels (s) of the quadrature.
fn motion(
    scene: &Lamb,
    receiver: &ReceiverSpec,
    times: &[f64],
    panel: f64,
) -> Result<[Vec<f64>; 2], String> {
    let material = &scene.material;
    let material = Elastic::new(material.youngs_modulus, material.nu, material.rho_kg_m3)
        .map_err(|error| error.to_string())?;
    let direction = match scene.source.direction {
        Direction::Vertical => lamb::Direction::Vertical,
        Direction::Horizontal => lamb::Direction::Horizontal,
    };
    let pulse = scene.source.pulse();
    let end = times.last().copied().unwrap_or(scene.time.end_s);
    let offset = receiver.x_m - scene.source.x_m;
    // -0.0 at the surface is no depth below it.
    let depth = (-receiver.y_m).max(0.0);
    let series = Response::new(&material, offset, depth, end, panel)
        .and_then(|response| response.series(direction, |t| pulse.value(t), times))
        .map_err(|error| error.to_string())?;
    Ok([0, 1].map(|axis| series.iter().map(|u| u[axis]).collect()))
}

/// Longest panel (s) of the reference's quadrature: a quarter of a period where the force is smooth.
/// Gauss points that straddle a kink converge slowly, so that a force with kinks gets a fiftieth.
fn panel(pulse: &Pulse) -> f64 {
    let share = match Smoothness::of(pulse) {
        Smoothness::Smooth => 0.25,
        Smoothness::Bent | Smoothness::Kinked => 0.02,
    };
    share / pulse.frequency
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finer_panels_change_nothing_that_is_judged() {
        let times: Vec<f64> = (0..=300).map(|i| 0.01 * f64::from(i)).collect();
        for (wavelet, t0_s, allowed) in [
            (Wavelet::Ricker, 0.5, 1e-7),
            (Wavelet::Ricker, 0.34, 1e-3),
            (Wavelet::SineSquared, 0.5, 1e-4),
            (Wavelet::Sine, 0.5, 1e-3),
            (Wavelet::HalfSine, 0.5, 1e-3),
            (Wavelet::Step, 0.5, 1e-4),
        ] {
            let mut scene = Lamb::default();
            (scene.source.wavelet, scene.source.t0_s) = (wavelet, t0_s);
            let panel = panel(&scene.source.pulse());
            for receiver in &scene.receivers {
                let by = |panel| motion(&scene, receiver, &times, panel).unwrap();
                let (used, fine) = (by(panel), by(0.25 * panel));
                let vector = |u: &[Vec<f64>; 2], i: usize| [u[0][i], u[1][i]];
                let (mut peak, mut change) = (0.0_f64, 0.0_f64);
                for i in 0..times.len() {
                    let ([x, y], [fine_x, fine_y]) = (vector(&used, i), vector(&fine, i));
                    peak = peak.max(fine_x.hypot(fine_y));
                    change = change.max((x - fine_x).hypot(y - fine_y));
                }
                let name = &receiver.name;
                assert!(
                    change < allowed * peak,
                    "{wavelet:?}, t0 = {t0_s} s, {name}: {:e}",
                    change / peak
                );
            }
        }
    }
}
