//! Curves with a knot that is exactly removable.

use num_traits::Zero;

use super::curves::{Wanted, curve};
use super::random::Random;
use super::representing;
use crate::curve::BSpline;
use crate::engine::{FloatCurve, Operation};
use crate::number::{Rational, RationalExt, RationalVector};

const BASE: Wanted = Wanted {
    dimension: None,
    bezier: 40,
    rational: 0,
    degree: 9,
    spans: 3,
    wild: false,
};

/// A curve in binary64 with a knot that was inserted exactly, and the removal of it.
pub(super) fn case(random: &mut Random) -> (FloatCurve, Operation) {
    for _ in 0..16 {
        if let Some(case) = attempt(random) {
            return case;
        }
    }
    // Halving a parabola of integers needs quarters only.
    let parabola = FloatCurve {
        degree: 2,
        knots: vec![0.0, 0.0, 0.0, 0.5, 1.0, 1.0, 1.0],
        points: vec![vec![0.0, 0.0], vec![0.5, 1.0], vec![1.5, 1.0], vec![2.0, 0.0]],
        weights: None,
    };
    let operation = Operation::RemoveKnot {
        parameter: 0.5,
        times: 1,
    };
    (parabola, operation)
}

fn attempt(random: &mut Random) -> Option<(FloatCurve, Operation)> {
    let curve = curve(random, BASE);
    let domain = &curve.knots[curve.degree..curve.knots.len() - curve.degree];
    let (start, end) = (domain[0], domain[domain.len() - 1]);
    let parameter = if random.chance(30) {
        domain[random.below(domain.len())]
    } else {
        start + (end - start) * random.whole(1, 3) as f64 / 4.0
    };
    let present = curve.knots.iter().filter(|t| **t == parameter).count();
    if parameter <= start || parameter >= end || present >= curve.degree {
        return None;
    }
    let times = 1 + random.below(curve.degree - present);
    let inserted = curve
        .exact()
        .ok()?
        .insert_knot(&Rational::from_f64(parameter)?, times)
        .ok()?;
    let curve = representing(&whole(&inserted)?)?;
    Some((curve, Operation::RemoveKnot { parameter, times }))
}

/// The same curve, enlarged until its coordinates are integers where they would not fit binary64.
fn whole(spline: &BSpline) -> Option<BSpline> {
    let denominator = spline.points().denominator();
    if denominator.is_power_of_two() {
        return Some(spline.clone());
    }
    let numerators = spline.points().numerators().iter().cloned().map(Rational::from_integer);
    let points: Vec<Rational> = numerators.collect();
    if points.iter().all(Zero::is_zero) {
        return None;
    }
    BSpline::new(
        spline.dimension(),
        spline.degree(),
        spline.knots().clone(),
        RationalVector::from_rationals(&points),
        None,
    )
    .ok()
}
