//! The search for a cover tree: subtrees in binary64, with an exact fallback near its limits, in a fixed order.

use super::exact;
use super::leaf::{self, Target};
use super::newton::{self, Candidate};
use super::node::{Kind, Node, Nodes};
use super::vector::{dot, sub};
use crate::check::element::{Element, Node as ExactNode};
use crate::claim::msd::Lower;
use crate::claim::tree::{Leaf, Token, write_token};

/// How two different nodes meet.
#[derive(Clone, Copy, Debug, Default)]
pub struct Contact {
    /// The end of the first is the start of the second.
    pub forward: bool,
    /// The first starts at 0, the second ends at M, and the curve is closed.
    pub backward: bool,
}

impl Contact {
    fn any(self) -> bool {
        self.forward || self.backward
    }

    /// The contacts of (A₁, B) and (A₂, B).
    pub fn of_first_halves(self, left: &Node, right: &Node) -> (Contact, Contact) {
        let left_contact = Contact {
            forward: self.forward && right.is_point(),
            backward: self.backward,
        };
        let right_contact = Contact {
            forward: self.forward,
            backward: self.backward && left.is_point(),
        };
        (left_contact, right_contact)
    }

    /// The contacts of (A, B₁) and (A, B₂).
    pub fn of_second_halves(self, left: &Node, right: &Node) -> (Contact, Contact) {
        let left_contact = Contact {
            forward: self.forward,
            backward: self.backward && right.is_point(),
        };
        let right_contact = Contact {
            forward: self.forward && left.is_point(),
            backward: self.backward,
        };
        (left_contact, right_contact)
    }
}

/// Why a search did not complete its tree.
#[derive(Clone, Debug)]
pub enum Event {
    /// There is a double normal shorter than the bound asked for.
    Shorter(Candidate),
    /// A pair that no rule excludes, however small.
    Stuck(Stuck),
    /// More leaves than allowed.
    Budget,
}

/// A pair that no rule excludes at the greatest depth.
#[derive(Clone, Debug)]
pub struct Stuck {
    /// Piece and local parameter in the first node.
    pub s: (usize, f64),
    /// The same for the second node; equal to `s` for a node with itself.
    pub t: (usize, f64),
    /// The distance between the two nodes' middles.
    pub distance: f64,
    /// Do the two nodes meet, or are they one?
    pub adjacent: bool,
}

/// What the leaves are to exclude.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aim {
    /// Double normals shorter than the lower bound.
    DoubleNormals,
    /// Common points of different parameters.
    CommonPoints,
}

/// What is searched for.
#[derive(Clone, Debug)]
pub struct Goal {
    /// What the leaves are to exclude.
    pub aim: Aim,
    /// The lower bound to be proved.
    pub lower: Lower,
    /// √ of it, rounded up; infinite for `Lower::Infinite`.
    pub length: f64,
    /// How far σ may be above that length.
    pub slack: f64,
    /// How often a piece may be halved.
    pub max_depth: u32,
    /// How many leaves are allowed.
    pub budget: u64,
    /// Cover only pairs that meet: is the curve regular?
    pub diagonal: bool,
}

/// A search under way.
pub struct Search<'n, 's> {
    /// The nodes.
    pub nodes: &'n mut Nodes<'s>,
    goal: &'n Goal,
    /// The tokens found, in their binary spelling.
    pub tokens: Vec<u8>,
    /// Leaves among them.
    pub leaves: u64,
    /// Pairs given to exact arithmetic, which are dear.
    exact_attempts: u64,
}

impl<'n, 's> Search<'n, 's> {
    /// A search with no tokens yet.
    pub fn new(nodes: &'n mut Nodes<'s>, goal: &'n Goal) -> Self {
        Search {
            nodes,
            goal,
            tokens: Vec::new(),
            leaves: 0,
            exact_attempts: 0,
        }
    }

    fn emit(&mut self, token: &Token) {
        write_token(token, self.nodes.context.chain.dimension, &mut self.tokens);
    }

