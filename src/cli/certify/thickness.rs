//! `knotproof certify thickness`: the smaller of the least radius of curvature and σ/2.

use std::fmt::Write;
use std::time::Instant;

use clap::{Args, ValueEnum};
use knotproof::certificate::Encoding;
use knotproof::claim::msd::Convention;
use knotproof::claim::thickness::{Content, Evidence};
use knotproof::curve::{Chain, CurveFile};
use knotproof::number::{Integer, Rational, RationalExt};
use knotproof::prove::thickness::{Certified, CertifyError, Options, Status, certify};
use serde::Serialize;
use tempfile::SpooledTempFile;

use super::msd::{Width, parse_width};
use super::output_file::{Common, Format, Target, encoding};
use super::progress::Progress;
use super::report::{Written, last_lines, parameter};
use super::time_limit::search_is_over;
use crate::cli::Exit;
use crate::cli::bounds::leaves_in_words;
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};
use crate::cli::thickness_words::{ThicknessLine, in_words, subject};

/// The thickness of a curve: the smaller of its least radius of curvature and half its minimum separation distance
///
/// Of a closed smooth curve without self-intersections it is the greatest radius of a pipe around the curve that does not cut itself. A corner makes it 0. Of an open curve,
/// in the convention "critical", it is the reach. The output is an interval that contains it; all that is printed as proved has been replayed by the checker.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1 or of a format that `import` reads; "-" is standard input. Several files, or a folder, make a batch.
    #[arg(required = true)]
    pub curve: Vec<Input>,
    /// Which chords count for the minimum separation distance; an open curve needs "critical".
    #[arg(long, value_enum, default_value_t = ConventionName::Smooth)]
    convention: ConventionName,
    /// How far apart the bounds may be, relative to the upper one: a decimal or a fraction from 1e-30 to 1e-1.
    #[arg(long, value_name = "WIDTH", default_value = "1e-9", allow_hyphen_values = true, value_parser = parse_width)]
    rel_width: Width,
    /// How many leaves the cover tree may have at most [default: 500,000 and 64 for each piece]
    #[arg(long, value_name = "LEAVES", value_parser = clap::value_parser!(u64).range(1..))]
    budget: Option<u64>,
    #[command(flatten)]
    pub common: Common,
}

#[derive(Clone, Copy, ValueEnum)]
enum ConventionName {
    /// Orthogonal to the tangent at each end
    Smooth,
    /// Turning points of the distance at open ends count too
    Critical,
}

/// The object of `--json`.
#[derive(Serialize)]
struct ForPrograms {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    claim: &'static str,
    #[serde(flatten)]
    bounds: Option<ThicknessLine>,
    relative_width_asked: String,
    /// Where the curvature is greatest, in the curve's own knots.
    at: Option<String>,
    piece: Option<usize>,
    /// The ends of the shortest double normal found, in the curve's own knots.
    chord: Option<Vec<String>>,
    corner: Option<String>,
    leaves: u64,
    seconds: f64,
    certificate: Option<String>,
    snapped_joints: usize,
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    let target = arguments.common.target(&arguments.curve[0])?;
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
    let found = certify(&file.curve, &options, &|part| progress.at(part));
    let mut found = found.map_err(|error| Failure::at(&arguments.curve[0], error))?;
    search_is_over();
    progress.checking();
    let written = write(&mut found, target.as_ref(), arguments.common.format)?;
    drop(progress);
    let report = Report {
        arguments,
        file: &file,
        found: &found,
        written,
        seconds: start.elapsed().as_secs_f64(),
    };
    if arguments.common.printing.json {
        say_json(&report.for_programs())?;
    } else if !arguments.common.printing.quiet {
        say(&report.for_people())?;
    }
    Ok(match found.status {
        Status::Certified => Exit::Success,
        Status::Undecided(_) => Exit::Undecided,
    })
}

/// Writes the certificate, or lets the checker replay it all the same when no file is asked for.
fn write(found: &mut Certified, target: Option<&Target>, format: Option<Format>) -> Result<Option<Written>, Failure> {
    if found.document.is_none() {
        return Ok(None);
    }
    match target {
        Some(target) => {
            let encoding = encoding(format, target.path());
            let write = |file: &mut _| found.write_checked(encoding, file).map_err(|error| failure(&error));
            target.write(write).map(Some)
        }
        None => {
            let mut nowhere = SpooledTempFile::new(1 << 26);
            found
                .write_checked(Encoding::Binary, &mut nowhere)
                .map_err(|error| failure(&error))?;
            Ok(None)
        }
    }
}

