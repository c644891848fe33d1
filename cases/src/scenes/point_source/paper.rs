//! What the paper says of the point source, and how it fares here.

use super::PointSource;
use crate::half_space::Direction;
use anechoic_reports::study::Finding;
use anechoic_solver::wavelet::Wavelet;

/// Which of the paper's tests the scene is, if its load and its metric's window are that test's.
pub(super) fn test(scene: &PointSource) -> Option<&'static str> {
    let (source, papers) = (&scene.source, PointSource::default());
    let same = source.direction == Direction::Vertical
        && scene.t1_s == papers.t1_s
        && scene.time.end_s == papers.time.end_s
        && scene.material == papers.material;
    match (source.wavelet, source.frequency, source.amplitude) {
        _ if !same => None,
        (Wavelet::Sine, 2.0, 1e6) => Some("Test 1"),
        (Wavelet::Sine, 2.0, 1e8) => Some("Test 2"),
        (Wavelet::Ricker, 3.0, 1e6) => Some("Test 3"),
        _ => None,
    }
}

/// Finding, place, note.
pub(super) const LEDGER: &[(Finding, &str, &str)] = &[
    (
        Finding::Reproduced,
        "section 3.1, order of the groups",
        "Late amplitudes over those of the standard run: the paper prints 10 / 12.1 / 12.0 % (A/B/C, Test 1). With frozen points and nodes that keep their motion the published layer leaves 5.1 / 13.5 / 10.8 % here. The paper's metric has a floor: waves that never met a boundary score 0.6 / 2.1 / 4.7 %.",
    ),
    (
        Finding::Differs,
        "section 3.1, Test 3",
        "The paper prints 10.1 / 13.5 / 11.6 % for the Ricker wavelet; the published layer leaves 1.9 / 6.6 / 26.3 % here, of which 0.1 / 0.1 / 18.9 % are waves that never met a boundary: at C3 they still pass after 5 s. Free of that floor the echo is 1.9 / 6.5 / 8.2 %, and 0.16 / 0.23 / 0.27 % with a true layer of 10 cells.",
    ),
    (
        Finding::Differs,
        "Eqs (8)-(9), absorbing by stretch",
        "C' = C/(i omega) makes the stretch real. It slows the wave and absorbs nothing: without Rayleigh damping and memory the echo is 36 / 158 / 84 % with frozen points, and the energy grows by 0.05 per second. What absorbs are the Rayleigh term and the displacement sent to nodes and back in every step, Eqs (17a) and (18); see `anechoic ablation point-source`.",
    ),
    (
        Finding::Differs,
        "Eqs (8) and (11), other materials",
        "Each row is stretched by its own C'_j alone, so that the symbol of the equations loses its positive determinant where c_p/c_s exceeds 1 + sqrt 2 (nu above 0.396): there they are ill-posed in the layer, plane waves grow the faster the shorter they are, and no damping independent of the wave's length helps. Largest real part of the semi-discrete spectrum with alpha_M = 1/s on a small mesh, cells of 20 and 10 m: -0.2, -0.1 per second at nu = 0.25; 0.8, 0.9 at 0.4; 16, 35 at 0.45; 59, 142 at 0.49. The paper's own nu = 0.25 is not concerned.",
    ),
    (
        Finding::Differs,
        "section 3.1, 50 cells of layer",
        "A true perfectly matched layer of 10 cells (a fifth of the thickness) leaves 0.41 / 0.95 / 0.47 % where the published one of 50 leaves 5.0 / 13.0 / 10.2 % (echo ratio, frozen points).",
    ),
    (
        Finding::Reproduced,
        "Eq (18), whose displacement",
        "It is of all particles. With the published transfer and 120,000 moving points (preset `paper-transfer`) the echo is 3.3 / 11.5 / 9.6 %. Where the layer's particles alone take the nodes' displacement, the nodes between body and layer mix filtered and unfiltered motion, and 7.1 / 10.5 / 10.2 % comes back.",
    ),
    (
        Finding::Differs,
        "Eq (10)",
        "The sign of the divergence term is misprinted; the balance of momentum is used.",
    ),
    (
        Finding::Differs,
        "Eqs (22) and (25)",
        "They exchange lambda and G against Eq (11). At nu = 0.25 both are equal and nothing shows; Eq (11) is used.",
    ),
    (
        Finding::Differs,
        "Eqs (37) and (43)",
        "The printed factor (1 + c)(E_inf - E0)/E_inf must be 1 + c (E_inf - E0)/E0, from Eqs (28) and (40).",
    ),
    (
        Finding::UnderSpecified,
        "section 3.1, geometry",
        "The places of the receivers, the 1000 m of layer and the 20,000 + 60,000 points cannot all hold. By default the receivers' places do: the target is 2000 x 2000 m with 40,000 points. Preset `counts` has the printed numbers of points; B3, B4, C2 and C3 then lie in the layer and are left out.",
    ),
    (
        Finding::UnderSpecified,
        "section 3.1, receivers C2 and C3",
        "(1105, 1105) and (1865, 1865) as printed leave the diagonal that C1 is on: they lack the offset of 1000 m in x. (2105, 1105) and (2865, 1865) are used.",
    ),
    (
        Finding::UnderSpecified,
        "Fig. 4, place of the source",
        "Not given in the text; (1120, 0) is used.",
    ),
    (
        Finding::UnderSpecified,
        "Fig. 5, pulses",
        "Shapes and amplitudes stand in the figure alone. Test 1: one full sine of 2 Hz, 1e6 N/m; Test 2: 100 times that; Test 3: a Ricker wavelet of 3 Hz centred at 0.5 s. Half a sine (preset `half-sine`) leaves a slow tail that the paper's metric takes for echo.",
    ),
    (
        Finding::UnderSpecified,
        "section 3.1, standard run",
        "What \"without absorbing particles\" means is not said: the mesh of the same size, elastic throughout and fixed at its outer edge, is used; the method `fixed-at-target` ends at the target.",
    ),
];
