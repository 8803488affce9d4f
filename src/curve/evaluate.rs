//! Points of a curve: de Casteljau's and de Boor's algorithms.

use num_traits::{One, Zero};

use super::homogeneous::Homogeneous;
use super::{BSpline, Bezier, Chain, OperationError};
use crate::number::{Integer, Rational};

/// A side of a parameter, where the two can differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The limit from smaller parameters.
    Before,
    /// The limit from greater parameters.
    After,
}

impl Bezier {
    /// The point c(u), 0 ≤ u ≤ 1, by de Casteljau's algorithm (de Casteljau 1959) on the homogeneous control points.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`].
    pub fn evaluate(&self, u: &Rational) -> Result<Vec<Rational>, OperationError> {
        self.check_inside(u)?;
        let mut points = self.homogeneous();
        for round in 1..=self.degree {
            for j in 0..=self.degree - round {
                points[j] = Homogeneous::mix(u, &points[j], &points[j + 1]);
            }
        }
        Ok(points[0].affine(self.dimension))
    }

    pub(super) fn check_inside(&self, u: &Rational) -> Result<(), OperationError> {
        if *u < Rational::zero() || *u > Rational::one() {
            return Err(OperationError::OutsideDomain);
        }
        Ok(())
    }
}

impl BSpline {
    /// The point c(t), t in the domain, by de Boor's algorithm (de Boor 1972) on the homogeneous control points.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`].
    pub fn evaluate(&self, t: &Rational) -> Result<Vec<Rational>, OperationError> {
        let k = self.span(t, Side::After)?;
        let arguments = vec![t.clone(); self.degree];
        let knots = self.span_knots(k);
        let point = blossom(&knots, self.span_control(k), &arguments);
        Ok(point.affine(self.dimension))
    }

    /// Whether the points at the two ends of the domain are the same.
    pub(super) fn is_closed(&self) -> bool {
        let (start, end) = self.domain();
        self.evaluate(&start) == self.evaluate(&end)
    }

    /// The index k of the non-empty knot span t_k < t_{k+1} of the domain on the given side of t; at an end of the
    /// domain the span inside.
    pub(super) fn span(&self, t: &Rational, side: Side) -> Result<usize, OperationError> {
        let (p, n) = (self.degree, self.count());
        let knots = self.knots.numerators();
        // t_i ? t  ⟺  numerator_i ? t · denominator
        let scaled = t * Rational::from_integer(self.knots.denominator().clone());
        let compare = |i: usize| Rational::from_integer(knots[i].clone()).cmp(&scaled);
        if compare(p).is_gt() || compare(n).is_lt() {
            return Err(OperationError::OutsideDomain);
        }
        let domain = &knots[p..=n];
        let at_or_before = domain.partition_point(|k| Rational::from_integer(k.clone()) <= scaled);
        let before = domain.partition_point(|k| Rational::from_integer(k.clone()) < scaled);
        let k = if (side == Side::After && !compare(n).is_eq()) || before == 0 {
            p + at_or_before - 1
        } else {
            p + before - 1
        };
        Ok(k)
    }

    /// The 2p knots that span k depends on, t_{k-p+1} … t_{k+p}.
    pub(super) fn span_knots(&self, k: usize) -> Vec<Rational> {
        let p = self.degree;
        (k + 1 - p..=k + p).map(|i| self.knots.get(i)).collect()
    }

    /// The p + 1 homogeneous control points that act on span k.
    pub(super) fn span_control(&self, k: usize) -> Vec<Homogeneous> {
        self.homogeneous_range(k - self.degree..k + 1)
    }
}

/// The blossom of the span between the two middle ones of the 2p `knots`, where `points` act, at p arguments.
pub(super) fn blossom(knots: &[Rational], mut points: Vec<Homogeneous>, arguments: &[Rational]) -> Homogeneous {
    let p = points.len() - 1;
    for round in 1..=p {
        let t = &arguments[round - 1];
        for j in 0..=p - round {
            let (low, high) = (&knots[j + round - 1], &knots[j + p]);
            let u = (t - low) / (high - low);
            points[j] = Homogeneous::mix(&u, &points[j], &points[j + 1]);
        }
    }
    points.swap_remove(0)
}

impl Chain<'_> {
    /// The point at the global parameter 0 ≤ t ≤ M.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`].
    pub fn evaluate(&self, parameter: &Rational) -> Result<Vec<Rational>, OperationError> {
        let (i, u) = self.locate(parameter).ok_or(OperationError::OutsideDomain)?;
        self.pieces()[i].evaluate(&u)
    }
}

/// The Bernstein polynomials B_0 … B_n at u, from their definition C(n, k) u^k (1 − u)^{n−k}.
pub fn bernstein(n: usize, u: &Rational) -> Vec<Rational> {
    let v = Rational::one() - u;
    let mut powers = vec![Rational::one()];
    for k in 0..n {
        powers.push(&powers[k] * u);
    }
    let mut values = vec![Rational::zero(); n + 1];
    let mut rest = Rational::one();
    for k in (0..=n).rev() {
        let binomial = Rational::from_integer(Integer::binomial(n as u32, k as u32));
        values[k] = binomial * &powers[k] * &rest;
        rest *= &v;
    }
    values
}
