//! `knotproof certify`: proves a claim about a curve.

mod curvature;
mod deviation;
pub mod domain;
mod embedding;
mod motion;
mod motion_report;
mod msd;
mod output_file;
pub mod progress;
mod report;
mod thickness;
mod values;

use clap::{Args, Subcommand};

use super::Exit;
use super::failure::Failure;

/// Prove a claim about a curve, and write the certificate.
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

/// Runs the subcommand.
pub fn run(arguments: Arguments) -> Result<Exit, Failure> {
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
