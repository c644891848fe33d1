//! What the paper says of the slide, and how it fares here.

use anechoic_reports::study::Finding;

/// Finding, place, note.
pub(super) const LEDGER: &[(Finding, &str, &str)] = &[
    (
        Finding::Differs,
        "Eq (9), rate of shear",
        "As printed the rate is the difference of the eigenvalues of the velocity gradient itself, which vanishes in simple shear. Here it is that of its symmetric part.",
    ),
    (
        Finding::UnderSpecified,
        "section 3.2, stress at the start",
        "Not stated. The weight is carried from the start, the horizontal stress nu/(1 - nu) of the vertical one; the preset `weightless` has neither.",
    ),
];
