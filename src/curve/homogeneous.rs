//! Homogeneous control points over one denominator each: what the algorithms compute with.

use std::ops::Range;

use num_traits::One;

use super::{BSpline, Bezier};
use crate::number::{Integer, Rational, RationalVector};

/// A control point (w P, w), or P alone on a polynomial curve: numerators over one positive denominator.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Homogeneous {
    numerators: Vec<Integer>,
    denominator: Integer,
}

impl Homogeneous {
    /// From fractions.
    pub(super) fn from_rationals(numbers: &[Rational]) -> Homogeneous {
        let vector = RationalVector::from_rationals(numbers);
        Homogeneous {
            numerators: vector.numerators().to_vec(),
            denominator: vector.denominator().clone(),
        }
    }

    /// (a p + b q) / c with c > 0.
    pub(super) fn combine(a: &Integer, p: &Homogeneous, b: &Integer, q: &Homogeneous, c: &Integer) -> Homogeneous {
        if b.is_zero() && a == c {
            return p.clone();
        }
        if a.is_zero() && b == c {
            return q.clone();
        }
        let (s, t, denominator) = if p.denominator == q.denominator {
            (a.clone(), b.clone(), &p.denominator * c)
        } else {
            let gcd = p.denominator.gcd(&q.denominator);
            let (m, n) = (&p.denominator / &gcd, &q.denominator / &gcd);
            (a * &n, b * m, &p.denominator * n * c)
        };
        let numerators = p
            .numerators
            .iter()
            .zip(&q.numerators)
            .map(|(x, y)| &s * x + &t * y)
            .collect();
        Homogeneous {
            numerators,
            denominator,
        }
        .reduced()
    }

    /// ((1 − u) p + u q) with u = numerator / denominator.
    pub(super) fn mix(u: &Rational, p: &Homogeneous, q: &Homogeneous) -> Homogeneous {
        let rest = u.denom() - u.numer();
        Homogeneous::combine(&rest, p, u.numer(), q, u.denom())
    }

    /// q − p.
    pub(super) fn difference(p: &Homogeneous, q: &Homogeneous) -> Homogeneous {
        let one = Integer::one();
        Homogeneous::combine(&-one.clone(), p, &one, q, &one)
    }

    /// The point times a fraction.
    pub(super) fn scaled(&self, factor: &Rational) -> Homogeneous {
        Homogeneous {
            numerators: self.numerators.iter().map(|x| x * factor.numer()).collect(),
            denominator: &self.denominator * factor.denom(),
        }
        .reduced()
    }

    /// p + q.
    pub(super) fn sum(p: &Homogeneous, q: &Homogeneous) -> Homogeneous {
        let one = Integer::one();
        Homogeneous::combine(&one, p, &one, q, &one)
    }

    /// All coordinates as fractions.
    pub(super) fn rationals(&self) -> Vec<Rational> {
        self.numerators
            .iter()
            .map(|x| Rational::new(x.clone(), self.denominator.clone()))
            .collect()
    }

    /// The affine point: the first `dimension` coordinates, divided by the weight when there is one.
    pub(super) fn affine(&self, dimension: usize) -> Vec<Rational> {
        let divisor = self.numerators.get(dimension).unwrap_or(&self.denominator);
        self.numerators[..dimension]
            .iter()
            .map(|x| Rational::new(x.clone(), divisor.clone()))
            .collect()
    }

    /// Whether there is a weight and it is positive.
    pub(super) fn has_positive_weight(&self, dimension: usize) -> bool {
        self.numerators.get(dimension).is_some_and(Integer::is_positive)
    }

    fn reduced(mut self) -> Homogeneous {
        let mut gcd = self.denominator.clone();
        for x in &self.numerators {
            if gcd.is_one() {
                return self;
            }
            gcd = gcd.gcd(x);
        }
        if !gcd.is_one() {
            for x in &mut self.numerators {
                *x = &*x / &gcd;
            }
            self.denominator = &self.denominator / gcd;
        }
        self
    }
}

/// Flat affine points and weights to the homogeneous control points of a range of indices.
fn lift(
    dimension: usize,
    points: &RationalVector,
    weights: Option<&RationalVector>,
    range: Range<usize>,
) -> Vec<Homogeneous> {
    let flat = &points.numerators()[range.start * dimension..range.end * dimension];
    let chunks = flat.chunks_exact(dimension);
    let d = points.denominator();
    let Some(weights) = weights else {
        return chunks
            .map(|chunk| Homogeneous {
                numerators: chunk.to_vec(),
                denominator: d.clone(),
            })
            .collect();
    };
    let denominator = d * weights.denominator();
    chunks
        .zip(&weights.numerators()[range])
        .map(|(chunk, w)| Homogeneous {
            numerators: chunk.iter().map(|x| x * w).chain([d * w]).collect(),
            denominator: denominator.clone(),
        })
        .collect()
}

/// Homogeneous control points to flat affine points and weights.
fn lower(dimension: usize, points: &[Homogeneous]) -> (RationalVector, Option<RationalVector>) {
    let flat: Vec<Rational> = points.iter().flat_map(|p| p.affine(dimension)).collect();
    let weights: Vec<Rational> = points
        .iter()
        .filter_map(|p| {
            Some(Rational::new(
                p.numerators.get(dimension)?.clone(),
                p.denominator.clone(),
            ))
        })
        .collect();
    (
        RationalVector::from_rationals(&flat),
        (!weights.is_empty()).then(|| RationalVector::from_rationals(&weights)),
    )
}

impl Bezier {
    /// Homogeneous control points, without the weight when there are no weights.
    pub(super) fn homogeneous(&self) -> Vec<Homogeneous> {
        lift(self.dimension, &self.points, self.weights.as_ref(), 0..self.degree + 1)
    }

    /// From at least two homogeneous control points with positive weights.
    pub(super) fn from_homogeneous(dimension: usize, control: &[Homogeneous]) -> Bezier {
        let (points, weights) = lower(dimension, control);
        Bezier {
            dimension,
            degree: control.len() - 1,
            points,
            weights,
        }
    }
}

impl BSpline {
    /// Homogeneous control points, without the weight when there are no weights.
    pub(super) fn homogeneous(&self) -> Vec<Homogeneous> {
        self.homogeneous_range(0..self.count())
    }

    /// The homogeneous control points of a range of indices.
    pub(super) fn homogeneous_range(&self, range: Range<usize>) -> Vec<Homogeneous> {
        lift(self.dimension, &self.points, self.weights.as_ref(), range)
    }

    /// From valid knots and matching homogeneous control points with positive weights.
    pub(super) fn from_homogeneous(
        dimension: usize,
        degree: usize,
        knots: RationalVector,
        control: &[Homogeneous],
    ) -> BSpline {
        let (points, weights) = lower(dimension, control);
        BSpline {
            dimension,
            degree,
            knots,
            points,
            weights,
        }
    }
}
