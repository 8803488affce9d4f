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
    /// c⁽ᵏ⁾ = ((wc)⁽ᵏ⁾ − Σ_{i=1..k} C(k, i) w⁽ⁱ⁾ c⁽ᵏ⁻ⁱ⁾) / w.
    pub(super) fn double_derivatives(&self, t: f64, side: Side, order: usize) -> Result<Vec<[Double; 3]>, FloatError> {
        if order > MAXIMUM_ORDER {
            return Err(FloatError::Argument {
                expected: "an order of at most 64",
            });
        }
        let k = self.span(t, side)?;
        let lifted = self.lifted_derivatives(k, t, order);
        let mut result: Vec<[Double; 3]> = Vec::with_capacity(order + 1);
        for (m, derivative) in lifted.iter().enumerate() {
            let mut vector = [derivative[0], derivative[1], derivative[2]];
            if self.weights.is_some() {
                let mut binomial = Double::ONE;
                for i in 1..=m {
                    binomial = binomial.times((m + 1 - i) as f64) / Double::from(i as f64);
                    let factor = binomial * lifted[i][3];
                    for axis in 0..3 {
                        vector[axis] = vector[axis] - factor * result[m - i][axis];
                    }
                }
                vector = vector.map(|x| x / lifted[0][3]);
            }
            result.push(vector);
        }
        Ok(result)
    }

    /// The derivatives of (wc, w) on span k: differences of control points over the knots they act on, summed by de Boor's algorithm. Unlike
    /// differences of the Bézier points of a span these stay accurate on spans of one unit in the last place.
    pub(super) fn lifted_derivatives(&self, k: usize, t: f64, order: usize) -> Vec<Lifted> {
        if self.degree < 8 {
            self.lifted_derivatives_in(k, t, order, [[Double::ZERO; 4]; 8])
        } else {
            self.lifted_derivatives_in(k, t, order, [[Double::ZERO; 4]; MAXIMUM_DEGREE + 1])
        }
    }

    fn lifted_derivatives_in<const SIZE: usize>(
        &self,
        k: usize,
        t: f64,
        order: usize,
        mut coefficients: [Lifted; SIZE],
    ) -> Vec<Lifted> {
        let p = self.degree;
        for (j, row) in coefficients[..=p].iter_mut().enumerate() {
            *row = self.lifted(k - p + j);
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

pub(super) fn finite(vector: [f64; 3]) -> Result<[f64; 3], FloatError> {
    if vector.iter().all(|x| x.is_finite()) {
        Ok(vector)
    } else {
        Err(FloatError::Range { place: "result" })
    }
}
