//! `knotproof certify curvature`: the greatest curvature.

use std::fmt::Write;
use std::time::Instant;

use clap::Args;
use knotproof::curve::{Chain, CurveFile};
use knotproof::number::{Integer, Rational, RationalExt, decimal_up, sqrt_enclosure};
use knotproof::prove::curvature::{Certified, Options, Status, certify};
use serde::Serialize;

use super::msd::{Width, parse_width};
use super::output_file::{Common, write};
use super::report::{Written, last_lines, parameter};
use super::time_limit::search_is_over;
use crate::cli::Exit;
use crate::cli::curvature_words::{CurvatureLine, in_words};
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};

/// Roots are enclosed this closely before widths are computed.
const ROOT_BITS: u32 = 256;

/// The greatest curvature of a curve
///
/// The output is an interval that contains the greatest curvature of the pieces (at joints from both sides) and a parameter where the lower bound is
/// attained. Corners do not count, but are told. Where the derivative vanishes, so that the curvature is not bounded, the exit code is 3 and the parameter is named.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1 or of a format that `import` reads; "-" is standard input. Several files, or a folder, make a batch.
    #[arg(required = true)]
    pub curve: Vec<Input>,
    /// How far apart the bounds may be, relative to the upper one: a decimal or a fraction from 1e-30 to 1e-1.
    #[arg(long, value_name = "WIDTH", default_value = "1e-9", allow_hyphen_values = true, value_parser = parse_width)]
    rel_width: Width,
    #[command(flatten)]
    pub common: Common,
}

/// The object of `--json`.
#[derive(Serialize)]
struct ForPrograms {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    claim: &'static str,
    #[serde(flatten)]
    bounds: Option<CurvatureLine>,
    relative_width: Option<String>,
    relative_width_asked: String,
    /// In the curve's own knots.
    at: Option<String>,
    piece: Option<usize>,
    local: Option<String>,
    /// The corners, in the curve's own knots.
    corners: Vec<String>,
    seconds: f64,
    certificate: Option<String>,
    snapped_joints: usize,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let target = arguments.common.target(&arguments.curve[0])?;
    let file = arguments.common.read(&arguments.curve[0])?;
    let options = Options {
        relative_width: arguments.rel_width.value.clone(),
        name: file.name.clone(),
        snapped_joints: (file.snapped > 0).then_some(file.snapped as u64),
    };
    let start = Instant::now();
    let found = certify(&file.curve, &options).map_err(|error| Failure::at(&arguments.curve[0], error))?;
    search_is_over();
    let written = match &found.document {
        None => None,
        Some(document) => write(document, target.as_ref(), arguments.common.format)?,
    };
    let seconds = start.elapsed().as_secs_f64();
    if arguments.common.printing.json {
        say_json(&for_programs(arguments, &file, &found, written.as_ref(), seconds))?;
    } else if !arguments.common.printing.quiet {
        say(&for_people(arguments, &file, &found, written.as_ref(), seconds))?;
    }
    Ok(match found.status {
        Status::Certified => Exit::Success,
        Status::Undecided(_) => Exit::Undecided,
    })
}

/// The knot values of corners.
fn corner_knots(chain: &Chain, corners: &[usize]) -> Vec<Rational> {
    let knot = |i: &usize| chain.knot_at(&Rational::from_integer(Integer::from(*i)));
    corners.iter().filter_map(knot).collect()
}

/// An upper bound of (upper − lower)/upper, 0 when both are equal.
fn relative_width(lower_squared: &Rational, upper_squared: &Rational) -> Option<String> {
    if lower_squared == upper_squared {
        return Some("0".into());
    }
    let (lower, upper) = (
        sqrt_enclosure(lower_squared, ROOT_BITS).0,
        sqrt_enclosure(upper_squared, ROOT_BITS).1,
    );
    (!upper.numer().is_zero()).then(|| decimal_up(&((&upper - lower) / &upper), 2))
}

fn for_programs(
    arguments: &Arguments,
    file: &CurveFile,
    found: &Certified,
    written: Option<&Written>,
    seconds: f64,
) -> ForPrograms {
    let chain = file.curve.chain();
    let (status, reason) = match &found.status {
        Status::Certified => ("certified", None),
        Status::Undecided(why) => ("undecided", Some(why.clone())),
    };
    let content = found.document.as_ref().map(|document| &document.claim);
    let evidence = content.map(|content| &content.evidence);
    ForPrograms {
        status,
        reason,
        claim: "curvature",
        bounds: content.map(|content| CurvatureLine::new(&content.statement)),
        relative_width: content
            .and_then(|content| relative_width(&content.statement.lower_squared, &content.statement.upper_squared)),
        relative_width_asked: arguments.rel_width.text.clone(),
        at: evidence.and_then(|evidence| Some(knot(&chain, evidence.piece, &evidence.u)?.format())),
        piece: evidence.map(|evidence| evidence.piece),
        local: evidence.map(|evidence| evidence.u.format()),
        corners: corner_knots(&chain, &found.corners)
            .iter()
            .map(Rational::format)
            .collect(),
        seconds,
        certificate: written.map(|written| written.path.display().to_string()),
        snapped_joints: file.snapped,
    }
}

fn knot(chain: &Chain, piece: usize, u: &Rational) -> Option<Rational> {
    chain.knot_at(&(Rational::from_integer(Integer::from(piece)) + u))
}

fn for_people(
    arguments: &Arguments,
    file: &CurveFile,
    found: &Certified,
    written: Option<&Written>,
    seconds: f64,
) -> String {
    let chain = file.curve.chain();
    let name = match &file.name {
        Some(name) => format!("{name:?}"),
        None => arguments.curve[0].to_string(),
    };
    let mut text = match &found.status {
        Status::Certified => format!("certified: greatest curvature of {name}\n"),
        Status::Undecided(why) => format!("undecided: greatest curvature of {name}\n  because {why}\n"),
    };
    let mut line = |words: String| {
        // Writing to a string does not fail.
        let _ = writeln!(text, "  {words}");
    };
    if let Some(document) = &found.document {
        let (statement, evidence) = (&document.claim.statement, &document.claim.evidence);
        let width = relative_width(&statement.lower_squared, &statement.upper_squared).unwrap_or_default();
        line(format!("{}, relative width {width}", in_words(statement)));
        let at = knot(&chain, evidence.piece, &evidence.u);
        line(format!(
            "where: parameter {} (piece {} at {}, pieces counted from 0)",
            at.as_ref().map(parameter).unwrap_or_default(),
            evidence.piece,
            parameter(&evidence.u)
        ));
    }
    let corners = corner_knots(&chain, &found.corners);
    if !corners.is_empty() {
        let first: Vec<String> = corners.iter().take(8).map(parameter).collect();
        let more = if corners.len() > first.len() { ", …" } else { "" };
        line(format!(
            "corners, which do not count: {}, at {}{more}",
            corners.len(),
            first.join(", ")
        ));
    }
    text + &last_lines(file.snapped, found.document.is_some(), written, seconds)
}
