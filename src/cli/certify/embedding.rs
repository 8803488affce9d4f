//! `knotproof certify embedding`: no two parameters with one point.

use std::time::Instant;

use clap::Args;
use knotproof::certificate::{Encoding, MAX_JSON_BYTES};
use knotproof::claim::msd::Upper;
use knotproof::number::{Rational, RationalExt};
use knotproof::prove::embedding::{Certified, Options, Outcome, certify};
use knotproof::prove::msd::{self, CertifyError};
use serde::Serialize;
use tempfile::{NamedTempFile, SpooledTempFile};

use super::output_file::{Common, Target, encoding};
use super::progress::Progress;
use super::report::{Written, last_lines};
use super::time_limit::search_is_over;
use crate::cli::Exit;
use crate::cli::bounds::leaves_in_words;
use crate::cli::embedding_words::{EmbeddingLine, in_words};
use crate::cli::failure::Failure;
use crate::cli::input::Input;
use crate::cli::output::{say, say_json};

/// Is the curve embedded: does it pass through no point twice?
///
/// If it is, the output tells also how many edges an inscribed polygon has that is ambient isotopic to the curve, and how far all control
/// points may move at the same time without the curve meeting itself. If the curve meets itself, the place is named, the exit code is 1,
/// and the certificate is one of the claim msd with σ = 0. All that is printed as proved has been replayed by the checker, with or
/// without -o. When neither can be proved, the exit code is 3.
#[derive(Args)]
pub struct Arguments {
    /// The curve, a file of version curve/1 or of a format that `import` reads; "-" is standard input. Several files, or a folder, make a batch.
    #[arg(required = true)]
    pub curve: Vec<Input>,
    /// How many leaves the proof may have at most [default: 500,000 and 64 for each piece]
    #[arg(long, value_name = "LEAVES", value_parser = clap::value_parser!(u64).range(1..))]
    budget: Option<u64>,
    /// How many threads search; the certificate does not depend on it [default: one for each core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    pub common: Common,
}

