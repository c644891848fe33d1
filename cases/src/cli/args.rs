//! Arguments.

mod examples;
mod studies;

use crate::commands::{Options, ScoreOptions};
use crate::frames::Sampling;
use crate::prepare::Request;
use crate::resume::Reuse;
use crate::shard::Shard;
use anechoic_reports::diff::REL_TOL;
use clap::builder::NonEmptyStringValueParser;
use clap::{Args, Parser, Subcommand, ValueEnum};
use examples::{
    CONVERGE_EXAMPLES, EXAMPLES, PLAN_EXAMPLES, SOLVE_EXAMPLES, STABILITY_EXAMPLES, SWEEP_EXAMPLES,
    TRADEOFF_EXAMPLES,
};
use std::path::PathBuf;
use studies::{CompareArgs, ConvergeArgs, SolveArgs, StabilityArgs, SweepArgs, TradeoffArgs};

/// Measures how much echo boundary methods leave in particle geomechanics.
#[derive(Debug, Parser)]
#[command(name = "anechoic", version, after_help = EXAMPLES)]
pub struct Arguments {
    /// What to do; without it, the program says what it is.
    #[command(subcommand)]
    pub command: Option<Command>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Name cases, profiles, presets and boundary methods.
    List {
        /// Output format.
        #[arg(long, value_enum, default_value_t)]
        format: Format,
    },
    /// Show a scene and what it will cost.
    Show {
        /// Scene.
        #[command(flatten)]
        scene: SceneArgs,
        /// Boundary method, as a preset over sides.
        #[arg(long)]
        method: Option<String>,
        /// Print the file to edit.
        #[arg(long)]
        toml: bool,
        /// Write what another program needs to solve it (mesh, material, load, receivers, reference)
        /// into a folder, as plain files.
        #[arg(long, value_name = "DIR", conflicts_with = "toml")]
        export: Option<PathBuf>,
        /// Output format.
        #[arg(long, value_enum, default_value_t)]
        format: Format,
    },
    /// Solve one scene with one method and judge it.
    #[command(after_help = SOLVE_EXAMPLES)]
    Run(SolveArgs),
    /// Solve one scene with all methods that apply, judge and rank them.
    #[command(after_help = SOLVE_EXAMPLES)]
    Compare(CompareArgs),
    /// Take a method apart: solve its variants and judge what each part absorbs.
    Ablation(WorkArgs),
    /// Measure what sides reflect of plane P and S waves: against angle, thickness of the layer, and
    /// cells in a wavelength.
    ///
    /// The solver's own steps on a strip in a harmonic state, judged by closed forms; seconds. The
    /// frequency is that of the scene's source, cells and steps are the scene's, points rest.
    Atlas(AtlasArgs),
    /// Refine a scene with one method: errors on all levels, and the order they fall with.
    #[command(after_help = CONVERGE_EXAMPLES)]
    Converge(ConvergeArgs),
    /// Vary fields of a scene or a method's parameters: echo and cost of several methods at all points.
    #[command(after_help = SWEEP_EXAMPLES)]
    Sweep(SweepArgs),
    /// Set error against cost: each method over its thickness and strength, what an echo takes, and advice.
    #[command(after_help = TRADEOFF_EXAMPLES)]
    Tradeoff(TradeoffArgs),
    /// Drive all methods to extremes of step, material, layer and points: which stay stable.
    #[command(after_help = STABILITY_EXAMPLES)]
    Stability(StabilityArgs),
    /// Write a study down as jobs for Snakemake or Slurm: shards of it, and their merge.
    ///
    /// Jobs ask for time and memory by the bill of their runs.
    #[command(after_help = PLAN_EXAMPLES)]
    Plan(PlanArgs),
    /// Compute a scene's certified reference and its floor, and store it.
    ///
    /// Its floor is how much it changes under a larger buffer and a tenth of the solver's tolerance:
    /// it is solved twice. Comparisons look it up by the hash of what it depends on.
    Reference {
        /// Scene.
        #[command(flatten)]
        scene: SceneArgs,
        /// Folder of its tables; those of `results/certified` are found by commands whose --out is
        /// `results`, those of `reference/data/certified` become part of the program when it is built.
        #[arg(long, value_name = "DIR", default_value = "results/certified")]
        into: PathBuf,
    },
    /// Judge the receivers' series of another program by the rows of ours, beside them.
    ///
    /// `show CASE --export DIR` writes what the program needs, and what its file must be like. Our
    /// runs come from --out; the standard run is solved if it is not there.
    Score(ScoreArgs),
    /// What changed from one results folder, study or run to another: numbers, verdicts, rows.
    ///
    /// What the runs cost is listed apart and never counted. Ends with 0 when nothing changed, 1 when
    /// something did.
    Diff {
        /// Results folder, study (a case's folder or its summary.json) or run before.
        before: PathBuf,
        /// The same after.
        after: PathBuf,
        /// Numbers closer than this share of the larger one are the same. What the solver's
        /// tolerance of 1e-10 leaves open in an echo of 1e-4 is 1e-6 of it.
        #[arg(long, value_name = "SHARE", default_value_t = REL_TOL, value_parser = share)]
        rel_tol: f64,
        /// Output format.
        #[arg(long, value_enum, default_value_t)]
        format: Format,
    },
    /// Rebuild rows, pictures and report from records, without solving.
    Report {
        /// Results folder, or a case's folder in it.
        folder: PathBuf,
        /// Only rows whose METHOD/METRIC/WHERE contains this.
        #[arg(long, value_parser = NonEmptyStringValueParser::new())]
        filter: Option<String>,
        /// Output format.
        #[arg(long, value_enum, default_value_t)]
        format: Format,
    },
}

