//! Evidence about the convex domain of a control point.

mod feasible;
pub mod levels;
mod parts;
pub mod problem;
pub mod questions;
pub mod sandwich;

use std::borrow::Cow;
use std::io::{self, Read, Seek, SeekFrom, Write};

use super::linear_program::FloatSolver;
use crate::certificate::{Document, Encoding, write};
use crate::check::domain::Context;
use crate::check::{Verdict, check};
use crate::claim::AsClaim;
use crate::claim::domain::{Content, Outcome, Statement};
use crate::curve::Curve;
use crate::number::{Rational, RationalExt};
use feasible::Found;
pub use problem::{Bounds, Problem, Question, QuestionError};
use sandwich::{Round, Search};

/// What certifying needs to know.
#[derive(Clone)]
pub struct Options<'s> {
    /// measure(outer \ inner)/measure(inner) is to be at most this.
    pub tolerance: Rational,
    /// Rows of the outer polytope at most.
    pub budget: usize,
    /// A name for the document.
    pub name: Option<String>,
    /// How many joints were moved together on reading.
    pub snapped_joints: Option<u64>,
    /// Measure the polytopes of every round exactly, not only those of the last.
    pub measure_rounds: bool,
    /// Suggests solutions of linear programs; what it says is never trusted.
    pub solver: &'s dyn FloatSolver,
}

/// What was found of a domain.
pub struct Certified<'c> {
    /// The document; `None` when nothing can be stated.
    pub document: Option<Document<'c, Content>>,
    /// Is what was asked for proved?
    pub status: Status,
    /// The rounds of the refinement.
    pub rounds: Vec<Round>,
}

/// How far the proof went.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Status {
    /// What was asked for is proved.
    Certified,
    /// Not within the budget; why.
    Undecided(String),
}

/// Why no certificate was written.
#[derive(Debug)]
pub enum CertifyError {
    /// Writing failed.
    Io(io::Error),
    /// The checker did not accept what was found; an error of this program.
    Refuted(String),
}

impl std::fmt::Display for CertifyError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            CertifyError::Io(error) => write!(f, "writing failed: {error}"),
            CertifyError::Refuted(why) => {
                write!(f, "the checker refuses the evidence found, nothing was written ({why})")
            }
        }
    }
}

impl std::error::Error for CertifyError {}

impl From<io::Error> for CertifyError {
    fn from(error: io::Error) -> Self {
        CertifyError::Io(error)
    }
}

/// Writes a certificate to `file`, reads it back and lets the checker replay it. Only `Ok` means that the file is a proof.
///
/// # Errors
/// [`CertifyError::Refuted`] when the checker does not accept the file, which must then be thrown away.
pub fn write_checked<C: AsClaim, F: Read + Write + Seek>(
    document: &Document<C>,
    encoding: Encoding,
    file: &mut F,
) -> Result<(), CertifyError> {
    write_with_tree(document, io::empty(), encoding, file)
}

/// The same with a tree, as its tokens in their binary spelling.
///
/// # Errors
/// As those of [`write_checked`].
pub(super) fn write_with_tree<C: AsClaim, F: Read + Write + Seek>(
    document: &Document<C>,
    tree: impl Read,
    encoding: Encoding,
    file: &mut F,
) -> Result<(), CertifyError> {
    {
        let mut out = io::BufWriter::with_capacity(1 << 16, &mut *file);
        write(document, tree, encoding, &mut out)?;
        out.flush()?;
    }
    file.seek(SeekFrom::Start(0))?;
    match check(&mut *file) {
        Verdict::Accepted { document: read, .. } if read.claim.as_claim() == document.claim.as_claim() => Ok(()),
        Verdict::Accepted { .. } => Err(CertifyError::Refuted("another claim was read back".into())),
        Verdict::Malformed(error) => Err(CertifyError::Refuted(error.to_string())),
        Verdict::Rejected { rejection, .. } => Err(CertifyError::Refuted(rejection.to_string())),
    }
}

/// Finds two polytopes with K ∩ B between them, close enough for the tolerance.
pub fn certify<'c>(curve: &'c Curve, problem: &Problem, options: &Options) -> Certified<'c> {
    match problem.position.len() {
        2 => certify_in::<2>(curve, problem, options),
        _ => certify_in::<3>(curve, problem, options),
    }
}

fn certify_in<'c, const D: usize>(curve: &'c Curve, problem: &Problem, options: &Options) -> Certified<'c> {
    let mut rounds = Vec::new();
    let undecided = |why: &str, rounds| Certified {
        document: None,
        status: Status::Undecided(why.into()),
        rounds,
    };
    let Ok(context) = Context::new(curve, &problem.domain) else {
        return undecided("the domain is none", rounds);
    };
    let document = |outcome, evidence| Document {
        tool: super::TOOL.into(),
        name: options.name.clone(),
        snapped_joints: options.snapped_joints,
        curve: Cow::Borrowed(curve),
        claim: Content {
            statement: Statement {
                domain: problem.domain.clone(),
                outcome,
            },
            evidence,
        },
    };
    let found = match position_inside(&context, problem) {
        Some(position) => Found::Point(position),
        None => feasible::find(&context, options.solver),
    };
    let center: [Rational; D] = match found {
        Found::Point(point) => match point.try_into() {
            Ok(center) => center,
            Err(_) => return undecided("no point of the domain was found", rounds),
        },
        Found::Empty(evidence) => {
            return Certified {
                document: Some(document(Outcome::Empty, evidence)),
                status: Status::Certified,
                rounds,
            };
        }
        Found::Nothing => {
            return undecided("neither a point of the domain was found nor that there is none", rounds);
        }
    };
    let tolerance = options.tolerance.to_f64();
    let Some(mut search) = Search::new(&context, center, tolerance, options.measure_rounds) else {
        return undecided("no point of the domain was found", rounds);
    };
    let mut best = None;
    let mut why = "";
    // The estimate has to leave room for the rounding.
    for share in [0.85, 0.6, 0.3] {
        let reached = search.refine(tolerance * share, options.budget, &mut rounds);
        match search.evidence() {
            Ok(found) => {
                let done = found.within(&options.tolerance);
                best = Some(found);
                if done {
                    why = "";
                    break;
                }
                why = "the tolerance was not reached";
            }
            Err(_) => why = "the polytopes found could not be shown to be right",
        }
        if !reached {
            break;
        }
    }
    let document = best.map(|found| {
        let outcome = Outcome::Sandwich {
            inner_measure: found.inner_measure,
            outer_measure: found.outer_measure,
        };
        document(outcome, found.evidence)
    });
    let status = if why.is_empty() {
        Status::Certified
    } else {
        Status::Undecided(why.into())
    };
    Certified {
        document,
        status,
        rounds,
    }
}

/// Where the control point is, if that is in K and inside the box.
fn position_inside(context: &Context, problem: &Problem) -> Option<Vec<Rational>> {
    let position = &problem.position;
    (problem.has_sign && sandwich::strictly_in_box(context, position)).then(|| position.clone())
}
