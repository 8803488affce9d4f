//! The point of cl K ∩ B nearest to a target.

use num_traits::{Signed, Zero};

use super::distance::Distances;
use super::projection::Projection;
use super::rounding::{bits_for, difference, down, length, offset, up};
use super::{AnswerError, Finding, close, rows_at, sides};
use crate::check::domain::Context;
use crate::check::polynomial::Bound;
use crate::claim::domain::{Evidence, Outcome, Row, Target};
use crate::number::{Integer, Rational, RationalExt, RationalVector};
use crate::prove::domain::Options;
use crate::prove::domain::parts::{Hit, Parts};

/// How often a point is pulled in further, each time eight times as far, until it is shown in cl K.
const PULLS: i32 = 18;
/// The least pull, as a part of the distance to the center.
const LEAST_PULL: f64 = 1e-15;
/// Relative accuracy of the parameters at which rays leave K.
const HIT_TOLERANCE: f64 = 1e-15;

/// The search.
struct Search<'a> {
    context: &'a Context<'a>,
    center: &'a [Rational],
    target: &'a [Rational],
    parts: Parts,
    /// Roughly the distance from the center to the nearest plane.
    clearance: f64,
    projection: Projection,
    rows: Vec<Row>,
}

/// Finds the bounds of the distance.
pub fn find(
    context: &Context,
    center: &[Rational],
    to: Target,
    target: &[Rational],
    options: &Options,
) -> Result<Finding, AnswerError> {
    let finding = |[lower_squared, upper_squared]: [Rational; 2], evidence, close| Finding {
        outcome: Outcome::Nearest {
            to: to.clone(),
            lower_squared,
            upper_squared,
        },
        evidence,
        close,
    };
    if shown(context, target, Bound::NonNegative) {
        let evidence = Evidence::Nearest {
            center: center.to_vec(),
            point: target.to_vec(),
            base: target.to_vec(),
            rows: Vec::new(),
            multipliers: Vec::new(),
        };
        return Ok(finding([Rational::zero(), Rational::zero()], evidence, true));
    }
    let integers = RationalVector::from_rationals(center);
    let parts = Parts::new(context, integers.numerators(), integers.denominator()).ok_or(AnswerError::NoPoint)?;
    let nearest_plane = Distances::new(context, center).nearest(&vec![0.0; center.len()]);
    let mut search = Search {
        context,
        center,
        target,
        parts,
        clearance: nearest_plane.map_or(f64::INFINITY, |plane| plane.distance),
        projection: Projection::new(target),
        rows: Vec::new(),
    };
    let bits = bits_for(&options.tolerance);
    let enough = search.negligible(&options.tolerance);
    for side in sides(context) {
        search.add(side);
    }
    let mut best: Option<(Rational, Vec<Rational>)> = None;
    loop {
        search
            .projection
            .solve()
            .ok_or_else(|| unsolved("the rows contradict each other"))?;
        let base = search.projection.point();
        let arm = difference(&base, center);
        let hit = search.parts.hit(&arm, HIT_TOLERANCE);
        let lower = down(&squared(&base, target), bits);
        // Only a point that could be close enough is worth the exact test.
        let promising = best.is_none() || hit.ratio <= 1.0 + 4.0 * options.tolerance.to_f64().sqrt();
        if promising && let Some(point) = search.pulled(&arm, &hit, &options.tolerance) {
            let upper = up(&squared(&point, target), bits);
            if best.as_ref().is_none_or(|(least, _)| upper < *least) {
                best = Some((upper, point));
            }
        }
        let done = best
            .as_ref()
            .is_some_and(|(upper, _)| close(&lower, upper, &options.tolerance) || *upper <= enough);
        if !done && search.rows.len() < options.budget.max(2 * context.dimension + 1) && search.cut(&hit) {
            continue;
        }
        let (upper, point) = best.ok_or_else(|| unsolved("no point of the domain's closure was shown"))?;
        let (base, rows, multipliers, lower) = search.evidence(bits);
        let close = close(&lower, &upper, &options.tolerance) || upper <= enough;
        let evidence = Evidence::Nearest {
            center: center.to_vec(),
            point,
            base,
            rows,
            multipliers,
        };
        return Ok(finding([lower, upper], evidence, close));
    }
}

fn unsolved(why: &str) -> AnswerError {
    AnswerError::Unsolved(why.into())
}

fn squared(a: &[Rational], b: &[Rational]) -> Rational {
    let squares = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y));
    squares.fold(Rational::zero(), |sum, square| sum + square)
}

