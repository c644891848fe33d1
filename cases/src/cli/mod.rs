//! The command line. Results go to stdout and can be parsed; progress and errors go to stderr.

mod args;
mod print;
mod print_plan;

use crate::commands::{self, Finished, Options, Plan};
use crate::error::{CaseError, exit};
use crate::over::Over;
use crate::scenes::SCENES;
use crate::{progress, scene_text};
use anechoic_reports::diff::diff_table;
use args::{Arguments, Command, Format, WorkArgs};
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
        Some(Command::Run(solve)) => {
            let options = solve.options();
            let plan = commands::plan_run(&options)?;
            return solve_or_show(&solve.work, &options, &plan, || commands::run(&options));
        }
        Some(Command::Compare(compare)) => {
            let (solve, options) = (&compare.solve, compare.options());
            let plan = commands::plan_compare(&options)?;
            return solve_or_show(&solve.work, &options, &plan, || commands::compare(&options));
        }
        Some(Command::Ablation(work)) => {
            let options = work.options();
            let plan = commands::plan_ablation(&options)?;
            return solve_or_show(work, &options, &plan, || commands::ablation(&options));
        }
        Some(Command::Atlas(arguments)) => {
            stop_on_interrupt()?;
            let atlas = commands::atlas(&arguments.options(), arguments.surface)?;
            for note in &atlas.notes {
                eprintln!("note: {note}");
            }
            print::out(&print::atlas(&atlas, arguments.format)?);
            return Ok(atlas.exit_code());
        }
        Some(Command::Converge(converge)) => {
            let (options, over) = (converge.options(), Over::parse(&converge.over)?);
            let plan = commands::plan_converge(&options, &over)?;
            let solve = || commands::converge(&options, &over);
            return solve_or_show(&converge.work, &options, &plan, solve);
        }
        Some(Command::Sweep(sweep)) => {
            let (options, over) = (sweep.options(), &sweep.over);
            let plan = commands::plan_sweep(&options, over)?;
            let solve = || commands::sweep(&options, over);
            return solve_or_show(&sweep.work, &options, &plan, solve);
        }
        Some(Command::Tradeoff(tradeoff)) => {
            let options = tradeoff.options();
            let plan = commands::plan_tradeoff(&options)?;
            let solve = || commands::tradeoff(&options, tradeoff.repeats.into());
            return solve_or_show(&tradeoff.work, &options, &plan, solve);
        }
        Some(Command::Stability(stability)) => {
            let options = stability.options();
            let plan = commands::plan_stability(&options)?;
            let solve = || commands::stability(&options);
            return solve_or_show(&stability.work, &options, &plan, solve);
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

/// Solves and prints, or says what would be solved.
fn solve_or_show(
    work: &WorkArgs,
    options: &Options,
    plan: &Plan,
    command: impl FnOnce() -> Result<Finished, CaseError>,
) -> Result<u8, CaseError> {
    for (method, why) in &plan.left_out {
        eprintln!("{method} is left out: {why}");
    }
    if work.dry_run {
        print::out(&print_plan::plan(plan, options, work.format)?);
        return Ok(exit::PASS);
    }
    stop_on_interrupt()?;
    print_finished(command()?, work.format)
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
