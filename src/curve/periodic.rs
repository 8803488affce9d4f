//! Periodic B-splines.

use super::{BSpline, CurveError, CurveFault, MAXIMUM_PIECES};
use crate::number::{Rational, RationalVector};

impl BSpline {
    /// The closed spline with the cyclic control points P_0 … P_{M−1} and the knots t_0 ≤ … ≤ t_M of one period, as an
    /// unclamped spline on [t_0, t_M]: knots and points continue periodically, the first `degree` points once more at the
    /// end.
    ///
    /// `points` is flat; `weights` has one entry a point. The curve is closed, with `degree` − m derivatives when t_0 occurs
    /// m times in a period.
    ///
    /// # Errors
    /// Knots not one more than the points, a period that is not positive, a knot that occurs in a period more often than the
    /// degree, and every fault of [`BSpline::new`], named by its place in the continued knots and points.
    pub fn periodic(
        dimension: usize,
        degree: usize,
        knots: &[Rational],
        points: &[Rational],
        weights: Option<&[Rational]>,
    ) -> Result<BSpline, CurveError> {
        if degree == 0 || degree > super::MAXIMUM_DEGREE {
            let fault = CurveFault::Degree { found: degree };
            return Err(CurveError::new("degree", fault));
        }
        if dimension != 2 && dimension != 3 {
            let fault = CurveFault::Dimension { found: dimension };
            return Err(CurveError::new("points", fault));
        }
        let count = points.len() / dimension;
        if !points.len().is_multiple_of(dimension) {
            let fault = CurveFault::MixedDimensions {
                found: points.len() % dimension,
                expected: dimension,
            };
            return Err(CurveError::new(format!("points[{count}]"), fault));
        }
        if count == 0 {
            let fault = CurveFault::PointCount { found: 0, expected: 1 };
            return Err(CurveError::new("points", fault));
        }
        if count > MAXIMUM_PIECES {
            let fault = CurveFault::TooMany { found: count };
            return Err(CurveError::new("points", fault));
        }
        if knots.len() != count + 1 {
            let fault = CurveFault::KnotCount {
                found: knots.len(),
                expected: count + 1,
            };
            return Err(CurveError::new("knots", fault));
        }
        if let Some(weights) = weights
            && weights.len() != count
        {
            let fault = CurveFault::WeightCount {
                found: weights.len(),
                expected: count,
            };
            return Err(CurveError::new("weights", fault));
        }
        // Seen cyclically the closing knot is an interior one.
        let closing = |t: &&Rational| **t == knots[0] || **t == knots[count];
        let multiplicity = knots[..count].iter().filter(closing).count();
        if multiplicity > degree && knots[0] != knots[count] {
            let fault = CurveFault::InteriorMultiplicity { multiplicity, degree };
            return Err(CurveError::new("knots[0]", fault));
        }
        let period = &knots[count] - &knots[0];
        // Knot `degree` is t_0.
        let continued: Vec<Rational> = (0..count + 2 * degree + 1)
            .map(|i| {
                let turns = (i + count * degree - degree) / count;
                let within = (i + count * degree - degree) % count;
                let shift = Rational::from_integer(turns.into()) - Rational::from_integer(degree.into());
                &knots[within] + shift * &period
            })
            .collect();
        let wrapped = |i: usize| i % count;
        let points: Vec<Rational> = (0..count + degree)
            .flat_map(|i| &points[wrapped(i) * dimension..][..dimension])
            .cloned()
            .collect();
        let weights = weights.map(|w| {
            let all: Vec<Rational> = (0..count + degree).map(|i| w[wrapped(i)].clone()).collect();
            RationalVector::from_rationals(&all)
        });
        BSpline::new(
            dimension,
            degree,
            RationalVector::from_rationals(&continued),
            RationalVector::from_rationals(&points),
            weights,
        )
    }
}
