//! The method before CPJ12 (Miller, Moore, Peters, Russell 2008), as CPJ12 §4.3 state it: a uniform partition with
//! |s_{i+1} − s_i| < min(ε/(√3·K₀), sin(ε/2)·μ₀/K₁).

use super::ApproximationError;
use super::difference::{differences, whole};
use super::enclosure::{greatest_infinity_norm, least_infinity_norm, sine};
use super::power::least_power;
use crate::curve::Chain;
use crate::number::Rational;

/// Enclosures are narrowed to a relative width of 2^-40.
const BITS: u32 = 40;
/// Bits of the sine.
const SINE_BITS: u32 = 200;

/// A number of subdivisions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subdivisions {
    /// ⌈…⌉ exactly; it may be negative.
    Exactly(i64),
    /// Every number will do: the formula takes log 0.
    Any,
    /// No number will do (the derivative vanishes), or the enclosures do not tell it.
    Undecided,
}

/// The quantities of the partition, each on the pieces' own parameters 0 ≤ u ≤ 1 and enclosed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Extremes {
    /// K₀ = max ‖c'‖_∞.
    pub speed: [Rational; 2],
    /// K₁ = max ‖c''‖_∞.
    pub acceleration: [Rational; 2],
    /// μ₀ = min ‖c'‖_∞.
    pub least_speed: [Rational; 2],
}

/// Encloses K₀, K₁ and μ₀ of a polynomial chain.
///
/// # Errors
/// [`ApproximationError::RationalPiece`].
pub fn extremes(chain: &Chain) -> Result<Extremes, ApproximationError> {
    let mut first = Vec::new();
    let mut second = Vec::new();
    for (i, piece) in chain.pieces().iter().enumerate() {
        if !piece.is_polynomial() {
            return Err(ApproximationError::RationalPiece { piece: i });
        }
        let n = piece.degree();
        let points: Vec<Vec<Rational>> = (0..=n).map(|k| piece.point(k)).collect();
        let derivative = scaled(&differences(&points), n);
        if n > 1 {
            second.push(scaled(&differences(&derivative), n - 1));
        }
        first.push(derivative);
    }
    Ok(Extremes {
        speed: greatest_infinity_norm(&first, BITS),
        acceleration: greatest_infinity_norm(&second, BITS),
        least_speed: least_infinity_norm(&first, BITS),
    })
}

fn scaled(vectors: &[Vec<Rational>], factor: usize) -> Vec<Vec<Rational>> {
    let factor = whole(factor);
    vectors
        .iter()
        .map(|vector| vector.iter().map(|x| x * &factor).collect())
        .collect()
}

impl Extremes {
    /// m̃₁ = ⌈−log₂(ε/(√3·K₀))⌉ for an enclosed ε > 0: the least m with 4^m ≥ 3K₀²/ε².
    pub fn m1(&self, epsilon: &[Rational; 2]) -> Subdivisions {
        let ratio = |speed: &Rational, epsilon: &Rational| whole(3) * speed * speed / (epsilon * epsilon);
        if !epsilon[0].numer().is_positive() {
            return Subdivisions::Undecided;
        }
        decide(
            ratio(&self.speed[0], &epsilon[1]),
            ratio(&self.speed[1], &epsilon[0]),
            2,
        )
    }

    /// m̃₂ = ⌈−log₂(sin(ε/2)·μ₀/K₁)⌉ for an enclosed 0 < ε ≤ 2: the least m with 2^m ≥ K₁/(sin(ε/2)·μ₀).
    pub fn m2(&self, epsilon: &[Rational; 2]) -> Subdivisions {
        let half = |x: &Rational| sine(&(x / whole(2)), SINE_BITS);
        let (Some(low), Some(high)) = (half(&epsilon[0]), half(&epsilon[1])) else {
            return Subdivisions::Undecided;
        };
        let least = low.0 * &self.least_speed[0];
        let most = high.1 * &self.least_speed[1];
        if !least.numer().is_positive() {
            return Subdivisions::Undecided;
        }
        decide(&self.acceleration[0] / most, &self.acceleration[1] / least, 1)
    }

    /// m̃ = max(m̃₁, m̃₂).
    pub fn subdivisions(&self, epsilon: &[Rational; 2]) -> Subdivisions {
        match (self.m1(epsilon), self.m2(epsilon)) {
            (Subdivisions::Exactly(m1), Subdivisions::Exactly(m2)) => Subdivisions::Exactly(m1.max(m2)),
            (Subdivisions::Any, m) | (m, Subdivisions::Any) => m,
            _ => Subdivisions::Undecided,
        }
    }
}

/// The rounded-up logarithm of a ratio between two bounds.
fn decide(low: Rational, high: Rational, bits: u32) -> Subdivisions {
    match (least_power(&low, bits), least_power(&high, bits)) {
        (None, None) => Subdivisions::Any,
        (Some(low), Some(high)) if low == high => Subdivisions::Exactly(low),
        _ => Subdivisions::Undecided,
    }
}
