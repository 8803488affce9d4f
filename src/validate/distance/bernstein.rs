//! The squared distance of two pieces as a quotient of polynomials in Bernstein form, rounded towards smaller distances.

use super::ExactPiece;
use crate::number::{Integer, Rational, RationalExt};

/// Bits after the binary point of coefficients relative to the largest: squared weights over six orders of magnitude on both sides
/// take 80 of them, squared distances the rest.
const BITS: i64 = 240;
/// Bits of λ that choose a direction.
const COARSE: i64 = 64;
/// The most halvings in one direction.
const DEEPEST: u32 = 60;

/// A part of the parameter square of a pair of pieces: G / D bounds the squared distance below, in units of 2^`exponent`.
pub(super) struct Pair {
    /// Degrees of both polynomials in u and v.
    degrees: (usize, usize),
    /// Coefficients of G, rounded down; v runs faster.
    numerator: Vec<Integer>,
    /// Coefficients of D, rounded up.
    denominator: Vec<Integer>,
    /// The part is [u, u + 2^-depth] × [v, v + 2^-depth].
    start: (f64, f64),
    depth: (u32, u32),
}

impl Pair {
    /// The whole square; coordinates are at most about `scale`.
    pub(super) fn new(a: &ExactPiece, b: &ExactPiece, scale: f64) -> Pair {
        let (p, q) = (a.control.len() - 1, b.control.len() - 1);
        let axes = a.control[0].len() - 1;
        let degrees = (2 * p, 2 * q);
        let count = (degrees.0 + 1) * (degrees.1 + 1);
        let mut numerator = vec![Rational::default(); count];
        let mut denominator = vec![Rational::default(); count];
        let first_binomials = square_factors(p);
        let second_binomials = square_factors(q);
        let factor = |i: usize, k: usize, j: usize, l: usize| &first_binomials[i][k] * &second_binomials[j][l];
        // Coefficients of N(u) V(v) − M(v) W(u) for each axis, and of W(u) V(v).
        let mut linear: Vec<Vec<Rational>> = Vec::with_capacity((p + 1) * (q + 1));
        for x in &a.control {
            for y in &b.control {
                let (w, v) = (&x[axes], &y[axes]);
                let mut entry: Vec<Rational> = (0..axes).map(|axis| &x[axis] * v - &y[axis] * w).collect();
                entry.push(w * v);
                linear.push(entry);
            }
        }
        for i in 0..=p {
            for k in 0..=p {
                for j in 0..=q {
                    for l in 0..=q {
                        let (x, y) = (&linear[i * (q + 1) + j], &linear[k * (q + 1) + l]);
                        let at = (i + k) * (degrees.1 + 1) + j + l;
                        let factor = factor(i, k, j, l);
                        let dot = (0..axes).fold(Rational::default(), |sum, axis| sum + &x[axis] * &y[axis]);
                        numerator[at] += dot * &factor;
                        denominator[at] += &x[axes] * &y[axes] * factor;
                    }
                }
            }
        }
        // A common power of two brings the largest possible coefficient near 2^BITS.
        let largest = denominator.iter().max().map_or(1.0, RationalExt::to_f64);
        let exponent = BITS - (largest * (scale * scale).max(1.0)).log2().ceil() as i64;
        let shifted = |x: &Rational| match u32::try_from(exponent) {
            Ok(bits) => (x.floor_shifted(bits), x.ceil_shifted(bits)),
            Err(_) => {
                let by = exponent.unsigned_abs() as u32;
                (x.floor_shifted(0) >> by, (x.ceil_shifted(0) >> by) + Integer::ONE)
            }
        };
        Pair {
            degrees,
            numerator: numerator.iter().map(|x| shifted(x).0).collect(),
            denominator: denominator.iter().map(|x| shifted(x).1).collect(),
            start: (0.0, 0.0),
            depth: (0, 0),
        }
    }

    /// Whether no two points of the part are nearer than the square root of `squared`.
    pub(super) fn all_at_least(&self, squared: &Rational) -> bool {
        let (n, d) = (squared.numer(), squared.denom());
        let mut entries = self.numerator.iter().zip(&self.denominator);
        entries.all(|(g, h)| g * d >= h * n)
    }

