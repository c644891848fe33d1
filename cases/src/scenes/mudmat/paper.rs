//! What the paper says of the slide, and how it fares here.

use anechoic_reports::study::Finding;

/// Finding, place, note.
pub(super) const LEDGER: &[(Finding, &str, &str)] = &[
    (
        Finding::Differs,
        "section 3.2, Fig. 6, fluctuation at 0.44 s",
        "There is a dip at 0.44 s without absorbing boundaries, of 0.3 to 0.4 rho v^2, and the hybrid set-up takes it away: beside a slide that goes on a tenth of it is left on cells of e/10, 0.22 on e/20, 0.57 on the paper's e/40 (four points): the printed layer is a factor a step, so that short steps make it strong enough to send the wave back itself. By its rate (method `hybrid-rate`) it leaves 0.06, 0.09, 0.24. It is not the echo of the top, as the paper has it: the dashpot on the top leaves it whole, the layer at the left end takes it, and a slide of 50 m (preset `long`) has none at 0.44 s. It is the wave that the left end sends out as the slide starts, due over 20 m at c + v after 0.42 s.",
    ),
    (
        Finding::Reproduced,
        "section 3.2, Fig. 8, dashpot on the free top",
        "It leaves 4 to 5 % of the wave at B, on cells of e/10 and e/20, where the paper has less than 10 %.",
    ),
    (
        Finding::Reproduced,
        "section 3.2, echo of the left end",
        "It reaches the mudmat after 0.84 s with the plain inflow, as 0.8 rho v^2 on cells of e/20, and not with the layer.",
    ),
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
