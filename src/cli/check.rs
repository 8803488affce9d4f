//! `knotproof check`: replays certificates.

use std::fmt::Write;

use clap::Args;
use knotproof::certificate::{Document, FormatError, curve_sha256};
use knotproof::check::{Verdict, check};
use knotproof::claim::Claim;
use serde::Serialize;

use super::bounds::{Bounds, in_words, leaves_in_words};
use super::curvature_words::{self, CurvatureLine};
use super::deviation_words::{self, DeviationLine};
use super::domain_words::{self, DomainLine};
use super::embedding_words::{self, EmbeddingLine};
use super::failure::Failure;
use super::input::{Input, Noting, standard_input_once};
use super::motion_words::{self, MotionLine};
use super::output::{complain, say, say_json};
#[cfg(feature = "import")]
use super::reading::Reading;
use super::thickness_words::{self, ThicknessLine};
use super::values_words::{self, ValuesLine};
use super::{Exit, Printing};

/// Check certificates: replay their evidence in exact arithmetic
///
/// The checker uses none of the code that finds evidence, and no floating-point numbers. An accepted statement is proved.
///
/// For each file one line says whether its statement is proved. With several files the exit code is the worst: 2 when one
/// cannot be read, else 1 when one is rejected, else 0.
#[derive(Args)]
pub struct Arguments {
    /// Certificates, JSON or binary; "-" is standard input.
    #[arg(value_name = "CERT", required = true)]
    certificates: Vec<Input>,
    /// Accept only certificates about exactly this curve.
    #[arg(long, value_name = "CURVE")]
    curve: Option<Input>,
    /// Read the curve as `certify --snap-joints` does.
    #[arg(long, requires = "curve")]
    snap_joints: bool,
    #[cfg(feature = "import")]
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    printing: Printing,
}

/// The curve that certificates must be about.
struct Wanted<'a> {
    file: &'a Input,
    sha256: [u8; 32],
}

/// What `--json` prints of one file.
#[derive(Serialize)]
struct Line<'a> {
    file: String,
    #[serde(flatten)]
    outcome: &'a Outcome,
}

/// What became of one file.
#[derive(Serialize)]
#[serde(untagged)]
enum Outcome {
    Accepted {
        verdict: &'static str,
        statement: Box<StatementLine>,
        leaves: u64,
        curve_sha256: String,
    },
    Rejected {
        verdict: &'static str,
        place: Option<String>,
        reason: String,
    },
    Unreadable {
        error: String,
    },
}

/// An accepted statement.
#[derive(Serialize)]
#[serde(tag = "claim", rename_all = "snake_case")]
pub enum StatementLine {
    Msd {
        convention: &'static str,
        #[serde(flatten)]
        bounds: Bounds,
        #[serde(skip)]
        words: String,
    },
    Domain {
        #[serde(flatten)]
        line: DomainLine,
        #[serde(skip)]
        words: String,
    },
    Deviation {
        #[serde(flatten)]
        line: DeviationLine,
        #[serde(skip)]
        words: String,
    },
    Thickness {
        #[serde(flatten)]
        line: ThicknessLine,
        #[serde(skip)]
        words: String,
    },
    Curvature {
        #[serde(flatten)]
        line: CurvatureLine,
        #[serde(skip)]
        words: String,
    },
    Embedding {
        #[serde(flatten)]
        line: EmbeddingLine,
        #[serde(skip)]
        words: String,
    },
    Motion {
        #[serde(flatten)]
        line: Box<MotionLine>,
        #[serde(skip)]
        words: String,
    },
    Values {
        #[serde(flatten)]
        line: ValuesLine,
        #[serde(skip)]
        words: String,
    },
}

/// Runs the subcommand.
pub fn run(arguments: &Arguments) -> Result<Exit, Failure> {
    standard_input_once(arguments.certificates.iter().chain(&arguments.curve))?;
    let wanted = match &arguments.curve {
        None => None,
        Some(file) => {
            #[cfg(feature = "import")]
            let (read, _) = file.read_curve_with(arguments.snap_joints, &arguments.reading)?;
            #[cfg(not(feature = "import"))]
            let read = file.read_curve(arguments.snap_joints)?;
            let sha256 = curve_sha256(&read.curve);
            Some(Wanted { file, sha256 })
        }
    };
    let mut worst = Exit::Success;
    for input in &arguments.certificates {
        let (outcome, exit) = match judge(input, wanted.as_ref()) {
            Ok(outcome @ Outcome::Accepted { .. }) => (outcome, Exit::Success),
            Ok(outcome) => (outcome, Exit::Refuted),
            Err(failure) => {
                complain(&failure);
                (
                    Outcome::Unreadable {
                        error: failure.to_string(),
                    },
                    Exit::Unusable,
                )
            }
        };
        worst = worst.max(exit);
        if arguments.printing.json {
            say_json(&Line {
                file: input.to_string(),
                outcome: &outcome,
            })?;
        } else if !arguments.printing.quiet {
            say(&outcome.for_people(input))?;
        }
    }
    Ok(worst)
}

