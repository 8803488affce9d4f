//! From what a user asks to the set K ∩ B that a certificate speaks of.

use std::fmt;

use crate::check::domain::Context;
use crate::check::domain::sign::{DomainError, sections};
use crate::check::polynomial::Bound;
use crate::claim::domain::{Box, Domain, Sign};
use crate::curve::{BSpline, Chain, Curve, Form};
use crate::number::{Rational, RationalExt, RationalVector};

/// Which domain is asked for.
#[derive(Clone, Debug)]
pub struct Question {
    /// The free control point, from 0: of a B-spline in the order of its points; of Bézier pieces with each joint counted once.
    pub point: usize,
    /// The sign; `None` is that which the curve has.
    pub sign: Option<Sign>,
    /// A part of the curve in its own parameter (knots, or piece numbers for Bézier pieces); `None` is the whole curve.
    pub interval: Option<[Rational; 2]>,
    /// The box.
    pub bounds: Bounds,
}

/// The box of a question.
#[derive(Clone, Debug)]
pub enum Bounds {
    /// A square or cube of this edge length centred at the control point.
    Edge(Rational),
    /// Its two corners.
    Corners(Box),
}

/// Why a question has no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum QuestionError {
    /// There is no such control point.
    Point {
        /// The index asked for.
        found: usize,
        /// How many there are.
        count: usize,
    },
    /// The box's edge is not positive, or a lower corner not below the upper one.
    Box,
    /// A corner of the box has another number of coordinates than the curve.
    Dimension {
        /// How many coordinates a corner has.
        found: usize,
        /// How many the curve has.
        expected: usize,
    },
    /// The control point is not in the box.
    Excluded,
    /// The interval is empty, reversed or not in the curve's parameter range.
    Interval {
        /// The range, as texts.
        range: [String; 2],
    },
    /// A piece of too low a degree has no curvature or torsion.
    Degree {
        /// The piece.
        piece: usize,
        /// Its degree.
        degree: usize,
        /// The least degree.
        least: usize,
    },
    /// The curve has both signs, or a zero, so that one must be chosen.
    Sign,
}

impl fmt::Display for QuestionError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            QuestionError::Point { found, count } => {
                write!(f, "there is no control point {found}: the curve's points are 0 to {}", count - 1)
            }
            QuestionError::Box => f.write_str("the box is empty: expected a positive edge, or lower corners below upper ones"),
            QuestionError::Dimension { found, expected } => {
                write!(f, "a corner of the box has {found} coordinates, the curve has {expected}")
            }
            QuestionError::Excluded => f.write_str("the box does not contain the control point"),
            QuestionError::Interval { range: [from, to] } => {
                write!(f, "the interval is not a part of the curve's parameter range, {from} to {to}")
            }
            QuestionError::Degree { piece, degree, least } => {
                let quantity = if *least == 2 { "curvature" } else { "torsion" };
                write!(f, "piece {piece} of degree {degree} has no {quantity}: expected degree {least} at least, or an interval without it")
            }
            QuestionError::Sign => f.write_str(
                "the curve, as it is, has not one sign on the interval (both signs, or a zero): choose the sign that it is to have",
            ),
        }
    }
}

impl std::error::Error for QuestionError {}

/// A question in the terms of a certificate.
#[derive(Clone, Debug)]
pub struct Problem {
    /// The set.
    pub domain: Domain,
    /// Where the control point is.
    pub position: Vec<Rational>,
    /// Is the position in K?
    pub has_sign: bool,
}

impl Problem {
    /// Finds the points that move together, the interval in the chain's parameter, the ends to be left open, the sign and the box.
    ///
    /// An end of the interval at which the sign function vanishes wherever the control point is, such as the end of a curve that begins with three fixed
    /// collinear points, is left open: otherwise K would be empty.
    ///
    /// # Errors
    /// [`QuestionError`].
    pub fn new(curve: &Curve, question: &Question) -> Result<Problem, QuestionError> {
        let (points, position) = moving_points(curve, question.point)?;
        let bounds = bounds(&question.bounds, &position)?;
        let chain = curve.chain();
        let interval = interval(&chain, question.interval.as_ref())?;
        let mut domain = Domain {
            points,
            sign: Sign::Positive,
            interval,
            open: [false; 2],
            bounds,
        };
        let closed = sections(curve, &domain).map_err(internal)?;
        let least = curve.dimension();
        for section in &closed {
            let degree = chain.pieces()[section.piece].degree();
            if degree < least {
                let piece = section.piece;
                return Err(QuestionError::Degree { piece, degree, least });
            }
        }
        let vanishes = |end: Option<&crate::check::domain::sign::Affine>| end.is_some_and(|end| end.is_zero());
        domain.open = [
            vanishes(closed.first().and_then(|section| section.coefficients.first())),
            vanishes(closed.last().and_then(|section| section.coefficients.last())),
        ];
        let at = RationalVector::from_rationals(&position);
        let mut has = |sign: Sign| -> Result<bool, QuestionError> {
            domain.sign = sign;
            let context = Context::new(curve, &domain).map_err(internal)?;
            Ok(context.show(at.numerators(), at.denominator(), Bound::Positive).is_ok())
        };
        let has_sign = match question.sign {
            Some(sign) => has(sign)?,
            None if has(Sign::Positive)? => true,
            None if has(Sign::Negative)? => true,
            None => return Err(QuestionError::Sign),
        };
        Ok(Problem {
            domain,
            position,
            has_sign,
        })
    }
}

