//! How far a curve is from its control polygon after subdivision (FORMAT §13).

use crate::number::Rational;

/// What a certificate of this claim says: the greatest squared distance of c(t) from L(t) lies in an interval.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// How often every piece is halved.
    pub subdivisions: u32,
    /// At most the greatest squared distance; not negative.
    pub lower_squared: Rational,
    /// At least it.
    pub upper_squared: Rational,
}

/// Where the lower bound is attained; the upper one needs no witness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// A piece.
    pub piece: usize,
    /// One of its 2^subdivisions parts.
    pub part: u64,
    /// A local parameter of the part, from 0 to 1.
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
