//! What can go wrong, where, and what to do about it; each error knows its exit code.

use crate::atlas::AtlasError;
use anechoic_solver::error::SolverError;
use std::fmt;
use std::io::ErrorKind;
use std::path::PathBuf;
use thiserror::Error;

/// Exit codes of the program.
pub mod exit {
    /// All claims hold, or none was made.
    pub const PASS: u8 = 0;
    /// A claim failed.
    pub const GATE_FAILED: u8 = 1;
    /// The command line, a file or the output folder is at fault; found before anything is solved.
    pub const USAGE: u8 = 2;
    /// A run failed or was stopped, or a result could not be written.
    pub const SOLVER_FAILED: u8 = 3;
    /// Claims could not be judged because their reference does not exist, or none of them could.
    pub const REFERENCE_MISSING: u8 = 4;
}

/// Where the value of a field comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The scene's own value.
    Default,
    /// A profile, preset or method of the scene.
    BuiltIn(String),
    /// A line of a file.
    File {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
    },
    /// A `--set` on the command line.
    Set(String),
    /// A level of an `--over` on the command line.
    Over(String),
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Origin::Default => write!(f, "the scene's value"),
            Origin::BuiltIn(name) => write!(f, "{name}"),
            Origin::File { path, line } => write!(f, "{}:{line}", path.display()),
            Origin::Set(text) => write!(f, "--set {text}"),
            Origin::Over(text) => write!(f, "--over {text}"),
        }
    }
}

/// One thing that is wrong with a scene as given.
#[derive(Clone, Debug, PartialEq)]
pub struct Complaint {
    /// Where the value comes from.
    pub origin: Origin,
    /// The field, for example `material.nu`.
    pub field: String,
    /// What is wrong and what is allowed.
    pub message: String,
}

impl fmt::Display for Complaint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.origin, self.field, self.message)
    }
}

