//! The claim `curvature`: the greatest curvature lies in an interval (FORMAT §11, proofs in docs/curvature.md).

mod field;

pub use field::Field;

use super::chain::Chain;
use super::polynomial::NotShown;
use super::rule::Failure;
use super::{Place, Reason, Rejection};
use crate::claim::curvature::{Content, Evidence, Statement};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt};

/// Checks statement and evidence about a curve.
///
/// Sound because κ² is the quotient that [`Field`] holds: at the witness it is computed, and on every piece `upper_squared` times
/// the denominator less the numerator is a polynomial shown to be non-negative, where the denominator is shown to be positive.
///
/// # Errors
/// The obligation that does not hold.
pub fn check_curvature(curve: &Curve, content: &Content) -> Result<(), Rejection> {
    let Statement {
        lower_squared,
        upper_squared,
    } = &content.statement;
    if lower_squared > upper_squared {
        return Err(Rejection {
            place: Place::Statement,
            reason: Reason::Reversed,
        });
    }
    let chain = Chain::new(curve).map_err(|piece| Rejection {
        place: Place::Curve,
        reason: Reason::PointPiece { piece },
    })?;
    attained(&chain, &content.evidence, lower_squared)
        .and_then(|()| (0..chain.pieces.len()).try_for_each(|piece| bounded(&chain, piece, upper_squared)))
        .map_err(|failure| Rejection {
            place: Place::Evidence,
            reason: Reason::Obligation {
                rule: "curvature",
                failure,
            },
        })
}

fn fails(expected: &'static str, found: String) -> Result<(), Failure> {
    Err(Failure { expected, found })
}

/// The squared curvature at the witness is at least `lower_squared`.
fn attained(chain: &Chain, Evidence { piece, u }: &Evidence, lower_squared: &Rational) -> Result<(), Failure> {
    let one = Rational::from_integer(Integer::ONE);
    if *piece >= chain.pieces.len() {
        return fails("a piece of the curve", format!("piece {piece}"));
    }
    if u.numer().is_negative() || *u > one {
        return fails("a local parameter from 0 to 1", u.format());
    }
    match Field::new(chain, *piece).squared_at(u) {
        None => fails("a parameter where D does not vanish", u.format()),
        Some(squared) if squared < *lower_squared => {
            fails("a squared curvature of at least lower_squared", "a smaller one".into())
        }
        Some(_) => Ok(()),
    }
}

/// A piece is regular, and its squared curvature is nowhere above `upper_squared`.
fn bounded(chain: &Chain, piece: usize, upper_squared: &Rational) -> Result<(), Failure> {
    let field = Field::new(chain, piece);
    field.show_regular().or_else(|why| {
        fails(
            "a squared length of D positive by halving",
            in_words(&why, piece, "D vanishes"),
        )
    })?;
    field.show_bound(upper_squared).or_else(|why| {
        fails(
            "a squared curvature of at most upper_squared by halving",
            in_words(&why, piece, "a greater one"),
        )
    })
}

fn in_words(why: &NotShown, piece: usize, what: &str) -> String {
    match why {
        NotShown::At { numerator, halvings } => {
            let u = Rational::new(Integer::from(*numerator), Integer::ONE << *halvings as u32);
            format!("{what} at {} of piece {piece}", u.format())
        }
        NotShown::Limits => format!("no end of halving on piece {piece}"),
    }
}
