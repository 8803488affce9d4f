//! Derivatives, curvature and torsion from the power series of X and w at a parameter.

use super::super::rule::Failure;
use super::pieces::Place;
use crate::number::{Integer, Rational};

/// For every column the coefficients of its power series at u up to `order`, all over one positive number.
///
/// With u = a/b: Σ c_j b^{n−j} v^j is b^n times the polynomial Σ c_j u^j at u = v/b; it is shifted to v = a by Horner's rule, and the
/// coefficient of (v−a)^k is that of (u − a/b)^k over b^k.
fn series(columns: &[Vec<Integer>], u: &Rational, order: usize) -> Vec<Vec<Integer>> {
    let (a, b) = (u.numer(), u.denom());
    let shifted = |column: &Vec<Integer>| {
        let mut row = monomials(column);
        let degree = row.len() - 1;
        let mut power = Integer::ONE;
        for j in (0..=degree).rev() {
            row[j] = &row[j] * &power;
            power *= b;
        }
        let mut scale = Integer::ONE;
        (0..=order)
            .map(|k| {
                if k > degree {
                    return Integer::ZERO;
                }
                for j in (k..degree).rev() {
                    row[j] = &row[j] + a * &row[j + 1];
                }
                let coefficient = &row[k] * &scale;
                scale = &scale * b;
                coefficient
            })
            .collect()
    };
    columns.iter().map(shifted).collect()
}

/// From Bernstein coefficients to those of the powers of u: c_j = C(n,j) Δʲx_0.
fn monomials(column: &[Integer]) -> Vec<Integer> {
    let degree = column.len() - 1;
    let mut differences = column.to_vec();
    let mut result = Vec::with_capacity(column.len());
    for j in 0..=degree {
        result.push(&differences[0] * Integer::binomial(degree as u32, j as u32));
        differences = differences.windows(2).map(|pair| &pair[1] - &pair[0]).collect();
    }
    result
}

/// The derivative of an order with respect to the knot parameter: order! times a coefficient of the quotient of power series X/w.
pub fn derivative(place: &Place, order: usize) -> Vec<Rational> {
    let series = series(&place.piece.columns, &place.u, order);
    let (weights, axes) = series.split_last().expect("a column of weights");
    let mut factor = Rational::from_integer(Integer::ONE);
    for k in 1..=order {
        factor = factor * Rational::from_integer(Integer::from(k)) / &place.length;
    }
    axes.iter()
        .map(|axis| {
            let mut quotient: Vec<Rational> = Vec::with_capacity(order + 1);
            for k in 0..=order {
                let mut rest = Rational::from_integer(axis[k].clone());
                for i in 1..=k {
                    rest -= Rational::from_integer(weights[i].clone()) * &quotient[k - i];
                }
                quotient.push(rest / Rational::from_integer(weights[0].clone()));
            }
            quotient.swap_remove(order) * &factor
        })
        .collect()
}

type Vector = [Integer; 3];

/// F = X'w − Xw', a positive multiple of c', and its first two derivatives; then w.
fn field(place: &Place) -> ([Vector; 3], Integer) {
    let series = series(&place.piece.columns, &place.u, 3);
    let (w, axes) = series.split_last().expect("a column of weights");
    let (two, six) = (Integer::from(2), Integer::from(6));
    let mut field: [Vector; 3] = Default::default();
    for (axis, x) in axes.iter().enumerate() {
        field[0][axis] = &x[1] * &w[0] - &x[0] * &w[1];
        field[1][axis] = &two * (&x[2] * &w[0] - &x[0] * &w[2]);
        field[2][axis] = &six * (&x[3] * &w[0] - &x[0] * &w[3]) + &two * (&x[2] * &w[1] - &x[1] * &w[2]);
    }
    (field, w[0].clone())
}

fn dot(a: &Vector, b: &Vector) -> Integer {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &Vector, b: &Vector) -> Vector {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}

/// κ² = w⁴|F×F'|²/|F|⁶.
///
/// # Errors
/// A parameter where c' = 0.
pub fn curvature_squared(place: &Place) -> Result<Rational, Failure> {
    let ([first, second, _], w) = field(place);
    let speed = dot(&first, &first);
    if speed.is_zero() {
        return Err(Failure {
            expected: "a derivative that is not zero",
            found: "zero".into(),
        });
    }
    let turn = cross(&first, &second);
    Ok(Rational::new(dot(&turn, &turn) * w.pow(4), speed.pow(3)))
}

/// τ = w² det(F, F', F'')/|F×F'|².
///
/// # Errors
/// A parameter where c' × c'' = 0.
pub fn torsion(place: &Place) -> Result<Rational, Failure> {
    let ([first, second, third], w) = field(place);
    let turn = cross(&first, &second);
    let squared = dot(&turn, &turn);
    if squared.is_zero() {
        return Err(Failure {
            expected: "first and second derivatives that are independent",
            found: "dependent ones".into(),
        });
    }
    Ok(Rational::new(dot(&turn, &third) * w.pow(2), squared))
}

#[cfg(test)]
mod tests {
    use super::super::pieces::Pieces;
    use super::*;
    use crate::claim::values::Side;
    use crate::curve::{self, BSpline, Curve};
    use crate::number::RationalVector;

    fn fraction(numerator: i64, denominator: i64) -> Rational {
        Rational::new(Integer::from(numerator), Integer::from(denominator))
    }

    fn vector(numbers: &[i64]) -> RationalVector {
        let numbers: Vec<Rational> = numbers.iter().map(|x| fraction(*x, 1)).collect();
        RationalVector::from_rationals(&numbers)
    }

    /// A rational cubic in space of two pieces of different lengths.
    fn spline() -> BSpline {
        BSpline::new(
            3,
            3,
            vector(&[0, 0, 0, 0, 2, 5, 5, 5, 5]),
            vector(&[0, 0, 1, 1, 3, 2, 4, -1, 0, 6, 2, 2, 7, 1, 5]),
            Some(vector(&[1, 3, 2, 1, 4])),
        )
        .expect("a spline")
    }

    #[test]
    fn derivatives_are_those_of_leibniz() {
        let spline = spline();
        let pieces = Pieces::new(&Curve::from(spline.clone())).expect("no points");
        for (t, side, same) in [
            (fraction(0, 1), Side::Right, curve::Side::After),
            (fraction(1, 3), Side::Left, curve::Side::Before),
            (fraction(2, 1), Side::Left, curve::Side::Before),
            (fraction(2, 1), Side::Right, curve::Side::After),
            (fraction(5, 1), Side::Left, curve::Side::Before),
        ] {
            let place = pieces.place(&t, side).expect("inside");
            let expected = spline.derivatives(&t, same, 6).expect("inside");
            for (order, vector) in expected.iter().enumerate() {
                assert_eq!(&derivative(&place, order), vector, "order {order}");
            }
            let [a, b, c] = [1, 2, 3].map(|k| &expected[k]);
            let turn = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i]);
            let dot = |v: &[Rational], w: &[Rational]| &v[0] * &w[0] + &v[1] * &w[1] + &v[2] * &w[2];
            let (speed, squared) = (dot(a, a), dot(&turn, &turn));
            assert_eq!(
                curvature_squared(&place).expect("regular"),
                &squared / (&speed * &speed * &speed)
            );
            assert_eq!(torsion(&place).expect("bent"), dot(&turn, c) / squared);
        }
    }
}
