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
        "The stated 0.4 goes through to the end on coarser cells than the paper's, fast on cells of D/64 and slowly on D/32. It takes an F-bar whose divergence is the mean over the points of a cell: with that of the cell's centre points of the heaved surface are inverted. On the paper's cells of D/80 with sixteen points it takes a share of pic of 0.01 as well, or what splashes is inverted in the air at w/D = 0.41.",
    ),
    (
        Finding::Differs,
        "section 3.3, dashpots",
        "They keep within 5 % of soil that goes on to w/D = 0.43, and leave 5.6 % to w/D = 0.5 on the paper's cells and points (3.2 % to w/D = 0.3 on D/16).",
    ),
    (
        Finding::Differs,
        "section 3.3, damping layer",
        "1 m of layer with alpha = 0.005 leaves a fluctuation of 18 (D/16) to 25 % (the paper's cells), not 5. No strength of such a layer does: at best 6 % (900/s, free end; to w/D = 0.3, cells of D/16). 4 m, growing with the square to 227/s with a free end, leave 3.5 % to w/D = 0.5 (method `damping-layer-thick`), for 6.8 times the points of the soil; 0.5 m of the true layer 0.2 %.",
    ),
    (
        Finding::UnderSpecified,
        "section 3.3, contact",
        "How the pipe touches nodes is not stated. Here a node is touched when a point's box touches the pipe and the node lies inside it or within half a cell.",
    ),
];
