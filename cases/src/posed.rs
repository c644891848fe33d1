//! A problem in the plane or in space, as a scene poses it: what does not care for the number of dimensions
//! asks here, or matches once by [`either!`].

use anechoic_solver::error::SolverError;
use anechoic_solver::problem::{Aabb, Drive, Elastic, Problem};
use anechoic_solver::wavelet::Pulse;
use anechoic_solver::{Bill, Monitor, Outcome, bill, solve};

/// What the solver is given.
#[derive(Clone, Debug)]
pub enum Posed {
    /// Plane strain.
    Plane(Problem<2>),
    /// Three dimensions.
    Space(Problem<3>),
}

/// The same expression of the problem in either number of dimensions.
macro_rules! either {
    ($posed:expr, $problem:ident => $value:expr) => {
        match $posed {
            $crate::posed::Posed::Plane($problem) => $value,
            $crate::posed::Posed::Space($problem) => $value,
        }
    };
}
pub(crate) use either;

impl From<Problem<2>> for Posed {
    fn from(problem: Problem<2>) -> Self {
        Posed::Plane(problem)
    }
}

impl From<Problem<3>> for Posed {
    fn from(problem: Problem<3>) -> Self {
        Posed::Space(problem)
    }
}

impl Posed {
    /// The problem in the plane; `None` in space.
    pub fn plane(self) -> Option<Problem<2>> {
        match self {
            Posed::Plane(problem) => Some(problem),
            Posed::Space(_) => None,
        }
    }

    /// Solves it.
    ///
    /// # Errors
    /// As [`solve`].
    pub fn solve(&self, monitor: &dyn Monitor) -> Result<Outcome, SolverError> {
        either!(self, problem => solve(problem, monitor))
    }

    /// Its bill.
    ///
    /// # Errors
    /// As [`bill`].
    pub fn bill(&self) -> Result<Bill, SolverError> {
        either!(self, problem => bill(problem))
    }

    /// Length of a step (s).
    pub fn dt(&self) -> f64 {
        either!(self, problem => problem.dt)
    }

    /// End of the run as asked (s).
    pub fn end_time(&self) -> f64 {
        either!(self, problem => problem.end_time)
    }

    /// Time of the last step (s).
    pub fn last_time(&self) -> f64 {
        either!(self, problem => problem.last_time())
    }

    /// The material.
    pub fn material(&self) -> &Elastic {
        either!(self, problem => &problem.material)
    }

    /// Shortest edge of the body (m).
    pub fn narrowest(&self) -> f64 {
        fn of<const D: usize>(body: &Aabb<D>) -> f64 {
            let edges = body.upper.iter().zip(&body.lower).map(|(u, l)| u - l);
            edges.fold(f64::INFINITY, f64::min)
        }
        either!(self, problem => of(&problem.target))
    }

    /// What drives it, over time: forces or velocities.
    pub fn pulses(&self) -> Vec<Pulse> {
        fn of<const D: usize>(problem: &Problem<D>) -> Vec<Pulse> {
            let drives = problem.drives.iter();
            drives
                .map(|drive| match drive {
                    Drive::SideVelocity { pulse, .. } | Drive::PointForce { pulse, .. } => *pulse,
                })
                .collect()
        }
        either!(self, problem => of(problem))
    }

    /// Points in a cell when there is one more along each axis.
    pub fn with_points_more(&self) -> usize {
        fn of<const D: usize>(problem: &Problem<D>) -> usize {
            let along = (problem.points_per_cell as f64)
                .powf(1.0 / D as f64)
                .round();
            (along as usize + 1).pow(D as u32)
        }
        either!(self, problem => of(problem))
    }

    /// Names and places (m) of the receivers.
    pub fn receivers(&self) -> Vec<(String, Vec<f64>)> {
        fn of<const D: usize>(problem: &Problem<D>) -> Vec<(String, Vec<f64>)> {
            let receivers = problem.probes.receivers.iter();
            receivers
                .map(|r| (r.name.clone(), r.place.to_vec()))
                .collect()
        }
        either!(self, problem => of(problem))
    }
}
