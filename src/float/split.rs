//! Splitting a curve in two.

use super::curve::Curve;
use super::error::FloatError;

impl Curve {
    /// The parts before and after t, strictly inside the domain, with their old knots and t degree + 1 times at the cut.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`].
    pub fn split(&self, t: f64) -> Result<(Curve, Curve), FloatError> {
        let (p, d) = (self.degree, self.dimension);
        let (start, end) = self.domain();
        if !(start < t && t < end) {
            return Err(FloatError::OutsideDomain);
        }
        let whole = self.insert_knot(t, p - self.multiplicity(t))?;
        // The first of the p knots at t; control point first − 1 is the point c(t).
        let first = whole.knots.partition_point(|knot| *knot < t);
        let mut left = whole.knots[..first + p].to_vec();
        left.push(t);
        let mut right = vec![t];
        right.extend_from_slice(&whole.knots[first..]);
        let part = |knots: Vec<f64>, range: std::ops::Range<usize>| Curve {
            dimension: d,
            degree: p,
            knots,
            points: whole.points[range.start * d..range.end * d].to_vec(),
            weights: whole.weights.as_ref().map(|weights| weights[range].to_vec()),
        };
        Ok((part(left, 0..first), part(right, first - 1..whole.count())))
    }
}
