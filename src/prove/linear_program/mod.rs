//! Linear programs in few variables, solved exactly, each answer with its proof.
//!
//! A float solver looks first; the rows that are nearly tight at its point are where the exact dual simplex method starts. What is answered
//! is decided by exact arithmetic alone, and so is that the method ends: after a run of steps without progress it follows Bland's rule (1977).

mod float;
pub(crate) mod linear_system;
mod simplex;
#[cfg(test)]
mod tests;
pub(crate) mod verify;

use std::fmt;

pub use float::{FloatSolver, GoodLp};
pub use verify::is_proof;

use crate::number::{Integer, Rational};
use simplex::Simplex;

/// The constraint normal·x + constant ≥ 0.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Row {
    /// One number for each variable; all of them may be 0.
    pub normal: Vec<Integer>,
    /// The constant.
    pub constant: Integer,
}

/// The answer to a linear program, with its proof.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Solution {
    /// There is a maximum.
    Optimal {
        /// Where it is attained; all rows hold there.
        point: Vec<Rational>,
        /// The maximum, objective·point.
        value: Rational,
        /// Rows that are 0 at the point, at most as many as there are variables.
        basis: Vec<usize>,
        /// For each of them a number ≥ 0, with objective = −Σ multiplier·normal; hence Σ multiplier·constant = value.
        multipliers: Vec<Rational>,
    },
    /// The rows hold at points where the objective is as great as one likes.
    Unbounded {
        /// A point where all rows hold.
        point: Vec<Rational>,
        /// A direction with normal·ray ≥ 0 for every row and objective·ray > 0.
        ray: Vec<Rational>,
    },
    /// The rows hold nowhere together.
    Infeasible {
        /// Rows that contradict each other, at most one more than there are variables.
        rows: Vec<usize>,
        /// For each of them a number ≥ 0, with Σ multiplier·normal = 0 and Σ multiplier·constant < 0.
        multipliers: Vec<Rational>,
    },
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LinearProgramError {
    /// A row with another number of variables than the objective.
    Variables {
        /// The row.
        row: usize,
        /// How many numbers its normal has.
        found: usize,
        /// How many the objective has.
        expected: usize,
    },
    /// What was found is not a proof: a defect of this module, noticed before anybody could rely on it.
    Unproved,
}

impl fmt::Display for LinearProgramError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            LinearProgramError::Variables { row, found, expected } => {
                write!(f, "row {row} has {found} variables where the objective has {expected}")
            }
            LinearProgramError::Unproved => f.write_str("the answer to a linear program failed its exact check"),
        }
    }
}

impl std::error::Error for LinearProgramError {}

/// Maximises objective·x over all x where every row is at least 0.
///
/// Meant for up to some four variables (any number works) and thousands of rows. The verdict and the value do not depend on `solver`; among
/// several points of the same value, and several proofs, its suggestion may choose. `&()` is the solver that suggests nothing.
///
/// # Errors
/// Rows and objective of different lengths.
///
/// ```
/// use knotproof::number::{Integer, Rational};
/// use knotproof::prove::linear_program::{GoodLp, Row, Solution, maximise};
/// let row = |normal: [i64; 2], constant: i64| Row { normal: normal.map(Integer::from).to_vec(), constant: constant.into() };
/// // x + 3y ≤ 1 and 3x + y ≤ 1.
/// let rows = [row([-1, -3], 1), row([-3, -1], 1)];
/// let Ok(Solution::Optimal { value, multipliers, .. }) = maximise(&[Integer::ONE, Integer::ONE], &rows, &GoodLp) else {
///     panic!("there is a maximum")
/// };
/// let fraction = |p: i64, q: i64| Rational::new(p.into(), q.into());
/// assert_eq!((value, multipliers), (fraction(1, 2), vec![fraction(1, 4); 2]));
/// ```
pub fn maximise(objective: &[Integer], rows: &[Row], solver: &dyn FloatSolver) -> Result<Solution, LinearProgramError> {
    let expected = objective.len();
    if let Some((row, found)) = (rows.iter().map(|row| row.normal.len()).enumerate()).find(|(_, n)| *n != expected) {
        return Err(LinearProgramError::Variables { row, found, expected });
    }
    let suggested = float::suggestion(objective, rows, solver);
    let solution = Simplex::new(objective, rows, suggested).solve();
    match solution.filter(|solution| is_proof(objective, rows, solution)) {
        Some(solution) => Ok(solution),
        None => Err(LinearProgramError::Unproved),
    }
}
