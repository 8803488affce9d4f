//! The claim `values`: results of the basic operations, recomputed (FORMAT §15, proofs in docs/values.md).
//!
//! None of it uses the operations of `curve`: points are sums of Bernstein polynomials, derivatives quotients of power series, curvature and torsion come
//! from X'w − Xw', and curves are compared as curves after comparing their knots.

pub mod distance;
pub mod nearest;
pub mod pieces;
pub mod same;
mod taylor;

use super::rule::Failure;
use super::{Place, Reason, Rejection};
use crate::claim::values::{
    Content, Entry, MOST_ENTRIES, MOST_ORDER, MOST_TIMES, MOST_TOKENS, Operation, Outcome, Witness,
};
use crate::curve::{Curve, Form};
use crate::number::{Rational, RationalExt};
use distance::check_tree;
use nearest::{show_lower, squared_distance};
use pieces::Pieces;
use same::{Spline, require_same};

/// Checks statement and evidence about a curve.
///
/// # Errors
/// The first entry that does not hold.
pub fn check_values(curve: &Curve, content: &Content) -> Result<(), Rejection> {
    let pieces = Pieces::new(curve).map_err(|piece| Rejection {
        place: Place::Curve,
        reason: Reason::PointPiece { piece },
    })?;
    let checker = Checker {
        curve,
        pieces: &pieces,
        spline: Spline::of(curve),
    };
    let entries = &content.statement.entries;
    let mut witnesses = content.evidence.witnesses.iter();
    let tokens = witnesses.clone().map(|witness| match witness {
        Witness::Distance { tree: Some(tokens), .. } => tokens.len(),
        _ => 0,
    });
    let evidence = |failure| Rejection {
        place: Place::Evidence,
        reason: Reason::Obligation {
            rule: "values",
            failure,
        },
    };
    if entries.len() > MOST_ENTRIES || tokens.fold(0, usize::saturating_add) > MOST_TOKENS {
        return Err(evidence(Failure {
            expected: "at most 65,536 entries and 4,194,304 tokens",
            found: "more".into(),
        }));
    }
    for (number, entry) in entries.iter().enumerate() {
        checker.entry(entry, &mut witnesses).map_err(|failure| Rejection {
            place: Place::Entry { number },
            reason: Reason::Obligation {
                rule: entry.operation.name(),
                failure,
            },
        })?;
    }
    match witnesses.next() {
        None => Ok(()),
        Some(_) => Err(evidence(Failure {
            expected: "one witness for each entry that needs one",
            found: "more".into(),
        })),
    }
}

struct Checker<'c> {
    curve: &'c Curve,
    pieces: &'c Pieces,
    /// Nothing for several Bézier pieces.
    spline: Option<Spline>,
}

fn fails<T>(expected: &'static str, found: impl Into<String>) -> Result<T, Failure> {
    let found = found.into();
    Err(Failure { expected, found })
}

/// Is what is stated what was computed?
fn equal(stated: &[Rational], computed: &[Rational]) -> Result<(), Failure> {
    if stated == computed {
        return Ok(());
    }
    let texts: Vec<String> = computed.iter().map(short).collect();
    fails(
        "the exact value",
        format!("another one; the exact one is {}", texts.join(", ")),
    )
}

/// A number for a message.
fn short(x: &Rational) -> String {
    match x.numer().bits() + x.denom().bits() {
        0..=200 => x.format(),
        _ => "a long fraction".into(),
    }
}

fn times(times: u32) -> Result<usize, Failure> {
    match times {
        1..=MOST_TIMES => Ok(times as usize),
        _ => fails("times from 1 to 64", times.to_string()),
    }
}

