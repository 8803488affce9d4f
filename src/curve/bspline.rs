//! One B-spline or NURBS curve.

use super::bezier::{check_bits, check_points, check_weights};
use super::{CurveError, CurveFault, MAXIMUM_DEGREE, MAXIMUM_PIECES};
use crate::number::{Rational, RationalVector};

/// A B-spline curve of degree p with knots t_0 ≤ … ≤ t_{n+p} and n affine control points, on the domain [t_p, t_n].
///
/// With weights it is a NURBS curve c(t) = Σ w_k P_k N_k(t) / Σ w_k N_k(t). Clamped, unclamped and periodic knots are
/// all accepted. Equality compares the data, not the shape.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BSpline {
    pub(crate) dimension: usize,
    pub(crate) degree: usize,
    pub(crate) knots: RationalVector,
    pub(crate) points: RationalVector,
    pub(crate) weights: Option<RationalVector>,
}

impl BSpline {
    /// A B-spline of degree `degree` (1 to 64) with the flat control points `points`, `dimension` (2 or 3) numbers each,
    /// points + degree + 1 knots, and one positive weight a point.
    ///
    /// # Errors
    /// Every [`CurveFault`] that a single spline can have, with its place.
    pub fn new(
        dimension: usize,
        degree: usize,
        knots: RationalVector,
        points: RationalVector,
        weights: Option<RationalVector>,
    ) -> Result<BSpline, CurveError> {
        if degree == 0 || degree > MAXIMUM_DEGREE {
            let fault = CurveFault::Degree { found: degree };
            return Err(CurveError::new("degree", fault));
        }
        let count = check_points(dimension, &points)?;
        if count < degree + 1 {
            let fault = CurveFault::PointCount {
                found: count,
                expected: degree + 1,
            };
            return Err(CurveError::new("points", fault));
        }
        if count > MAXIMUM_PIECES {
            let fault = CurveFault::TooMany { found: count };
            return Err(CurveError::new("points", fault));
        }
        if knots.len() != count + degree + 1 {
            let fault = CurveFault::KnotCount {
                found: knots.len(),
                expected: count + degree + 1,
            };
            return Err(CurveError::new("knots", fault));
        }
        check_bits("knots", &knots)?;
        check_knots(degree, count, &knots)?;
        check_weights(count, weights.as_ref())?;
        Ok(BSpline {
            dimension,
            degree,
            knots,
            points,
            weights,
        })
    }

    /// Coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The degree p, 1 to 64.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The number of control points.
    pub fn count(&self) -> usize {
        self.points.len() / self.dimension
    }

    /// The knots, `count + degree + 1` of them, non-decreasing.
    pub fn knots(&self) -> &RationalVector {
        &self.knots
    }

    /// The affine control points, flat, `dimension` numbers each.
    pub fn points(&self) -> &RationalVector {
        &self.points
    }

    /// The weights, one a control point, or nothing for a polynomial spline.
    pub fn weights(&self) -> Option<&RationalVector> {
        self.weights.as_ref()
    }

    /// The two ends t_p < t_n of the parameter range.
    pub fn domain(&self) -> (Rational, Rational) {
        (self.knots.get(self.degree), self.knots.get(self.count()))
    }
}

/// Order and multiplicities of the knots.
fn check_knots(degree: usize, count: usize, knots: &RationalVector) -> Result<(), CurveError> {
    // One common positive denominator: the numerators compare as the knots do.
    let t = knots.numerators();
    if let Some(k) = t.windows(2).position(|pair| pair[1] < pair[0]) {
        let fault = CurveFault::DecreasingKnots;
        return Err(CurveError::new(format!("knots[{}]", k + 1), fault));
    }
    let (start, end) = (&t[degree], &t[count]);
    if start == end {
        return Err(CurveError::new("knots", CurveFault::EmptyDomain));
    }
    let mut first = 0;
    for run in t.chunk_by(|a, b| a == b) {
        let (knot, multiplicity) = (&run[0], run.len());
        let fault = if start < knot && knot < end && multiplicity > degree {
            Some(CurveFault::InteriorMultiplicity { multiplicity, degree })
        } else if multiplicity > degree + 1 {
            Some(CurveFault::EndMultiplicity { multiplicity, degree })
        } else {
            None
        };
        if let Some(fault) = fault {
            return Err(CurveError::new(format!("knots[{first}]"), fault));
        }
        first += multiplicity;
    }
    Ok(())
}
