//! Non-negative combinations of rows, and the outcome `empty`.

use super::{Checked, Context, Exact, fails};
use crate::claim::domain::Row;
use crate::number::{Integer, Rational};

/// Σ λ·row, exactly.
pub struct Combination {
    /// The linear part.
    pub linear: Vec<Rational>,
    /// The constant.
    pub constant: Rational,
}

/// The combination of rows with multipliers that must be ≥ 0 and as many.
pub fn combine(context: &Context, rows: &[Exact], multipliers: &[Rational]) -> Checked<Combination> {
    if rows.len() != multipliers.len() {
        return fails("as many multipliers as rows", multipliers.len().to_string());
    }
    let mut sum = Combination {
        linear: vec![Rational::from_integer(Integer::ZERO); context.dimension],
        constant: Rational::from_integer(Integer::ZERO),
    };
    for (i, (row, multiplier)) in rows.iter().zip(multipliers).enumerate() {
        if multiplier.numer().is_negative() {
            return fails("multipliers ≥ 0", format!("a negative one of row {i}"));
        }
        let factor = multiplier * &row.scale;
        for (total, part) in sum.linear.iter_mut().zip(&row.affine.linear) {
            *total = &*total + &factor * Rational::from_integer(part.clone());
        }
        sum.constant = &sum.constant + &factor * Rational::from_integer(row.affine.constant.clone());
    }
    Ok(sum)
}

/// Outcome `empty`: a combination of rows that is a constant and not positive.
pub fn check_empty(context: &Context, rows: &[Row], multipliers: &[Integer]) -> Checked {
    let rows = context.rows(rows)?;
    let fractions: Vec<Rational> = multipliers.iter().cloned().map(Rational::from_integer).collect();
    let sum = combine(context, &rows, &fractions)?;
    if multipliers.iter().all(Integer::is_zero) {
        return fails("a multiplier other than 0", "none");
    }
    if sum.linear.iter().any(|part| !part.numer().is_zero()) {
        return fails("a combination constant in x", "one that is not");
    }
    let strict = rows
        .iter()
        .zip(multipliers)
        .any(|(row, m)| row.strict && m.is_positive());
    let constant = sum.constant.numer();
    if constant.is_negative() || (constant.is_zero() && strict) {
        Ok(())
    } else {
        fails(
            "a combination that is negative, or 0 with a strict row",
            "one that is not",
        )
    }
}
