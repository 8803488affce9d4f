//! Certified enclosures: the sine, and the extremes of the ∞-norm of polynomial vectors.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::difference::{absolute, whole};
use crate::number::{Integer, Rational};

/// An interval of polynomial vectors is halved so often, at most, in all.
const MOST_HALVINGS: usize = 4_000;

/// Two fractions (lower, upper) with lower ≤ sin x ≤ upper and upper − lower ≤ 2^-bits, for 0 ≤ x ≤ 1. `None` for other x.
///
/// The terms of Taylor's series alternate and decrease there, so neighbouring partial sums are bounds.
pub fn sine(x: &Rational, bits: u32) -> Option<(Rational, Rational)> {
    if x.numer().is_negative() || x.numer() > x.denom() {
        return None;
    }
    let width = Rational::new(Integer::ONE, Integer::ONE << bits);
    let square = x * x;
    let (mut lower, mut upper) = (Rational::default(), x.clone());
    let mut term = x.clone();
    let mut k = 1;
    while &upper - &lower > width {
        term = term * &square / whole((k + 1) * (k + 2));
        lower = &upper - &term;
        k += 2;
        term = term * &square / whole((k + 1) * (k + 2));
        k += 2;
        if &upper - &lower > width {
            upper = &lower + &term;
        }
    }
    Some((lower, upper))
}

/// max over 0 ≤ u ≤ 1 and all curves of the greatest absolute coordinate, enclosed to a relative 2^-bits. Every curve is given by its Bézier control points.
pub(super) fn greatest_infinity_norm(curves: &[Vec<Vec<Rational>>], bits: u32) -> [Rational; 2] {
    let mut lower = Rational::default();
    let mut queue = BinaryHeap::new();
    let mut order = 0;
    let push = |points: Vec<Vec<Rational>>, lower: &mut Rational, queue: &mut BinaryHeap<Waiting<Rational>>, order| {
        for end in [&points[0], &points[points.len() - 1]] {
            *lower = lower.clone().max(norm(end));
        }
        let key = points.iter().map(|point| norm(point)).max().unwrap_or_default();
        queue.push(Waiting { key, order, points });
    };
    for points in curves {
        push(points.clone(), &mut lower, &mut queue, order);
        order += 1;
    }
    for _ in 0..MOST_HALVINGS {
        match queue.pop() {
            Some(top) if !is_near(&lower, &top.key, bits) => {
                for half in halve(top.points) {
                    push(half, &mut lower, &mut queue, order);
                    order += 1;
                }
            }
            Some(top) => return [lower, top.key],
            None => break,
        }
    }
    let upper = queue.pop().map_or_else(|| lower.clone(), |top| top.key);
    [lower, upper]
}

/// min over 0 ≤ u ≤ 1 and all curves of the greatest absolute coordinate, enclosed to a relative 2^-bits; when the minimum is 0 and not attained at a dyadic
/// parameter, the lower end is 0 and the upper one small.
pub(super) fn least_infinity_norm(curves: &[Vec<Vec<Rational>>], bits: u32) -> [Rational; 2] {
    let mut upper: Option<Rational> = None;
    let mut queue = BinaryHeap::new();
    let mut order = 0;
    let push = |points: Vec<Vec<Rational>>,
                upper: &mut Option<Rational>,
                queue: &mut BinaryHeap<Waiting<Reverse<Rational>>>,
                order| {
        for end in [&points[0], &points[points.len() - 1]] {
            let value = norm(end);
            if upper.as_ref().is_none_or(|least| value < *least) {
                *upper = Some(value);
            }
        }
        let key = Reverse(least_on(&points));
        queue.push(Waiting { key, order, points });
    };
    for points in curves {
        push(points.clone(), &mut upper, &mut queue, order);
        order += 1;
    }
    let mut lower = None;
    for _ in 0..MOST_HALVINGS {
        let Some(top) = queue.pop() else { break };
        let least = upper.clone().unwrap_or_default();
        if is_near(&top.key.0, &least, bits) || least.numer().is_zero() {
            lower = Some(top.key.0);
            break;
        }
        for half in halve(top.points) {
            push(half, &mut upper, &mut queue, order);
            order += 1;
        }
    }
    let lower = lower.or_else(|| queue.pop().map(|top| top.key.0)).unwrap_or_default();
    let upper = upper.unwrap_or_default();
    [lower.min(upper.clone()), upper]
}

