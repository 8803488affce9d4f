//! Following a curve or polygon through one step after another.

use std::io;

use super::contact::{self, Rest};
use super::geometry::{Geometry, Snapshot};
use super::search::{Search, Stuck};
use super::{Events, Followed, name};
use crate::check::motion::{Moved, Positions, Shape, Stage, Table};
use crate::claim::motion::{Contact, Event, Move, Track, TrackKind};
use crate::claim::tree::{Token, TokenError, TokenSource};
use crate::curve::Curve;
use crate::number::{Integer, Rational, RationalExt};

/// Times in a step are multiples of 2^-TICKS.
const TICKS: u32 = 30;
/// How near to a meeting that is certified the embedding is followed: 2^-NEAR of a step.
const NEAR: u32 = 12;
/// At which fractions 2^-k of a step a meeting is looked for.
const LOOKS: [u32; 5] = [0, 6, 12, 20, TICKS];
/// Leaves that one leaf may be replaced by.
const REPLACEMENTS: u64 = 4_000;
/// Leaves that may be found in one step, in vain or not, before a track is given up; beside twice those of its last whole tree.
const EFFORT: u64 = 12_000;
/// How often pieces are halved, at time 0 and in new trees.
const DEPTH: u32 = 34;

/// Tokens in memory.
struct List(std::vec::IntoIter<Token>);

impl TokenSource for List {
    fn next_token(&mut self) -> Result<Option<Token>, TokenError> {
        Ok(self.0.next())
    }
}

/// A curve or polygon that is followed.
pub struct Follower<'c> {
    kind: TrackKind,
    curve: &'c Curve,
    table: Table<'c>,
    /// The shape once more, for the search.
    shape: Shape<'c>,
    /// Leaves of the last whole tree.
    planted: usize,
    edits: u64,
    budget: u64,
    /// What positions are over.
    denominator: &'c Integer,
    /// Were all leaves found to hold when they were last looked at, at the current time?
    looked: bool,
    /// Leaves found in the present step, in vain or not.
    effort: u64,
    /// A meeting in the present step.
    contact: Option<Contact>,
    /// Where the last search came to an end, and up to what time it was to go.
    stuck: Option<(Stuck, u64)>,
}

/// A step that is gone through.
pub struct Stretch<'s> {
    /// Number of the frame before it.
    pub frame: u64,
    /// What positions are over.
    pub denominator: &'s Integer,
    /// The positions before it.
    pub positions: &'s Positions,
    /// The positions after it.
    pub next: &'s Positions,
    /// How the one become the other.
    pub displacements: &'s Move,
}

/// A time in a step, in ticks.
type Ticks = u64;
const WHOLE: Ticks = 1 << TICKS;

/// Numerator and exponent of a time, reduced.
fn reduced(at: Ticks) -> (u64, u32) {
    if at == 0 {
        return (0, 0);
    }
    let zeros = at.trailing_zeros().min(TICKS);
    (at >> zeros, TICKS - zeros)
}

fn fraction(at: Ticks) -> Rational {
    Rational::new(Integer::from(at), Integer::ONE << TICKS)
}

/// Positions with the exponent of their units.
struct Placed {
    positions: Positions,
    exponent: u32,
}