/// Is a point in the box and shown in K or cl K?
fn shown(context: &Context, point: &[Rational], bound: Bound) -> bool {
    let integers = RationalVector::from_rationals(point);
    let (numerators, denominator) = (integers.numerators(), integers.denominator());
    context.in_box(numerators, denominator) && context.show(numerators, denominator, bound).is_ok()
}

impl Search<'_> {
    /// The square of a distance that is next to nothing: of `tolerance` times the box's longest edge.
    fn negligible(&self, tolerance: &Rational) -> Rational {
        let bounds = &self.context.domain.bounds;
        let edges = bounds.high.iter().zip(&bounds.low).map(|(high, low)| high - low);
        let longest = edges.max().unwrap_or_else(Rational::zero) * tolerance;
        &longest * &longest
    }

    /// Adds a row that depends on x.
    fn add(&mut self, row: Row) -> bool {
        match self.context.row(&row) {
            Some(exact) if exact.affine.linear.iter().any(|a| !a.is_zero()) => {
                self.projection.add(exact.affine);
                self.rows.push(row);
                true
            }
            _ => false,
        }
    }

    /// Adds the row at the parameter where the ray to the base leaves K; false if it does not exclude the base.
    fn cut(&mut self, hit: &Hit) -> bool {
        if hit.ratio <= 1.0 {
            return false;
        }
        let section = &self.context.sections[hit.section];
        for row in rows_at(section, hit.at) {
            let excludes = |row: &Row| {
                let exact = self.context.row(row);
                exact.is_some_and(|exact| self.projection.violates(&exact.affine))
            };
            if excludes(&row) {
                return self.add(row);
            }
        }
        false
    }

    /// The base pulled towards the center until it is shown in cl K and in the box.
    fn pulled(&self, arm: &[f64], hit: &Hit, tolerance: &Rational) -> Option<Vec<Rational>> {
        let reach = length(arm);
        let distance = squared(&self.projection.point(), self.target).to_f64().sqrt();
        let first = (distance / reach * tolerance.to_f64() / 32.0).clamp(LEAST_PULL, 1e-3);
        let boundary = hit.ratio.max(1.0);
        (0..PULLS).find_map(|k| {
            let pull = first * 8f64.powi(k);
            if pull >= 1.0 {
                return None;
            }
            let pulled: Vec<f64> = arm.iter().map(|x| x * (1.0 - pull) / boundary).collect();
            // A pull by some part takes the point that part of the clearance away from each plane.
            let mut point = offset(self.center, &pulled, reach.min(self.clearance) * pull / 32.0)?;
            let bounds = &self.context.domain.bounds;
            for (axis, x) in point.iter_mut().enumerate() {
                *x = (&*x).clamp(&bounds.low[axis], &bounds.high[axis]).clone();
            }
            shown(self.context, &point, Bound::NonNegative).then_some(point)
        })
    }

    /// Base, rows, multipliers and lower bound, the multipliers rounded: the bound is stationary in them.
    fn evidence(&self, bits: u32) -> (Vec<Rational>, Vec<Row>, Vec<Rational>, Rational) {
        let mut base = self.target.to_vec();
        let (mut rows, mut multipliers, mut exacts) = (Vec::new(), Vec::new(), Vec::new());
        for (number, multiplier) in self.projection.active() {
            let row = &self.rows[number];
            let Some(exact) = self.context.row(row).filter(|_| multiplier.is_positive()) else {
                continue;
            };
            let multiplier = down(&(multiplier / &exact.scale), bits);
            let factor = &multiplier * &exact.scale;
            for (x, a) in base.iter_mut().zip(&exact.affine.linear) {
                *x += &factor * Rational::from_integer(a.clone());
            }
            rows.push(row.clone());
            multipliers.push(multiplier);
            exacts.push((exact.affine, factor));
        }
        let integers = RationalVector::from_rationals(&base);
        let mut bound = squared(&base, self.target);
        for (affine, factor) in exacts {
            let value = affine.at(integers.numerators(), integers.denominator());
            bound -= Rational::new(value, integers.denominator().clone())
                * factor
                * Rational::from_integer(Integer::from(2));
        }
        if bound.is_negative() {
            return (self.target.to_vec(), Vec::new(), Vec::new(), Rational::zero());
        }
        let lower = down(&bound, bits);
        (base, rows, multipliers, lower)
    }
}
