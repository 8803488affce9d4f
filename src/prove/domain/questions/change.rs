//! The shortest move that changes the sign.

use num_traits::Zero;

use super::distance::{Distances, Plane, show_ball};
use super::rounding::{bits_for, down, up};
use super::{AnswerError, Finding, close, rows_at};
use crate::check::domain::Context;
use crate::claim::domain::{Evidence, Outcome, Row};
use crate::number::{Integer, Rational, RationalExt, RationalVector};
use crate::prove::domain::Options;

/// How often a nearer plane is looked for.
const ATTEMPTS: usize = 40;
/// By how much the lower bound is lowered at last, as parts of the upper one.
const LAST_GAPS: i32 = 40;

/// Finds the bounds of the distance from `position`, a point of K, to the complement of K.
pub fn find(context: &Context, position: &[Rational], options: &Options) -> Result<Finding, AnswerError> {
    let distances = Distances::new(context, position);
    let here = vec![0.0; position.len()];
    let first = distances.nearest(&here);
    let Some(mut plane) = first.filter(|plane| plane.distance.is_finite()) else {
        return Err(AnswerError::Constant);
    };
    let bits = bits_for(&options.tolerance);
    let mut best: Option<(Rational, Row)> = None;
    let two = Rational::from_integer(Integer::from(2));
    let gap = &options.tolerance / &two;
    for _ in 0..ATTEMPTS {
        let found = nearest_row(context, position, &plane);
        let improved = found.filter(|(square, _)| best.as_ref().is_none_or(|(least, _)| square < least));
        let Some((square, row)) = improved else { break };
        best = Some((square.clone(), row));
        let lower = down(&(&square - &square * &gap), bits);
        match show_ball(context, position, &lower) {
            // A nearer plane.
            Err(Some((section, at))) => {
                let Some(nearer) = distances.nearest_around(&here, section, at) else {
                    break;
                };
                plane = nearer;
            }
            _ => break,
        }
    }
    let (square, row) = best.ok_or(AnswerError::Constant)?;
    let upper_squared = up(&square, bits);
    // The first of them is the one that was just shown, if it was.
    let mut gap = gap;
    let mut lower_squared = Rational::zero();
    for _ in 0..LAST_GAPS {
        let lower = down(&(&square - &square * &gap), bits);
        if show_ball(context, position, &lower).is_ok() {
            lower_squared = lower;
            break;
        }
        gap = gap * &two * &two;
        if gap > Rational::from_integer(Integer::ONE) {
            break;
        }
    }
    let close = close(&lower_squared, &upper_squared, &options.tolerance);
    Ok(Finding {
        outcome: Outcome::Change {
            from: position.to_vec(),
            lower_squared,
            upper_squared,
        },
        evidence: Evidence::Change { row },
        close,
    })
}

/// The squared distance to the plane of a short parameter near the one found, exactly: the least of several roundings, a much shorter one if it is nearly as good.
fn nearest_row(context: &Context, position: &[Rational], plane: &Plane) -> Option<(Rational, Row)> {
    let integers = RationalVector::from_rationals(position);
    let section = context.sections.get(plane.section)?;
    let rows = rows_at(section, plane.at).filter_map(|row| {
        let affine = context.row(&row)?.affine;
        let normal: Integer = affine.linear.iter().map(|a| a * a).sum();
        if normal.is_zero() {
            return None;
        }
        let over = integers.denominator();
        let value = affine.at(integers.numerators(), over);
        Some((Rational::new(&value * &value, normal * over * over), row))
    });
    let rows: Vec<(Rational, Row)> = rows.collect();
    let least = rows
        .iter()
        .map(|(square, _)| square.to_f64())
        .fold(f64::INFINITY, f64::min);
    let nearly = |(square, _): &(Rational, Row)| square.to_f64() <= least * (1.0 + 1e-15);
    rows.into_iter().find(nearly)
}
