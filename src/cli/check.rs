//! `knotproof check`: replays certificates.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Write as _};
use std::path::{Path, PathBuf};

use clap::Args;
use knotproof::certificate::{Document, FormatError, curve_sha256};
use knotproof::check::{Verdict, check};
use knotproof::claim::Claim;
use serde::Serialize;

#[cfg(feature = "prove")]
use super::batch::progress::Progress;
use super::bounds::{Bounds, in_words, leaves_in_words};
use super::curvature_words::{self, CurvatureLine};
use super::deviation_words::{self, DeviationLine};
use super::domain_words::{self, DomainStatementLine};
use super::embedding_words::{self, EmbeddingLine};
use super::failure::Failure;
use super::input::{Input, Noting, standard_input_once};
use super::motion_words::{self, MotionLine};
use super::output::{complain, say, say_json};
use super::pool::{self, guarded};
#[cfg(feature = "import")]
use super::reading::Reading;
use super::thickness_words::{self, ThicknessLine};
use super::values_words::{self, ValuesLine};
use super::{Exit, Printing};

/// Check certificates: replay their evidence in exact arithmetic
///
/// The checker uses none of the code that finds evidence, and no floating-point numbers. An accepted statement is proved.
///
/// For each file one line says whether its statement is proved. Several files are checked at the same time, and a last line counts them; the exit code is the worst: 2 when
/// one cannot be read, else 1 when one is rejected, else 0.
#[derive(Args)]
pub struct Arguments {
    /// Certificates, JSON or binary, and folders, of which the files that end in ".cert.json" or ".cert.bin" are taken; "-" is standard input.
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
    /// How many certificates are checked at the same time [default: one for each core]
    #[arg(long, short, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    jobs: Option<u16>,
    /// Write one JSON object for each file, as --json does, to this file.
    #[arg(long, value_name = "FILE")]
    jsonl: Option<PathBuf>,
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
        line: DomainStatementLine,
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
    let inputs = expand(&arguments.certificates)?;
    let mut lines = match &arguments.jsonl {
        None => None,
        Some(path) => Some((path, File::create(path).map_err(|error| unwritable(path, &error))?)),
    };
    #[cfg(feature = "prove")]
    let progress = Progress::new(inputs.len(), arguments.printing.quiet || inputs.len() == 1);
    let mut worst = Exit::Success;
    let mut counts = [0; 3];
    let mut failure = None;
    let work = |i: usize| guarded(|| judge(&inputs[i], wanted.as_ref()));
    pool::in_order(inputs.len(), pool::workers(arguments.jobs), work, |i, judged| {
        let judged = judged.unwrap_or_else(|panic| Err(Failure::at(&inputs[i], panic)));
        let tell = || arguments.tell(&inputs[i], judged, lines.as_mut());
        #[cfg(feature = "prove")]
        let told = {
            progress.done("checked");
            progress.aside(tell)
        };
        #[cfg(not(feature = "prove"))]
        let told = tell();
        match told {
            Ok(exit) => {
                worst = worst.max(exit);
                counts[usize::from(exit.code())] += 1;
            }
            Err(error) => {
                failure.get_or_insert(error);
            }
        }
    });
    if let Some(failure) = failure {
        return Err(failure);
    }
    let printing = arguments.printing;
    if inputs.len() > 1 && !printing.json && !printing.quiet {
        let [accepted, rejected, unreadable] = counts;
        let count = inputs.len();
        say(&format!(
            "{count} files: {accepted} accepted, {rejected} rejected, {unreadable} not read\n"
        ))?;
    }
    Ok(worst)
}

impl Arguments {
    /// Tells what became of a file.
    fn tell(
        &self,
        input: &Input,
        judged: Result<Outcome, Failure>,
        lines: Option<&mut (&PathBuf, File)>,
    ) -> Result<Exit, Failure> {
        let (outcome, exit) = match judged {
            Ok(outcome @ Outcome::Accepted { .. }) => (outcome, Exit::Success),
            Ok(outcome) => (outcome, Exit::Refuted),
            Err(failure) => {
                complain(&failure);
                let error = failure.to_string();
                (Outcome::Unreadable { error }, Exit::Unusable)
            }
        };
        let line = Line {
            file: input.to_string(),
            outcome: &outcome,
        };
        if let Some((path, file)) = lines {
            let mut text = serde_json::to_string(&line).map_err(|error| Failure::at(path.display(), error))?;
            text.push('\n');
            file.write_all(text.as_bytes())
                .map_err(|error| unwritable(path, &error))?;
        }
        if self.printing.json {
            say_json(&line)?;
        } else if !self.printing.quiet {
            say(&outcome.for_people(input))?;
        }
        Ok(exit)
    }
}

fn unwritable(path: &Path, error: &io::Error) -> Failure {
    Failure::io(path.display(), "cannot be written", error)
}

/// Folders become the certificates in them.
fn expand(given: &[Input]) -> Result<Vec<Input>, Failure> {
    let mut inputs = Vec::new();
    for input in given {
        let Input::File(folder) = input else {
            inputs.push(input.clone());
            continue;
        };
        if !folder.is_dir() {
            inputs.push(input.clone());
            continue;
        }
        let certificates = input.files_in(folder)?.into_iter().filter(|path| {
            let name = path.to_string_lossy();
            name.ends_with(".cert.json") || name.ends_with(".cert.bin")
        });
        let before = inputs.len();
        inputs.extend(certificates.map(Input::File));
        if inputs.len() == before {
            let what = "found no file in the folder that ends in .cert.json or .cert.bin";
            return Err(Failure::at(input, what));
        }
    }
    Ok(inputs)
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
            line: DomainStatementLine::new(&content.statement),
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

/// Bytes as hexadecimal digits.
pub fn hexadecimal(bytes: &[u8]) -> String {
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
