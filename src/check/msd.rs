//! The claim `msd`: the statement's own consistency, the tree, the upper bound (FORMAT §4).

use super::chain::Chain;
use super::cover::{Context, replay};
use super::rule::{critical, crossing, miranda, root};
use super::word::widening;
use super::{Place, Reason, Rejection};
use crate::certificate::Document;
use crate::claim::msd::{Convention, Lower, Statement, Upper};
use crate::claim::tree::TokenSource;
use crate::number::Rational;

/// The largest grid exponent.
const MAX_GRID: u32 = 100_000;

/// Checks a document and its tokens; returns the number of leaves.
pub fn check_msd<S: TokenSource>(document: &Document, tokens: &mut S) -> Result<u64, Rejection> {
    let statement = &document.statement;
    consistent(document)?;
    let chain = Chain::new(&document.curve).map_err(|piece| Rejection {
        place: Place::Curve,
        reason: Reason::PointPiece { piece },
    })?;
    if let (Some(rule), Some(upper_squared)) = (&document.evidence.upper, &statement.upper_squared) {
        upper(&chain, rule, statement.convention, upper_squared)?;
    }
    if !document.has_tree {
        return match tokens.next_token() {
            Ok(None) => Ok(0),
            _ => Err(Rejection {
                place: Place::Token { number: 0 },
                reason: Reason::TokensLeft,
            }),
        };
    }
    let context = Context::new(&chain, statement.convention, document.evidence.grid);
    replay(&context, &statement.lower_squared, tokens).map_err(|rejection| *rejection)
}

fn consistent(document: &Document) -> Result<(), Rejection> {
    let Statement {
        lower_squared,
        upper_squared,
        ..
    } = &document.statement;
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
    if zero == document.has_tree {
        return fail(Reason::TreePresence);
    }
    if upper_squared.is_some() != document.evidence.upper.is_some() {
        return fail(Reason::UpperPresence);
    }
    if document.evidence.grid > MAX_GRID {
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
                widening!(128, W => miranda::check::<W>(chain, &witness, upper_squared)),
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
