//! Mutants of certificates of moving polygons: what is still accepted must be true at every 64th part of a step, and where it says that the curve meets itself, it must do so.

use std::collections::BTreeSet;
use std::io::Cursor;

use knotproof::certificate::{MotionHash, read};
use knotproof::check::{Verdict, check};
use knotproof::claim::motion::{Event, EventSource, FirstFailures, Statement};
use knotproof::claim::tree::{Token, TokenSource};
use knotproof::curve::{Curve, Form};
use knotproof::number::Rational;
use serde_json::json;

use super::mutated_bytes;
use crate::common::document::Certificate;
use crate::common::python;
use crate::subjects;
use crate::values::{other_values, pointers};

type Point = Vec<Rational>;

/// How many times a step is looked at.
const TIMES: i64 = 64;

/// A motion read without the checker: the vertices of a polygon at every frame.
struct Motion {
    statement: Statement,
    frames: Vec<Vec<Point>>,
    closed: bool,
    hash: String,
}

fn vertices(curve: &Curve) -> Option<Vec<Point>> {
    let Form::Bezier(pieces) = curve.form() else {
        return None;
    };
    if pieces.iter().any(|piece| piece.degree() != 1) {
        return None;
    }
    let mut vertices = vec![pieces[0].point(0)];
    vertices.extend(pieces.iter().map(|piece| piece.point(1)));
    Some(vertices)
}

fn motion(bytes: &[u8]) -> Option<Motion> {
    let (document, mut events) = read(Cursor::new(bytes)).ok()?;
    let statement = document.claim.motion()?.statement.clone();
    let mut vertices = vertices(&document.curve)?;
    let closed = document.curve.is_closed();
    if closed {
        vertices.pop();
    }
    let mut hash = MotionHash::new(&document.curve, &statement.denominator);
    let mut frames = vec![vertices.clone()];
    loop {
        let event = match events.next_event() {
            Ok(Some(event)) => event,
            Ok(None) => break,
            Err(_) => return None,
        };
        if let Event::Step(displacements) | Event::Begin(displacements) = &event {
            hash.include(displacements);
            for (point, by) in displacements.iter() {
                for (x, by) in vertices.get_mut(usize::try_from(point).ok()?)?.iter_mut().zip(by) {
                    *x = &*x + Rational::new(by, statement.denominator.clone());
                }
            }
            frames.push(vertices.clone());
        }
        // In the binary form tokens stand between events: here they are read as far as a tree goes.
        let mut pairs = u64::from(matches!(event, Event::Tree(_) | Event::Edit(..)));
        while pairs > 0 {
            pairs = match events.next_token().ok()? {
                None => break,
                Some(Token::Split) => pairs + 2,
                Some(Token::First | Token::Second) => pairs + 1,
                Some(Token::Leaf(_)) => pairs - 1,
            };
        }
    }
    let hash = hash.finish();
    Some(Motion {
        statement,
        frames,
        closed,
        hash,
    })
}

fn minus(p: &Point, q: &Point) -> Point {
    p.iter().zip(q).map(|(x, y)| x - y).collect()
}

fn cross(v: &Point, w: &Point) -> Rational {
    &v[0] * &w[1] - &v[1] * &w[0]
}

fn dot(v: &Point, w: &Point) -> Rational {
    v.iter().zip(w).fold(Rational::default(), |sum, (x, y)| sum + x * y)
}

fn is_zero(x: &Rational) -> bool {
    x.numer().is_zero()
}

fn positive(x: &Rational) -> bool {
    x.numer().is_positive()
}

/// Is p on the segment from a to b?
fn on(p: &Point, a: &Point, b: &Point) -> bool {
    is_zero(&cross(&minus(b, a), &minus(p, a))) && !positive(&dot(&minus(p, a), &minus(p, b)))
}

/// Do two segments in the plane have a common point?
fn meet([a, b]: [&Point; 2], [c, d]: [&Point; 2]) -> bool {
    let opposite =
        |x: &Rational, y: &Rational| positive(x) && y.numer().is_negative() || positive(y) && x.numer().is_negative();
    let side = |p: &Point, q: &Point, r: &Point| cross(&minus(q, p), &minus(r, p));
    on(a, c, d)
        || on(b, c, d)
        || on(c, a, b)
        || on(d, a, b)
        || opposite(&side(a, b, c), &side(a, b, d)) && opposite(&side(c, d, a), &side(c, d, b))
}

