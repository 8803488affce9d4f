//! One rational or polynomial Bézier piece.

use super::{CurveError, CurveFault, MAXIMUM_BITS, MAXIMUM_DEGREE};
use crate::number::{Rational, RationalVector};

/// A Bézier piece c(u) = Σ w_k P_k B_k(u) / Σ w_k B_k(u), 0 ≤ u ≤ 1, with affine control points P_k and weights w_k > 0.
///
/// Without weights it is polynomial. Equality compares the data, not the shape.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Bezier {
    pub(crate) dimension: usize,
    pub(crate) degree: usize,
    pub(crate) points: RationalVector,
    pub(crate) weights: Option<RationalVector>,
}

impl Bezier {
    /// A piece with the flat control points `points`, `dimension` (2 or 3) numbers each, and one positive weight a point.
    ///
    /// # Errors
    /// A wrong dimension, fewer than 2 or more than 65 points, weights in another number or not positive, numbers above
    /// [`MAXIMUM_BITS`].
    pub fn new(
        dimension: usize,
        points: RationalVector,
        weights: Option<RationalVector>,
    ) -> Result<Bezier, CurveError> {
        let count = check_points(dimension, &points)?;
        if count < 2 {
            let fault = CurveFault::PointCount {
                found: count,
                expected: 2,
            };
            return Err(CurveError::new("points", fault));
        }
        let degree = count - 1;
        if degree > MAXIMUM_DEGREE {
            let fault = CurveFault::Degree { found: degree };
            return Err(CurveError::new("points", fault));
        }
        check_weights(count, weights.as_ref())?;
        Ok(Bezier {
            dimension,
            degree,
            points,
            weights,
        })
    }

    /// Coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The degree n, 1 to 64; the piece has n + 1 control points.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The affine control points, flat, `dimension` numbers each.
    pub fn points(&self) -> &RationalVector {
        &self.points
    }

    /// The weights, one a control point, or nothing for a polynomial piece.
    pub fn weights(&self) -> Option<&RationalVector> {
        self.weights.as_ref()
    }

    /// The affine control point `k`.
    ///
    /// # Panics
    /// When `k` exceeds the degree.
    pub fn point(&self, k: usize) -> Vec<Rational> {
        (0..self.dimension)
            .map(|axis| self.points.get(k * self.dimension + axis))
            .collect()
    }

    /// Whether all weights are equal, so that the piece is a polynomial curve.
    pub fn is_polynomial(&self) -> bool {
        self.weights
            .as_ref()
            .is_none_or(|w| w.numerators().windows(2).all(|pair| pair[0] == pair[1]))
    }
}

/// The number of points in a flat vector.
pub(super) fn check_points(dimension: usize, points: &RationalVector) -> Result<usize, CurveError> {
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
    check_bits("points", points)?;
    Ok(count)
}

/// Positive weights, one a point.
pub(super) fn check_weights(count: usize, weights: Option<&RationalVector>) -> Result<(), CurveError> {
    let Some(weights) = weights else {
        return Ok(());
    };
    if weights.len() != count {
        let fault = CurveFault::WeightCount {
            found: weights.len(),
            expected: count,
        };
        return Err(CurveError::new("weights", fault));
    }
    if let Some(k) = weights.numerators().iter().position(|w| !w.is_positive()) {
        let fault = CurveFault::NonPositiveWeight;
        return Err(CurveError::new(format!("weights[{k}]"), fault));
    }
    check_bits("weights", weights)
}

/// Numerators and denominator within the accepted size.
pub(super) fn check_bits(place: &str, numbers: &RationalVector) -> Result<(), CurveError> {
    let found = numbers
        .numerators()
        .iter()
        .chain([numbers.denominator()])
        .map(|n| n.bits())
        .max()
        .unwrap_or(0);
    if found > MAXIMUM_BITS {
        return Err(CurveError::new(place, CurveFault::TooManyBits { found }));
    }
    Ok(())
}
