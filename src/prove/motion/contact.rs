//! Proofs that a moving curve, or polygon, meets itself.

use super::geometry::{Geometry, Snapshot, difference, evaluate};
use super::search::Stuck;
use crate::check::motion::{Shape, Stage, curve_at};
use crate::claim::motion::Contact;
use crate::claim::msd::{Interval, Upper};
use crate::number::{Integer, Rational, RationalExt, approximate, simplest_between};
use crate::prove::embedding::{self, Outcome};
use crate::prove::vector::{Vector, add, dot, scale, sub};

/// What is left of a step when it cannot be gone through: fractions of it.
pub struct Rest<'r> {
    /// Up to here the curve is embedded.
    pub from: Rational,
    /// Up to here not every leaf could be refined.
    pub to: Rational,
    /// Where the search came to an end.
    pub stuck: &'r Stuck,
    /// Is a meeting known, and one sooner looked for?
    pub sooner: bool,
}

/// Looks for a contact in the rest of a step, after `rest.from`.
pub fn find(stage: &Stage, rest: &Rest) -> Option<Contact> {
    let frame = Rational::from_integer(stage.frame.into());
    let after = &frame + &rest.from;
    let by = &frame + Rational::from_integer(1.into());
    let holds = |contact: &Contact| matches!(stage.shows(contact, &after, &by), Ok(Ok(())));
    let found = if stage.curve.dimension() == 2 {
        at_one_time(stage, rest)
    } else {
        passing(stage, rest, &holds).or_else(|| at_one_time(stage, rest))
    };
    found.filter(|contact| holds(contact))
}

/// Times at which the whole curve is looked at.
fn times(rest: &Rest) -> Vec<Rational> {
    let one = Rational::from_integer(1.into());
    let two = Rational::from_integer(2.into());
    let mut times = vec![one.clone()];
    let simple = simplest_between(&rest.from, &rest.to);
    let mut part = &one - &rest.from;
    for _ in 0..7 {
        part /= &two;
        times.push(&rest.from + &part);
    }
    times.extend([simple, rest.to.clone()]);
    times.retain(|time| *time > rest.from && *time <= one);
    if rest.sooner {
        times.sort();
    }
    let mut kept: Vec<Rational> = Vec::new();
    for time in times {
        if !kept.contains(&time) {
            kept.push(time);
        }
    }
    kept
}

/// How many leaves the search of the curve at one time may have, beside 64 for each piece.
const LEAVES: u64 = 10_000;

/// A contact at one of some times, found by a search of the whole curve there.
fn at_one_time(stage: &Stage, rest: &Rest) -> Option<Contact> {
    times(rest).into_iter().find_map(|fraction| {
        let positions = stage
            .positions
            .on_the_way(stage.displacements, fraction.numer(), fraction.denom())
            .ok()?;
        let denominator = stage.denominator * fraction.denom();
        let curve = curve_at(stage.curve, stage.shape, &positions, &denominator)?;
        let time = Rational::from_integer(stage.frame.into()) + fraction;
        let count = curve.chain().count();
        if curve.is_closed() && !stage.shape.closed {
            return Some(Contact::Touch {
                time,
                s: Rational::default(),
                t: Rational::from_integer(count.into()),
            });
        }
        let options = embedding::Options {
            budget: Some(LEAVES + 64 * count as u64),
            ..embedding::Options::default()
        };
        let found = embedding::certify(&curve, &options, &|_| ()).ok()?;
        let Outcome::MeetsItself(certified) = found else {
            return None;
        };
        match certified.document.claim.evidence.upper {
            Some(Upper::Touch { s, t }) => Some(Contact::Touch { time, s, t }),
            Some(Upper::Crossing { s, t, first, second }) => Some(Contact::Crossing {
                time,
                s,
                t,
                first,
                second,
            }),
            _ => None,
        }
    })
}

/// A common point of two parts of the curve in space and time, approximately: pieces, local parameters, fraction of the step.
#[derive(Clone, Copy, Debug)]
struct Root {
    s: (usize, f64),
    t: (usize, f64),
    time: f64,
    /// The inverse of the derivative of c_u(s) − c_u(t) by s, t and u.
    inverse: [[f64; 3]; 3],
}

