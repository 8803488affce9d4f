//! The greatest curvature of a curve (FORMAT §11).

use crate::number::Rational;

/// What a certificate of this claim says: κ² of the point of greatest curvature, an interval.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// At most the greatest squared curvature; not negative.
    pub lower_squared: Rational,
    /// At least the squared curvature everywhere.
    pub upper_squared: Rational,
}

/// Why the lower bound holds; the upper one needs no witness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// A piece of the curve, from 0.
    pub piece: usize,
    /// A local parameter from 0 to 1 where the squared curvature is at least `lower_squared`.
    pub u: Rational,
}

/// Statement and evidence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Content {
    /// What is claimed.
    pub statement: Statement,
    /// Why.
    pub evidence: Evidence,
}
