//! Fixed side: all displacements are held.

use super::params::{MethodInfo, SideMethod, Upkeep};
use super::{Context, End, Layout, Parts, walls};
use crate::error::SolverError;
use crate::problem::{Problem, Side};

/// The method's entry.
pub static METHOD: MethodInfo = MethodInfo {
    name: "fixed",
    summary: "all displacements held",
    params: &[],
    ladder: &[],
    extremes: &[],
    passive: true,
    upkeep: Upkeep::none,
};

pub(crate) fn layout<const D: usize>(
    _problem: &Problem<D>,
    _side: Side,
    _method: &SideMethod,
) -> Result<Layout, SolverError> {
    Ok(Layout::plain(End::Fixed))
}

pub(crate) fn build<const D: usize>(context: &Context<'_, D>) -> Result<Parts<D>, SolverError> {
    Ok(Parts::of_terms(walls(context)))
}
