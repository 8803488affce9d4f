//! Tangent directions at the ends of pieces, and the joints between pieces.

use num_traits::{Signed, Zero};

use super::{Bezier, Chain};
use crate::number::Rational;

/// How the two pieces at a joint meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joint {
    /// The one-sided tangent directions are parallel with positive dot product (G1).
    Smooth,
    /// The directions differ, a turn by 180° included.
    Corner,
    /// One of the pieces is a single point and has no direction.
    Undirected,
}

impl Bezier {
    /// The forward tangent direction at u = 0, up to a positive factor: P_k − P_0 for the first P_k ≠ P_0, on rational
    /// pieces too. Nothing when the piece is a single point.
    pub fn start_direction(&self) -> Option<Vec<Rational>> {
        (1..=self.degree).find_map(|k| self.difference(0, k))
    }

    /// The forward tangent direction at u = 1, up to a positive factor: P_n − P_k for the last P_k ≠ P_n. Nothing when
    /// the piece is a single point.
    pub fn end_direction(&self) -> Option<Vec<Rational>> {
        let n = self.degree;
        (0..n).rev().find_map(|k| self.difference(k, n))
    }

    /// P_j − P_i unless zero.
    fn difference(&self, i: usize, j: usize) -> Option<Vec<Rational>> {
        let d = self.dimension;
        let x = self.points.numerators();
        if (0..d).all(|axis| x[i * d + axis] == x[j * d + axis]) {
            return None;
        }
        let denominator = self.points.denominator();
        Some(
            (0..d)
                .map(|axis| {
                    let difference = &x[j * d + axis] - &x[i * d + axis];
                    Rational::new(difference, denominator.clone())
                })
                .collect(),
        )
    }
}

impl Chain<'_> {
    /// How the pieces meet at the joint i, 0 < i < M, or at the closing point, i = 0, of a closed chain. Nothing
    /// elsewhere.
    pub fn joint(&self, i: usize) -> Option<Joint> {
        let pieces = self.pieces();
        let (before, after) = match i {
            0 if self.closed() => (pieces.last()?, pieces.first()?),
            0 => return None,
            _ => (&pieces[i - 1], pieces.get(i)?),
        };
        let (Some(v), Some(w)) = (before.end_direction(), after.start_direction()) else {
            return Some(Joint::Undirected);
        };
        Some(if is_same_direction(&v, &w) {
            Joint::Smooth
        } else {
            Joint::Corner
        })
    }
}

/// Whether two non-zero vectors are parallel with positive dot product.
fn is_same_direction(v: &[Rational], w: &[Rational]) -> bool {
    let d = v.len();
    let dot = (0..d).fold(Rational::zero(), |sum, i| sum + &v[i] * &w[i]);
    let parallel = (0..d).all(|i| (0..i).all(|j| &v[i] * &w[j] == &v[j] * &w[i]));
    parallel && dot.is_positive()
}
