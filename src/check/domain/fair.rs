//! The position of least ∫|c''|² dt.
//!
//! c'' = N''·x + s'' gives ∫|c''|² = |x|²·∫N''² + 2x·∫N''s'' + ∫|s''|², whose level sets are spheres around −∫N''s''/∫N''².

use super::sign::second_differences;
use crate::curve::{Curve, Form};
use crate::number::{Integer, Rational};

/// Where the control points would minimise ∫|c''|² dt, in the parameter of the curve's knots, if they were free to move anywhere.
/// `None` for a curve with a rational piece, or whose second derivative does not depend on the points.
pub fn fair_point(curve: &Curve, points: &[usize]) -> Option<Vec<Rational>> {
    let d = curve.dimension();
    let pieces = second_differences(curve, points)?;
    let spans: Vec<Rational> = match curve.form() {
        Form::Bezier(pieces) => vec![Rational::from_integer(Integer::ONE); pieces.len()],
        Form::BSpline(spline) => {
            let (knots, over) = (spline.knots().numerators(), spline.knots().denominator());
            let domain = &knots[spline.degree()..=spline.count()];
            let differences = domain.windows(2).map(|pair| &pair[1] - &pair[0]);
            let spans = differences.filter(|difference| !difference.is_zero());
            spans
                .map(|difference| Rational::new(difference, over.clone()))
                .collect()
        }
    };
    let zero = Rational::from_integer(Integer::ZERO);
    let (mut mixed, mut square) = (vec![zero.clone(); d], zero.clone());
    for (differences, span) in pieces.iter().zip(&spans) {
        // Degree n − 2 of the second derivative.
        let Some(degree) = differences.len().checked_sub(1) else {
            continue;
        };
        let n = Integer::from(degree + 2);
        let speed = &n * (&n - Integer::ONE);
        let factor = Rational::from_integer(&speed * &speed)
            / (Rational::from_integer(Integer::from(2 * degree + 1)) * span * span * span);
        let binomial = |n: usize, k: usize| Integer::binomial(n as u32, k as u32);
        for (j, p) in differences.iter().enumerate() {
            for (k, q) in differences.iter().enumerate() {
                let weight = Rational::new(binomial(degree, j) * binomial(degree, k), binomial(2 * degree, j + k))
                    * &factor
                    * &p[d];
                for axis in 0..d {
                    mixed[axis] = &mixed[axis] + &weight * &q[axis];
                }
                square = &square + &weight * &q[d];
            }
        }
    }
    if square == zero {
        return None;
    }
    Some(mixed.iter().map(|part| -(part / &square)).collect())
}