    fn emit_leaf(&mut self, leaf: Leaf) -> Result<(), Event> {
        self.leaves += 1;
        if self.leaves > self.goal.budget {
            return Err(Event::Budget);
        }
        self.emit(&Token::Leaf(leaf));
        Ok(())
    }

    /// A leaf for the pair, found in binary64.
    pub fn quick_leaf(&self, a: &Node, b: Option<&Node>, contact: Contact) -> Option<Leaf> {
        if self.goal.aim == Aim::CommonPoints {
            return match b {
                Some(b) if !contact.any() => leaf::separate(self.nodes, a, b),
                b => leaf::monotone(self.nodes, a, b),
            };
        }
        let Some(b) = b else {
            return leaf::cone(self.nodes, a, None).or_else(|| leaf::bend(self.nodes, a, None, bend_signs(a, a)));
        };
        if contact.any() {
            return leaf::cone(self.nodes, a, Some(b)).or_else(|| leaf::bend(self.nodes, a, Some(b), bend_signs(a, b)));
        }
        leaf::far(
            self.nodes,
            a,
            b,
            Target {
                length: self.goal.length,
            },
        )
        .or_else(|| leaf::not_normal(self.nodes, a, b))
    }

    /// Covers the pair (A, B), or (A, A) when `b` is `None`.
    pub fn pair(&mut self, a: &Node, b: Option<&Node>, contact: Contact) -> Result<(), Event> {
        if b.is_none() && a.is_point() || self.goal.diagonal && b.is_some() && !contact.any() {
            return Ok(());
        }
        if let Some(leaf) = self.quick_leaf(a, b, contact) {
            return self.emit_leaf(leaf);
        }
        let second = b.unwrap_or(a);
        if !a.is_run() && !second.is_run() {
            let borderline = self.goal.length.is_finite()
                && b.is_some_and(|b| {
                    !contact.any()
                        && leaf::far_within_errors(
                            self.nodes,
                            a,
                            b,
                            Target {
                                length: self.goal.length,
                            },
                            self.goal.slack,
                        )
                });
            if borderline
                && let Some(leaf) = self.exact_leaf(&self.nodes.exact(a), b.map(|b| self.nodes.exact(b)).as_ref())
            {
                return self.emit_leaf(leaf);
            }
            if self.needs_exactness(a, second) {
                let (exact_a, exact_b) = (self.nodes.exact(a), b.map(|b| self.nodes.exact(b)));
                return self.exact_pair(&exact_a, exact_b.as_ref());
            }
            if let Some(event) = self.shorter_double_normal(a, b, contact) {
                return Err(event);
            }
            if let Some(leaf) = b.filter(|_| !contact.any()).and_then(|b| self.pedal(a, b)) {
                return self.emit_leaf(leaf);
            }
            if a.depth().max(second.depth()) >= self.goal.max_depth {
                return Err(self.stuck(a, b, contact));
            }
        }
        let mark = self.nodes.mark();
        let outcome = self.split(a, b, contact);
        self.nodes.release(mark);
        outcome
    }

    /// A `pedal` leaf for two parts of a planar curve that bend around one point.
    fn pedal(&self, a: &Node, b: &Node) -> Option<Leaf> {
        let context = self.nodes.context;
        let Lower::Finite(lower_squared) = &self.goal.lower else {
            return None;
        };
        if context.chain.dimension != 2 || self.goal.aim != Aim::DoubleNormals || a.is_point() || b.is_point() {
            return None;
        }
        let aim = leaf::pedal::Aim {
            lower_squared,
            length: self.goal.length,
            slack: self.goal.slack,
        };
        let estimate = leaf::pedal::estimate(self.nodes, a, b, &aim)?;
        let (a, b) = (self.nodes.exact(a), self.nodes.exact(b));
        let leaf = leaf::pedal::leaf(self.nodes, &a, &b, &estimate, &aim)?;
        context
            .obligation(&a, Some(&b), &leaf, &self.goal.lower)
            .is_ok()
            .then_some(leaf)
    }

