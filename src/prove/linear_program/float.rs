//! What a float solver suggests.

use std::panic::{AssertUnwindSafe, catch_unwind};

use good_lp::solvers::WithTimeLimit;
use good_lp::{Expression, ProblemVariables, Solution, SolverModel, constraint, microlp, variable};

use super::Row;
use crate::number::{Integer, Rational, RationalExt};

/// A solver of linear programs in binary64, trusted with nothing.
pub trait FloatSolver {
    /// A point thought to maximise objective·x where normal·x + constant ≥ 0 for every (normal, constant); `None` when it knows none.
    ///
    /// Numbers are finite, the entries of objective and normals at most 1. Whatever it answers, NaN, infinities, a wrong number of coordinates
    /// and a panic included, the exact result is right; a good answer makes it quick.
    fn solve(&self, objective: &[f64], rows: &[(Vec<f64>, f64)]) -> Option<Vec<f64>>;
}

/// No suggestion.
impl FloatSolver for () {
    fn solve(&self, _objective: &[f64], _rows: &[(Vec<f64>, f64)]) -> Option<Vec<f64>> {
        None
    }
}

/// The crate `good_lp` with its solver `microlp`.
#[derive(Clone, Copy, Debug, Default)]
pub struct GoodLp;

/// Seconds after which the solver is to give up: it does not promise to end.
const TIME_LIMIT: f64 = 2.0;

impl FloatSolver for GoodLp {
    fn solve(&self, objective: &[f64], rows: &[(Vec<f64>, f64)]) -> Option<Vec<f64>> {
        let mut variables = ProblemVariables::new();
        let x = variables.add_vector(variable(), objective.len());
        let linear = |factors: &[f64]| -> Expression { factors.iter().zip(&x).map(|(a, x)| *a * *x).sum() };
        let mut model = variables
            .maximise(linear(objective))
            .using(microlp)
            .with_time_limit(TIME_LIMIT);
        for (normal, offset) in rows {
            model.add_constraint(constraint!(linear(normal) + *offset >= 0.0));
        }
        let solution = model.solve().ok()?;
        Some(x.iter().map(|x| solution.value(*x)).collect())
    }
}

/// Rows that are nearly 0 at the point that the solver finds, the nearest first; none without a usable point.
pub fn suggestion(objective: &[Integer], rows: &[Row], solver: &dyn FloatSolver) -> Vec<usize> {
    let zero = Integer::ZERO;
    let objective = scaled(objective, &zero).0;
    let scaled_rows: Vec<(Vec<f64>, f64)> = rows.iter().map(|row| scaled(&row.normal, &row.constant)).collect();
    let finite = |(normal, constant): &(Vec<f64>, f64)| constant.is_finite() && normal.iter().any(|a| *a != 0.0);
    let numbers: Vec<usize> = (0..rows.len()).filter(|row| finite(&scaled_rows[*row])).collect();
    let usable: Vec<(Vec<f64>, f64)> = numbers.iter().map(|row| scaled_rows[*row].clone()).collect();
    if usable.is_empty() {
        return Vec::new();
    }
    // A solver that panics has no suggestion either.
    let solve = || solver.solve(&objective, &usable);
    let Ok(Some(point)) = catch_unwind(AssertUnwindSafe(solve)) else {
        return Vec::new();
    };
    if point.len() != objective.len() || point.iter().any(|x| !x.is_finite()) {
        return Vec::new();
    }
    let distance = |(normal, constant): &(Vec<f64>, f64)| {
        let slack = normal.iter().zip(&point).fold(*constant, |sum, (a, x)| sum + a * x);
        slack.abs() / normal.iter().map(|a| a * a).sum::<f64>().sqrt()
    };
    let mut near: Vec<(f64, usize)> = usable.iter().map(distance).zip(numbers).collect();
    near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    // More than a basis: where more rows meet, some bases prove nothing.
    near.truncate(4 * objective.len());
    near.into_iter().map(|(_, row)| row).collect()
}

/// A row in binary64, times the power of two that takes its greatest entry below 1.
fn scaled(normal: &[Integer], constant: &Integer) -> (Vec<f64>, f64) {
    let exponent = normal.iter().map(|a| a.bits()).max().unwrap_or(0);
    let one = Integer::ONE << u32::try_from(exponent).unwrap_or(u32::MAX);
    let float = |x: &Integer| Rational::new(x.clone(), one.clone()).to_f64();
    (normal.iter().map(float).collect(), float(constant))
}
