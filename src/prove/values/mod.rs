//! Entries for the claim `values`: exact results of the basic operations, and intervals for distances.

mod distance;
mod float_curve;
mod nearest;
mod results;
mod samples;

use std::borrow::Cow;

use super::domain::Status;
use crate::certificate::Document;
use crate::check::values::pieces::Pieces;
use crate::claim::values::{Content, Entry, Evidence, MOST_ENTRIES, Operation, Outcome, Statement, Witness};
use crate::curve::{Curve, Form};
use crate::number::{Integer, Rational, RationalExt};
use float_curve::{FloatCurve, Place};

/// A B-spline with more control points is not transformed unless that is asked for.
const MOST_POINTS: usize = 4096;
/// Local parameters that were searched for have so many bits.
const PARAMETER_BITS: u32 = 60;

/// An operation that can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Points.
    Point,
    /// Derivatives of the orders 1 to 3.
    Derivative,
    /// Squared curvatures.
    Curvature,
    /// Torsions, in space.
    Torsion,
    /// Knot insertions.
    InsertKnot,
    /// Knot removals, of knots that can be removed.
    RemoveKnot,
    /// Degree elevations.
    ElevateDegree,
    /// Splits in two.
    Split,
    /// The decomposition into Bézier pieces.
    Decompose,
    /// Distances of the targets.
    NearestPoint,
    /// Distances of the other curves.
    CurveDistance,
}

impl Kind {
    /// All of them, in the order in which their entries stand.
    pub const ALL: [Kind; 11] = [
        Kind::Point,
        Kind::Derivative,
        Kind::Curvature,
        Kind::Torsion,
        Kind::InsertKnot,
        Kind::RemoveKnot,
        Kind::ElevateDegree,
        Kind::Split,
        Kind::Decompose,
        Kind::NearestPoint,
        Kind::CurveDistance,
    ];

    /// As it is written in a certificate.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Point => "point",
            Kind::Derivative => "derivative",
            Kind::Curvature => "curvature",
            Kind::Torsion => "torsion",
            Kind::InsertKnot => "insert_knot",
            Kind::RemoveKnot => "remove_knot",
            Kind::ElevateDegree => "elevate_degree",
            Kind::Split => "split",
            Kind::Decompose => "decompose",
            Kind::NearestPoint => "nearest_point",
            Kind::CurveDistance => "curve_distance",
        }
    }

    fn needs_spline(self) -> bool {
        matches!(
            self,
            Kind::InsertKnot | Kind::RemoveKnot | Kind::ElevateDegree | Kind::Split | Kind::Decompose
        )
    }
}

/// What certifying needs to know.
#[derive(Clone, Debug)]
pub struct Options {
    /// Which operations; `None` for all that the curve has.
    pub operations: Option<Vec<Kind>>,
    /// Parameters inside each piece, beside its ends and the binary64 numbers next to them.
    pub samples: usize,
    /// Points of the curve's dimension, for `nearest_point`.
    pub targets: Vec<Vec<Rational>>,
    /// Curves of the curve's dimension, for `curve_distance`.
    pub others: Vec<Curve>,
    /// (upper − lower)/upper of a squared distance is to be at most this.
    pub relative_width: Rational,
    /// A name for the document.
    pub name: Option<String>,
    /// How many joints were moved together on reading.
    pub snapped_joints: Option<u64>,
}

/// What was found of a curve.
pub struct Certified<'c> {
    /// The document.
    pub document: Document<'c, Content>,
    /// Are all distances as narrow as was asked for?
    pub status: Status,
    /// Of the operations asked for, those without any entry, with the reason.
    pub without: Vec<(Kind, &'static str)>,
}

/// Why there is nothing to certify.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ValuesError {
    /// A piece of the curve, or of another one, is a single point.
    PointPiece {
        /// Which of the other curves; `None` for the curve itself.
        other: Option<usize>,
        /// The number of the piece.
        piece: usize,
    },
    /// A target or another curve of the wrong dimension.
    Dimension {
        /// The curve's.
        expected: usize,
        /// The other one.
        found: usize,
    },
    /// An operation that the curve does not have.
    NotOffered {
        /// The operation.
        kind: Kind,
        /// Why not.
        why: &'static str,
    },
    /// More than 65,536 entries.
    TooMany,
}

