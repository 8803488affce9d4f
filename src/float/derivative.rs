//! Derivatives of every order, in double-double.

use super::curve::{Curve, Lifted};
use super::double::Double;
use super::error::FloatError;
use crate::curve::{MAXIMUM_DEGREE, Side};

/// The highest order offered.
pub const MAXIMUM_ORDER: usize = 64;

impl Curve {
    /// The derivative of order `order` (0 to 64) with respect to t at the domain parameter `t`, from the given side where t is a knot; at an end of
    /// the domain both sides mean the inner one. z = 0 in the plane.
    ///
    /// # Errors
    /// [`FloatError::OutsideDomain`], [`FloatError::Argument`] for an order above [`MAXIMUM_ORDER`], [`FloatError::Range`] when the result is not finite.
    pub fn derivative(&self, t: f64, side: Side, order: usize) -> Result<[f64; 3], FloatError> {
        let all = self.double_derivatives(t, side, order)?;
        finite(all[order].map(Double::value))
    }

    /// The point and the derivatives of orders 1 … `order`: `order` + 1 vectors.
    ///
    /// # Errors
    /// As for [`Curve::derivative`].
    pub fn derivatives(&self, t: f64, side: Side, order: usize) -> Result<Vec<[f64; 3]>, FloatError> {
        let all = self.double_derivatives(t, side, order)?;
        all.iter().map(|vector| finite(vector.map(Double::value))).collect()
    }

    /// The same in double-double. Rational curves by the recursion of Leibniz' rule (Piegl and Tiller 1997, algorithm A4.2):
    /// c⁽ᵏ⁾ = ((wc)⁽ᵏ⁾ − Σ_{i=1..k} C(k, i) w⁽ⁱ⁾ c⁽ᵏ⁻ⁱ⁾) / w. Derivatives do not change when the curve is moved, so this is done on the curve with its
    /// point at t, rounded, in the origin: where control points coincide, nothing is left that would have to cancel.
    pub(super) fn double_derivatives(&self, t: f64, side: Side, order: usize) -> Result<Vec<[Double; 3]>, FloatError> {
        if order > MAXIMUM_ORDER {
            return Err(FloatError::Argument {
                expected: "an order of at most 64",
            });
        }
        let k = self.span(t, side)?;
        if self.weights.is_none() {
            let lifted = self.lifted_derivatives(k, t, order, &[0.0; 3]);
            return Ok(lifted.iter().map(|[x, y, z, _]| [*x, *y, *z]).collect());
        }
        let origin = self.exact_point(k, t);
        let lifted = self.lifted_derivatives(k, t, order, &origin);
        let mut result: Vec<[Double; 3]> = Vec::with_capacity(order + 1);
        for (m, derivative) in lifted.iter().enumerate() {
            let mut vector = [derivative[0], derivative[1], derivative[2]];
            let mut binomial = Double::ONE;
            for i in 1..=m {
                binomial = binomial.times((m + 1 - i) as f64) / Double::from(i as f64);
                let factor = binomial * lifted[i][3];
                for axis in 0..3 {
                    vector[axis] = vector[axis] - factor * result[m - i][axis];
                }
            }
            result.push(vector.map(|x| x / lifted[0][3]));
        }
        for (x, origin) in result[0].iter_mut().zip(origin) {
            *x = *x + Double::from(origin);
        }
        Ok(result)
    }

