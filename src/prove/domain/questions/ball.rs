//! The largest ball in cl K ∩ B.
//!
//! For the rows found so far the center x and the radius r of the largest ball solve a linear program: row(x) − r·|A| ≥ 0, the lengths rounded down. The plane that cuts the ball most gives the
//! next row.

use num_traits::{Signed, Zero};

use super::distance::{Distances, show_ball};
use super::rounding::{bits_for, difference, down, offset, up};
use super::{AnswerError, Finding, close, rows_at, sides};
use crate::check::domain::Context;
use crate::check::polynomial::Bound;
use crate::claim::domain::{Evidence, Outcome, Row};
use crate::number::{Integer, Rational, RationalExt, RationalVector};
use crate::prove::domain::Options;
use crate::prove::linear_program::{self, Solution, maximise};

/// How often the radius of the shown ball is reduced, each time eight times as much.
const SHRINKS: i32 = 12;

/// A row of the evidence, and as one of the linear program: (2^shift·A, −length)·(x, r) + 2^shift·b, up to a factor.
struct Cut {
    row: Row,
    scale: Rational,
    shift: u32,
    program: linear_program::Row,
}

/// A ball that is shown.
struct Ball {
    center: Vec<Rational>,
    radius: Rational,
}

/// Finds the bounds of the radius; `inside` is a point of K inside the box.
pub fn find(context: &Context, inside: &[Rational], options: &Options) -> Result<Finding, AnswerError> {
    let d = context.dimension;
    let bits = bits_for(&options.tolerance);
    let distances = Distances::new(context, inside);
    let mut objective = vec![Integer::ZERO; d];
    objective.push(Integer::ONE);
    let mut cuts: Vec<Cut> = sides(context).filter_map(|row| Cut::new(context, row, bits)).collect();
    let mut best: Option<Ball> = None;
    loop {
        let program: Vec<linear_program::Row> = cuts.iter().map(|cut| cut.program.clone()).collect();
        let solution = maximise(&objective, &program, options.solver);
        let Ok(Solution::Optimal {
            point,
            value,
            basis,
            multipliers,
        }) = solution
        else {
            return Err(AnswerError::Unsolved(
                "the linear program of the largest ball has no solution".into(),
            ));
        };
        let upper = up(&value, bits);
        let arm = difference(&point[..d], inside);
        let plane = distances.nearest(&arm);
        // Parameters whose planes cut the ball.
        let mut worst: Vec<(usize, f64)> = Vec::new();
        let radius = value.to_f64();
        let found = plane.map_or(f64::INFINITY, |plane| plane.distance);
        if let Some(plane) = plane.filter(|plane| plane.distance < radius) {
            worst.push((plane.section, plane.at));
        }
        let least = best.as_ref().map_or(0.0, |ball| ball.radius.to_f64());
        if found.min(radius) > least {
            match shrunk(context, inside, &arm, found.min(radius), &options.tolerance, bits) {
                Ok(ball) if best.as_ref().is_none_or(|old| old.radius < ball.radius) => best = Some(ball),
                Ok(_) => {}
                Err(nearer) => worst.extend(nearer.and_then(|(section, at)| {
                    let plane = distances.nearest_around(&arm, section, at)?;
                    Some((plane.section, plane.at))
                })),
            }
        }
        let done = best
            .as_ref()
            .is_some_and(|ball| close(&ball.radius, &upper, &options.tolerance));
        if !done && cuts.len() < options.budget.max(2 * d + 1) {
            let new = worst
                .iter()
                .find_map(|(section, at)| excluding(context, *section, *at, &point, bits));
            if let Some(cut) = new {
                cuts.push(cut);
                continue;
            }
        }
        let ball = best.ok_or_else(|| AnswerError::Unsolved("no ball in the domain was shown".into()))?;
        return Ok(finding(ball, upper, &cuts, &basis, &multipliers, &options.tolerance));
    }
}