fn failure(error: &CertifyError) -> Failure {
    match error {
        CertifyError::Io(error) => Failure::io("the certificate", "cannot be written", error),
        CertifyError::Refuted(_) => Failure::new(format!("{error}; this is an error of knotproof, please report it")),
    }
}

struct Report<'r> {
    arguments: &'r Arguments,
    file: &'r CurveFile,
    found: &'r Certified<'r>,
    written: Option<Written>,
    seconds: f64,
}

/// The knot value of a global parameter, on a closed curve modulo the number of pieces.
fn knot(chain: &Chain, parameter: &Rational) -> Option<Rational> {
    let count = Rational::from_integer(Integer::from(chain.count()));
    match chain.closed() && *parameter >= count {
        true => chain.knot_at(&(parameter - count)),
        false => chain.knot_at(parameter),
    }
}

impl Report<'_> {
    fn content(&self) -> Option<&Content> {
        self.found.document.as_ref().map(|document| &document.claim)
    }

    /// Where the curvature is greatest: the knot value and the piece.
    fn bend(&self, chain: &Chain) -> Option<(Rational, usize)> {
        let Evidence::Bounds { curvature, .. } = &self.content()?.evidence else {
            return None;
        };
        let piece = curvature.evidence.piece;
        let global = Rational::from_integer(Integer::from(piece)) + &curvature.evidence.u;
        Some((chain.knot_at(&global)?, piece))
    }

    fn corner(&self, chain: &Chain) -> Option<Rational> {
        match &self.content()?.evidence {
            Evidence::Corner { joint } => chain.knot_at(&Rational::from_integer(Integer::from(*joint))),
            Evidence::Bounds { .. } => None,
        }
    }

    fn chord(&self, chain: &Chain) -> Option<Vec<Rational>> {
        self.found.chord.as_ref()?.iter().map(|end| knot(chain, end)).collect()
    }

    fn for_programs(&self) -> ForPrograms {
        let chain = self.file.curve.chain();
        let (status, reason) = match &self.found.status {
            Status::Certified => ("certified", None),
            Status::Undecided(why) => ("undecided", Some(why.clone())),
        };
        let bend = self.bend(&chain);
        let chord = self.chord(&chain);
        ForPrograms {
            status,
            reason,
            claim: "thickness",
            bounds: self.content().map(|content| ThicknessLine::new(&content.statement)),
            relative_width_asked: self.arguments.rel_width.text.clone(),
            at: bend.as_ref().map(|(knot, _)| knot.format()),
            piece: bend.map(|(_, piece)| piece),
            chord: chord.map(|ends| ends.iter().map(Rational::format).collect()),
            corner: self.corner(&chain).map(|knot| knot.format()),
            leaves: self.found.leaves,
            seconds: self.seconds,
            certificate: self.written.as_ref().map(|written| written.path.display().to_string()),
            snapped_joints: self.file.snapped,
        }
    }

    fn for_people(&self) -> String {
        let chain = self.file.curve.chain();
        let name = match &self.file.name {
            Some(name) => format!("{name:?}"),
            None => self.arguments.curve[0].to_string(),
        };
        let subject = subject(chain.closed());
        let mut text = match &self.found.status {
            Status::Certified => format!("certified: {subject} of {name}\n"),
            Status::Undecided(why) => format!("undecided: {subject} of {name}\n  because {why}\n"),
        };
        let mut line = |words: String| {
            // Writing to a string does not fail.
            let _ = writeln!(text, "  {words}");
        };
        if let Some(content) = self.content() {
            line(in_words(&content.statement, chain.closed()));
        }
        if let Some(corner) = self.corner(&chain) {
            line(format!("because of a corner at the parameter {}", parameter(&corner)));
        }
        if let Some((bend, piece)) = self.bend(&chain) {
            line(format!(
                "greatest curvature: parameter {} (piece {piece}, counted from 0)",
                parameter(&bend)
            ));
        }
        if let Some(ends) = self.chord(&chain) {
            let ends: Vec<String> = ends.iter().map(parameter).collect();
            line(format!("shortest double normal: parameters {}", ends.join(" and ")));
            line(format!("a cover tree with {}", leaves_in_words(self.found.leaves)));
        }
        let has_evidence = self.found.document.is_some();
        text + &last_lines(self.file.snapped, has_evidence, self.written.as_ref(), self.seconds)
    }
}
