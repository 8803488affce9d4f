//! `knotproof certify values`: exact results of the basic operations.

use std::fmt::Write as _;
use std::time::Instant;

use clap::Args;
use knotproof::number::{Meaning, Rational, parse_number};
use knotproof::prove::domain::Status;
use knotproof::prove::values::{Kind, Options, ValuesError, certify};
use serde::Serialize;

use super::msd::{Width, parse_width};
use super::output_file::{Common, write};
use super::report::last_lines;
use super::time_limit::search_is_over;
use crate::cli::Exit;
use crate::cli::failure::Failure;
use crate::cli::input::{Input, standard_input_once};
use crate::cli::output::{say, say_json};
use crate::cli::values_words::{ValuesLine, in_words};

/// Exact results of the basic operations: points, derivatives, curvature, torsion, knot insertion and removal, degree elevation, splitting, distances
///
/// The operations are done in exact arithmetic at parameters that depend on the curve alone: its knots, the binary64 numbers next to them, and some between.
/// The checker recomputes every result by another formula. Distances are given as intervals.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1 or of a format that `import` reads; "-" is standard input. Several files, or a folder, make a batch.
    #[arg(required = true)]
    pub curve: Vec<Input>,
    /// Which operations, with commas between: point, derivative, curvature, torsion, insert_knot, remove_knot, elevate_degree, split, decompose, nearest_point,
    /// curve_distance [default: all that the curve has]
    #[arg(long, value_name = "OPERATIONS", value_delimiter = ',', value_parser = parse_kind)]
    ops: Option<Vec<Kind>>,
    /// Parameters inside each piece, beside its ends and the binary64 numbers next to them. Of a curve of more than 64 pieces 64 are sampled.
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u16).range(0..=1024))]
    samples: u16,
    /// A point whose distance from the curve is asked for; may be given several times.
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = parse_target)]
    target: Vec<Target>,
    /// Another curve whose distance from this one is asked for; may be given several times.
    #[arg(long, value_name = "CURVE2")]
    other: Vec<Input>,
    /// How far apart the bounds of a squared distance may be, relative to the upper one: a decimal or a fraction from 1e-30 to 1e-1.
    #[arg(long, value_name = "WIDTH", default_value = "1e-9", allow_hyphen_values = true, value_parser = parse_width)]
    rel_width: Width,
    #[command(flatten)]
    pub common: Common,
}

/// A position; `clap` would take a list for several values.
#[derive(Clone)]
struct Target(Vec<Rational>);

fn parse_kind(text: &str) -> Result<Kind, String> {
    let names: Vec<&str> = Kind::ALL.iter().map(|kind| kind.name()).collect();
    let found = Kind::ALL.into_iter().find(|kind| kind.name() == text);
    found.ok_or_else(|| format!("expected one of {}", names.join(", ")))
}

fn parse_target(text: &str) -> Result<Target, String> {
    let coordinates = text.split(',').map(|word| parse_number(word, Meaning::Decimal));
    let coordinates: Vec<Rational> = coordinates
        .collect::<Result<_, _>>()
        .map_err(|error| error.to_string())?;
    match coordinates.len() {
        2 | 3 => Ok(Target(coordinates)),
        found => Err(format!("expected 2 or 3 coordinates, found {found}")),
    }
}

#[derive(Serialize)]
struct ForPrograms {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    claim: &'static str,
    #[serde(flatten)]
    line: ValuesLine,
    /// Operations asked for that have no entry, with the reason.
    without: Vec<Without>,
    relative_width_asked: String,
    seconds: f64,
    certificate: Option<String>,
    snapped_joints: usize,
}

#[derive(Serialize)]
struct Without {
    operation: &'static str,
    reason: &'static str,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    standard_input_once(std::iter::once(&arguments.curve[0]).chain(&arguments.other))?;
    let target = arguments.common.target(&arguments.curve[0])?;
    let file = arguments.common.read(&arguments.curve[0])?;
    let mut snapped = file.snapped;
    let mut others = Vec::new();
    for other in &arguments.other {
        let other = other.read_curve(arguments.common.snap_joints)?;
        snapped += other.snapped;
        others.push(other.curve);
    }
    let options = Options {
        operations: arguments.ops.clone(),
        samples: usize::from(arguments.samples),
        targets: arguments.target.iter().map(|target| target.0.clone()).collect(),
        others,
        relative_width: arguments.rel_width.value.clone(),
        name: file.name.clone(),
        snapped_joints: (snapped > 0).then_some(snapped as u64),
    };
    let start = Instant::now();
    let found = certify(&file.curve, &options).map_err(|error| match error {
        ValuesError::PointPiece {
            other: Some(number),
            piece,
        } => Failure::at(&arguments.other[number], ValuesError::PointPiece { other: None, piece }),
        error => Failure::at(&arguments.curve[0], error),
    })?;
    search_is_over();
    let written = write(&found.document, target.as_ref(), arguments.common.format)?;
    let seconds = start.elapsed().as_secs_f64();
    let statement = &found.document.claim.statement;
    let reason = match &found.status {
        Status::Certified => None,
        Status::Undecided(why) => Some(why.clone()),
    };
    let exit = match reason {
        None => Exit::Success,
        Some(_) => Exit::Undecided,
    };
    if arguments.common.printing.json {
        let without = found.without.iter().map(|(kind, reason)| Without {
            operation: kind.name(),
            reason,
        });
        say_json(&ForPrograms {
            status: if reason.is_none() { "certified" } else { "undecided" },
            reason,
            claim: "values",
            line: ValuesLine::new(statement),
            without: without.collect(),
            relative_width_asked: arguments.rel_width.text.clone(),
            seconds,
            certificate: written.map(|written| written.path.display().to_string()),
            snapped_joints: snapped,
        })?;
    } else if !arguments.common.printing.quiet {
        let name = match &file.name {
            Some(name) => format!("{name:?}"),
            None => arguments.curve[0].to_string(),
        };
        let mut text = match &reason {
            None => format!("certified: results of operations on {name}\n"),
            Some(why) => format!("undecided: results of operations on {name}\n  because {why}\n"),
        };
        let _ = writeln!(text, "  {}", in_words(statement));
        for (kind, why) in &found.without {
            let _ = writeln!(text, "  no {}: {why}", kind.name());
        }
        text.push_str(&last_lines(snapped, true, written.as_ref(), seconds));
        say(&text)?;
    }
    Ok(exit)
}