impl std::fmt::Display for ValuesError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ValuesError::PointPiece { other: None, piece } => {
                write!(f, "piece {piece} is a single point; leave it out of the curve")
            }
            ValuesError::PointPiece {
                other: Some(other),
                piece,
            } => write!(
                f,
                "other curve {other}: piece {piece} is a single point; leave it out of the curve"
            ),
            ValuesError::Dimension { expected, found } => {
                write!(
                    f,
                    "expected targets and other curves of dimension {expected}, found {found}"
                )
            }
            ValuesError::NotOffered { kind, why } => write!(f, "operation {}: {why}", kind.name()),
            ValuesError::TooMany => write!(
                f,
                "there would be more than {MOST_ENTRIES} entries; ask for fewer samples or operations"
            ),
        }
    }
}

impl std::error::Error for ValuesError {}

/// An interval of a squared distance.
struct Bracket {
    lower: Rational,
    upper: Rational,
}

/// How narrow an interval is to be.
struct Width {
    relative: Rational,
    /// A squared distance below this counts as 0.
    negligible: Rational,
}

impl Width {
    /// `size` of the things whose distance is asked for.
    fn new(relative: &Rational, size: f64) -> Width {
        let size = Rational::from_f64(size).unwrap_or_default();
        let unit = Rational::new(Integer::ONE, Integer::ONE << 80);
        Width {
            relative: relative.clone(),
            negligible: &size * &size * unit,
        }
    }

    fn is_negligible(&self, squared: &Rational) -> bool {
        *squared <= self.negligible
    }

    fn is_reached(&self, bracket: &Bracket) -> bool {
        self.is_negligible(&bracket.upper) || &bracket.upper - &bracket.lower <= &self.relative * &bracket.upper
    }
}

/// The knot value at a place, its local parameter rounded to 60 bits.
fn exact_parameter(pieces: &Pieces, (piece, u): Place) -> Rational {
    let one = Rational::from_integer(Integer::ONE);
    let u = Rational::from_f64(u.clamp(0.0, 1.0)).unwrap_or_default();
    let u = Rational::new(u.floor_shifted(PARAMETER_BITS), Integer::ONE << PARAMETER_BITS).min(one);
    let (low, high) = (&pieces.ends[piece], &pieces.ends[piece + 1]);
    low + (high - low) * u
}

/// Why a curve does not have an operation.
fn not_offered(curve: &Curve, kind: Kind, options: &Options) -> Option<&'static str> {
    match kind {
        Kind::Torsion if curve.dimension() == 2 => Some("a curve in the plane has no torsion"),
        Kind::NearestPoint if options.targets.is_empty() => Some("there is no target"),
        Kind::CurveDistance if options.others.is_empty() => Some("there is no other curve"),
        kind if kind.needs_spline() && matches!(curve.form(), Form::Bezier(pieces) if pieces.len() > 1) => {
            Some("several Bézier pieces are no B-spline")
        }
        _ => None,
    }
}

/// Finds results of operations.
///
/// # Errors
/// [`ValuesError`].
pub fn certify<'c>(curve: &'c Curve, options: &Options) -> Result<Certified<'c>, ValuesError> {
    let pieces = Pieces::new(curve).map_err(|piece| ValuesError::PointPiece { other: None, piece })?;
    let dimensions = options.targets.iter().map(Vec::len);
    let dimensions = dimensions.chain(options.others.iter().map(Curve::dimension));
    let expected = curve.dimension();
    if let Some(found) = dimensions.into_iter().find(|found| *found != expected) {
        return Err(ValuesError::Dimension { expected, found });
    }
    let long = matches!(curve.form(), Form::BSpline(spline) if spline.count() > MOST_POINTS);
    let kinds: Vec<Kind> = match &options.operations {
        None => {
            let offered = |kind: &Kind| not_offered(curve, *kind, options).is_none() && !(long && kind.needs_spline());
            Kind::ALL.into_iter().filter(offered).collect()
        }
        Some(asked) => {
            for &kind in asked {
                if let Some(why) = not_offered(curve, kind, options) {
                    return Err(ValuesError::NotOffered { kind, why });
                }
            }
            Kind::ALL.into_iter().filter(|kind| asked.contains(kind)).collect()
        }
    };
    let mut found = Entries {
        entries: Vec::new(),
        witnesses: Vec::new(),
        wide: 0,
    };
    let mut without = Vec::new();
    for kind in kinds {
        let before = found.entries.len();
        found.extend(curve, &pieces, kind, options)?;
        if found.entries.len() > MOST_ENTRIES {
            return Err(ValuesError::TooMany);
        }
        if found.entries.len() == before {
            let why = match kind {
                Kind::RemoveKnot => "no knot can be removed without changing the curve",
                Kind::Curvature => "the derivative is zero at all samples",
                Kind::Torsion => "first and second derivatives are dependent at all samples",
                _ => "the numbers would be too long",
            };
            without.push((kind, why));
        }
    }
    let status = match found.wide {
        0 => Status::Certified,
        1 => Status::Undecided("the bounds of one distance came no closer together".into()),
        wide => Status::Undecided(format!("the bounds of {wide} distances came no closer together")),
    };
    let document = Document {
        tool: super::TOOL.into(),
        name: options.name.clone(),
        snapped_joints: options.snapped_joints,
        curve: Cow::Borrowed(curve),
        claim: Content {
            statement: Statement { entries: found.entries },
            evidence: Evidence {
                witnesses: found.witnesses,
            },
        },
    };
    Ok(Certified {
        document,
        status,
        without,
    })
}