    /// Bounds of the errors of each coordinate of the derivatives of orders 0 … `order` that [`Curve::double_derivatives`] gives.
    ///
    /// With T the sum of the magnitudes of all terms that are added up on the way to a number, it has an error of at most a few units of 2⁻¹⁰⁴ T for each of the p
    /// rounds of de Boor's algorithm, of the differences and of the terms of Leibniz' rule; (p + 8) (m + 1) 2⁻¹⁰⁰ T for order m has room for that. T comes from
    /// the same formulas with magnitudes in place of numbers and sums in place of differences. The first differences of a polynomial curve are exact.
    pub(super) fn derivative_errors(&self, t: f64, side: Side, order: usize) -> Result<Vec<f64>, FloatError> {
        let (k, p, d) = (self.span(t, side)?, self.degree, self.dimension);
        let (mut terms, mut weights) = ([0.0; MAXIMUM_DEGREE + 1], [0.0; MAXIMUM_DEGREE + 1]);
        let mut weight = 1.0;
        if let Some(all) = &self.weights {
            let lifted = self.lifted_point(k, t);
            let origin = self.affine(&lifted).map(Double::value);
            weight = lifted[3].value();
            for (j, i) in (k - p..=k).enumerate() {
                terms[j] = all[i] * farthest(&self.points[i * d..(i + 1) * d], &origin);
                weights[j] = all[i];
            }
        }
        let (mut bounds, mut factors) = (vec![0.0; order + 1], vec![0.0; order + 1]);
        for m in 0..=order {
            if m > 0 && m <= p {
                let degree = p - m;
                for j in 0..=degree {
                    let factor = (degree + 1) as f64 / (self.knots[k + 1 + j] - self.knots[k - degree + j]);
                    terms[j] = factor
                        * if m == 1 && self.weights.is_none() {
                            let (one, other) = self.points[(k - p + j) * d..(k - p + j + 2) * d].split_at(d);
                            farthest(one, other)
                        } else {
                            terms[j] + terms[j + 1]
                        };
                    weights[j] = factor * (weights[j] + weights[j + 1]);
                }
            }
            if m <= p {
                factors[m] = self.combination(k, t, m, weights);
                bounds[m] = self.combination(k, t, m, terms);
            }
            let mut binomial = 1.0;
            for i in 1..=m {
                binomial *= (m + 1 - i) as f64 / i as f64;
                bounds[m] += binomial * factors[i] * bounds[m - i];
            }
            bounds[m] /= weight;
        }
        let unit = (p + 8) as f64 / (1_u128 << 100) as f64;
        Ok(bounds
            .iter()
            .enumerate()
            .map(|(m, bound)| (m + 1) as f64 * unit * bound)
            .collect())
    }

    /// De Boor's algorithm for the derivative of order `order`, in binary64, on coefficients that are not negative.
    fn combination(&self, k: usize, t: f64, order: usize, mut row: [f64; MAXIMUM_DEGREE + 1]) -> f64 {
        let degree = self.degree - order;
        for round in 1..=degree {
            for j in 0..=degree - round {
                let i = k - degree + j + round;
                let (low, high) = (self.knots[i], self.knots[i + degree + 1 - round]);
                let length = high - low;
                row[j] = (high - t) / length * row[j] + (t - low) / length * row[j + 1];
            }
        }
        row[0]
    }

    /// The derivatives of (wc, w), c seen from `origin`, on span k: differences of control points over the knots they act on, summed by de Boor's algorithm. Unlike
    /// differences of the Bézier points of a span these stay accurate on spans of one unit in the last place.
    pub(super) fn lifted_derivatives(&self, k: usize, t: f64, order: usize, origin: &[f64; 3]) -> Vec<Lifted> {
        if self.degree < 8 {
            self.lifted_derivatives_in(k, t, order, origin, [[Double::ZERO; 4]; 8])
        } else {
            self.lifted_derivatives_in(k, t, order, origin, [[Double::ZERO; 4]; MAXIMUM_DEGREE + 1])
        }
    }

    fn lifted_derivatives_in<const SIZE: usize>(
        &self,
        k: usize,
        t: f64,
        order: usize,
        origin: &[f64; 3],
        mut coefficients: [Lifted; SIZE],
    ) -> Vec<Lifted> {
        let p = self.degree;
        for (j, row) in coefficients[..=p].iter_mut().enumerate() {
            *row = self.lifted_from(k - p + j, origin);
        }
        let mut result = Vec::with_capacity(order + 1);
        for m in 0..=order {
            if m > p {
                result.push([Double::ZERO; 4]);
                continue;
            }
            if m > 0 {
                let degree = p - m;
                for j in 0..=degree {
                    // Coefficient k − degree + j of the derivative acts from knot k − degree + j on.
                    let low = self.knots[k - degree + j];
                    let high = self.knots[k + 1 + j];
                    let factor = Double::from((degree + 1) as f64) / Double::difference(high, low);
                    for axis in 0..4 {
                        coefficients[j][axis] = (coefficients[j + 1][axis] - coefficients[j][axis]) * factor;
                    }
                }
            }
            let mut rows = coefficients;
            self.de_boor(k, t, m, &mut rows);
            result.push(rows[0]);
        }
        result
    }
}

/// The greatest difference of coordinates.
fn farthest(one: &[f64], other: &[f64]) -> f64 {
    one.iter()
        .zip(other)
        .fold(0.0, |most: f64, (x, y)| most.max((x - y).abs()))
}

pub(super) fn finite(vector: [f64; 3]) -> Result<[f64; 3], FloatError> {
    if vector.iter().all(|x| x.is_finite()) {
        Ok(vector)
    } else {
        Err(FloatError::Range { place: "result" })
    }
}
