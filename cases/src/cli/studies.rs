//! Commands that solve a plan of runs: at once, as a shard of it, or written down for a cluster.

use super::args::{Command, PlanArgs, WorkArgs, lasting, parse};
use super::{print, print_finished, print_plan, stop_on_interrupt};
use crate::commands::{self, Options, Plan, execute, share, workflow};
use crate::error::{CaseError, exit};
use crate::over::Over;
use crate::resume::Reuse;

/// A command with what it would solve.
struct Study<'a> {
    work: &'a WorkArgs,
    options: Options,
    plan: Plan,
}

impl<'a> Study<'a> {
    /// Of a command that solves a plan.
    fn of(command: &'a Command) -> Result<Self, CaseError> {
        let (work, options) = match command {
            Command::Run(run) => (&run.work, run.options()),
            Command::Compare(compare) => (&compare.solve.work, compare.options()),
            Command::Ablation(work) => (work, work.options()),
            Command::Converge(converge) => (&converge.work, converge.options()),
            Command::Sweep(sweep) => (&sweep.work, sweep.options()),
            Command::Tradeoff(tradeoff) => (&tradeoff.work, tradeoff.options()),
            Command::Stability(stability) => (&stability.work, stability.options()),
            _ => return Err(not_shared()),
        };
        let plan = match command {
            Command::Run(_) if work.shard.is_some() => return Err(not_shared()),
            Command::Run(_) => commands::plan_run(&options),
            Command::Compare(_) => commands::plan_compare(&options),
            Command::Ablation(_) => commands::plan_ablation(&options),
            Command::Converge(converge) => {
                let over = converge.over.iter().map(|text| Over::parse(text));
                let over: Vec<Over> = over.collect::<Result<_, _>>()?;
                commands::plan_converge(&options, &over, converge.budget)
            }
            Command::Sweep(sweep) => commands::plan_sweep(&options, &sweep.over),
            Command::Tradeoff(_) => commands::plan_tradeoff(&options),
            Command::Stability(_) => commands::plan_stability(&options),
            _ => return Err(not_shared()),
        }?;
        Ok(Study {
            work,
            options,
            plan,
        })
    }
}

/// What a command that is no study is told.
fn not_shared() -> CaseError {
    CaseError::Usage(
        "only a study of several runs can be shared out: compare, ablation, converge, sweep, tradeoff, stability".into(),
    )
}

/// Solves and prints, or says what would be solved.
pub fn solve(command: &Command) -> Result<u8, CaseError> {
    let Study {
        work,
        options,
        mut plan,
    } = Study::of(command)?;
    eprint!("{}", left_out(&plan.left_out, work.dry_run));
    if work.dry_run {
        if let Some(shard) = work.shard {
            plan.keep(shard);
        }
        print::out(&print_plan::plan(&plan, &options, work.format)?);
        return Ok(exit::PASS);
    }
    stop_on_interrupt()?;
    let Some(shard) = work.shard else {
        return print_finished(execute(plan, &options)?, work.format);
    };
    let share = share(plan, &options, shard)?;
    print::out(&print_plan::share(&share, work.format)?);
    Ok(share.exit_code())
}

/// Runs that are left out are named one by one up to so many.
const NAMED: usize = 4;

/// What is left out and why: a line each, or, unless all are asked for, the first few of many.
fn left_out(runs: &[(String, String)], all: bool) -> String {
    let named = if all || runs.len() <= NAMED {
        runs.len()
    } else {
        NAMED - 1
    };
    let lines = runs[..named].iter();
    let mut text: String = lines
        .map(|(run, why)| format!("{run} is left out: {why}\n"))
        .collect();
    if named < runs.len() {
        let more = runs.len() - named;
        text += &format!("{more} more runs are left out; --dry-run names them all\n");
    }
    text
}

/// Writes a study down for engines that run jobs.
pub fn write_down(arguments: &PlanArgs) -> Result<u8, CaseError> {
    let command = parse(&arguments.command);
    let command = command.filter(|command| !matches!(command, Command::Run(_)));
    let Study {
        work,
        mut options,
        plan,
    } = Study::of(command.as_ref().ok_or_else(not_shared)?)?;
    let own = |flag: &str, why: &str| Err(CaseError::Usage(format!("{flag}: {why}")));
    if work.dry_run {
        return own("--dry-run", "a plan solves nothing; leave it out");
    }
    if options.reuse == Reuse::AllButFailed {
        return own(
            "--failed",
            "the jobs of a plan go on with what is whole, as --resume",
        );
    }
    if options.sampling.animation {
        return own(
            "--animate",
            "an animation is drawn by the process that solves; shards cannot share it",
        );
    }
    if let Some(shard) = work.shard {
        return own(
            &format!("--shard {shard}"),
            "the plan gives each job its own",
        );
    }
    options.jobs = work.jobs.map_or(1, usize::from);
    let program = std::env::current_exe()
        .map_err(|error| CaseError::Usage(format!("the program does not find itself: {error}")))?;
    let words = lasting(arguments.command.iter().cloned(), &["--jobs"]);
    let shards = arguments.shards.map(usize::from);
    let written = workflow(plan, &options, shards, &arguments.into, (&program, &words))?;
    print::out(&print_plan::written(&written));
    Ok(exit::PASS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn many_runs_that_are_left_out_are_counted() {
        let runs = |n: usize| -> Vec<(String, String)> {
            (0..n)
                .map(|i| (format!("run {i}"), "no".to_owned()))
                .collect()
        };
        assert_eq!(left_out(&runs(0), false), "");
        assert_eq!(left_out(&runs(4), false).lines().count(), 4);
        let many = left_out(&runs(9), false);
        assert!(many.contains("run 2") && !many.contains("run 3") && many.contains("6 more"));
        assert_eq!(left_out(&runs(9), true).lines().count(), 9);
    }
}
