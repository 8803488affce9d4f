//! Evidence for the claim `deviation`, and the bound of Nairn, Peters and Lutterkort (1999) beside it.

use std::borrow::Cow;

use rayon::prelude::*;

use super::domain::Status;
pub use crate::approximation::nairn_peters_lutterkort;
use crate::certificate::Document;
use crate::check::chain::Chain;
use crate::check::deviation::{Part, edges, parts};
use crate::check::polynomial::NotShown;
use crate::claim::deviation::{Content, Evidence, Statement};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt};

/// Samples of an edge.
const SAMPLES: u32 = 16;
/// How often a greater distance is looked for.
const ATTEMPTS: usize = 40;
/// Bits of a parameter.
const BITS: u32 = 40;

/// What certifying needs to know.
#[derive(Clone, Debug)]
pub struct Options {
    /// How often every piece is halved.
    pub subdivisions: u32,
    /// (upper − lower)/upper of the squared distance is to be at most this.
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
    /// Edges of the control polygon.
    pub edges: u64,
    /// N∞(n)² times the greatest squared second difference of control points in a part, over all parts; `None` if a piece is rational.
    pub bound_squared: Option<Rational>,
}

/// Why there is nothing to certify.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DeviationError {
    /// A piece is a single point.
    PointPiece {
        /// Its number.
        piece: usize,
    },
    /// More than 16 subdivisions, or more than 4,194,304 edges.
    TooMany,
}

impl std::fmt::Display for DeviationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            DeviationError::PointPiece { piece } => {
                write!(f, "piece {piece} is a single point; leave it out of the curve")
            }
            DeviationError::TooMany => f.write_str("expected at most 16 subdivisions, and at most 4,194,304 edges"),
        }
    }
}

impl std::error::Error for DeviationError {}

/// A distance and where it is attained.
#[derive(Clone)]
struct Peak {
    squared: Rational,
    evidence: Evidence,
}

impl Peak {
    fn new(all: &[Vec<Part>], piece: usize, part: usize, u: Rational) -> Peak {
        Peak {
            squared: all[piece][part].squared_at(&u),
            evidence: Evidence {
                piece,
                part: part as u64,
                u,
            },
        }
    }
}

/// Certifies the greatest distance between a curve and its control polygon.
///
/// # Errors
/// [`DeviationError`].
pub fn certify<'c>(curve: &'c Curve, options: &Options) -> Result<Certified<'c>, DeviationError> {
    let chain = Chain::new(curve).map_err(|piece| DeviationError::PointPiece { piece })?;
    let count = edges(&chain, options.subdivisions).ok_or(DeviationError::TooMany)?;
    let all: Vec<Vec<Part>> = (0..chain.pieces.len())
        .into_par_iter()
        .map(|piece| parts(&chain, piece, options.subdivisions))
        .collect();
    let polynomial = chain.pieces.iter().all(|piece| !piece.rational);
    let bound_squared = polynomial.then(|| all.par_iter().flatten().map(bound_squared).max().unwrap_or_default());
    let (_, piece, j, u) = all
        .par_iter()
        .enumerate()
        .flat_map_iter(|(piece, parts)| {
            parts.iter().enumerate().map(move |(j, part)| {
                let (squared, u) = highest(part);
                (squared, piece, j, u)
            })
        })
        .max_by(|a, b| a.0.total_cmp(&b.0).then((b.1, b.2).cmp(&(a.1, a.2))))
        .expect("a curve has a piece");
    let mut peak = Peak::new(&all, piece, j, u);
    let half = &options.relative_width / Rational::from_integer(2.into());
    let mut upper_squared = Rational::from_integer(Integer::ZERO);
    let mut shown = false;
    for attempt in 0..ATTEMPTS {
        // The first time exactly, where that is a short number: as for a parabola, it may be the greatest.
        let exact = attempt == 0 && peak.squared.denom().bits() <= BOUND_BITS as u64;
        let half = if exact {
            Rational::from_integer(Integer::ZERO)
        } else {
            half.clone()
        };
        upper_squared = rounded_up(&(&peak.squared * (Rational::from_integer(Integer::ONE) + half)));
        let failure = all.par_iter().enumerate().find_map_first(|(piece, parts)| {
            parts.iter().enumerate().find_map(|(j, part)| {
                (0..part.degree()).find_map(|edge| Some((piece, j, edge, part.show(edge, &upper_squared).err()?)))
            })
        });
        match failure {
            None => {
                shown = true;
                break;
            }
            Some((piece, j, edge, NotShown::At { numerator, halvings })) => {
                let v = Rational::new(Integer::from(numerator), Integer::ONE << halvings as u32);
                let part = &all[piece][j];
                let u = (Rational::from_integer(edge.into()) + v) / Rational::from_integer(part.degree().into());
                let found = Peak::new(&all, piece, j, u);
                if found.squared > peak.squared {
                    peak = found;
                }
            }
            // Exactly the greatest distance at a parameter that halving does not reach: the next attempt leaves room.
            Some(_) if exact => {}
            Some(_) => break,
        }
    }
    let document = shown.then(|| Document {
        tool: super::TOOL.into(),
        name: options.name.clone(),
        snapped_joints: options.snapped_joints,
        curve: Cow::Borrowed(curve),
        claim: Content {
            statement: Statement {
                subdivisions: options.subdivisions,
                lower_squared: rounded_down(&peak.squared),
                upper_squared,
            },
            evidence: peak.evidence,
        },
    });
    Ok(Certified {
        document,
        status: match shown {
            true => Status::Certified,
            false => Status::Undecided("the bounds came no closer together".into()),
        },
        edges: count,
        bound_squared,
    })
}

