//! The squared curvature of a piece as a quotient of polynomials (FORMAT §11; the identities are proved in docs/curvature.md).

use crate::check::chain::{Chain, OwnedNumbers};
use crate::check::polynomial::{Bound, NotShown, convolution, scaled, show, unscaled};
use crate::number::{Integer, Rational};

/// The planes in which the cross product c' × c'' has its components.
const PLANES: [(usize, usize); 3] = [(0, 1), (1, 2), (2, 0)];

/// The polynomials of a piece of degree n, by their coefficients times binomials: κ² = `factor` · ω · Σ `minors`² / |`tangents`|⁶.
///
/// ω is w⁶ of a rational piece and 1 of a polynomial one, written with degree 2n + 2 so that the degrees agree.
pub struct Field {
    degree: usize,
    /// A positive multiple of D, by coordinates.
    tangents: [Vec<Integer>; 3],
    /// The weights of a rational piece.
    weights: Option<Vec<Integer>>,
    /// For each plane the determinants of the polynomials on consecutive control points; none of a piece of degree 1.
    minors: Vec<Vec<Integer>>,
    factor: Rational,
}

impl Field {
    /// The polynomials of a piece that there is.
    pub fn new(chain: &Chain, piece: usize) -> Field {
        let numbers: OwnedNumbers<Integer> = chain.numbers_as(piece).expect("unbounded integers do not overflow");
        let n = chain.pieces[piece].degree;
        let axis = |vectors: &[[Integer; 3]], axis: usize| -> Vec<Integer> {
            vectors.iter().map(|vector| vector[axis].clone()).collect()
        };
        let planes = if chain.dimension == 2 {
            &PLANES[..1]
        } else {
            &PLANES[..]
        };
        let planes = if n < 2 { &[] } else { planes };
        let big = |x: usize| Integer::from(x);
        let (minors, weights, factor) = if numbers.weights.is_empty() {
            let minors = planes.iter().map(|(i, j)| {
                let columns = [axis(&numbers.tangents, *i), axis(&numbers.tangents, *j)];
                minor_of_differences(&columns, n)
            });
            // The stored differences are those of the points times q.
            let q = chain.pieces[piece].point_scale.value();
            let factor = Rational::new(big(n - 1) * q, big(n));
            (minors.collect(), None, &factor * &factor)
        } else {
            let minors = planes.iter().map(|(i, j)| {
                let columns = [
                    numbers.weights.clone(),
                    axis(&numbers.points, *i),
                    axis(&numbers.points, *j),
                ];
                minor_of_points(&columns, n)
            });
            // The stored tangents are D times L, the least common multiple of the binomials of its degree.
            let top = 2 * n as u32 - 2;
            let multiple = (0..=top).fold(Integer::ONE, |lcm, k| lcm.lcm(&Integer::binomial(top, k)));
            let factor = big(n).pow(2) * big(n - 1) * multiple.pow(3);
            let factor = Rational::from_integer(&factor * &factor);
            (minors.collect(), Some(scaled(&numbers.weights)), factor)
        };
        Field {
            degree: n,
            tangents: [0, 1, 2].map(|i| scaled(&axis(&numbers.tangents, i))),
            weights,
            minors,
            factor,
        }
    }

    /// How many leading and trailing coefficients of D vanish; not all do.
    pub fn zeros(&self) -> [usize; 2] {
        let vanishes = |k: &usize| self.tangents.iter().all(|column| column[*k].is_zero());
        let count = self.tangents[0].len();
        [
            (0..count).take_while(vanishes).count(),
            (0..count).rev().take_while(vanishes).count(),
        ]
    }

    /// How many leading and trailing coefficients of the numerator of κ vanish, or nothing if the piece is straight.
    pub fn straight_ends(&self) -> Option<[usize; 2]> {
        let vanishes = |k: &usize| self.minors.iter().all(|minor| minor[*k].is_zero());
        let count = self.minors.first()?.len();
        let start = (0..count).take_while(vanishes).count();
        (start < count).then(|| [start, (0..count).rev().take_while(vanishes).count()])
    }

