//! A curve in binary64.

use super::double::Double;
use super::error::FloatError;
use crate::curve::{self, BSpline, Bezier, CurveError, CurveFault, Form, MAXIMUM_DEGREE, MAXIMUM_PIECES};
use crate::number::RationalVector;

/// Magnitudes of coordinates, weights and knots lie within 2^±`EXPONENT`, so that their products neither overflow nor lose digits.
const EXPONENT: i32 = 300;

/// A homogeneous control point (w P, w), with z = 0 in the plane.
pub(super) type Lifted = [Double; 4];

/// A B-spline or NURBS curve in the plane or in space with binary64 numbers, taken as exact.
///
/// Degree p, knots t_0 ≤ … ≤ t_{n+p}, n affine control points and positive weights or none; the domain is [t_p, t_n]. A Bézier piece has the
/// knots 0 and 1, p + 1 times each. Knots may be clamped, unclamped and of every multiplicity up to p (p + 1 at the ends of the domain).
/// ```
/// use knotproof::float::Curve;
///
/// let curve = Curve::new(2, 2, vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], vec![1.0, 0.0, 1.0, 1.0, 0.0, 1.0], Some(vec![1.0, 1.0, 2.0]))?;
/// assert_eq!(curve.point(0.5)?, [0.6, 0.8, 0.0]);
/// # Ok::<(), knotproof::float::FloatError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    pub(super) dimension: usize,
    pub(super) degree: usize,
    pub(super) knots: Vec<f64>,
    pub(super) points: Vec<f64>,
    pub(super) weights: Option<Vec<f64>>,
}

impl Curve {
    /// A curve of `dimension` (2 or 3) coordinates and degree 1 to 64, with the flat affine control points `points`, n + `degree` + 1 knots and
    /// n positive weights.
    ///
    /// # Errors
    /// [`FloatError::Curve`] for every fault an exact curve can have; [`FloatError::Range`] for numbers that are not finite or that leave the range
    /// 2^±300 (zeros excepted; a coordinate may be smaller if another one is not), the knots taken relative to the domain.
    pub fn new(
        dimension: usize,
        degree: usize,
        knots: Vec<f64>,
        points: Vec<f64>,
        weights: Option<Vec<f64>>,
    ) -> Result<Curve, FloatError> {
        let fault = |place: &str, fault| Err(FloatError::Curve(CurveError::new(place, fault)));
        if degree == 0 || degree > MAXIMUM_DEGREE {
            return fault("degree", CurveFault::Degree { found: degree });
        }
        if dimension != 2 && dimension != 3 {
            return fault("points", CurveFault::Dimension { found: dimension });
        }
        let count = points.len() / dimension;
        if !points.len().is_multiple_of(dimension) {
            let (found, expected) = (points.len() % dimension, dimension);
            return fault("points", CurveFault::MixedDimensions { found, expected });
        }
        if count < degree + 1 {
            let (found, expected) = (count, degree + 1);
            return fault("points", CurveFault::PointCount { found, expected });
        }
        if count > MAXIMUM_PIECES {
            return fault("points", CurveFault::TooMany { found: count });
        }
        if knots.len() != count + degree + 1 {
            let (found, expected) = (knots.len(), count + degree + 1);
            return fault("knots", CurveFault::KnotCount { found, expected });
        }
        if let Some(weights) = &weights {
            if weights.len() != count {
                let (found, expected) = (weights.len(), count);
                return fault("weights", CurveFault::WeightCount { found, expected });
            }
            if let Some(k) = weights.iter().position(|w| *w <= 0.0) {
                return fault(&format!("weights[{k}]"), CurveFault::NonPositiveWeight);
            }
            check_range("weights", weights, true)?;
        }
        check_range("knots", &knots, false)?;
        check_range("points", &points, false)?;
        check_knots(degree, count, &knots)?;
        Ok(Curve {
            dimension,
            degree,
            knots,
            points,
            weights,
        })
    }

    /// The exact curve with every number rounded to the nearest binary64 number.
    ///
    /// A chain of M Bézier pieces becomes one spline with the knots 0, 1, …, M: pieces are elevated to one degree and their weights scaled to agree
    /// at the joints, both exactly, before anything is rounded.
    ///
    /// # Errors
    /// As for [`Curve::new`]: numbers may be out of range, and distinct knots may round to the same number.
    pub fn from_exact(exact: &curve::Curve) -> Result<Curve, FloatError> {
        match exact.form() {
            Form::BSpline(spline) => Curve::from_spline(spline),
            Form::Bezier(pieces) => Curve::from_pieces(exact.dimension(), pieces),
        }
    }

