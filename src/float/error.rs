//! Why an operation in floating point is refused.

use std::fmt;

use crate::curve::CurveError;

/// A refusal. Nothing is computed rather than something wrong.
#[derive(Debug, Clone, PartialEq)]
pub enum FloatError {
    /// The data are not a curve; the fault is the same as for an exact curve.
    Curve(CurveError),
    /// A number is not finite, or magnitudes are outside the range in which the arithmetic keeps its accuracy.
    Range {
        /// Which numbers: "knots", "points", "weights", "parameter", "result".
        place: &'static str,
    },
    /// The parameter is outside the domain.
    OutsideDomain,
    /// The knot would occur more often than the degree allows, or does not occur as often as it is to be removed.
    Multiplicity {
        /// The multiplicity asked for, or found.
        multiplicity: usize,
        /// The greatest one possible.
        greatest: usize,
    },
    /// Without the knot the curve would change by more than the tolerance.
    NotRemovable {
        /// A bound of the change found.
        deviation: f64,
    },
    /// The degree would exceed [`MAXIMUM_DEGREE`](crate::curve::MAXIMUM_DEGREE).
    Degree {
        /// The degree asked for.
        degree: usize,
    },
    /// The first derivative vanishes, or for a torsion the curvature.
    Irregular,
    /// The operation is for another dimension than the curve's, or the two curves differ in theirs.
    Dimension,
    /// An argument outside its stated range.
    Argument {
        /// What was expected.
        expected: &'static str,
    },
    /// Rounding leaves open whether there is a result, or of which form.
    Doubtful,
    /// The search did not end within its budget.
    Budget,
}

impl fmt::Display for FloatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            FloatError::Curve(error) => error.fmt(f),
            FloatError::Range { place } => write!(f, "{place}: not finite, or too large or small for binary64"),
            FloatError::OutsideDomain => write!(f, "the parameter is outside the domain"),
            FloatError::Multiplicity { multiplicity, greatest } => {
                write!(f, "multiplicity {multiplicity}, expected at most {greatest}")
            }
            FloatError::NotRemovable { deviation } => {
                write!(f, "without the knot the curve would change by up to {deviation:e}")
            }
            FloatError::Degree { degree } => write!(f, "degree {degree}, expected at most 64"),
            FloatError::Irregular => write!(f, "the derivatives vanish or are parallel there"),
            FloatError::Dimension => write!(f, "the dimension does not fit"),
            FloatError::Argument { expected } => write!(f, "expected {expected}"),
            FloatError::Doubtful => write!(f, "rounding leaves the result open"),
            FloatError::Budget => write!(f, "the search did not end within its budget"),
        }
    }
}

impl std::error::Error for FloatError {}

impl From<CurveError> for FloatError {
    fn from(error: CurveError) -> FloatError {
        FloatError::Curve(error)
    }
}
