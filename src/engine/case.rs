//! Cases: operations on curves in binary64.

use serde::{Deserialize, Serialize};

use super::FloatCurve;

/// Which of the two one-sided values is asked for where they differ.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CaseSide {
    /// The limit from smaller parameters.
    Left,
    /// The limit from greater parameters.
    Right,
}

/// What is asked of an engine about a curve.
#[derive(Debug, Clone, PartialEq)]
pub enum Operation {
    /// The point c(t).
    Point {
        /// t.
        parameter: f64,
    },
    /// The derivative of some order with respect to the parameter.
    Derivative {
        /// t.
        parameter: f64,
        /// The order, at least 1.
        order: usize,
        /// The side where t is a knot.
        side: CaseSide,
    },
    /// The curvature, a magnitude or, in the plane, signed.
    Curvature {
        /// t.
        parameter: f64,
        /// The side where t is a knot.
        side: CaseSide,
    },
    /// The torsion of a curve in space.
    Torsion {
        /// t.
        parameter: f64,
        /// The side where t is a knot.
        side: CaseSide,
    },
    /// The same curve with a knot more often.
    InsertKnot {
        /// The knot.
        parameter: f64,
        /// How often.
        times: usize,
    },
    /// The same curve with a knot less often; only knots that are exactly removable are asked for.
    RemoveKnot {
        /// The knot.
        parameter: f64,
        /// How often.
        times: usize,
    },
    /// The same curve with a higher degree.
    ElevateDegree {
        /// By how much.
        times: usize,
    },
    /// The two parts of the curve before and after a parameter inside the domain.
    Split {
        /// Where.
        parameter: f64,
    },
    /// The Bézier pieces of the curve.
    Decompose,
    /// The distance from a point to the curve.
    NearestPoint {
        /// The point.
        target: Vec<f64>,
    },
    /// The smallest distance between this curve and another.
    CurveDistance {
        /// The other curve.
        other: Box<FloatCurve>,
    },
    /// The length of the shortest double normal of the curve, smooth convention.
    Msd,
    /// The convex domain of a control point after a number of subdivisions: where it can be put, inside a box, so that all Bernstein coefficients of the
    /// sign of curvature (in the plane) or torsion (in space) are at least 0.
    ConvexDomain {
        /// The index of the control point.
        point: usize,
        /// Half the width of the box around its place.
        half_width: f64,
        /// How often every span is halved, at most [`MOST_LEVELS`].
        level: u32,
        /// The sign: greater than 0, or less.
        positive: bool,
    },
}

/// The last level of a convex domain.
pub const MOST_LEVELS: u32 = 16;

/// The names of all operations.
pub const OPERATIONS: [&str; 13] = [
    "point",
    "derivative",
    "curvature",
    "torsion",
    "insert_knot",
    "remove_knot",
    "elevate_degree",
    "split",
    "decompose",
    "nearest_point",
    "curve_distance",
    "msd",
    "convex_domain",
];

impl Operation {
    /// The name in files, one of [`OPERATIONS`].
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
            Operation::Msd => "msd",
            Operation::ConvexDomain { .. } => "convex_domain",
        }
    }

    /// The parameter, when there is one.
    pub fn parameter(&self) -> Option<f64> {
        match self {
            Operation::Point { parameter }
            | Operation::Derivative { parameter, .. }
            | Operation::Curvature { parameter, .. }
            | Operation::Torsion { parameter, .. }
            | Operation::InsertKnot { parameter, .. }
            | Operation::RemoveKnot { parameter, .. }
            | Operation::Split { parameter } => Some(*parameter),
            _ => None,
        }
    }
}

/// One operation on one curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// Its name, unique in a file.
    pub id: String,
    /// What is asked.
    pub operation: Operation,
    /// About which curve.
    pub curve: FloatCurve,
}

/// A file of cases.
#[derive(Debug, Clone, PartialEq)]
pub struct CasesFile {
    /// The seed the cases were made from, when they were.
    pub seed: Option<u64>,
    /// The cases, with ids all different.
    pub cases: Vec<Case>,
}