    /// A single exact spline with every number rounded to the nearest binary64 number.
    ///
    /// # Errors
    /// As for [`Curve::from_exact`].
    pub fn from_spline(spline: &BSpline) -> Result<Curve, FloatError> {
        Curve::new(
            spline.dimension(),
            spline.degree(),
            spline.knots().to_f64s(),
            spline.points().to_f64s(),
            spline.weights().map(RationalVector::to_f64s),
        )
    }

    fn from_pieces(dimension: usize, pieces: &[Bezier]) -> Result<Curve, FloatError> {
        let rational = pieces.iter().any(|piece| !piece.is_polynomial());
        let (degree, aligned) = curve::align(pieces);
        let mut knots = vec![0.0; degree + 1];
        let (mut points, mut weights) = (Vec::new(), Vec::new());
        for (i, aligned) in aligned.enumerate() {
            // To the degree asked for there is always a way: it is the greatest one of a valid piece.
            let aligned = aligned.map_err(|_| FloatError::Degree { degree })?;
            let first = usize::from(i > 0);
            points.extend_from_slice(&aligned.piece.points().to_f64s()[first * dimension..]);
            weights.extend_from_slice(&RationalVector::from_rationals(&aligned.weights).to_f64s()[first..]);
            let last = i + 1 == pieces.len();
            knots.extend(std::iter::repeat_n((i + 1) as f64, degree + usize::from(last)));
        }
        Curve::new(dimension, degree, knots, points, rational.then_some(weights))
    }

    /// Coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The degree p, 1 to 64.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The number n of control points.
    pub fn count(&self) -> usize {
        self.points.len() / self.dimension
    }

    /// The knots, n + p + 1 of them, non-decreasing.
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// The affine control points, flat, `dimension` numbers each.
    pub fn points(&self) -> &[f64] {
        &self.points
    }

    /// The weights, one a control point, or nothing for a polynomial curve.
    pub fn weights(&self) -> Option<&[f64]> {
        self.weights.as_deref()
    }

    /// The two ends t_p < t_n of the parameter range.
    pub fn domain(&self) -> (f64, f64) {
        (self.knots[self.degree], self.knots[self.count()])
    }

    /// Control point i as (w P, w), exact to 2^-100.
    #[inline]
    pub(super) fn lifted(&self, i: usize) -> Lifted {
        let mut lifted = [Double::ZERO; 4];
        let point = &self.points[i * self.dimension..(i + 1) * self.dimension];
        match &self.weights {
            None => {
                for (to, x) in lifted.iter_mut().zip(point) {
                    *to = Double::from(*x);
                }
                lifted[3] = Double::ONE;
            }
            Some(weights) => {
                for (to, x) in lifted.iter_mut().zip(point) {
                    *to = Double::product(*x, weights[i]);
                }
                lifted[3] = Double::from(weights[i]);
            }
        }
        lifted
    }

    /// The same seen from `origin`: (w (P − origin), w).
    pub(super) fn lifted_from(&self, i: usize, origin: &[f64; 3]) -> Lifted {
        let weight = self.weights.as_ref().map_or(1.0, |weights| weights[i]);
        let mut lifted = [Double::ZERO; 4];
        let point = &self.points[i * self.dimension..(i + 1) * self.dimension];
        for ((to, x), origin) in lifted.iter_mut().zip(point).zip(origin) {
            *to = Double::difference(*x, *origin).times(weight);
        }
        lifted[3] = Double::from(weight);
        lifted
    }

    /// Control points of a range of indices.
    pub(super) fn lifted_range(&self, range: std::ops::Range<usize>) -> Vec<Lifted> {
        range.map(|i| self.lifted(i)).collect()
    }

    /// A curve like this one with other knots and control points, each rounded once.
    pub(super) fn with(&self, degree: usize, knots: Vec<f64>, control: &[Lifted]) -> Result<Curve, FloatError> {
        let mut points = Vec::with_capacity(control.len() * self.dimension);
        let mut weights = self.weights.as_ref().map(|_| Vec::with_capacity(control.len()));
        for lifted in control {
            self.lower(lifted, &mut points, weights.as_mut());
        }
        let result = Curve {
            dimension: self.dimension,
            degree,
            knots,
            points,
            weights,
        };
        result.in_range()
    }

