//! The claim `motion`: a curve and the polygon of its control points while they move (FORMAT §14).
//!
//! With degrees, knots and weights fixed, every obligation reads n·(linear function of the own control points) > 0. One that holds at two times holds at all times
//! between, where the points are convex combinations of those at the two; and nothing else than the leaves of the trees is needed for the curve to be embedded, and
//! for the motion to be an isotopy. So leaves are looked at, at the times at which they must hold, and nothing is sampled.

mod contact;
mod criteria;
mod greatest;
mod nu;
mod obligation;
mod parts;
mod positions;
mod replay;
mod runs;
mod shape;
mod table;

use super::{Place, Reason, Rejection};
use crate::claim::motion::{
    Content, Criteria as Stated, EventSource, FirstFailures, MAX_STEPS, Statement, Track, TrackKind,
};
use crate::curve::Curve;
use crate::number::Rational;

pub use contact::{Stage, curve_at, polygon};
pub use criteria::{Criteria, Greatests, bound_factor, note};
pub use nu::{MOST_EDGES, nu_squared};
pub use positions::{MotionError, Positions};
pub use shape::{Matrix, Node, PartRows, Piece, Shape};
pub use table::{Moved, Table, TreeError};

pub(super) fn expected(place: Place, expected: &'static str, found: impl Into<String>) -> Rejection {
    let found = found.into();
    Rejection {
        place,
        reason: Reason::Expected { expected, found },
    }
}

fn in_statement(what: &'static str, found: impl Into<String>) -> Rejection {
    expected(Place::Statement, what, found)
}

/// Checks statement and evidence about a moving curve, and the events; returns the number of leaves that were looked at when they came.
///
/// # Errors
/// The first place where the certificate is found wanting.
pub fn check_motion<S: EventSource>(curve: &Curve, content: &Content, events: &mut S) -> Result<u64, Rejection> {
    consistent(content)?;
    let statement = &content.statement;
    let point_piece = |piece| Rejection {
        place: Place::Curve,
        reason: Reason::PointPiece { piece },
    };
    super::chain::Chain::new(curve).map_err(point_piece)?;
    let start = Positions::new(curve, &statement.denominator).map_err(|error| Rejection {
        place: Place::Statement,
        reason: Reason::Motion(error),
    })?;
    let wants_polygon =
        statement.polygon.is_some() || statement.criteria.as_ref().is_some_and(|all| all.half_nu.is_some());
    let polygon = match wants_polygon {
        true => Some(polygon(curve).ok_or_else(|| in_statement("a polygon of at most 4,000,000 edges", "more"))?),
        false => None,
    };
    let mut criteria = None;
    if let Some(stated) = &statement.criteria {
        let measures = Criteria::new(&mut Shape::new(curve), &start, &statement.denominator);
        let measures =
            measures.ok_or_else(|| in_statement("criteria only of polynomial pieces", "a rational piece"))?;
        if let (Some(half_nu), Some(polygon)) = (&stated.half_nu, &polygon) {
            let found = nu_squared(&Shape::new(polygon), &start, &statement.denominator);
            let found = found.ok_or_else(|| {
                in_statement(
                    "ν of a polygon of at most 4,096 edges, some vertex apart from some edge",
                    "none",
                )
            })?;
            if found != half_nu.nu_squared {
                return Err(in_statement(
                    "criteria.half_nu.nu_squared: the square of ν",
                    half_nu.nu_squared.to_string(),
                ));
            }
        }
        criteria = Some(measures);
    }
    let (leaves, found) = replay::replay(curve, polygon.as_ref(), content, start, criteria, events)?;
    if let (Some(stated), Some(found)) = (&statement.criteria, found) {
        compare(stated, &found)?;
    }
    Ok(leaves)
}

/// The first failures found: of second differences, of half ν.
pub(super) type Found = [FirstFailures; 2];

fn compare(stated: &Stated, found: &Found) -> Result<(), Rejection> {
    let words = |failures: &FirstFailures| {
        let word = |first: Option<u64>| first.map_or("null".to_string(), |first| first.to_string());
        format!(
            "infinity {}, euclidean {}",
            word(failures.infinity),
            word(failures.euclidean)
        )
    };
    if stated.second_differences != found[0] {
        let found = format!("{} (they are {})", words(&stated.second_differences), words(&found[0]));
        return Err(in_statement("criteria.second_differences: the first failures", found));
    }
    match &stated.half_nu {
        Some(half_nu) if half_nu.failures != found[1] => {
            let found = format!("{} (they are {})", words(&half_nu.failures), words(&found[1]));
            Err(in_statement("criteria.half_nu: the first failures", found))
        }
        _ => Ok(()),
    }
}

/// The number of the last frame at a time or before it.
pub(super) fn frame_before(time: &Rational) -> Option<u64> {
    time.numer().div_floor(time.denom()).to_u64()
}

/// What the statement says must be possible, and contacts there when and only when it names a meeting.
fn consistent(content: &Content) -> Result<(), Rejection> {
    let Statement {
        steps,
        denominator,
        criteria,
        ..
    } = &content.statement;
    if *steps > MAX_STEPS {
        return Err(in_statement("at most 100,000,000 steps", steps.to_string()));
    }
    if !denominator.is_positive() {
        return Err(in_statement("a denominator of at least 1", denominator.to_string()));
    }
    if criteria
        .as_ref()
        .is_some_and(|criteria| !criteria.display_tolerance.numer().is_positive())
    {
        return Err(in_statement("criteria.display_tolerance: a fraction above 0", "none"));
    }
    let end = Rational::from_integer((*steps).into());
    for kind in TrackKind::BOTH {
        let contact = match kind {
            TrackKind::Curve => &content.evidence.curve_contact,
            TrackKind::Polygon => &content.evidence.polygon_contact,
        };
        let Track {
            embedded_through,
            meets_by,
        } = match content.statement.track(kind) {
            Some(track) => track,
            None if contact.is_some() => {
                return Err(expected(
                    Place::Evidence,
                    "a contact only of a track of the statement",
                    kind.name(),
                ));
            }
            None => continue,
        };
        if embedded_through.numer().is_negative() || *embedded_through > end {
            return Err(in_statement(
                "embedded_through: a time from 0 to the number of steps",
                embedded_through.to_string(),
            ));
        }
        if meets_by.is_some() != contact.is_some() {
            return Err(expected(
                Place::Evidence,
                "a contact when and only when there is a meets_by",
                kind.name(),
            ));
        }
        let Some(by) = meets_by else { continue };
        let frame = Rational::from_integer(embedded_through.numer().div_floor(embedded_through.denom()));
        if by <= embedded_through || *by > end || *by > frame + Rational::from_integer(1.into()) {
            return Err(in_statement(
                "meets_by: a time after embedded_through, not after the frame that follows it",
                by.to_string(),
            ));
        }
    }
    Ok(())
}
