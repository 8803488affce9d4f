//! Outcome `nearest`: the least distance from a point to cl K ∩ B.
//!
//! With z − y = Σ λ_i A_i and λ ≥ 0, for every x of cl K ∩ B: |x−y|² ≥ |z−y|² + 2(z−y)·(x−z) = |z−y|² + 2 Σ λ_i (row_i(x) − row_i(z))
//! ≥ |z−y|² − 2 Σ λ_i row_i(z).

use super::combination::combine;
use super::{Checked, Context, fails, fair_point};
use crate::check::polynomial::Bound;
use crate::claim::domain::{Evidence, Target};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt};

pub fn squared_distance(a: &[Rational], b: &[Rational]) -> Rational {
    let squares = a.iter().zip(b).map(|(x, y)| (x - y) * (x - y));
    squares.fold(Rational::from_integer(Integer::ZERO), |sum, square| sum + square)
}

pub fn check(
    context: &Context,
    curve: &Curve,
    evidence: &Evidence,
    to: &Target,
    [lower_squared, upper_squared]: [&Rational; 2],
) -> Checked {
    let Evidence::Nearest {
        center,
        point,
        base,
        rows,
        multipliers,
    } = evidence
    else {
        return fails("the evidence of a nearest point", "that of another outcome");
    };
    let target = match to {
        Target::Point(target) => target.clone(),
        Target::Fair => match fair_point(curve, &context.domain.points) {
            Some(target) => target,
            None => {
                return fails(
                    "a polynomial curve whose second derivative depends on the points",
                    "another curve",
                );
            }
        },
    };
    context.point(center, Bound::Positive, "center")?;
    context.point(point, Bound::NonNegative, "point")?;
    if *upper_squared < squared_distance(point, &target) {
        return fails(
            "upper_squared at least the point's squared distance",
            upper_squared.format(),
        );
    }
    let rows = context.rows(rows)?;
    let sum = combine(context, &rows, multipliers)?;
    let stationary = (0..context.dimension).all(|axis| &base[axis] - &target[axis] == sum.linear[axis]);
    if !stationary {
        return fails(
            "base minus target equal to the combination of normals",
            "another vector",
        );
    }
    let products = sum.linear.iter().zip(base).map(|(a, z)| a * z);
    let at_base = products.fold(sum.constant, |total, product| total + product);
    let bound = squared_distance(base, &target) - &at_base - &at_base;
    if lower_squared.numer().is_negative() || *lower_squared > bound {
        return fails(
            "0 ≤ lower_squared ≤ the bound of the multipliers",
            lower_squared.format(),
        );
    }
    Ok(())
}