/// Which scene.
#[derive(Debug, Args)]
pub struct SceneArgs {
    /// A case, or a TOML file that names one (`show CASE --toml` makes one).
    #[arg(value_name = "CASE|FILE")]
    target: String,
    /// Discretisation, point mode and duration [default: the file's, else quick].
    #[arg(long)]
    profile: Option<String>,
    /// Another reading or load of the case; repeatable.
    #[arg(long)]
    preset: Vec<String>,
    /// Override a field (`grid.h_m=0.5`, `receivers.A.y_m=40`) or a method's parameter
    /// (`dashpot.impedance=0.5`); repeatable.
    #[arg(long, value_name = "FIELD=VALUE")]
    set: Vec<String>,
}

impl SceneArgs {
    /// The request.
    pub fn request(&self) -> Request {
        Request {
            target: self.target.clone(),
            profile: self.profile.clone(),
            presets: self.preset.clone(),
            sets: self.set.clone(),
        }
    }
}

/// What to solve and where to put it.
#[derive(Debug, Args)]
pub struct WorkArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Only rows whose METHOD/METRIC/WHERE contains this, and the methods that they need.
    #[arg(long, value_parser = NonEmptyStringValueParser::new())]
    filter: Option<String>,
    /// Results folder.
    #[arg(long, value_name = "DIR", default_value = "results")]
    pub out: PathBuf,
    /// Runs at a time, each on one thread [default: one a processor].
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub jobs: Option<u16>,
    /// Solve this share of the runs only, for example 1/4, and judge nothing: the others are those
    /// of other processes, and the same command with --resume and without --shard merges them.
    #[arg(long, value_name = "SHARE/SHARES")]
    pub shard: Option<Shard>,
    /// Output format.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// Go on with a study that was interrupted: runs that are whole, complete and made by this
    /// program are read back, all others are solved.
    #[arg(long, conflicts_with = "failed")]
    resume: bool,
    /// Solve only those stored runs again that failed, were stopped or are damaged.
    #[arg(long)]
    failed: bool,
    /// Say what would be solved and what taken from disk, and stop.
    #[arg(long)]
    pub dry_run: bool,
}

impl WorkArgs {
    /// The options without methods, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            request: self.scene.request(),
            methods: Vec::new(),
            filter: self.filter.clone(),
            sampling: Sampling::default(),
            out: self.out.clone(),
            jobs: threads(self.jobs),
            repeats: 0,
            reuse: match (self.resume, self.failed) {
                (true, _) => Reuse::Whole,
                (false, true) => Reuse::AllButFailed,
                (false, false) => Reuse::Nothing,
            },
            command: typed(),
        }
    }
}

/// Which scene, which methods, where to.
#[derive(Debug, Args)]
pub struct AtlasArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Boundary method, as a preset over sides; repeatable [default: all that apply].
    #[arg(long)]
    method: Vec<String>,
    /// Only rows whose METHOD/METRIC/WHERE contains this.
    #[arg(long, value_parser = NonEmptyStringValueParser::new())]
    filter: Option<String>,
    /// Results folder.
    #[arg(long, value_name = "DIR", default_value = "results")]
    out: PathBuf,
    /// Rayleigh waves as well, by runs in time: half a minute for each method.
    #[arg(long)]
    pub surface: bool,
    /// Responses measured at a time [default: one a processor].
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Output format.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

