//! Outcome `change`: how far a position in K is from where the sign is no longer kept.

use super::nearest::squared_distance;
use super::sign::Section;
use super::{Checked, Context, fails};
use crate::check::polynomial::{self, Bound, NotShown, scaled_product, unscaled};
use crate::claim::domain::Row;
use crate::number::{Integer, Rational, RationalExt, RationalVector};

/// Shows that the ball of radius √`radius_squared` around a point of K is in cl K: g(u;p)² ≥ r²·|A(u)|² on every section.
pub fn show_ball(context: &Context, center: &[Rational], radius_squared: &Rational) -> Checked {
    let center = RationalVector::from_rationals(center);
    let (point, denominator) = (center.numerators(), center.denominator());
    for section in &context.sections {
        let difference = ball_polynomial(section, point, denominator, radius_squared);
        match polynomial::show(difference, Bound::NonNegative) {
            Ok(()) => {}
            Err(NotShown::At { numerator, halvings }) => {
                let u = section.local(numerator, halvings).format();
                let found = format!("a sign change nearer than that at {u} of piece {}", section.piece);
                return fails("a ball within the domain", found);
            }
            Err(NotShown::Limits) => {
                let found = format!("no end of halving on piece {}", section.piece);
                return fails("a ball within the domain", found);
            }
        }
    }
    Ok(())
}

/// q²·s·(g(u; p/q)² − (r/s)·|A(u)|²), up to a positive factor.
fn ball_polynomial(
    section: &Section,
    point: &[Integer],
    denominator: &Integer,
    radius_squared: &Rational,
) -> Vec<Integer> {
    let values = section.at(point, denominator);
    let mut sum: Vec<Integer> = scaled_product(&values, &values)
        .iter()
        .map(|x| x * radius_squared.denom())
        .collect();
    let factor = radius_squared.numer() * denominator * denominator;
    for axis in 0..point.len() {
        let column: Vec<Integer> = section.coefficients.iter().map(|c| c.linear[axis].clone()).collect();
        for (total, square) in sum.iter_mut().zip(scaled_product(&column, &column)) {
            *total -= square * &factor;
        }
    }
    unscaled(sum).0
}

pub fn check(
    context: &Context,
    from: &[Rational],
    [lower_squared, upper_squared]: [&Rational; 2],
    row: &Row,
) -> Checked {
    let integers = RationalVector::from_rationals(from);
    context.shown(integers.numerators(), integers.denominator(), Bound::Positive, || {
        "position".into()
    })?;
    if lower_squared.numer().is_negative() {
        return fails("lower_squared ≥ 0", lower_squared.format());
    }
    show_ball(context, from, lower_squared)?;
    let Row::Parameter { .. } = row else {
        return fails("a row of a piece", "a side of the box");
    };
    let Some(row) = context.row(row) else {
        return fails("a row of a section", "a parameter outside");
    };
    let zero = vec![Rational::from_integer(Integer::ZERO); context.dimension];
    let linear: Vec<Rational> = row.affine.linear.iter().cloned().map(Rational::from_integer).collect();
    let normal = squared_distance(&linear, &zero);
    let value = Rational::new(
        row.affine.at(integers.numerators(), integers.denominator()),
        integers.denominator().clone(),
    );
    if normal.numer().is_zero() || &value * &value > upper_squared * normal {
        return fails("a row that vanishes within upper_squared", upper_squared.format());
    }
    Ok(())
}
