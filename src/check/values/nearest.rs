//! The distance of a point from the curve.

use super::super::polynomial::{Bound, NotShown, convolution, scaled, show, unscaled};
use super::pieces::Pieces;
use crate::number::{Integer, Rational, RationalVector};

/// |p − q|².
pub fn squared_distance(p: &[Rational], q: &[Rational]) -> Rational {
    p.iter()
        .zip(q)
        .fold(Rational::from_integer(Integer::ZERO), |sum, (x, y)| {
            let difference = x - y;
            sum + &difference * &difference
        })
}

/// Shows by halving that |X − w·target|² − lower·w² ≥ 0 on every piece.
///
/// # Errors
/// The number of a piece, and where it is not shown there.
pub fn show_lower(pieces: &Pieces, target: &[Rational], lower_squared: &Rational) -> Result<(), (usize, NotShown)> {
    let target = RationalVector::from_rationals(target);
    let (y, q) = (target.numerators(), target.denominator());
    for (number, piece) in pieces.pieces.iter().enumerate() {
        let columns: Vec<Vec<Integer>> = piece.columns.iter().map(|column| scaled(column)).collect();
        let (w, axes) = columns.split_last().expect("a column of weights");
        let factor = lower_squared.numer() * q * q;
        let mut room: Vec<Integer> = convolution(w, w).iter().map(|x| -(x * &factor)).collect();
        for (column, y) in axes.iter().zip(y) {
            let difference: Vec<Integer> = column.iter().zip(w).map(|(x, w)| x * q - w * y).collect();
            for (total, square) in room.iter_mut().zip(convolution(&difference, &difference)) {
                *total += square * lower_squared.denom();
            }
        }
        show(unscaled(room).0, Bound::NonNegative).map_err(|why| (number, why))?;
    }
    Ok(())
}
