//! `SHA256SUMS`: what each file of a run was when it was written, as `sha256sum -c` reads it. A file
//! that was cut short, changed by hand or lost is found by it, whatever it still looks like.

use crate::error::CaseError;
use sha2::{Digest, Sha256};
use std::fmt::Write as _;
use std::path::Path;

/// The file's name.
pub const SUMS: &str = "SHA256SUMS";

/// The text for files with these names and contents.
pub fn write(files: &[(&str, Vec<u8>)]) -> String {
    let mut text = String::new();
    for (name, content) in files {
        let _ = writeln!(text, "{}  {name}", sum(content));
    }
    text
}

/// Are all files of a folder what they were when they were written?
///
/// # Errors
/// [`CaseError::BadRecord`] with the first that is not.
pub fn check(folder: &Path) -> Result<(), CaseError> {
    let bad = |name: &str, reason: String| CaseError::BadRecord {
        path: folder.join(name),
        reason,
    };
    let read = |name: &str| {
        std::fs::read(folder.join(name))
            .map_err(|error| bad(name, format!("cannot be read: {error}")))
    };
    let sums = String::from_utf8_lossy(&read(SUMS)?).into_owned();
    for (index, line) in sums.lines().enumerate() {
        let Some((expected, name)) = line.split_once("  ") else {
            let reason = format!("line {}: expected `HASH  FILE`", index + 1);
            return Err(bad(SUMS, reason));
        };
        if sum(&read(name)?) != expected {
            let reason = format!("its hash is not that of {SUMS}: it was changed after the run");
            return Err(bad(name, reason));
        }
    }
    Ok(())
}

/// SHA-256 in hexadecimal digits.
pub fn sum(content: &[u8]) -> String {
    let mut text = String::with_capacity(64);
    for byte in Sha256::digest(content) {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_changed_and_a_lost_file_are_found() {
        let folder = tempfile::tempdir().unwrap();
        let files = [("a.csv", b"t_s\n1\n2\n".to_vec()), ("b.csv", b"x".to_vec())];
        for (name, content) in &files {
            std::fs::write(folder.path().join(name), content).unwrap();
        }
        assert!(check(folder.path()).is_err());
        std::fs::write(folder.path().join(SUMS), write(&files)).unwrap();
        assert!(check(folder.path()).is_ok());
        std::fs::write(folder.path().join("a.csv"), "t_s\n1\n").unwrap();
        let error = check(folder.path()).unwrap_err().to_string();
        assert!(error.contains("a.csv") && error.contains("hash"), "{error}");
        std::fs::write(folder.path().join("a.csv"), &files[0].1).unwrap();
        std::fs::remove_file(folder.path().join("b.csv")).unwrap();
        assert!(
            check(folder.path())
                .unwrap_err()
                .to_string()
                .contains("b.csv")
        );
    }

    #[test]
    fn the_sum_is_that_of_the_standard() {
        assert!(sum(b"abc").starts_with("ba7816bf8f01cfea414140de5dae2223"));
    }
}
