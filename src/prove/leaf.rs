//! Finding a leaf for a pair of nodes in binary64, with room for every error.
//!
//! Whatever is returned satisfies its obligation exactly, by the error bounds of the nodes; the checker replays it all the same.

mod apart;
mod meeting;
mod not_normal;
pub mod pedal;

use super::float_chain::UNIT;
use super::node::{Node, Nodes};
use super::vector::{Vector, dot, from_integers, greater, lesser, norm1, quantised, scale, sub};
use crate::claim::tree::Leaf;
pub use apart::{monotone, separate};
pub use meeting::{bend, cone};
pub use not_normal::not_normal;

/// The bound that `far` leaves must reach.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// At least √lower_squared; infinite when no `far` leaf is allowed.
    pub length: f64,
}

/// Sizes in bits that are tried for a vector, least first.
const BITS: [u32; 7] = [2, 4, 7, 11, 17, 26, 40];

fn far_leaf(n: [i64; 3]) -> Leaf {
    Leaf::Far(n.map(Into::into))
}

/// The least n·p over a node's hull, or the greatest, without errors.
fn support(nodes: &Nodes, node: &Node, n: &Vector, greatest: bool) -> f64 {
    if node.is_run() {
        let mut sum = 0.0;
        for axis in 0..3 {
            sum += n[axis]
                * if (n[axis] > 0.0) == greatest {
                    node.high[axis]
                } else {
                    node.low[axis]
                };
        }
        return sum;
    }
    let products = nodes.hull(node).iter().map(|point| dot(n, point));
    if greatest {
        products.fold(f64::NEG_INFINITY, |most, x| greater(x, most))
    } else {
        products.fold(f64::INFINITY, |least, x| lesser(x, least))
    }
}

/// A certain lower bound of min n·p − max n·q.
fn gap(nodes: &Nodes, a: &Node, b: &Node, n: &Vector) -> f64 {
    let value = support(nodes, a, n, false) - support(nodes, b, n, true);
    // Hull errors, three products and three additions on each side, and the subtraction.
    value - norm1(n) * (a.margin + b.margin)
}

/// `far` for two different nodes.
pub fn far(nodes: &Nodes, a: &Node, b: &Node, target: Target) -> Option<Leaf> {
    if target.length.is_infinite() {
        return None;
    }
    // Along each axis how far a is above b, or below.
    let (above, below) = (sub(&a.low, &b.high), sub(&b.low, &a.high));
    let needed = target.length + a.margin + b.margin;
    for axis in 0..3 {
        if greater(above[axis], below[axis]) > needed {
            let mut n = [0; 3];
            n[axis] = if above[axis] > 0.0 { 1 } else { -1 };
            return Some(far_leaf(n));
        }
    }
    let apart = [0, 1, 2].map(|axis| greater(above[axis], 0.0) - greater(below[axis], 0.0));
    let apart = [apart[0], apart[1], apart[2], 0.0];
    let between = dot(&apart, &apart).sqrt();
    if between > target.length
        && let Some(leaf) = rounded_far(nodes, a, b, &apart, between, target)
    {
        return Some(leaf);
    }
    if a.is_run() && b.is_run() {
        return None;
    }
    nearest_far(nodes, a, b, target)
}

/// Rounds a direction, from few bits to many, until `far` holds.
fn rounded_far(nodes: &Nodes, a: &Node, b: &Node, direction: &Vector, length: f64, target: Target) -> Option<Leaf> {
    // A direction off by the angle φ loses the factor cos φ ≈ 1 − φ²/2 of the gap, and bits bits leave φ ≈ 2^-bits.
    let slack = (length / target.length - 1.0).max(1e-24);
    // Half of −log₂ of the slack, from its binary exponent, rounded down.
    let needed = (1022u64.saturating_sub(slack.to_bits() >> 52) / 2) as u32;
    for bits in BITS.into_iter().filter(|bits| *bits >= needed) {
        let n = quantised(direction, bits);
        let as_float = from_integers(&n);
        let norm = dot(&as_float, &as_float).sqrt();
        if gap(nodes, a, b, &as_float) > target.length * norm * (1.0 + 4.0 * UNIT) {
            return Some(far_leaf(n));
        }
    }
    None
}

