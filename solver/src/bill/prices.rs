//! What a pass over points or nodes costs, measured, and how many passes a step makes.

use crate::problem::{BasisKind, MassKind, Problem, SolverKind};
use crate::tensor::Vector;

/// CPU times (ns) in two dimensions, of a point or a node. Smallest of ten samples of
/// `cargo bench -p anechoic-solver --bench pass` on a core of a server of 2023: 120,000 points, four
/// a cell.
#[derive(Clone, Copy, Debug)]
pub(super) struct Prices {
    /// A nodal vector to a point.
    pub gather: f64,
    /// A vector of a point to its nodes.
    pub scatter: f64,
    /// The same with its gradient.
    pub affine: f64,
    /// Gradient, small-strain stress, force.
    pub small_force: f64,
    /// Gradient, finite-strain stress, force.
    pub finite_force: f64,
    /// Gradient, finite-strain moduli.
    pub moduli: f64,
    /// Stiffness of a point into the matrix.
    pub tangent: f64,
    /// Consistent mass of a point into the matrix.
    pub mass: f64,
    /// Nodes and shape functions of a point.
    pub find: f64,
    /// A node's row of the matrix times a vector.
    pub product: f64,
    /// A node in an iteration of conjugate gradients.
    pub iteration: f64,
}

/// Four nodes a point, nine couplings a node.
const LINEAR: Prices = Prices {
    gather: 13.0,
    scatter: 8.0,
    affine: 61.0,
    small_force: 32.0,
    finite_force: 86.0,
    moduli: 185.0,
    tangent: 350.0,
    mass: 80.0,
    find: 104.0,
    product: 27.0,
    iteration: 46.0,
};

/// Nine nodes a point, 25 couplings a node.
const WIDE: Prices = Prices {
    gather: 23.0,
    scatter: 14.0,
    affine: 130.0,
    small_force: 54.0,
    finite_force: 107.0,
    moduli: 190.0,
    tangent: 1520.0,
    mass: 650.0,
    find: 225.0,
    product: 72.0,
    iteration: 91.0,
};

/// A node's vectors in one look at the balance of forces, and in a step around it (ns).
pub(super) const BALANCE: f64 = 40.0;
pub(super) const STEP: f64 = 40.0;
/// A place of a line, a snapshot or a receiver (ns).
pub(super) const PLACE: f64 = 60.0;

/// Iterations that a triangular solve is worth, and a factorisation.
const SOLVE: f64 = 8.0;
const FACTOR: f64 = 40.0;

impl Prices {
    pub(super) fn of(basis: BasisKind) -> Self {
        match basis {
            BasisKind::Linear => LINEAR,
            BasisKind::Gimp | BasisKind::Bspline => WIDE,
        }
    }
}

/// Symbols of a basis along an axis at the wave number where its stiffness is largest: mass, and
/// stiffness over that of linear functions.
fn symbols(basis: BasisKind) -> (f64, f64) {
    match basis {
        BasisKind::Bspline => (0.133, 1.0 / 3.0),
        _ => (1.0 / 3.0, 1.0),
    }
}

/// Iterations of conjugate gradients that a linear solve is expected to need, from the condition of
/// `4 M/dt^2 + K` on an endless mesh: a quarter of dt^2 K over M is (c dt/h)^2 at most.
pub(super) fn iterations<const D: usize>(problem: &Problem<D>, h: &Vector<D>) -> f64 {
    let least = h.iter().copied().fold(f64::INFINITY, f64::min);
    let courant = |speed: f64| (speed * problem.dt / least).powi(2);
    let (p, s) = (
        courant(problem.stiffest().p_speed()),
        courant(problem.stiffest().s_speed()),
    );
    let (blur, stiff) = symbols(problem.basis);
    let inertia = match problem.mass {
        MassKind::Lumped => 1.0,
        MassKind::Consistent => blur,
    };
    let spectrum = [
        1.0,
        inertia + stiff * p,
        inertia + stiff * s,
        inertia * inertia + stiff * blur * (p + s),
    ];
    let most = spectrum.iter().copied().fold(0.0, f64::max);
    let least = spectrum.iter().copied().fold(f64::INFINITY, f64::min);
    let root = (most / least).sqrt().max(1.0 + 1e-6);
    (2.0 / problem.rel_tol).ln() / ((root + 1.0) / (root - 1.0)).ln()
}

/// A linear solve in iterations of conjugate gradients: theirs, or what a factorisation is worth.
pub(super) fn solve_in_iterations<const D: usize>(
    problem: &Problem<D>,
    h: &Vector<D>,
    varying: bool,
) -> f64 {
    let needed = iterations(problem, h);
    let direct = match problem.solver {
        SolverKind::Direct => true,
        SolverKind::Cg => false,
        SolverKind::Auto => needed > crate::linear::ITERATIONS_WORTH_A_FACTOR as f64,
    };
    match (direct, varying) {
        (false, _) => needed,
        (true, false) => SOLVE,
        (true, true) => SOLVE + FACTOR,
    }
}
