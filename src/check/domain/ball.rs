//! Outcome `ball`: the radius of the largest ball in cl K ∩ B.
//!
//! A ball of radius ρ around y in cl K ∩ B has row_i(y) ≥ ρ·|A_i| for every row; with Σ λ_i A_i = 0 this adds up to Σ λ_i b_i ≥ ρ·Σ λ_i|A_i|.

use super::change::show_ball;
use super::combination::combine;
use super::{Checked, Context, fails};
use crate::check::polynomial::Bound;
use crate::claim::domain::Evidence;
use crate::number::{Integer, Rational, RationalExt};

pub fn check(context: &Context, evidence: &Evidence, [lower, upper]: [&Rational; 2]) -> Checked {
    let Evidence::Ball {
        center,
        rows,
        multipliers,
        lengths,
    } = evidence
    else {
        return fails("the evidence of a ball", "that of another outcome");
    };
    let zero = Rational::from_integer(Integer::ZERO);
    if *lower <= zero {
        return fails("a positive radius", lower.format());
    }
    let bounds = &context.domain.bounds;
    let within =
        |axis: usize| &center[axis] - &bounds.low[axis] >= *lower && &bounds.high[axis] - &center[axis] >= *lower;
    if !(0..context.dimension).all(within) {
        return fails("a ball within the box", "one that leaves it");
    }
    context.point(center, Bound::Positive, "center")?;
    show_ball(context, center, &(lower * lower))?;
    let rows = context.rows(rows)?;
    let sum = combine(context, &rows, multipliers)?;
    if sum.linear.iter().any(|part| *part != zero) {
        return fails("a combination of normals that vanishes", "one that does not");
    }
    if lengths.len() != rows.len() {
        return fails("as many lengths as rows", lengths.len().to_string());
    }
    let mut total = zero.clone();
    for (i, ((row, multiplier), length)) in rows.iter().zip(multipliers).zip(lengths).enumerate() {
        let squares = row.affine.linear.iter().map(|x| x * x);
        let squared = squares.fold(Integer::ZERO, |sum, square| sum + square);
        let normal = &row.scale * &row.scale * Rational::from_integer(squared);
        if *length < zero || length * length > normal {
            return fails(
                "lengths at most those of the normals",
                format!("a longer one of row {i}"),
            );
        }
        total += multiplier * length;
    }
    if total == zero {
        return fails("a positive sum of multipliers times lengths", "0");
    }
    if sum.constant > upper * total {
        return fails("an upper bound at least that of the multipliers", upper.format());
    }
    Ok(())
}
