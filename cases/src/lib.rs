//! The case runner: scenes as data, runs, records on disk, judgement, the command line.
//!
//! - [`scenes`]: the benchmarks, one file each; [`scene`] says what a benchmark is.
//! - [`spec`], [`half_space`], [`field`], [`checks`]: parts of scenes, their keys, ranges and relations.
//! - [`draft`]: profile, preset, file, method and `--set` laid over a scene's values.
//! - [`prepare`]: from what was asked to a scene ready to run; [`scene_text`] writes it down.
//! - [`posed`]: what a scene gives the solver, in the plane or in space.
//! - [`shard`]: shares of a plan for several processes.
//! - [`frames`]: fields over time on request.
//! - [`runner`], [`progress`]: solving; [`store`]: records on disk; [`resume`]: those that are read
//!   back instead of solved; [`foreign`]: series of other programs.
//! - [`certified`]: references that have to be solved for; where they lie, until when they serve.
//! - [`judge`]: metrics, claims, rows; [`pictures`], [`study`]: what is shown of them.
//! - [`over`]: levels of convergence studies; [`sweep`]: points of sweeps.
//! - [`timing`]: runs for their time alone; [`awake`]: cells that a wave has reached; [`spectrum`]: what
//!   small meshes with a scene's sides grow by.
//! - [`atlas`]: what sides reflect of plane waves, by angle.
//! - [`commands`], [`cli`]: the program.

pub mod atlas;
pub mod awake;
pub mod certified;
pub mod checks;
pub mod cli;
pub mod commands;
pub mod draft;
pub mod error;
pub mod field;
pub mod filter;
pub mod foreign;
pub mod frames;
pub mod half_space;
pub mod judge;
pub mod over;
pub mod pictures;
pub mod posed;
pub mod prepare;
pub mod progress;
pub mod provenance;
pub mod resume;
pub mod runner;
pub mod scene;
pub mod scene_text;
pub mod scenes;
pub mod shard;
pub mod spec;
pub mod spectrum;
pub mod store;
pub mod study;
pub mod sweep;
pub mod timing;