/// Does a planar polygon pass twice through a point?
fn meets_itself(vertices: &[Point], closed: bool) -> bool {
    let count = vertices.len();
    let edges = if closed { count } else { count - 1 };
    let edge = |i: usize| [&vertices[i], &vertices[(i + 1) % count]];
    (0..edges).any(|i| edge(i)[0] == edge(i)[1])
        || (0..edges).any(|i| {
            (i + 1..edges).any(|j| match (j == i + 1, closed && (j + 1) % count == i) {
                (false, false) => meet(edge(i), edge(j)),
                // Neighbours meet in more than their vertex when one lies back on the other.
                (next, _) => {
                    let (before, after) = if next { (edge(i), edge(j)) } else { (edge(j), edge(i)) };
                    on(after[1], before[0], before[1]) || on(before[0], after[0], after[1])
                }
            })
        })
}

impl Motion {
    fn at(&self, time: &Rational) -> Vec<Point> {
        let frame = time.numer().div_floor(time.denom()).to_u64().expect("a time from 0") as usize;
        let fraction = time - Rational::from_integer((frame as i64).into());
        let next = &self.frames[(frame + 1).min(self.frames.len() - 1)];
        let between = |(p, q): (&Point, &Point)| p.iter().zip(q).map(|(x, y)| x + (y - x) * &fraction).collect();
        self.frames[frame].iter().zip(next).map(between).collect()
    }

    fn times(&self) -> impl Iterator<Item = Rational> + '_ {
        let last = (self.frames.len() as i64 - 1) * TIMES;
        (0..=last).map(|i| Rational::new(i.into(), TIMES.into()))
    }

    fn is_true(&self) -> bool {
        let Statement {
            steps,
            motion_sha256,
            curve,
            polygon,
            criteria,
            ..
        } = &self.statement;
        if self.frames.len() as u64 != steps + 1 || self.hash != *motion_sha256 {
            return false;
        }
        let tracks = [curve, polygon].into_iter().flatten().all(|track| {
            let through = &track.embedded_through;
            let mut before = self.times().filter(|time| time <= through);
            let embedded = before.all(|time| !meets_itself(&self.at(&time), self.closed));
            let meets = track.meets_by.as_ref().is_none_or(|by| {
                let mut between = self.times().filter(|time| time > through && time <= by);
                between.any(|time| meets_itself(&self.at(&time), self.closed))
            });
            embedded && meets
        });
        let criteria = criteria.as_ref().is_none_or(|criteria| {
            let found = self.first_failures(&criteria.display_tolerance);
            criteria.second_differences == found && criteria.half_nu.is_none()
        });
        tracks && criteria
    }

    /// Of straight pieces all second differences are zero.
    fn first_failures(&self, tolerance: &Rational) -> FirstFailures {
        let moved = |frame: &Vec<Point>, norm: fn(&Point) -> Rational| {
            let each = frame.iter().zip(&self.frames[0]).map(|(p, q)| norm(&minus(p, q)));
            each.max().unwrap_or_default()
        };
        let greatest: fn(&Point) -> Rational = |v| v.iter().map(|x| x.max(&-x).clone()).max().unwrap_or_default();
        let square: fn(&Point) -> Rational = |v| dot(v, v);
        let first = |fails: &dyn Fn(&Vec<Point>) -> bool| self.frames.iter().position(fails).map(|frame| frame as u64);
        FirstFailures {
            infinity: first(&|frame| moved(frame, greatest) >= *tolerance),
            euclidean: first(&|frame| moved(frame, square) >= tolerance * tolerance),
        }
    }
}

struct Mutants {
    name: String,
    accepted: Vec<Vec<u8>>,
    rejected: Vec<Vec<u8>>,
}

