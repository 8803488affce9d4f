use proptest::prelude::*;

use super::*;
use crate::number::RationalExt;

fn integers(numbers: &[i64]) -> Vec<Integer> {
    numbers.iter().copied().map(Integer::from).collect()
}

fn row(normal: &[i64], constant: i64) -> Row {
    Row {
        normal: integers(normal),
        constant: constant.into(),
    }
}

fn fraction(p: i64, q: i64) -> Rational {
    Rational::new(p.into(), q.into())
}

/// Answers the same to every question.
struct Stubborn(Option<Vec<f64>>);

impl FloatSolver for Stubborn {
    fn solve(&self, _objective: &[f64], _rows: &[(Vec<f64>, f64)]) -> Option<Vec<f64>> {
        self.0.clone()
    }
}

/// Fails.
struct Panicking;

impl FloatSolver for Panicking {
    fn solve(&self, _objective: &[f64], _rows: &[(Vec<f64>, f64)]) -> Option<Vec<f64>> {
        panic!("meant to be caught")
    }
}

/// Every solver, the honest one first.
fn solvers(n: usize) -> Vec<Box<dyn FloatSolver>> {
    let all = |x: f64| Stubborn(Some(vec![x; n]));
    vec![
        Box::new(GoodLp),
        Box::new(()),
        Box::new(all(0.0)),
        Box::new(all(3.5)),
        Box::new(all(-1e300)),
        Box::new(all(f64::NAN)),
        Box::new(all(f64::INFINITY)),
        Box::new(Stubborn(Some(vec![1.0; n + 1]))),
        Box::new(Stubborn(Some(Vec::new()))),
    ]
}

/// The verdict with its value; every solver must lead to the same, and every answer prove itself by a check of its own.
fn verdict(objective: &[Integer], rows: &[Row]) -> (&'static str, Option<Rational>) {
    let verdicts: Vec<_> = solvers(objective.len())
        .iter()
        .map(|solver| {
            let solution = maximise(objective, rows, solver.as_ref()).expect("an answer");
            assert!(proves(objective, rows, &solution), "{solution:?}");
            match solution {
                Solution::Optimal { value, .. } => ("optimal", Some(value)),
                Solution::Unbounded { .. } => ("unbounded", None),
                Solution::Infeasible { .. } => ("infeasible", None),
            }
        })
        .collect();
    assert!(verdicts.iter().all(|other| *other == verdicts[0]), "{verdicts:?}");
    verdicts[0].clone()
}

/// The definition of a proof again, in fractions from the start.
fn proves(objective: &[Integer], rows: &[Row], solution: &Solution) -> bool {
    let zero = || Rational::from_integer(Integer::ZERO);
    let dot = |a: &[Integer], b: &[Rational]| {
        assert_eq!(a.len(), b.len());
        let products = a.iter().zip(b).map(|(a, b)| Rational::from_integer(a.clone()) * b);
        products.fold(zero(), |sum, x| sum + x)
    };
    let slack = |row: &Row, x: &[Rational]| dot(&row.normal, x) + Rational::from_integer(row.constant.clone());
    let sum = |chosen: &[usize], multipliers: &[Rational]| {
        assert_eq!(chosen.len(), multipliers.len());
        assert!(multipliers.iter().all(|m| *m >= zero()));
        let part = |of: &dyn Fn(&Row) -> Integer| {
            let parts: Vec<Integer> = chosen.iter().map(|i| of(&rows[*i])).collect();
            dot(&parts, multipliers)
        };
        let linear: Vec<Rational> = (0..objective.len())
            .map(|axis| part(&|row| row.normal[axis].clone()))
            .collect();
        (linear, part(&|row| row.constant.clone()))
    };
    match solution {
        Solution::Optimal {
            point,
            value,
            basis,
            multipliers,
        } => {
            let (linear, constant) = sum(basis, multipliers);
            rows.iter().all(|row| slack(row, point) >= zero())
                && basis.iter().all(|i| slack(&rows[*i], point) == zero())
                && objective
                    .iter()
                    .zip(linear)
                    .all(|(c, a)| -Rational::from_integer(c.clone()) == a)
                && dot(objective, point) == *value
                && constant == *value
        }
        Solution::Unbounded { point, ray } => {
            rows.iter()
                .all(|row| slack(row, point) >= zero() && dot(&row.normal, ray) >= zero())
                && dot(objective, ray) > zero()
        }
        Solution::Infeasible {
            rows: chosen,
            multipliers,
        } => {
            let (linear, constant) = sum(chosen, multipliers);
            chosen.len() <= objective.len() + 1 && linear.iter().all(|a| *a == zero()) && constant < zero()
        }
    }
}