    fn split(&mut self, a: &Node, b: Option<&Node>, contact: Contact) -> Result<(), Event> {
        let mut halves = [Node::NONE; 2];
        let Some(b) = b else {
            if !self.nodes.halves(a, &mut halves) {
                return Err(self.stuck(a, None, contact));
            }
            let [left, right] = &halves;
            self.emit(&Token::Split);
            let between = Contact {
                forward: true,
                backward: self.nodes.floats.closed && self.nodes.is_whole(a),
            };
            self.pair(left, None, Contact::default())?;
            self.pair(left, Some(right), between)?;
            return self.pair(right, None, Contact::default());
        };
        let first = splits_first(a, b);
        if !self.nodes.halves(if first { a } else { b }, &mut halves) {
            return Err(self.stuck(a, Some(b), contact));
        }
        let [left, right] = &halves;
        if first {
            self.emit(&Token::First);
            let (of_left, of_right) = contact.of_first_halves(left, right);
            self.pair(left, Some(b), of_left)?;
            self.pair(right, Some(b), of_right)
        } else {
            self.emit(&Token::Second);
            let (of_left, of_right) = contact.of_second_halves(left, right);
            self.pair(a, Some(left), of_left)?;
            self.pair(a, Some(right), of_right)
        }
    }

    /// Are two nodes so small beside the errors of their coordinates, or so degenerate, that floats decide nothing?
    fn needs_exactness(&self, a: &Node, b: &Node) -> bool {
        let size = a.diagonal_squared().max(b.diagonal_squared()).sqrt();
        let tangents = |node: &Node| self.nodes.tangents(node);
        let has_zero = |node: &Node| tangents(node).iter().any(|v| dot(v, v) == 0.0);
        let vague = |node: &Node| {
            tangents(node)
                .iter()
                .all(|v| dot(v, v).sqrt() < 1e8 * node.tangent_error)
        };
        let blurred = size.is_nan() || size <= 64.0 * (a.error + b.error) && !(a.is_point() && b.is_point());
        blurred || a.is_point() && b.is_point() || vague(a) || vague(b) || has_zero(a) || has_zero(b)
    }

    /// Now and then, where all chords of a pair are shorter than the bound asked for: is there a double normal?
    fn shorter_double_normal(&self, a: &Node, b: Option<&Node>, contact: Contact) -> Option<Event> {
        let b = b?;
        let depth = a.depth() + b.depth();
        if contact.any() || depth < 4 || !depth.is_multiple_of(6) {
            return None;
        }
        let (s, t) = (a.middle()?, b.middle()?);
        let mut most = 0.0;
        for axis in 0..3 {
            let reach = (a.high[axis] - b.low[axis]).max(b.high[axis] - a.low[axis]);
            most += reach * reach;
        }
        if self.goal.length.is_finite() && most.sqrt() >= self.goal.length {
            return None;
        }
        let found = newton::double_normal(self.nodes.floats, s, t)?;
        (found.squared.sqrt() < self.goal.length * (1.0 - 1e-14)).then_some(Event::Shorter(found))
    }

    fn stuck(&self, a: &Node, b: Option<&Node>, contact: Contact) -> Event {
        let location = |node: &Node| match node.kind {
            Kind::Point(Element::Corner(joint)) => (joint, 0.0),
            Kind::Point(Element::End) => (self.nodes.context.chain.count() - 1, 1.0),
            _ => node.middle().unwrap_or((0, 0.0)),
        };
        let second = b.unwrap_or(a);
        let (s, t) = (location(a), location(second));
        let x = sub(
            &self.nodes.floats.evaluate(s.0, s.1)[0],
            &self.nodes.floats.evaluate(t.0, t.1)[0],
        );
        Event::Stuck(Stuck {
            s,
            t,
            distance: dot(&x, &x).sqrt(),
            adjacent: b.is_none() || contact.any(),
        })
    }