impl Mutants {
    fn judge(&mut self, bytes: Vec<u8>, what: &str) {
        match check(bytes.as_slice()) {
            Verdict::Accepted { document, .. } => {
                // Of curves that are no polygons nothing is known here.
                let unknown = vertices(&document.curve).is_none();
                let found = unknown || motion(&bytes).is_some_and(|motion| motion.is_true());
                assert!(
                    found,
                    "{}: {what} is accepted and false: {:?}",
                    self.name, document.claim
                );
                self.accepted.push(bytes);
            }
            Verdict::Malformed(_) | Verdict::Rejected { .. } => self.rejected.push(bytes),
        }
    }

    fn agree(self, sample: usize) {
        let few = self.rejected.iter().step_by(sample).map(Vec::as_slice);
        let all: Vec<&[u8]> = self.accepted.iter().map(Vec::as_slice).chain(few).collect();
        for (i, answer) in python::check_bytes(&all).into_iter().enumerate() {
            let text = String::from_utf8_lossy(all[i]);
            assert_eq!(
                answer.accepted,
                i < self.accepted.len(),
                "{}: {}\n{text}",
                self.name,
                answer.reason
            );
        }
        assert!(
            self.rejected.len() > self.accepted.len(),
            "{}: too many are accepted",
            self.name
        );
    }
}

fn hand_made(name: &str) -> Certificate {
    let cases = subjects::motion::cases();
    let case = cases
        .iter()
        .find(|case| case.accepted() && case.name == name)
        .expect("an accepted case");
    Certificate::of_bytes(&case.bytes)
}

fn mutate(certificate: &Certificate, mutants: &mut Mutants) {
    let mut places = Vec::new();
    pointers(&certificate.0, "", &mut places);
    for pointer in places {
        let value = certificate.0.pointer(&pointer).expect("there");
        for other in other_values(value) {
            let what = format!("{pointer}: {}", other.to_string().chars().take(80).collect::<String>());
            let mutant = certificate.clone().with(&pointer, other);
            let moves = ["/curve/", "/evidence/events", "/statement/denominator"];
            if moves.iter().any(|place| pointer.starts_with(place)) {
                mutants.judge(mutant.clone().rehashed().moved().json(), &what);
            }
            mutants.judge(mutant.json(), &what);
        }
    }
}

fn run(name: &str, certificate: &Certificate) {
    let mut mutants = Mutants {
        name: name.into(),
        accepted: Vec::new(),
        rejected: Vec::new(),
    };
    mutants.judge(certificate.json(), "the certificate itself");
    assert_eq!(mutants.accepted.len(), 1, "{name}");
    mutate(certificate, &mut mutants);
    mutants.agree(40);
}

#[test]
fn moving_polygons() {
    let criteria = json!({
        "display_tolerance": "3/2", "second_differences": { "infinity": 2, "euclidean": 2 }, "half_nu": null
    });
    for name in ["both-tracks", "edited", "halfway", "touch", "crossing", "square"] {
        let certificate = hand_made(name);
        let certificate = match name {
            "both-tracks" => certificate.with("/statement/criteria", criteria.clone()),
            _ => certificate,
        };
        run(name, &certificate);
    }
}

#[test]
fn bytes_of_moving_polygons() {
    for name in ["halfway", "touch"] {
        let mut mutants = Mutants {
            name: format!("bytes of {name}"),
            accepted: Vec::new(),
            rejected: Vec::new(),
        };
        let bytes = hand_made(name).binary();
        mutants.judge(bytes.clone(), "the certificate itself");
        mutated_bytes(&bytes, &mut |mutant, what| mutants.judge(mutant, what));
        mutants.agree(60);
    }
}

#[test]
fn the_truth_about_polygons() {
    let point = |x: i64, y: i64| vec![Rational::from_integer(x.into()), Rational::from_integer(y.into())];
    let line = [point(0, 0), point(4, 0), point(4, 3)];
    let with = |last: Point| [&line[..], &[last]].concat();
    let seen: BTreeSet<(bool, bool)> = [point(0, 3), point(0, 0), point(1, -1), point(4, 1), point(6, 2)]
        .map(|last| {
            (
                meets_itself(&with(last.clone()), false),
                meets_itself(&with(last), true),
            )
        })
        .into();
    assert_eq!(seen, [(false, false), (false, true), (true, true)].into());
}
