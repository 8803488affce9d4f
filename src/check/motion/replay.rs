//! The events of a motion, one after another (FORMAT §14).

use super::contact::Stage;
use super::criteria::{Criteria, note};
use super::positions::{MotionError, Positions};
use super::shape::Shape;
use super::table::{Moved, Table, TreeError};
use super::{Found, expected, frame_before};
use crate::certificate::MotionHash;
use crate::check::{Place, Reason, Rejection};
use crate::claim::motion::{Content, Event, EventSource, Move, Track, TrackKind};
use crate::curve::Curve;
use crate::number::{Integer, Rational};

/// One of the two tracks, of which the statement says something.
struct Followed<'c> {
    kind: TrackKind,
    stated: &'c Track,
    curve: &'c Curve,
    table: Table<'c>,
    state: State,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// No tree yet.
    Awaited,
    Present,
    Ended,
}

/// A move that has begun.
struct Begun {
    displacements: Move,
    /// How much of it is done, numerator/2^exponent.
    numerator: u64,
    exponent: u32,
    /// The positions there, unless nothing is done yet.
    between: Option<Positions>,
}

struct Replay<'c, S> {
    content: &'c Content,
    events: &'c mut S,
    tracks: Vec<Followed<'c>>,
    /// Closed B-splines and their polygons may not open; chains of Bézier pieces cannot.
    may_open: bool,
    positions: Positions,
    frame: u64,
    begun: Option<Begun>,
    hash: MotionHash,
    criteria: Option<(Criteria, Shape<'c>)>,
    found: Found,
    number: u64,
    leaves: u64,
}

/// Replays all events; returns the number of leaves and the first failures of the criteria.
pub fn replay<'c, S: EventSource>(
    curve: &'c Curve,
    polygon: Option<&'c Curve>,
    content: &'c Content,
    start: Positions,
    criteria: Option<Criteria>,
    events: &'c mut S,
) -> Result<(u64, Option<Found>), Rejection> {
    let statement = &content.statement;
    let mut tracks = Vec::new();
    for kind in TrackKind::BOTH {
        let about = match kind {
            TrackKind::Curve => Some(curve),
            TrackKind::Polygon => polygon,
        };
        if let (Some(stated), Some(curve)) = (statement.track(kind), about) {
            tracks.push(Followed {
                kind,
                stated,
                curve,
                table: Table::new(Shape::new(curve)),
                state: State::Awaited,
            });
        }
    }
    let mut replay = Replay {
        content,
        events,
        tracks,
        may_open: matches!(curve.form(), crate::curve::Form::BSpline(_)),
        positions: start,
        frame: 0,
        begun: None,
        hash: MotionHash::new(curve, &statement.denominator),
        criteria: criteria.map(|criteria| (criteria, Shape::new(curve))),
        found: Found::default(),
        number: 0,
        leaves: 0,
    };
    let mut closing = (replay.may_open && curve.is_closed()).then(|| Shape::new(curve));
    replay.judge_frame();
    while let Some(event) = replay.next()? {
        replay.event(event, &mut closing)?;
        replay.number += 1;
    }
    replay.finish()
}

impl<'c, S: EventSource> Replay<'c, S> {
    fn next(&mut self) -> Result<Option<Event>, Rejection> {
        self.events.next_event().map_err(|error| Rejection {
            place: self.place(),
            reason: Reason::Token(error.to_string()),
        })
    }

    fn place(&self) -> Place {
        Place::Event { number: self.number }
    }

    fn fails<T>(&self, what: &'static str, found: impl Into<String>) -> Result<T, Rejection> {
        Err(expected(self.place(), what, found))
    }

    fn motion(&self, error: MotionError) -> Rejection {
        Rejection {
            place: self.place(),
            reason: Reason::Motion(error),
        }
    }

    fn time(&self) -> Rational {
        let frame = Rational::from_integer(self.frame.into());
        match &self.begun {
            None => frame,
            Some(begun) => frame + Rational::new(begun.numerator.into(), Integer::ONE << begun.exponent),
        }
    }

    fn event(&mut self, event: Event, closing: &mut Option<Shape>) -> Result<(), Rejection> {
        match event {
            Event::Tree(kind) => self.tree(kind),
            Event::Edit(kind, leaf) => self.edit(kind, leaf),
            Event::End(kind) => self.end(kind),
            Event::Step(displacements) => {
                self.announce(&displacements)?;
                self.arrive(&displacements, true, closing)
            }
            Event::Begin(displacements) => {
                self.announce(&displacements)?;
                self.begun = Some(Begun {
                    displacements,
                    numerator: 0,
                    exponent: 0,
                    between: None,
                });
                Ok(())
            }
            Event::Go { numerator, exponent } => self.go(numerator, exponent, closing),
        }
    }

