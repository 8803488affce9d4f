//! Knot insertion and refinement (Böhm 1980).

use super::homogeneous::Homogeneous;
use super::{BSpline, MAXIMUM_PIECES, OperationError};
use crate::number::{Rational, RationalVector};

impl BSpline {
    /// How often `t` occurs among the knots.
    pub fn multiplicity(&self, t: &Rational) -> usize {
        self.knots.iter().filter(|knot| knot == t).count()
    }

    /// The same curve with `t`, anywhere in the domain ends included, as a knot `times` times more.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`], and [`OperationError::Multiplicity`] when the knot would occur more often than
    /// the degree.
    pub fn insert_knot(&self, t: &Rational, times: usize) -> Result<BSpline, OperationError> {
        self.refine(&vec![t.clone(); times])
    }

    /// The same curve with all of `parameters`, in any order, as further knots.
    ///
    /// # Errors
    /// As for [`BSpline::insert_knot`].
    pub fn refine(&self, parameters: &[Rational]) -> Result<BSpline, OperationError> {
        if self.count() + parameters.len() > MAXIMUM_PIECES {
            return Err(OperationError::TooMany);
        }
        let mut knots: Vec<Rational> = self.knots.iter().collect();
        let mut control = self.homogeneous();
        for t in parameters {
            insert(self.degree, &mut knots, &mut control, t)?;
        }
        let knots = RationalVector::from_rationals(&knots);
        Ok(BSpline::from_homogeneous(self.dimension, self.degree, knots, &control))
    }
}

/// Inserts `t` once.
pub(super) fn insert(
    p: usize,
    knots: &mut Vec<Rational>,
    control: &mut Vec<Homogeneous>,
    t: &Rational,
) -> Result<(), OperationError> {
    if *t < knots[p] || *t > knots[control.len()] {
        return Err(OperationError::OutsideDomain);
    }
    let after = knots.partition_point(|knot| knot <= t);
    let multiplicity = after - knots.partition_point(|knot| knot < t);
    if multiplicity >= p {
        return Err(OperationError::Multiplicity {
            multiplicity: multiplicity + 1,
            degree: p,
        });
    }
    let k = after - 1;
    let fresh: Vec<Homogeneous> = (k + 1 - p..=k - multiplicity)
        .map(|i| {
            let u = (t - &knots[i]) / (&knots[i + p] - &knots[i]);
            Homogeneous::mix(&u, &control[i - 1], &control[i])
        })
        .collect();
    control.splice(k + 1 - p..k - multiplicity, fresh);
    knots.insert(after, t.clone());
    Ok(())
}