impl<'c> Follower<'c> {
    /// Plants the tree of the first frame; the inner error says why there is none.
    pub fn plant(
        kind: TrackKind,
        curve: &'c Curve,
        positions: &Positions,
        denominator: &'c Integer,
        budget: u64,
        events: &mut Events,
    ) -> io::Result<Result<Follower<'c>, String>> {
        let mut follower = Follower {
            kind,
            curve,
            table: Table::new(Shape::new(curve)),
            shape: Shape::new(curve),
            planted: 0,
            edits: 0,
            budget,
            denominator,
            looked: true,
            effort: 0,
            contact: None,
            stuck: None,
        };
        let tokens = match follower.tree(positions) {
            Ok(tokens) => tokens,
            Err(stuck) => return Ok(Err(follower.describe(&stuck))),
        };
        if let Err(error) = follower.table.plant(positions, &mut List(tokens.clone().into_iter())) {
            return Ok(Err(format!(
                "{}: a leaf of its tree does not hold exactly ({}; {})",
                name(kind),
                error.a,
                error.b
            )));
        }
        follower.planted = follower.table.count();
        events.push(&Event::Tree(kind), &tokens)?;
        Ok(Ok(follower))
    }

    fn tree(&mut self, positions: &Positions) -> Result<Vec<Token>, Stuck> {
        let snapshots = [Snapshot::new(positions, self.denominator, 0)];
        let whole = self.shape.whole();
        let mut geometry = Geometry::new(&mut self.shape, &snapshots);
        let mut search = Search {
            geometry: &mut geometry,
            max_depth: DEPTH,
            budget: self.budget,
            tokens: Vec::new(),
        };
        search.cover(whole, None)?;
        Ok(search.tokens)
    }

    /// Plants a new tree when the table has grown to twice the size of the last one.
    pub fn replant_if_grown(&mut self, positions: &Positions, events: &mut Events) -> io::Result<()> {
        if self.table.count() < 2 * self.planted + 64 {
            return Ok(());
        }
        // Not to be tried again soon if it fails.
        self.planted = self.table.count();
        let Ok(tokens) = self.tree(positions) else {
            return Ok(());
        };
        let mut table = Table::new(Shape::new(self.curve));
        if table.plant(positions, &mut List(tokens.clone().into_iter())).is_err() || table.count() >= self.table.count()
        {
            return Ok(());
        }
        self.table = table;
        self.planted = self.table.count();
        self.looked = true;
        events.push(&Event::Tree(self.kind), &tokens)
    }

    /// It came to the end of the motion.
    pub fn arrived(&self, steps: u64) -> Followed {
        Followed {
            kind: self.kind,
            track: Some(Track {
                embedded_through: Rational::from_integer(steps.into()),
                meets_by: None,
            }),
            contact: None,
            undecided: None,
            leaves: self.table.count() as u64,
            edits: self.edits,
        }
    }

    fn describe(&self, stuck: &Stuck) -> String {
        let it = name(self.kind);
        let at = |(piece, local): (usize, f64)| format!("piece {piece} at {local:.9}");
        match stuck {
            Stuck::Budget => format!("{it}: the budget of leaves ran out"),
            Stuck::Pair { s, adjacent: true, .. } => {
                format!("{it}: the derivative vanishes, or it turns back, at about {}", at(*s))
            }
            Stuck::Pair { s, t, .. } => {
                let (s, t) = (at(*s), at(*t));
                format!("{it}: points at about {s} and {t} could not be told from one point")
            }
        }
    }

    /// Do all leaves hold at the next frame, without a change?
    fn keeps(&mut self, step: &Stretch) -> bool {
        let moved = match self.looked {
            true => Moved::By(step.displacements),
            false => Moved::All,
        };
        let keeps = self.table.check(step.next, moved).is_none();
        self.looked = keeps;
        keeps
    }

    /// Makes the leaves hold at the time `to` as well as at the time `from`, at which all hold.
    fn reach(
        &mut self,
        from: &Placed,
        to: &Placed,
        depth: u32,
        events: &mut Events,
    ) -> io::Result<Result<(), Failure>> {
        let failing = self.table.failing(&to.positions, Moved::All);
        if failing.is_empty() {
            return Ok(Ok(()));
        }
        // New leaves are put in at the time before.
        if self.table.check(&from.positions, Moved::All).is_some() {
            return Ok(Err(Failure::Inexact));
        }
        let snapshots = [from, to].map(|placed| Snapshot::new(&placed.positions, self.denominator, placed.exponent));
        let mut geometry = Geometry::new(&mut self.shape, &snapshots);
        for leaf in failing {
            let Some((a, b, _)) = self.table.leaf(leaf) else {
                continue;
            };
            let mut search = Search {
                geometry: &mut geometry,
                max_depth: depth,
                budget: REPLACEMENTS,
                tokens: Vec::new(),
            };
            let outcome = search.cover(a, b);
            self.effort += REPLACEMENTS - search.budget;
            if let Err(stuck) = outcome {
                return Ok(Err(Failure::Stuck(stuck)));
            }
            let tokens = search.tokens;
            match self
                .table
                .replace(&from.positions, leaf, &mut List(tokens.clone().into_iter()))
            {
                Some(Ok(_)) => {}
                _ => return Ok(Err(Failure::Inexact)),
            }
            self.edits += 1;
            events.push(&Event::Edit(self.kind, leaf), &tokens)?;
        }
        Ok(match self.table.check(&to.positions, Moved::All) {
            None => Ok(()),
            Some(_) => Err(Failure::Inexact),
        })
    }
}

/// The time by which a contact shows a meeting.
fn end_of(contact: &Contact) -> &Rational {
    match contact {
        Contact::Touch { time, .. } | Contact::Crossing { time, .. } => time,
        Contact::Passage { times, .. } => &times[1],
    }
}

/// Why a time was not reached.
enum Failure {
    /// A pair that nothing excludes at both times.
    Stuck(Stuck),
    /// A leaf found in binary64 does not hold exactly.
    Inexact,
}

