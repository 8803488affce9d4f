//! The dual simplex method, exactly.
//!
//! A basis is a set of n planes with independent normals, of which the objective is a combination: objective = −Σ λ·normal with all λ ≥ 0, so that
//! their common point maximises the objective over their n half-spaces alone. A row violated there enters, another leaves, and the maximum falls (or
//! stays), until no row is violated, or the violated row contradicts the basis.
//!
//! The first basis consists of *starts*: planes across one axis each. With rows taken without their constants, and starts one unit from the
//! origin, the method finds a basis of rows (starts remain only with λ = 0), or a direction in which the objective grows for ever. Then the constants are put back.

use std::cmp::Ordering;

use super::linear_system::{Solutions, solve};
use super::verify::product;
use super::{Row, Solution};
use crate::number::{Integer, Rational};

/// So many steps without progress make the choice of the next row follow Bland's rule.
const PATIENCE: usize = 20;

/// A plane of the basis; the order is that of Bland's rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Plane {
    /// That of a row.
    Row(usize),
    /// That across an axis.
    Start(usize),
}

/// What the constants are.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Constants {
    /// 0 for rows, 1 for starts: x is a direction.
    Directions,
    /// Those of the rows, 0 for starts: x is a position.
    Positions,
}

/// How a run ended.
enum End {
    /// No row is violated at the basis' point.
    Optimal,
    /// The basis' rows contradict another one.
    Contradiction(Solution),
}

/// A linear program on its way.
pub struct Simplex<'a> {
    objective: &'a [Integer],
    rows: &'a [Row],
    /// Rows that are tried first.
    suggested: Vec<usize>,
    /// Exponents of 2 near the lengths of the normals.
    sizes: Vec<i64>,
    basis: Vec<Plane>,
}

impl<'a> Simplex<'a> {
    /// Rows must be as long as the objective.
    pub fn new(objective: &'a [Integer], rows: &'a [Row], suggested: Vec<usize>) -> Self {
        let size = |row: &Row| row.normal.iter().map(|a| a.bits() as i64).max().unwrap_or(0);
        Simplex {
            objective,
            rows,
            suggested,
            sizes: rows.iter().map(size).collect(),
            basis: (0..objective.len()).map(Plane::Start).collect(),
        }
    }

    /// Solves it; `None` would be a defect.
    pub fn solve(mut self) -> Option<Solution> {
        if self.depends_on_starts()? {
            self.run(Constants::Directions)?;
            if self.depends_on_starts()? {
                return self.unbounded();
            }
        }
        self.replace_starts()?;
        match self.run(Constants::Positions)? {
            End::Contradiction(solution) => Some(solution),
            End::Optimal => self.optimal(),
        }
    }

    /// The objective's multipliers of the basis.
    fn multipliers(&self) -> Option<Solutions> {
        let objective = self.objective.iter().map(|c| -c).collect();
        solve(&self.columns(), &[objective])
    }

    /// Has a start a multiplier other than 0?
    fn depends_on_starts(&self) -> Option<bool> {
        let multipliers = self.multipliers()?;
        let is_start = |plane: &Plane| matches!(plane, Plane::Start(_));
        let mut pairs = self.basis.iter().zip(&multipliers.numerators[0]);
        Some(pairs.any(|(plane, multiplier)| is_start(plane) && !multiplier.is_zero()))
    }

    fn optimal(&self) -> Option<Solution> {
        let vertex = self.vertex(Constants::Positions)?;
        let multipliers = self.multipliers()?;
        let point = fractions(&vertex);
        let value = Rational::new(product(self.objective, &vertex.numerators[0]), vertex.denominator);
        let rows = self.basis.iter().zip(fractions(&multipliers));
        let (basis, multipliers) = rows
            .filter_map(|(plane, multiplier)| match plane {
                Plane::Row(row) => Some((*row, multiplier)),
                Plane::Start(_) => None,
            })
            .unzip();
        Some(Solution::Optimal {
            point,
            value,
            basis,
            multipliers,
        })
    }

    /// The basis' point is a direction in which the objective grows; is there a point at all?
    fn unbounded(self) -> Option<Solution> {
        let ray = fractions(&self.vertex(Constants::Directions)?);
        let indifferent = vec![Integer::ZERO; self.objective.len()];
        match Simplex::new(&indifferent, self.rows, self.suggested).solve()? {
            Solution::Optimal { point, .. } => Some(Solution::Unbounded { point, ray }),
            infeasible => Some(infeasible),
        }
    }

    /// Puts rows in the place of starts, all of multiplier 0, as far as the rows' normals go. A start that remains is across a direction on which no
    /// row depends.
    fn replace_starts(&mut self) -> Option<()> {
        let n = self.basis.len();
        for k in 0..n {
            if matches!(self.basis[k], Plane::Row(_)) {
                continue;
            }
            let mut unit = vec![Integer::ZERO; n];
            unit[k] = Integer::ONE;
            let across = solve(&self.normals(), &[unit])?.numerators.swap_remove(0);
            let mut candidates = self.suggested.iter().copied().chain(0..self.rows.len());
            if let Some(row) = candidates.find(|row| !product(&self.rows[*row].normal, &across).is_zero()) {
                self.basis[k] = Plane::Row(row);
            }
        }
        Some(())
    }

