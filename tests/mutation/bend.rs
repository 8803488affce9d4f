//! The truth about curvature and thickness: exact derivatives at many parameters, and a new search for double normals.

use knotproof::certificate::Document;
use knotproof::claim::msd::Lower;
use knotproof::curve::{Bezier, Curve, Joint};
use knotproof::number::{Integer, Rational};
use knotproof::prove::curvature;

use crate::truth::{recomputed, zero};

/// Parameters of a piece that are looked at.
const SAMPLES: i64 = 97;

/// κ² at a local parameter; nothing where the derivative vanishes.
fn squared_at(piece: &Bezier, u: &Rational) -> Option<Rational> {
    let v = piece.derivatives(u, 2).ok()?;
    let at = |k: usize, i: usize| v[k].get(i).cloned().unwrap_or_else(zero);
    let square = |x: Rational| &x * &x;
    let speed = (0..3).fold(zero(), |sum, i| sum + square(at(1, i)));
    let planes = [(0, 1), (1, 2), (2, 0)];
    let bend = planes
        .iter()
        .map(|(i, j)| square(at(1, *i) * at(2, *j) - at(1, *j) * at(2, *i)))
        .fold(zero(), |sum, x| sum + x);
    (speed != zero()).then(|| bend / (&speed * &speed * &speed))
}

/// The greatest of all samples.
fn greatest_sample(curve: &Curve) -> Rational {
    let chain = curve.chain();
    let fractions = || (0..=SAMPLES).map(|k| Rational::new(Integer::from(k), Integer::from(SAMPLES)));
    let values = chain
        .pieces()
        .iter()
        .flat_map(|piece| fractions().filter_map(|u| squared_at(piece, &u)));
    values.fold(zero(), Ord::max)
}

/// Is what a certificate of the claim `curvature` says true?
pub fn curvature_is_true(document: &Document) -> bool {
    let Some(content) = document.claim.curvature() else {
        return false;
    };
    let chain = document.curve.chain();
    let witness = &content.evidence;
    let attained = squared_at(&chain.pieces()[witness.piece], &witness.u);
    attained.is_some_and(|squared| squared >= content.statement.lower_squared)
        && greatest_sample(&document.curve) <= content.statement.upper_squared
}

/// Is what a certificate of the claim `thickness` says true?
pub fn thickness_is_true(document: &Document) -> bool {
    let Some(content) = document.claim.thickness() else {
        return false;
    };
    let statement = &content.statement;
    let curve: &Curve = &document.curve;
    let chain = curve.chain();
    let corner = (0..chain.count()).any(|joint| chain.joint(joint) == Some(Joint::Corner));
    let says_nothing = statement.lower_squared == Lower::Finite(zero());
    if corner {
        return says_nothing;
    }
    let sigma = recomputed(curve, statement.convention);
    let four = Rational::from_integer(4.into());
    let sample = greatest_sample(curve);
    let lower_holds = match &statement.lower_squared {
        Lower::Infinite => sigma.upper.is_none() && sample == zero(),
        Lower::Finite(lower) => {
            sigma.upper.is_none_or(|upper| lower * &four <= upper)
                && lower * &sample <= Rational::from_integer(1.into())
        }
    };
    let upper_holds = statement.upper_squared.as_ref().is_none_or(|upper| {
        let options = curvature::Options {
            relative_width: Rational::new(1.into(), 1_000_000.into()),
            name: None,
            snapped_joints: None,
        };
        let found = curvature::certify(curve, &options)
            .ok()
            .and_then(|found| found.document);
        let kappa = found.map(|document| document.claim.statement.upper_squared);
        let radius = kappa.is_none_or(|kappa| kappa != zero() && upper * kappa >= Rational::from_integer(1.into()));
        radius || sigma.lower.is_some_and(|lower| upper * &four >= lower)
    });
    lower_holds && upper_holds
}
