//! Small systems of linear equations in integers, without fractions on the way.

use crate::number::Integer;

/// Solutions over one positive denominator.
pub struct Solutions {
    /// The denominator.
    pub denominator: Integer,
    /// The numerators of one solution for each right-hand side.
    pub numerators: Vec<Vec<Integer>>,
}

/// Solves `matrix`·x = r for each r of `sides`; `None` when the matrix, a list of rows, is singular.
///
/// Gauss–Jordan elimination in the fraction-free form of Bareiss (1968): after step k every entry is a minor of the matrix with k + 1 rows, so that
/// all divisions are exact.
pub fn solve(matrix: &[Vec<Integer>], sides: &[Vec<Integer>]) -> Option<Solutions> {
    let n = matrix.len();
    let mut rows: Vec<Vec<Integer>> = matrix
        .iter()
        .enumerate()
        .map(|(i, row)| row.iter().chain(sides.iter().map(|side| &side[i])).cloned().collect())
        .collect();
    let mut previous = Integer::ONE;
    for k in 0..n {
        let pivot_row = (k..n).find(|i| !rows[*i][k].is_zero())?;
        rows.swap(k, pivot_row);
        let pivot = rows[k].clone();
        for (i, row) in rows.iter_mut().enumerate() {
            if i == k {
                continue;
            }
            let factor = row[k].clone();
            for (entry, of_pivot) in row.iter_mut().zip(&pivot) {
                *entry = (&*entry * &pivot[k] - &factor * of_pivot).div_exact(&previous);
            }
        }
        previous = pivot[k].clone();
    }
    let negative = previous.is_negative();
    let signed = |x: &Integer| if negative { -x } else { x.clone() };
    let numerators = (n..n + sides.len())
        .map(|column| rows.iter().map(|row| signed(&row[column])).collect())
        .collect();
    Some(Solutions {
        denominator: previous.abs(),
        numerators,
    })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn small_systems() {
        let integers = |numbers: &[i64]| -> Vec<Integer> { numbers.iter().copied().map(Integer::from).collect() };
        let solved = solve(&[integers(&[0, -2]), integers(&[3, 1])], &[integers(&[4, 1])]).unwrap();
        assert_eq!(solved.denominator, Integer::from(6));
        assert_eq!(solved.numerators, [integers(&[6, -12])]);
        assert!(solve(&[integers(&[1, 2]), integers(&[2, 4])], &[]).is_none());
        assert!(solve(&[], &[vec![]]).is_some_and(|solved| solved.denominator.is_one()));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(100))]

        #[test]
        fn solves(n in 1_usize..5, numbers in prop::collection::vec(-4_i64..5, 28), shift in 0_u32..80) {
            let numbers: Vec<Integer> = numbers.iter().map(|x| (Integer::from(*x) << shift) + Integer::from(*x)).collect();
            let matrix: Vec<Vec<Integer>> = (0..n).map(|i| numbers[i * n..][..n].to_vec()).collect();
            let sides = [numbers[16..][..n].to_vec(), numbers[20..][..n].to_vec()];
            if let Some(solved) = solve(&matrix, &sides) {
                prop_assert!(solved.denominator.is_positive());
                for (side, solution) in sides.iter().zip(&solved.numerators) {
                    for (row, right) in matrix.iter().zip(side) {
                        let product: Integer = row.iter().zip(solution).map(|(a, x)| a * x).sum();
                        prop_assert_eq!(product, right * &solved.denominator);
                    }
                }
            } else {
                prop_assert_eq!(determinant(&matrix), Integer::ZERO);
            }
        }
    }

    fn determinant(matrix: &[Vec<Integer>]) -> Integer {
        let Some((first, rest)) = matrix.split_first() else {
            return Integer::ONE;
        };
        let minor = |k: usize| -> Vec<Vec<Integer>> {
            let without = |row: &Vec<Integer>| [&row[..k], &row[k + 1..]].concat();
            rest.iter().map(without).collect()
        };
        let term = |(k, x): (usize, &Integer)| {
            let product = x * determinant(&minor(k));
            if k % 2 == 0 { product } else { -product }
        };
        first.iter().enumerate().map(term).sum()
    }
}
