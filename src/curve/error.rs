//! Why something is not a curve.

use std::fmt;

/// The reason a curve was refused, with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CurveError {
    /// Where, as a path inside the refused object: `knots[4]`, `points[3]`, `pieces[7]`. Empty for the whole object.
    pub place: String,
    /// What is wrong there.
    pub fault: CurveFault,
}

impl CurveError {
    pub(crate) fn new(place: impl Into<String>, fault: CurveFault) -> Self {
        CurveError {
            place: place.into(),
            fault,
        }
    }
}

/// What is wrong with a refused curve.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum CurveFault {
    /// Points have neither 2 nor 3 coordinates.
    Dimension {
        /// Coordinates found.
        found: usize,
    },
    /// Two points have different numbers of coordinates.
    MixedDimensions {
        /// Coordinates found.
        found: usize,
        /// Coordinates of the first point.
        expected: usize,
    },
    /// The degree is 0 or above [`MAXIMUM_DEGREE`](super::MAXIMUM_DEGREE).
    Degree {
        /// The degree found.
        found: usize,
    },
    /// Too few control points, or for a Bézier piece another number than degree + 1.
    PointCount {
        /// Points found.
        found: usize,
        /// The least number expected.
        expected: usize,
    },
    /// The knots are not as many as points + degree + 1.
    KnotCount {
        /// Knots found.
        found: usize,
        /// Points + degree + 1.
        expected: usize,
    },
    /// The weights are not as many as the points.
    WeightCount {
        /// Weights found.
        found: usize,
        /// Number of points.
        expected: usize,
    },
    /// A weight is zero or negative.
    NonPositiveWeight,
    /// A knot is less than the one before.
    DecreasingKnots,
    /// A knot strictly inside the domain occurs more often than the degree, so the curve may tear there.
    InteriorMultiplicity {
        /// How often the knot occurs.
        multiplicity: usize,
        /// The degree.
        degree: usize,
    },
    /// A knot at an end of the domain occurs more often than degree + 1 times.
    EndMultiplicity {
        /// How often the knot occurs.
        multiplicity: usize,
        /// The degree.
        degree: usize,
    },
    /// The knots `t[degree]` and `t[points]`, the ends of the domain, are equal.
    EmptyDomain,
    /// A chain without pieces.
    NoPieces,
    /// More pieces or control points than [`MAXIMUM_PIECES`](super::MAXIMUM_PIECES).
    TooMany {
        /// Number found.
        found: usize,
    },
    /// A number with more bits than [`MAXIMUM_BITS`](super::MAXIMUM_BITS).
    TooManyBits {
        /// Bits found.
        found: u64,
    },
    /// A piece does not start where the piece before ends.
    Gap,
}

impl fmt::Display for CurveError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if !self.place.is_empty() {
            write!(f, "{}: ", self.place)?;
        }
        self.fault.fmt(f)
    }
}

impl std::error::Error for CurveError {}

impl fmt::Display for CurveFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            CurveFault::Dimension { found } => {
                write!(f, "found {found} coordinates, expected 2 or 3")
            }
            CurveFault::MixedDimensions { found, expected } => write!(
                f,
                "found {found} coordinates, expected {expected} as in the first point"
            ),
            CurveFault::Degree { found } => write!(f, "found degree {found}, expected 1 to {}", super::MAXIMUM_DEGREE),
            CurveFault::PointCount { found, expected } => {
                write!(f, "found {found} control points, expected {expected}")
            }
            CurveFault::KnotCount { found, expected } => write!(
                f,
                "found {found} knots, expected {expected} (control points + degree + 1)"
            ),
            CurveFault::WeightCount { found, expected } => {
                write!(
                    f,
                    "found {found} weights, expected {expected}, one for each control point"
                )
            }
            CurveFault::NonPositiveWeight => write!(f, "found a weight that is not positive, expected a positive one"),
            CurveFault::DecreasingKnots => write!(
                f,
                "found a knot less than the one before, expected non-decreasing knots"
            ),
            CurveFault::InteriorMultiplicity { multiplicity, degree } => write!(
                f,
                "found an interior knot {multiplicity} times, expected at most {degree} times, the degree"
            ),
            CurveFault::EndMultiplicity { multiplicity, degree } => write!(
                f,
                "found an end knot {multiplicity} times, expected at most {} times, the degree + 1",
                degree + 1
            ),
            CurveFault::EmptyDomain => write!(
                f,
                "found a domain of length zero, expected the knot at index [degree] to be less than the knot at index \
                 [number of control points]"
            ),
            CurveFault::NoPieces => write!(f, "found no pieces, expected at least one"),
            CurveFault::TooMany { found } => {
                write!(f, "found {found}, expected at most {}", super::MAXIMUM_PIECES)
            }
            CurveFault::TooManyBits { found } => write!(
                f,
                "found a number of {found} bits, expected at most {}",
                super::MAXIMUM_BITS
            ),
            CurveFault::Gap => write!(
                f,
                "found a piece that does not start exactly where the piece before ends, expected one that does"
            ),
        }
    }
}
