//! Results by the operations of `curve`: de Boor's algorithm, Leibniz' rule, Böhm's knot insertion, blossoms.

use super::samples::{Sample, between, chosen};
use crate::check::values::pieces::Pieces;
use crate::claim::values::{Entry, Operation, Outcome, Side};
use crate::curve::{self, BSpline, Bezier, Curve, Form, MAXIMUM_BITS, MAXIMUM_DEGREE};
use crate::number::{Integer, Rational, RationalVector};

/// Orders of derivatives, from 1.
const ORDERS: usize = 3;

/// What an entry must be to stand in a certificate: numbers that are not too long.
fn short(numbers: &[Rational]) -> bool {
    numbers
        .iter()
        .all(|x| x.numer().bits().max(x.denom().bits()) <= MAXIMUM_BITS)
}

/// The point and the derivatives up to an order.
pub fn derivatives(curve: &Curve, parameter: &Rational, side: Side, order: usize) -> Option<Vec<Vec<Rational>>> {
    let one = Rational::from_integer(Integer::ONE);
    match curve.form() {
        Form::BSpline(spline) => {
            let side = match side {
                Side::Left => curve::Side::Before,
                Side::Right => curve::Side::After,
            };
            spline.derivatives(parameter, side, order).ok()
        }
        Form::Bezier(pieces) => {
            let floor = parameter.floor();
            let (mut i, mut u) = (floor.to_integer().to_u64()? as usize, parameter - floor);
            if side == Side::Left && u.numer().is_zero() {
                (i, u) = (i.checked_sub(1)?, one);
            }
            pieces.get(i)?.derivatives(&u, order).ok()
        }
    }
}

/// The entry `point`.
pub fn point(curve: &Curve, sample: &Sample) -> Option<Entry> {
    let parameter = sample.parameter.clone();
    let point = match curve.form() {
        Form::BSpline(spline) => spline.evaluate(&parameter).ok()?,
        Form::Bezier(_) => curve.chain().evaluate(&parameter).ok()?,
    };
    short(&point).then_some(Entry {
        operation: Operation::Point { parameter },
        outcome: Outcome::Point(point),
    })
}

/// The entries `derivative` of the first orders.
pub fn derivative_entries(curve: &Curve, sample: &Sample, side: Side) -> Vec<Entry> {
    let found = derivatives(curve, &sample.parameter, side, ORDERS).unwrap_or_default();
    let entries = found
        .into_iter()
        .enumerate()
        .skip(1)
        .filter(|(_, vector)| short(vector));
    entries
        .map(|(order, vector)| Entry {
            operation: Operation::Derivative {
                parameter: sample.parameter.clone(),
                order: order as u32,
                side,
            },
            outcome: Outcome::Vector(vector),
        })
        .collect()
}

fn dot(a: &[Rational], b: &[Rational]) -> Rational {
    let zero = Rational::from_integer(Integer::ZERO);
    a.iter().zip(b).fold(zero, |sum, (x, y)| sum + x * y)
}

/// c'×c'', with a third coordinate of 0 in the plane.
fn turn(a: &[Rational], b: &[Rational]) -> [Rational; 3] {
    let at = |v: &[Rational], i: usize| v.get(i).cloned().unwrap_or_default();
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| at(a, i) * at(b, j) - at(a, j) * at(b, i))
}

/// The entry `curvature`; nothing where c' = 0.
pub fn curvature(curve: &Curve, sample: &Sample, side: Side) -> Option<Entry> {
    let found = derivatives(curve, &sample.parameter, side, 2)?;
    let speed = dot(&found[1], &found[1]);
    if speed.numer().is_zero() {
        return None;
    }
    let turn = turn(&found[1], &found[2]);
    let squared = dot(&turn, &turn) / (&speed * &speed * &speed);
    short(std::slice::from_ref(&squared)).then(|| Entry {
        operation: Operation::Curvature {
            parameter: sample.parameter.clone(),
            side,
        },
        outcome: Outcome::ValueSquared(squared),
    })
}

/// The entry `torsion`; nothing where c'×c'' = 0.
pub fn torsion(curve: &Curve, sample: &Sample, side: Side) -> Option<Entry> {
    let found = derivatives(curve, &sample.parameter, side, 3)?;
    let turn = turn(&found[1], &found[2]);
    let squared = dot(&turn, &turn);
    if squared.numer().is_zero() {
        return None;
    }
    let value = dot(&turn, &found[3]) / squared;
    short(std::slice::from_ref(&value)).then(|| Entry {
        operation: Operation::Torsion {
            parameter: sample.parameter.clone(),
            side,
        },
        outcome: Outcome::Value(value),
    })
}

/// The curve as a B-spline: itself, or a single Bézier piece with the knots 0 and 1.
pub fn spline_of(curve: &Curve) -> Option<BSpline> {
    match curve.form() {
        Form::BSpline(spline) => Some(spline.clone()),
        Form::Bezier(pieces) => {
            let [piece] = pieces.as_slice() else {
                return None;
            };
            let ends = [Integer::ZERO, Integer::ONE].map(Rational::from_integer);
            let knots: Vec<Rational> = ends.into_iter().flat_map(|end| vec![end; piece.degree() + 1]).collect();
            BSpline::new(
                piece.dimension(),
                piece.degree(),
                RationalVector::from_rationals(&knots),
                piece.points().clone(),
                piece.weights().cloned(),
            )
            .ok()
        }
    }
}

