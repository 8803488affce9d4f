//! The minimum separation distance: the length σ of the shortest double normal (FORMAT §4, §6).

use crate::number::{Integer, Rational};

/// Which chords count as double normals at corners and ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convention {
    /// Orthogonal to a one-sided tangent at each end.
    Smooth,
    /// Corners and open ends are points of their own, where a turning point of the distance counts.
    Critical,
}

impl Convention {
    /// Its name in a certificate.
    pub fn name(self) -> &'static str {
        match self {
            Convention::Smooth => "smooth",
            Convention::Critical => "critical",
        }
    }

    /// The convention of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        [Convention::Smooth, Convention::Critical]
            .into_iter()
            .find(|convention| convention.name() == name)
    }
}

/// A lower bound of σ².
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Lower {
    /// There is no double normal at all.
    Infinite,
    /// Every double normal has at least this squared length, a number ≥ 0.
    Finite(Rational),
}

/// What a certificate of this claim says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// Which chords count.
    pub convention: Convention,
    /// Every double normal is at least this long, squared.
    pub lower_squared: Lower,
    /// Some double normal is at most this long, squared; `None`: not bounded.
    pub upper_squared: Option<Rational>,
}

/// The evidence beside the cover tree, which is streamed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The boxes of runs are on the grid 2^-grid.
    pub grid: u32,
    /// Why the upper bound holds; present when and only when there is one.
    pub upper: Option<Upper>,
}

/// Statement and evidence; the tree itself is streamed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Content {
    /// What is claimed.
    pub statement: Statement,
    /// Why, beside the tree.
    pub evidence: Evidence,
    /// Is there a tree?
    pub has_tree: bool,
}

/// A closed parameter interval of the chain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Interval {
    /// Start.
    pub start: Rational,
    /// End, greater than the start.
    pub end: Rational,
}

/// On which piece an integer parameter is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The piece that ends there.
    Before,
    /// The piece that begins there.
    After,
}

impl Side {
    /// Its name in a certificate.
    pub fn name(self) -> &'static str {
        match self {
            Side::Before => "before",
            Side::After => "after",
        }
    }

    /// The side of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        [Side::Before, Side::After].into_iter().find(|side| side.name() == name)
    }
}

/// One rule for the upper bound, with its witness.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Upper {
    /// A double normal exists in a box of parameters, by the signs of two functions on its faces.
    Miranda {
        /// First interval I.
        s: Interval,
        /// Second interval J.
        t: Interval,
        /// α₁, β₁.
        first: [Integer; 2],
        /// α₂, β₂.
        second: [Integer; 2],
        /// m_I and m_J; the third component is 0 in the plane.
        regular: [[Integer; 3]; 2],
        /// Into how many equal sub-sections each section is cut on the faces.
        subdivisions: u32,
    },
    /// A chord that is exactly orthogonal at both ends.
    Root {
        /// First parameter and its side.
        s: (Rational, Side),
        /// Second parameter and its side.
        t: (Rational, Side),
    },
    /// The curve passes twice through a point, at exact parameters.
    Touch {
        /// First parameter.
        s: Rational,
        /// Second parameter.
        t: Rational,
    },
    /// A planar curve crosses itself in a box of parameters.
    Crossing {
        /// First interval I.
        s: Interval,
        /// Second interval J.
        t: Interval,
        /// n₁.
        first: [Integer; 3],
        /// n₂.
        second: [Integer; 3],
    },
    /// A critical chord at exact parameters.
    CriticalRoot {
        /// First parameter.
        s: Rational,
        /// Second parameter.
        t: Rational,
    },
    /// A critical chord from a corner or an end to a point in an interval.
    CriticalInterval {
        /// The corner or end.
        s: Rational,
        /// The interval.
        t: Interval,
        /// m_J.
        regular: [Integer; 3],
    },
}
