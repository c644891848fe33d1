//! What is true of the half-space, and what is claimed of the solver.

use super::Lamb;
use crate::half_space::Direction;
use crate::scene::{Quantity, Reference, Role, Scene, SceneClaim};
use crate::spec::ReceiverSpec;
use anechoic_reference::analytic::elastic::Elastic;
use anechoic_reference::analytic::lamb::{self, Response};
use anechoic_reference::claim::Evidence;
use anechoic_solver::wavelet::{Pulse, Wavelet};

/// Name in rows.
const NAME: &str = "lamb";

/// A Ricker wavelet that starts with a larger share of its peak than this has a jump.
const SILENT_START: f64 = 1e-6;

/// What the half-space does: it judges the method, and, as long as nothing can come back from an
/// extended end, the solver.
pub(super) fn references(scene: &Lamb, times: &[f64]) -> Result<Vec<Reference>, String> {
    if scene.boundary.top.method != "free" {
        return Err(format!(
            "Lamb's half-space has boundary.top = free, here it is {}",
            scene.boundary.top.method
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
                let motion = motion(scene, receiver, times)
                    .map_err(|reason| format!("receiver {}: {reason}", receiver.name))?;
                Ok((receiver.name.clone(), motion))
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

/// Displacement (m) of a receiver, x and y.
fn motion(scene: &Lamb, receiver: &ReceiverSpec, times: &[f64]) -> Result<[Vec<f64>; 2], String> {
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
    let series = Response::new(&material, offset, depth, end, panel(&pulse))
        .and_then(|response| response.series(direction, |t| pulse.value(t), times))
        .map_err(|error| error.to_string())?;
    Ok([0, 1].map(|axis| series.iter().map(|u| u[axis]).collect()))
}

/// Longest panel (s) of the reference's quadrature: a quarter of a period where the force is smooth
/// on its whole line. Panels that straddle a kink converge slowly, so that a force with kinks gets a
/// twenty-fifth of a period.
fn panel(pulse: &Pulse) -> f64 {
    let smooth = match pulse.wavelet {
        Wavelet::Ricker => pulse.value(0.0).abs() <= SILENT_START * pulse.amplitude,
        Wavelet::Sine | Wavelet::HalfSine | Wavelet::SineSquared => false,
    };
    (if smooth { 0.25 } else { 0.04 }) / pulse.frequency
}

/// The claims, for the scene as run.
pub(super) fn claims(_scene: &Lamb) -> Vec<SceneClaim> {
    Vec::new()
}
