//! Blossoms: the symmetric multi-affine form of a polynomial curve (Ramshaw 1987).

use num_traits::{One, Zero};

use super::homogeneous::Homogeneous;
use super::{BSpline, Bezier, OperationError, Side, evaluate};
use crate::number::Rational;

impl Bezier {
    /// The blossom of the homogeneous piece at the n `arguments`, any rationals: (w X, w), or X alone without weights.
    ///
    /// Control point k is weighted with the sum, over the k-element subsets S of the arguments, of
    /// Π_{i in S} u_i · Π_{i not in S} (1 − u_i). The formula shares nothing with de Casteljau's algorithm.
    ///
    /// # Panics
    /// When the number of arguments is not the degree.
    pub fn blossom(&self, arguments: &[Rational]) -> Vec<Rational> {
        self.blossom_point(arguments).rationals()
    }

    pub(super) fn blossom_point(&self, arguments: &[Rational]) -> Homogeneous {
        assert_eq!(arguments.len(), self.degree, "one argument a degree");
        // Coefficients of Π ((1 − u_i) + u_i z).
        let mut factors = vec![Rational::one()];
        for u in arguments {
            let v = Rational::one() - u;
            let mut next = vec![Rational::zero(); factors.len() + 1];
            for (k, factor) in factors.iter().enumerate() {
                next[k] += factor * &v;
                next[k + 1] += factor * u;
            }
            factors = next;
        }
        let mut terms = self.homogeneous().into_iter().zip(&factors);
        let (point, factor) = terms.next().expect("a piece has control points");
        terms.fold(point.scaled(factor), |sum, (point, factor)| {
            Homogeneous::sum(&sum, &point.scaled(factor))
        })
    }
}

impl BSpline {
    /// The blossom, at p `arguments`, of the homogeneous polynomial piece on the given side of the domain parameter `t`.
    ///
    /// At p consecutive knots around that piece it is the homogeneous control point there.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`] when `t` is.
    ///
    /// # Panics
    /// When the number of arguments is not the degree.
    pub fn blossom(&self, t: &Rational, side: Side, arguments: &[Rational]) -> Result<Vec<Rational>, OperationError> {
        assert_eq!(arguments.len(), self.degree, "one argument a degree");
        let k = self.span(t, side)?;
        let knots = self.span_knots(k);
        Ok(evaluate::blossom(&knots, self.span_control(k), arguments).rationals())
    }
}
