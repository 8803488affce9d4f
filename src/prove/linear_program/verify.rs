//! The check of an answer: a few sums.

use super::{Row, Solution};
use crate::number::{Integer, Rational, RationalVector};

/// Does the solution prove itself: are all (in)equalities that [`Solution`] names true?
///
/// `false` too when numbers of entries do not fit together.
pub fn is_proof(objective: &[Integer], rows: &[Row], solution: &Solution) -> bool {
    match solution {
        Solution::Optimal {
            point,
            value,
            basis,
            multipliers,
        } => {
            let Some((linear, constant)) = combine(objective.len(), rows, basis, multipliers) else {
                return false;
            };
            let opposite = |(c, a): (&Integer, &Rational)| a.is_integer() && *a.numer() == -c;
            basis.len() <= objective.len()
                && is_feasible(objective.len(), rows, point)
                && objective.iter().zip(&linear).all(opposite)
                && constant == *value
                && dot(objective, point) == *value
        }
        Solution::Unbounded { point, ray } => {
            let vector = RationalVector::from_rationals(ray);
            ray.len() == objective.len()
                && is_feasible(objective.len(), rows, point)
                && rows
                    .iter()
                    .all(|row| !product(&row.normal, vector.numerators()).is_negative())
                && product(objective, vector.numerators()).is_positive()
        }
        Solution::Infeasible {
            rows: chosen,
            multipliers,
        } => match combine(objective.len(), rows, chosen, multipliers) {
            Some((linear, constant)) => {
                chosen.len() <= objective.len() + 1
                    && constant.numer().is_negative()
                    && linear.iter().all(|a| a.numer().is_zero())
            }
            None => false,
        },
    }
}

/// The sum of products of two equally long vectors.
pub fn product(a: &[Integer], b: &[Integer]) -> Integer {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

fn dot(a: &[Integer], b: &[Rational]) -> Rational {
    let vector = RationalVector::from_rationals(b);
    Rational::new(product(a, vector.numerators()), vector.denominator().clone())
}

fn is_feasible(n: usize, rows: &[Row], point: &[Rational]) -> bool {
    let vector = RationalVector::from_rationals(point);
    let slack = |row: &Row| product(&row.normal, vector.numerators()) + &row.constant * vector.denominator();
    point.len() == n && rows.iter().all(|row| !slack(row).is_negative())
}

/// Σ multiplier·normal and Σ multiplier·constant; `None` for a negative multiplier, or one without row.
fn combine(n: usize, rows: &[Row], chosen: &[usize], multipliers: &[Rational]) -> Option<(Vec<Rational>, Rational)> {
    if chosen.len() != multipliers.len() || multipliers.iter().any(|m| m.numer().is_negative()) {
        return None;
    }
    let chosen: Vec<&Row> = chosen.iter().map(|i| rows.get(*i)).collect::<Option<_>>()?;
    let sum = |part: &dyn Fn(&Row) -> Integer| {
        let parts: Vec<Integer> = chosen.iter().map(|row| part(row)).collect();
        dot(&parts, multipliers)
    };
    let linear = (0..n).map(|axis| sum(&|row| row.normal[axis].clone())).collect();
    Some((linear, sum(&|row| row.constant.clone())))
}
