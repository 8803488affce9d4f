//! The point of a curve nearest to a given one: branch and bound on the Bernstein coefficients of the squared distance, then Newton's method.
//!
//! The squared distance of a piece with homogeneous points (X, w) is D/W with D = |X − qw|² and W = w². As W > 0, it is at least the least ratio of
//! their Bernstein coefficients, a bound that converges quadratically.

use std::collections::BinaryHeap;

use super::FloatError;
use super::bound::{Least, flat, ratios};
use super::curve::Curve;
use super::double::Double;
use super::piece::{Pieces, Vector, binomials, dot, greatest, length};
use super::tree::halve;
use crate::curve::Side;

/// A nearest point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// The distance.
    pub distance: f64,
    /// The parameter where it is attained.
    pub parameter: f64,
}

/// Parts before giving up.
const BUDGET: usize = 1_000_000;
/// Equally near places that are looked at more closely.
const MOST_CANDIDATES: usize = 64;

/// Part of a piece on [start, start + width] of its local parameter.
struct Part {
    piece: usize,
    start: f64,
    width: f64,
    /// Coefficients of D and W.
    coefficients: Vec<[f64; 2]>,
    /// Rounding of D/W.
    rounding: f64,
}

impl Curve {
    /// The point nearest to `target` (z = 0 in the plane), ends of an open curve included; one of them if there are several.
    ///
    /// # Errors
    /// [`FloatError::Range`] when a coordinate is not finite or above 2^300; [`FloatError::Budget`].
    pub fn nearest_point(&self, target: [f64; 3]) -> Result<Nearest, FloatError> {
        if target.iter().any(|x| x.is_nan() || x.abs() > 2f64.powi(300)) {
            return Err(FloatError::Range { place: "parameter" });
        }
        let target = if self.dimension == 2 {
            [target[0], target[1], 0.0]
        } else {
            target
        };
        let pieces = Pieces::new(self, &target);
        let mut result: Option<Nearest> = None;
        for (piece, u) in places(&pieces)? {
            for u in [u, foot(&pieces, piece, u)] {
                let t = pieces.all[piece].parameter(u);
                let distance = self.distance_from(t, &target)?;
                if result.is_none_or(|best| distance < best.distance) {
                    result = Some(Nearest { distance, parameter: t });
                }
            }
        }
        result.ok_or(FloatError::Budget)
    }

    /// |c(t) − target| in double-double.
    fn distance_from(&self, t: f64, target: &Vector) -> Result<f64, FloatError> {
        let point = self.affine(&self.lifted_point(self.span(t, Side::After)?, t));
        Ok(length(&std::array::from_fn(|axis| {
            point[axis] - Double::from(target[axis])
        })))
    }
}

/// The places where the distance of the pieces from the origin is least, up to rounding.
fn places(pieces: &Pieces) -> Result<Vec<(usize, f64)>, FloatError> {
    let mut heap = BinaryHeap::new();
    let mut best = f64::INFINITY;
    for (i, piece) in pieces.all.iter().enumerate() {
        let coefficients = squared(&piece.control);
        let (_, ends) = ratios(&coefficients);
        best = best.min(ends.0).min(ends.1);
        let most = piece
            .control
            .iter()
            .map(|c| dot(&[c[0], c[1], c[2]], &[c[0], c[1], c[2]]) / (c[3] * c[3]));
        let part = Part {
            piece: i,
            start: 0.0,
            width: 1.0,
            coefficients,
            rounding: 8.0 * f64::EPSILON * most.fold(0.0, f64::max),
        };
        heap.push(Least(ratios(&part.coefficients).0.0, part));
    }
    let mut places = Vec::new();
    let mut budget = BUDGET;
    while let Some(Least(lower, mut part)) = heap.pop() {
        if places.len() == MOST_CANDIDATES {
            break;
        }
        let slack = part.rounding;
        if lower > best + slack + 16.0 * f64::EPSILON * best {
            continue;
        }
        let ((least, most), _) = ratios(&part.coefficients);
        if flat(least, most, slack) || part.width < 2f64.powi(-50) {
            places.push((part.piece, part.start + part.width / 2.0));
            continue;
        }
        budget -= 1;
        if budget == 0 {
            return Err(FloatError::Budget);
        }
        let left = halve(&mut part.coefficients);
        let width = part.width / 2.0;
        let halves = [(left, part.start), (part.coefficients, part.start + width)];
        for (coefficients, start) in halves {
            let ((least, _), ends) = ratios(&coefficients);
            best = best.min(ends.0).min(ends.1);
            let (piece, rounding) = (part.piece, part.rounding);
            let half = Part {
                piece,
                start,
                width,
                coefficients,
                rounding,
            };
            heap.push(Least(least, half));
        }
    }
    Ok(places)
}

/// The coefficients of |X|² and w².
fn squared(control: &[[f64; 4]]) -> Vec<[f64; 2]> {
    let n = control.len() - 1;
    let (row, total) = (binomials(n), binomials(2 * n));
    (0..=2 * n)
        .map(|k| {
            let mut sum = [0.0; 2];
            for i in k.saturating_sub(n)..=k.min(n) {
                let (a, b) = (&control[i], &control[k - i]);
                let factor = row[i] * row[k - i] / total[k];
                sum[0] += factor * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
                sum[1] += factor * a[3] * b[3];
            }
            sum
        })
        .collect()
}

/// The local parameter of the foot of the perpendicular from the origin near u, within the piece.
pub(super) fn foot(pieces: &Pieces, piece: usize, mut u: f64) -> f64 {
    for _ in 0..12 {
        let [c, first, second] = pieces.all[piece].evaluate(u);
        let speed = dot(&first, &first);
        let curved = speed + dot(&c, &second);
        // Away from a minimum the step of Gauss and Newton.
        let slope = if curved > 0.0 { curved } else { speed };
        let step = dot(&c, &first) / slope;
        if step.is_nan() || greatest(&first) == 0.0 {
            return u;
        }
        let next = (u - step).clamp(0.0, 1.0);
        if (next - u).abs() < 1e-17 {
            return next;
        }
        u = next;
    }
    u
}
