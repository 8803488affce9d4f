//! Derivatives of every order.

use num_traits::{One, Zero};

use super::decompose::span_bezier;
use super::homogeneous::Homogeneous;
use super::{BSpline, Bezier, OperationError, Side};
use crate::number::{Integer, Rational};

impl Bezier {
    /// The point and the derivatives with respect to u of orders 1 … `order` at 0 ≤ u ≤ 1: `order + 1` vectors.
    ///
    /// Rational pieces by the recursion of Leibniz' rule (Piegl and Tiller 1997, algorithm A4.2):
    /// c⁽ᵏ⁾ = ((wc)⁽ᵏ⁾ − Σ_{i=1..k} C(k, i) w⁽ⁱ⁾ c⁽ᵏ⁻ⁱ⁾) / w.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`].
    pub fn derivatives(&self, u: &Rational, order: usize) -> Result<Vec<Vec<Rational>>, OperationError> {
        self.check_inside(u)?;
        let lifted = self.homogeneous_derivatives(u, order);
        if self.weights.is_none() {
            return Ok(lifted);
        }
        let d = self.dimension;
        let weight = lifted[0][d].clone();
        let mut result: Vec<Vec<Rational>> = Vec::with_capacity(order + 1);
        for (k, derivative) in lifted.iter().enumerate() {
            let mut vector = derivative[..d].to_vec();
            for i in 1..=k {
                let binomial = Rational::from_integer(Integer::binomial(k as u32, i as u32));
                let factor = binomial * &lifted[i][d];
                for (x, y) in vector.iter_mut().zip(&result[k - i]) {
                    *x -= &factor * y;
                }
            }
            for x in &mut vector {
                *x /= &weight;
            }
            result.push(vector);
        }
        Ok(result)
    }

    /// The derivatives of the homogeneous polynomial piece: n! / (n − k)! times the k-th differences of the control
    /// points, evaluated by de Casteljau's algorithm.
    fn homogeneous_derivatives(&self, u: &Rational, order: usize) -> Vec<Vec<Rational>> {
        let n = self.degree;
        let mut control = self.homogeneous();
        let zero = vec![Rational::zero(); control[0].rationals().len()];
        let mut factor = Rational::one();
        let mut result = Vec::with_capacity(order + 1);
        for k in 0..=order {
            if k > n {
                result.push(zero.clone());
                continue;
            }
            if k > 0 {
                control = control
                    .windows(2)
                    .map(|pair| Homogeneous::difference(&pair[0], &pair[1]))
                    .collect();
                factor *= Rational::from_integer(Integer::from(n + 1 - k));
            }
            let mut points = control.clone();
            for round in 1..points.len() {
                for j in 0..points.len() - round {
                    points[j] = Homogeneous::mix(u, &points[j], &points[j + 1]);
                }
            }
            result.push(points[0].scaled(&factor).rationals());
        }
        result
    }
}

impl BSpline {
    /// The point and the derivatives with respect to t of orders 1 … `order` at the domain parameter `t`, from the given
    /// side where t is a knot: `order + 1` vectors.
    ///
    /// At an end of the domain both sides mean the inner one.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`].
    pub fn derivatives(&self, t: &Rational, side: Side, order: usize) -> Result<Vec<Vec<Rational>>, OperationError> {
        let k = self.span(t, side)?;
        let (start, end) = (self.knots.get(k), self.knots.get(k + 1));
        let length = end - &start;
        let piece = span_bezier(self, k);
        let mut result = piece.derivatives(&((t - start) / &length), order)?;
        let mut factor = Rational::one();
        for vector in &mut result {
            for x in vector {
                *x *= &factor;
            }
            factor /= &length;
        }
        Ok(result)
    }
}
