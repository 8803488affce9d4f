//! `knotproof certify deviation`: the distance between a curve and its control polygon.

use std::fmt::Write as _;
use std::time::Instant;

use clap::Args;
use knotproof::check::deviation::MOST_SUBDIVISIONS;
use knotproof::number::{RationalExt, sqrt_decimal_up};
use knotproof::prove::deviation::{Options, certify};
use knotproof::prove::domain::Status;
use serde::Serialize;

use super::msd::{Width, parse_width};
use super::output_file::{Common, write};
use super::report::last_lines;
use super::time_limit::search_is_over;
use crate::cli::Exit;
use crate::cli::deviation_words::{DeviationLine, in_words};
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};

/// Digits of the bound.
const BOUND_DIGITS: usize = 6;

/// The distance between a curve and its control polygon after subdivision
///
/// Every piece is halved so often as is asked for; the control polygon of the parts is parametrised linearly between control points, the k-th of n+1 at k/n of its part. The output is an
/// interval that contains the greatest distance of points of the same parameter, and the bound of Nairn, Peters and Lutterkort (1999) that visualisation software goes by.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1 or of a format that `import` reads; "-" is standard input. Several files, or a folder, make a batch.
    #[arg(required = true)]
    pub curve: Vec<Input>,
    /// How often every piece is halved.
    #[arg(long, value_name = "M", default_value_t = 0, value_parser = clap::value_parser!(u32).range(0..=i64::from(MOST_SUBDIVISIONS)))]
    subdivisions: u32,
    /// How far apart the bounds of the squared distance may be, relative to the upper one: a decimal or a fraction from 1e-30 to 1e-1.
    #[arg(long, value_name = "WIDTH", default_value = "1e-6", allow_hyphen_values = true, value_parser = parse_width)]
    rel_width: Width,
    #[command(flatten)]
    pub common: Common,
}

#[derive(Serialize)]
struct ForPrograms {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    claim: &'static str,
    #[serde(flatten)]
    bounds: Option<DeviationLine>,
    edges: u64,
    /// The bound of Nairn, Peters and Lutterkort, squared and exact, for polynomial pieces.
    bound_squared: Option<String>,
    /// The same as a decimal, rounded up.
    bound: Option<String>,
    seconds: f64,
    certificate: Option<String>,
    snapped_joints: usize,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let target = arguments.common.target(&arguments.curve[0])?;
    let file = arguments.common.read(&arguments.curve[0])?;
    let options = Options {
        subdivisions: arguments.subdivisions,
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
    let bound = found
        .bound_squared
        .as_ref()
        .map(|squared| sqrt_decimal_up(squared, BOUND_DIGITS));
    let statement = found.document.as_ref().map(|document| &document.claim.statement);
    let reason = match &found.status {
        Status::Certified => None,
        Status::Undecided(why) => Some(why.clone()),
    };
    let exit = match reason {
        None => Exit::Success,
        Some(_) => Exit::Undecided,
    };
    if arguments.common.printing.json {
        say_json(&ForPrograms {
            status: if reason.is_none() { "certified" } else { "undecided" },
            reason,
            claim: "deviation",
            bounds: statement.map(DeviationLine::new),
            edges: found.edges,
            bound_squared: found.bound_squared.as_ref().map(|squared| squared.format()),
            bound,
            seconds,
            certificate: written.map(|written| written.path.display().to_string()),
            snapped_joints: file.snapped,
        })?;
    } else if !arguments.common.printing.quiet {
        let name = match &file.name {
            Some(name) => format!("{name:?}"),
            None => arguments.curve[0].to_string(),
        };
        let mut text = match &reason {
            None => format!("certified: deviation of {name} from its control polygon\n"),
            Some(why) => format!("undecided: deviation of {name} from its control polygon\n  because {why}\n"),
        };
        if let Some(statement) = statement {
            let _ = writeln!(text, "  {}", in_words(statement));
        }
        let edges = if found.edges == 1 { "edge" } else { "edges" };
        let _ = writeln!(text, "  the polygon has {} {edges}", found.edges);
        let _ = match bound {
            Some(bound) => writeln!(
                text,
                "  bound by second differences (Nairn, Peters, Lutterkort 1999): at most {bound}"
            ),
            None => writeln!(text, "  no bound by second differences: a piece is rational"),
        };
        text.push_str(&last_lines(
            file.snapped,
            statement.is_some(),
            written.as_ref(),
            seconds,
        ));
        say(&text)?;
    }
    Ok(exit)
}
