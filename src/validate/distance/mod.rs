//! Enclosures of distances: from a point to a curve, and between two curves.
//!
//! The upper bound is the exact distance at exact parameters, which a search in binary64 suggests. The lower bound is proved by branch and bound in integers:
//! on a pair of pieces, the squared distance times the squared weights is a polynomial G with Bernstein coefficients G_ij and denominator D with D_ij; where G_ij ≥ λ D_ij
//! for all i, j, no two points are nearer than √λ. Halving halves the coefficients' distance from the polynomial twice over, so that few halvings suffice.

mod bernstein;
mod search;

use crate::curve::{BSpline, Curve};
use crate::number::{Rational, RationalExt, sqrt_enclosure};

use bernstein::Pair;
use search::{FloatPiece, Start};

/// How far apart the two bounds may be, relative to the largest coordinate: the first width for which few enough parts suffice. Where curves run at a constant
/// distance, the number of parts grows with the root of the width.
const RELATIVE_WIDTHS: [f64; 4] = [1e-12, 1e-10, 1e-8, 1e-7];
/// The most pairs of parts looked at for a width; after the last the lower bound stays open.
const MOST_PARTS: usize = 30_000;
/// Bits of square roots.
const ROOT_BITS: u32 = 90;

/// A distance between two bounds.
#[derive(Debug, Clone)]
pub(super) struct Enclosure {
    pub(super) lower: Rational,
    pub(super) upper: Rational,
    pub(super) upper_squared: Rational,
    /// Where the upper bound is attained: one parameter of each curve.
    pub(super) parameters: Vec<Rational>,
}

/// One piece of either side: a point is a piece of degree 0.
#[derive(Debug, Clone)]
pub(super) struct ExactPiece {
    /// Homogeneous control points, the weight last.
    pub(super) control: Vec<Vec<Rational>>,
    pub(super) knots: (Rational, Rational),
}

impl ExactPiece {
    fn of(spline: &BSpline) -> Vec<ExactPiece> {
        let curve = Curve::from(spline.clone());
        let chain = curve.chain();
        let piece = |i: usize| {
            let piece = chain.piece(i)?;
            let one = Rational::from_integer(1.into());
            let control = (0..=piece.bezier.degree()).map(|k| {
                let weight = piece
                    .bezier
                    .weights()
                    .map_or_else(|| one.clone(), |weights| weights.get(k));
                let mut point: Vec<Rational> = piece.bezier.point(k).iter().map(|x| x * &weight).collect();
                point.push(weight);
                point
            });
            Some(ExactPiece {
                control: control.collect(),
                knots: piece.knots.clone(),
            })
        };
        (0..chain.count()).filter_map(piece).collect()
    }

    fn of_point(point: &[Rational]) -> ExactPiece {
        let mut control = point.to_vec();
        control.push(Rational::from_integer(1.into()));
        ExactPiece {
            control: vec![control],
            knots: Default::default(),
        }
    }

    /// The point at 0 ≤ u ≤ 1, by de Casteljau's algorithm.
    fn point(&self, u: &Rational) -> Vec<Rational> {
        let mut control = self.control.clone();
        let v = Rational::from_integer(1.into()) - u;
        for round in 1..control.len() {
            for j in 0..control.len() - round {
                let (a, b) = (&control[j], &control[j + 1]);
                control[j] = a.iter().zip(b).map(|(x, y)| x * &v + y * u).collect();
            }
        }
        let mut point = control.swap_remove(0);
        let weight = point.pop().unwrap_or_default();
        for x in &mut point {
            *x /= &weight;
        }
        point
    }

    fn knot(&self, u: &Rational) -> Rational {
        &self.knots.0 + u * (&self.knots.1 - &self.knots.0)
    }
}

/// The distance from a point to a curve; `scale` is the largest coordinate of both.
pub(super) fn to_point(spline: &BSpline, target: &[Rational], scale: f64) -> Enclosure {
    let mut found = enclose(&ExactPiece::of(spline), &[ExactPiece::of_point(target)], scale);
    found.parameters.truncate(1);
    found
}

/// The smallest distance between two curves; `scale` is the largest coordinate of both.
pub(super) fn between(a: &BSpline, b: &BSpline, scale: f64) -> Enclosure {
    enclose(&ExactPiece::of(a), &ExactPiece::of(b), scale)
}

/// The best pair of parameters known, with its exact squared distance.
struct Best {
    squared: Rational,
    float: f64,
    parameters: Vec<Rational>,
}