#[test]
fn panicking_solver() {
    let solution = maximise(&integers(&[2]), &[row(&[-1], 3)], &Panicking);
    assert!(matches!(solution, Ok(Solution::Optimal { value, .. }) if value == fraction(6, 1)));
}

#[test]
fn no_rows() {
    assert_eq!(verdict(&integers(&[0, 0]), &[]), ("optimal", Some(fraction(0, 1))));
    assert_eq!(verdict(&integers(&[0, -1]), &[]), ("unbounded", None));
    assert_eq!(verdict(&[], &[]), ("optimal", Some(fraction(0, 1))));
    assert_eq!(verdict(&[], &[row(&[], -1)]), ("infeasible", None));
}

#[test]
fn zero_normals() {
    let box_rows = [row(&[1, 0], 0), row(&[0, 1], 0), row(&[-1, -1], 2)];
    let with = |constant: i64| [&box_rows[..], &[row(&[0, 0], constant)]].concat();
    let objective = integers(&[3, 1]);
    assert_eq!(verdict(&objective, &with(0)), ("optimal", Some(fraction(6, 1))));
    assert_eq!(verdict(&objective, &with(-1)), ("infeasible", None));
    // Alone, beside an objective without bound.
    assert_eq!(verdict(&objective, &[row(&[0, 0], 0)]), ("unbounded", None));
    assert_eq!(verdict(&objective, &[row(&[0, 0], -1)]), ("infeasible", None));
}

#[test]
fn unbounded_or_infeasible() {
    // Both the rows contradict each other and the objective has a direction of growth.
    let rows = [row(&[1, 0], -1), row(&[-1, 0], 0)];
    assert_eq!(verdict(&integers(&[0, 1]), &rows), ("infeasible", None));
    assert_eq!(verdict(&integers(&[0, 0]), &rows), ("infeasible", None));
    let rows = [row(&[1, 0], -1), row(&[-1, 0], 1)];
    assert_eq!(verdict(&integers(&[0, 1]), &rows), ("unbounded", None));
    assert_eq!(verdict(&integers(&[5, 0]), &rows), ("optimal", Some(fraction(5, 1))));
}

#[test]
fn one_dimension_less() {
    // No row depends on y; the optimum is a line.
    let rows = [row(&[-2, 0], 3), row(&[-4, 0], 6), row(&[1, 0], 7)];
    assert_eq!(verdict(&integers(&[1, 0]), &rows), ("optimal", Some(fraction(3, 2))));
    assert_eq!(verdict(&integers(&[-1, 0]), &rows), ("optimal", Some(fraction(7, 1))));
    // The objective is a multiple of a normal that is across no axis.
    let rows = [row(&[-1, -1, 0], 1), row(&[-1, -1, 0], 2)];
    assert_eq!(verdict(&integers(&[2, 2, 0]), &rows), ("optimal", Some(fraction(2, 1))));
    assert_eq!(verdict(&integers(&[2, 1, 0]), &rows), ("unbounded", None));
}

