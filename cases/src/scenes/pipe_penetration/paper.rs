//! What the paper says of the pipe, and how it fares here.

use anechoic_reports::study::Finding;

/// Finding, place, note.
pub(super) const LEDGER: &[(Finding, &str, &str)] = &[
    (
        Finding::Differs,
        "section 3.3, wave speed",
        "The printed 178 m/s is sqrt(lambda/rho). Compressional waves run at sqrt((lambda + 2 G)/rho) = 181.4 m/s, with which the echo of the base meets the pipe at the stated w/D = 0.172.",
    ),
    (
        Finding::Differs,
        "section 3.3, Courant number",
        "At the stated 0.4 points of the heaved surface beside the pipe are inverted on cells of D/64 and finer, with B-splines and affine; at 0.2 they are not. GIMP, flip with 5 % of pic and MUSL go through at 0.4.",
    ),
    (
        Finding::UnderSpecified,
        "section 3.3, contact",
        "How the pipe touches nodes is not stated. Here a node is touched when a point's box touches the pipe and the node lies inside it or within half a cell.",
    ),
];
