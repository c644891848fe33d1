//! How alike a run and what is true of it look in time and frequency, as seismologists say it.

use super::Subject;
use anechoic_reports::judge::Measurement;
use anechoic_reports::norms::{Misfit, misfits, with_groups, with_groups_of_goodness};

/// Envelope and phase misfits, and the goodness of fit.
pub(super) fn measure(subject: &Subject<'_>, numbers: &mut Vec<Measurement>) {
    let found = subject.pair().and_then(|(run, truth)| misfits(run, truth));
    let scores = |of: fn(&Misfit) -> f64| {
        let found = found.clone()?;
        Ok(found.iter().map(|misfit| misfit.score(of)).collect())
    };
    let grouped = |of| scores(of).and_then(|scores: Vec<_>| with_groups(&scores));
    subject.put("envelope_misfit", "1", grouped(|m| m.envelope), numbers);
    subject.put("phase_misfit", "1", grouped(|m| m.phase), numbers);
    let goodness = scores(Misfit::goodness);
    let goodness = goodness.and_then(|scores| with_groups_of_goodness(&scores));
    subject.put("goodness", "1", goodness, numbers);
}
