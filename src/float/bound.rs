//! Bounds from ratios of Bernstein coefficients, and a queue that gives the least one first.

use std::cmp::Ordering;

/// Something with a lower bound; in a heap the least is greatest.
pub(super) struct Least<T>(pub(super) f64, pub(super) T);

impl<T> PartialEq for Least<T> {
    fn eq(&self, other: &Least<T>) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl<T> Eq for Least<T> {}
impl<T> PartialOrd for Least<T> {
    fn partial_cmp(&self, other: &Least<T>) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl<T> Ord for Least<T> {
    fn cmp(&self, other: &Least<T>) -> Ordering {
        other.0.total_cmp(&self.0)
    }
}

/// The least and the greatest ratio of the coefficients of D and W > 0, and those at the two ends.
pub(super) fn ratios(coefficients: &[[f64; 2]]) -> ((f64, f64), (f64, f64)) {
    let ratio = |c: &[f64; 2]| c[0] / c[1];
    let all = coefficients.iter().map(ratio);
    let range = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    (
        range,
        (ratio(&coefficients[0]), ratio(&coefficients[coefficients.len() - 1])),
    )
}

/// Whether a range is no more than rounding.
pub(super) fn flat(least: f64, most: f64, slack: f64) -> bool {
    most - least <= slack + 4.0 * f64::EPSILON * most.abs()
}
