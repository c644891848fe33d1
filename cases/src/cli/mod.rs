//! The command line. Results go to stdout and can be parsed; progress and errors go to stderr.

mod args;
mod print;
mod print_plan;
mod studies;

use crate::commands::{self, Finished};
use crate::error::{CaseError, exit};
use crate::scenes::SCENES;
use crate::{progress, scene_text};
use anechoic_reports::diff::diff_table;
use args::{Arguments, Command, Format};
use clap::Parser;
use std::path::Path;

/// Where results lie by default, and with them references that were solved for.
const RESULTS: &str = "results";

/// Runs the program; returns its exit code.
pub fn main() -> u8 {
    let arguments = Arguments::parse();
    match act(&arguments) {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            error.exit_code()
        }
    }
}

fn act(arguments: &Arguments) -> Result<u8, CaseError> {
    match &arguments.command {
        None => print::out(&print::welcome()),
        Some(Command::List { format }) => print::out(&print::list(SCENES, *format)?),
        Some(Command::Show {
            scene,
            method,
            toml,
            export,
            format,
        }) => {
            let prepared = commands::show(&scene.request(), method.as_deref())?;
            if let Some(folder) = export {
                let exported = commands::export(&prepared, folder, Path::new(RESULTS))?;
                print::out(&print_plan::exported(&exported));
                return Ok(exit::PASS);
            }
            let text = match (toml, format) {
                (true, _) => scene_text::write(&prepared),
                (false, format) => print::show(&prepared, *format)?,
            };
            print::out(&text);
        }
        Some(
            command @ (Command::Run(_)
            | Command::Compare(_)
            | Command::Ablation(_)
            | Command::Converge(_)
            | Command::Sweep(_)
            | Command::Tradeoff(_)
            | Command::Stability(_)),
        ) => return studies::solve(command),
        Some(Command::Plan(arguments)) => return studies::write_down(arguments),
        Some(Command::Atlas(arguments)) => {
            stop_on_interrupt()?;
            let atlas = commands::atlas(&arguments.options(), arguments.surface)?;
            for note in &atlas.notes {
                eprintln!("note: {note}");
            }
            print::out(&print::atlas(&atlas, arguments.format)?);
            return Ok(atlas.exit_code());
        }
        Some(Command::Reference { scene, into }) => {
            stop_on_interrupt()?;
            let recomputed = commands::reference(&scene.request(), into)?;
            print::out(&print::recomputed(&recomputed));
        }
        Some(Command::Score(score)) => {
            stop_on_interrupt()?;
            return print_finished(commands::score(&score.options())?, score.format);
        }
        Some(Command::Diff {
            before,
            after,
            rel_tol,
            format,
        }) => {
            let diff = commands::compare_rows(before, after, *rel_tol)?;
            let text = match format {
                Format::Table => diff_table(&diff, *rel_tol),
                Format::Json => print::json_text(&diff.changes)?,
            };
            print::out(&text);
            if !diff.is_same() {
                return Ok(exit::GATE_FAILED);
            }
        }
        Some(Command::Report {
            folder,
            filter,
            format,
        }) => {
            let rebuilt = commands::report(folder, filter.as_deref())?;
            for finished in &rebuilt.studies {
                eprint!("{}", print::missing(finished));
            }
            for error in &rebuilt.unreadable {
                eprintln!("error: {error}");
            }
            print::out(&print::results(&rebuilt.studies, *format)?);
            return Ok(rebuilt.exit_code());
        }
    }
    Ok(exit::PASS)
}

/// Prints what came of a study; returns the exit code.
fn print_finished(finished: Finished, format: Format) -> Result<u8, CaseError> {
    let code = finished.exit_code();
    eprint!("{}", print::missing(&finished));
    print::out(&print::results(&[finished], format)?);
    Ok(code)
}

fn stop_on_interrupt() -> Result<(), CaseError> {
    progress::stop_on_interrupt()
        .map_err(|error| CaseError::Usage(format!("Ctrl-C cannot be caught: {error}")))
}
