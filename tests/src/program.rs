//! The program as it is typed.

use assert_cmd::Command;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Child;
use std::time::Duration;

/// A column two cells wide: the wave is the same, the cost is not.
pub const NARROW: [&str; 6] = [
    "--set",
    "body.width_m=2",
    "--set",
    "receivers.A.x_m=1",
    "--set",
    "receivers.B.x_m=1",
];

/// What a call left.
#[derive(Debug)]
pub struct Output {
    /// Exit code.
    pub code: i32,
    /// What can be parsed.
    pub out: String,
    /// Errors and progress.
    pub err: String,
}

/// The built program, beside the test binaries of the same profile.
///
/// # Panics
/// When it was not built: `cargo test` in the workspace builds it.
pub fn binary() -> PathBuf {
    let test = std::env::current_exe().expect("a test knows its own file");
    let folder = test
        .ancestors()
        .find(|folder| folder.file_name().is_some_and(|name| name == "deps"))
        .and_then(Path::parent)
        .expect("test binaries lie in target/PROFILE/deps");
    let binary = folder.join(format!("anechoic{}", std::env::consts::EXE_SUFFIX));
    assert!(
        binary.is_file(),
        "{}: not built; run `cargo test` for the whole workspace, or `cargo build -p anechoic` first",
        binary.display()
    );
    binary
}

/// Calls the program in `folder`.
///
/// # Panics
/// When it does not start or is killed.
pub fn anechoic(folder: &Path, arguments: &[&str]) -> Output {
    let output = Command::new(binary())
        .current_dir(folder)
        .args(arguments)
        .output()
        .expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    Output {
        code: output.status.code().expect("an exit code"),
        out: text(&output.stdout),
        err: text(&output.stderr),
    }
}

/// The arguments with profile `gate` on a narrow column.
pub fn narrow<'a>(arguments: &[&'a str]) -> Vec<&'a str> {
    [arguments, &["--profile", "gate"], &NARROW].concat()
}

/// A folder that goes at the end of the test.
///
/// # Panics
/// When there is no place for temporary files.
pub fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a temporary folder")
}

/// The text of a file.
///
/// # Panics
/// When it cannot be read.
pub fn read(path: &Path) -> String {
    std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Rows out of JSON.
///
/// # Panics
/// When it is no list.
pub fn rows(json: &str) -> Vec<Value> {
    serde_json::from_str(json).unwrap_or_else(|error| panic!("no rows: {error} in {json}"))
}

/// The only folder of a method's runs on compression-1d in `results`.
///
/// # Panics
/// When there is not exactly one.
pub fn run_folder(results: &Path, method: &str) -> PathBuf {
    let methods = results.join("compression-1d").join(method);
    let entries = std::fs::read_dir(&methods)
        .unwrap_or_else(|error| panic!("{}: {error}", methods.display()));
    let mut folders: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .collect();
    assert_eq!(folders.len(), 1, "{folders:?}");
    folders.remove(0)
}

/// Waits half a minute for a file that the program makes while it is at work.
///
/// # Panics
/// When the file does not come, or the program ends without it.
pub fn wait_for(path: &Path, child: &mut Child) {
    for _ in 0..6000 {
        if path.exists() {
            return;
        }
        assert_eq!(child.try_wait().expect("a child"), None, "ended early");
        std::thread::sleep(Duration::from_millis(5));
    }
    panic!("{} did not come", path.display());
}
