//! A curve as a user gives it.

use super::{BSpline, Bezier, CurveError, CurveFault, MAXIMUM_PIECES};
use crate::number::{Integer, RationalVector};

/// A valid curve in the plane or in space.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Curve {
    dimension: usize,
    form: Form,
}

/// How a curve is given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Form {
    /// One B-spline or NURBS curve.
    BSpline(BSpline),
    /// Bézier pieces, each starting exactly where the one before ends.
    Bezier(Vec<Bezier>),
}

impl Curve {
    /// A curve of `dimension` (2 or 3) coordinates.
    ///
    /// # Errors
    /// A form of another dimension, no pieces or more than [`MAXIMUM_PIECES`], pieces that do not join exactly.
    pub fn new(dimension: usize, form: Form) -> Result<Curve, CurveError> {
        let check = |place: &dyn Fn() -> String, found: usize| {
            if found == dimension {
                return Ok(());
            }
            let fault = CurveFault::MixedDimensions {
                found,
                expected: dimension,
            };
            Err(CurveError::new(place(), fault))
        };
        match &form {
            Form::BSpline(spline) => check(&|| "points".into(), spline.dimension)?,
            Form::Bezier(pieces) => {
                if pieces.is_empty() {
                    return Err(CurveError::new("pieces", CurveFault::NoPieces));
                }
                if pieces.len() > MAXIMUM_PIECES {
                    let found = pieces.len();
                    return Err(CurveError::new("pieces", CurveFault::TooMany { found }));
                }
                for (i, piece) in pieces.iter().enumerate() {
                    check(&|| format!("pieces[{i}].points"), piece.dimension)?;
                }
                if let Some(i) = pieces.windows(2).position(|p| !joins(&p[0], &p[1])) {
                    let place = format!("pieces[{}].points[0]", i + 1);
                    return Err(CurveError::new(place, CurveFault::Gap));
                }
            }
        }
        Ok(Curve { dimension, form })
    }

    /// Coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The curve's data.
    pub fn form(&self) -> &Form {
        &self.form
    }

    /// Whether the two ends coincide exactly.
    pub fn is_closed(&self) -> bool {
        match &self.form {
            Form::BSpline(spline) => spline.is_closed(),
            Form::Bezier(pieces) => joins(&pieces[pieces.len() - 1], &pieces[0]),
        }
    }

    /// The curve's data, by value.
    pub fn into_form(self) -> Form {
        self.form
    }
}

impl From<BSpline> for Curve {
    fn from(spline: BSpline) -> Curve {
        Curve {
            dimension: spline.dimension,
            form: Form::BSpline(spline),
        }
    }
}

/// Whether `before` ends exactly where `after` starts; both have the same dimension.
pub(super) fn joins(before: &Bezier, after: &Bezier) -> bool {
    let d = before.dimension;
    let last = before.degree * d;
    (0..d).all(|axis| equal(&before.points, last + axis, &after.points, axis))
}

/// Whether number `i` of `a` equals number `j` of `b`, without reducing fractions.
pub(super) fn equal(a: &RationalVector, i: usize, b: &RationalVector, j: usize) -> bool {
    let (p, q) = (&a.numerators()[i], &b.numerators()[j]);
    let (m, n) = (a.denominator(), b.denominator());
    if m == n { p == q } else { p * n == q * m }
}

/// Numbers over a denominator known to be positive.
pub(super) fn over(numerators: Vec<Integer>, denominator: Integer) -> RationalVector {
    RationalVector::from_parts(numerators, denominator).expect("a product of denominators is positive")
}