struct Entries {
    entries: Vec<Entry>,
    witnesses: Vec<Witness>,
    /// Distances that are not as narrow as was asked for.
    wide: usize,
}

impl Entries {
    fn extend(&mut self, curve: &Curve, pieces: &Pieces, kind: Kind, options: &Options) -> Result<(), ValuesError> {
        let samples = || samples::samples(pieces, options.samples);
        let spline = || results::spline_of(curve);
        match kind {
            Kind::Point => {
                let entries = samples()
                    .into_iter()
                    .filter_map(|sample| results::point(curve, &sample));
                self.entries.extend(entries);
            }
            Kind::Derivative | Kind::Curvature | Kind::Torsion => {
                for sample in samples() {
                    for &side in sample.sides {
                        match kind {
                            Kind::Derivative => {
                                self.entries.extend(results::derivative_entries(curve, &sample, side));
                            }
                            Kind::Curvature => self.entries.extend(results::curvature(curve, &sample, side)),
                            _ => self.entries.extend(results::torsion(curve, &sample, side)),
                        }
                    }
                }
            }
            Kind::InsertKnot => {
                let entries = spline().map(|spline| results::insertions(&spline, pieces));
                self.entries.extend(entries.unwrap_or_default());
            }
            Kind::RemoveKnot => {
                let entries = spline().map(|spline| results::removals(&spline, pieces));
                self.entries.extend(entries.unwrap_or_default());
            }
            Kind::ElevateDegree => {
                let entries = spline().map(|spline| results::elevations(&spline));
                self.entries.extend(entries.unwrap_or_default());
            }
            Kind::Split => {
                let entries = spline().map(|spline| results::splits(&spline, pieces));
                self.entries.extend(entries.unwrap_or_default());
            }
            Kind::Decompose => self.entries.extend(results::decomposition(curve)),
            Kind::NearestPoint => {
                let float = FloatCurve::new(pieces);
                for target in &options.targets {
                    let width = Width::new(&options.relative_width, float.size());
                    let found = nearest::nearest(pieces, &float, target, &width);
                    let target = target.clone();
                    self.distance(Operation::NearestPoint { target }, found, &width);
                }
            }
            Kind::CurveDistance => {
                let float = FloatCurve::new(pieces);
                for (number, other) in options.others.iter().enumerate() {
                    let theirs = Pieces::new(other).map_err(|piece| ValuesError::PointPiece {
                        other: Some(number),
                        piece,
                    })?;
                    let other_float = FloatCurve::new(&theirs);
                    let width = Width::new(&options.relative_width, float.size().max(other_float.size()));
                    let found = distance::distance([pieces, &theirs], [&float, &other_float], &width);
                    let other = Box::new(other.clone());
                    self.distance(Operation::CurveDistance { other }, found, &width);
                }
            }
        }
        Ok(())
    }

    fn distance(&mut self, operation: Operation, (bracket, witness): (Bracket, Witness), width: &Width) {
        self.wide += usize::from(!width.is_reached(&bracket));
        let Bracket { lower, upper } = bracket;
        self.entries.push(Entry {
            operation,
            outcome: Outcome::DistanceSquared { lower, upper },
        });
        self.witnesses.push(witness);
    }
}
