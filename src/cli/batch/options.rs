//! Options of a batch.

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, ValueEnum};

use crate::cli::certify::time_limit::parse_seconds;

/// The heading over these options.
pub const MANY: &str = "Many curves";

/// How many curves are worked on, and what is written of them.
#[derive(Args, Clone, Default)]
pub struct Many {
    /// How many curves are worked on at the same time [default: one for each core]
    #[arg(long, short, help_heading = MANY, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
    /// Give a search up after this time, as undecided.
    #[arg(long, help_heading = MANY, value_name = "SECONDS", value_parser = parse_seconds)]
    pub time_limit: Option<Duration>,
    /// Keep what an earlier run into the same folder certified or refuted of the same curves with the same options. Its certificates are checked again.
    #[arg(long, help_heading = MANY, requires = "output")]
    pub resume: bool,
    /// Write one JSON object for each curve and claim to this file, as soon as it is known; "-" is standard output.
    #[arg(long, help_heading = MANY, value_name = "FILE")]
    pub jsonl: Option<PathBuf>,
    /// Write a page index.html into the folder, with all curves and what came of them [default if given: pictures]
    #[arg(long, help_heading = MANY, value_enum, value_name = "WHAT", num_args = 0..=1, require_equals = true, default_missing_value = "pictures", requires = "output")]
    pub show: Option<Show>,
}

/// What is drawn.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub enum Show {
    /// The page alone, with a small picture of each curve
    Index,
    /// A drawing of each certificate too
    Pictures,
    /// Drawings, and a report of each certificate with the checker inside (about 0.7 MB each)
    Reports,
}

impl Many {
    /// Is there an option that makes sense for many curves alone?
    pub fn is_given(&self) -> bool {
        self.jobs.is_some() || self.resume || self.jsonl.is_some() || self.show.is_some()
    }
}
