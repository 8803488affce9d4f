//! One polynomial piece prepared for evaluation, its degree and dimension known to the compiler.

use super::curve::Curve;
use super::error::FloatError;
use super::taylor::{compensated, horner};

/// A polynomial curve of one span, prepared for evaluation, of degree `ORDER` − 1 up to 7 with `DIMENSION` coordinates: as accurate as an
/// [`Evaluator`](super::Evaluator) and faster, because nothing about the curve has to be looked up.
/// ```
/// use knotproof::float::{BezierEvaluator, Curve};
///
/// let knots = vec![0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0];
/// let curve = Curve::new(2, 3, knots, vec![1.0, 1.0, 2.0, 4.0, 5.0, -1.0, 6.0, 3.0], None)?;
/// let cubic = BezierEvaluator::<4, 2>::new(&curve)?;
/// assert_eq!(cubic.point(0.5)?, [3.5, 1.625]);
/// # Ok::<(), knotproof::float::FloatError>(())
/// ```
pub struct BezierEvaluator<const ORDER: usize, const DIMENSION: usize> {
    middle: f64,
    start: f64,
    end: f64,
    /// Parameters no farther from the middle are inside the domain, whatever rounding does.
    reach: f64,
    threshold: f64,
    high: [[f64; DIMENSION]; ORDER],
    careful: Box<Careful>,
}

/// What is needed near the origin.
struct Careful {
    curve: Curve,
    span: usize,
    high: Vec<[f64; 4]>,
    low: Vec<[f64; 4]>,
    threshold: f64,
}

/// Points that a batch computes together.
const CHUNK: usize = 16;

impl<const ORDER: usize, const DIMENSION: usize> BezierEvaluator<ORDER, DIMENSION> {
    /// Prepares a curve, which may also be one span with unclamped knots.
    ///
    /// # Errors
    /// [`FloatError::Argument`] when the curve has another degree, another dimension, several spans or weights, or `ORDER` exceeds 8.
    pub fn new(curve: &Curve) -> Result<BezierEvaluator<ORDER, DIMENSION>, FloatError> {
        let fits = ORDER <= 8
            && curve.degree + 1 == ORDER
            && curve.dimension == DIMENSION
            && curve.count() == ORDER
            && curve.weights.is_none();
        if !fits {
            return Err(FloatError::Argument {
                expected: "a polynomial curve of one span, of this degree up to 7 and this dimension",
            });
        }
        let span = curve.degree;
        let taylor = curve.taylor(span);
        let (start, end) = curve.domain();
        // Subtraction is monotone: what is less than these differences comes from a parameter between the ends.
        let reach = (taylor.middle - start).min(end - taylor.middle).next_down();
        let mut high = [[0.0; DIMENSION]; ORDER];
        for (to, from) in high.iter_mut().zip(&taylor.high) {
            to.copy_from_slice(&from[..DIMENSION]);
        }
        Ok(BezierEvaluator {
            middle: taylor.middle,
            start,
            end,
            reach,
            threshold: taylor.threshold,
            high,
            careful: Box::new(Careful {
                curve: curve.clone(),
                span,
                high: taylor.high,
                low: taylor.low,
                threshold: taylor.compensated_threshold,
            }),
        })
    }

    /// The point c(t), t in the domain.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`].
    #[inline]
    pub fn point(&self, t: f64) -> Result<[f64; DIMENSION], FloatError> {
        // NaN is outside.
        if !(self.start <= t && t <= self.end) {
            return Err(FloatError::OutsideDomain);
        }
        let point = horner(&self.high, t - self.middle);
        if greatest(&point) >= self.threshold {
            return Ok(point);
        }
        Ok(self.carefully(t))
    }

    /// The points at many parameters.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`] for the first parameter outside, and [`FloatError::Argument`] when `points` has another length; `points` is then
    /// unspecified.
    pub fn points_at(&self, parameters: &[f64], points: &mut [[f64; DIMENSION]]) -> Result<(), FloatError> {
        if parameters.len() != points.len() {
            return Err(FloatError::Argument {
                expected: "room for as many points as there are parameters",
            });
        }
        let (middle, reach, threshold, high) = (self.middle, self.reach, self.threshold, self.high);
        let (chunks, rest) = parameters.as_chunks::<CHUNK>();
        let (point_chunks, last) = points.as_chunks_mut::<CHUNK>();
        for (chunk, found) in chunks.iter().zip(point_chunks) {
            let mut doubtful = 0;
            for (t, point) in chunk.iter().zip(found.iter_mut()) {
                let u = t - middle;
                *point = horner(&high, u);
                // NaN is neither less nor greater.
                let inside = u.abs() <= reach;
                let accurate = greatest(point) >= threshold;
                doubtful |= u32::from(!inside) | u32::from(!accurate);
            }
            if doubtful != 0 {
                self.one_by_one(chunk, found)?;
            }
        }
        self.one_by_one(rest, last)
    }

    fn one_by_one(&self, parameters: &[f64], points: &mut [[f64; DIMENSION]]) -> Result<(), FloatError> {
        for (t, point) in parameters.iter().zip(points) {
            *point = self.point(*t)?;
        }
        Ok(())
    }

    /// By the compensated scheme, or else in double-double.
    #[cold]
    #[inline(never)]
    fn carefully(&self, t: f64) -> [f64; DIMENSION] {
        let careful = &self.careful;
        let sum = compensated::<4>(&careful.high, &careful.low, self.middle, t);
        let point = std::array::from_fn(|axis| sum[axis]);
        if greatest(&point) >= careful.threshold {
            return point;
        }
        let point = careful.curve.exact_point(careful.span, t);
        std::array::from_fn(|axis| point[axis])
    }
}

#[inline(always)]
fn greatest<const D: usize>(point: &[f64; D]) -> f64 {
    let mut most = point[0].abs();
    for x in &point[1..] {
        most = if x.abs() > most { x.abs() } else { most };
    }
    most
}
