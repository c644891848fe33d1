//! Extended domain: plain material, so much of it that no wave comes back during the run.
//!
//! Not an absorber but the honest competitor, and what certifies itself: the fastest wave from any
//! place of the body to the outer end and back needs at least `2 thickness / c_p`. Material that flows in from the
//! start does so at the outer end too; any other end is fixed.

use super::params::{Ladder, MethodInfo, Param, ParamKind, Rungs, SideMethod, Upkeep};
use super::{Context, End, Layout, Parts, inflow, walls};
use crate::error::SolverError;
use crate::problem::{Problem, Side};

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "extended",
    summary: "plain material added so that no wave comes back during the run",
    params: &[Param {
        name: "thickness_m",
        doc: "material added; by default as much as the fastest wave needs not to come back before the end",
        kind: ParamKind::Number {
            unit: "m",
            default: None,
            min: 1e-9,
            max: 1e9,
        },
    }],
    ladder: &[Ladder {
        param: "thickness_m",
        rungs: Rungs::Cells(&[10.0, 25.0, 50.0, 100.0, 150.0, 200.0]),
    }],
    extremes: &[],
    passive: true,
    upkeep: Upkeep::none,
};

/// Implicit schemes spread a little of everything a few cells ahead of the wave.
const CELLS_AHEAD: f64 = 10.0;

pub(crate) fn layout<const D: usize>(
    problem: &Problem<D>,
    side: Side,
    method: &SideMethod,
) -> Result<Layout, SolverError> {
    let end = if problem.flow.velocity[side.axis] == 0.0 {
        End::Fixed
    } else {
        inflow::check(problem, side)?;
        End::Inflow
    };
    Ok(Layout {
        outside: thickness(problem, method),
        inside: 0.0,
        end,
        layer: None,
    })
}

/// Material added (m), before it is rounded up to whole cells.
pub fn thickness<const D: usize>(problem: &Problem<D>, method: &SideMethod) -> f64 {
    method.given_number("thickness_m").unwrap_or_else(|| {
        let needed = 0.5 * problem.material.p_speed() * problem.last_time();
        needed + CELLS_AHEAD * problem.cell_size
    })
}

pub(crate) fn build<const D: usize>(context: &Context<'_, D>) -> Result<Parts<D>, SolverError> {
    Ok(Parts::of_terms(walls(context)))
}