fn finding(
    ball: Ball,
    upper: Rational,
    cuts: &[Cut],
    basis: &[usize],
    multipliers: &[Rational],
    tolerance: &Rational,
) -> Finding {
    let used = || {
        basis
            .iter()
            .zip(multipliers)
            .filter(|(_, multiplier)| multiplier.is_positive())
    };
    let multiplier = |(cut, multiplier): (&usize, &Rational)| {
        let cut = &cuts[*cut];
        multiplier * Rational::from_integer(Integer::ONE << cut.shift) / &cut.scale
    };
    let close = close(&ball.radius, &upper, tolerance);
    let evidence = Evidence::Ball {
        center: ball.center,
        rows: used().map(|(cut, _)| cuts[*cut].row.clone()).collect(),
        multipliers: used().map(multiplier).collect(),
        lengths: used().map(|(cut, _)| cuts[*cut].length()).collect(),
    };
    Finding {
        outcome: Outcome::Ball {
            lower: ball.radius,
            upper,
        },
        evidence,
        close,
    }
}

/// The ball around the program's point, rounded, with nearly the radius estimated, as far as it can be shown.
///
/// # Errors
/// Where a plane cuts it, if known.
fn shrunk(
    context: &Context,
    inside: &[Rational],
    arm: &[f64],
    estimate: f64,
    tolerance: &Rational,
    bits: u32,
) -> Result<Ball, Option<(usize, f64)>> {
    let mut share = (tolerance.to_f64() / 16.0).max(1e-15);
    let mut nearer = None;
    for _ in 0..SHRINKS {
        if share >= 0.5 {
            break;
        }
        let center = offset(inside, arm, estimate * share / 4.0).ok_or(None)?;
        let radius = Rational::from_f64(estimate * (1.0 - share)).ok_or(None)?;
        let radius = down(&within_box(context, &center, radius), bits);
        if radius.is_positive() && is_inside(context, &center) {
            match show_ball(context, &center, &(&radius * &radius)) {
                Ok(()) => return Ok(Ball { center, radius }),
                Err(at) => nearer = nearer.or(at),
            }
        }
        share *= 8.0;
    }
    Err(nearer)
}

/// The radius, or the distance to the nearest side if that is less.
fn within_box(context: &Context, center: &[Rational], radius: Rational) -> Rational {
    let bounds = &context.domain.bounds;
    let sides =
        (0..center.len()).flat_map(|axis| [&center[axis] - &bounds.low[axis], &bounds.high[axis] - &center[axis]]);
    sides.fold(radius, std::cmp::min)
}

fn is_inside(context: &Context, point: &[Rational]) -> bool {
    let integers = RationalVector::from_rationals(point);
    context
        .show(integers.numerators(), integers.denominator(), Bound::Positive)
        .is_ok()
}

/// A row at about the parameter that excludes the program's point.
fn excluding(context: &Context, section: usize, at: f64, point: &[Rational], bits: u32) -> Option<Cut> {
    let excludes = |cut: &Cut| {
        let terms = cut.program.normal.iter().zip(point);
        let constant = Rational::from_integer(cut.program.constant.clone());
        let sum = terms.fold(constant, |sum, (a, x)| sum + x * Rational::from_integer(a.clone()));
        sum.is_negative()
    };
    rows_at(&context.sections[section], at)
        .filter_map(|row| Cut::new(context, row, bits))
        .find(excludes)
}

impl Cut {
    /// `None` for a row that does not depend on x.
    fn new(context: &Context, row: Row, bits: u32) -> Option<Cut> {
        let exact = context.row(&row)?;
        let squared: Integer = exact.affine.linear.iter().map(|a| a * a).sum();
        if squared.is_zero() {
            return None;
        }
        // As many bits of the length as the tolerance asks for.
        let shift = u32::try_from((u64::from(bits) + 4).saturating_sub(squared.bits() / 2)).unwrap_or(0);
        let length = (squared << (2 * shift)).sqrt_floor()?;
        let mut normal: Vec<Integer> = exact.affine.linear.iter().map(|a| a << shift).collect();
        normal.push(-length);
        Some(Cut {
            row,
            scale: exact.scale,
            shift,
            program: linear_program::Row {
                normal,
                constant: exact.affine.constant << shift,
            },
        })
    }

    /// At most the length of the row's normal.
    fn length(&self) -> Rational {
        let length = self
            .program
            .normal
            .last()
            .map_or_else(Rational::zero, |last| Rational::from_integer(-last));
        length / Rational::from_integer(Integer::ONE << self.shift) * &self.scale
    }
}