    /// The track of an event, by its place in the list.
    fn track(&self, kind: TrackKind) -> Result<usize, Rejection> {
        match self.tracks.iter().position(|track| track.kind == kind) {
            Some(track) => Ok(track),
            None => self.fails("an event about a track of the statement", kind.name()),
        }
    }

    fn tree(&mut self, kind: TrackKind) -> Result<(), Rejection> {
        let track = self.track(kind)?;
        let at_start = self.time().numer().is_zero();
        match self.tracks[track].state {
            State::Ended => return self.fails("no tree of a track that has ended", kind.name()),
            State::Awaited if !at_start => return self.fails("the first tree of a track at time 0", "a later time"),
            _ => {}
        }
        let positions = current(&self.begun, &self.positions);
        let followed = &mut self.tracks[track];
        let planted = followed.table.plant(positions, self.events);
        followed.state = State::Present;
        self.leaves += followed.table.count() as u64;
        self.grown(kind, planted)
    }

    fn edit(&mut self, kind: TrackKind, leaf: u64) -> Result<(), Rejection> {
        let track = self.track(kind)?;
        if self.tracks[track].state != State::Present {
            return self.fails("an edit of a track with a tree", kind.name());
        }
        let positions = current(&self.begun, &self.positions);
        let followed = &mut self.tracks[track];
        let before = followed.table.next_number();
        let replaced = followed.table.replace(positions, leaf, self.events);
        self.leaves += followed.table.next_number() - before;
        match replaced {
            Some(replaced) => self.grown(kind, replaced),
            None => self.fails("a leaf of the table", leaf.to_string()),
        }
    }

    /// What a tree or an edit came to.
    fn grown(&self, kind: TrackKind, grown: Result<u64, TreeError>) -> Result<(), Rejection> {
        if let Err(error) = grown {
            let place = Place::EventPair {
                number: self.number,
                track: kind.name(),
                token: error.token,
                nodes: Box::new([error.a.to_string(), error.b.to_string()]),
            };
            return Err(Rejection {
                place,
                reason: *error.reason,
            });
        }
        if self.events.tokens_left() {
            return Err(Rejection {
                place: self.place(),
                reason: Reason::TokensLeft,
            });
        }
        Ok(())
    }

    fn end(&mut self, kind: TrackKind) -> Result<(), Rejection> {
        let track = self.track(kind)?;
        if self.tracks[track].state != State::Present {
            return self.fails("an end of a track with a tree", kind.name());
        }
        let time = self.time();
        if self.tracks[track].stated.embedded_through != time {
            let found = format!("{} at time {time}", self.tracks[track].stated.embedded_through);
            return self.fails("the end of a track at embedded_through", found);
        }
        self.tracks[track].state = State::Ended;
        Ok(())
    }

    /// A move is to come: it is counted, hashed, and contacts on the way are looked at.
    fn announce(&mut self, displacements: &Move) -> Result<(), Rejection> {
        if self.begun.is_some() {
            return self.fails("the rest of the move that has begun", "another move");
        }
        if self.frame >= self.content.statement.steps {
            return self.fails("no more moves than steps of the statement", "another move");
        }
        let count = self.positions.count();
        if let Some(point) = displacements.last_point().filter(|last| *last >= count as u64) {
            return Err(self.motion(MotionError::Point { point, count }));
        }
        self.hash.include(displacements);
        for track in &mut self.tracks {
            let contact = match track.kind {
                TrackKind::Curve => &self.content.evidence.curve_contact,
                TrackKind::Polygon => &self.content.evidence.polygon_contact,
            };
            let (Some(contact), Some(by)) = (contact, &track.stated.meets_by) else {
                continue;
            };
            let after = &track.stated.embedded_through;
            if frame_before(after) != Some(self.frame) {
                continue;
            }
            let stage = Stage {
                curve: track.curve,
                shape: track.table.shape(),
                positions: &self.positions,
                displacements,
                denominator: &self.content.statement.denominator,
                frame: self.frame,
            };
            let rule = contact.rule();
            let place = Place::Contact {
                track: track.kind.name(),
            };
            let outcome = stage.shows(contact, after, by).map_err(|error| Rejection {
                place: place.clone(),
                reason: Reason::Motion(error),
            })?;
            outcome.map_err(|failure| Rejection {
                place,
                reason: Reason::Obligation { rule, failure },
            })?;
        }
        Ok(())
    }