impl Best {
    /// Takes a pair of parameters when it is nearer.
    fn try_at(&mut self, a: &ExactPiece, b: &ExactPiece, at: Start) {
        let exact = |x: f64| Rational::from_f64(x.clamp(0.0, 1.0)).unwrap_or_default();
        let mut pairs = vec![(exact(at.u), exact(at.v))];
        // Simple fractions nearby are easier to read, and often the exact place.
        if let (Some(u), Some(v)) = (
            crate::number::approximate(at.u.clamp(0.0, 1.0), 64),
            crate::number::approximate(at.v.clamp(0.0, 1.0), 64),
        ) && (u.to_f64() - at.u).abs().max((v.to_f64() - at.v).abs()) < 1e-6
        {
            pairs.push((u, v));
        }
        for (u, v) in pairs {
            let (p, q) = (a.point(&u), b.point(&v));
            let squared = p.iter().zip(&q).fold(Rational::default(), |sum, (x, y)| {
                let difference = x - y;
                sum + &difference * &difference
            });
            if self.parameters.is_empty() || squared <= self.squared {
                self.float = squared.to_f64();
                self.squared = squared;
                self.parameters = vec![a.knot(&u), b.knot(&v)];
            }
        }
    }
}

fn enclose(first: &[ExactPiece], second: &[ExactPiece], scale: f64) -> Enclosure {
    let floats = |pieces: &[ExactPiece]| pieces.iter().map(FloatPiece::new).collect::<Vec<_>>();
    let (first_floats, second_floats) = (floats(first), floats(second));
    let mut best = Best {
        squared: Rational::default(),
        float: f64::INFINITY,
        parameters: Vec::new(),
    };
    let pairs = || (0..first.len()).flat_map(|i| (0..second.len()).map(move |j| (i, j)));
    for (i, j) in pairs() {
        for start in search::starts(&first_floats[i], &second_floats[j]) {
            let start = search::descend(&first_floats[i], &second_floats[j], start);
            if start.squared <= best.float {
                best.try_at(&first[i], &second[j], start);
            }
        }
    }
    let nearer = |best: &mut Best, i: usize, j: usize, middle: Start| {
        let nearer = search::descend(&first_floats[i], &second_floats[j], middle);
        best.try_at(&first[i], &second[j], nearer);
    };
    let middle = |i: usize, j: usize, (u, v): (f64, f64)| search::at(&first_floats[i], &second_floats[j], u, v);
    let lower = RELATIVE_WIDTHS.into_iter().find_map(|width| {
        let whole = || pairs().map(|(i, j)| (i, j, Pair::new(&first[i], &second[j], scale)));
        let width = Rational::from_f64(scale * width)?;
        proved(whole, &width, &mut best, &middle, &nearer)
    });
    Enclosure {
        lower: lower.unwrap_or_default(),
        upper: sqrt_enclosure(&best.squared, ROOT_BITS).1,
        upper_squared: best.squared,
        parameters: best.parameters,
    }
}

/// A lower bound at most `width` below the best distance known, which may become less on the way; nothing when that takes too many parts.
fn proved<P: Iterator<Item = (usize, usize, Pair)>>(
    whole: impl Fn() -> P,
    width: &Rational,
    best: &mut Best,
    middle_of: &dyn Fn(usize, usize, (f64, f64)) -> Start,
    follow: &dyn Fn(&mut Best, usize, usize, Start),
) -> Option<Rational> {
    let zero = Rational::default();
    let below = |best: &Best| (sqrt_enclosure(&best.squared, ROOT_BITS).0 - width).max(zero.clone());
    let mut lower = below(best);
    if lower == zero {
        return Some(zero);
    }
    let mut parts: Vec<(usize, usize, Pair)> = whole().collect();
    let mut bound = &lower * &lower;
    let mut looked_at = 0;
    while let Some((i, j, pair)) = parts.pop() {
        if pair.all_at_least(&bound) {
            continue;
        }
        looked_at += 1;
        if looked_at > MOST_PARTS || pair.is_tiny() {
            return None;
        }
        let middle = middle_of(i, j, pair.middle());
        if middle.squared < best.float {
            follow(best, i, j, middle);
            lower = below(best);
            bound = &lower * &lower;
        }
        let (a, b) = pair.halves(&bound);
        parts.push((i, j, a));
        parts.push((i, j, b));
    }
    Some(lower)
}

#[cfg(test)]
mod tests;
