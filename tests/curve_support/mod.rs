//! Random valid curves for the property tests.
#![allow(dead_code, reason = "every test program uses a part of its own")]

use knotproof::curve::{BSpline, Bezier};
use knotproof::number::{Integer, Rational, RationalVector};
use proptest::collection::vec;
use proptest::prelude::*;

/// The fraction n/d.
pub fn fraction(n: i64, d: i64) -> Rational {
    Rational::new(Integer::from(n), Integer::from(d))
}

/// A vector of fractions.
pub fn vector(numbers: &[Rational]) -> RationalVector {
    RationalVector::from_rationals(numbers)
}

/// A vector of integers.
pub fn integers(numbers: &[i64]) -> RationalVector {
    let numbers: Vec<Rational> = numbers.iter().map(|&n| fraction(n, 1)).collect();
    vector(&numbers)
}

/// Small coordinates, decimals and others.
pub fn coordinate() -> impl Strategy<Value = Rational> {
    (
        -40i64..=40,
        prop_oneof![Just(1i64), Just(2), Just(3), Just(7), Just(10), Just(16)],
    )
        .prop_map(|(n, d)| fraction(n, d))
}

/// Small positive weights.
pub fn weight() -> impl Strategy<Value = Rational> {
    (1i64..=9, 1i64..=6).prop_map(|(n, d)| fraction(n, d))
}

/// A parameter from 0 to 1.
pub fn unit() -> impl Strategy<Value = Rational> {
    (1i64..=24)
        .prop_flat_map(|d| (0..=d, Just(d)))
        .prop_map(|(n, d)| fraction(n, d))
}

fn control(dimension: usize, count: usize) -> impl Strategy<Value = (RationalVector, Option<RationalVector>)> {
    (
        vec(coordinate(), dimension * count),
        proptest::option::of(vec(weight(), count)),
    )
        .prop_map(|(points, weights)| (vector(&points), weights.map(|w| vector(&w))))
}

/// Bézier pieces of degree 1 to `highest`, polynomial and rational, plane and space.
pub fn bezier(highest: usize) -> impl Strategy<Value = Bezier> {
    (2usize..=3, 1..=highest)
        .prop_flat_map(|(d, n)| (Just(d), control(d, n + 1)))
        .prop_map(|(d, (points, weights))| Bezier::new(d, points, weights).expect("valid piece"))
}

/// B-splines of degree 1 to `highest` with clamped and unclamped knots and interior knots of every multiplicity up to the
/// degree, some with control points that act nowhere in the domain.
pub fn bspline(highest: usize) -> impl Strategy<Value = BSpline> {
    (2usize..=3, 1..=highest)
        .prop_flat_map(|(d, p)| (Just(d), Just(p), knots(p)))
        .prop_flat_map(|(d, p, knots)| {
            let count = knots.len() - p - 1;
            (Just(d), Just(p), Just(knots), control(d, count))
        })
        .prop_filter_map("empty domain", |(d, p, knots, (points, weights))| {
            BSpline::new(d, p, vector(&knots), points, weights).ok()
        })
}

fn knots(p: usize) -> impl Strategy<Value = Vec<Rational>> {
    let run = (1i64..=5, 1..=p);
    (0..4usize, vec(run, 0..5), 1i64..=6).prop_map(move |(ends, mut runs, divisor)| {
        match ends {
            // Clamped.
            0 | 1 => {
                runs.insert(0, (1, p + 1));
                runs.push((2, p + 1));
            }
            // Control points beyond clamped ends.
            2 => {
                runs.insert(0, (1, p + 1));
                runs.insert(0, (1, 1));
                runs.push((2, p + 1));
                runs.push((1, 1));
            }
            // Unclamped.
            _ => {
                for _ in 0..=p {
                    runs.insert(0, (1, 1));
                    runs.push((3, 1));
                }
            }
        }
        let mut value = -7;
        let mut knots = Vec::new();
        for (step, multiplicity) in runs {
            value += step;
            knots.extend(std::iter::repeat_n(fraction(value, divisor), multiplicity));
        }
        knots
    })
}

/// A parameter of the domain at the given fraction of its length.
pub fn at(spline: &BSpline, u: &Rational) -> Rational {
    let (start, end) = spline.domain();
    &start + u * (end - &start)
}
