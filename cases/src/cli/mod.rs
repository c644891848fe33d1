//! The command line. Results go to stdout and can be parsed; progress and errors go to stderr.

mod args;
mod print;

use crate::commands::{self, Finished, Plan};
use crate::error::{CaseError, exit};
use crate::over::Over;
use crate::scenes::SCENES;
use crate::{progress, scene_text};
use args::{Arguments, Command, WorkArgs};
use clap::Parser;

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
            format,
        }) => {
            let prepared = commands::show(&scene.request(), method.as_deref())?;
            let text = match (toml, format) {
                (true, _) => scene_text::write(&prepared),
                (false, format) => print::show(&prepared, *format)?,
            };
            print::out(&text);
        }
        Some(Command::Run(solve)) => {
            let options = solve.options();
            let plan = commands::plan_run(&options)?;
            return solve_or_show(&solve.work, &plan, || commands::run(&options));
        }
        Some(Command::Compare(solve)) => {
            let options = solve.options();
            let plan = commands::plan_compare(&options)?;
            return solve_or_show(&solve.work, &plan, || commands::compare(&options));
        }
        Some(Command::Ablation(work)) => {
            let options = work.options();
            let plan = commands::plan_ablation(&options)?;
            return solve_or_show(work, &plan, || commands::ablation(&options));
        }
        Some(Command::Converge(converge)) => {
            let (options, over) = (converge.options(), Over::parse(&converge.over)?);
            let plan = commands::plan_converge(&options, &over)?;
            let solve = || commands::converge(&options, &over);
            return solve_or_show(&converge.work, &plan, solve);
        }
        Some(Command::Reference { scene, into }) => {
            stop_on_interrupt()?;
            let recomputed = commands::reference(&scene.request(), into)?;
            print::out(&print::recomputed(&recomputed));
        }
        Some(Command::Report {
            folder,
            filter,
            format,
        }) => {
            let studies = commands::report(folder, filter.as_deref())?;
            for finished in &studies {
                eprint!("{}", print::missing(finished));
            }
            print::out(&print::results(&studies, *format)?);
            return Ok(studies
                .iter()
                .map(Finished::exit_code)
                .max()
                .unwrap_or(exit::PASS));
        }
    }
    Ok(exit::PASS)
}

/// Solves and prints, or says what would be solved.
fn solve_or_show(
    work: &WorkArgs,
    plan: &Plan,
    command: impl FnOnce() -> Result<Finished, CaseError>,
) -> Result<u8, CaseError> {
    for (method, why) in &plan.left_out {
        eprintln!("{method} is left out: {why}");
    }
    if work.dry_run {
        print::out(&print::plan(plan, &work.out, work.format)?);
        return Ok(exit::PASS);
    }
    stop_on_interrupt()?;
    let finished = command()?;
    let code = finished.exit_code();
    eprint!("{}", print::missing(&finished));
    print::out(&print::results(&[finished], work.format)?);
    Ok(code)
}

fn stop_on_interrupt() -> Result<(), CaseError> {
    progress::stop_on_interrupt()
        .map_err(|error| CaseError::Usage(format!("Ctrl-C cannot be caught: {error}")))
}
