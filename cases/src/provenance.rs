//! What the program was built from, as `build.rs` found it.

use anechoic_reports::provenance::Provenance;

/// Provenance of a run with the given input; every run has one thread.
pub fn of(input_hash: &str) -> Provenance {
    Provenance {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        revision: env!("ANECHOIC_REVISION").to_owned(),
        dirty: env!("ANECHOIC_DIRTY") == "true",
        sources: env!("ANECHOIC_SOURCES").to_owned(),
        compiler: env!("ANECHOIC_COMPILER").to_owned(),
        threads: 1,
        input_hash: input_hash.to_owned(),
    }
}

/// Was a run made by this program? Two builds are the same when version, compiler and the sources that
/// records depend on (scenes, solver, versions of libraries) are: a commit that changes nothing else
/// does not matter, and changes that were not committed do.
///
/// # Errors
/// In what it differs.
pub fn made_by_this_program(run: &Provenance) -> Result<(), String> {
    let own = of("");
    for (what, theirs, ours) in [
        ("version", &run.version, &own.version),
        ("compiler", &run.compiler, &own.compiler),
        ("hash of sources", &run.sources, &own.sources),
    ] {
        if theirs != ours {
            return Err(format!(
                "it was made by another program ({what} `{theirs}`, not `{ours}`)"
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_decide_and_commits_do_not() {
        let mut run = of("input");
        run.revision = "another".into();
        run.dirty = !run.dirty;
        assert_eq!(made_by_this_program(&run), Ok(()));
        assert_eq!(run.sources.len(), 16);
        run.sources = "0".repeat(16);
        let why = made_by_this_program(&run).unwrap_err();
        assert!(why.contains("sources"), "{why}");
        let mut run = of("input");
        run.version = "0.0.0".into();
        assert!(made_by_this_program(&run).unwrap_err().contains("0.0.0"));
    }
}