/// Why a command did not do what it was asked.
#[derive(Debug, Error)]
pub enum CaseError {
    /// A name that is not known.
    #[error("unknown {what} `{given}`{}; known: {}", hint(.nearest), .known.join(", "))]
    Unknown {
        /// Kind of name: case, profile, preset, method.
        what: &'static str,
        /// The name as given.
        given: String,
        /// The known name that is nearest.
        nearest: Option<String>,
        /// All known names.
        known: Vec<String>,
    },
    /// The same of a name in a file.
    #[error("{origin}: {error}")]
    InFile {
        /// The line.
        origin: Origin,
        /// What is wrong with the name.
        error: Box<CaseError>,
    },
    /// Fields of the scene are at fault; all of them are listed.
    #[error("{}", join(.0))]
    Scene(Vec<Complaint>),
    /// A file is not TOML.
    #[error("{}:{line}:{column}: {message}", path.display())]
    Syntax {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What the parser says.
        message: String,
    },
    /// A file that names no case.
    #[error("{}: the file names no case; its first line should be `case = \"...\"`", .0.display())]
    NoCase(PathBuf),
    /// A file cannot be read.
    #[error("{}: cannot be read: {}", path.display(), in_words(.source))]
    Read {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The output folder cannot be written; found before anything is solved.
    #[error("{}: cannot write there: {}; choose another folder with --out", path.display(), in_words(.source))]
    Output {
        /// The folder.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A result could not be written midway; what was finished before stays.
    #[error("{}: could not be written: {source}; what was finished before stays", path.display())]
    Storage {
        /// The file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A stored record does not say what it should.
    #[error("{}: not a whole record: {reason}", path.display())]
    BadRecord {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        reason: String,
    },
    /// A study of which nothing can be read.
    #[error("{}: none of its runs can be read: {reason}; its report was left as it was, and what made it, with --resume, solves them again", path.display())]
    NothingWhole {
        /// The study's folder.
        path: PathBuf,
        /// What is wrong with its first run.
        reason: String,
    },
    /// Series of another program that do not fit the scene.
    #[error("{}:{line}: {message}", path.display())]
    Series {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: u64,
        /// The column and what is wrong with it.
        message: String,
    },
    /// Rows that should be there and cannot be read.
    #[error("{}: its rows cannot be read: {reason}; `anechoic report` makes them again from the records", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// Why.
        reason: String,
    },
    /// A folder with runs that no study holds together.
    #[error("{}: holds runs, but no study.json that says which belong together; the command that made them, with --resume, writes it again", .0.display())]
    NoStudy(PathBuf),
    /// A folder without records.
    #[error("{}: holds no records; `anechoic compare CASE --out DIR` makes some", .0.display())]
    NoRecords(PathBuf),
    /// A filter that matches nothing.
    #[error("--filter {given} matches nothing{}; it is looked for in METHOD/METRIC/WHERE, for example in {example}", hint(.nearest))]
    Filter {
        /// The filter as given.
        given: String,
        /// The nearest known word.
        nearest: Option<String>,
        /// A row that exists.
        example: String,
    },
    /// What cannot be refined, or not like that.
    #[error("--over {given}: {reason}")]
    Refinement {
        /// What was given, or its field.
        given: String,
        /// What is wrong with it, and what is expected.
        reason: String,
    },
    /// A command line that does not make sense.
    #[error("{0}")]
    Usage(String),
    /// The problem cannot be set up for a reason the scene did not see.
    #[error("{0}")]
    Solver(#[from] SolverError),
    /// A reflection cannot be measured.
    #[error(transparent)]
    Atlas(#[from] AtlasError),
    /// Work that was asked to stop.
    #[error("{0} was stopped before its end")]
    Stopped(String),
    /// A picture or report could not be made.
    #[error("{what} could not be made: {reason}")]
    Report {
        /// Which.
        what: String,
        /// Why.
        reason: String,
    },
}

/// What the system says, without its numbers where a file and a folder are mixed up.
fn in_words(error: &std::io::Error) -> String {
    match error.kind() {
        ErrorKind::IsADirectory => "it is a folder, and a file is needed".to_owned(),
        ErrorKind::NotADirectory => "it is a file, and a folder is needed".to_owned(),
        ErrorKind::AlreadyExists => "a file is in the way".to_owned(),
        ErrorKind::NotFound => "there is no such file or folder".to_owned(),
        _ => error.to_string(),
    }
}

impl CaseError {
    /// The exit code that this error stands for.
    pub fn exit_code(&self) -> u8 {
        match self {
            CaseError::InFile { error, .. } => error.exit_code(),
            CaseError::Unknown { .. }
            | CaseError::Scene(_)
            | CaseError::Syntax { .. }
            | CaseError::NoCase(_)
            | CaseError::Read { .. }
            | CaseError::Output { .. }
            | CaseError::BadRecord { .. }
            | CaseError::NoRecords(_)
            | CaseError::NoStudy(_)
            | CaseError::Series { .. }
            | CaseError::Filter { .. }
            | CaseError::Refinement { .. }
            | CaseError::Usage(_)
            | CaseError::Atlas(
                AtlasError::Unsupported { .. } | AtlasError::Solver(SolverError::Setup { .. }),
            )
            | CaseError::Solver(SolverError::Setup { .. }) => exit::USAGE,
            CaseError::Storage { .. }
            | CaseError::Solver(_)
            | CaseError::Atlas(_)
            | CaseError::Stopped(_)
            | CaseError::NothingWhole { .. }
            | CaseError::Unreadable { .. }
            | CaseError::Report { .. } => exit::SOLVER_FAILED,
        }
    }

    /// An unknown name, with the nearest of the known ones.
    pub fn unknown<'a>(
        what: &'static str,
        given: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known: Vec<String> = known.into_iter().map(str::to_owned).collect();
        CaseError::Unknown {
            what,
            given: given.to_owned(),
            nearest: nearest(given, known.iter().map(String::as_str)),
            known,
        }
    }
}

/// The known name that looks most like `given`, if any looks alike.
pub fn nearest<'a>(given: &str, known: impl IntoIterator<Item = &'a str>) -> Option<String> {
    known
        .into_iter()
        .map(|name| (strsim::jaro_winkler(given, name), name))
        .filter(|(likeness, _)| *likeness > 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, name)| name.to_owned())
}

/// "; did you mean ...?" when there is a nearest name.
pub fn hint(nearest: &Option<String>) -> String {
    nearest
        .as_ref()
        .map(|name| format!("; did you mean `{name}`?"))
        .unwrap_or_default()
}

fn join(complaints: &[Complaint]) -> String {
    let lines: Vec<String> = complaints.iter().map(Complaint::to_string).collect();
    match lines.as_slice() {
        [one] => one.clone(),
        several => format!(
            "{} fields are at fault:\n  {}",
            several.len(),
            several.join("\n  ")
        ),
    }
}
