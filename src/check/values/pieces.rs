//! A curve as pieces over intervals of its knots, in integers.

use super::super::chain::Chain;
use super::super::deviation::{Part, parts};
use super::super::rule::Failure;
use crate::claim::values::Side;
use crate::curve::{Curve, Form};
use crate::number::{Integer, Rational, RationalExt};

/// The pieces of a curve with the knots at their ends.
pub struct Pieces {
    /// 2 or 3.
    pub dimension: usize,
    /// The knots at the ends of the pieces, increasing, one more than pieces.
    pub ends: Vec<Rational>,
    /// The pieces in order.
    pub pieces: Vec<Part>,
}

/// A parameter on a piece.
pub struct Place<'p> {
    /// The piece.
    pub piece: &'p Part,
    /// The local parameter, 0 to 1.
    pub u: Rational,
    /// The length of the piece's interval of knots.
    pub length: Rational,
}

impl Pieces {
    /// The pieces of a curve, or the number of the first piece that is a single point.
    pub fn new(curve: &Curve) -> Result<Pieces, usize> {
        let chain = Chain::new(curve)?;
        let ends = match curve.form() {
            Form::BSpline(spline) => {
                let mut ends: Vec<Rational> = (spline.degree()..=spline.count())
                    .map(|i| spline.knots().get(i))
                    .collect();
                ends.dedup();
                ends
            }
            Form::Bezier(pieces) => (0..=pieces.len())
                .map(|i| Rational::from_integer(Integer::from(i)))
                .collect(),
        };
        let pieces = (0..chain.count()).flat_map(|i| parts(&chain, i, 0)).collect();
        Ok(Pieces {
            dimension: chain.dimension,
            ends,
            pieces,
        })
    }

    /// The first and the last parameter.
    pub fn domain(&self) -> [&Rational; 2] {
        [&self.ends[0], &self.ends[self.pieces.len()]]
    }

    /// The piece on one side of a parameter.
    ///
    /// # Errors
    /// A parameter outside the domain, or a side on which there is no curve.
    pub fn place(&self, t: &Rational, side: Side) -> Result<Place<'_>, Failure> {
        let [start, end] = self.domain();
        let outside = match side {
            Side::Left => t <= start || t > end,
            Side::Right => t < start || t >= end,
        };
        if outside {
            return Err(Failure {
                expected: "a parameter of the curve, and a side on which there is the curve",
                found: format!("{}, {}", t.format(), side.name()),
            });
        }
        // The first end that is not before, or not at and before, the parameter.
        let after = match side {
            Side::Left => self.ends.partition_point(|end| end < t),
            Side::Right => self.ends.partition_point(|end| end <= t),
        };
        let (low, high) = (&self.ends[after - 1], &self.ends[after]);
        let length = high - low;
        Ok(Place {
            piece: &self.pieces[after - 1],
            u: (t - low) / &length,
            length,
        })
    }

    /// The point c(t).
    ///
    /// # Errors
    /// A parameter outside the domain.
    pub fn point(&self, t: &Rational) -> Result<Vec<Rational>, Failure> {
        let side = if t == self.domain()[0] { Side::Right } else { Side::Left };
        let place = self.place(t, side)?;
        let values: Vec<Integer> = place
            .piece
            .columns
            .iter()
            .map(|column| bernstein_sum(column, &place.u))
            .collect();
        let (weight, point) = values.split_last().expect("a column of weights");
        Ok(point.iter().map(|x| Rational::new(x.clone(), weight.clone())).collect())
    }
}

/// Σ x_k C(n,k) u^k (1−u)^{n−k}, times the n-th power of u's denominator.
fn bernstein_sum(column: &[Integer], u: &Rational) -> Integer {
    let degree = column.len() - 1;
    let (a, b) = (u.numer(), u.denom() - u.numer());
    let mut powers = vec![Integer::ONE];
    for k in 0..degree {
        powers.push(&powers[k] * &b);
    }
    let mut total = Integer::ZERO;
    let mut power = Integer::ONE;
    for (k, x) in column.iter().enumerate() {
        let binomial = Integer::binomial(degree as u32, k as u32);
        total += x * binomial * &power * &powers[degree - k];
        power *= a;
    }
    total
}
