//! From an approximate double normal to evidence that one exists nearby: one file for each kind of evidence.

mod corner;
mod crossing;
mod miranda;
mod rational;
mod round;

use super::float_chain::FloatChain;
use super::newton::{Candidate, Location};
use super::vector::{dot, quantised, sub};
use crate::check::chain::Chain;
use crate::check::section::{locate, point};
use crate::claim::msd::{Convention, Interval, Side, Upper};
use crate::number::{Integer, Rational, RationalExt};
use round::integer;
pub use round::{few_bits_between, raw_product};

/// Evidence for an upper bound, and the bound it proves.
#[derive(Clone, Debug)]
pub struct UpperBound {
    /// The rule and its witness.
    pub rule: Upper,
    /// The bound of σ².
    pub squared: Rational,
    /// The two parameters, approximately or exactly.
    pub at: [Rational; 2],
}

/// The curve, exactly and in floats.
#[derive(Clone, Copy)]
pub struct Bounds<'c> {
    /// The exact chain.
    pub chain: &'c Chain,
    /// The same in floats.
    pub floats: &'c FloatChain,
    /// The statement's convention.
    pub convention: Convention,
}

impl Bounds<'_> {
    pub(super) fn global(&self, location: Location) -> Option<Rational> {
        let s = integer(location.0) + Rational::from_f64(location.1)?;
        Some(self.normal(s))
    }

    /// M is written 0 on a closed curve.
    pub(super) fn normal(&self, s: Rational) -> Rational {
        if self.chain.closed && s >= integer(self.chain.count()) {
            s - integer(self.chain.count())
        } else {
            s
        }
    }

    pub(super) fn local(&self, s: &Rational) -> Location {
        let piece = s.numer().div_floor(s.denom()).to_u64().unwrap_or(0) as usize;
        let piece = piece.min(self.chain.count() - 1);
        (piece, (s - integer(piece)).to_f64())
    }

    /// Evidence near a candidate, with a bound within the relative width of its length.
    pub fn prove(&self, candidate: &Candidate, relative_width: &Rational) -> Option<UpperBound> {
        self.rational_root(candidate)
            .or_else(|| self.critical_interval(candidate, relative_width))
            .or_else(|| self.miranda(candidate, relative_width))
    }

    pub(super) fn jacobian(&self, s: Location, t: Location) -> [[f64; 2]; 2] {
        let ([p, p1, p2], [q, q1, q2]) = (self.floats.evaluate(s.0, s.1), self.floats.evaluate(t.0, t.1));
        let x = sub(&p, &q);
        [
            [dot(&p1, &p1) + dot(&x, &p2), -dot(&p1, &q1)],
            [dot(&p1, &q1), dot(&x, &q2) - dot(&q1, &q1)],
        ]
    }

    /// |c'|/|D| at a location.
    pub(super) fn field_scale(&self, location: Location) -> f64 {
        let piece = &self.floats.pieces[location.0];
        if !piece.rational {
            return piece.degree as f64;
        }
        // c' = D/w², with the weight in the floats' own scale of homogeneous coordinates; compare lengths instead.
        let [_, derivative, _] = self.floats.evaluate(location.0, location.1);
        let Some(here) = Rational::from_f64(location.1).and_then(|local| {
            point::<Integer>(
                self.chain,
                &crate::check::section::Location {
                    piece: location.0,
                    local,
                },
            )
        }) else {
            return 1.0;
        };
        let field = here
            .field
            .each_ref()
            .map(|x| super::float_chain::quotient(x, here.field_scale.doubled(0)));
        let length = (field[0] * field[0] + field[1] * field[1] + field[2] * field[2]).sqrt();
        dot(&derivative, &derivative).sqrt() / length
    }

    pub(super) fn any_side(&self, s: &Rational) -> Side {
        if locate(self.chain, s, Side::After).is_some() {
            Side::After
        } else {
            Side::Before
        }
    }

    /// An integer vector along the tangent in the middle of an interval.
    pub(super) fn direction(&self, interval: &Interval) -> [Integer; 3] {
        let middle = self.normal((&interval.start + &interval.end) / integer(2));
        let (piece, u) = self.local(&middle);
        let [_, derivative, _] = self.floats.evaluate(piece, u);
        quantised(&derivative, 6).map(Integer::from)
    }
}
