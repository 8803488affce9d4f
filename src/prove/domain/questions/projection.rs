//! The point nearest to a target where all rows are ≥ 0, exactly.
//!
//! The solution is given by few active rows: with Gram matrix G_ij = A_i·A_j and Gλ = −row(y), it is x = y + Σ λ_i A_i with λ ≥ 0. A violated row joins the active ones; of
//! their subsets the one whose solution satisfies all of them becomes active. The distance grows each time, so that this ends.

use crate::check::domain::sign::Affine;
use crate::number::{Integer, Rational, RationalVector};
use crate::prove::linear_program::linear_system::solve;
use crate::prove::linear_program::verify::product;

/// The nearest point for the rows so far.
pub struct Projection {
    target: RationalVector,
    rows: Vec<Affine>,
    solution: Solution,
}

/// The point of some active rows.
#[derive(Clone, Debug)]
struct Solution {
    active: Vec<usize>,
    multipliers: Vec<Rational>,
    /// Numerators and denominator of the point.
    point: Vec<Integer>,
    denominator: Integer,
}

impl Projection {
    /// Without rows it is the target itself.
    pub fn new(target: &[Rational]) -> Self {
        let target = RationalVector::from_rationals(target);
        let solution = Solution {
            active: Vec::new(),
            multipliers: Vec::new(),
            point: target.numerators().to_vec(),
            denominator: target.denominator().clone(),
        };
        Projection {
            target,
            rows: Vec::new(),
            solution,
        }
    }

    /// Adds a row; [`solve`](Self::solve) takes it into account.
    pub fn add(&mut self, row: Affine) {
        self.rows.push(row);
    }

    /// Is a row negative at the point?
    pub fn violates(&self, row: &Affine) -> bool {
        self.solution.value(row).is_negative()
    }

    /// The point.
    pub fn point(&self) -> Vec<Rational> {
        let over = &self.solution.denominator;
        let numerators = self.solution.point.iter();
        numerators.map(|x| Rational::new(x.clone(), over.clone())).collect()
    }

    /// The active rows, by the order in which they were added, with their multipliers.
    pub fn active(&self) -> impl Iterator<Item = (usize, &Rational)> {
        self.solution.active.iter().copied().zip(&self.solution.multipliers)
    }

    /// Moves the point until no row is violated; `None` if the rows contradict each other.
    pub fn solve(&mut self) -> Option<()> {
        while let Some(worst) = self.worst() {
            self.solution = self.with(worst)?;
        }
        Some(())
    }

    /// The row that is violated most.
    fn worst(&self) -> Option<usize> {
        let violation = |(number, row): (usize, &Affine)| {
            let value = self.solution.value(row);
            value.is_negative().then(|| {
                let size = row.linear.iter().map(|a| a.bits() as i64).max().unwrap_or(0);
                let (mantissa, exponent) = value.to_f64_exponent();
                (number, (exponent - size) as f64 + (-mantissa).log2())
            })
        };
        let violations = self.rows.iter().enumerate().filter_map(violation);
        violations.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(number, _)| number)
    }

    /// The solution for the active rows and one that is violated. It is active then.
    fn with(&self, entering: usize) -> Option<Solution> {
        let old = &self.solution.active;
        let all: Vec<usize> = old.iter().copied().chain([entering]).collect();
        let d = self.target.len();
        let mut subsets: Vec<Vec<usize>> = (0..1_usize << old.len())
            .map(|bits| {
                let chosen = old.iter().enumerate().filter(|(k, _)| bits >> k & 1 == 1);
                chosen.map(|(_, row)| *row).chain([entering]).collect()
            })
            .filter(|subset: &Vec<usize>| subset.len() <= d)
            .collect();
        subsets.sort_by_key(|subset| std::cmp::Reverse(subset.len()));
        subsets.into_iter().find_map(|subset| {
            let solution = self.on(subset)?;
            let holds = |row: &usize| !solution.value(&self.rows[*row]).is_negative();
            all.iter().all(holds).then_some(solution)
        })
    }

    /// The point nearest to the target where some rows are 0, if its multipliers are not negative.
    fn on(&self, active: Vec<usize>) -> Option<Solution> {
        let normals: Vec<&[Integer]> = active.iter().map(|row| &self.rows[*row].linear[..]).collect();
        let gram: Vec<Vec<Integer>> = normals
            .iter()
            .map(|a| normals.iter().map(|b| product(a, b)).collect())
            .collect();
        let (y, over) = (self.target.numerators(), self.target.denominator());
        let right = active.iter().map(|row| -self.rows[*row].at(y, over)).collect();
        let solved = solve(&gram, &[right])?;
        let numerators = &solved.numerators[0];
        if numerators.iter().any(Integer::is_negative) {
            return None;
        }
        let denominator = over * &solved.denominator;
        let coordinate = |(axis, y): (usize, &Integer)| -> Integer {
            let moved: Integer = normals.iter().zip(numerators).map(|(a, m)| &a[axis] * m).sum();
            y * &solved.denominator + moved
        };
        let multiplier = |m: &Integer| Rational::new(m.clone(), denominator.clone());
        Some(Solution {
            multipliers: numerators.iter().map(multiplier).collect(),
            point: y.iter().enumerate().map(coordinate).collect(),
            denominator: denominator.clone(),
            active,
        })
    }
}

impl Solution {
    /// The value of a row, up to a positive factor.
    fn value(&self, row: &Affine) -> Integer {
        row.at(&self.point, &self.denominator)
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(150))]

        /// Rows that hold at 0; the solution is stationary, complementary and satisfies all of them, which makes it the nearest point.
        #[test]
        fn stationary(
            target in prop::collection::vec(-9_i64..10, 2..4),
            rows in prop::collection::vec((prop::collection::vec(-3_i64..4, 3), 0_i64..5), 0..12),
        ) {
            let target: Vec<Rational> = target.into_iter().map(|x| Rational::new(x.into(), Integer::from(2))).collect();
            let mut projection = Projection::new(&target);
            let rows: Vec<Affine> = rows.into_iter().map(|(normal, constant)| Affine {
                linear: normal[..target.len()].iter().copied().map(Integer::from).collect(),
                constant: constant.into(),
            }).collect();
            for (i, row) in rows.iter().enumerate() {
                projection.add(row.clone());
                if i % 3 == 2 {
                    prop_assert!(projection.solve().is_some());
                }
            }
            prop_assert!(projection.solve().is_some());
            let point = projection.point();
            let zero = Rational::from_integer(Integer::ZERO);
            let value = |row: &Affine| {
                let terms = row.linear.iter().zip(&point).map(|(a, x)| x * Rational::from_integer(a.clone()));
                terms.fold(Rational::from_integer(row.constant.clone()), |sum, term| sum + term)
            };
            prop_assert!(rows.iter().all(|row| value(row) >= zero));
            let mut combination = target.clone();
            for (row, multiplier) in projection.active() {
                prop_assert!(*multiplier >= zero);
                prop_assert_eq!(value(&rows[row]), zero.clone());
                for (x, a) in combination.iter_mut().zip(&rows[row].linear) {
                    *x += multiplier * Rational::from_integer(a.clone());
                }
            }
            prop_assert_eq!(combination, point);
        }
    }
}
