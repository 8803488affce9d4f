//! `knotproof certify`: proves a claim about a curve.

mod curvature;
mod deviation;
pub mod domain;
mod embedding;
mod motion;
mod motion_report;
mod msd;
pub mod output_file;
pub mod progress;
mod report;
pub mod specification;
mod thickness;
pub mod time_limit;
mod values;

use clap::{ArgMatches, Args, Subcommand};

use self::output_file::Common;
use self::specification::Specification;
use super::failure::Failure;
use super::input::Input;
use super::{Exit, batch};

/// Prove a claim about a curve, and write the certificate
///
/// With several files, with a folder of files, or with --all, which takes every curve of a file, it is proved of many curves in parallel; -o then names a folder. See `batch` for
/// several claims at once.
#[derive(Args)]
pub struct Arguments {
    #[command(subcommand)]
    claim: Claim,
}

#[derive(Subcommand)]
enum Claim {
    Msd(Box<msd::Arguments>),
    Domain(Box<domain::Arguments>),
    Curvature(curvature::Arguments),
    Deviation(deviation::Arguments),
    Embedding(Box<embedding::Arguments>),
    Motion(Box<motion::Arguments>),
    Thickness(thickness::Arguments),
    Values(values::Arguments),
}

impl Claim {
    /// The files, and what every claim's command takes.
    fn common(&self) -> (&[Input], &Common) {
        match self {
            Claim::Msd(arguments) => (&arguments.curve, &arguments.common),
            Claim::Domain(arguments) => (&arguments.curve, &arguments.common),
            Claim::Curvature(arguments) => (&arguments.curve, &arguments.common),
            Claim::Deviation(arguments) => (&arguments.curve, &arguments.common),
            Claim::Embedding(arguments) => (&arguments.curve, &arguments.common),
            Claim::Motion(arguments) => (&arguments.motion, &arguments.common),
            Claim::Thickness(arguments) => (&arguments.curve, &arguments.common),
            Claim::Values(arguments) => (&arguments.curve, &arguments.common),
        }
    }
}

/// Runs the subcommand; `matches` are those of its arguments.
pub fn run(arguments: Arguments, matches: &ArgMatches) -> Result<Exit, Failure> {
    let (inputs, common) = arguments.claim.common();
    if let Some((claim, matches)) = matches.subcommand() {
        if common.makes_a_batch(inputs) {
            return batch::perform(batch::Order {
                inputs,
                specifications: vec![Specification::of(claim, matches)],
                output: common.output.as_deref(),
                format: common.format,
                snap_joints: common.snap_joints,
                #[cfg(feature = "import")]
                reading: &common.reading,
                many: &common.many,
                printing: common.printing,
            });
        }
        if let Some(limit) = common.many.time_limit {
            time_limit::watch(limit, claim, common.printing);
        }
    }
    match arguments.claim {
        Claim::Msd(arguments) => msd::run(*arguments),
        Claim::Domain(arguments) => domain::run(&arguments),
        Claim::Curvature(arguments) => curvature::run(&arguments),
        Claim::Deviation(arguments) => deviation::run(&arguments),
        Claim::Embedding(arguments) => embedding::run(*arguments),
        Claim::Motion(arguments) => motion::run(&arguments),
        Claim::Thickness(arguments) => thickness::run(&arguments),
        Claim::Values(arguments) => values::run(&arguments),
    }
}
