//! Records what the program was built from: revision, whether it had changes, compiler, and a hash of
//! the sources that records depend on.

use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::path::Path;
use std::process::Command;

/// What a record depends on beside its input: scenes, solver, and the libraries' versions.
const SOURCES: [&str; 3] = ["src", "../solver/src", "../Cargo.lock"];

fn main() {
    let revision = output("git", &["rev-parse", "--short=12", "HEAD"]);
    // Outside a repository nothing is known of changes; the revision says so.
    let dirty = output("git", &["status", "--porcelain", "--untracked-files=no"])
        .is_some_and(|changes| !changes.is_empty());
    let compiler = std::env::var("RUSTC")
        .ok()
        .and_then(|rustc| output(&rustc, &["--version"]));
    println!(
        "cargo::rustc-env=ANECHOIC_REVISION={}",
        revision.as_deref().unwrap_or("unknown")
    );
    println!("cargo::rustc-env=ANECHOIC_DIRTY={dirty}");
    println!(
        "cargo::rustc-env=ANECHOIC_COMPILER={}",
        compiler.as_deref().unwrap_or("unknown")
    );
    let mut sources = DefaultHasher::new();
    for place in SOURCES {
        take_in(Path::new(place), &mut sources);
        println!("cargo::rerun-if-changed={place}");
    }
    println!(
        "cargo::rustc-env=ANECHOIC_SOURCES={:016x}",
        sources.finish()
    );
    for name in ["HEAD", "index"] {
        if let Some(path) = output("git", &["rev-parse", "--git-path", name])
            && Path::new(&path).exists()
        {
            println!("cargo::rerun-if-changed={path}");
        }
    }
}

/// Standard output of a program, trimmed; `None` when it is absent or fails.
fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let output = Command::new(program).args(arguments).output().ok()?;
    output
        .status
        .success()
        .then(|| String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

/// Names and contents of a file, or of all files below a folder in the order of their names.
fn take_in(path: &Path, hasher: &mut DefaultHasher) {
    if let Ok(entries) = path.read_dir() {
        let mut below: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
        below.sort();
        for path in below {
            take_in(&path, hasher);
        }
    } else if let Ok(content) = std::fs::read(path) {
        path.hash(hasher);
        content.hash(hasher);
    }
}
