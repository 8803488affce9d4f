//! A B-spline as Bézier pieces, by exact knot insertion (Böhm 1980).

use super::homogeneous::Homogeneous;
use super::{BSpline, Bezier};
use crate::number::{Integer, RationalVector};

/// The Bézier pieces of the non-empty knot spans of the domain, and the knots at their ends, one more than the pieces.
///
/// Clamped or not, with interior knots of any multiplicity up to the degree. A piece whose weights are all equal gets none.
pub(super) fn decompose(spline: &BSpline) -> (Vec<Bezier>, RationalVector) {
    let (p, count) = (spline.degree, spline.count());
    let knots = spline.knots.numerators();
    let mut pieces = Vec::new();
    let mut ends = vec![knots[p].clone()];
    for k in p..count {
        if knots[k] == knots[k + 1] {
            continue;
        }
        let mut piece = span_bezier(spline, k);
        if piece.is_polynomial() {
            piece.weights = None;
        }
        pieces.push(piece);
        ends.push(knots[k + 1].clone());
    }
    let ends = super::data::over(ends, spline.knots.denominator().clone());
    (pieces, ends)
}

/// The Bézier piece of the non-empty span t_k < t_{k+1} of the domain.
pub(super) fn span_bezier(spline: &BSpline, k: usize) -> Bezier {
    let p = spline.degree;
    let knots = &spline.knots.numerators()[k + 1 - p..=k + p];
    Bezier::from_homogeneous(
        spline.dimension,
        &span_points(knots, spline.homogeneous_range(k - p..k + 1)),
    )
}

/// The Bézier control points of the span between the two middle ones of the 2p knots on which p + 1 control points act.
///
/// With the blossom f, control point j is f(knots[j..j + p]). The start a of the span is inserted until the points are
/// f(a, …, a, knots[p..p + j]), then its end b until they are f(a, …, a, b, …, b).
fn span_points(knots: &[Integer], mut points: Vec<Homogeneous>) -> Vec<Homogeneous> {
    let p = points.len() - 1;
    let (a, b) = (&knots[p - 1], &knots[p]);
    for round in 1..=p {
        for j in 0..=p - round {
            let (low, high) = (&knots[j + round - 1], &knots[j + p]);
            points[j] = Homogeneous::combine(&(high - a), &points[j], &(a - low), &points[j + 1], &(high - low));
        }
    }
    // Every knot before b is now a.
    let mut pieces = Vec::with_capacity(p + 1);
    for round in 1..=p {
        pieces.push(points[0].clone());
        for j in 0..=p - round {
            let high = &knots[j + p];
            points[j] = Homogeneous::combine(&(high - b), &points[j], &(b - a), &points[j + 1], &(high - a));
        }
    }
    pieces.push(points[0].clone());
    pieces
}
