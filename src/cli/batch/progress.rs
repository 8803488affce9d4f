//! One progress bar for many things.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io::{IsTerminal, stderr};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How often the elapsed time is drawn anew.
const TICK: Duration = Duration::from_millis(250);

/// A bar on standard error that vanishes with this value.
pub struct Progress {
    bar: ProgressBar,
    counts: RefCell<BTreeMap<&'static str, usize>>,
}

impl Progress {
    /// Shows that nothing of `count` is done. There is no bar when `quiet` or when standard error is not a terminal.
    pub fn new(count: usize, quiet: bool) -> Progress {
        let shown = !quiet && stderr().is_terminal();
        let target = match shown {
            true => ProgressDrawTarget::stderr(),
            false => ProgressDrawTarget::hidden(),
        };
        let bar = ProgressBar::with_draw_target(Some(count as u64), target);
        if let Ok(style) = ProgressStyle::with_template("{pos} of {len} {bar:30} {elapsed}, {eta} to go, {msg}") {
            bar.set_style(style);
        }
        if shown {
            bar.enable_steady_tick(TICK);
        }
        Progress {
            bar,
            counts: RefCell::default(),
        }
    }

    /// Shows that one more is done, with this outcome.
    pub fn done(&self, outcome: &'static str) {
        let mut counts = self.counts.borrow_mut();
        *counts.entry(outcome).or_default() += 1;
        let words: Vec<String> = counts
            .iter()
            .map(|(outcome, count)| format!("{count} {outcome}"))
            .collect();
        self.bar.set_message(words.join(", "));
        self.bar.inc(1);
    }

    /// Writes something to standard output beside the bar.
    pub fn aside<R>(&self, write: impl FnOnce() -> R) -> R {
        self.bar.suspend(write)
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
