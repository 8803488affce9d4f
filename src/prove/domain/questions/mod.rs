//! Questions about a domain: the nearest point of it, the fairest, the shortest move that changes the sign, the largest ball.
//!
//! The first two and the last are solved by cutting planes: the exact solution for the rows found so far, then the row that it violates most (Kelley
//! 1960). What is found is evidence for the checker, and has passed it when it is returned.

mod ball;
mod change;
mod distance;
mod nearest;
mod projection;
pub(crate) mod rounding;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::fmt;

use num_traits::Signed;

use super::feasible::{self, Found};
use super::{Options, Problem, Status, position_inside};
use crate::certificate::Document;
use crate::check::domain::sign::{DomainError, Section};
use crate::check::domain::{Context, check_domain, fair_point};
use crate::claim::domain::{Content, Evidence, Outcome, Row, Statement, Target};
use crate::curve::Curve;
use crate::number::{Integer, Rational};

/// What is asked about K ∩ B, K the domain and B the box.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum About {
    /// The point of cl K ∩ B nearest to this one.
    Nearest(Vec<Rational>),
    /// The point of cl K ∩ B where ∫|c''|² is least.
    Fair,
    /// The shortest move of the control point, from where it is, that changes the sign. The box plays no part.
    Change,
    /// The largest ball in cl K ∩ B.
    Ball,
}

/// An answer with its evidence, which the checker has accepted.
pub struct Answer<'c> {
    /// The document.
    pub document: Document<'c, Content>,
    /// Are the bounds as close as was asked for?
    pub status: Status,
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq)]
pub enum AnswerError {
    /// The domain is none.
    Domain(DomainError),
    /// The point asked about has another number of coordinates than the curve.
    Dimension {
        /// How many it has.
        found: usize,
        /// How many the curve has.
        expected: usize,
    },
    /// The curve has a rational piece, or its second derivative does not depend on the control point.
    NoFairPoint,
    /// The control point is not in K.
    Outside,
    /// The sign does not depend on the control point: no move changes it.
    Constant,
    /// K ∩ B is empty, with the evidence of the outcome `empty`.
    Empty(Box<Evidence>),
    /// Neither a point of K ∩ B was found nor that there is none.
    NoPoint,
    /// Bounds could not be found; why.
    Unsolved(String),
    /// The checker does not accept the evidence found; an error of this program.
    Refuted(String),
}

impl fmt::Display for AnswerError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            AnswerError::Domain(error) => error.fmt(f),
            AnswerError::Dimension { found, expected } => {
                write!(f, "the point asked about has {found} coordinates, the curve has {expected}")
            }
            AnswerError::NoFairPoint => f.write_str(
                "no position minimises ∫|c''|²: expected polynomial pieces and a control point that the second derivative depends on",
            ),
            AnswerError::Outside => {
                f.write_str("the control point is not in its domain: where it is, the curve has not the sign asked for everywhere")
            }
            AnswerError::Constant => f.write_str("no move of the control point changes the sign"),
            AnswerError::Empty(_) => f.write_str("the domain has no point in the box"),
            AnswerError::NoPoint => {
                f.write_str("neither a point of the domain was found in the box nor a proof that there is none")
            }
            AnswerError::Unsolved(why) => write!(f, "no bounds were found: {why}"),
            AnswerError::Refuted(why) => write!(f, "the checker refuses the evidence found ({why})"),
        }
    }
}

impl std::error::Error for AnswerError {}

/// How close the bounds are to be unless something else is asked for: 1e-9.
pub fn usual_width() -> Rational {
    Rational::new(Integer::ONE, Integer::from(1_000_000_000))
}

/// What one of the searches found.
struct Finding {
    outcome: Outcome,
    evidence: Evidence,
    close: bool,
}

/// Answers a question about a domain, and lets the checker replay the evidence.
///
/// `options.tolerance` is the width of the bounds in relation to the upper one: of squared distances, or of the ball's radius ([`usual_width`]). The
/// bounds of a distance that is 0, or next to nothing in relation to the box, are close enough when the distance is below that part of the box.
/// `options.budget` bounds the rows.
///
/// # Errors
/// [`AnswerError`]: questions without answer, an empty domain (with its evidence), a search without result.
pub fn answer<'c>(
    curve: &'c Curve,
    problem: &Problem,
    about: &About,
    options: &Options,
) -> Result<Answer<'c>, AnswerError> {
    let context = Context::new(curve, &problem.domain).map_err(AnswerError::Domain)?;
    let finding = match about {
        About::Nearest(point) => {
            let (found, expected) = (point.len(), context.dimension);
            if found != expected {
                return Err(AnswerError::Dimension { found, expected });
            }
            let center = center(&context, problem, options)?;
            nearest::find(&context, &center, Target::Point(point.clone()), point, options)?
        }
        About::Fair => {
            let point = fair_point(curve, &problem.domain.points).ok_or(AnswerError::NoFairPoint)?;
            let center = center(&context, problem, options)?;
            nearest::find(&context, &center, Target::Fair, &point, options)?
        }
        About::Change => {
            if !problem.has_sign {
                return Err(AnswerError::Outside);
            }
            change::find(&context, &problem.position, options)?
        }
        About::Ball => {
            let center = center(&context, problem, options)?;
            ball::find(&context, &center, options)?
        }
    };
    let content = Content {
        statement: Statement {
            domain: problem.domain.clone(),
            outcome: finding.outcome,
        },
        evidence: finding.evidence,
    };
    check_domain(curve, &content).map_err(|rejection| AnswerError::Refuted(rejection.to_string()))?;
    Ok(Answer {
        document: Document {
            tool: crate::prove::TOOL.into(),
            name: options.name.clone(),
            snapped_joints: options.snapped_joints,
            curve: Cow::Borrowed(curve),
            claim: content,
        },
        status: if finding.close {
            Status::Certified
        } else {
            Status::Undecided("the bounds are not as close as was asked for".into())
        },
    })
}

/// A point of K inside the box.
fn center(context: &Context, problem: &Problem, options: &Options) -> Result<Vec<Rational>, AnswerError> {
    if let Some(position) = position_inside(context, problem) {
        return Ok(position);
    }
    match feasible::find(context, options.solver) {
        Found::Point(point) => Ok(point),
        Found::Empty(evidence) => Err(AnswerError::Empty(Box::new(evidence))),
        Found::Nothing => Err(AnswerError::NoPoint),
    }
}

/// The rows that every search begins with: the sides of the box.
fn sides(context: &Context) -> impl Iterator<Item = Row> {
    (0..2 * context.dimension).map(|side| Row::Side {
        axis: side / 2,
        high: side % 2 == 1,
    })
}

/// The rows at a parameter of a section, 0 to 1, rounded more and more finely: short ones serve as well, since at the worst parameter the violation
/// changes with the square of the rounding.
fn rows_at(section: &Section, at: f64) -> impl Iterator<Item = Row> {
    const BITS: [u32; 4] = [16, 26, 38, 52];
    BITS.into_iter().map(move |bits| {
        let numerator = (at * 2f64.powi(bits as i32)).round() as u64;
        Row::Parameter {
            piece: section.piece,
            u: section.local(numerator, bits as usize),
        }
    })
}

/// (upper − lower) ≤ tolerance·upper.
fn close(lower: &Rational, upper: &Rational, tolerance: &Rational) -> bool {
    debug_assert!(!lower.is_negative());
    upper - lower <= upper * tolerance
}