/// One part of the curve passes through another in space.
fn passing(stage: &Stage, rest: &Rest, holds: &dyn Fn(&Contact) -> bool) -> Option<Contact> {
    let Stuck::Pair {
        s, t, adjacent: false, ..
    } = *rest.stuck
    else {
        return None;
    };
    let ends = [
        stage.positions.clone(),
        stage
            .positions
            .on_the_way(stage.displacements, &Integer::ONE, &Integer::ONE)
            .ok()?,
    ];
    let snapshots = ends
        .each_ref()
        .map(|positions| Snapshot::new(positions, stage.denominator, 0));
    // The two snapshots are about their own first points: what lies between these is added.
    let shift = difference(&ends[1].get(0), &ends[0].get(0), stage.denominator);
    let mut shape = Shape::new(stage.curve);
    let mut geometry = Geometry::new(&mut shape, &snapshots);
    let (from, to) = (rest.from.to_f64(), rest.to.to_f64());
    for start in [(from + to) / 2.0, to, from] {
        let Some(root) = newton(&mut geometry, &shift, s, t, start) else {
            continue;
        };
        if root.time < from - 1e-9 || root.time > 1.0 + 1e-9 {
            continue;
        }
        if let Some(contact) = exact(stage, &root, holds).or_else(|| boxed(stage, &root, &rest.from, holds)) {
            return Some(contact);
        }
    }
    None
}

/// Newton's method for c_u(s) = c_u(t) in s, t and u.
fn newton(geometry: &mut Geometry, shift: &Vector, s: (usize, f64), t: (usize, f64), time: f64) -> Option<Root> {
    let (mut s, mut t, mut u) = (s, t, time);
    for step in 0..40 {
        let mut at = |(piece, local): (usize, f64)| {
            let pieces = geometry.piece(piece);
            let [(p, p1), (q, q1)] = [evaluate(&pieces[0], local), evaluate(&pieces[1], local)];
            let velocity = add(&sub(&q, &p), shift);
            let point = add(&p, &scale(&velocity, u));
            (point, add(&p1, &scale(&sub(&q1, &p1), u)), velocity)
        };
        let ((p, p1, pv), (q, q1, qv)) = (at(s), at(t));
        let residual = sub(&p, &q);
        let columns = [p1, scale(&q1, -1.0), sub(&pv, &qv)];
        let inverse = inverse(&columns)?;
        let correction = inverse.map(|row| row[0] * residual[0] + row[1] * residual[1] + row[2] * residual[2]);
        if correction.iter().any(|x| !x.is_finite()) {
            return None;
        }
        let size = correction.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        // Half a piece or step at a time at most.
        let damping = if size > 0.5 { 0.5 / size } else { 1.0 };
        s = moved(geometry, s, s.1 - damping * correction[0]);
        t = moved(geometry, t, t.1 - damping * correction[1]);
        u = (u - damping * correction[2]).clamp(-0.5, 1.5);
        if size < 1e-13 || step == 39 && size < 1e-9 {
            return (s != t).then_some(Root { s, t, time: u, inverse });
        }
    }
    None
}

/// The place at a local parameter of a piece, on a neighbouring piece if it is outside.
fn moved(geometry: &Geometry, (piece, _): (usize, f64), local: f64) -> (usize, f64) {
    let count = geometry.shape.pieces.len();
    let closed = geometry.shape.closed;
    if local < 0.0 && (piece > 0 || closed) {
        ((piece + count - 1) % count, (local + 1.0).clamp(0.0, 1.0))
    } else if local > 1.0 && (piece + 1 < count || closed) {
        ((piece + 1) % count, (local - 1.0).clamp(0.0, 1.0))
    } else {
        (piece, local.clamp(0.0, 1.0))
    }
}

