//! The certified references that a study needs.

use crate::certified::key;
use crate::certified::library::Library;
use crate::error::CaseError;
use crate::posed::Posed;
use crate::prepare::Prepared;
use crate::runner::pool;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A reference that scenes need.
pub(super) struct Wanted {
    /// Hash by which it is found.
    pub hash: String,
    /// The case that names it.
    pub case: &'static str,
    /// The problem of the scene that ends last.
    pub problem: Posed,
}

impl Wanted {
    /// Is there none that serves until the problem's end?
    pub fn is_missing(&self, library: &Library) -> Result<bool, CaseError> {
        let found = library.find(self.case, &self.problem)?;
        Ok(found.is_none_or(|found| found.about.serves(self.problem.last_time()).is_err()))
    }
}

/// The references that the scenes need, each once, in the order of their hashes.
pub(super) fn wanted<'a>(scenes: impl IntoIterator<Item = &'a Prepared>) -> Vec<Wanted> {
    let mut wanted: BTreeMap<String, Wanted> = BTreeMap::new();
    for scene in scenes {
        let Some(problem) = scene.scene.extended() else {
            continue;
        };
        let hash = key::hash_of(&problem);
        let known = wanted.get(&hash);
        // Scenes that differ in their end alone share a reference, which has to serve them all.
        if known.is_none_or(|known| known.problem.last_time() < problem.last_time()) {
            let one = Wanted {
                hash: hash.clone(),
                case: scene.info.name,
                problem,
            };
            wanted.insert(hash, one);
        }
    }
    wanted.into_values().collect()
}

/// Solves for those that nobody has stored, `jobs` at a time.
///
/// One that cannot be computed is no error here: the runs go on, and their claims say why they were
/// not evaluated.
pub(super) fn provide(wanted: &[Wanted], library: &Library, jobs: usize) -> Result<(), CaseError> {
    let obtain = |one: &Wanted| match library.obtain(one.case, &one.problem) {
        Ok(_) | Err(CaseError::Solver(_) | CaseError::Stopped(_)) => Ok(()),
        Err(error) => Err(error),
    };
    pool(jobs)?.install(|| wanted.par_iter().with_max_len(1).try_for_each(obtain))
}
