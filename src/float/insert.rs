//! Knot insertion (Böhm 1980).

use super::curve::{Curve, Lifted, mix, parts};
use super::double::{Double, two_product, two_sum};
use super::error::FloatError;
use crate::curve::MAXIMUM_PIECES;

/// Coordinates of new points that one inserted knot may have without taking the general way.
const FRESH: usize = 9;

impl Curve {
    /// How often `t` occurs among the knots.
    pub fn multiplicity(&self, t: f64) -> usize {
        let first = self.knots.partition_point(|knot| *knot < t);
        self.knots[first..].iter().take_while(|knot| **knot == t).count()
    }

    /// The same curve with `t`, anywhere in the domain ends included, as a knot `times` times more.
    ///
    /// Control points that do not change are copied; the others are convex combinations, computed in double-double and rounded once.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`], and [`FloatError::Multiplicity`] when the knot would occur more often than the degree.
    #[inline]
    pub fn insert_knot(&self, t: f64, times: usize) -> Result<Curve, FloatError> {
        let (p, d) = (self.degree, self.dimension);
        let (start, end) = self.domain();
        if !(start <= t && t <= end) {
            return Err(FloatError::OutsideDomain);
        }
        let after = self.knots.partition_point(|knot| *knot <= t);
        let multiplicity = self.knots[..after].iter().rev().take_while(|knot| **knot == t).count();
        let total = multiplicity.saturating_add(times);
        if times > 0 && total > p {
            let (multiplicity, greatest) = (total, p);
            return Err(FloatError::Multiplicity { multiplicity, greatest });
        }
        if self.count() + times > MAXIMUM_PIECES {
            return Err(FloatError::Argument {
                expected: "at most 4,000,000 control points",
            });
        }
        if times == 0 {
            return Ok(self.clone());
        }
        let k = after - 1;
        // Points k − p … k − multiplicity become points k − p … k − multiplicity + times; the first and the last of them stay.
        let (first, last) = (k - p, k - multiplicity);
        // One knot, the usual case, has its own way.
        let alone = times == 1 && self.weights.is_none() && (p - multiplicity) * d <= FRESH;
        let fresh = if alone {
            Vec::new()
        } else {
            self.inserted(k, multiplicity, t, times)
        };
        let mut knots = Vec::with_capacity(self.knots.len() + times);
        knots.extend_from_slice(&self.knots[..after]);
        for _ in 0..times {
            knots.push(t);
        }
        knots.extend_from_slice(&self.knots[after..]);
        let mut points = Vec::with_capacity(self.points.len() + times * d);
        points.extend_from_slice(&self.points[..(first + 1) * d]);
        let mut weights = self.weights.as_ref().map(|weights| {
            let mut all = Vec::with_capacity(weights.len() + times);
            all.extend_from_slice(&weights[..=first]);
            all
        });
        if alone {
            let (count, fresh) = self.between(first, last, t);
            points.extend_from_slice(&fresh[..count]);
        }
        for lifted in &fresh {
            self.lower(lifted, &mut points, weights.as_mut());
        }
        points.extend_from_slice(&self.points[last * d..]);
        if let (Some(to), Some(from)) = (&mut weights, &self.weights) {
            to.extend_from_slice(&from[last..]);
        }
        let result = Curve {
            dimension: d,
            degree: p,
            knots,
            points,
            weights,
        };
        // The mean of numbers in range is.
        if result.weights.is_none() {
            Ok(result)
        } else {
            result.in_range()
        }
    }

    /// Control points `first` + 1 … `last` after the insertion of t: point i is that between control points i − 1 and i that divides them as t divides knots
    /// i and i + p. From the nearer one on, so that a small share keeps its relative accuracy; in double-double, rounded once. How many
    /// coordinates, and these.
    #[inline]
    fn between(&self, first: usize, last: usize, t: f64) -> (usize, [f64; FRESH]) {
        let d = self.dimension;
        let count = (last - first) * d;
        let (mut near, mut far) = ([0.0; FRESH], [0.0; FRESH]);
        let (mut high, mut low) = ([0.0; FRESH], [0.0; FRESH]);
        for i in first + 1..=last {
            let (start, end) = (self.knots[i], self.knots[i + self.degree]);
            let (from, to) = (Double::difference(t, start), Double::difference(end, t));
            let before = from.value() <= to.value();
            let share = if before { from } else { to } / Double::difference(end, start);
            let (p, q) = self.points[(i - 1) * d..(i + 1) * d].split_at(d);
            let (p, q) = if before { (p, q) } else { (q, p) };
            let place = (i - first - 1) * d;
            for axis in 0..d {
                (near[place + axis], far[place + axis]) = (p[axis], q[axis]);
                (high[place + axis], low[place + axis]) = (share.value(), share.rest());
            }
        }
        // Plain arrays, which the compiler turns into vector instructions.
        {
            let (near, far, high, low) = (&mut near[..count], &far[..count], &high[..count], &low[..count]);
            for j in 0..count {
                let (difference, error) = two_sum(far[j], -near[j]);
                let (product, lost) = two_product(high[j], difference);
                let (sum, rest) = two_sum(near[j], product);
                near[j] = sum + (rest + (lost + (high[j] * error + low[j] * difference)));
            }
        }
        (count, near)
    }

    /// The points strictly between k − p and k − multiplicity + times of the curve with t inserted `times` times (Piegl and Tiller 1997, A5.1).
    fn inserted(&self, k: usize, multiplicity: usize, t: f64, times: usize) -> Vec<Lifted> {
        let p = self.degree;
        let mut row = self.lifted_range(k - p..k - multiplicity + 1);
        let (mut left, mut right) = (Vec::with_capacity(p), Vec::with_capacity(times));
        for round in 1..=times {
            let count = p - round - multiplicity;
            for i in 0..=count {
                let low = k - p + round + i;
                let (u, v) = parts(self.knots[low], t, self.knots[i + k + 1]);
                row[i] = mix(v, &row[i], u, &row[i + 1]);
            }
            if round < times {
                left.push(row[0]);
                right.push(row[count]);
            } else {
                left.extend_from_slice(&row[..=count]);
            }
        }
        left.extend(right.into_iter().rev());
        left
    }
}
