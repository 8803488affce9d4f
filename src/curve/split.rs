//! Splitting a curve in two.

use num_traits::{One, Zero};

use super::homogeneous::Homogeneous;
use super::insert::insert;
use super::{BSpline, Bezier, OperationError};
use crate::number::{Rational, RationalVector};

impl Bezier {
    /// The parts on [0, u] and [u, 1], each on its own range 0 to 1, by de Casteljau's algorithm; 0 < u < 1.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`].
    pub fn split(&self, u: &Rational) -> Result<(Bezier, Bezier), OperationError> {
        if *u <= Rational::zero() || *u >= Rational::one() {
            return Err(OperationError::OutsideDomain);
        }
        let mut right = self.homogeneous();
        let mut left = vec![right[0].clone()];
        for round in 1..=self.degree {
            for j in 0..=self.degree - round {
                right[j] = Homogeneous::mix(u, &right[j], &right[j + 1]);
            }
            left.push(right[0].clone());
        }
        Ok((
            Bezier::from_homogeneous(self.dimension, &left),
            Bezier::from_homogeneous(self.dimension, &right),
        ))
    }
}

impl BSpline {
    /// The parts before and after t, strictly inside the domain, with their old knots and t degree + 1 times at the cut.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`].
    pub fn split(&self, t: &Rational) -> Result<(BSpline, BSpline), OperationError> {
        let (p, d) = (self.degree, self.dimension);
        let (start, end) = self.domain();
        if *t <= start || *t >= end {
            return Err(OperationError::OutsideDomain);
        }
        let mut knots: Vec<Rational> = self.knots.iter().collect();
        let mut control = self.homogeneous();
        for _ in self.multiplicity(t)..p {
            insert(p, &mut knots, &mut control, t)?;
        }
        // The first of the p knots at t; control point r − 1 is the point c(t).
        let r = knots.partition_point(|knot| knot < t);
        let mut left = knots[..r + p].to_vec();
        left.push(t.clone());
        let mut right = vec![t.clone()];
        right.extend_from_slice(&knots[r..]);
        let part = |knots: &[Rational], control: &[Homogeneous]| {
            BSpline::from_homogeneous(d, p, RationalVector::from_rationals(knots), control)
        };
        Ok((part(&left, &control[..r]), part(&right, &control[r - 1..])))
    }
}