/// upper − lower ≤ 2^-bits · upper.
fn is_near(lower: &Rational, upper: &Rational, bits: u32) -> bool {
    (upper - lower) * Rational::from_integer(Integer::ONE << bits) <= *upper
}

fn norm(vector: &[Rational]) -> Rational {
    vector.iter().cloned().map(absolute).max().unwrap_or_default()
}

/// A lower bound of the greatest absolute coordinate: that of a coordinate whose coefficients have one sign.
fn least_on(points: &[Vec<Rational>]) -> Rational {
    let axis = |i: usize| {
        let positive = points[0][i].numer().is_positive();
        let one_sign = points.iter().all(|point| match positive {
            true => point[i].numer().is_positive(),
            false => point[i].numer().is_negative(),
        });
        match one_sign {
            true => points.iter().map(|point| absolute(point[i].clone())).min(),
            false => None,
        }
    };
    (0..points[0].len()).filter_map(axis).max().unwrap_or_default()
}

fn halve(mut row: Vec<Vec<Rational>>) -> [Vec<Vec<Rational>>; 2] {
    let last = row.len() - 1;
    let half = Rational::new(Integer::ONE, Integer::from(2));
    let (mut left, mut right) = (vec![row[0].clone()], vec![row[last].clone()]);
    for round in (0..last).rev() {
        for k in 0..=round {
            row[k] = row[k].iter().zip(&row[k + 1]).map(|(x, y)| (x + y) * &half).collect();
        }
        left.push(row[0].clone());
        right.push(row[round].clone());
    }
    right.reverse();
    [left, right]
}

/// An interval that waits to be halved, the greatest key first.
struct Waiting<K> {
    key: K,
    order: usize,
    points: Vec<Vec<Rational>>,
}

impl<K: Ord> Ord for Waiting<K> {
    fn cmp(&self, other: &Self) -> Ordering {
        (&self.key, Reverse(self.order)).cmp(&(&other.key, Reverse(other.order)))
    }
}

impl<K: Ord> PartialOrd for Waiting<K> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<K: Ord> PartialEq for Waiting<K> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl<K: Ord> Eq for Waiting<K> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::RationalExt;

    #[test]
    fn sines() {
        for p in 0..=20 {
            let x = Rational::new(Integer::from(p), Integer::from(20));
            let (lower, upper) = sine(&x, 60).expect("in range");
            let value = (f64::from(p) / 20.0).sin();
            assert!(lower <= upper && lower.to_f64() <= value + 1e-15 && upper.to_f64() >= value - 1e-15);
            assert!((upper - lower).to_f64() <= 1e-18);
        }
        assert_eq!(sine(&whole(2), 60), None);
        assert_eq!(sine(&-whole(1), 60), None);
        assert_eq!(sine(&Rational::default(), 60), Some(Default::default()));
    }

    #[test]
    fn extremes_of_a_parabola_and_of_a_kink() {
        let point = |x: i64, y: i64| vec![Rational::from_integer(x.into()), Rational::from_integer(y.into())];
        // y = 4u(1 − u) is greatest at 1/2.
        let arch = vec![point(0, 0), point(0, 2), point(0, 0)];
        assert_eq!(greatest_infinity_norm(&[arch], 30), [whole(1), whole(1)]);
        // max(|3u − 1|, |1 − u|): least where 3u − 1 = 1 − u, at u = 1/2, 1/2.
        let kink = vec![point(-1, 1), point(2, 0)];
        let half = Rational::new(Integer::ONE, Integer::from(2));
        assert_eq!(least_infinity_norm(&[kink], 30), [half.clone(), half]);
        // max(|5u − 1|, |1 − u|): where 5u − 1 = 1 − u, at u = 1/3, 2/3.
        let kink = vec![point(-1, 1), point(4, 0)];
        let [lower, upper] = least_infinity_norm(&[kink], 30);
        let third = Rational::new(Integer::from(2), Integer::from(3));
        assert!(lower <= third && third <= upper && is_near(&lower, &upper, 30) && lower < upper);
        // A zero that halving does not reach.
        let zero = vec![point(-1, 0), point(2, 0)];
        let [lower, upper] = least_infinity_norm(&[zero], 30);
        assert!(lower.numer().is_zero() && upper.to_f64() < 1e-9 && upper > lower);
    }
}
