//! The distance of a point from the curve.

use super::float_curve::{FloatCurve, Place, Vector, squared};
use super::{Bracket, Width, exact_parameter};
use crate::check::polynomial::NotShown;
use crate::check::values::nearest::{show_lower, squared_distance};
use crate::check::values::pieces::Pieces;
use crate::claim::values::Witness;
use crate::number::{Integer, Rational, RationalExt};
use crate::prove::deviation::{rounded_down, rounded_up};

/// Samples of the curve.
const SAMPLES: usize = 4096;
/// Samples that are followed to a minimum.
const FOLLOWED: usize = 8;
/// How often a smaller distance is looked for, or a weaker bound tried.
const ATTEMPTS: usize = 24;

/// A point of the curve and its exact squared distance.
struct Found {
    squared: Rational,
    parameter: Rational,
}

/// An interval for the squared distance of a point, and its witness.
pub fn nearest(pieces: &Pieces, float: &FloatCurve, target: &[Rational], width: &Width) -> (Bracket, Witness) {
    let mut q: Vector = [0.0; 3];
    for (axis, x) in target.iter().enumerate() {
        q[axis] = x.to_f64();
    }
    let exact = |place: Place| {
        let parameter = exact_parameter(pieces, place);
        let point = pieces.point(&parameter).ok()?;
        Some(Found {
            squared: squared_distance(&point, target),
            parameter,
        })
    };
    let mut samples: Vec<(f64, Place)> = float
        .samples(SAMPLES)
        .into_iter()
        .map(|place| (squared(&float.point(place), &q), place))
        .collect();
    samples.sort_by(|a, b| a.0.total_cmp(&b.0));
    let followed = samples
        .iter()
        .take(FOLLOWED)
        .flat_map(|(_, place)| [*place, float.nearest(&q, *place).1]);
    let ends = [(0, 0.0), (pieces.pieces.len() - 1, 1.0)];
    let mut best = followed
        .chain(ends)
        .filter_map(exact)
        .min_by(|a, b| a.squared.cmp(&b.squared))
        .expect("the ends of a curve are points of it");
    let zero = Rational::from_integer(Integer::ZERO);
    // First the exact distance, where it is a short number; then less and less of it.
    let mut share = Some(zero.clone()).filter(|_| best.squared.denom().bits() <= 80);
    let mut next = &width.relative / Rational::from_integer(Integer::from(2));
    for _ in 0..ATTEMPTS {
        let share_now = share.clone().unwrap_or_else(|| next.clone());
        let one = Rational::from_integer(Integer::ONE);
        let lower = rounded_down(&(&best.squared * (&one - &share_now)));
        let closer = match show_lower(pieces, target, &lower) {
            Ok(()) => {
                let upper = rounded_up(&best.squared);
                let witness = Witness::Nearest {
                    parameter: best.parameter,
                };
                return (Bracket { lower, upper }, witness);
            }
            Err((piece, NotShown::At { numerator, halvings })) => {
                let u = numerator as f64 / 2f64.powi(halvings as i32);
                [(piece, u), float.nearest(&q, (piece, u)).1]
                    .into_iter()
                    .filter_map(exact)
                    .min_by(|a, b| a.squared.cmp(&b.squared))
                    .filter(|found| found.squared < best.squared)
            }
            Err((_, NotShown::Limits)) => None,
        };
        match closer {
            Some(found) => best = found,
            None if share.is_some() => share = None,
            None => next = (next * Rational::from_integer(Integer::from(64))).min(one),
        }
        if width.is_negligible(&best.squared) {
            break;
        }
    }
    let upper = rounded_up(&best.squared);
    let witness = Witness::Nearest {
        parameter: best.parameter,
    };
    (Bracket { lower: zero, upper }, witness)
}