#[test]
fn cycling_examples() {
    // Beale (1955): min −3/4 x1 + 150 x2 − 1/50 x3 + 6 x4; the textbook rule returns to where it was. Optimum 1/20.
    let rows = [
        row(&[-25, 6000, 4, -900], 0),
        row(&[-50, 9000, 2, -300], 0),
        row(&[0, 0, -1, 0], 1),
        row(&[1, 0, 0, 0], 0),
        row(&[0, 1, 0, 0], 0),
        row(&[0, 0, 1, 0], 0),
        row(&[0, 0, 0, 1], 0),
    ];
    let objective = integers(&[75, -15000, 2, -600]);
    assert_eq!(verdict(&objective, &rows), ("optimal", Some(fraction(5, 1))));
    // Many planes through one point.
    let rows: Vec<Row> = (0..40).map(|i| row(&[i - 20, 13 * i % 41 - 20, -30], 0)).collect();
    assert_eq!(verdict(&integers(&[0, 0, 1]), &rows), ("optimal", Some(fraction(0, 1))));
}

#[test]
fn long_numbers() {
    // (1 ± 2^-400) on both sides of what binary64 can tell apart.
    let huge = Integer::ONE << 400;
    let rows = [
        Row {
            normal: vec![-&huge, Integer::ZERO],
            constant: &huge + Integer::ONE,
        },
        Row {
            normal: vec![-&huge, Integer::ZERO],
            constant: &huge - Integer::ONE,
        },
        row(&[0, -1], 5),
    ];
    let (_, value) = verdict(&integers(&[1, 0]), &rows);
    assert_eq!(value, Some(Rational::new(&huge - Integer::ONE, huge.clone())));
    let constant = Integer::ONE << 5000;
    let far = [Row {
        normal: integers(&[-1]),
        constant: constant.clone(),
    }];
    assert_eq!(
        verdict(&integers(&[1]), &far),
        ("optimal", Some(Rational::from_integer(constant)))
    );
}

#[test]
fn rows_of_another_length() {
    let error = maximise(&integers(&[1, 0]), &[row(&[1, 0], 0), row(&[1], 0)], &GoodLp).unwrap_err();
    assert_eq!(
        error,
        LinearProgramError::Variables {
            row: 1,
            found: 1,
            expected: 2
        }
    );
    assert_eq!(error.to_string(), "row 1 has 1 variables where the objective has 2");
}

#[test]
fn wrong_proofs() {
    let rows = [row(&[-1, 0], 1), row(&[0, -1], 1), row(&[1, 1], 3)];
    let objective = integers(&[1, 2]);
    let one = || fraction(1, 1);
    let optimal = |point: [i64; 2], value: i64, basis: &[usize], multipliers: &[i64]| Solution::Optimal {
        point: point.map(|x| fraction(x, 1)).to_vec(),
        value: fraction(value, 1),
        basis: basis.to_vec(),
        multipliers: multipliers.iter().map(|m| fraction(*m, 1)).collect(),
    };
    assert!(is_proof(&objective, &rows, &optimal([1, 1], 3, &[0, 1], &[1, 2])));
    for wrong in [
        optimal([1, 1], 3, &[1, 0], &[1, 2]),
        optimal([1, 1], 4, &[0, 1], &[1, 2]),
        optimal([2, 1], 4, &[0, 1], &[1, 2]),
        optimal([1, 0], 1, &[0, 1], &[1, 2]),
        optimal([1, 1], 3, &[0, 1, 2], &[1, 2, 0]),
        optimal([1, 1], 3, &[0, 1], &[1]),
        optimal([1, 1], 3, &[0, 9], &[1, 2]),
        optimal([1, -4], -7, &[0, 2], &[1, -2]),
        Solution::Unbounded {
            point: vec![one(), one()],
            ray: vec![one(), one()],
        },
        Solution::Unbounded {
            point: vec![one(), one()],
            ray: vec![-one(), one()],
        },
        Solution::Infeasible {
            rows: vec![0, 1, 2],
            multipliers: vec![one(), one(), one()],
        },
        Solution::Infeasible {
            rows: vec![],
            multipliers: vec![],
        },
    ] {
        assert!(!is_proof(&objective, &rows, &wrong), "{wrong:?}");
    }
}