/// Bits of a rounded bound.
const BOUND_BITS: i64 = 80;

fn shift(x: &Rational) -> i64 {
    BOUND_BITS - (x.numer().bits() as i64 - x.denom().bits() as i64)
}

/// A short fraction that is not greater, or the number itself when it is short.
pub(super) fn rounded_down(x: &Rational) -> Rational {
    match u32::try_from(shift(x)) {
        Ok(bits) if x.denom().bits() > u64::from(bits) => Rational::new(x.floor_shifted(bits), Integer::ONE << bits),
        _ => x.clone(),
    }
}

/// A short fraction that is not smaller, or the number itself when it is short.
pub(super) fn rounded_up(x: &Rational) -> Rational {
    match u32::try_from(shift(x)) {
        Ok(bits) if x.denom().bits() > u64::from(bits) => Rational::new(x.ceil_shifted(bits), Integer::ONE << bits),
        _ => x.clone(),
    }
}

/// The squared bound of a polynomial part.
fn bound_squared(part: &Part) -> Rational {
    let points: Vec<Vec<Rational>> = (0..=part.degree()).map(|k| part.control_point(k)).collect();
    let second = points.windows(3).map(|p| {
        (0..p[0].len()).fold(Rational::from_integer(Integer::ZERO), |sum, axis| {
            let x = &p[2][axis] - &p[1][axis] - &p[1][axis] + &p[0][axis];
            sum + &x * &x
        })
    });
    let factor = nairn_peters_lutterkort(part.degree());
    second.max().unwrap_or_default() * &factor * &factor
}

/// Roughly the greatest squared distance of a part, by samples in binary64, and a parameter for it.
fn highest(part: &Part) -> (f64, Rational) {
    let n = part.degree();
    let points: Vec<Vec<f64>> = (0..=n)
        .map(|k| part.control_point(k).iter().map(RationalExt::to_f64).collect())
        .collect();
    let weights: Vec<f64> = part.weights().iter().map(RationalExt::to_f64).collect();
    let squared = |u: f64| {
        let d = points[0].len();
        let mut row: Vec<Vec<f64>> = points
            .iter()
            .zip(&weights)
            .map(|(p, w)| p.iter().map(|x| x * w).chain([*w]).collect())
            .collect();
        for round in (1..row.len()).rev() {
            for k in 0..round {
                for i in 0..=d {
                    row[k][i] += (row[k + 1][i] - row[k][i]) * u;
                }
            }
        }
        let edge = ((u * n as f64) as usize).min(n - 1);
        let v = u * n as f64 - edge as f64;
        (0..d)
            .map(|i| {
                let x = row[0][i] / row[0][d] - points[edge][i] - (points[edge + 1][i] - points[edge][i]) * v;
                x * x
            })
            .sum::<f64>()
    };
    let count = SAMPLES * n as u32;
    let best = (0..=count)
        .map(|k| f64::from(k) / f64::from(count))
        .max_by(|a, b| squared(*a).total_cmp(&squared(*b)))
        .unwrap_or(0.0);
    let (mut u, mut step) = (best, 0.5 / f64::from(count));
    while step > 1e-12 {
        match [u - step, u + step]
            .into_iter()
            .find(|x| (0.0..=1.0).contains(x) && squared(*x) > squared(u))
        {
            Some(better) => u = better,
            None => step /= 2.0,
        }
    }
    let whole = 2f64.powi(BITS as i32);
    (
        squared(u),
        Rational::new(Integer::from((u * whole).round() as i64), Integer::ONE << BITS),
    )
}