    /// The nearest affine point and weight, appended.
    pub(super) fn lower(&self, lifted: &Lifted, points: &mut Vec<f64>, weights: Option<&mut Vec<f64>>) {
        match weights {
            None => points.extend(lifted[..self.dimension].iter().map(|x| x.value())),
            Some(weights) => {
                points.extend(lifted[..self.dimension].iter().map(|x| (*x / lifted[3]).value()));
                weights.push(lifted[3].value());
            }
        }
    }

    /// Refuses a result that left the range of binary64.
    pub(super) fn in_range(self) -> Result<Curve, FloatError> {
        let weights = self.weights.iter().flatten();
        if self.points.iter().chain(weights).all(|x| x.is_finite()) {
            Ok(self)
        } else {
            Err(FloatError::Range { place: "result" })
        }
    }

    /// The greatest magnitude of a coordinate.
    pub(super) fn magnitude(&self) -> f64 {
        self.points.iter().fold(0.0, |most, x| most.max(x.abs()))
    }
}

impl Curve {
    /// p becomes v p + u q, in the coordinates that the curve has; the others are 0, or a weight of 1 that stays.
    #[inline(always)]
    pub(super) fn mix_into(&self, v: Double, p: &mut Lifted, u: Double, q: &Lifted) {
        for axis in 0..self.dimension {
            p[axis] = v * p[axis] + u * q[axis];
        }
        if self.weights.is_some() {
            p[3] = v * p[3] + u * q[3];
        }
    }
}

/// v p + u q.
#[inline(always)]
pub(super) fn mix(v: Double, p: &Lifted, u: Double, q: &Lifted) -> Lifted {
    std::array::from_fn(|i| v * p[i] + u * q[i])
}

/// The two parts (t − low)/(high − low) and (high − t)/(high − low) of an interval, both to full relative accuracy; low < high.
#[inline(always)]
pub(super) fn parts(low: f64, t: f64, high: f64) -> (Double, Double) {
    let length = Double::difference(high, low);
    (
        Double::difference(t, low) / length,
        Double::difference(high, t) / length,
    )
}

/// Finite and, where not zero, not far from 1. Of coordinates and knots only the greatest counts, of weights each.
fn check_range(place: &'static str, numbers: &[f64], each: bool) -> Result<(), FloatError> {
    let (least, most) = (2f64.powi(-EXPONENT), 2f64.powi(EXPONENT));
    // Not comparing true, NaN is refused.
    let fits = |x: f64| x == 0.0 || (least..=most).contains(&x.abs());
    let all = if each {
        numbers.iter().all(|x| fits(*x))
    } else {
        let greatest = numbers.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        numbers.iter().all(|x| x.is_finite()) && fits(greatest)
    };
    if all { Ok(()) } else { Err(FloatError::Range { place }) }
}

/// Order and multiplicities of the knots.
fn check_knots(degree: usize, count: usize, knots: &[f64]) -> Result<(), FloatError> {
    let fault = |place: String, fault| Err(FloatError::Curve(CurveError::new(place, fault)));
    if let Some(k) = knots.windows(2).position(|pair| pair[1] < pair[0]) {
        return fault(format!("knots[{}]", k + 1), CurveFault::DecreasingKnots);
    }
    let (start, end) = (knots[degree], knots[count]);
    if start == end {
        return fault("knots".into(), CurveFault::EmptyDomain);
    }
    let mut first = 0;
    for run in knots.chunk_by(|a, b| a == b) {
        let (knot, multiplicity) = (run[0], run.len());
        let found = if start < knot && knot < end && multiplicity > degree {
            Some(CurveFault::InteriorMultiplicity { multiplicity, degree })
        } else if multiplicity > degree + 1 {
            Some(CurveFault::EndMultiplicity { multiplicity, degree })
        } else {
            None
        };
        if let Some(found) = found {
            return fault(format!("knots[{first}]"), found);
        }
        first += multiplicity;
    }
    // Differences of knots are divided by, up to the power of the degree.
    let least = 2f64.powi(-EXPONENT);
    let shortest = knots[degree..=count]
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .filter(|length| *length > 0.0)
        .fold(f64::INFINITY, f64::min);
    if shortest < least {
        return Err(FloatError::Range { place: "knots" });
    }
    Ok(())
}
