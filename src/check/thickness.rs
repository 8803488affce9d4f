//! The claim `thickness`: the bounds that follow from those of σ and of the greatest curvature (FORMAT §12, proofs in docs/thickness.md).

use super::chain::Chain;
use super::curvature::check_curvature;
use super::rule::Failure;
use super::{Place, Reason, Rejection, check_msd, no_tokens};
use crate::claim::msd::{Convention, Lower};
use crate::claim::thickness::{Content, Evidence, Statement};
use crate::claim::tree::TokenSource;
use crate::claim::{curvature, msd};
use crate::curve::Curve;
use crate::number::{Integer, Rational};

/// Checks statement and evidence about a curve, and the tree's tokens; returns the number of leaves.
///
/// Sound because τ² = min(1/κ_max², σ²/4) grows with σ and falls with κ_max.
///
/// # Errors
/// The obligation that does not hold.
pub fn check_thickness<S: TokenSource>(curve: &Curve, content: &Content, tokens: &mut S) -> Result<u64, Rejection> {
    let statement = &content.statement;
    consistent(statement)?;
    let chain = Chain::new(curve).map_err(|piece| Rejection {
        place: Place::Curve,
        reason: Reason::PointPiece { piece },
    })?;
    if !chain.closed && statement.convention == Convention::Smooth {
        return refuse("the convention \"critical\" for an open curve", "\"smooth\"".into());
    }
    match &content.evidence {
        Evidence::Corner { joint } => {
            corner(&chain, *joint, &statement.lower_squared)?;
            no_tokens(tokens).map(|()| 0)
        }
        Evidence::Bounds { msd, curvature } => {
            smooth(&chain)?;
            follows(statement, msd, curvature)?;
            drop(chain);
            check_curvature(curve, curvature)?;
            check_msd(curve, msd, tokens)
        }
    }
}

fn refuse<T>(expected: &'static str, found: String) -> Result<T, Rejection> {
    Err(Rejection {
        place: Place::Evidence,
        reason: Reason::Obligation {
            rule: "thickness",
            failure: Failure { expected, found },
        },
    })
}

fn consistent(statement: &Statement) -> Result<(), Rejection> {
    let reversed = match (&statement.lower_squared, &statement.upper_squared) {
        (_, None) => false,
        (Lower::Infinite, Some(_)) => true,
        (Lower::Finite(lower), Some(upper)) => lower > upper,
    };
    match reversed {
        true => Err(Rejection {
            place: Place::Statement,
            reason: Reason::Reversed,
        }),
        false => Ok(()),
    }
}

/// The joints of a chain, with the pieces on both sides.
fn joints(chain: &Chain) -> impl Iterator<Item = (usize, usize)> + '_ {
    let count = chain.pieces.len();
    (usize::from(!chain.closed)..count).map(move |joint| ((joint + count - 1) % count, joint))
}

fn corner(chain: &Chain, joint: usize, lower_squared: &Lower) -> Result<(), Rejection> {
    let found = joints(chain).any(|(before, after)| after == joint && !chain.smooth_joint(before, after));
    if !found {
        return refuse("a joint that is a corner", format!("joint {joint}"));
    }
    match lower_squared {
        Lower::Finite(lower) if lower.numer().is_zero() => Ok(()),
        _ => refuse("lower_squared 0 of a curve with a corner", "another".into()),
    }
}

fn smooth(chain: &Chain) -> Result<(), Rejection> {
    match joints(chain).find(|(before, after)| !chain.smooth_joint(*before, *after)) {
        Some((_, joint)) => refuse("no corner", format!("joint {joint}")),
        None => Ok(()),
    }
}

/// The bounds of τ² follow from those of σ² and κ².
fn follows(statement: &Statement, msd: &msd::Content, curvature: &curvature::Content) -> Result<(), Rejection> {
    if msd.statement.convention != statement.convention {
        return refuse(
            "bounds of σ in the convention of the statement",
            "those of another".into(),
        );
    }
    let one = Rational::from_integer(Integer::ONE);
    let four = Rational::from_integer(Integer::from(4));
    let (sigma, kappa) = (&msd.statement, &curvature.statement);
    let lower_follows = match (&statement.lower_squared, &sigma.lower_squared) {
        (Lower::Finite(lower), _) if lower.numer().is_zero() => true,
        (Lower::Finite(lower), least) => {
            let chords = match least {
                Lower::Infinite => true,
                Lower::Finite(least) => lower * &four <= *least,
            };
            chords && lower * &kappa.upper_squared <= one
        }
        (Lower::Infinite, Lower::Infinite) => kappa.upper_squared.numer().is_zero(),
        (Lower::Infinite, Lower::Finite(_)) => false,
    };
    if !lower_follows {
        return refuse(
            "a lower_squared at most 1/κ² and σ²/4 by the bounds in the evidence",
            "a greater one".into(),
        );
    }
    let upper_follows = statement.upper_squared.as_ref().is_none_or(|upper| {
        let chord = sigma.upper_squared.as_ref().is_some_and(|most| upper * &four >= *most);
        chord || upper * &kappa.lower_squared >= one
    });
    match upper_follows {
        true => Ok(()),
        false => refuse(
            "an upper_squared at least 1/κ² or σ²/4 by the bounds in the evidence",
            "a smaller one".into(),
        ),
    }
}