/// The hull point of `node` that is extreme along `n`.
fn extreme(nodes: &Nodes, node: &Node, n: &Vector, greatest: bool) -> Vector {
    if node.is_run() {
        let mut point = node.low;
        for axis in 0..3 {
            if (n[axis] > 0.0) == greatest {
                point[axis] = node.high[axis];
            }
        }
        return point;
    }
    let points = nodes.hull(node);
    let mut best = points[0];
    let mut value = dot(n, &best);
    for point in &points[1..] {
        let product = dot(n, point);
        if (product > value) == greatest && product != value {
            (best, value) = (*point, product);
        }
    }
    best
}

/// `far` along the shortest vector between the two hulls, approached by Frank–Wolfe steps.
fn nearest_far(nodes: &Nodes, a: &Node, b: &Node, target: Target) -> Option<Leaf> {
    // Points of both hulls that are too near forbid any direction.
    let first = |node: &Node| {
        if node.is_run() {
            super::vector::middle(&node.low, &node.high)
        } else {
            nodes.hull(node)[0]
        }
    };
    let last = |node: &Node| {
        if node.is_run() {
            super::vector::middle(&node.low, &node.high)
        } else {
            *nodes.hull(node).last().expect("a point")
        }
    };
    let too_near = |p: Vector, q: Vector| {
        let x = sub(&p, &q);
        dot(&x, &x) < target.length * target.length
    };
    if too_near(first(a), first(b))
        || too_near(last(a), last(b))
        || too_near(first(a), last(b))
        || too_near(last(a), first(b))
    {
        return None;
    }
    let mut x = sub(
        &super::vector::middle(&a.low, &a.high),
        &super::vector::middle(&b.low, &b.high),
    );
    for _ in 0..6 {
        let length = dot(&x, &x).sqrt();
        if length <= target.length {
            return None;
        }
        let support = sub(&extreme(nodes, a, &x, false), &extreme(nodes, b, &x, true));
        let reached = dot(&support, &x) / length;
        if reached > target.length * (1.0 + 4.0 * UNIT)
            && let Some(leaf) = rounded_far(nodes, a, b, &x, reached, target)
        {
            return Some(leaf);
        }
        // The point of the segment from x to the support point that is nearest to the origin.
        let step = sub(&x, &support);
        let square = dot(&step, &step);
        let fraction = if square > 0.0 {
            (dot(&x, &step) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        if fraction <= 0.0 {
            return None;
        }
        x = sub(&x, &scale(&step, fraction));
    }
    None
}

/// Is it only for the errors of floats that `far` does not hold, as between parallel lines? Only asked where these errors are not small beside
/// the `slack` that the bounds leave.
pub fn far_within_errors(nodes: &Nodes, a: &Node, b: &Node, target: Target, slack: f64) -> bool {
    if slack > 64.0 * (a.margin + b.margin) {
        return false;
    }
    let mut n = sub(
        &super::vector::middle(&a.low, &a.high),
        &super::vector::middle(&b.low, &b.high),
    );
    for axis in 0..3 {
        if a.low[axis] > b.high[axis] || b.low[axis] > a.high[axis] {
            continue;
        }
        // Only axes along which the boxes are apart, if there are any.
        if (0..3).any(|other| a.low[other] > b.high[other] || b.low[other] > a.high[other]) {
            n[axis] = 0.0;
        }
    }
    let norm = dot(&n, &n).sqrt();
    let error = norm1(&n) * (a.margin + b.margin);
    let value = support(nodes, a, &n, false) - support(nodes, b, &n, true);
    value + 4.0 * error >= target.length * norm * (1.0 - 16.0 * UNIT)
}
