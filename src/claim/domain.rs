//! The convex domain of a control point: where it may be so that curvature or torsion keeps one sign (FORMAT §9).

use crate::number::{Integer, Rational};

/// The sign that curvature (in the plane) or torsion (in space) is to have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Greater than 0.
    Positive,
    /// Less than 0.
    Negative,
}

impl Sign {
    /// Its name in a certificate.
    pub fn name(self) -> &'static str {
        match self {
            Sign::Positive => "+",
            Sign::Negative => "-",
        }
    }

    /// The sign of a name.
    pub fn from_name(name: &str) -> Option<Self> {
        [Sign::Positive, Sign::Negative]
            .into_iter()
            .find(|sign| sign.name() == name)
    }
}

/// An axis-parallel box, its two corners; each has as many coordinates as the curve.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Box {
    /// The least coordinates.
    pub low: Vec<Rational>,
    /// The greatest coordinates, each greater than the least.
    pub high: Vec<Rational>,
}

/// Which set is spoken of: K ∩ B.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Domain {
    /// The control points that move together, by their place in the curve's list of points (of all pieces, one after another).
    pub points: Vec<usize>,
    /// The sign.
    pub sign: Sign,
    /// The part of the curve, in the chain's global parameter.
    pub interval: [Rational; 2],
    /// Is the interval open at its start, at its end?
    pub open: [bool; 2],
    /// The box B.
    pub bounds: Box,
}

/// What is claimed of the domain.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Two polytopes, one inside K ∩ B and one around it.
    Sandwich {
        /// At most the area or volume of the inner polytope; positive.
        inner_measure: Rational,
        /// At least the area or volume of the outer polytope.
        outer_measure: Rational,
    },
    /// K ∩ B is empty.
    Empty,
    /// The least distance from a point to cl K ∩ B.
    Nearest {
        /// Which point.
        to: Target,
        /// At most the distance, squared.
        lower_squared: Rational,
        /// At least the distance, squared.
        upper_squared: Rational,
    },
    /// The least length of a move, from a position in K, to where the sign is no longer kept.
    Change {
        /// The position.
        from: Vec<Rational>,
        /// At most the length, squared.
        lower_squared: Rational,
        /// At least the length, squared.
        upper_squared: Rational,
    },
    /// The radius of the greatest ball in cl K ∩ B.
    Ball {
        /// At most the radius; positive.
        lower: Rational,
        /// At least the radius.
        upper: Rational,
    },
}

/// The point that a nearest point is sought to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// Its coordinates.
    Point(Vec<Rational>),
    /// Where the control point would minimise ∫|c''|² dt if it were free to move anywhere.
    Fair,
}

/// What a certificate of this claim says.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Statement {
    /// The set.
    pub domain: Domain,
    /// What is said of it.
    pub outcome: Outcome,
}

/// A half-space that contains K ∩ B.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Row {
    /// The sign function at a parameter is not negative.
    Parameter {
        /// The piece.
        piece: usize,
        /// The local parameter, from 0 to 1.
        u: Rational,
    },
    /// A side of the box.
    Side {
        /// The axis.
        axis: usize,
        /// The side of the greatest coordinate, or of the least?
        high: bool,
    },
}

/// Points over one denominator.
pub type Points = Vec<Vec<Integer>>;

/// A polytope around the center, as the union of the simplices over its cells.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Star {
    /// Points over the denominator.
    pub points: Points,
    /// For each cell the numbers of its points, as many as the curve has coordinates.
    pub cells: Vec<Vec<usize>>,
}

/// Why the statement holds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Evidence {
    /// For [`Outcome::Sandwich`].
    Sandwich {
        /// All points are integers over this.
        denominator: Integer,
        /// A point of K ∩ B.
        center: Vec<Integer>,
        /// Points of cl K ∩ B, and cells between them.
        inner: Star,
        /// A surface around K ∩ B.
        outer: Star,
        /// Half-spaces that contain K ∩ B.
        rows: Vec<Row>,
        /// For each cell of `outer` the row that cuts K off there.
        cell_rows: Vec<usize>,
    },
    /// For [`Outcome::Empty`].
    Empty {
        /// Half-spaces that contain K ∩ B.
        rows: Vec<Row>,
        /// How often each is taken.
        multipliers: Vec<Integer>,
    },
    /// For [`Outcome::Nearest`].
    Nearest {
        /// A point of K.
        center: Vec<Rational>,
        /// A point of cl K ∩ B as near.
        point: Vec<Rational>,
        /// The point where the multipliers are stationary.
        base: Vec<Rational>,
        /// Half-spaces that contain K ∩ B.
        rows: Vec<Row>,
        /// How often each is taken.
        multipliers: Vec<Rational>,
    },
    /// For [`Outcome::Change`].
    Change {
        /// Where the sign changes within `upper_squared`.
        row: Row,
    },
    /// For [`Outcome::Ball`].
    Ball {
        /// The center of a ball of radius `lower`.
        center: Vec<Rational>,
        /// Half-spaces that contain K ∩ B.
        rows: Vec<Row>,
        /// How often each is taken.
        multipliers: Vec<Rational>,
        /// For each row at most the length of its normal.
        lengths: Vec<Rational>,
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
