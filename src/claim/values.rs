//! Exact results of the basic operations on a curve (FORMAT §15).
//!
//! Parameters are knot values of the curve, from the first to the last of its domain; the pieces of a Bézier chain have the knots 0, 1, 2, ….

use super::tree::Token;
use crate::curve::Curve;
use crate::number::Rational;

/// The most entries of a certificate.
pub const MOST_ENTRIES: usize = 65_536;
/// The highest order of a derivative.
pub const MOST_ORDER: u32 = 64;
/// How often a knot is inserted or removed, and by how much a degree is elevated, at most.
pub const MOST_TIMES: u32 = 64;
/// The most tokens of the trees of a certificate.
pub const MOST_TOKENS: usize = 4_194_304;

/// A side of a parameter, where the two can differ. At the first parameter there is only the right one, at the last only the left one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The limit from smaller parameters.
    Left,
    /// The limit from greater parameters.
    Right,
}

impl Side {
    /// As it is written.
    pub fn name(self) -> &'static str {
        match self {
            Side::Left => "left",
            Side::Right => "right",
        }
    }
}

/// An operation on the certificate's curve c, with its parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Operation {
    /// The point c(t).
    Point {
        /// t.
        parameter: Rational,
    },
    /// The derivative of an order with respect to t.
    Derivative {
        /// t.
        parameter: Rational,
        /// 1 to [`MOST_ORDER`].
        order: u32,
        /// Which one-sided value.
        side: Side,
    },
    /// The squared curvature |c'×c''|²/|c'|⁶.
    Curvature {
        /// t.
        parameter: Rational,
        /// Which one-sided value.
        side: Side,
    },
    /// The torsion det(c', c'', c''')/|c'×c''|², of a curve in space.
    Torsion {
        /// t.
        parameter: Rational,
        /// Which one-sided value.
        side: Side,
    },
    /// The same curve with a knot more often.
    InsertKnot {
        /// The knot.
        parameter: Rational,
        /// How often more, 1 to [`MOST_TIMES`].
        times: u32,
    },
    /// The same curve with a knot less often.
    RemoveKnot {
        /// The knot.
        parameter: Rational,
        /// How often less, 1 to [`MOST_TIMES`].
        times: u32,
    },
    /// The same curve with a higher degree, every knot as often more.
    ElevateDegree {
        /// By how much, 1 to [`MOST_TIMES`].
        times: u32,
    },
    /// The two curves before and after a parameter, which is inside the domain.
    Split {
        /// The parameter.
        parameter: Rational,
    },
    /// The Bézier pieces of the non-empty knot intervals, each on its own range 0 to 1.
    Decompose,
    /// The squared distance of a point from the curve.
    NearestPoint {
        /// The point.
        target: Vec<Rational>,
    },
    /// The squared distance of another curve from this one.
    CurveDistance {
        /// The other curve.
        other: Box<Curve>,
    },
}

impl Operation {
    /// As it is written.
    pub fn name(&self) -> &'static str {
        match self {
            Operation::Point { .. } => "point",
            Operation::Derivative { .. } => "derivative",
            Operation::Curvature { .. } => "curvature",
            Operation::Torsion { .. } => "torsion",
            Operation::InsertKnot { .. } => "insert_knot",
            Operation::RemoveKnot { .. } => "remove_knot",
            Operation::ElevateDegree { .. } => "elevate_degree",
            Operation::Split { .. } => "split",
            Operation::Decompose => "decompose",
            Operation::NearestPoint { .. } => "nearest_point",
            Operation::CurveDistance { .. } => "curve_distance",
        }
    }
}

/// The exact result of an operation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Of `point`: d coordinates.
    Point(Vec<Rational>),
    /// Of `derivative`: d coordinates.
    Vector(Vec<Rational>),
    /// Of `curvature`: κ².
    ValueSquared(Rational),
    /// Of `torsion`.
    Value(Rational),
    /// Of `insert_knot`, `remove_knot`, `elevate_degree` a B-spline, of `decompose` Bézier pieces.
    Curve(Box<Curve>),
    /// Of `split`: two B-splines.
    Curves(Box<[Curve; 2]>),
    /// Of `nearest_point` and `curve_distance`: the squared distance lies in this interval.
    DistanceSquared {
        /// At most the squared distance; not negative.
        lower: Rational,
        /// At least it.
        upper: Rational,
    },
}

/// One operation and its result.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// What is asked.
    pub operation: Operation,
    /// The answer, of the kind that belongs to the operation.
    pub outcome: Outcome,
}

/// What a certificate of this claim says: every entry's outcome is that of its operation on the curve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// The entries, at most [`MOST_ENTRIES`].
    pub entries: Vec<Entry>,
}

/// Why a distance lies in its interval.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Witness {
    /// Of `nearest_point`; the lower bound needs no witness.
    Nearest {
        /// A parameter of a point that is not farther than the upper bound.
        parameter: Rational,
    },
    /// Of `curve_distance`.
    Distance {
        /// Parameters of points, on this curve and on the other, that are not farther apart than the upper bound.
        parameters: [Rational; 2],
        /// The cover tree of the lower bound; nothing when that is 0. Its tokens are [`Token::First`], [`Token::Second`] and the leaf `far`.
        tree: Option<Vec<Token>>,
    },
}

/// The witnesses of those entries that need one, in the order of the entries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// One for each entry `nearest_point` or `curve_distance`.
    pub witnesses: Vec<Witness>,
}

/// Statement and evidence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Content {
    /// What is claimed.
    pub statement: Statement,
    /// Why.
    pub evidence: Evidence,
}