    /// Covers a pair in exact arithmetic.
    fn exact_pair(&mut self, a: &ExactNode<'s>, b: Option<&ExactNode<'s>>) -> Result<(), Event> {
        let context = self.nodes.context;
        if b.is_none() && a.is_point() || self.goal.diagonal && b.is_some_and(|b| !context.adjacent(a, b)) {
            return Ok(());
        }
        self.exact_attempts += 1;
        if self.exact_attempts > 50_000 + self.goal.budget / 40 {
            return Err(Event::Budget);
        }
        if let Some(leaf) = self.exact_leaf(a, b) {
            return self.emit_leaf(leaf);
        }
        let second = b.unwrap_or(a);
        let depth = |node: &ExactNode| {
            if let ExactNode::Part(part) = node {
                Some(part.depth)
            } else {
                None
            }
        };
        let first = match (depth(a), depth(second)) {
            (None, None) => return Err(self.exactly_stuck(a, b)),
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (Some(x), Some(y)) => x <= y,
        };
        let split = if first { a } else { second };
        if depth(split).unwrap_or(0) >= self.goal.max_depth {
            return Err(self.exactly_stuck(a, b));
        }
        let Some((left, right)) = context.halves(split) else {
            return Err(self.exactly_stuck(a, b));
        };
        match b {
            None => {
                self.emit(&Token::Split);
                self.exact_pair(&left, None)?;
                self.exact_pair(&left, Some(&right))?;
                self.exact_pair(&right, None)
            }
            Some(b) if first => {
                self.emit(&Token::First);
                self.exact_pair(&left, Some(b))?;
                self.exact_pair(&right, Some(b))
            }
            Some(_) => {
                self.emit(&Token::Second);
                self.exact_pair(a, Some(&left))?;
                self.exact_pair(a, Some(&right))
            }
        }
    }

    /// A leaf for the pair, found in exact arithmetic.
    fn exact_leaf(&self, a: &ExactNode<'s>, b: Option<&ExactNode<'s>>) -> Option<Leaf> {
        let context = self.nodes.context;
        if self.goal.aim == Aim::CommonPoints {
            return exact::apart(context, a, b);
        }
        let second = b.unwrap_or(a);
        let end = |node: &ExactNode, end| node.contains_end(&context.elements, end);
        let any_end = |node: &ExactNode| end(node, Element::Start) || end(node, Element::End);
        let signs = [
            [if any_end(a) { -1 } else { 0 }, if any_end(second) { -1 } else { 0 }],
            [
                if end(a, Element::Start) { 1 } else { 0 },
                if end(second, Element::End) { 1 } else { 0 },
            ],
        ];
        exact::leaf(context, a, b, &self.goal.lower, self.goal.length, signs)
    }

    fn exactly_stuck(&self, a: &ExactNode, b: Option<&ExactNode>) -> Event {
        let context = self.nodes.context;
        let location = |node: &ExactNode| match node {
            ExactNode::Part(part) => (part.piece, (part.index as f64 + 0.5) / 2f64.powi(part.depth as i32)),
            ExactNode::Point(Element::Corner(joint)) => (*joint, 0.0),
            ExactNode::Point(Element::End) => (context.chain.count() - 1, 1.0),
            _ => (0, 0.0),
        };
        let second = b.unwrap_or(a);
        let (s, t) = (location(a), location(second));
        let x = sub(
            &self.nodes.floats.evaluate(s.0, s.1)[0],
            &self.nodes.floats.evaluate(t.0, t.1)[0],
        );
        let adjacent = b.is_none_or(|b| context.adjacent(a, b));
        Event::Stuck(Stuck {
            s,
            t,
            distance: dot(&x, &x).sqrt(),
            adjacent,
        })
    }
}

/// Signs of α, β in `bend` at the ends of the curve.
fn bend_signs(a: &Node, b: &Node) -> super::half_plane::Signs {
    let at = |node: &Node, end| node.kind == Kind::Point(end);
    [
        if at(a, Element::Start) { 1 } else { 0 },
        if at(b, Element::End) { 1 } else { 0 },
    ]
}

/// Which of two nodes to split: the larger one; of two parts of about the same size the one that bends more.
pub fn splits_first(a: &Node, b: &Node) -> bool {
    if a.is_point() || b.is_point() {
        return b.is_point();
    }
    a.diagonal_squared() >= b.diagonal_squared()
}
