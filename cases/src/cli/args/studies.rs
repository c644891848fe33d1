//! Arguments of the commands that solve: which scene, which methods, which points.

use super::WorkArgs;
use crate::commands::Options;
use crate::frames::Sampling;
use clap::Args;

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
    #[arg(long, conflicts_with = "shard")]
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
    /// What is refined and its values: grid.h_m, time.dt_s or points.per_cell; repeated, one after the
    /// other.
    #[arg(long, value_name = "FIELD=VALUE,VALUE,...")]
    pub over: Vec<String>,
    /// What space, time, points, boundary and reference contribute to the errors of the scene as it
    /// stands: runs that differ from it in one thing.
    #[arg(long)]
    pub budget: bool,
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
    repeats: u8,
    #[command(flatten)]
    pub work: WorkArgs,
}

impl TradeoffArgs {
    /// The options, with the command as typed.
    pub fn options(&self) -> Options {
        Options {
            methods: self.method.clone(),
            repeats: self.repeats.into(),
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
