//! Chains of Bézier pieces as one B-spline.

use num_traits::One;

use super::{BSpline, Bezier, Curve, CurveError, CurveFault, Form, OperationError};
use crate::number::{Integer, Rational, RationalVector};

/// A piece elevated to the degree of its chain, and its weights scaled to agree with the piece before at their joint.
pub(crate) struct Aligned {
    /// The piece; its own weights are not scaled.
    pub(crate) piece: Bezier,
    /// The scaled weights, the degree + 1 of them.
    pub(crate) weights: Vec<Rational>,
}

/// The greatest degree of some pieces, and the pieces aligned, one after the other.
pub(crate) fn align(pieces: &[Bezier]) -> (usize, impl Iterator<Item = Result<Aligned, OperationError>> + '_) {
    let degree = pieces.iter().map(Bezier::degree).max().unwrap_or(1);
    let mut joint = Rational::one();
    let aligned = pieces.iter().map(move |piece| {
        let piece = piece.elevate(degree - piece.degree())?;
        let own: Vec<Rational> = match piece.weights() {
            Some(weights) => weights.iter().collect(),
            None => vec![Rational::one(); degree + 1],
        };
        let factor = &joint / &own[0];
        let weights: Vec<Rational> = own.iter().map(|w| w * &factor).collect();
        joint = weights[degree].clone();
        Ok(Aligned { piece, weights })
    });
    (degree, aligned)
}

impl Curve {
    /// The curve as one B-spline. A chain of M Bézier pieces has the knots 0, 1, …, M: pieces are elevated to the greatest degree p of them, their weights scaled
    /// to agree at the joints, and every joint is a knot of multiplicity p.
    ///
    /// # Errors
    /// A chain with too many control points, or whose scaled weights are too long.
    pub fn to_spline(&self) -> Result<BSpline, CurveError> {
        let pieces = match self.form() {
            Form::BSpline(spline) => return Ok(spline.clone()),
            Form::Bezier(pieces) => pieces,
        };
        let rational = pieces.iter().any(|piece| !piece.is_polynomial());
        let (degree, aligned) = align(pieces);
        let knot = |i: usize| Rational::from_integer(Integer::from(i as u64));
        let mut knots = vec![knot(0); degree + 1];
        let (mut points, mut weights) = (Vec::new(), Vec::new());
        for (i, aligned) in aligned.enumerate() {
            let aligned = aligned.map_err(|_| CurveError::new("degree", CurveFault::Degree { found: degree }))?;
            let first = usize::from(i > 0);
            points.extend(aligned.piece.points().iter().skip(first * self.dimension()));
            weights.extend(aligned.weights.into_iter().skip(first));
            let last = usize::from(i + 1 == pieces.len());
            knots.extend(std::iter::repeat_n(knot(i + 1), degree + last));
        }
        BSpline::new(
            self.dimension(),
            degree,
            RationalVector::from_rationals(&knots),
            RationalVector::from_rationals(&points),
            rational.then(|| RationalVector::from_rationals(&weights)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::read_curve;

    #[test]
    fn a_chain_and_its_spline_have_the_same_points() {
        let chain = r#"{ "knotproof": "curve/1", "bezier": { "pieces": [
            { "points": [[1, 0], [1, 1], [0, 1]], "weights": [1, 1, 2] },
            { "points": [[0, 1], [-3, 1]] },
            { "points": [[-3, 1], [-4, 1], [-4, 7], [1, 0]], "weights": ["1/3", 1, 2, 1] } ] } }"#;
        let curve = read_curve(chain).unwrap().curve;
        let spline = curve.to_spline().unwrap();
        assert_eq!((spline.degree(), spline.count()), (3, 10));
        for t in 0..=12 {
            let t = Rational::new(Integer::from(t), Integer::from(4));
            assert_eq!(spline.evaluate(&t).unwrap(), curve.chain().evaluate(&t).unwrap());
        }
        assert_eq!(Curve::from(spline.clone()).to_spline().unwrap(), spline);
    }

    #[test]
    fn polynomial_pieces_make_a_polynomial_spline() {
        let chain = r#"{ "knotproof": "curve/1", "bezier": { "pieces": [ { "points": [[1, 0], [1, 1]], "weights": [2, 2] }, { "points": [[1, 1], [0, 1]] } ] } }"#;
        let spline = read_curve(chain).unwrap().curve.to_spline().unwrap();
        assert_eq!(spline.weights(), None);
    }
}
