//! Where certified references lie: those that come with the program, and those that a results folder
//! has from earlier commands.

use super::{Certified, file, key, solve};
use crate::error::CaseError;
use crate::posed::Posed;
use crate::store::write_file;
use std::path::{Path, PathBuf};

/// Folder of references in a results folder.
const FOLDER: &str = "certified";

/// References that come with the program, and those of a folder, if there is one.
#[derive(Clone, Debug)]
pub struct Library {
    folder: Option<PathBuf>,
}

impl Library {
    /// Those that come with the program alone.
    pub fn shipped() -> Self {
        Library { folder: None }
    }

    /// Those of a results folder as well.
    pub fn of_results(root: &Path) -> Self {
        Library {
            folder: Some(root.join(FOLDER)),
        }
    }

    /// Those of a folder of references as well.
    pub fn of_folder(folder: &Path) -> Self {
        Library {
            folder: Some(folder.to_owned()),
        }
    }

    /// The reference of an extended problem: one that serves until its end, if any does, else one
    /// that does not.
    ///
    /// # Errors
    /// [`CaseError::BadRecord`] for a damaged one.
    pub fn find(&self, case: &str, problem: &Posed) -> Result<Option<Certified>, CaseError> {
        let hash = key::hash_of(problem);
        let shipped = file::read(case, &hash, |name| {
            anechoic_reference::certified::table(name).map(str::to_owned)
        })?;
        let own = match &self.folder {
            None => None,
            Some(folder) => file::read(case, &hash, |name| {
                std::fs::read_to_string(folder.join(name)).ok()
            })
            .map_err(|error| damaged(folder, error))?,
        };
        let serves = |found: &Certified| found.about.serves(problem.last_time()).is_ok();
        let found = [shipped, own].into_iter().flatten();
        Ok(found.max_by_key(serves))
    }

    /// The reference of an extended problem; solves for it and stores it when there is none that
    /// serves until the problem's end.
    ///
    /// # Errors
    /// As [`Library::find`], [`solve::compute`] and [`Library::save`].
    pub fn obtain(&self, case: &str, problem: &Posed) -> Result<Certified, CaseError> {
        if let Some(found) = self.find(case, problem)?
            && found.about.serves(problem.last_time()).is_ok()
        {
            return Ok(found);
        }
        let reference = solve::compute(case, problem)?;
        self.save(&reference)?;
        Ok(reference)
    }

    /// Stores a reference in the folder, if there is one; returns the files.
    ///
    /// # Errors
    /// [`CaseError::Storage`].
    pub fn save(&self, reference: &Certified) -> Result<Vec<PathBuf>, CaseError> {
        let Some(folder) = &self.folder else {
            return Ok(Vec::new());
        };
        let mut files = file::write(reference)?;
        // The main table last: it is what is looked for.
        files.rotate_left(1);
        let mut paths = Vec::new();
        for (name, text) in files {
            let path = folder.join(name);
            write_file(&path, text.as_bytes())?;
            paths.push(path);
        }
        Ok(paths)
    }
}

/// The error of a damaged table with its folder, and what to do.
fn damaged(folder: &Path, error: CaseError) -> CaseError {
    match error {
        CaseError::BadRecord { path, reason } => CaseError::BadRecord {
            path: folder.join(path),
            reason: format!("{reason}; without the file, the next comparison computes it again"),
        },
        other => other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certified::file::tests::example;

    /// A kill between two tables then leaves parts that nobody looks for.
    #[test]
    fn the_table_that_is_looked_for_is_written_last() {
        let folder = tempfile::tempdir().unwrap();
        let library = Library::of_folder(folder.path());
        let paths = library.save(&example()).unwrap();
        let last = paths.last().unwrap().file_name().unwrap().to_owned();
        let main = format!("point-source-{}.csv", example().about.hash);
        assert_eq!((paths.len(), last.to_str()), (3, Some(main.as_str())));
    }
}
