//! Why an operation on a valid curve is impossible.

use std::fmt;

/// The reason an operation was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OperationError {
    /// The parameter is outside the domain, or at its end where a point strictly inside is needed.
    OutsideDomain,
    /// The knot would occur more often than the degree.
    Multiplicity {
        /// The multiplicity that would result.
        multiplicity: usize,
        /// The degree.
        degree: usize,
    },
    /// The degree would exceed [`MAXIMUM_DEGREE`](super::MAXIMUM_DEGREE).
    Degree {
        /// The degree that would result.
        degree: usize,
    },
    /// The knot does not occur so often, or the curve would be another one without it.
    NotRemovable,
    /// The result would have more than [`MAXIMUM_PIECES`](super::MAXIMUM_PIECES) control points.
    TooMany,
}

impl fmt::Display for OperationError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            OperationError::OutsideDomain => write!(f, "the parameter is outside the domain"),
            OperationError::Multiplicity { multiplicity, degree } => write!(
                f,
                "the knot would occur {multiplicity} times, expected at most {degree}, the degree"
            ),
            OperationError::Degree { degree } => write!(
                f,
                "the degree would be {degree}, expected at most {}",
                super::MAXIMUM_DEGREE
            ),
            OperationError::NotRemovable => write!(f, "the knot cannot be removed so often without changing the curve"),
            OperationError::TooMany => write!(
                f,
                "the result would have more than {} control points",
                super::MAXIMUM_PIECES
            ),
        }
    }
}

impl std::error::Error for OperationError {}
