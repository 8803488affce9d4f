//! What reading changed, left out or came upon, in numbers.

use std::fmt;

use crate::number::{Rational, decimal_up, sqrt_decimal_up};

/// Something to know about an imported curve. Without notes other than [`Note::Missed`] the curve is exactly what the file says.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Note {
    /// Arcs, or rotations, that are no rational curves were replaced by rational ones near them.
    Approximated {
        /// How many arcs were replaced; 0 when only a rotation was.
        arcs: usize,
        /// No point of the curve is farther than this from the file's curve, and the other way round, in the file's units.
        bound: Rational,
    },
    /// Pieces all of whose control points coincide were left out.
    Dropped {
        /// How many.
        pieces: usize,
    },
    /// The curve's end was moved to its start.
    Welded {
        /// The square of how far, in the file's units.
        distance_squared: Rational,
    },
    /// The curve's end misses its start, which rounding of the file's numbers explains; it was left as it is, with the line that closes it if the file closes it.
    /// [`Options::weld`](super::Options::weld) moves the end to the start.
    Missed {
        /// The square of the distance, in the file's units.
        distance_squared: Rational,
    },
    /// Neighbours in a backbone whose residue numbers do not follow each other are joined all the same.
    Bridged {
        /// How many such gaps.
        gaps: usize,
    },
    /// A curve through the file's points, made by the reader.
    Smoothed,
}

impl Note {
    /// Whether it tells of a difference between the curve and the file.
    pub fn is_change(&self) -> bool {
        !matches!(self, Note::Missed { .. })
    }
}

impl fmt::Display for Note {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let s = |n: usize| if n == 1 { "" } else { "s" };
        match self {
            Note::Approximated { arcs: 0, bound } => {
                write!(f, "a rotation approximated, distance at most {}", decimal_up(bound, 2))
            }
            Note::Approximated { arcs, bound } => {
                let bound = decimal_up(bound, 2);
                write!(f, "{arcs} arc{} approximated, distance at most {bound}", s(*arcs))
            }
            Note::Dropped { pieces } => write!(f, "{pieces} piece{} without length left out", s(*pieces)),
            Note::Welded { distance_squared } => {
                let distance = sqrt_decimal_up(distance_squared, 2);
                write!(f, "end welded to the start, moved by {distance}")
            }
            Note::Missed { distance_squared } => {
                let distance = sqrt_decimal_up(distance_squared, 2);
                write!(
                    f,
                    "the end misses the start by {distance}, as rounding may; --weld moves it there"
                )
            }
            Note::Bridged { gaps } => write!(f, "{gaps} gap{} in the residue numbers bridged", s(*gaps)),
            Note::Smoothed => f.write_str("C1 cubics through the file's points (Catmull-Rom)"),
        }
    }
}
