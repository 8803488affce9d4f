//! Evidence about the greatest curvature of a curve.
//!
//! Samples in binary64 say where to begin; from there on everything is exact. A bound slightly above the greatest value found is handed to
//! the checker's own halving, and where it fails, at a parameter with a greater curvature, the search goes on.

mod climb;
mod regular;
mod sample;

use std::borrow::Cow;

use rayon::prelude::*;

use super::domain::questions::rounding::{bits_for, down, up};
pub use super::domain::{CertifyError, Status, write_checked};
use crate::certificate::Document;
use crate::check::chain::Chain;
use crate::check::curvature::Field;
use crate::check::polynomial::NotShown;
use crate::claim::curvature::{Content, Evidence, Statement};
use crate::curve::{Curve, Joint, MAXIMUM_BITS};
use crate::number::{Integer, Rational};
use climb::{Peak, climb};
pub use regular::Irregular;

/// How often a greater curvature is looked for.
const ATTEMPTS: usize = 60;
/// A parameter with so small a denominator may be where the greatest curvature is attained exactly.
const SHORT_DENOMINATOR: i64 = 1 << 12;
/// An exact greatest curvature of more bits is not stated.
const SHORT_BITS: u64 = 4096;

/// What certifying needs to know.
#[derive(Clone, Debug)]
pub struct Options {
    /// (upper − lower)/upper of the greatest curvature is to be at most this; greater than 0 and below 1.
    pub relative_width: Rational,
    /// A name for the document.
    pub name: Option<String>,
    /// How many joints were moved together on reading.
    pub snapped_joints: Option<u64>,
}

/// What was found of a curve.
pub struct Certified<'c> {
    /// The document; `None` when nothing can be stated.
    pub document: Option<Document<'c, Content>>,
    /// Is what was asked for proved?
    pub status: Status,
    /// The joints that are corners, 0 for the closing point; no curvature is counted there.
    pub corners: Vec<usize>,
}

/// A piece whose derivative vanishes identically: nothing is certified about such a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PointPiece(pub usize);

impl std::fmt::Display for PointPiece {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "piece {} is a single point", self.0)
    }
}

impl std::error::Error for PointPiece {}

/// Finds bounds of the greatest curvature.
///
/// # Errors
/// A piece that is a point.
pub fn certify<'c>(curve: &'c Curve, options: &Options) -> Result<Certified<'c>, PointPiece> {
    let chain = Chain::new(curve).map_err(PointPiece)?;
    let pieces = curve.chain();
    let joints = usize::from(!pieces.closed())..pieces.count();
    let corners = joints.filter(|i| pieces.joint(*i) == Some(Joint::Corner)).collect();
    let (content, status) = match regular::first_irregular(&chain, &pieces) {
        Some(found) => (None, Status::Undecided(found.in_words(&pieces))),
        None => search(&chain, &pieces, options),
    };
    Ok(Certified {
        document: content.map(|claim| Document {
            tool: super::TOOL.into(),
            name: options.name.clone(),
            snapped_joints: options.snapped_joints,
            curve: Cow::Borrowed(curve),
            claim,
        }),
        status,
        corners,
    })
}

/// Both bounds of a regular curve.
fn search(chain: &Chain, pieces: &crate::curve::Chain, options: &Options) -> (Option<Content>, Status) {
    let bits = bits_for(&options.relative_width);
    let one = Rational::from_integer(Integer::ONE);
    let four = Rational::from_integer(Integer::from(4));
    let mut gap = options.relative_width.clone();
    let (piece, at) = sample::greatest(pieces.pieces());
    let mut peak = climb(&Field::new(chain, piece), piece, at, bits);
    for _ in 0..ATTEMPTS {
        let short =
            peak.u.denom().to_i64().is_some_and(|q| q <= SHORT_DENOMINATOR) && size(&peak.squared) <= SHORT_BITS;
        let mut outcome = Some((0, NotShown::Limits));
        if short {
            outcome = first_failure(chain, &peak.squared);
            if outcome.is_none() {
                let squared = peak.squared.clone();
                return (Some(content(&peak, squared.clone(), squared)), Status::Certified);
            }
        }
        if let Some((_, NotShown::Limits)) = outcome {
            let upper = up(&(&peak.squared * (&one + &gap)), bits);
            outcome = first_failure(chain, &upper);
            if outcome.is_none() {
                let lower = down(&peak.squared, bits);
                if size(&lower).max(size(&upper)) > MAXIMUM_BITS {
                    let why = "the curvature is too great or too small to be written down";
                    return (None, Status::Undecided(why.into()));
                }
                // L/U ≥ 1 − width of the roots.
                let rest = &one - &options.relative_width;
                let close = lower >= &upper * &rest * &rest;
                let status = if close {
                    Status::Certified
                } else {
                    Status::Undecided("halving does not come to an end with closer bounds".into())
                };
                return (Some(content(&peak, lower, upper)), status);
            }
        }
        match outcome {
            Some((piece, NotShown::At { numerator, halvings })) => {
                let u = Rational::new(Integer::from(numerator), Integer::ONE << halvings as u32);
                peak = climb(&Field::new(chain, piece), piece, u, bits);
            }
            _ => gap *= &four,
        }
        if gap > one {
            break;
        }
    }
    let why = "no upper bound of the curvature was found within the limits of halving";
    (None, Status::Undecided(why.into()))
}

fn content(peak: &Peak, lower_squared: Rational, upper_squared: Rational) -> Content {
    Content {
        statement: Statement {
            lower_squared,
            upper_squared,
        },
        evidence: Evidence {
            piece: peak.piece,
            u: peak.u.clone(),
        },
    }
}

/// The longer of numerator and denominator, in bits.
fn size(x: &Rational) -> u64 {
    x.numer().bits().max(x.denom().bits())
}

/// A piece whose curvature is not shown to be at most a bound: the first with a parameter where it is greater, else the first.
fn first_failure(chain: &Chain, upper_squared: &Rational) -> Option<(usize, NotShown)> {
    let failures = (0..chain.pieces.len()).into_par_iter().filter_map(|piece| {
        let shown = Field::new(chain, piece).show_bound(upper_squared);
        shown.err().map(|why| (piece, why))
    });
    failures.min_by_key(|(piece, why)| (*why == NotShown::Limits, *piece))
}
