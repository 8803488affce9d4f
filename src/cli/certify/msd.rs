//! `knotproof certify msd`: the minimum separation distance.

use std::time::Instant;

use clap::{Args, ValueEnum};
use knotproof::certificate::{Encoding, MAX_JSON_BYTES};
use knotproof::claim::msd::Convention;
use knotproof::number::{Integer, Meaning, Rational, parse_number};
use knotproof::prove::msd::{Certified, CertifyError, Options, Status, certify};
use tempfile::SpooledTempFile;

use super::output_file::{Common, Target, encoding};
use super::progress::Progress;
use super::report::{Report, Written};
use super::time_limit::search_is_over;
use crate::cli::Exit;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};

/// The minimum separation distance σ: the length of the shortest double normal
///
/// A double normal is a chord orthogonal to the curve at both ends. The output is an interval that contains σ and the place
/// on the curve. All that is printed as proved has been replayed by the checker, with or without -o. When the interval asked
/// for cannot be proved, the exit code is 3, and what could be proved is printed and written.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1 or of a format that `import` reads; "-" is standard input. Several files, or a folder, make a batch.
    #[arg(required = true)]
    pub curve: Vec<Input>,
    /// Which chords count at corners and ends.
    #[arg(long, value_enum, default_value_t = ConventionName::Smooth)]
    convention: ConventionName,
    /// How far apart the bounds may be, relative to the upper one: a decimal or a fraction from 1e-30 to 1e-1.
    #[arg(long, value_name = "WIDTH", default_value = "1e-12", allow_hyphen_values = true, value_parser = parse_width)]
    rel_width: Width,
    /// How many leaves the proof may have at most [default: 500,000 and 64 for each piece]
    #[arg(long, value_name = "LEAVES", value_parser = clap::value_parser!(u64).range(1..))]
    budget: Option<u64>,
    /// How many threads search; the certificate does not depend on it [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    pub common: Common,
}

#[derive(Clone, Copy, ValueEnum)]
enum ConventionName {
    /// Orthogonal to a one-sided tangent at each end
    Smooth,
    /// Turning points of the distance at corners and open ends count too
    Critical,
}

/// A relative width, with the text that gave it.
#[derive(Clone)]
pub struct Width {
    /// As it was written.
    pub text: String,
    /// From 1e-30 to 1e-1.
    pub value: Rational,
}

/// Reads a relative width.
pub fn parse_width(text: &str) -> Result<Width, String> {
    let power = |exponent| Rational::new(Integer::ONE, Integer::from(10).pow(exponent));
    let value = parse_number(text, Meaning::Decimal).map_err(|error| error.to_string())?;
    if value < power(30) || value > power(1) {
        return Err("expected a width from 1e-30 to 1e-1".into());
    }
    Ok(Width {
        text: text.into(),
        value,
    })
}

/// Runs the subcommand.
pub fn run(arguments: Arguments) -> Result<Exit, Failure> {
    let target = arguments.common.target(&arguments.curve[0])?;
    if let Some(threads) = arguments.threads {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
        pool.build_global().map_err(|error| Failure::at("--threads", error))?;
    }
    let file = arguments.common.read(&arguments.curve[0])?;
    let options = Options {
        convention: match arguments.convention {
            ConventionName::Smooth => Convention::Smooth,
            ConventionName::Critical => Convention::Critical,
        },
        relative_width: arguments.rel_width.value.clone(),
        budget: arguments.budget,
        name: file.name.clone(),
        snapped_joints: (file.snapped > 0).then_some(file.snapped as u64),
    };
    let start = Instant::now();
    let progress = Progress::new(arguments.common.printing.quiet);
    let mut certified = certify(&file.curve, &options, &|part| progress.at(part)).map_err(|error| match error {
        CertifyError::PointPiece { .. } => Failure::at(&arguments.curve[0], error),
        error => failure(&error, None),
    })?;
    search_is_over();
    progress.checking();
    let written = match target {
        Some(target) => Some(write(
            &mut certified,
            encoding(arguments.common.format, target.path()),
            &target,
        )?),
        None => {
            let mut nowhere = SpooledTempFile::new(1 << 26);
            certified
                .write_checked(Encoding::Binary, &mut nowhere)
                .map_err(|error| failure(&error, None))?;
            None
        }
    };
    drop(progress);
    let seconds = start.elapsed().as_secs_f64();
    let report = Report {
        input: &arguments.curve[0],
        file: &file,
        certified: &certified,
        width_asked: &arguments.rel_width.text,
        seconds,
        written,
    };
    if arguments.common.printing.json {
        say_json(&report.for_programs())?;
    } else if !arguments.common.printing.quiet {
        say(&report.for_people())?;
    }
    Ok(match certified.status {
        Status::Certified => Exit::Success,
        Status::Undecided(_) => Exit::Undecided,
    })
}

fn write(certified: &mut Certified, encoding: Encoding, target: &Target) -> Result<Written, Failure> {
    target.write(|file| {
        certified.write_checked(encoding, file).map_err(|error| {
            let size = file.as_file().metadata().map_or(0, |metadata| metadata.len());
            if encoding == Encoding::Json && size >= MAX_JSON_BYTES {
                let what = "cannot be written: the certificate is above 1 GiB as JSON, use --format binary";
                return Failure::at(target.path().display(), what);
            }
            failure(&error, Some(target))
        })
    })
}

fn failure(error: &CertifyError, target: Option<&Target>) -> Failure {
    match (error, target) {
        (CertifyError::Io(error), Some(target)) => target.failure(error),
        (CertifyError::Io(error), None) => Failure::io("temporary file", "cannot be written", error),
        (CertifyError::PointPiece { .. }, _) => Failure::new(error.to_string()),
        (CertifyError::Refuted(_), _) => {
            Failure::new(format!("{error}; this is an error of knotproof, please report it"))
        }
    }
}