/// What `moving_points`, `bounds` and `interval` return makes a domain.
fn internal(error: DomainError) -> QuestionError {
    match error {
        DomainError::Box(_) => QuestionError::Box,
        _ => unreachable!("points and interval were taken from the curve: {error}"),
    }
}

/// The control points that move together with one, and where they are.
///
/// Of a joint of Bézier pieces both copies move; where a curve is closed at a control point, or continues periodically, its other copy moves too.
///
/// # Errors
/// [`QuestionError::Point`].
pub fn moving_points(curve: &Curve, point: usize) -> Result<(Vec<usize>, Vec<Rational>), QuestionError> {
    let d = curve.dimension();
    match curve.form() {
        Form::BSpline(spline) => {
            let count = spline.count();
            if point >= count {
                return Err(QuestionError::Point { found: point, count });
            }
            let position = (0..d).map(|axis| spline.points().get(point * d + axis)).collect();
            let mut points = vec![point];
            if let Some(period) = period(spline) {
                points.extend((point % period..count).step_by(period).filter(|copy| *copy != point));
            }
            points.sort_unstable();
            Ok((points, position))
        }
        Form::Bezier(pieces) => {
            // Flat indices of the copies of each distinct point.
            let mut copies: Vec<Vec<usize>> = Vec::new();
            let mut flat = 0;
            for (i, piece) in pieces.iter().enumerate() {
                for k in 0..=piece.degree() {
                    match copies.last_mut() {
                        Some(joint) if k == 0 && i > 0 => joint.push(flat),
                        _ => copies.push(vec![flat]),
                    }
                    flat += 1;
                }
            }
            if curve.is_closed()
                && copies.len() > 1
                && let Some(end) = copies.pop()
            {
                copies[0].extend(end);
            }
            let count = copies.len();
            let Some(points) = copies.into_iter().nth(point) else {
                return Err(QuestionError::Point { found: point, count });
            };
            let mut first = points[0];
            let holder = pieces.iter().find(|piece| {
                let inside = first <= piece.degree();
                if !inside {
                    first -= piece.degree() + 1;
                }
                inside
            });
            let position = holder.map_or_else(Vec::new, |piece| piece.point(first));
            Ok((points, position))
        }
    }
}

/// After how many control points a B-spline repeats: a closed clamped one after all but the last, a periodic one after all but the degree.
fn period(spline: &BSpline) -> Option<usize> {
    let (d, count, p) = (spline.dimension(), spline.count(), spline.degree());
    let same = |a: usize, b: usize| {
        let point = |k: usize| (0..d).map(move |axis| spline.points().get(k * d + axis));
        let weight = |k: usize| spline.weights().map(|weights| weights.get(k));
        point(a).eq(point(b)) && weight(a) == weight(b)
    };
    let knots = spline.knots().numerators();
    let clamped = knots[0] == knots[p] && knots[count] == knots[count + p];
    if clamped {
        return (count > 2 && same(0, count - 1)).then_some(count - 1);
    }
    let period = count.checked_sub(p).filter(|period| *period > 0)?;
    let difference = |i: usize| &knots[i + period] - &knots[i];
    let periodic = (1..=2 * p).all(|i| difference(i) == difference(0)) && (0..p).all(|k| same(k, k + period));
    periodic.then_some(period)
}

fn bounds(bounds: &Bounds, position: &[Rational]) -> Result<Box, QuestionError> {
    let found = match bounds {
        Bounds::Edge(edge) => {
            let half = edge / Rational::from_integer(2.into());
            Box {
                low: position.iter().map(|x| x - &half).collect(),
                high: position.iter().map(|x| x + &half).collect(),
            }
        }
        Bounds::Corners(corners) => corners.clone(),
    };
    for corner in [&found.low, &found.high] {
        if corner.len() != position.len() {
            return Err(QuestionError::Dimension {
                found: corner.len(),
                expected: position.len(),
            });
        }
    }
    if found.low.iter().zip(&found.high).any(|(low, high)| low >= high) {
        return Err(QuestionError::Box);
    }
    let inside =
        (0..position.len()).all(|axis| found.low[axis] <= position[axis] && position[axis] <= found.high[axis]);
    if inside {
        Ok(found)
    } else {
        Err(QuestionError::Excluded)
    }
}

fn interval(chain: &Chain, interval: Option<&[Rational; 2]>) -> Result<[Rational; 2], QuestionError> {
    let ends = [0, chain.count()].map(|end| Rational::from_integer(end.into()));
    let Some([from, to]) = interval else {
        return Ok(ends);
    };
    let refuse = || QuestionError::Interval {
        range: ends
            .each_ref()
            .map(|end| chain.knot_at(end).map_or_else(String::new, |knot| knot.format())),
    };
    match (chain.parameter_at(from), chain.parameter_at(to)) {
        (Some(from), Some(to)) if from < to => Ok([from, to]),
        _ => Err(refuse()),
    }
}