    fn go(&mut self, numerator: u64, exponent: u32, closing: &mut Option<Shape>) -> Result<(), Rejection> {
        let reduced = if exponent == 0 {
            numerator == 1
        } else {
            numerator % 2 == 1
        };
        if !reduced || exponent > 60 || numerator > 1 << exponent {
            return self.fails(
                "a reduced dyadic fraction above 0 and at most 1",
                format!("{numerator}/2^{exponent}"),
            );
        }
        let Some(mut begun) = self.begun.take() else {
            return self.fails("a move that has begun", "none");
        };
        let fraction = |numerator: u64, exponent: u32| Rational::new(numerator.into(), Integer::ONE << exponent);
        if fraction(numerator, exponent) <= fraction(begun.numerator, begun.exponent) {
            return self.fails(
                "a time after the one before",
                format!("{numerator}/2^{exponent} of the move"),
            );
        }
        if exponent == 0 {
            // Nothing was looked at elsewhere if nothing of the move is done.
            let whole = begun.between.is_none();
            return self.arrive(&begun.displacements, whole, closing);
        }
        let between = self.positions.between(&begun.displacements, numerator, exponent);
        let between = between.map_err(|error| self.motion(error))?;
        (begun.numerator, begun.exponent) = (numerator, exponent);
        begun.between = Some(between);
        self.begun = Some(begun);
        self.look(Moved::All)
    }

    /// The next frame is reached.
    fn arrive(&mut self, displacements: &Move, whole: bool, closing: &mut Option<Shape>) -> Result<(), Rejection> {
        let applied = self.positions.apply(displacements);
        applied.map_err(|error| self.motion(error))?;
        self.frame += 1;
        self.stays_closed(closing)?;
        if let Some((criteria, shape)) = &mut self.criteria {
            criteria.update(shape, &self.positions, displacements);
        }
        self.judge_frame();
        self.look(if whole { Moved::By(displacements) } else { Moved::All })
    }

    fn stays_closed(&mut self, closing: &mut Option<Shape>) -> Result<(), Rejection> {
        if !self.may_open {
            return Ok(());
        }
        let mut closed = closing
            .as_mut()
            .map_or(Ok(()), |shape| shape.stays_closed(&self.positions));
        if let Some(polygon) = self.tracks.iter_mut().find(|track| track.kind == TrackKind::Polygon) {
            closed = closed.and_then(|()| polygon.table.shape().stays_closed(&self.positions));
        }
        closed.map_err(|error| self.motion(error))
    }

    /// All leaves must hold at the current time.
    fn look(&mut self, moved: Moved) -> Result<(), Rejection> {
        let positions = current(&self.begun, &self.positions);
        for track in self.tracks.iter_mut().filter(|track| track.state == State::Present) {
            let Some(number) = track.table.check(positions, moved) else {
                continue;
            };
            let place = Place::EventLeaf {
                number: self.number,
                track: track.kind.name(),
                leaf: number,
            };
            let failure = track.table.leaf(number).and_then(|(a, b, leaf)| {
                let failure = track.table.obligation(positions, &a, b.as_ref(), &leaf).err()?;
                let rule = leaf.rule();
                Some(Reason::Obligation { rule, failure })
            });
            // A leaf fails only by an obligation.
            let reason = failure.unwrap_or_else(|| Reason::Expected {
                expected: "a leaf that holds",
                found: "one that does not".into(),
            });
            return Err(Rejection { place, reason });
        }
        Ok(())
    }

    fn judge_frame(&mut self) {
        let (Some((criteria, _)), Some(stated)) = (&self.criteria, &self.content.statement.criteria) else {
            return;
        };
        let done = |first: &crate::claim::motion::FirstFailures| first.infinity.is_some() && first.euclidean.is_some();
        if done(&self.found[0]) && (done(&self.found[1]) || stated.half_nu.is_none()) {
            return;
        }
        let greatest = criteria.greatest();
        note(
            &mut self.found[0],
            greatest.reach(&stated.display_tolerance),
            self.frame,
        );
        if let Some(half_nu) = &stated.half_nu {
            note(&mut self.found[1], greatest.reach_half(&half_nu.nu_squared), self.frame);
        }
    }

    fn finish(self) -> Result<(u64, Option<Found>), Rejection> {
        let statement = &self.content.statement;
        if self.begun.is_some() || self.frame != statement.steps {
            let found = format!("{} moves gone through of {}", self.frame, statement.steps);
            return self.fails("events until the last frame", found);
        }
        for track in &self.tracks {
            match track.state {
                State::Awaited => return self.fails("a tree for every track of the statement", "none"),
                State::Present if track.stated.embedded_through != self.time() => {
                    return self.fails("a track that ends at embedded_through", track.kind.name());
                }
                _ => {}
            }
        }
        let actual = self.hash.finish();
        if statement.motion_sha256 != actual {
            let found = format!(
                "{} (the motion's hash is {actual})",
                statement.motion_sha256.chars().take(64).collect::<String>()
            );
            return Err(expected(
                Place::Statement,
                "motion_sha256: the hash of the motion",
                found,
            ));
        }
        let found = self.criteria.is_some().then_some(self.found);
        Ok((self.leaves, found))
    }
}

/// The positions at the current time.
fn current<'p>(begun: &'p Option<Begun>, positions: &'p Positions) -> &'p Positions {
    begun
        .as_ref()
        .and_then(|begun| begun.between.as_ref())
        .unwrap_or(positions)
}