/// A result as a curve, if its numbers are not too long.
fn valid(spline: BSpline) -> Option<Curve> {
    let (knots, points) = (spline.knots().clone(), spline.points().clone());
    let weights = spline.weights().cloned();
    BSpline::new(spline.dimension(), spline.degree(), knots, points, weights)
        .ok()
        .map(Curve::from)
}

/// Parameters for structural operations: one inside the first, the middle and the last of the chosen pieces.
fn inside(pieces: &Pieces) -> Vec<Rational> {
    let numbers = chosen(pieces.pieces.len());
    let mut three = vec![numbers[0], numbers[numbers.len() / 2], numbers[numbers.len() - 1]];
    three.dedup();
    let places = three.into_iter().zip([(1, 2), (1, 3), (3, 4)]);
    places
        .map(|(i, (p, q))| between(&pieces.ends[i], &pieces.ends[i + 1], p, q))
        .collect()
}

/// Some of the knots inside the domain, with their multiplicities.
fn knots_inside(spline: &BSpline, pieces: &Pieces) -> Vec<(Rational, usize)> {
    let numbers = chosen(pieces.pieces.len());
    let knots = numbers.into_iter().filter(|i| *i > 0).map(|i| pieces.ends[i].clone());
    knots.map(|knot| (knot.clone(), spline.multiplicity(&knot))).collect()
}

/// The entries `insert_knot`: once, twice and as often as possible inside pieces, and once at a knot.
pub fn insertions(spline: &BSpline, pieces: &Pieces) -> Vec<Entry> {
    let p = spline.degree();
    let fresh = inside(pieces).into_iter().zip([1, p, 2]);
    let known = knots_inside(spline, pieces);
    let known = known.into_iter().find(|(_, multiplicity)| *multiplicity < p);
    let wanted = fresh.chain(known.map(|(knot, _)| (knot, 1)));
    wanted
        .filter_map(|(parameter, times)| {
            let times = times.min(p);
            let result = spline.insert_knot(&parameter, times).ok().and_then(valid)?;
            let times = times as u32;
            Some(Entry {
                operation: Operation::InsertKnot { parameter, times },
                outcome: Outcome::Curve(Box::new(result)),
            })
        })
        .collect()
}

/// The entries `remove_knot`: of the first of the chosen knots that can be removed, as often as it can.
pub fn removals(spline: &BSpline, pieces: &Pieces) -> Vec<Entry> {
    let mut knots = knots_inside(spline, pieces).into_iter();
    let found = knots.find_map(|(knot, multiplicity)| {
        let times = (1..=multiplicity).take_while(|n| spline.remove_knot(&knot, *n).is_ok());
        times.last().map(|times| (knot, times))
    });
    let entry = found.and_then(|(parameter, times)| {
        let result = spline.remove_knot(&parameter, times).ok().and_then(valid)?;
        let times = times as u32;
        Some(Entry {
            operation: Operation::RemoveKnot { parameter, times },
            outcome: Outcome::Curve(Box::new(result)),
        })
    });
    entry.into_iter().collect()
}

/// The entries `elevate_degree`: by 1 and by 2.
pub fn elevations(spline: &BSpline) -> Vec<Entry> {
    let possible = (1..=2).filter(|times| spline.degree() + times <= MAXIMUM_DEGREE);
    possible
        .filter_map(|times| {
            let result = spline.elevate(times).ok().and_then(valid)?;
            let times = times as u32;
            Some(Entry {
                operation: Operation::ElevateDegree { times },
                outcome: Outcome::Curve(Box::new(result)),
            })
        })
        .collect()
}

/// The entries `split`: inside a piece, and at a knot.
pub fn splits(spline: &BSpline, pieces: &Pieces) -> Vec<Entry> {
    let mut parameters = inside(pieces);
    parameters.truncate(2);
    let known = knots_inside(spline, pieces);
    parameters.extend(known.get(known.len() / 2).map(|(knot, _)| knot.clone()));
    let entries = parameters.into_iter().filter_map(|parameter| {
        let (before, behind) = spline.split(&parameter).ok()?;
        let curves = Box::new([valid(before)?, valid(behind)?]);
        Some(Entry {
            operation: Operation::Split { parameter },
            outcome: Outcome::Curves(curves),
        })
    });
    entries.collect()
}

/// The entry `decompose`.
pub fn decomposition(curve: &Curve) -> Option<Entry> {
    let chain = curve.chain();
    let pieces: Option<Vec<Bezier>> = chain
        .pieces()
        .iter()
        .map(|piece| Bezier::new(piece.dimension(), piece.points().clone(), piece.weights().cloned()).ok())
        .collect();
    let result = Curve::new(curve.dimension(), Form::Bezier(pieces?)).ok()?;
    Some(Entry {
        operation: Operation::Decompose,
        outcome: Outcome::Curve(Box::new(result)),
    })
}
