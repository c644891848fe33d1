//! How far the work is, and whether to go on.

use anechoic_solver::Monitor;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};
use std::time::{Duration, Instant};

/// Work shorter than this shows no bar.
const QUIET: Duration = Duration::from_secs(2);

/// Stops all runs of this process at their next step.
static STOP: AtomicBool = AtomicBool::new(false);

/// Has a stop been asked for?
pub fn stopped() -> bool {
    STOP.load(Ordering::Relaxed)
}

/// Lets Ctrl-C stop the runs at their next step, so that what stands is stored; a second one ends
/// the program at once.
///
/// # Errors
/// When the handler cannot be installed.
pub fn stop_on_interrupt() -> Result<(), ctrlc::Error> {
    ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        eprintln!("stopping at the next step; what stands is stored (again: end at once)");
    })
}

/// Progress of several runs together, in point-steps.
#[derive(Debug)]
pub struct Progress {
    total: u64,
    done: AtomicU64,
    start: Instant,
    wanted: bool,
    bar: OnceLock<ProgressBar>,
}

impl Progress {
    /// Progress of `total` point-steps; shown if stderr is a terminal.
    pub fn new(total: u64) -> Self {
        Progress {
            total,
            done: AtomicU64::new(0),
            start: Instant::now(),
            wanted: std::io::stderr().is_terminal(),
            bar: OnceLock::new(),
        }
    }

    /// The monitor of one run, whose steps count `points` each.
    pub fn monitor(&self, points: usize) -> RunMonitor<'_> {
        RunMonitor {
            progress: self,
            points: points as u64,
            last: AtomicUsize::new(0),
        }
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }

    fn advance(&self, work: u64) {
        let done = self.done.fetch_add(work, Ordering::Relaxed) + work;
        if self.wanted && self.start.elapsed() > QUIET {
            self.bar
                .get_or_init(|| bar(self.total, self.start.elapsed()))
                .set_position(done.min(self.total));
        }
    }
}

fn bar(total: u64, elapsed: Duration) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} %  {elapsed} gone, {eta} left")
        .expect("the template is well formed");
    ProgressBar::with_draw_target(Some(total), ProgressDrawTarget::stderr())
        .with_style(style)
        .with_elapsed(elapsed)
}

/// Tells [`Progress`] of one run's steps.
#[derive(Debug)]
pub struct RunMonitor<'a> {
    progress: &'a Progress,
    points: u64,
    last: AtomicUsize,
}

impl Monitor for RunMonitor<'_> {
    fn step(&self, done: usize, _total: usize) -> bool {
        let last = self.last.swap(done, Ordering::Relaxed);
        self.progress
            .advance(self.points * done.saturating_sub(last) as u64);
        !stopped()
    }
}