/// What `--json` prints.
#[derive(Serialize)]
struct Line {
    status: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    claim: &'static str,
    #[serde(flatten)]
    statement: Option<EmbeddingLine>,
    /// Edges of the control polygon of the cells, if it is isotopic by the same tree; beside the statement, not in it.
    #[serde(skip_serializing_if = "Option::is_none")]
    control_polygon_edges: Option<Option<u64>>,
    /// The knot values of a common point: exact, or the middle of a box that contains them.
    #[serde(skip_serializing_if = "Option::is_none")]
    at: Option<[String; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rule: Option<&'static str>,
    leaves: u64,
    seconds: f64,
    certificate: Option<String>,
    snapped_joints: usize,
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
        budget: arguments.budget,
        name: file.name.clone(),
        snapped_joints: (file.snapped > 0).then_some(file.snapped as u64),
    };
    let start = Instant::now();
    let progress = Progress::new(arguments.common.printing.quiet);
    let outcome = certify(&file.curve, &options, &|part| progress.at(part)).map_err(|error| match error {
        CertifyError::PointPiece { .. } => Failure::at(&arguments.curve[0], error),
        error => failure(&error, None),
    })?;
    search_is_over();
    progress.checking();
    let mut line = Line {
        status: "undecided",
        reason: None,
        claim: "embedding",
        statement: None,
        control_polygon_edges: None,
        at: None,
        rule: None,
        leaves: 0,
        seconds: 0.0,
        certificate: None,
        snapped_joints: file.snapped,
    };
    let mut written = None;
    let (exit, words) = match outcome {
        Outcome::Embedded(mut certified) => {
            written = keep(certified.as_mut(), &arguments, target)?;
            let statement = &certified.document.claim.statement;
            line.status = "certified";
            line.statement = Some(EmbeddingLine::new(statement));
            line.leaves = certified.leaves;
            line.control_polygon_edges = Some(certified.control_polygon_edges);
            let control = match certified.control_polygon_edges {
                Some(1) => "the control polygon of its cells, of 1 edge, is isotopic to it too".into(),
                Some(edges) => format!("the control polygon of its cells, of {edges} edges, is isotopic to it too"),
                None => "no control polygon is shown to be isotopic to it: pieces are rational".to_string(),
            };
            let leaves = leaves_in_words(certified.leaves);
            let words = format!("{}\n  {control}\n  by {leaves}", in_words(statement));
            (Exit::Success, words)
        }
        Outcome::MeetsItself(mut certified) => {
            written = keep(certified.as_mut(), &arguments, target)?;
            line.status = "refuted";
            let count = Rational::from_integer(file.curve.chain().count().into());
            let knot = |s: &Rational| {
                let s = if *s > count { s - &count } else { s.clone() };
                file.curve.chain().knot_at(&s)
            };
            let at = certified
                .at
                .as_ref()
                .map(|at| at.each_ref().map(|s| knot(s).unwrap_or_default()));
            let (rule, how) = match certified.document.claim.evidence.upper {
                Some(Upper::Crossing { .. }) => ("crossing", "crosses itself at about"),
                _ => ("touch", "passes twice through the point at exactly"),
            };
            line.rule = Some(rule);
            line.at = at.as_ref().map(|at| at.each_ref().map(RationalExt::format));
            let places = at.map_or(String::new(), |[s, t]| {
                format!(" {how} the knot values {} and {}", near(&s), near(&t))
            });
            (Exit::Refuted, format!("the curve is not embedded, it{places}"))
        }
        Outcome::Undecided(reason) => {
            let words = format!("whether the curve is embedded, because {reason}");
            line.reason = Some(reason);
            (Exit::Undecided, words)
        }
    };
    drop(progress);
    line.seconds = start.elapsed().as_secs_f64();
    line.certificate = written.as_ref().map(|written| written.path.display().to_string());
    if arguments.common.printing.json {
        say_json(&line)?;
    } else if !arguments.common.printing.quiet {
        let mut text = format!("{}: {words}\n", line.status);
        text.push_str(&last_lines(
            file.snapped,
            exit != Exit::Undecided,
            written.as_ref(),
            line.seconds,
        ));
        say(&text)?;
    }
    Ok(exit)
}

/// A parameter for people.
fn near(x: &Rational) -> String {
    format!("{:.12}", x.to_f64())
}

/// Either kind of certificate.
trait Checked {
    fn write_checked_to(&mut self, encoding: Encoding, file: &mut NamedTempFile) -> Result<(), CertifyError>;
    fn check_alone(&mut self) -> Result<(), CertifyError>;
}

macro_rules! checked {
    ($($kind:ty),*) => {
        $(impl Checked for $kind {
            fn write_checked_to(&mut self, encoding: Encoding, file: &mut NamedTempFile) -> Result<(), CertifyError> {
                self.write_checked(encoding, file)
            }
            fn check_alone(&mut self) -> Result<(), CertifyError> {
                self.write_checked(Encoding::Binary, &mut SpooledTempFile::new(1 << 26))
            }
        })*
    };
}

checked!(Certified<'_>, msd::Certified<'_>);

/// Lets the checker replay a certificate, and writes it where it is wanted.
fn keep(
    certified: &mut impl Checked,
    arguments: &Arguments,
    target: Option<Target>,
) -> Result<Option<Written>, Failure> {
    let Some(target) = target else {
        certified.check_alone().map_err(|error| failure(&error, None))?;
        return Ok(None);
    };
    let encoding = encoding(arguments.common.format, target.path());
    let written = target.write(|file| {
        certified.write_checked_to(encoding, file).map_err(|error| {
            let size = file.as_file().metadata().map_or(0, |metadata| metadata.len());
            if encoding == Encoding::Json && size >= MAX_JSON_BYTES {
                let what = "cannot be written: the certificate is above 1 GiB as JSON, use --format binary";
                return Failure::at(target.path().display(), what);
            }
            failure(&error, Some(&target))
        })
    })?;
    Ok(Some(written))
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
