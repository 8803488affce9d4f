//! A moving curve: what stays true of it and of its control polygon at, and between, all frames (FORMAT §14).

mod event;

use super::msd::Interval;
use crate::number::{Integer, Rational};

pub use event::{Event, EventSource, Move, MoveError, TrackKind, write_event, write_move};

/// The most frames after the first.
pub const MAX_STEPS: u64 = 100_000_000;
/// The greatest exponent of two in the denominator of a time between frames.
pub const MAX_TIME_EXPONENT: u32 = 60;

/// What a certificate of this claim says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// N, the number of moves.
    pub steps: u64,
    /// Q ≥ 1: all displacements, and the coordinates of the first frame, are integers over it.
    pub denominator: Integer,
    /// The hash of curve, denominator and moves: 64 hexadecimal digits.
    pub motion_sha256: String,
    /// What is said of the curve, if anything is.
    pub curve: Option<Track>,
    /// What is said of the polygon of its own control points, if anything is.
    pub polygon: Option<Track>,
    /// When the criteria that look at single frames first fail.
    pub criteria: Option<Criteria>,
}

impl Statement {
    /// What is said of one of the two.
    pub fn track(&self, kind: TrackKind) -> Option<&Track> {
        match kind {
            TrackKind::Curve => self.curve.as_ref(),
            TrackKind::Polygon => self.polygon.as_ref(),
        }
    }
}

/// What is said of the curve, or of the polygon. Times count moves: i + λ is the fraction λ of the way from frame i to frame i+1.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Track {
    /// At every time from 0 to this one it is embedded, and ambient isotopic to the first.
    pub embedded_through: Rational,
    /// Some time after `embedded_through` and not after this one, two different parameters have one point.
    pub meets_by: Option<Rational>,
}

/// When the criteria of the literature first fail, in whole frames.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Criteria {
    /// The distance that must not be reached, ε.
    pub display_tolerance: Rational,
    /// Second differences times N∞ and greatest displacement together reach ε.
    pub second_differences: FirstFailures,
    /// Some control point has moved by half of ν or more.
    pub half_nu: Option<HalfNu>,
}

/// The first frame at which a criterion fails, in two norms; `None` if it never does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct FirstFailures {
    /// In the norm of greatest coordinates.
    pub infinity: Option<u64>,
    /// In the Euclidean norm.
    pub euclidean: Option<u64>,
}

/// The criterion of half the least distance of a vertex from an edge that does not end in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct HalfNu {
    /// ν², at time 0.
    pub nu_squared: Rational,
    /// When a control point has first moved by ν/2 or more.
    pub failures: FirstFailures,
}

/// Why two different parameters have one point at some time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Contact {
    /// At an exact time, at exact parameters.
    Touch {
        /// The time.
        time: Rational,
        /// First parameter.
        s: Rational,
        /// Second parameter.
        t: Rational,
    },
    /// In the plane: at an exact time the curve crosses itself in a box of parameters.
    Crossing {
        /// The time.
        time: Rational,
        /// First interval I.
        s: Interval,
        /// Second interval J.
        t: Interval,
        /// n₁.
        first: [Integer; 3],
        /// n₂.
        second: [Integer; 3],
    },
    /// In space: between two times one part of the curve passes through another.
    Passage {
        /// u₀ and u₁.
        times: [Rational; 2],
        /// First interval I.
        s: Interval,
        /// Second interval J.
        t: Interval,
        /// n₁, n₂, n₃.
        vectors: [[Integer; 3]; 3],
    },
}

impl Contact {
    /// The rule's name.
    pub fn rule(&self) -> &'static str {
        match self {
            Contact::Touch { .. } => "touch",
            Contact::Crossing { .. } => "crossing",
            Contact::Passage { .. } => "passage",
        }
    }
}

/// The evidence beside the events, which are streamed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Evidence {
    /// Why the curve meets itself, when and only when the statement says so.
    pub curve_contact: Option<Contact>,
    /// Why the polygon does.
    pub polygon_contact: Option<Contact>,
}

/// Statement and evidence; the events are streamed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Content {
    /// What is claimed.
    pub statement: Statement,
    /// Why, beside the events.
    pub evidence: Evidence,
}