impl AtlasArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            request: self.scene.request(),
            methods: self.method.clone(),
            filter: self.filter.clone(),
            out: self.out.clone(),
            sampling: Sampling::default(),
            jobs: threads(self.jobs),
            repeats: 0,
            reuse: Reuse::Nothing,
            command: typed(),
        }
    }
}

/// As many as asked for, or as there are processors.
fn threads(asked: Option<u16>) -> usize {
    let all = || std::thread::available_parallelism().map_or(1, usize::from);
    asked.map_or_else(all, usize::from)
}

/// Which series, and what they are judged by.
#[derive(Debug, Args)]
pub struct ScoreArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// The series: `t_s`, `NAME_ux_m`, `NAME_uy_m` of every receiver; velocities if you have them.
    #[arg(value_name = "SERIES.csv")]
    series: PathBuf,
    /// Its name in rows [default: the file's without its ending].
    #[arg(long)]
    name: Option<String>,
    /// The method of ours that its boundary is a model of: its claims judge the series.
    #[arg(long)]
    method: Option<String>,
    /// Only rows whose METHOD/METRIC/WHERE contains this.
    #[arg(long, value_parser = NonEmptyStringValueParser::new())]
    filter: Option<String>,
    /// Results folder.
    #[arg(long, value_name = "DIR", default_value = "results")]
    out: PathBuf,
    /// Output format.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
}

impl ScoreArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> ScoreOptions {
        ScoreOptions {
            common: Options {
                request: self.scene.request(),
                methods: self.method.iter().cloned().collect(),
                filter: self.filter.clone(),
                out: self.out.clone(),
                sampling: Sampling::default(),
                jobs: 1,
                repeats: 0,
                reuse: Reuse::Nothing,
                command: typed(),
            },
            series: self.series.clone(),
            name: self.name.clone(),
        }
    }
}

/// Which study, in how many jobs, where they are written down.
#[derive(Debug, Args)]
pub struct PlanArgs {
    /// Jobs, each with a share of the runs [default: as many as take some ten minutes each].
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    pub shards: Option<u16>,
    /// Folder of the files.
    #[arg(long, value_name = "DIR")]
    pub into: PathBuf,
    /// The study: compare, ablation, converge, sweep, tradeoff or stability, with its options;
    /// --jobs there is the threads of each job [default: 1].
    #[arg(last = true, required = true, value_name = "COMMAND")]
    pub command: Vec<String>,
}

/// The command that some words name; ends the program when they name none.
pub fn parse(words: &[String]) -> Option<Command> {
    let name = std::iter::once("anechoic");
    let words = name.chain(words.iter().map(String::as_str));
    Arguments::parse_from(words).command
}

/// The command as typed. However often it was interrupted and however it was shared out, a study is
/// that of the command without the words that say so.
fn typed() -> String {
    let words = lasting(std::env::args().skip(1), &["--shard"]);
    format!("anechoic {}", words.join(" "))
}

/// The words of a command without those that say how to go on, and without some flags and their
/// values.
pub fn lasting(words: impl Iterator<Item = String>, flags: &[&str]) -> Vec<String> {
    let mut kept = Vec::new();
    let mut of_flag = false;
    for word in words {
        if std::mem::take(&mut of_flag) || ["--resume", "--failed"].contains(&word.as_str()) {
            continue;
        }
        let flag = word.split('=').next().unwrap_or_default();
        if flags.contains(&flag) {
            of_flag = flag == word;
            continue;
        }
        kept.push(word);
    }
    kept
}

/// A share: from 0 to 1.
fn share(text: &str) -> Result<f64, String> {
    let number: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if (0.0..=1.0).contains(&number) {
        Ok(number)
    } else {
        Err("allowed: 0 <= value <= 1".to_owned())
    }
}

/// Output format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// For people.
    #[default]
    Table,
    /// For programs; rows as in summary.json.
    Json,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_say_how_to_go_on_do_not_last() {
        let left = |text: &str| {
            let words = text.split(' ').map(str::to_owned);
            lasting(words, &["--shard", "--jobs"]).join(" ")
        };
        for text in [
            "sweep a --resume --shard 1/2 --set b=1",
            "sweep a --shard=1/2 --jobs 2 --set b=1 --failed",
            "--jobs=3 sweep a --set b=1 --shard 1/2",
        ] {
            assert_eq!(left(text), "sweep a --set b=1", "{text}");
        }
    }
}
