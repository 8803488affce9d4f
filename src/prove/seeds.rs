//! Short double normals, found but not proved: the first pass of the search.
//!
//! Nodes are paired and split as in the cover tree, nearer pairs first, and whatever is farther apart than the shortest double normal found so
//! far is left. Pairs of parts that are nearly straight are given to Newton's method.

use super::cover::{Contact, splits_first};
use super::leaf;
use super::newton::{self, Candidate, Location};
use super::node::{Kind, Node, Nodes};
use super::vector::{dot, greater, sub};
use crate::check::element::Element;

/// Parts are given to Newton's method when all tangents make an angle of at least this cosine with an axis.
const STRAIGHT: f64 = 0.82;
/// How often a piece may be halved in this pass.
const DEPTH: u32 = 9;
/// How many candidates are kept, shortest first.
const KEPT: usize = 16;

struct Seeds<'n, 's> {
    nodes: &'n mut Nodes<'s>,
    found: Vec<Candidate>,
    /// The squared length of the shortest so far.
    shortest: f64,
    steps: u64,
    suspicious: bool,
}

/// What the first pass found.
pub struct Found {
    /// The shortest double normals, shortest first.
    pub candidates: Vec<Candidate>,
    /// Somewhere the curve still turned by more than a right angle when it was cut small: a corner, or a point that is not regular.
    pub suspicious: bool,
}

/// Looks for short double normals, in a bounded number of steps.
pub fn find(nodes: &mut Nodes, steps: u64) -> Found {
    let whole = nodes.whole();
    let mut seeds = Seeds {
        nodes,
        found: Vec::new(),
        shortest: f64::INFINITY,
        steps,
        suspicious: false,
    };
    seeds.pair(&whole, None, Contact::default());
    let Seeds {
        found: mut candidates,
        suspicious,
        steps,
        ..
    } = seeds;
    candidates.sort_by(|a, b| a.squared.total_cmp(&b.squared));
    candidates.truncate(KEPT);
    Found {
        candidates,
        suspicious: suspicious || steps == 0,
    }
}

/// The squared distance of two boxes.
fn box_distance(a: &Node, b: &Node) -> f64 {
    let mut sum = 0.0;
    for axis in 0..3 {
        let apart = greater(greater(a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]), 0.0);
        sum += apart * apart;
    }
    sum
}

impl Seeds<'_, '_> {
    /// Looks for double normals between two nodes that are nearer than the shortest so far, or of one node.
    fn pair(&mut self, a: &Node, b: Option<&Node>, contact: Contact) {
        let Some(b) = b else {
            if a.is_point() || self.nodes.cone(a).cosine > 0.1 {
                return;
            }
            if a.depth() >= DEPTH {
                self.suspicious = true;
                return;
            }
            let mark = self.nodes.mark();
            let mut halves = [Node::NONE; 2];
            if self.nodes.halves(a, &mut halves) {
                let [left, right] = &halves;
                let between = Contact {
                    forward: true,
                    backward: self.nodes.floats.closed && self.nodes.is_whole(a),
                };
                self.pair(left, None, Contact::default());
                self.pair(right, None, Contact::default());
                if box_distance(left, right) < self.shortest {
                    self.pair(left, Some(right), between);
                }
            }
            self.nodes.release(mark);
            return;
        };
        if self.steps == 0 {
            return;
        }
        self.steps -= 1;
        let touching = contact.forward || contact.backward;
        if touching && self.gentle(a, b) {
            return;
        }
        if !touching && (a.is_run() || b.is_run()) && leaf::not_normal(self.nodes, a, b).is_some() {
            return;
        }
        self.suspicious |= touching && a.depth().max(b.depth()) >= DEPTH;
        if a.depth().max(b.depth()) >= DEPTH || !touching && self.settled(a, b) {
            return;
        }
        let mark = self.nodes.mark();
        let first = splits_first(a, b);
        let mut halves = [Node::NONE; 2];
        if self.nodes.halves(if first { a } else { b }, &mut halves) {
            let [left, right] = &halves;
            let (of_left, of_right) = if first {
                contact.of_first_halves(left, right)
            } else {
                contact.of_second_halves(left, right)
            };
            let other = if first { b } else { a };
            let (to_left, to_right) = (box_distance(left, other), box_distance(right, other));
            let mut halves = [(left, of_left, to_left), (right, of_right, to_right)];
            if to_right < to_left {
                halves.swap(0, 1);
            }
            for (half, contact, distance) in halves {
                if distance >= self.shortest {
                    continue;
                }
                if first {
                    self.pair(half, Some(b), contact)
                } else {
                    self.pair(a, Some(half), contact)
                }
            }
        }
        self.nodes.release(mark);
    }

