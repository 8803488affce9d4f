//! A curve as a chain of Bézier pieces on the global parameter 0 ≤ t ≤ M.

use std::borrow::Cow;

use num_traits::{One, Zero};

use super::data::joins;
use super::{Bezier, Curve, Form};
use crate::number::{Integer, Rational, RationalVector};

/// M Bézier pieces, piece i on the global parameter range [i, i + 1], each starting exactly where the one before ends.
///
/// Pieces whose weights are all equal carry none. Pieces given as such are borrowed, so that large curves are not copied.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chain<'a> {
    dimension: usize,
    pieces: Cow<'a, [Bezier]>,
    /// The user's knots 0 … M of the piece ends; nothing when they are the integers.
    knots: Option<RationalVector>,
    closed: bool,
}

/// One piece of a chain with its interval of the user's knots.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Piece<'a> {
    /// The piece.
    pub bezier: &'a Bezier,
    /// The user's knots at its start and end.
    pub knots: (Rational, Rational),
}

impl Curve {
    /// The curve as a chain of Bézier pieces: B-splines by exact knot insertion, Bézier pieces as they are.
    pub fn chain(&self) -> Chain<'_> {
        match self.form() {
            Form::BSpline(spline) => {
                let (pieces, knots) = super::decompose::decompose(spline);
                Chain::new(Cow::Owned(pieces), Some(knots))
            }
            Form::Bezier(pieces) if pieces.iter().any(has_idle_weights) => {
                Chain::new(Cow::Owned(strip(pieces.clone())), None)
            }
            Form::Bezier(pieces) => Chain::new(Cow::Borrowed(pieces), None),
        }
    }

    /// The same as [`Curve::chain`] without a loan or a copy.
    pub fn into_chain(self) -> Chain<'static> {
        match self.into_form() {
            Form::BSpline(spline) => {
                let (pieces, knots) = super::decompose::decompose(&spline);
                Chain::new(Cow::Owned(pieces), Some(knots))
            }
            Form::Bezier(pieces) => Chain::new(Cow::Owned(strip(pieces)), None),
        }
    }
}

fn has_idle_weights(piece: &Bezier) -> bool {
    piece.weights.is_some() && piece.is_polynomial()
}

fn strip(mut pieces: Vec<Bezier>) -> Vec<Bezier> {
    for piece in pieces.iter_mut().filter(|p| has_idle_weights(p)) {
        piece.weights = None;
    }
    pieces
}

impl<'a> Chain<'a> {
    /// `pieces` is not empty, of one dimension and joined; `knots` has one entry more.
    fn new(pieces: Cow<'a, [Bezier]>, knots: Option<RationalVector>) -> Chain<'a> {
        let (first, last) = (&pieces[0], &pieces[pieces.len() - 1]);
        Chain {
            dimension: first.dimension,
            closed: joins(last, first),
            pieces,
            knots,
        }
    }

    /// Coordinates of a point, 2 or 3.
    pub fn dimension(&self) -> usize {
        self.dimension
    }

    /// The pieces, at least one.
    pub fn pieces(&self) -> &[Bezier] {
        &self.pieces
    }

    /// The number M of pieces; the global parameter runs from 0 to M.
    pub fn count(&self) -> usize {
        self.pieces.len()
    }

    /// Whether the two ends coincide exactly.
    pub fn closed(&self) -> bool {
        self.closed
    }

    /// Piece `i` with its knots, or nothing when there is none.
    pub fn piece(&self, i: usize) -> Option<Piece<'_>> {
        let bezier = self.pieces.get(i)?;
        let knots = match &self.knots {
            Some(knots) => (knots.get(i), knots.get(i + 1)),
            None => (integer(i), integer(i + 1)),
        };
        Some(Piece { bezier, knots })
    }

    /// The piece and the local parameter 0 ≤ u ≤ 1 of a global parameter 0 ≤ t ≤ M; a joint belongs to the piece after
    /// it, M to the last piece. Nothing outside.
    pub fn locate(&self, parameter: &Rational) -> Option<(usize, Rational)> {
        let floor = parameter.numer().div_floor(parameter.denom());
        let i = usize::try_from(floor.to_u64()?).ok()?;
        if i == self.count() && parameter.is_integer() {
            return Some((i - 1, Rational::one()));
        }
        (i < self.count()).then(|| (i, parameter - Rational::from_integer(floor)))
    }

    /// The user's knot value at the global parameter i + u, or nothing outside [0, M].
    pub fn knot_at(&self, parameter: &Rational) -> Option<Rational> {
        let (i, u) = self.locate(parameter)?;
        let (start, end) = self.piece(i)?.knots;
        Some(&start + u * (end - &start))
    }

    /// The global parameter i + u at the user's knot value, or nothing outside the domain.
    pub fn parameter_at(&self, knot: &Rational) -> Option<Rational> {
        let Some(knots) = &self.knots else {
            return (*knot >= Rational::zero() && *knot <= integer(self.count())).then(|| knot.clone());
        };
        let count = self.count();
        if *knot < knots.get(0) || *knot > knots.get(count) {
            return None;
        }
        // The number of joints at or before the knot.
        let (mut low, mut high) = (0, count);
        while high - low > 1 {
            let middle = low + (high - low) / 2;
            if knots.get(middle) <= *knot {
                low = middle;
            } else {
                high = middle;
            }
        }
        let (start, end) = (knots.get(low), knots.get(low + 1));
        Some(integer(low) + (knot - &start) / (end - start))
    }

    /// The chain with its pieces owned.
    pub fn into_owned(self) -> Chain<'static> {
        Chain {
            dimension: self.dimension,
            pieces: Cow::Owned(self.pieces.into_owned()),
            knots: self.knots,
            closed: self.closed,
        }
    }
}

fn integer(i: usize) -> Rational {
    Rational::from_integer(Integer::from(i))
}