    /// Whether the part cannot be halved further.
    pub(super) fn is_tiny(&self) -> bool {
        self.depth.0 >= DEEPEST || self.depth.1 >= DEEPEST
    }

    /// The middle of the part.
    pub(super) fn middle(&self) -> (f64, f64) {
        let half = |start: f64, depth: u32| start + 0.5_f64.powi(depth as i32 + 1);
        (half(self.start.0, self.depth.0), half(self.start.1, self.depth.1))
    }

    /// Two halves, in the direction in which the coefficients of G − λD differ more, λ = `squared` to some digits. Those of G alone would not do: where weights differ, G follows
    /// D in one direction however small the part is.
    pub(super) fn halves(&self, squared: &Rational) -> (Pair, Pair) {
        let shift = (COARSE - squared.numer().bits() as i64 + squared.denom().bits() as i64).max(0) as u32;
        let factor = squared.floor_shifted(shift);
        let entries = self.numerator.iter().zip(&self.denominator);
        let difference: Vec<Integer> = entries.map(|(g, h)| (g << shift) - h * &factor).collect();
        let in_u = self.spread(&difference, true) >= self.spread(&difference, false);
        let (first, second) = split(&self.numerator, self.degrees, in_u, false);
        let (first_denominator, second_denominator) = split(&self.denominator, self.degrees, in_u, true);
        let half = |numerator, denominator, step: bool| {
            let mut half = Pair {
                degrees: self.degrees,
                numerator,
                denominator,
                start: self.start,
                depth: self.depth,
            };
            let (start, depth) = if in_u {
                (&mut half.start.0, &mut half.depth.0)
            } else {
                (&mut half.start.1, &mut half.depth.1)
            };
            *depth += 1;
            if step {
                *start += 0.5_f64.powi(*depth as i32);
            }
            half
        };
        (
            half(first, first_denominator, false),
            half(second, second_denominator, true),
        )
    }

    /// The largest difference of neighbouring coefficients in one direction; −1 in a direction of degree 0.
    fn spread(&self, coefficients: &[Integer], in_u: bool) -> Integer {
        let row = self.degrees.1 + 1;
        let step = if in_u { row } else { 1 };
        let mut most = Integer::from(-1);
        for i in 0..coefficients.len().saturating_sub(step) {
            if in_u || (i + 1) % row != 0 {
                let difference = (&coefficients[i + step] - &coefficients[i]).abs();
                most = most.max(difference);
            }
        }
        most
    }
}

/// C(n, i) C(n, k) / C(2n, i + k): the product of B_i and B_k in terms of B_{i+k}.
fn square_factors(n: usize) -> Vec<Vec<Rational>> {
    let binomial = |n: usize, k: usize| Integer::binomial(n as u32, k as u32);
    let factor = |i: usize, k: usize| Rational::new(binomial(n, i) * binomial(n, k), binomial(2 * n, i + k));
    (0..=n).map(|i| (0..=n).map(|k| factor(i, k)).collect()).collect()
}

/// De Casteljau's algorithm at ½ in one direction, every mean rounded down, or up.
fn split(all: &[Integer], degrees: (usize, usize), in_u: bool, up: bool) -> (Vec<Integer>, Vec<Integer>) {
    let row = degrees.1 + 1;
    let (lines, length, step, next) = if in_u {
        (row, degrees.0 + 1, row, 1)
    } else {
        (degrees.0 + 1, row, 1, row)
    };
    let round = if up { Integer::ONE } else { Integer::ZERO };
    let (mut first, mut second) = (all.to_vec(), all.to_vec());
    for line in 0..lines {
        let base = line * next;
        for level in 1..length {
            // The second half's array is the working one; its entry 0 after each level belongs to the first half.
            for k in 0..length - level {
                let at = base + k * step;
                second[at] = (&second[at] + &second[at + step] + &round) >> 1;
            }
            first[base + level * step] = second[base].clone();
        }
    }
    (first, second)
}