    /// Do two nodes that meet bend so little that a double normal between them is unlikely? If there is one, the search will find it.
    fn gentle(&self, a: &Node, b: &Node) -> bool {
        let (of_a, of_b) = (self.nodes.cone(a), self.nodes.cone(b));
        of_a.cosine > 0.5 && of_b.cosine > 0.5 && dot(&of_a.axis, &of_b.axis) > -0.3
    }

    /// Looks for double normals of two nodes that do not meet; `false` if they are to be split.
    fn settled(&mut self, a: &Node, b: &Node) -> bool {
        if a.is_run() || b.is_run() {
            return false;
        }
        if a.is_point() && b.is_point() {
            self.corners(a, b);
            return true;
        }
        let straight = |node: &Node| node.is_point() || self.nodes.cone(node).cosine > STRAIGHT;
        if !straight(a) || !straight(b) {
            return false;
        }
        if leaf::not_normal(self.nodes, a, b).is_some() {
            return true;
        }
        if a.is_point() || b.is_point() {
            return self.corner_and_part(a, b);
        }
        let (Some(s), Some(t)) = (a.middle(), b.middle()) else {
            return false;
        };
        match newton::double_normal(self.nodes.floats, s, t) {
            Some(found) => {
                self.add(found);
                // One is enough where it was looked for; one found elsewhere says nothing about this pair.
                near(a, found.s) && near(b, found.t)
            }
            None => a.depth().min(b.depth()) >= 4,
        }
    }

    fn add(&mut self, candidate: Candidate) {
        if self.found.len() < 4 * KEPT || candidate.squared < self.shortest {
            self.found.push(candidate);
        }
        self.shortest = self.shortest.min(candidate.squared);
    }

    /// Where a corner or an end is, and whether a chord to `other` from there is critical.
    fn critical_at(&self, node: &Node, other: &super::vector::Vector) -> Option<(Location, bool)> {
        let Kind::Point(element) = node.kind else { return None };
        let pieces = self.nodes.floats.pieces.len();
        let point = self.nodes.hull(node)[0];
        let x = sub(other, &point);
        let tangents = self.nodes.tangents(node);
        Some(match element {
            Element::Start => ((0, 0.0), dot(&x, &tangents[0]) <= 0.0),
            Element::End => ((pieces - 1, 1.0), dot(&x, &tangents[0]) >= 0.0),
            Element::Corner(joint) => ((joint, 0.0), dot(&x, &tangents[0]) * dot(&x, tangents.last()?) <= 0.0),
            Element::Piece(_) => return None,
        })
    }

    fn corners(&mut self, a: &Node, b: &Node) {
        let (p, q) = (self.nodes.hull(a)[0], self.nodes.hull(b)[0]);
        if let (Some((s, true)), Some((t, true))) = (self.critical_at(a, &q), self.critical_at(b, &p)) {
            let x = sub(&p, &q);
            self.add(Candidate {
                s,
                t,
                squared: dot(&x, &x),
            });
        }
    }

    fn corner_and_part(&mut self, a: &Node, b: &Node) -> bool {
        let (point, part) = if a.is_point() { (a, b) } else { (b, a) };
        let Some(middle) = part.middle() else { return false };
        let corner = self.nodes.hull(point)[0];
        let Some(foot) = newton::foot(self.nodes.floats, &corner, middle) else {
            return part.depth() >= 4;
        };
        let [q, _, _] = self.nodes.floats.evaluate(foot.0, foot.1);
        if let Some((location, true)) = self.critical_at(point, &q) {
            let x = sub(&q, &corner);
            let (s, t) = if (location.0, location.1) <= (foot.0, foot.1) {
                (location, foot)
            } else {
                (foot, location)
            };
            if dot(&x, &x) > 0.0 {
                self.add(Candidate {
                    s,
                    t,
                    squared: dot(&x, &x),
                });
            }
        }
        near(part, foot)
    }
}

/// Is a location in a part or beside it?
fn near(part: &Node, location: Location) -> bool {
    let Kind::Part { piece, index, depth } = part.kind else {
        return false;
    };
    let width = 2f64.powi(-(depth as i32));
    let start = index as f64 * width;
    location.0 == piece && (start - width..=start + 2.0 * width).contains(&location.1)
}
