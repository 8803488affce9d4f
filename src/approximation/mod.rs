//! Polygons that approximate polynomial curves, and what they tell of the minimum separation distance, exactly.
//!
//! - [`measure`]: second centred differences and edges of every piece ([`PieceMeasures`]), and the bounds that rest on them ([`Bounds`]);
//! - [`Polygon`]: the control polygon after m uniform subdivisions, with its discrete derivative, the readings of the estimate of
//!   Cassidy, Peters and Jordan (2012), "CPJ12", and an interval of σ that is proved ([`Separation`]);
//! - [`Plan`]: CPJ12's numbers ε, m₁, m₂, m and E, equations (1) to (3), decided exactly;
//! - [`predecessor`]: the subdivisions m̃₁, m̃₂ of the method before.
//!
//! Rational pieces are refused by number: the bounds do not hold for them. Statements and proofs are in `docs/approximation.md`.

mod difference;
mod enclosure;
mod plan;
mod polygon;
mod power;
pub mod predecessor;
mod search;
mod segment;
mod separation;

pub use difference::{Bounds, Norm, Norms, PieceMeasures, bounds, measure, nairn_peters_lutterkort};
pub use enclosure::sine;
pub use plan::{Parameters, Plan, plan};
pub use polygon::{MOST_EDGES, MOST_SUBDIVISIONS, Polygon};
pub use power::least_power;
pub use separation::{Chord, Pair, Separation};

/// Why a curve or a tolerance is refused.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ApproximationError {
    /// A piece is rational: the bounds by second differences do not hold for it.
    RationalPiece {
        /// Its number.
        piece: usize,
    },
    /// A tolerance is zero or negative.
    Tolerance {
        /// Its name.
        name: &'static str,
    },
    /// More subdivisions than [`MOST_SUBDIVISIONS`] or more edges than [`MOST_EDGES`].
    TooMany,
}

impl std::fmt::Display for ApproximationError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            ApproximationError::RationalPiece { piece } => write!(
                f,
                "piece {piece} is rational; the bounds by second differences are for polynomial pieces"
            ),
            ApproximationError::Tolerance { name } => {
                write!(f, "found {name} zero or negative, expected a positive number")
            }
            ApproximationError::TooMany => write!(
                f,
                "expected at most {MOST_SUBDIVISIONS} subdivisions, and at most {MOST_EDGES} edges"
            ),
        }
    }
}

impl std::error::Error for ApproximationError {}

#[cfg(test)]
mod tests;
