//! The claim `msd`: the statement's own consistency, the tree, the upper bound (FORMAT §4).

use super::chain::Chain;
use super::cover::{Context, replay};
use super::rule::{critical, crossing, miranda, root};
use super::word::widening;
use super::{Place, Reason, Rejection, no_tokens};
use crate::claim::msd::{Content, Convention, Lower, Statement, Upper};
use crate::claim::tree::TokenSource;
use crate::curve::Curve;
use crate::number::Rational;

/// The largest grid exponent.
pub const MAX_GRID: u32 = 100_000;

/// Checks statement and evidence about a curve, and the tree's tokens; returns the number of leaves.
pub fn check_msd<S: TokenSource>(curve: &Curve, content: &Content, tokens: &mut S) -> Result<u64, Rejection> {
    let statement = &content.statement;
    consistent(content)?;
    let chain = Chain::new(curve).map_err(|piece| Rejection {
        place: Place::Curve,
        reason: Reason::PointPiece { piece },
    })?;
    if let (Some(rule), Some(upper_squared)) = (&content.evidence.upper, &statement.upper_squared) {
        upper(&chain, rule, statement.convention, upper_squared)?;
    }
    if !content.has_tree {
        return no_tokens(tokens).map(|()| 0);
    }
    let context = Context::new(&chain, statement.convention, content.evidence.grid);
    let lower = &statement.lower_squared;
    replay(&context, |a, b, leaf| context.obligation(a, b, leaf, lower), tokens).map_err(|rejection| *rejection)
}

fn consistent(content: &Content) -> Result<(), Rejection> {
    let Statement {
        lower_squared,
        upper_squared,
        ..
    } = &content.statement;
    let fail = |reason| {
        Err(Rejection {
            place: Place::Statement,
            reason,
        })
    };
    match (lower_squared, upper_squared) {
        (Lower::Infinite, Some(_)) => return fail(Reason::Reversed),
        (Lower::Finite(lower), Some(upper)) if lower > upper => return fail(Reason::Reversed),
        _ => {}
    }
    let zero = matches!(lower_squared, Lower::Finite(lower) if lower.numer().is_zero());
    if zero == content.has_tree {
        return fail(Reason::TreePresence);
    }
    if upper_squared.is_some() != content.evidence.upper.is_some() {
        return fail(Reason::UpperPresence);
    }
    if content.evidence.grid > MAX_GRID {
        return fail(Reason::Grid);
    }
    Ok(())
}

fn upper(chain: &Chain, rule: &Upper, convention: Convention, upper_squared: &Rational) -> Result<(), Rejection> {
    let (name, outcome) = match rule {
        Upper::Miranda {
            s,
            t,
            first,
            second,
            regular,
            subdivisions,
        } => {
            let witness = miranda::Witness {
                s,
                t,
                first,
                second,
                regular,
                subdivisions: *subdivisions,
            };
            (
                "miranda",
                widening!(128, W => miranda::check::<W>(chain, &witness, convention, upper_squared)),
            )
        }
        Upper::Root { s, t } => ("root", root::check(chain, s, t, upper_squared)),
        Upper::Touch { s, t } => ("touch", root::check_touch(chain, s, t)),
        Upper::Crossing { s, t, first, second } => (
            "crossing",
            widening!(64, W => crossing::check::<W>(chain, s, t, first, second)),
        ),
        Upper::CriticalRoot { s, t } => ("critical_root", critical::check_root(chain, s, t, upper_squared)),
        Upper::CriticalInterval { s, t, regular } => (
            "critical_interval",
            widening!(64, W => critical::check_interval::<W>(chain, s, t, regular, upper_squared)),
        ),
    };
    let place = Place::Upper { rule: name };
    if matches!(rule, Upper::CriticalRoot { .. } | Upper::CriticalInterval { .. }) && convention != Convention::Critical
    {
        return Err(Rejection {
            place,
            reason: Reason::WrongConvention,
        });
    }
    outcome.map_err(|failure| Rejection {
        place,
        reason: Reason::Obligation { rule: name, failure },
    })
}
