//! The embedding of a curve: no two parameters with one point (FORMAT §10).

use crate::number::Rational;

/// How far control points may move, all at the same time, without the curve meeting itself. Both are fractions ≥ 0; 0 says nothing.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Radius {
    /// Every coordinate of every control point may change by less than this.
    pub infinity: Rational,
    /// Every control point may move by less than this distance.
    pub euclidean: Rational,
}

/// What a certificate of this claim says: the curve is embedded, and so are its neighbours.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// Edges of the polygon inscribed at the end points of the tree's leaves, which is ambient isotopic to the curve.
    pub edges: u64,
    /// Moves of the control points that leave the curve embedded.
    pub perturbation_radius: Radius,
}

/// The evidence beside the cover tree, which is streamed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The boxes of runs are on the grid 2^-grid.
    pub grid: u32,
}

/// Statement and evidence; the tree itself is streamed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Content {
    /// What is claimed.
    pub statement: Statement,
    /// Why, beside the tree.
    pub evidence: Evidence,
}
