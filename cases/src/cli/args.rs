//! Arguments.

use crate::commands::{Options, ScoreOptions};
use crate::frames::Sampling;
use crate::prepare::Request;
use crate::resume::Reuse;
use anechoic_reports::diff::REL_TOL;
use clap::builder::NonEmptyStringValueParser;
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
  anechoic sweep point-source --over pml.thickness_m=100..400:100
  anechoic atlas point-source                         reflection of plane waves by angle
  anechoic report results                             rebuild the report from records
  anechoic diff before after                          what moved between two results
  anechoic score compression-1d series.csv            another program's series beside ours

Exit codes: 0 pass, 1 a claim failed (diff: something changed), 2 usage or input (an output
folder that cannot be written included), 3 a run failed or was stopped, a record is damaged, or
a result could not be written midway, 4 a reference is missing.";

const SOLVE_EXAMPLES: &str = "\
Examples:
  anechoic compare compression-1d --profile gate --jobs 2
  anechoic compare compression-1d --set dashpot.impedance=0.5 --filter dashpot
  anechoic run my.toml --format json > rows.json
  anechoic compare point-source --resume              after a stop or a kill
  anechoic run compression-1d --method damping-layer --dry-run";

const CONVERGE_EXAMPLES: &str = "\
Examples:
  anechoic converge lamb --over grid.h_m=20,10,5
  anechoic converge compression-1d --over grid.h_m=4,2,1,0.5 --set source.wavelet=sine-squared
  anechoic converge compression-1d --over pml.thickness_m=40,20,10 --method pml";

const SWEEP_EXAMPLES: &str = "\
The scene is a case, a file, or a named sweep: appendix-a, or a part of it, as appendix-a/thickness.

Examples:
  anechoic sweep point-source --over pml.thickness_m=100..400:100
  anechoic sweep point-source --over pml.thickness_m,damping-layer.thickness_m=200,400,800
  anechoic sweep compression-1d --over grid.h_m=2,1 --over dashpot.impedance=0.5,1,2
  anechoic sweep point-source --method pml-stretched \\
    --over pml-stretched.alpha=0.8..4:0.8/pml-stretched.thickness_m=200..1000:200
  anechoic sweep appendix-a --dry-run                 all points of K25, Appendix A";

const TRADEOFF_EXAMPLES: &str = "\
Examples:
  anechoic tradeoff point-source                      which method, how thick, at what cost
  anechoic tradeoff compression-1d --method pml --method dashpot
  anechoic tradeoff my.toml --repeats 5";

const STABILITY_EXAMPLES: &str = "\
A run that grows, diverges or does not converge is a result here, and ends with 0; a method that
theory says is stable and that is not ends with 1.

Examples:
  anechoic stability point-source --profile gate      a few minutes
  anechoic stability compression-1d --method pml --method dashpot
  anechoic stability my.toml";

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

/// Which scene, which methods.
#[derive(Debug, Args)]
pub struct SolveArgs {
    /// Boundary method, as a preset over sides; repeatable for compare [default: run: the scene's
    /// sides, compare: all that apply].
    #[arg(long)]
    method: Vec<String>,
    /// Write fields.pvd for ParaView into each run's folder: the displacement at the scene's own
    /// times and at 20 times over the run.
    #[arg(long)]
    fields: bool,
    #[command(flatten)]
    pub work: WorkArgs,
}

impl SolveArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            methods: self.method.clone(),
            sampling: Sampling {
                fields: self.fields,
                animation: false,
            },
            ..self.work.options()
        }
    }
}

/// Which scene, which methods, and what is shown of them.
#[derive(Debug, Args)]
pub struct CompareArgs {
    #[command(flatten)]
    pub solve: SolveArgs,
    /// Write animation.gif beside the report: the wave field of the standard run, of a method and
    /// of the run without echo, which are solved as well if they are not asked for.
    #[arg(long)]
    animate: bool,
}

impl CompareArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        let mut options = self.solve.options();
        options.sampling.animation = self.animate;
        options
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

/// Which scene, which methods, which points.
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// What is varied: a list or a range `FROM..TO:STEP`; fields that have the same values are joined
    /// by `,`, fields that advance together by `/`; repeated, axes are crossed.
    #[arg(long, value_name = "FIELD=VALUES")]
    pub over: Vec<String>,
    /// Boundary method; repeatable [default: those whose parameters are varied, else all that apply].
    #[arg(long)]
    method: Vec<String>,
    #[command(flatten)]
    pub work: WorkArgs,
}

impl SweepArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            methods: self.method.clone(),
            ..self.work.options()
        }
    }
}

/// Which scene, which methods, how carefully timed.
#[derive(Debug, Args)]
pub struct TradeoffArgs {
    /// Boundary method; repeatable [default: all that apply]. The extended mesh is always there.
    #[arg(long)]
    method: Vec<String>,
    /// How often short runs are timed, one after the other, after the runs for accuracy; 0: not at all.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u8).range(0..100))]
    pub repeats: u8,
    #[command(flatten)]
    pub work: WorkArgs,
}

impl TradeoffArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            methods: self.method.clone(),
            ..self.work.options()
        }
    }
}

/// Which scene, which methods.
#[derive(Debug, Args)]
pub struct StabilityArgs {
    /// Boundary method; repeatable [default: all that apply].
    #[arg(long)]
    method: Vec<String>,
    #[command(flatten)]
    pub work: WorkArgs,
}

impl StabilityArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            methods: self.method.clone(),
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
    #[arg(long, value_parser = NonEmptyStringValueParser::new())]
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

/// The command as typed. However often it was interrupted, a study is that of the command without
/// the words that say how to go on.
fn typed() -> String {
    let words = std::env::args().skip(1);
    let words: Vec<String> = words
        .filter(|w| w != "--resume" && w != "--failed")
        .collect();
    format!("anechoic {}", words.join(" "))
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