impl Stretch<'_> {
    /// Goes through the step; returns what became of those that were lost on the way, who are no longer active.
    pub fn go(&self, active: &mut Vec<Follower>, events: &mut Events) -> io::Result<Vec<Followed>> {
        let mut kept = true;
        for follower in active.iter_mut() {
            if !follower.keeps(self) {
                kept = false;
                break;
            }
        }
        if kept {
            events.push(&Event::Step(self.displacements.clone()), &[])?;
            return Ok(Vec::new());
        }
        self.go_slowly(active, events)
    }

    fn at(&self, at: Ticks) -> Placed {
        let (numerator, exponent) = reduced(at);
        let positions = match at {
            0 => self.positions.clone(),
            WHOLE => self.next.clone(),
            _ => self
                .positions
                .between(self.displacements, numerator, exponent)
                .unwrap_or_else(|_| self.next.clone()),
        };
        Placed { positions, exponent }
    }

    fn go_slowly(&self, active: &mut Vec<Follower>, events: &mut Events) -> io::Result<Vec<Followed>> {
        let mut lost = Vec::new();
        let mut begun = false;
        let (mut at, mut width) = (0, 0u32);
        let mut here = self.at(0);
        for follower in active.iter_mut() {
            follower.contact = None;
            follower.stuck = None;
            follower.effort = 0;
        }
        while at < WHOLE {
            let to = (at + (WHOLE >> width)).min(WHOLE);
            // A meeting that is certified is not gone beyond, and no more than nearly reached.
            let mut too_far = false;
            let mut i = 0;
            while i < active.len() {
                if !active[i]
                    .contact
                    .as_ref()
                    .is_some_and(|contact| self.is_beyond(to, contact))
                {
                    i += 1;
                } else if width >= NEAR {
                    lost.push(self.lose(active.remove(i), at, events)?);
                    width = 0;
                } else {
                    too_far = true;
                    i += 1;
                }
            }
            if too_far {
                width += 1;
                continue;
            }
            let to = (at + (WHOLE >> width)).min(WHOLE);
            let there = self.at(to);
            let mut failed = Vec::new();
            for (i, follower) in active.iter_mut().enumerate() {
                let depth = (14 + 2 * width).min(DEPTH);
                match follower.reach(&here, &there, depth, events)? {
                    Ok(()) => follower.stuck = None,
                    Err(Failure::Stuck(stuck)) => {
                        follower.stuck = Some((stuck, to));
                        failed.push((i, false));
                    }
                    Err(Failure::Inexact) => failed.push((i, true)),
                }
            }
            if failed.is_empty() {
                if to == WHOLE && !begun {
                    events.push(&Event::Step(self.displacements.clone()), &[])?;
                } else {
                    if !begun {
                        events.push(&Event::Begin(self.displacements.clone()), &[])?;
                        begun = true;
                    }
                    let (numerator, exponent) = reduced(to);
                    events.push(&Event::Go { numerator, exponent }, &[])?;
                }
                (at, here) = (to, there);
                width = width.saturating_sub(1);
                continue;
            }
            let mut given_up = false;
            for (i, inexact) in failed.into_iter().rev() {
                let follower = &mut active[i];
                let exhausted = width >= TICKS || follower.effort > EFFORT + 2 * follower.planted as u64;
                if follower.contact.is_none() && (exhausted || LOOKS.contains(&width)) && !inexact {
                    follower.contact = self.look_for_contact(follower, at, false);
                }
                if inexact || exhausted || follower.contact.is_some() && width >= NEAR {
                    lost.push(self.lose(active.remove(i), at, events)?);
                    given_up = true;
                }
            }
            width = if given_up { 0 } else { width + 1 };
        }
        active.iter_mut().for_each(|follower| follower.looked = true);
        Ok(lost)
    }

    fn look_for_contact(&self, follower: &Follower, at: Ticks, sooner: bool) -> Option<Contact> {
        let (stuck, to) = follower.stuck.as_ref()?;
        let stage = Stage {
            curve: follower.curve,
            shape: &follower.shape,
            positions: self.positions,
            displacements: self.displacements,
            denominator: self.denominator,
            frame: self.frame,
        };
        let rest = Rest {
            from: fraction(at),
            to: fraction(*to),
            stuck,
            sooner,
        };
        contact::find(&stage, &rest)
    }

    /// May the embedding be proved up to this time without a contradiction to the contact?
    fn is_beyond(&self, to: Ticks, contact: &Contact) -> bool {
        let time = Rational::from_integer(self.frame.into()) + fraction(to);
        match contact {
            Contact::Touch { time: at, .. } | Contact::Crossing { time: at, .. } => time >= *at,
            Contact::Passage { times, .. } => time > times[0],
        }
    }

    /// Gives a track up at a time.
    fn lose(&self, mut follower: Follower, at: Ticks, events: &mut Events) -> io::Result<Followed> {
        events.push(&Event::End(follower.kind), &[])?;
        let embedded_through = Rational::from_integer(self.frame.into()) + fraction(at);
        if follower.contact.is_some()
            && let Some(sooner) = self.look_for_contact(&follower, at, true)
            && follower
                .contact
                .as_ref()
                .is_some_and(|known| end_of(&sooner) < end_of(known))
        {
            follower.contact = Some(sooner);
        }
        let meets_by = follower.contact.as_ref().map(|contact| end_of(contact).clone());
        let undecided = match (&meets_by, &follower.stuck) {
            (Some(_), _) => None,
            (None, stuck) => {
                let why = match stuck {
                    Some((stuck, _)) => follower.describe(stuck),
                    None => format!("{}: binary64 is not fine enough for it", name(follower.kind)),
                };
                Some(format!("after time {:.9} {why}", embedded_through.to_f64()))
            }
        };
        Ok(Followed {
            kind: follower.kind,
            track: Some(Track {
                embedded_through,
                meets_by,
            }),
            contact: follower.contact,
            undecided,
            leaves: follower.table.count() as u64,
            edits: follower.edits,
        })
    }
}