    /// Shows that D vanishes nowhere but, as often as its first or last coefficients do, at an end.
    ///
    /// Sound because D without its leading z coefficients times binomials is D/u^z, which is then not zero anywhere on [0, 1].
    ///
    /// # Errors
    /// Where it vanishes, or that the limits of halving were reached.
    pub fn show_regular(&self) -> Result<(), NotShown> {
        let [start, end] = self.zeros();
        let inside = start..self.tangents[0].len() - end;
        let squares = self.tangents.iter().map(|column| {
            let column = &column[inside.clone()];
            convolution(column, column)
        });
        show(unscaled(sum(squares)).0, Bound::Positive)
    }

    /// Shows that κ² ≤ `upper_squared` wherever D does not vanish.
    ///
    /// # Errors
    /// A parameter where κ² is greater, or that the limits of halving were reached.
    pub fn show_bound(&self, upper_squared: &Rational) -> Result<(), NotShown> {
        // (a/b)·|D|⁶ − (f/g)·numerator, times b·g.
        let speed_factor = upper_squared.numer() * self.factor.denom();
        let bend_factor = upper_squared.denom() * self.factor.numer();
        let difference = self
            .speed()
            .iter()
            .zip(self.bend())
            .map(|(speed, bend)| speed * &speed_factor - bend * &bend_factor)
            .collect();
        let coefficients = unscaled(difference).0;
        let common = coefficients.iter().filter_map(Integer::trailing_zeros).min();
        let shift = common.and_then(|bits| u32::try_from(bits).ok()).unwrap_or(0);
        show(
            coefficients.into_iter().map(|x| x >> shift).collect(),
            Bound::NonNegative,
        )
    }

    /// |D|⁶.
    fn speed(&self) -> Vec<Integer> {
        let square = sum(self.tangents.iter().map(|column| convolution(column, column)));
        convolution(&square, &convolution(&square, &square))
    }

    /// ω · Σ minors², of the degree of |D|⁶.
    fn bend(&self) -> Vec<Integer> {
        let degree = 6 * (self.tangents[0].len() - 1);
        if self.minors.is_empty() {
            return vec![Integer::ZERO; degree + 1];
        }
        let squares = sum(self.minors.iter().map(|minor| convolution(minor, minor)));
        let rest = match &self.weights {
            Some(weights) => {
                let cube = convolution(weights, &convolution(weights, weights));
                convolution(&cube, &cube)
            }
            None => binomials(degree + 1 - squares.len()),
        };
        convolution(&squares, &rest)
    }

    /// κ² at a local parameter from 0 to 1, exactly; nothing where D vanishes.
    pub fn squared_at(&self, u: &Rational) -> Option<Rational> {
        let at = |scaled: &[Integer]| value(scaled, u);
        let speed: Integer = self.tangents.iter().map(|column| at(column)).map(|x| &x * &x).sum();
        if speed.is_zero() {
            return None;
        }
        let bend: Integer = self.minors.iter().map(|minor| at(minor)).map(|x| &x * &x).sum();
        // Values of degree m are times (denominator of u)^m; in the quotient these powers cancel.
        let rest = match &self.weights {
            Some(weights) => at(weights).pow(6),
            None => u.denom().pow(2 * self.degree as u32 + 2),
        };
        Some(Rational::new(bend * rest, speed.pow(3)) * &self.factor)
    }
}

/// The value at u = p/q of a polynomial of degree m, times q^m.
fn value(scaled: &[Integer], u: &Rational) -> Integer {
    let (p, rest) = (u.numer(), u.denom() - u.numer());
    // Horner's rule in p, with the powers of q − p that the terms passed lack.
    let (mut sum, mut power) = (Integer::ZERO, Integer::ONE);
    for coefficient in scaled.iter().rev() {
        sum = sum * p + coefficient * &power;
        power *= &rest;
    }
    sum
}

fn sum(polynomials: impl Iterator<Item = Vec<Integer>>) -> Vec<Integer> {
    let add = |mut total: Vec<Integer>, other: Vec<Integer>| {
        for (x, y) in total.iter_mut().zip(other) {
            *x += y;
        }
        total
    };
    polynomials.reduce(add).unwrap_or_default()
}

fn binomials(degree: usize) -> Vec<Integer> {
    (0..=degree)
        .map(|k| Integer::binomial(degree as u32, k as u32))
        .collect()
}