/// The inverse of a matrix given by its columns.
fn inverse([a, b, c]: &[Vector; 3]) -> Option<[[f64; 3]; 3]> {
    let cross = |p: &Vector, q: &Vector| {
        [
            p[1] * q[2] - p[2] * q[1],
            p[2] * q[0] - p[0] * q[2],
            p[0] * q[1] - p[1] * q[0],
            0.0,
        ]
    };
    let rows = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, &rows[0]);
    (determinant != 0.0 && determinant.is_finite()).then(|| rows.map(|row| [0, 1, 2].map(|i| row[i] / determinant)))
}

/// The exact point, where parameters and time are simple fractions.
fn exact(stage: &Stage, root: &Root, holds: &dyn Fn(&Contact) -> bool) -> Option<Contact> {
    let simple = |x: f64| approximate(x, 4096).filter(|near| (near.to_f64() - x).abs() < 1e-9);
    let place =
        |(piece, local): (usize, f64)| Some(normal(stage, Rational::from_integer(piece.into()) + simple(local)?));
    let (s, t) = (place(root.s)?, place(root.t)?);
    let (s, t) = if s <= t { (s, t) } else { (t, s) };
    let time = Rational::from_integer(stage.frame.into()) + simple(root.time)?;
    let contact = Contact::Touch { time, s, t };
    holds(&contact).then_some(contact)
}

/// M is 0 on a closed curve.
fn normal(stage: &Stage, s: Rational) -> Rational {
    let count = Rational::from_integer(stage.shape.pieces.len().into());
    if stage.shape.closed && s >= count { s - count } else { s }
}

/// Bits of the vectors.
const BITS: u32 = 40;

/// A box in s, t and u around the root on whose faces the signs are as `passage` asks: the vectors are the rows of the inverse derivative.
fn boxed(stage: &Stage, root: &Root, from: &Rational, holds: &dyn Fn(&Contact) -> bool) -> Option<Contact> {
    let count = Rational::from_integer(stage.shape.pieces.len().into());
    let global = |(piece, local): (usize, f64)| Some(Rational::from_integer(piece.into()) + Rational::from_f64(local)?);
    let (mut s, mut t, mut inverse) = (global(root.s)?, global(root.t)?, root.inverse);
    if s > t {
        // c(s) − c(t) changes its sign with the order; so do the rows, and the first two change places.
        std::mem::swap(&mut s, &mut t);
        inverse.swap(0, 1);
        inverse = inverse.map(|row| row.map(|x| -x));
    }
    let vectors = inverse.map(|row| {
        let most = row.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        row.map(|x| {
            let scaled = (x / most * 2f64.powi(BITS as i32)).round();
            Rational::from_f64(scaled).map_or(Integer::ZERO, |x| x.numer().clone())
        })
    });
    let time = Rational::from_f64(root.time)?;
    let frame = Rational::from_integer(stage.frame.into());
    let one = Rational::from_integer(1.into());
    for bits in [24u32, 30, 20, 16, 12, 36, 10] {
        for finer in [0u32, 4, 8] {
            let step = |bits: u32| Rational::new(Integer::ONE, Integer::ONE << bits);
            let around = |x: &Rational, bits: u32| {
                let middle = Rational::new(x.floor_shifted(bits + 4), Integer::ONE << (bits + 4));
                (&middle - step(bits), middle + step(bits))
            };
            let (u0, u1) = around(&time, bits + finer);
            if u0 < *from || u1 > one {
                continue;
            }
            let interval = |x: &Rational| {
                let (mut start, mut end) = around(x, bits);
                if start.numer().is_negative() && stage.shape.closed {
                    (start, end) = (start + &count, end + &count);
                }
                if !stage.shape.closed {
                    end = end.min(count.clone());
                    start = start.max(Rational::default());
                }
                Interval { start, end }
            };
            let (first, second) = (interval(&s), interval(&t));
            if first.end >= second.start {
                continue;
            }
            let contact = Contact::Passage {
                times: [&frame + u0, &frame + u1],
                s: first,
                t: second,
                vectors: vectors.clone(),
            };
            if holds(&contact) {
                return Some(contact);
            }
        }
    }
    None
}