/// The greatest value over all points where n rows meet and all hold; `None` where there is none.
fn brute_force(objective: &[Integer], rows: &[Row]) -> Option<Rational> {
    let n = objective.len();
    let mut best: Option<Rational> = None;
    let mut chosen: Vec<usize> = (0..n).collect();
    loop {
        let normals: Vec<Vec<Integer>> = chosen.iter().map(|i| rows[*i].normal.clone()).collect();
        let constants = chosen.iter().map(|i| -&rows[*i].constant).collect();
        if let Some(vertex) = linear_system::solve(&normals, &[constants]) {
            let dot = |a: &[Integer]| -> Integer { a.iter().zip(&vertex.numerators[0]).map(|(a, x)| a * x).sum() };
            let holds = |row: &Row| !(dot(&row.normal) + &row.constant * &vertex.denominator).is_negative();
            if rows.iter().all(holds) {
                let value = Rational::new(dot(objective), vertex.denominator.clone());
                best = Some(best.map_or(value.clone(), |best| best.max(value)));
            }
        }
        // The next choice.
        let Some(k) = (0..n).rfind(|k| chosen[*k] < rows.len() - n + k) else {
            return best;
        };
        chosen[k] += 1;
        for next in k + 1..n {
            chosen[next] = chosen[next - 1] + 1;
        }
    }
}

fn programs() -> impl Strategy<Value = (Vec<Integer>, Vec<Row>)> {
    let numbers = |count| prop::collection::vec(-3_i64..4, count);
    (1_usize..5).prop_flat_map(move |n| {
        let rows = prop::collection::vec((numbers(n), -4_i64..7, 0_u32..3), 0..9);
        (numbers(n), rows).prop_map(|(objective, rows)| {
            // Some rows twice as long: duplicates of others.
            let scaled = |(normal, constant, shift): &(Vec<i64>, i64, u32)| {
                let normal: Vec<i64> = normal.iter().map(|a| a << (40 * shift / 2)).collect();
                row(&normal, constant << (40 * shift / 2))
            };
            (integers(&objective), rows.iter().map(scaled).collect())
        })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(80))]

    #[test]
    fn within_a_box((objective, mut rows) in programs(), side in 1_i64..9) {
        for axis in 0..objective.len() {
            for sign in [-1, 1] {
                let mut normal = vec![0; objective.len()];
                normal[axis] = sign;
                rows.push(row(&normal, side));
            }
        }
        let expected = brute_force(&objective, &rows);
        let (name, value) = verdict(&objective, &rows);
        prop_assert_eq!(name, if expected.is_some() { "optimal" } else { "infeasible" });
        prop_assert_eq!(value, expected);
    }

    #[test]
    fn without_a_box((objective, rows) in programs()) {
        // `verdict` asks for the proof of each verdict, and they exclude each other.
        let (name, value) = verdict(&objective, &rows);
        prop_assert_eq!(value.is_some(), name == "optimal");
    }
}

#[test]
fn thousands_of_rows() {
    // Tangent planes of the unit ball, and the point of it farthest in a direction, nearly.
    let tangent = |i: i64| {
        let (a, b) = (f64::from(i as i32) * 2.399_963, 1.0 - 2.0 * (i as f64 + 0.5) / 3000.0);
        let r = (1.0 - b * b).sqrt();
        let normal = [r * a.cos(), r * a.sin(), b].map(|x| (x * -1e30) as i128);
        Row {
            normal: normal.map(Integer::from).to_vec(),
            constant: Integer::from(10_i128.pow(30)),
        }
    };
    let rows: Vec<Row> = (0..3000).map(tangent).collect();
    let objective = integers(&[1, 2, 2]);
    for solver in [&GoodLp as &dyn FloatSolver, &()] {
        let Ok(Solution::Optimal { value, .. }) = maximise(&objective, &rows, solver) else {
            panic!("a bounded program")
        };
        assert!((3.0..3.02).contains(&value.to_f64()), "{}", value.to_f64());
    }
}
