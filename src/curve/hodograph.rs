//! The hodograph field of a Bézier piece.

use num_traits::{One, Zero};

use super::homogeneous::Homogeneous;
use super::{Bezier, OperationError};
use crate::number::{Integer, Rational, RationalVector};

/// A polynomial vector field D(u) = Σ D_k B_k(u) that is a positive function times c'(u).
///
/// Polynomial piece of degree n: D_k = P_{k+1} − P_k, degree n − 1, c' = n D. Rational piece: degree 2n − 2, D = w² c',
/// D_k = Σ_i (k − 2i + 1) C(n, i) C(n, k − i + 1) / C(2n − 2, k) · w_i w_{k−i+1} (P_{k−i+1} − P_i), the sum over
/// max(0, k − n + 1) ≤ i ≤ k/2 (Saito, Wang, Sederberg 1995).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hodograph {
    dimension: usize,
    degree: usize,
    coefficients: RationalVector,
}

impl Hodograph {
    /// Coordinates of a vector, 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The degree of the field; there is one coefficient more.
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// The Bernstein coefficients D_k, flat, `dimension` numbers each.
    pub fn coefficients(&self) -> &RationalVector {
        &self.coefficients
    }

    /// The coefficient D_k.
    ///
    /// # Panics
    /// When `k` exceeds the degree.
    pub fn coefficient(&self, k: usize) -> Vec<Rational> {
        (0..self.dimension)
            .map(|axis| self.coefficients.get(k * self.dimension + axis))
            .collect()
    }

    /// The vector D(u), 0 ≤ u ≤ 1.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`].
    pub fn evaluate(&self, u: &Rational) -> Result<Vec<Rational>, OperationError> {
        if *u < Rational::zero() || *u > Rational::one() {
            return Err(OperationError::OutsideDomain);
        }
        let mut points: Vec<Homogeneous> = (0..=self.degree)
            .map(|k| Homogeneous::from_rationals(&self.coefficient(k)))
            .collect();
        for round in 1..=self.degree {
            for j in 0..=self.degree - round {
                points[j] = Homogeneous::mix(u, &points[j], &points[j + 1]);
            }
        }
        Ok(points[0].rationals())
    }
}

impl Bezier {
    /// The hodograph field; by the polynomial formula when all weights are equal.
    pub fn hodograph(&self) -> Hodograph {
        let (d, n) = (self.dimension, self.degree);
        let points = self.points.numerators();
        let (degree, numerators, denominator) = match &self.weights {
            Some(weights) if !self.is_polynomial() => {
                let (numerators, denominator) = rational_field(d, n, points, weights.numerators());
                let squared = weights.denominator() * weights.denominator();
                (2 * n - 2, numerators, denominator * squared)
            }
            _ => {
                let numerators = (0..n * d).map(|j| &points[j + d] - &points[j]).collect();
                (n - 1, numerators, Integer::one())
            }
        };
        Hodograph {
            dimension: d,
            degree,
            coefficients: super::data::over(numerators, denominator * self.points.denominator()),
        }
    }
}

/// The coefficients of the rational field over one denominator, for integer points and weights.
fn rational_field(d: usize, n: usize, points: &[Integer], weights: &[Integer]) -> (Vec<Integer>, Integer) {
    let choose = |n: usize, k: usize| Integer::binomial(n as u32, k as u32);
    let scaled: Vec<Integer> = (0..=n).map(|i| choose(n, i) * &weights[i]).collect();
    let divisors: Vec<Integer> = (0..=2 * n - 2).map(|k| choose(2 * n - 2, k)).collect();
    let denominator = divisors.iter().fold(Integer::ONE, |lcm, divisor| lcm.lcm(divisor));
    let mut numerators = Vec::with_capacity((2 * n - 1) * d);
    for (k, divisor) in divisors.iter().enumerate() {
        let mut sum = vec![Integer::zero(); d];
        for i in (k + 1).saturating_sub(n)..=k / 2 {
            let j = k + 1 - i;
            let factor = Integer::from(j - i) * &scaled[i] * &scaled[j];
            for (axis, x) in sum.iter_mut().enumerate() {
                *x += &factor * (&points[j * d + axis] - &points[i * d + axis]);
            }
        }
        let scale = &denominator / divisor;
        numerators.extend(sum.into_iter().map(|x| x * &scale));
    }
    (numerators, denominator)
}
