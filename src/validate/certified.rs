//! Cases and exact results from accepted certificates: the entries of `values`, the bounds of `msd`.

use std::fmt::Write as _;

use sha2::{Digest, Sha256};

use super::condition::Condition;
use super::truth::{About, Enclosed, MsdBounds, Truth};
use crate::certificate::{Document, curve_sha256};
use crate::claim::Claim;
use crate::claim::msd::{Convention, Lower};
use crate::claim::values::{Operation as ExactOperation, Outcome, Side};
use crate::engine::{Case, CaseSide, FloatCurve, Operation};
use crate::number::{RationalExt, sqrt_enclosure};

/// Bits of square roots.
const ROOT_BITS: u32 = 90;

/// A case made from a certificate, with the result that the certificate proves.
#[derive(Debug, Clone, PartialEq)]
pub struct Certified {
    /// The case: the certificate's curve and parameters, rounded to binary64.
    pub case: Case,
    /// The result for the exact curve and parameters.
    pub truth: Truth,
}

/// The cases of a document that the checker has accepted: of the claim `values` one an entry, with the id "`first 12 digits of curve_sha256`/`index`-`digest of what is asked`", of the claim
/// `msd` (smooth convention, bounded on both sides) one with the id "…/msd".
///
/// A chain of Bézier pieces is the one B-spline that it makes ([`to_spline`](crate::curve::Curve::to_spline)), on the same parameters: engines have no others. Knots and degree of that
/// are no operations of the chain, and certificates have none of them. Nothing of other claims, and of entries that are none any more once rounded to binary64.
pub fn certified(document: &Document) -> Vec<Certified> {
    let Ok(spline) = document.curve.to_spline() else {
        return Vec::new();
    };
    let curve = FloatCurve::rounded(&spline);
    if curve.exact().is_err() {
        return Vec::new();
    }
    let digest = hexadecimal(&curve_sha256(&document.curve)[..6]);
    let with = |id: String, operation: Operation, truth: Truth| Certified {
        case: Case {
            id,
            operation,
            curve: curve.clone(),
        },
        truth,
    };
    match &document.claim {
        Claim::Values(content) => {
            let entries = content.statement.entries.iter().enumerate();
            let made = entries.filter_map(|(i, entry)| {
                let operation = rounded(&entry.operation)?;
                let about = About {
                    curve: &curve,
                    spline: spline.clone(),
                };
                let truth = truth(about, &entry.operation, &entry.outcome).ok()?;
                // Entries of other certificates about the same curve have the same numbers.
                let asked = hexadecimal(&Sha256::digest(format!("{:?}", entry.operation))[..4]);
                Some(with(format!("{digest}/{i}-{asked}"), operation, truth))
            });
            made.collect()
        }
        Claim::Msd(content) if content.statement.convention == Convention::Smooth => {
            let bounds = match (&content.statement.lower_squared, &content.statement.upper_squared) {
                (Lower::Infinite, _) => MsdBounds::None,
                (Lower::Finite(lower), Some(upper)) => MsdBounds::Squared {
                    lower: lower.clone(),
                    upper: upper.clone(),
                },
                (Lower::Finite(_), None) => return Vec::new(),
            };
            vec![with(
                format!("{digest}/msd"),
                Operation::Msd,
                Truth::of_msd(&bounds, &curve),
            )]
        }
        _ => Vec::new(),
    }
}

fn hexadecimal(bytes: &[u8]) -> String {
    let mut text = String::new();
    for byte in bytes {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

fn side(side: Side) -> CaseSide {
    match side {
        Side::Left => CaseSide::Left,
        Side::Right => CaseSide::Right,
    }
}

/// The operation with its numbers rounded.
fn rounded(operation: &ExactOperation) -> Option<Operation> {
    Some(match operation {
        ExactOperation::Point { parameter } => Operation::Point {
            parameter: parameter.to_f64(),
        },
        ExactOperation::Derivative {
            parameter,
            order,
            side: at,
        } => Operation::Derivative {
            parameter: parameter.to_f64(),
            order: *order as usize,
            side: side(*at),
        },
        ExactOperation::Curvature { parameter, side: at } => Operation::Curvature {
            parameter: parameter.to_f64(),
            side: side(*at),
        },
        ExactOperation::Torsion { parameter, side: at } => Operation::Torsion {
            parameter: parameter.to_f64(),
            side: side(*at),
        },
        ExactOperation::InsertKnot { parameter, times } => Operation::InsertKnot {
            parameter: parameter.to_f64(),
            times: *times as usize,
        },
        ExactOperation::RemoveKnot { parameter, times } => Operation::RemoveKnot {
            parameter: parameter.to_f64(),
            times: *times as usize,
        },
        ExactOperation::ElevateDegree { times } => Operation::ElevateDegree { times: *times as usize },
        ExactOperation::Split { parameter } => Operation::Split {
            parameter: parameter.to_f64(),
        },
        ExactOperation::Decompose => Operation::Decompose,
        ExactOperation::NearestPoint { target } => Operation::NearestPoint {
            target: target.iter().map(RationalExt::to_f64).collect(),
        },
        ExactOperation::CurveDistance { other } => {
            let other = FloatCurve::rounded(&other.to_spline().ok()?);
            other.exact().ok()?;
            Operation::CurveDistance { other: Box::new(other) }
        }
    })
}

/// The exact result: the certificate's numbers where the result is a number, and the exact curve itself where it is a curve, which the
/// certificate's was found equal to. Beside a one-sided value stands the other one, which an engine may mean as well.
fn truth(about: About<'_>, operation: &ExactOperation, outcome: &Outcome) -> Result<Truth, String> {
    let scale = Condition::scale(about.curve);
    match operation {
        ExactOperation::Point { parameter } => about.point(parameter),
        ExactOperation::Derivative { parameter, order, .. } => about.derivative(parameter, *order as usize),
        ExactOperation::Curvature { parameter, .. } => about.curvature(parameter),
        ExactOperation::Torsion { parameter, .. } => about.torsion(parameter),
        ExactOperation::InsertKnot { parameter, times } => about.insertion(parameter.clone(), *times as usize),
        ExactOperation::RemoveKnot { parameter, times } => about.removal(parameter.clone(), *times as usize),
        ExactOperation::ElevateDegree { times } => Ok(about.elevation(*times as usize)),
        ExactOperation::Split { parameter } => about.split(parameter.clone()),
        ExactOperation::Decompose => Ok(about.decomposition()),
        ExactOperation::NearestPoint { target } => {
            let scale = target.iter().fold(scale, |scale, x| scale.max(x.to_f64().abs()));
            distance(outcome, scale)
        }
        ExactOperation::CurveDistance { other } => {
            let other = other.to_spline().map_err(|error| error.to_string())?;
            distance(outcome, scale.max(Condition::scale(&FloatCurve::rounded(&other))))
        }
    }
}

fn distance(outcome: &Outcome, scale: f64) -> Result<Truth, String> {
    let Outcome::DistanceSquared { lower, upper } = outcome else {
        return Err("the certificate has no distance there".into());
    };
    Ok(Truth::Distance {
        bounds: Enclosed {
            lower: sqrt_enclosure(lower, ROOT_BITS).0,
            upper: sqrt_enclosure(upper, ROOT_BITS).1,
            unit: scale * f64::EPSILON,
        },
        attained: "as certified".into(),
    })
}
