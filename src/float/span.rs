//! The knot span of a parameter.

use super::curve::Curve;
use super::error::FloatError;
use crate::curve::Side;

impl Curve {
    /// The index k of the non-empty span t_k < t_{k+1} of the domain on the given side of t; at an end of the domain the span inside.
    pub(super) fn span(&self, t: f64, side: Side) -> Result<usize, FloatError> {
        self.span_near(t, side, self.degree)
    }

    /// The same, tried first at `hint` and where equal spans would have it.
    #[inline]
    pub(super) fn span_near(&self, t: f64, side: Side, hint: usize) -> Result<usize, FloatError> {
        let (p, n) = (self.degree, self.count());
        let (start, end) = (self.knots[p], self.knots[n]);
        // NaN is outside.
        if !(start <= t && t <= end) {
            return Err(FloatError::OutsideDomain);
        }
        let inside = |k: usize| self.knots[k] < t && t < self.knots[k + 1];
        if inside(hint) {
            return Ok(hint);
        }
        let guess = p + ((t - start) / (end - start) * (n - p) as f64) as usize;
        let guess = guess.min(n - 1);
        if inside(guess) {
            return Ok(guess);
        }
        let domain = &self.knots[p..=n];
        let before = domain.partition_point(|k| *k < t);
        if (side == Side::After && t < end) || before == 0 {
            let not_after = before + domain[before..].iter().take_while(|k| **k == t).count();
            Ok(p + not_after - 1)
        } else {
            Ok(p + before - 1)
        }
    }
}
