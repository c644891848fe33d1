//! The extended run of a study as reference of the others: the same scheme on the same mesh, free of
//! its outer end until a time that it knows. What differs from it is the boundary's alone.

use super::{Subject, traces};
use crate::runner::Run;
use crate::scene::{Quantity, Reference, Role, Window};
use anechoic_reference::claim::Evidence;
use anechoic_reports::judge::Measurement;
use anechoic_solver::boundary::extended;

/// The method whose run certifies the others of a study; `extended-...` are the same beside other sides.
pub const CERTIFIER: &str = "extended";

/// Name of the reference in rows.
const NAME: &str = "extended-run";

/// The run that certifies the others, if the study has it.
pub(super) fn certifier<'a>(runs: &[&'a Run]) -> Option<&'a Run> {
    runs.iter().copied().find(|run| certifies(run))
}

/// Is it an extended run?
pub(super) fn certifies(run: &Run) -> bool {
    let method = run.manifest.method.strip_prefix(CERTIFIER);
    method.is_some_and(|rest| rest.is_empty() || rest.starts_with('-')) && run.complete()
}

/// The extended run that tells of `run` what its boundary does: the same but for the sides that are extended, and
/// free of their ends until `run` ends.
pub(super) fn beside<'a>(run: &Run, runs: &[&'a Run]) -> Option<&'a Run> {
    let end = run.record.receivers.times.last().copied().unwrap_or(0.0);
    let sides = run.prepared.scene.boundary().sides();
    let serves = |other: &&Run| {
        let scene = &other.prepared.scene;
        let others = scene.boundary().sides();
        let mut pairs = others.as_flattened().iter().zip(sides.as_flattened());
        let alike = pairs.all(|(other, own)| other.method == extended::METHOD.name || other == own);
        certifies(other) && alike && scene.serves_until_s().is_some_and(|until| end <= until)
    };
    runs.iter().copied().find(serves)
}

/// Residuals of a run against the extended one, where a claim asks for them; of the extended run
/// itself, until when it serves.
///
/// # Errors
/// Why there is no reference; the claims are then not evaluated for the same reason.
pub(super) fn measure(
    run: &Run,
    extended: Option<&Run>,
    numbers: &mut Vec<Measurement>,
) -> Result<(), String> {
    let method = &run.manifest.method;
    if method == CERTIFIER
        && let Some(until) = run.prepared.scene.serves_until_s()
    {
        numbers.push(Measurement::of_run(method, "serves_until_s", until, "s"));
    }
    // A scene with a stored reference has no need of a run.
    let asked = run.prepared.scene.extended().is_none()
        && run.prepared.scene.pulse_amplitude().is_some()
        && run.prepared.scene.claims().iter().any(|claim| {
            run.manifest.judged_as() == Some(&claim.claim.method)
                && claim.claim.evidence == Evidence::Certified
                && claim.not_here.is_none()
        });
    if !asked {
        return Ok(());
    }
    let scene = &run.prepared.scene;
    let windows: Vec<Window> = scene
        .windows()
        .into_iter()
        .filter(|window| window.stated_by.is_none())
        .collect();
    let reference = match reference(run, extended) {
        Ok(reference) => reference,
        Err(reason) => {
            numbers.extend(windows.iter().map(|window| Measurement {
                method: method.clone(),
                metric: "residual".to_owned(),
                place: window.place(),
                value: Err(reason.clone()),
                unit: "1".to_owned(),
                against: Some((Evidence::Certified, NAME.to_owned())),
            }));
            return Err(reason);
        }
    };
    let subject = Subject {
        problem: &scene.posed(),
        method,
        reference: &reference,
        truth: super::traces_of(&reference, &run.record),
        run: traces(&run.record, reference.quantity),
        standard: None,
    };
    if let Some(amplitude) = scene.pulse_amplitude() {
        subject.residuals(&windows, amplitude, numbers);
    }
    Ok(())
}

/// The extended run's series, if there is one and it serves to the end of `run`.
fn reference(run: &Run, extended: Option<&Run>) -> Result<Reference, String> {
    let extended = extended.ok_or_else(|| {
        format!(
            "needs the run `{CERTIFIER}` of the same comparison: anechoic compare {} --method {CERTIFIER} --method {}",
            run.manifest.case, run.manifest.method
        )
    })?;
    let until = extended.prepared.scene.serves_until_s();
    let end = run.record.receivers.times.last().copied().unwrap_or(0.0);
    match until {
        Some(until) if end <= until => {}
        Some(until) => {
            return Err(format!(
                "the run `{CERTIFIER}` serves until {until:.3} s, when a wave can be back from its outer end, and not until {end:.3} s: a larger {CERTIFIER}.thickness_m, or none, which then follows the run"
            ));
        }
        None => return Err(format!("the run `{CERTIFIER}` has no extended side")),
    }
    let quantity = Quantity::Velocity;
    let series = traces(&extended.record, quantity).map_err(|error| error.to_string())?;
    let receivers = series.receivers().iter();
    let receivers = receivers.map(|trace| (trace.name.clone(), trace.components.clone()));
    Ok(Reference {
        name: NAME,
        role: Role::NoEcho,
        evidence: Evidence::Certified,
        quantity,
        receivers: receivers.collect(),
        pulses: false,
    })
}
