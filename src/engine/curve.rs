//! A curve in binary64.

use super::FileError;
use crate::curve::BSpline;
use crate::number::{Rational, RationalExt, RationalVector};

/// A B-spline or NURBS curve in binary64, as an engine gets and returns it.
///
/// It need not be a curve at all: [`FloatCurve::exact`] finds out.
#[derive(Debug, Clone, PartialEq)]
pub struct FloatCurve {
    /// The degree p.
    pub degree: usize,
    /// The knots, points + p + 1 of them.
    pub knots: Vec<f64>,
    /// The affine control points.
    pub points: Vec<Vec<f64>>,
    /// One weight a control point; nothing for a polynomial curve.
    pub weights: Option<Vec<f64>>,
}

impl FloatCurve {
    /// The exact curve of these numbers.
    ///
    /// # Errors
    /// What keeps them from being a curve, with its path inside the curve.
    pub fn exact(&self) -> Result<BSpline, FileError> {
        let dimension = self.points.first().map_or(0, Vec::len);
        if let Some(k) = self.points.iter().position(|point| point.len() != dimension) {
            let found = self.points[k].len();
            let what = format!("found {found} coordinates, expected {dimension} as in the first point");
            return Err(FileError::new(format!("points[{k}]"), what));
        }
        let knots = exact_numbers("knots", &self.knots)?;
        let points = exact_numbers("points", &self.points.concat())?;
        let weights = match &self.weights {
            Some(weights) => Some(exact_numbers("weights", weights)?),
            None => None,
        };
        BSpline::new(dimension, self.degree, knots, points, weights)
            .map_err(|error| FileError::new(error.place, error.fault.to_string()))
    }

    /// Every number of a curve rounded to the nearest binary64.
    pub fn rounded(spline: &BSpline) -> FloatCurve {
        FloatCurve {
            degree: spline.degree(),
            knots: spline.knots().to_f64s(),
            points: spline
                .points()
                .to_f64s()
                .chunks(spline.dimension())
                .map(<[f64]>::to_vec)
                .collect(),
            weights: spline.weights().map(RationalVector::to_f64s),
        }
    }

    /// The curve in binary64 when all its numbers are.
    pub fn representing(spline: &BSpline) -> Option<FloatCurve> {
        let curve = FloatCurve::rounded(spline);
        (curve.exact().as_ref() == Ok(spline)).then_some(curve)
    }

    /// A Bézier curve on [0, 1].
    pub fn bezier(points: Vec<Vec<f64>>, weights: Option<Vec<f64>>) -> FloatCurve {
        let order = points.len();
        let mut knots = vec![0.0; order];
        knots.extend(vec![1.0; order]);
        FloatCurve {
            degree: order.saturating_sub(1),
            knots,
            points,
            weights,
        }
    }

    /// Whether the knots are those of a Bézier curve on [0, 1].
    pub fn is_bezier(&self) -> bool {
        let order = self.points.len();
        self.degree + 1 == order
            && self.knots.len() == 2 * order
            && self.knots[..order].iter().all(|t| *t == 0.0)
            && self.knots[order..].iter().all(|t| *t == 1.0)
    }

    /// Whether the first and the last p + 1 knots are equal.
    pub fn is_clamped(&self) -> bool {
        let (p, count) = (self.degree, self.knots.len());
        let all = |knots: &[f64]| knots.windows(2).all(|pair| pair[0] == pair[1]);
        count > p && all(&self.knots[..=p]) && all(&self.knots[count - p - 1..])
    }

    /// Coordinates of the first point; 0 without points.
    pub fn dimension(&self) -> usize {
        self.points.first().map_or(0, Vec::len)
    }
}

fn exact_numbers(place: &str, numbers: &[f64]) -> Result<RationalVector, FileError> {
    let mut exact = Vec::with_capacity(numbers.len());
    for (k, number) in numbers.iter().enumerate() {
        match Rational::from_f64(*number) {
            Some(number) => exact.push(number),
            None => {
                let what = format!("found {number}, expected a finite number");
                return Err(FileError::new(format!("{place}[{k}]"), what));
            }
        }
    }
    Ok(RationalVector::from_rationals(&exact))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_curve_is_told() {
        let line = FloatCurve::bezier(vec![vec![0.0, 1.0], vec![2.0, 3.0]], None);
        assert!(line.exact().is_ok() && line.is_bezier() && line.is_clamped());
        let mut broken = line.clone();
        broken.knots[1] = f64::NAN;
        assert!(broken.exact().unwrap_err().to_string().contains("knots[1]: found NaN"));
        let mut broken = line.clone();
        broken.points[1].push(0.0);
        assert_eq!(broken.exact().unwrap_err().path, "points[1]");
        let mut broken = line.clone();
        broken.points.clear();
        assert!(broken.exact().is_err());
        let mut broken = line;
        broken.weights = Some(vec![1.0, 0.0]);
        assert_eq!(broken.exact().unwrap_err().path, "weights[1]");
    }

    #[test]
    fn only_what_binary64_holds_is_represented() {
        let third = Rational::new(1.into(), 3.into());
        let zero = Rational::from_integer(0.into());
        let points =
            |x: &Rational| RationalVector::from_rationals(&[zero.clone(), zero.clone(), x.clone(), zero.clone()]);
        let one = Rational::from_integer(1.into());
        let knots = RationalVector::from_rationals(&[zero.clone(), zero.clone(), one.clone(), one.clone()]);
        let curve = BSpline::new(2, 1, knots.clone(), points(&third), None).unwrap();
        assert_eq!(FloatCurve::representing(&curve), None);
        let curve = BSpline::new(2, 1, knots, points(&one), None).unwrap();
        assert!(FloatCurve::representing(&curve).is_some());
    }
}
