//! Interval methods of other projects among what is compared.

use std::time::Duration;

use clap::Args;
use knotproof::compare::PeerOptions;

/// Which interpreter, and how long.
#[derive(Args)]
pub struct PeerArguments {
    /// Run interval methods too, where they are installed: Codac and python-flint, as Python modules (pip install codac python-flint numpy).
    #[arg(long, help_heading = "Interval methods")]
    peers: bool,
    /// The Python interpreter.
    #[arg(
        long,
        value_name = "PROGRAM",
        default_value = "python3",
        requires = "peers",
        help_heading = "Interval methods"
    )]
    python: String,
    /// A method that takes longer than so many seconds is ended.
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, requires = "peers", help_heading = "Interval methods", allow_hyphen_values = true, value_parser = seconds)]
    peer_limit: f64,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if seconds > 0.0 && seconds <= 1e6 => Ok(seconds),
        _ => Err("expected a number of seconds above 0, at most 1000000".into()),
    }
}

impl PeerArguments {
    /// What is asked of the library; nothing without --peers.
    pub fn options(&self) -> Option<PeerOptions> {
        self.peers.then(|| PeerOptions {
            python: self.python.clone(),
            limit: Duration::from_secs_f64(self.peer_limit),
        })
    }
}
