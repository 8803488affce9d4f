//! What is true of a curve, found without the certificate.

use knotproof::claim::msd::{Convention, Lower, Statement};
use knotproof::curve::{Curve, Form};
use knotproof::number::Rational;
use knotproof::prove::msd::{Options, certify};

use crate::common::polygon::Polygon;

/// Bounds of σ², of which ∞ is `None`.
#[derive(Clone, Debug)]
pub struct Enclosure {
    /// Not above σ².
    pub lower: Option<Rational>,
    /// Not below it; `None` also when nothing bounds it.
    pub upper: Option<Rational>,
}

/// 0.
pub fn zero() -> Rational {
    Rational::from_integer(0.into())
}

/// The vertices of a curve of straight pieces.
pub fn vertices(curve: &Curve) -> Option<Vec<Vec<Rational>>> {
    let Form::Bezier(pieces) = curve.form() else {
        return None;
    };
    if pieces
        .iter()
        .any(|piece| piece.degree() != 1 || !piece.is_polynomial() || piece.point(0) == piece.point(1))
    {
        return None;
    }
    let mut vertices = vec![pieces[0].point(0)];
    vertices.extend(pieces.iter().map(|piece| piece.point(1)));
    Some(vertices)
}

/// σ² of a curve: exactly for polygons, else as a new search finds it.
pub fn recomputed(curve: &Curve, convention: Convention) -> Enclosure {
    if let Some(vertices) = vertices(curve) {
        let squared = Polygon::new(&vertices).squared(convention == Convention::Critical);
        return Enclosure {
            lower: squared.clone(),
            upper: squared,
        };
    }
    let options = Options {
        convention,
        relative_width: Rational::new(1.into(), 100_000.into()),
        budget: Some(3000),
        ..Options::default()
    };
    let found = certify(curve, &options, &|_| ())
        .expect("certifies")
        .document
        .claim
        .statement;
    let lower = match found.lower_squared {
        Lower::Infinite => None,
        Lower::Finite(lower) => Some(lower),
    };
    Enclosure {
        lower,
        upper: found.upper_squared,
    }
}

/// Is the statement compatible with what is known of σ²? A lower bound above a known upper one is wrong, and so is the reverse.
pub fn is_true(statement: &Statement, known: &Enclosure) -> bool {
    let lower_holds = match (&statement.lower_squared, &known.upper) {
        (Lower::Infinite, Some(_)) => false,
        (Lower::Finite(lower), Some(upper)) => lower <= upper,
        (_, None) => true,
    };
    let upper_holds = match (&statement.upper_squared, &known.lower) {
        (Some(upper), Some(lower)) => upper >= lower,
        (Some(_), None) => false,
        (None, _) => true,
    };
    lower_holds && upper_holds
}
