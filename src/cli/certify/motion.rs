//! `knotproof certify motion`: what stays true while a curve moves.

use std::io::Read;
use std::path::Path;
use std::time::Instant;

use clap::{Args, ValueEnum};
use knotproof::certificate::{Encoding, MAX_JSON_BYTES};
use knotproof::motion::{Motion, ReadOptions, read_motion, read_motion_text};
use knotproof::number::{Meaning, Rational, parse_number};
use knotproof::prove::motion::{Certified, Options, certify};
use knotproof::prove::msd::CertifyError;
use tempfile::SpooledTempFile;

use super::motion_report::{FRAMES_TOLD, Report};
use super::output_file::{Common, Target, encoding};
use super::progress::Progress;
use super::report::Written;
use super::time_limit::search_is_over;
use crate::cli::Exit;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};

/// A moving curve: what stays true at, and between, all frames, and until when.
///
/// The motion moves the control points in a straight line from each frame to the next. Certified is until when the curve, and the polygon of its control points, pass through no point twice; the motion up to
/// there is an isotopy. If one of them meets itself, the step in which it does is named, the exit code is 1, and the certificate proves both: no meeting before, a meeting in that step. With a display tolerance, the
/// first steps are told at which the criterion of second differences (CPIJ14) and that of ½ν fail; these do not change the exit code. When neither an embedding to the end nor a meeting can be proved, the exit code is 3.
#[derive(Args)]
pub struct Arguments {
    /// The motion, a file of version motion/1; "-" is standard input, where paths of curves are relative to the current directory. Several files make a batch.
    #[arg(required = true)]
    pub motion: Vec<Input>,
    /// What is followed.
    #[arg(long, value_enum, default_value_t = Tracks::Both)]
    track: Tracks,
    /// The distance ε_d that the curve may have from the polygon drawn at time 0: a positive decimal or fraction [default: that of the motion, if it has one]
    #[arg(long, value_name = "DISTANCE", allow_hyphen_values = true, value_parser = parse_distance)]
    display_tolerance: Option<Distance>,
    /// How many leaves a tree may have at most [default: 500,000 and 64 for each piece]
    #[arg(long, value_name = "LEAVES", value_parser = clap::value_parser!(u64).range(1..))]
    budget: Option<u64>,
    #[command(flatten)]
    pub common: Common,
}

/// What is followed.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Tracks {
    /// The curve
    Curve,
    /// The polygon of its control points
    Polygon,
    /// Both
    Both,
}

/// A distance from the command line.
#[derive(Clone)]
struct Distance(Rational);

fn parse_distance(text: &str) -> Result<Distance, String> {
    let value = parse_number(text, Meaning::Decimal).map_err(|error| error.to_string())?;
    if value.numer().is_positive() {
        Ok(Distance(value))
    } else {
        Err("expected a positive number".into())
    }
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let target = arguments.common.target(&arguments.motion[0])?;
    let motion = read(&arguments.motion[0], arguments.common.snap_joints)?;
    let options = Options {
        curve: arguments.track != Tracks::Polygon,
        polygon: arguments.track != Tracks::Curve,
        display_tolerance: arguments.display_tolerance.clone().map(|distance| distance.0),
        budget: arguments.budget,
        frames_kept: FRAMES_TOLD,
    };
    let start = Instant::now();
    let progress = Progress::new(arguments.common.printing.quiet);
    let mut certified = certify(&motion, &options, &|part| progress.at(part))
        .map_err(|error| Failure::at(&arguments.motion[0], error))?;
    search_is_over();
    progress.checking();
    let written = match certified.document {
        Some(_) => keep(&mut certified, arguments, target.as_ref())?,
        None => None,
    };
    drop(progress);
    let report = Report {
        input: &arguments.motion[0],
        motion: &motion,
        certified: &certified,
        seconds: start.elapsed().as_secs_f64(),
        written,
    };
    if arguments.common.printing.json {
        say_json(&report.for_programs())?;
    } else if !arguments.common.printing.quiet {
        say(&report.for_people())?;
    }
    Ok(report.exit())
}

fn read(input: &Input, snap_joints: bool) -> Result<Motion, Failure> {
    let options = ReadOptions { snap_joints };
    let motion = match input {
        Input::File(path) => read_motion(path, options),
        Input::Standard => {
            let mut text = Vec::new();
            input
                .open()?
                .read_to_end(&mut text)
                .map_err(|error| input.unreadable(&error))?;
            read_motion_text(&text, Path::new(""), options)
        }
    };
    motion.map_err(|error| Failure::at(input, error))
}

/// Lets the checker replay the certificate, and writes it where it is wanted.
fn keep(certified: &mut Certified, arguments: &Arguments, target: Option<&Target>) -> Result<Option<Written>, Failure> {
    let Some(target) = target else {
        let mut nowhere = SpooledTempFile::new(1 << 26);
        certified
            .write_checked(Encoding::Binary, &mut nowhere)
            .map_err(|error| failure(&error, None))?;
        return Ok(None);
    };
    let encoding = encoding(arguments.common.format, target.path());
    let written = target.write(|file| {
        certified.write_checked(encoding, file).map_err(|error| {
            let size = file.as_file().metadata().map_or(0, |metadata| metadata.len());
            if encoding == Encoding::Json && size >= MAX_JSON_BYTES {
                let what = "cannot be written: the certificate is above 1 GiB as JSON, use --format binary";
                return Failure::at(target.path().display(), what);
            }
            failure(&error, Some(target))
        })
    })?;
    Ok(Some(written))
}

fn failure(error: &CertifyError, target: Option<&Target>) -> Failure {
    match (error, target) {
        (CertifyError::Io(error), Some(target)) => target.failure(error),
        (CertifyError::Io(error), None) => Failure::io("temporary file", "cannot be written", error),
        _ => Failure::new(format!("{error}; this is an error of knotproof, please report it")),
    }
}