impl Checker<'_> {
    fn entry<'w>(&self, entry: &Entry, witnesses: &mut impl Iterator<Item = &'w Witness>) -> Result<(), Failure> {
        let pieces = self.pieces;
        match (&entry.operation, &entry.outcome) {
            (Operation::Point { parameter }, Outcome::Point(point)) => equal(point, &pieces.point(parameter)?),
            (Operation::Derivative { parameter, order, side }, Outcome::Vector(vector)) => {
                if *order == 0 || *order > MOST_ORDER {
                    return fails("an order from 1 to 64", order.to_string());
                }
                let place = pieces.place(parameter, *side)?;
                equal(vector, &taylor::derivative(&place, *order as usize))
            }
            (Operation::Curvature { parameter, side }, Outcome::ValueSquared(squared)) => {
                let computed = taylor::curvature_squared(&pieces.place(parameter, *side)?)?;
                equal(std::slice::from_ref(squared), &[computed])
            }
            (Operation::Torsion { parameter, side }, Outcome::Value(value)) => {
                if pieces.dimension != 3 {
                    return fails("a curve in space", "one in the plane");
                }
                let computed = taylor::torsion(&pieces.place(parameter, *side)?)?;
                equal(std::slice::from_ref(value), &[computed])
            }
            (Operation::InsertKnot { parameter, times: n }, Outcome::Curve(result)) => {
                let Some(wanted) = self.spline()?.inserted(parameter, times(*n)?) else {
                    return fails("a knot in the domain", parameter.format());
                };
                self.is_same(&wanted, result)
            }
            (Operation::RemoveKnot { parameter, times: n }, Outcome::Curve(result)) => {
                let Some(wanted) = self.spline()?.removed(parameter, times(*n)?) else {
                    return fails("a knot inside the domain, so often", parameter.format());
                };
                self.is_same(&wanted, result)
            }
            (Operation::ElevateDegree { times: n }, Outcome::Curve(result)) => {
                self.is_same(&self.spline()?.elevated(times(*n)?), result)
            }
            (Operation::Split { parameter }, Outcome::Curves(results)) => {
                let Some(wanted) = self.spline()?.split(parameter) else {
                    return fails("a parameter inside the domain", parameter.format());
                };
                wanted
                    .iter()
                    .zip(results.iter())
                    .try_for_each(|(wanted, result)| self.is_same(wanted, result))
            }
            (Operation::Decompose, Outcome::Curve(result)) => self.decomposed(result),
            (Operation::NearestPoint { target }, Outcome::DistanceSquared { lower, upper }) => {
                let Some(Witness::Nearest { parameter }) = witnesses.next() else {
                    return fails("a witness with one parameter", "none");
                };
                self.nearest(target, [lower, upper], parameter)
            }
            (Operation::CurveDistance { other }, Outcome::DistanceSquared { lower, upper }) => {
                let Some(Witness::Distance { parameters, tree }) = witnesses.next() else {
                    return fails("a witness with two parameters", "none");
                };
                let other = match Pieces::new(other) {
                    Ok(other) if other.dimension == pieces.dimension => other,
                    Ok(_) => return fails("a curve of the same dimension", "another one"),
                    Err(piece) => return fails("pieces that are not points", format!("piece {piece}")),
                };
                let [p, q] = [pieces.point(&parameters[0])?, other.point(&parameters[1])?];
                if squared_distance(&p, &q) > *upper {
                    return fails("points of a squared distance of at most upper_squared", "a greater one");
                }
                match tree {
                    None if lower.numer().is_zero() => Ok(()),
                    Some(tokens) if lower.numer().is_positive() => check_tree(pieces, &other, tokens, lower),
                    _ => fails("a tree when and only when lower_squared is not 0", "otherwise"),
                }
            }
            _ => fails("the outcome that belongs to the operation", "another one"),
        }
    }

    fn spline(&self) -> Result<&Spline, Failure> {
        match &self.spline {
            Some(spline) => Ok(spline),
            None => fails("a B-spline or a single Bézier piece", "several Bézier pieces"),
        }
    }

    fn is_same(&self, wanted: &Spline, result: &Curve) -> Result<(), Failure> {
        wanted.require(result)?;
        require_same(self.pieces, &pieces_of(result)?)
    }

    fn decomposed(&self, result: &Curve) -> Result<(), Failure> {
        self.spline()?;
        let Form::Bezier(found) = result.form() else {
            return fails("Bézier pieces", "a B-spline");
        };
        let pieces = self.pieces;
        let alike = found.len() == pieces.pieces.len()
            && found.iter().zip(&pieces.pieces).all(|(a, b)| a.degree() == b.degree());
        if !alike {
            return fails("a piece of the curve's degree for every non-empty interval", "others");
        }
        let mut result = pieces_of(result)?;
        result.ends.clone_from(&pieces.ends);
        require_same(pieces, &result)
    }

    fn nearest(
        &self,
        target: &[Rational],
        [lower, upper]: [&Rational; 2],
        parameter: &Rational,
    ) -> Result<(), Failure> {
        if target.len() != self.curve.dimension() {
            return fails(
                "a point of the curve's dimension",
                format!("{} coordinates", target.len()),
            );
        }
        if squared_distance(&self.pieces.point(parameter)?, target) > *upper {
            return fails(
                "a point of a squared distance of at most upper_squared",
                "a greater one",
            );
        }
        match show_lower(self.pieces, target, lower) {
            Ok(()) => Ok(()),
            Err((piece, _)) => fails(
                "a squared distance of at least lower_squared by halving",
                format!("a smaller one on piece {piece}, or no end of halving"),
            ),
        }
    }
}

fn pieces_of(result: &Curve) -> Result<Pieces, Failure> {
    match Pieces::new(result) {
        Ok(pieces) => Ok(pieces),
        Err(piece) => fails("the same curve", format!("piece {piece} is a single point")),
    }
}