/// det(b₀, b₁) of the polynomials of degree n−2 on the differences j … j+n−2.
fn minor_of_differences(columns: &[Vec<Integer>; 2], n: usize) -> Vec<Integer> {
    let b = |column: usize, j: usize| scaled(&columns[column][j..=j + n - 2]);
    let mut minor = convolution(&b(0, 0), &b(1, 1));
    for (x, y) in minor.iter_mut().zip(convolution(&b(1, 0), &b(0, 1))) {
        *x -= y;
    }
    minor
}

/// det(b₀, b₁, b₂) of the polynomials of degree n−2 on the homogeneous control points j … j+n−2, weight first.
fn minor_of_points(columns: &[Vec<Integer>; 3], n: usize) -> Vec<Integer> {
    let b = |column: usize, j: usize| scaled(&columns[column][j..=j + n - 2]);
    let mut minor = vec![Integer::ZERO; 3 * (n - 2) + 1];
    for [i, j, k] in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
        let first = b(i, 0);
        let even = convolution(&b(j, 1), &b(k, 2));
        let odd = convolution(&b(k, 1), &b(j, 2));
        let difference: Vec<Integer> = even.into_iter().zip(odd).map(|(x, y)| x - y).collect();
        for (x, y) in minor.iter_mut().zip(convolution(&first, &difference)) {
            *x += y;
        }
    }
    minor
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Bezier, Curve, Form};
    use crate::number::RationalVector;

    fn fraction(p: i64, q: i64) -> Rational {
        Rational::new(p.into(), q.into())
    }

    /// |c'×c''|²/|c'|⁶ from exact derivatives, which `curve` computes in another way.
    fn by_derivatives(piece: &Bezier, u: &Rational) -> Rational {
        let v = piece.derivatives(u, 2).expect("inside");
        let zero = fraction(0, 1);
        let at = |k: usize, i: usize| v[k].get(i).unwrap_or(&zero).clone();
        let cross = |i: usize, j: usize| at(1, i) * at(2, j) - at(1, j) * at(2, i);
        let speed: Rational = (0..3).map(|i| at(1, i) * at(1, i)).fold(zero.clone(), |s, x| s + x);
        let crosses = PLANES.iter().map(|(i, j)| cross(*i, *j)).map(|x| &x * &x);
        crosses.fold(zero.clone(), |s, x| s + x) / (&speed * &speed * &speed)
    }

    /// Numbers from a small generator, enough for control points.
    fn numbers(seed: u64, count: usize, low: i64, high: i64) -> Vec<Rational> {
        let mut state = seed;
        let mut next = || {
            state = state
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            low + ((state >> 33) % (high - low + 1) as u64) as i64
        };
        (0..count).map(|i| fraction(next(), 1 + (i % 3) as i64)).collect()
    }

    #[test]
    fn the_quotient_is_the_curvature_from_derivatives() {
        for n in 1..=6 {
            for d in [2, 3] {
                for rational in [false, true] {
                    let points = RationalVector::from_rationals(&numbers(7 * n as u64 + d as u64, (n + 1) * d, -9, 9));
                    let weights = RationalVector::from_rationals(&numbers(n as u64, n + 1, 1, 8));
                    let piece = Bezier::new(d, points, rational.then_some(weights)).expect("a piece");
                    let curve = Curve::new(d, Form::Bezier(vec![piece.clone()])).expect("a curve");
                    let chain = Chain::new(&curve).expect("no point");
                    let field = Field::new(&chain, 0);
                    assert_eq!(field.bend().len(), field.speed().len(), "degree {n}");
                    for u in [fraction(0, 1), fraction(1, 1), fraction(2, 7), fraction(5, 8)] {
                        let expected = by_derivatives(&piece, &u);
                        assert_eq!(
                            field.squared_at(&u),
                            Some(expected.clone()),
                            "degree {n}, {d}, {rational}"
                        );
                        let quotient = Rational::new(value(&field.bend(), &u), value(&field.speed(), &u));
                        assert_eq!(quotient * &field.factor, expected, "degree {n}, {d}, {rational}");
                    }
                }
            }
        }
    }
}
