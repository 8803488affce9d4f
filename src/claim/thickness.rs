//! The thickness of a curve: the smaller of its least radius of curvature and half its minimum separation distance (FORMAT §12).

use super::msd::{Convention, Lower};
use super::{curvature, msd};
use crate::number::Rational;

/// What a certificate of this claim says: τ² in an interval, τ = min(1/κ_max, σ/2), and τ = 0 of a curve with a corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// Which chords σ is about; `Smooth` for closed curves only.
    pub convention: Convention,
    /// At most τ².
    pub lower_squared: Lower,
    /// At least τ²; `None`: not bounded.
    pub upper_squared: Option<Rational>,
}

/// Why the statement holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// The curve has a corner.
    Corner {
        /// A joint, 0 for the closing point.
        joint: usize,
    },
    /// Bounds of both numbers.
    Bounds {
        /// Those of σ; its tree is streamed.
        msd: Box<msd::Content>,
        /// Those of the greatest curvature.
        curvature: Box<curvature::Content>,
    },
}

/// Statement and evidence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Content {
    /// What is claimed.
    pub statement: Statement,
    /// Why.
    pub evidence: Evidence,
}

impl Content {
    /// Is there a tree, that of the bounds of σ?
    pub fn has_tree(&self) -> bool {
        matches!(&self.evidence, Evidence::Bounds { msd, .. } if msd.has_tree)
    }
}
