//! Arguments.

use crate::commands::Options;
use crate::prepare::Request;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  anechoic list                                       cases and methods
  anechoic compare compression-1d                     all methods, ranked
  anechoic run compression-1d --method dashpot --set grid.h_m=0.5
  anechoic show compression-1d --toml > my.toml       edit it, then:
  anechoic run my.toml
  anechoic ablation point-source                      what each part of a method absorbs
  anechoic converge lamb --over grid.h_m=20,10        the order with which errors fall
  anechoic report results                             rebuild the report from records

Exit codes: 0 pass, 1 a claim failed, 2 usage or input (an output folder that cannot be
written included), 3 a run failed or was stopped, or a result could not be written midway,
4 a reference is missing.";

const SOLVE_EXAMPLES: &str = "\
Examples:
  anechoic compare compression-1d --profile gate --jobs 2
  anechoic compare compression-1d --set dashpot.impedance=0.5 --filter dashpot
  anechoic run my.toml --format json > rows.json
  anechoic run compression-1d --method damping-layer --dry-run";

const CONVERGE_EXAMPLES: &str = "\
Examples:
  anechoic converge lamb --over grid.h_m=20,10,5
  anechoic converge compression-1d --over grid.h_m=4,2,1,0.5 --set source.wavelet=sine-squared
  anechoic converge compression-1d --over pml.thickness_m=40,20,10 --method pml";

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
        /// Output format.
        #[arg(long, value_enum, default_value_t)]
        format: Format,
    },
    /// Solve one scene with one method and judge it.
    #[command(after_help = SOLVE_EXAMPLES)]
    Run(SolveArgs),
    /// Solve one scene with all methods that apply, judge and rank them.
    #[command(after_help = SOLVE_EXAMPLES)]
    Compare(SolveArgs),
    /// Take a method apart: solve its variants and judge what each part absorbs.
    Ablation(WorkArgs),
    /// Refine a scene with one method: errors on all levels, and the order they fall with.
    #[command(after_help = CONVERGE_EXAMPLES)]
    Converge(ConvergeArgs),
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
    /// Rebuild rows, pictures and report from records, without solving.
    Report {
        /// Results folder, or a case's folder in it.
        folder: PathBuf,
        /// Only rows whose METHOD/METRIC/WHERE contains this.
        #[arg(long)]
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

/// Which scene, which methods.
#[derive(Debug, Args)]
pub struct SolveArgs {
    /// Boundary method, as a preset over sides; repeatable for compare [default: run: the scene's
    /// sides, compare: all that apply].
    #[arg(long)]
    method: Vec<String>,
    #[command(flatten)]
    pub work: WorkArgs,
}

impl SolveArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            methods: self.method.clone(),
            ..self.work.options()
        }
    }
}

/// Which scene, which method, which levels.
#[derive(Debug, Args)]
pub struct ConvergeArgs {
    /// The number to refine and its values: a field, or a method's parameter.
    #[arg(long, value_name = "FIELD=VALUE,VALUE,...")]
    pub over: String,
    /// Boundary method, as a preset over sides [default: the scene's sides].
    #[arg(long)]
    method: Option<String>,
    #[command(flatten)]
    pub work: WorkArgs,
}

impl ConvergeArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            methods: self.method.iter().cloned().collect(),
            ..self.work.options()
        }
    }
}

/// What to solve and where to put it.
#[derive(Debug, Args)]
pub struct WorkArgs {
    #[command(flatten)]
    scene: SceneArgs,
    /// Only rows whose METHOD/METRIC/WHERE contains this, and the methods that they need.
    #[arg(long)]
    filter: Option<String>,
    /// Results folder.
    #[arg(long, value_name = "DIR", default_value = "results")]
    pub out: PathBuf,
    /// Runs at a time, each on one thread [default: one a processor].
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..))]
    jobs: Option<u16>,
    /// Output format.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// Say what would be solved, and stop.
    #[arg(long)]
    pub dry_run: bool,
}

impl WorkArgs {
    /// The options without methods, with the command as typed.
    pub fn options(&self) -> Options {
        let typed: Vec<String> = std::env::args().skip(1).collect();
        Options {
            request: self.scene.request(),
            methods: Vec::new(),
            filter: self.filter.clone(),
            out: self.out.clone(),
            jobs: match self.jobs {
                Some(jobs) => jobs.into(),
                None => std::thread::available_parallelism().map_or(1, usize::from),
            },
            command: format!("anechoic {}", typed.join(" ")),
        }
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
