//! Frames of a motion, and where the curve or its polygon meets itself.

use super::scene::own_points;
use super::{Kind, Point, Scene, Segment, Shape};
use crate::check::motion::{Positions, Shape as Moving, curve_at};
use crate::claim::motion::{Contact, Content, Event, EventSource, Track, TrackKind};
use crate::claim::tree::{Token, TokenError};
use crate::curve::Curve;
use crate::number::RationalExt;

/// Frames that a report carries, and that a drawing shows.
const REPORTED: u64 = 200;
const DRAWN: u64 = 6;

/// A frame: the curve's pieces and its own control points.
#[derive(Clone)]
struct Frame {
    segments: Vec<Segment>,
    points: Vec<Point>,
}

impl Frame {
    fn new(curve: &Curve) -> Frame {
        Frame {
            segments: curve.chain().pieces().iter().map(Segment::new).collect(),
            points: own_points(curve),
        }
    }

    /// The place at the fraction `part` of the way to another frame.
    fn towards(&self, other: &Frame, part: f64) -> Frame {
        let between = |a: &Point, b: &Point| std::array::from_fn(|axis| (1.0 - part) * a[axis] + part * b[axis]);
        let all = |a: &[Point], b: &[Point]| a.iter().zip(b).map(|(a, b)| between(a, b)).collect();
        let segments = self.segments.iter().zip(&other.segments);
        Frame {
            segments: segments
                .map(|(a, b)| Segment {
                    points: all(&a.points, &b.points),
                    weights: a.weights.clone(),
                })
                .collect(),
            points: all(&self.points, &other.points),
        }
    }
}

impl Scene {
    /// Adds later frames, and the points where the certificate says that the curve or the polygon meets itself.
    pub(super) fn motion<S: EventSource>(&mut self, curve: &Curve, content: &Content, events: &mut S) {
        // A certificate whose events cannot be followed was not checked; the first frame is shown.
        let _ = self.follow(curve, content, events);
        let drawn: Vec<(f64, Vec<Segment>)> = {
            let stride = (self.frames.len() as u64).div_ceil(DRAWN).max(1) as usize;
            let last = self.frames.len().saturating_sub(1);
            let chosen = self
                .frames
                .iter()
                .enumerate()
                .filter(|(i, _)| (last - i).is_multiple_of(stride));
            chosen.map(|(_, frame)| frame.clone()).collect()
        };
        for (time, segments) in drawn {
            self.push(Kind::Frame, Shape::Path(segments), format!("the curve at time {time}"));
        }
    }

    fn follow<S: EventSource>(&mut self, curve: &Curve, content: &Content, events: &mut S) -> Option<()> {
        let statement = &content.statement;
        let shape = Moving::new(curve);
        let mut positions = Positions::new(curve, &statement.denominator).ok()?;
        let stride = statement.steps.div_ceil(REPORTED).max(1);
        let mut number = 0;
        let mut before = Frame::new(curve);
        let contacts = [
            (TrackKind::Curve, &content.evidence.curve_contact),
            (TrackKind::Polygon, &content.evidence.polygon_contact),
        ];
        let step_of = |track: Option<&Track>| track.map(|track| track.embedded_through.to_f64().floor() as u64);
        while let Some(event) = events.next_event().ok()? {
            let displacements = match event {
                Event::Tree(_) | Event::Edit(..) => {
                    skip_tree(events).ok()?;
                    continue;
                }
                Event::Step(displacements) | Event::Begin(displacements) => displacements,
                Event::Go { .. } | Event::End(_) => continue,
            };
            positions.apply(&displacements).ok()?;
            number += 1;
            let listed = number % stride == 0 || number == statement.steps;
            let meets = contacts.iter().filter_map(|(kind, contact)| {
                let contact = contact.as_ref()?;
                (step_of(statement.track(*kind)) == Some(number - 1)).then_some((*kind, contact))
            });
            let meets: Vec<(TrackKind, &Contact)> = meets.collect();
            // The frame before a meeting is needed too.
            let needed = listed
                || !meets.is_empty()
                || TrackKind::BOTH
                    .iter()
                    .any(|kind| step_of(statement.track(*kind)) == Some(number));
            if !needed {
                continue;
            }
            let after = Frame::new(&curve_at(curve, &shape, &positions, &statement.denominator)?);
            for (kind, contact) in meets {
                self.meeting(kind, contact, &before, &after, number - 1);
            }
            if listed {
                self.frames.push((number as f64, after.segments.clone()));
            }
            before = after;
        }
        Some(())
    }

    /// Marks where a contact is.
    fn meeting(&mut self, kind: TrackKind, contact: &Contact, before: &Frame, after: &Frame, step: u64) {
        let middle = |interval: &crate::claim::msd::Interval| (interval.start.to_f64() + interval.end.to_f64()) / 2.0;
        let (time, s) = match contact {
            Contact::Touch { time, s, .. } => (time.to_f64(), s.to_f64()),
            Contact::Crossing { time, s, .. } => (time.to_f64(), middle(s)),
            Contact::Passage { times, s, .. } => ((times[0].to_f64() + times[1].to_f64()) / 2.0, middle(s)),
        };
        let frame = before.towards(after, time - step as f64);
        let point = match kind {
            TrackKind::Curve => {
                let (piece, u) = self.locate(s);
                frame.segments[piece].point(u)
            }
            TrackKind::Polygon => {
                let edges = frame.points.len().saturating_sub(1).max(1);
                let s = if s > edges as f64 { s - edges as f64 } else { s };
                let edge = (s.floor() as usize).min(edges - 1);
                let part = s - edge as f64;
                let (from, to) = (frame.points[edge], frame.points[(edge + 1).min(edges)]);
                std::array::from_fn(|axis| (1.0 - part) * from[axis] + part * to[axis])
            }
        };
        let what = kind.name();
        self.push(
            Kind::Mark,
            Shape::Dots(vec![point]),
            format!("here the {what} meets itself, at time {time:.6}"),
        );
    }
}

/// Passes over the tokens of one tree, which is complete when every pair has its leaf.
fn skip_tree<S: EventSource>(events: &mut S) -> Result<(), TokenError> {
    let mut pairs: u64 = 1;
    while pairs > 0 {
        pairs = match events.next_token()? {
            Some(Token::Split) => pairs + 2,
            Some(Token::First | Token::Second) => pairs + 1,
            Some(Token::Leaf(_)) => pairs - 1,
            None => return Err(TokenError::Truncated),
        };
    }
    Ok(())
}
