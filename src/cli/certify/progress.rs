//! A progress bar for long runs.

use std::io::{IsTerminal, stderr};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Shorter runs show no bar.
const PATIENCE: Duration = Duration::from_millis(500);
/// How often the elapsed time is drawn anew.
const TICK: Duration = Duration::from_millis(200);
/// Steps of the bar.
const STEPS: u64 = 1000;

/// A bar on standard error that appears when a run lasts, and vanishes with this value.
pub struct Progress {
    bar: ProgressBar,
    /// Shows the bar after a while, unless its sender goes before.
    patience: Option<(Sender<()>, JoinHandle<()>)>,
}

impl Progress {
    /// Starts the clock. There is no bar when `quiet` or when standard error is not a terminal.
    pub fn new(quiet: bool) -> Progress {
        let bar = ProgressBar::with_draw_target(Some(STEPS), ProgressDrawTarget::hidden());
        if quiet || !stderr().is_terminal() {
            return Progress { bar, patience: None };
        }
        if let Ok(style) = ProgressStyle::with_template("{msg} {bar:40} {percent:>3} % of this pass, {elapsed}") {
            bar.set_style(style);
        }
        bar.set_message("searching");
        let (sender, receiver) = channel::<()>();
        let shown = bar.clone();
        let thread = thread::spawn(move || {
            if receiver.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(TICK);
            }
        });
        Progress {
            bar,
            patience: Some((sender, thread)),
        }
    }

    /// Shows that `part` of the present search, between 0 and 1, is done.
    pub fn at(&self, part: f64) {
        self.bar.set_position((part.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }

    /// Shows that the checker replays what was found.
    pub fn checking(&self) {
        self.bar.set_message("checking");
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some((sender, thread)) = self.patience.take() {
            drop(sender);
            // The thread does nothing that fails.
            let _ = thread.join();
            self.bar.finish_and_clear();
        }
    }
}
