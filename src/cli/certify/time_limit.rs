//! An end to a search that takes too long.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use serde::Serialize;

use crate::cli::Printing;
use crate::cli::output::{say, say_json};

/// Set by whoever is first: the search that comes to its end, or the watch.
static OVER: AtomicBool = AtomicBool::new(false);

/// The exit code of a run without a result.
const UNDECIDED: i32 = 3;

/// What `--json` prints of a search that was stopped.
#[derive(Serialize)]
struct Line<'a> {
    status: &'static str,
    reason: String,
    claim: &'a str,
    seconds: f64,
    certificate: Option<String>,
}

/// Reads a number of seconds greater than 0.
pub fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| "expected a number of seconds".to_string())?;
    if seconds > 0.0
        && let Ok(limit) = Duration::try_from_secs_f64(seconds)
        && !limit.is_zero()
    {
        return Ok(limit);
    }
    Err("expected a number of seconds greater than 0".into())
}

/// The reason that a stopped search has.
pub fn reason(limit: Duration) -> String {
    format!("the time limit of {} s was reached", limit.as_secs_f64())
}

/// Ends the program with exit code 3 when the search is not over by then. A certificate that is being checked and written is finished.
pub fn watch(limit: Duration, claim: &str, printing: Printing) {
    let claim = claim.to_string();
    thread::spawn(move || {
        thread::sleep(limit);
        if OVER.swap(true, Ordering::SeqCst) {
            return;
        }
        let reason = reason(limit);
        // Whatever came of telling it, the run ends here.
        let _ = if printing.json {
            say_json(&Line {
                status: "undecided",
                reason,
                claim: &claim,
                seconds: limit.as_secs_f64(),
                certificate: None,
            })
        } else if printing.quiet {
            Ok(())
        } else {
            say(&format!("undecided: {claim}\n  because {reason}\n"))
        };
        process::exit(UNDECIDED);
    });
}

/// Tells the watch that the search came to its end. When the watch was first, this never returns.
pub fn search_is_over() {
    if OVER.swap(true, Ordering::SeqCst) {
        loop {
            thread::park();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds() {
        assert_eq!(parse_seconds("1.5"), Ok(Duration::from_millis(1500)));
        for text in ["", "0", "-1", "nan", "inf", "1e30", "1e-30", "ten"] {
            assert!(parse_seconds(text).is_err(), "{text}");
        }
    }
}