    /// Exchanges planes until no row is violated.
    fn run(&mut self, constants: Constants) -> Option<End> {
        let mut without_progress = 0;
        loop {
            let vertex = self.vertex(constants)?;
            let Some(entering) = self.entering(constants, &vertex, without_progress >= PATIENCE) else {
                return Some(End::Optimal);
            };
            let normal = self.rows[entering].normal.clone();
            let objective = self.objective.iter().map(|c| -c).collect();
            let solutions = solve(&self.columns(), &[objective, normal])?;
            let [multipliers, shares] = &solutions.numerators[..] else {
                return None;
            };
            let Some(leaving) = self.leaving(multipliers, shares) else {
                return Some(End::Contradiction(self.contradiction(
                    entering,
                    shares,
                    &solutions.denominator,
                )));
            };
            if multipliers[leaving].is_zero() {
                without_progress += 1;
            } else {
                without_progress = 0;
            }
            self.basis[leaving] = Plane::Row(entering);
        }
    }

    /// The row to enter: the one violated most, among the suggested if any of them is violated; by Bland's rule the first.
    fn entering(&self, constants: Constants, vertex: &Solutions, bland: bool) -> Option<usize> {
        let violation = |row: usize| {
            let Row { normal, constant } = &self.rows[row];
            let mut slack = product(normal, &vertex.numerators[0]);
            if constants == Constants::Positions {
                slack += constant * &vertex.denominator;
            }
            slack.is_negative().then(|| {
                let (mantissa, exponent) = slack.to_f64_exponent();
                let size = (exponent - self.sizes[row]) as f64 + (-mantissa).log2();
                (row, size)
            })
        };
        if bland {
            return (0..self.rows.len()).find_map(violation).map(|(row, _)| row);
        }
        let most = |rows: &mut dyn Iterator<Item = usize>| {
            let violations = rows.filter_map(violation);
            violations
                .max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))
                .map(|(row, _)| row)
        };
        most(&mut self.suggested.iter().copied()).or_else(|| most(&mut (0..self.rows.len())))
    }

    /// The place of the plane to leave: the first whose multiplier becomes 0, among equals that of the first plane.
    fn leaving(&self, multipliers: &[Integer], shares: &[Integer]) -> Option<usize> {
        let places = (0..shares.len()).filter(|k| shares[*k].is_positive());
        places.min_by(|i, j| {
            let sides = (&multipliers[*i] * &shares[*j]).cmp(&(&multipliers[*j] * &shares[*i]));
            sides.then(self.basis[*i].cmp(&self.basis[*j]))
        })
    }

    /// normal = Σ share·(normals of the basis) with all shares ≤ 0, and the row is negative where the basis' rows are 0.
    fn contradiction(&self, entering: usize, shares: &[Integer], denominator: &Integer) -> Solution {
        let of_basis = self.basis.iter().zip(shares).filter_map(|(plane, share)| match plane {
            Plane::Row(row) if !share.is_zero() => Some((*row, Rational::new(-share, denominator.clone()))),
            _ => None,
        });
        let one = Rational::from_integer(Integer::ONE);
        let (rows, multipliers) = [(entering, one)].into_iter().chain(of_basis).unzip();
        Solution::Infeasible { rows, multipliers }
    }

    /// The point of the basis.
    fn vertex(&self, constants: Constants) -> Option<Solutions> {
        let constant = |plane: &Plane| match (plane, constants) {
            (Plane::Row(row), Constants::Positions) => -&self.rows[*row].constant,
            (Plane::Start(_), Constants::Directions) => Integer::from(-1),
            _ => Integer::ZERO,
        };
        solve(&self.normals(), &[self.basis.iter().map(constant).collect()])
    }

    /// The normals of the basis.
    fn normals(&self) -> Vec<Vec<Integer>> {
        let normal = |plane: &Plane| match plane {
            Plane::Row(row) => self.rows[*row].normal.clone(),
            Plane::Start(axis) => {
                // Towards smaller values of the objective's term, so that its multiplier is ≥ 0.
                let sign = match self.objective[*axis].sign() {
                    Ordering::Greater => -1,
                    _ => 1,
                };
                let mut normal = vec![Integer::ZERO; self.basis.len()];
                normal[*axis] = Integer::from(sign);
                normal
            }
        };
        self.basis.iter().map(normal).collect()
    }

    /// The transpose of [`normals`](Self::normals).
    fn columns(&self) -> Vec<Vec<Integer>> {
        let normals = self.normals();
        (0..normals.len())
            .map(|axis| normals.iter().map(|normal| normal[axis].clone()).collect())
            .collect()
    }
}

/// The first of the solutions.
fn fractions(solutions: &Solutions) -> Vec<Rational> {
    let first = solutions.numerators[0].iter();
    first
        .map(|x| Rational::new(x.clone(), solutions.denominator.clone()))
        .collect()
}