fn judge(input: &Input, wanted: Option<&Wanted>) -> Result<Outcome, Failure> {
    let mut source = Noting::new(input.open()?);
    let verdict = check(&mut source);
    if let Some(error) = source.into_error() {
        return Err(input.unreadable(&error));
    }
    let (document, leaves) = match verdict {
        Verdict::Accepted { document, leaves } => (document, leaves),
        Verdict::Malformed(_) if input.is_curve_file() => {
            let reason = "found a curve file, expected a certificate; certify makes one of it";
            return Ok(rejected(None, reason.into()));
        }
        Verdict::Malformed(error) => return Ok(malformed(error)),
        Verdict::Rejected { rejection, .. } => {
            return Ok(rejected(
                Some(rejection.place.to_string()),
                rejection.reason.to_string(),
            ));
        }
    };
    let sha256 = curve_sha256(&document.curve);
    match wanted {
        Some(wanted) if wanted.sha256 != sha256 => {
            let reason = format!(
                "the certificate is about another curve: expected curve_sha256 {}, that of {}, found {}",
                hexadecimal(&wanted.sha256),
                wanted.file,
                hexadecimal(&sha256)
            );
            Ok(rejected(Some("curve".into()), reason))
        }
        _ => Ok(accepted(&document, leaves, &sha256)),
    }
}

/// What a certificate states.
pub fn statement(document: &Document) -> StatementLine {
    match &document.claim {
        Claim::Msd(content) => StatementLine::Msd {
            convention: content.statement.convention.name(),
            bounds: Bounds::new(&content.statement),
            words: in_words(&content.statement),
        },
        Claim::Domain(content) => StatementLine::Domain {
            line: DomainLine::new(&content.statement),
            words: domain_words::in_words(&content.statement),
        },
        Claim::Deviation(content) => StatementLine::Deviation {
            line: DeviationLine::new(&content.statement),
            words: deviation_words::in_words(&content.statement),
        },
        Claim::Thickness(content) => StatementLine::Thickness {
            line: ThicknessLine::new(&content.statement),
            words: thickness_words::in_words(&content.statement, document.curve.is_closed()),
        },
        Claim::Curvature(content) => StatementLine::Curvature {
            line: CurvatureLine::new(&content.statement),
            words: curvature_words::in_words(&content.statement),
        },
        Claim::Motion(content) => StatementLine::Motion {
            line: Box::new(MotionLine::new(&content.statement)),
            words: motion_words::in_words(&content.statement),
        },
        Claim::Embedding(content) => StatementLine::Embedding {
            line: EmbeddingLine::new(&content.statement),
            words: embedding_words::in_words(&content.statement),
        },
        Claim::Values(content) => StatementLine::Values {
            line: ValuesLine::new(&content.statement),
            words: values_words::in_words(&content.statement),
        },
    }
}

fn accepted(document: &Document, leaves: u64, sha256: &[u8]) -> Outcome {
    Outcome::Accepted {
        verdict: "accepted",
        statement: Box::new(statement(document)),
        leaves,
        curve_sha256: hexadecimal(sha256),
    }
}

fn rejected(place: Option<String>, reason: String) -> Outcome {
    Outcome::Rejected {
        verdict: "rejected",
        place,
        reason,
    }
}

fn malformed(error: FormatError) -> Outcome {
    match error {
        FormatError::Malformed { place, what } => rejected(Some(place), what),
        other => rejected(None, other.to_string()),
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

#[cfg(feature = "prove")]
impl StatementLine {
    /// The statement in words.
    #[cfg(feature = "prove")]
    pub fn words(&self) -> &str {
        match self {
            StatementLine::Msd { words, .. }
            | StatementLine::Domain { words, .. }
            | StatementLine::Deviation { words, .. }
            | StatementLine::Thickness { words, .. }
            | StatementLine::Curvature { words, .. }
            | StatementLine::Embedding { words, .. }
            | StatementLine::Values { words, .. }
            | StatementLine::Motion { words, .. } => words,
        }
    }
}

impl Outcome {
    /// One line, or nothing of a file that could not be read: standard error has told that.
    fn for_people(&self, input: &Input) -> String {
        match self {
            Outcome::Accepted {
                statement,
                leaves,
                curve_sha256,
                ..
            } => {
                let curve = &curve_sha256[..12];
                match statement.as_ref() {
                    StatementLine::Msd { convention, words, .. } => format!(
                        "accepted: {input}: {words} (minimum separation distance, {convention} convention; curve {curve}…, {})\n",
                        leaves_in_words(*leaves),
                    ),
                    StatementLine::Thickness { line, words } => format!(
                        "accepted: {input}: {words} ({} convention; curve {curve}…, {})\n",
                        line.convention,
                        leaves_in_words(*leaves),
                    ),
                    StatementLine::Embedding { words, .. } | StatementLine::Motion { words, .. } => format!(
                        "accepted: {input}: {words} (curve {curve}…, {})\n",
                        leaves_in_words(*leaves),
                    ),
                    StatementLine::Domain { words, .. }
                    | StatementLine::Deviation { words, .. }
                    | StatementLine::Values { words, .. }
                    | StatementLine::Curvature { words, .. } => {
                        format!("accepted: {input}: {words} (curve {curve}…)\n")
                    }
                }
            }
            Outcome::Rejected {
                place: Some(place),
                reason,
                ..
            } => format!("rejected: {input}: {place}: {reason}\n"),
            Outcome::Rejected {
                place: None, reason, ..
            } => format!("rejected: {input}: {reason}\n"),
            Outcome::Unreadable { .. } => String::new(),
        }
    }
}
