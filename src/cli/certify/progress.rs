//! A progress bar for long runs.

use std::cell::OnceCell;
use std::io::{IsTerminal, stderr};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};

/// Shorter runs show no bar.
const PATIENCE: Duration = Duration::from_millis(500);
/// Steps of the bar.
const STEPS: u64 = 1000;

/// A bar on standard error that appears when a run lasts, and vanishes with this value.
pub struct Progress {
    start: Instant,
    shown: bool,
    bar: OnceCell<ProgressBar>,
}

impl Progress {
    /// Starts the clock. There is no bar when `quiet` or when standard error is not a terminal.
    pub fn new(quiet: bool) -> Progress {
        Progress {
            start: Instant::now(),
            shown: !quiet && stderr().is_terminal(),
            bar: OnceCell::new(),
        }
    }

    /// Shows that `part` of the present search, between 0 and 1, is done.
    pub fn at(&self, part: f64) {
        if self.shown && self.start.elapsed() >= PATIENCE {
            let bar = self.bar.get_or_init(|| {
                let bar = ProgressBar::new(STEPS);
                if let Ok(style) =
                    ProgressStyle::with_template("searching [{elapsed}] {bar:40} {percent} %")
                {
                    bar.set_style(style);
                }
                bar
            });
            bar.set_position((part.clamp(0.0, 1.0) * STEPS as f64) as u64);
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = self.bar.get() {
            bar.finish_and_clear();
        }
    }
}
