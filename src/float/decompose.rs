//! A curve as Bézier pieces.

use super::curve::{Curve, Lifted, mix, parts};
use super::error::FloatError;

impl Curve {
    /// The Bézier pieces of the non-empty knot spans of the domain, each with its own two knots, degree + 1 times each.
    ///
    /// Neighbours share the same binary64 point and weight at their joint.
    ///
    /// # Errors
    /// [`FloatError::Range`] when a weight leaves the range.
    pub fn decompose(&self) -> Result<Vec<Curve>, FloatError> {
        let (p, d) = (self.degree, self.dimension);
        let mut pieces: Vec<Curve> = Vec::new();
        for k in p..self.count() {
            let (a, b) = (self.knots[k], self.knots[k + 1]);
            if a == b {
                continue;
            }
            let mut knots = vec![a; p + 1];
            knots.extend(std::iter::repeat_n(b, p + 1));
            let mut piece = self.with(p, knots, &self.span_points(k))?;
            if let Some(before) = pieces.last() {
                piece.points[..d].copy_from_slice(&before.points[p * d..]);
                if let (Some(own), Some(other)) = (&mut piece.weights, &before.weights) {
                    own[0] = other[p];
                }
            }
            pieces.push(piece);
        }
        Ok(pieces)
    }

    /// The Bézier points of span k: its start is inserted to full multiplicity, then its end. Both are convex combinations.
    pub(super) fn span_points(&self, k: usize) -> Vec<Lifted> {
        let p = self.degree;
        let mut points = self.lifted_range(k - p..k + 1);
        let knots = &self.knots[k + 1 - p..=k + p];
        let (a, b) = (knots[p - 1], knots[p]);
        for round in 1..=p {
            for j in 0..=p - round {
                let (u, v) = parts(knots[j + round - 1], a, knots[j + p]);
                points[j] = mix(v, &points[j], u, &points[j + 1]);
            }
        }
        // Every knot before b is now a; the points are f(a, …, a, knots[p..p + j]).
        let mut result = Vec::with_capacity(p + 1);
        for round in 1..=p {
            result.push(points[0]);
            for j in 0..=p - round {
                let (u, v) = parts(a, b, knots[j + p]);
                points[j] = mix(v, &points[j], u, &points[j + 1]);
            }
        }
        result.push(points[0]);
        result
    }
}
