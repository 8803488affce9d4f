//! Knot insertion (Böhm 1980).

use super::curve::{Curve, Lifted, mix, parts};
use super::double::{two_product, two_sum};
use super::error::FloatError;
use crate::curve::MAXIMUM_PIECES;

/// Up to so many knots are gone through in turn, which a processor that predicts branches does ahead of time; more are searched by halving.
const FEW: usize = 32;

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
        let after = if self.knots.len() <= FEW {
            self.knots.iter().position(|knot| *knot > t).unwrap_or(self.knots.len())
        } else {
            self.knots.partition_point(|knot| *knot <= t)
        };
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
        let mut knots = Vec::with_capacity(self.knots.len() + times);
        knots.extend_from_slice(&self.knots[..after]);
        for _ in 0..times {
            knots.push(t);
        }
        knots.extend_from_slice(&self.knots[after..]);
        let mut points = Vec::with_capacity(self.points.len() + times * d);
        points.extend_from_slice(&self.points[..(first + 1) * d]);
        let Some(all) = &self.weights else {
            if times == 1 {
                // One knot, the usual case, has its own way. The new points are written over copies of old ones.
                points.extend_from_slice(&self.points[first * d..]);
                let fresh = &mut points[(first + 1) * d..(last + 1) * d];
                if d == 2 {
                    self.between::<2>(first..last, t, fresh);
                } else {
                    self.between::<3>(first..last, t, fresh);
                }
            } else {
                for lifted in self.inserted(k, multiplicity, t, times) {
                    self.lower(&lifted, &mut points, None);
                }
                points.extend_from_slice(&self.points[last * d..]);
            }
            // The mean of numbers in range is.
            return Ok(Curve {
                dimension: d,
                degree: p,
                knots,
                points,
                weights: None,
            });
        };
        let mut weights = Vec::with_capacity(all.len() + times);
        weights.extend_from_slice(&all[..=first]);
        for lifted in self.inserted(k, multiplicity, t, times) {
            self.lower(&lifted, &mut points, Some(&mut weights));
        }
        points.extend_from_slice(&self.points[last * d..]);
        weights.extend_from_slice(&all[last..]);
        let result = Curve {
            dimension: d,
            degree: p,
            knots,
            points,
            weights: Some(weights),
        };
        result.in_range()
    }

    /// The control points after those of `range` when t is inserted: after point i comes the one between points i and i + 1 that divides them as t divides
    /// knots i + 1 and i + 1 + p.
    ///
    /// From the nearer point n on, with s the share of the shorter part in the whole: n + s (f − n) with f the farther one, so that a small s keeps its
    /// relative accuracy. s is taken as h + l, h the quotient of the rounded parts; with a = A + a′ and b = B + b′ the part and the whole, exactly,
    /// s − h = (a − h b)/b, where A − h B is computed without error but for the last digit of a number of magnitude 2⁻⁵³ A, so that l has a relative error
    /// of few units of 2⁻⁵³ and h + l one of few units of 2⁻¹⁰⁶. The sum is rounded once, from 2⁻¹⁰⁰ of |n| + |f|.
    #[inline(always)]
    fn between<const D: usize>(&self, range: std::ops::Range<usize>, t: f64, fresh: &mut [f64]) {
        let starts = &self.knots[range.start + 1..=range.end];
        let ends = &self.knots[range.start + 1 + self.degree..=range.end + self.degree];
        let (old, _) = self.points[range.start * D..(range.end + 1) * D].as_chunks::<D>();
        let (fresh, _) = fresh.as_chunks_mut::<D>();
        for (((to, pair), start), end) in fresh.iter_mut().zip(old.windows(2)).zip(starts).zip(ends) {
            let before = t - start <= end - t;
            let (part, part_rest) = if before { two_sum(t, -start) } else { two_sum(*end, -t) };
            let (whole, whole_rest) = two_sum(*end, -start);
            let share = part / whole;
            let (product, lost) = two_product(share, whole);
            let share_rest = ((part - product) - lost + (part_rest - share * whole_rest)) / whole;
            let (near, far) = if before {
                (&pair[0], &pair[1])
            } else {
                (&pair[1], &pair[0])
            };
            for axis in 0..D {
                let (difference, error) = two_sum(far[axis], -near[axis]);
                let (product, lost) = two_product(share, difference);
                let (sum, rest) = two_sum(near[axis], product);
                to[axis] = sum + (rest + (lost + (share * error + share_rest * difference)));
            }
        }
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
