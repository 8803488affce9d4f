//! Exact knot removal: the inverse of knot insertion, where there is one.

use super::decompose::decompose;
use super::elevate::fill;
use super::evaluate::blossom;
use super::homogeneous::Homogeneous;
use super::{BSpline, OperationError};
use crate::number::{Rational, RationalVector};

impl BSpline {
    /// The same curve with the knot `t`, inside the domain, `times` times less.
    ///
    /// The control points are blossoms, at consecutive remaining knots, of the polynomial pieces there (Ramshaw 1987); whether the curve is the same is
    /// then seen by inserting the knot again.
    ///
    /// # Errors
    /// [`OperationError::OutsideDomain`]; [`OperationError::NotRemovable`] when `t` does not occur so often, when the homogeneous curve is not smooth enough
    /// there, or when a weight would not be positive.
    pub fn remove_knot(&self, t: &Rational, times: usize) -> Result<BSpline, OperationError> {
        let (start, end) = self.domain();
        if *t <= start || *t >= end {
            return Err(OperationError::OutsideDomain);
        }
        if times == 0 {
            return Ok(self.clone());
        }
        let p = self.degree;
        let mut knots: Vec<Rational> = self.knots.iter().collect();
        let first = knots.partition_point(|knot| knot < t);
        if self.multiplicity(t) < times {
            return Err(OperationError::NotRemovable);
        }
        let spans: Vec<usize> = (p..self.count()).filter(|&k| knots[k] < knots[k + 1]).collect();
        let old = knots.clone();
        knots.drain(first..first + times);
        let control: Vec<Option<Homogeneous>> = (0..knots.len() - p - 1)
            .map(|i| {
                // Any span on which the control point acts.
                let k = *spans.iter().find(|&&k| old[k + 1] > knots[i])?;
                (old[k] < knots[i + p + 1]).then(|| {
                    let arguments = &knots[i + 1..=i + p];
                    blossom(&self.span_knots(k), self.span_control(k), arguments)
                })
            })
            .collect();
        let control = fill(control);
        if self.weights.is_some() && control.iter().any(|point| !point.has_positive_weight(self.dimension)) {
            return Err(OperationError::NotRemovable);
        }
        let knots = RationalVector::from_rationals(&knots);
        let removed = BSpline::from_homogeneous(self.dimension, p, knots, &control);
        let again = removed.insert_knot(t, times)?;
        match decompose(&again).0 == decompose(self).0 {
            true => Ok(removed),
            false => Err(OperationError::NotRemovable),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Integer;

    fn vector(numbers: &[i64]) -> RationalVector {
        let numbers: Vec<Rational> = numbers
            .iter()
            .map(|x| Rational::from_integer(Integer::from(*x)))
            .collect();
        RationalVector::from_rationals(&numbers)
    }

    fn spline(weights: Option<&[i64]>) -> BSpline {
        BSpline::new(
            2,
            3,
            vector(&[0, 0, 0, 0, 1, 3, 3, 4, 4, 4, 4]),
            vector(&[0, 0, 1, 3, 4, -1, 6, 2, 7, 7, 8, 1, 9, 0]),
            weights.map(vector),
        )
        .expect("a spline")
    }

    #[test]
    fn undoes_insertion() {
        for weights in [None, Some(&[1, 2, 3, 1, 1, 5, 1][..])] {
            let spline = spline(weights);
            for (t, times) in [((1, 2), 3), ((7, 2), 1), ((1, 1), 2), ((3, 1), 1)] {
                let t = Rational::new(Integer::from(t.0), Integer::from(t.1));
                let inserted = spline.insert_knot(&t, times).expect("inserts");
                assert_eq!(inserted.remove_knot(&t, times).expect("removes"), spline);
                assert_eq!(
                    inserted.remove_knot(&t, times + 1 + spline.multiplicity(&t)),
                    Err(OperationError::NotRemovable)
                );
            }
        }
    }

    #[test]
    fn refuses() {
        let spline = spline(None);
        let at = |t: i64, times| spline.remove_knot(&Rational::from_integer(Integer::from(t)), times);
        assert_eq!(at(1, 1), Err(OperationError::NotRemovable));
        assert_eq!(at(3, 1), Err(OperationError::NotRemovable));
        assert_eq!(at(2, 1), Err(OperationError::NotRemovable));
        assert_eq!(at(0, 1), Err(OperationError::OutsideDomain));
        assert_eq!(at(5, 1), Err(OperationError::OutsideDomain));
        assert_eq!(at(1, 0), Ok(spline.clone()));
    }

    #[test]
    fn unclamped() {
        let knots = vector(&[0, 1, 2, 3, 5, 6, 8, 9]);
        let spline = BSpline::new(2, 2, knots, vector(&[0, 0, 2, 1, 3, 5, 4, 4, 9, 1]), None).expect("a spline");
        for t in [2, 4] {
            let t = Rational::new(Integer::from(t), Integer::ONE) + Rational::new(Integer::ONE, Integer::from(2));
            let inserted = spline.insert_knot(&t, 2).expect("inserts");
            assert_eq!(inserted.remove_knot(&t, 2).expect("removes"), spline);
        }
    }
}
