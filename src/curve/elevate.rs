//! Degree elevation.

use super::decompose::span_bezier;
use super::homogeneous::Homogeneous;
use super::{BSpline, Bezier, MAXIMUM_DEGREE, MAXIMUM_PIECES, OperationError};
use crate::number::{Integer, Rational, RationalVector};

impl Bezier {
    /// The same piece with degree n + `by`.
    ///
    /// # Errors
    /// [`OperationError::Degree`] when that exceeds [`MAXIMUM_DEGREE`].
    pub fn elevate(&self, by: usize) -> Result<Bezier, OperationError> {
        check_degree(self.degree, by)?;
        if by == 0 {
            return Ok(self.clone());
        }
        let mut control = self.homogeneous();
        for _ in 0..by {
            control = elevate_once(&control);
        }
        Ok(Bezier::from_homogeneous(self.dimension, &control))
    }
}

fn check_degree(degree: usize, by: usize) -> Result<(), OperationError> {
    let degree = degree.saturating_add(by);
    if degree > MAXIMUM_DEGREE {
        return Err(OperationError::Degree { degree });
    }
    Ok(())
}

/// Q_k = k/(n+1) P_{k−1} + (1 − k/(n+1)) P_k (Forrest 1972).
fn elevate_once(control: &[Homogeneous]) -> Vec<Homogeneous> {
    let total = Integer::from(control.len());
    let mut result = vec![control[0].clone()];
    for (k, pair) in control.windows(2).enumerate() {
        let a = Integer::from(k + 1);
        let b = &total - &a;
        result.push(Homogeneous::combine(&a, &pair[0], &b, &pair[1], &total));
    }
    result.push(control[control.len() - 1].clone());
    result
}

impl BSpline {
    /// The same curve with degree p + `by` and the same continuity: every knot of the domain occurs `by` times more.
    ///
    /// Knots outside the domain are repeated alike and the surplus at the two outer ends dropped, so that a periodic
    /// spline stays one. The control points are blossoms of the elevated pieces at consecutive knots.
    ///
    /// # Errors
    /// [`OperationError::Degree`] when the degree would exceed [`MAXIMUM_DEGREE`], [`OperationError::TooMany`] when the
    /// control points would be too many.
    pub fn elevate(&self, by: usize) -> Result<BSpline, OperationError> {
        check_degree(self.degree, by)?;
        if by == 0 {
            return Ok(self.clone());
        }
        if self.knots.len().saturating_mul(by + 1) > MAXIMUM_PIECES {
            return Err(OperationError::TooMany);
        }
        let (p, q) = (self.degree, self.degree + by);
        let knots = self.elevated_knots(by);
        let count = knots.len() - q - 1;
        // The non-empty spans of the domain in the elevated knots, with their elevated pieces.
        let mut spans: Vec<(usize, Bezier)> = Vec::new();
        let mut next = q;
        for k in p..self.count() {
            if self.knots.numerators()[k] < self.knots.numerators()[k + 1] {
                let piece = span_bezier(self, k).elevate(by)?;
                let span = (next..count)
                    .find(|&i| knots[i] < knots[i + 1])
                    .expect("elevation keeps the spans");
                spans.push((span, piece));
                next = span + 1;
            }
        }
        let mut control: Vec<Option<Homogeneous>> = vec![None; count];
        for (span, piece) in &spans {
            let (start, length) = (&knots[*span], &knots[span + 1] - &knots[*span]);
            for (i, slot) in control.iter_mut().enumerate().take(span + 1).skip(span - q) {
                if slot.is_none() {
                    let arguments: Vec<Rational> = knots[i + 1..=i + q].iter().map(|t| (t - start) / &length).collect();
                    *slot = Some(piece.blossom_point(&arguments));
                }
            }
        }
        let control = fill(control);
        let knots = RationalVector::from_rationals(&knots);
        Ok(BSpline::from_homogeneous(self.dimension, q, knots, &control))
    }

    /// Every distinct knot `by` times more, trimmed so that the domain starts at index q and ends q knots before the last.
    fn elevated_knots(&self, by: usize) -> Vec<Rational> {
        let (p, n) = (self.degree, self.count());
        let old = self.knots.numerators();
        let mut all = Vec::new();
        for run in old.chunk_by(|a, b| a == b) {
            let knot = Rational::new(run[0].clone(), self.knots.denominator().clone());
            all.extend(std::iter::repeat_n(knot, run.len() + by));
        }
        let distinct = |range: &[Integer]| range.chunk_by(|a, b| a == b).count();
        // The knots up to t_p gain `by` a distinct one; p + by + 1 of them stay. Likewise from t_n on.
        let first = distinct(&old[..=p]) * by - by;
        let last = distinct(&old[n..]) * by - by;
        all.truncate(all.len() - last);
        all.split_off(first)
    }
}

/// Control points that act nowhere in the domain repeat the nearest one that does.
pub(super) fn fill(mut control: Vec<Option<Homogeneous>>) -> Vec<Homogeneous> {
    for i in (0..control.len().saturating_sub(1)).rev() {
        if control[i].is_none() {
            control[i] = control[i + 1].clone();
        }
    }
    for i in 1..control.len() {
        if control[i].is_none() {
            control[i] = control[i - 1].clone();
        }
    }
    control.into_iter().flatten().collect()
}
