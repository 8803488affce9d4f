//! `separate` and `monotone`: leaves that exclude common points. Among directions that serve, one with a wide margin is taken.

use super::meeting::trustworthy;
use super::{extreme, gap};
use crate::claim::tree::Leaf;
use crate::prove::cone::Cone;
use crate::prove::float_chain::UNIT;
use crate::prove::node::{Node, Nodes};
use crate::prove::vector::{
    Vector, dot, from_integers, greater, inner_direction, lesser, middle, norm1, quantised, scale, sub, unit,
};

/// `separate` for two different nodes.
pub fn separate(nodes: &Nodes, a: &Node, b: &Node) -> Option<Leaf> {
    // Along each axis how far a is above b, or below.
    let (above, below) = (sub(&a.low, &b.high), sub(&b.low, &a.high));
    let mut best: Option<([i64; 3], f64)> = None;
    let mut consider = |n: [i64; 3]| {
        let as_float = from_integers(&n);
        let margin = gap(nodes, a, b, &as_float) / dot(&as_float, &as_float).sqrt();
        if margin > 0.0 && best.is_none_or(|(_, known)| margin > 1.02 * known) {
            best = Some((n, margin));
        }
    };
    for axis in 0..3 {
        if greater(above[axis], below[axis]) > a.margin + b.margin {
            let mut n = [0; 3];
            n[axis] = if above[axis] > 0.0 { 1 } else { -1 };
            consider(n);
        }
    }
    let direction = if a.is_run() && b.is_run() {
        let apart = [0, 1, 2].map(|axis| greater(above[axis], 0.0) - greater(below[axis], 0.0));
        [apart[0], apart[1], apart[2], 0.0]
    } else {
        nearest(nodes, a, b)
    };
    for bits in [3u32, 7] {
        consider(quantised(&direction, bits));
    }
    for bits in [12u32, 20, 40] {
        if best.is_some() {
            break;
        }
        let n = quantised(&direction, bits);
        if gap(nodes, a, b, &from_integers(&n)) > 0.0 {
            best = Some((n, 0.0));
        }
    }
    best.map(|(n, _)| Leaf::Separate(n.map(Into::into)))
}

/// Nearly the shortest vector from hull to hull, by Gilbert's steps; any vector where they meet.
fn nearest(nodes: &Nodes, a: &Node, b: &Node) -> Vector {
    let mut x = sub(&middle(&a.low, &a.high), &middle(&b.low, &b.high));
    let mut best = (f64::NEG_INFINITY, x);
    for _ in 0..16 {
        let length = dot(&x, &x).sqrt();
        let support = sub(&extreme(nodes, a, &x, false), &extreme(nodes, b, &x, true));
        let reached = dot(&support, &x) / length;
        if reached > best.0 {
            best = (reached, x);
        }
        let step = sub(&x, &support);
        let square = dot(&step, &step);
        let fraction = if square > 0.0 {
            (dot(&x, &step) / square).clamp(0.0, 1.0)
        } else {
            0.0
        };
        if fraction <= 0.0 || reached.is_nan() || reached > 0.99 * length {
            break;
        }
        x = sub(&x, &scale(&step, fraction));
    }
    best.1
}

/// `monotone` for one node or two adjacent ones.
pub fn monotone(nodes: &Nodes, a: &Node, b: Option<&Node>) -> Option<Leaf> {
    if a.is_run() || b.is_some_and(Node::is_run) {
        return monotone_runs(nodes, a, b);
    }
    let given: Vec<Vector> = std::iter::once(a)
        .chain(b)
        .flat_map(|node| nodes.tangents(node))
        .copied()
        .collect();
    let directions: Option<Vec<Vector>> = given.iter().map(unit).collect();
    let error = greater(a.tangent_error, b.map_or(0.0, |b| b.tangent_error));
    let size = given.iter().fold(0.0, |most, v| greater(norm1(v), most));
    let directions = directions?;
    // What is certain of the least product: errors of the tangents, three products and two additions.
    let least = |n: &Vector| {
        let least = given.iter().fold(f64::INFINITY, |least, v| lesser(dot(n, v), least));
        least - norm1(n) * (error + 4.0 * UNIT * size)
    };
    // The margin counts by the tangents as they are; whether there is any, by their directions.
    let mut best: Option<([i64; 3], f64)> = None;
    let by_direction = inner_direction(&directions);
    if directions.iter().any(|v| dot(v, &by_direction) <= 0.0) {
        return None;
    }
    for direction in [inner_direction(&given), by_direction] {
        for bits in [2u32, 4, 7, 12, 20, 40] {
            let n = quantised(&direction, bits);
            let as_float = from_integers(&n);
            let margin = least(&as_float) / dot(&as_float, &as_float).sqrt();
            if margin > 0.0 && best.is_none_or(|(_, known)| margin > 1.02 * known) {
                best = Some((n, margin));
            } else if best.is_some() {
                break;
            }
        }
    }
    best.map(|(n, _)| Leaf::Monotone(n.map(Into::into)))
}

/// The same where a run takes part, by cones around its tangents.
fn monotone_runs(nodes: &Nodes, a: &Node, b: Option<&Node>) -> Option<Leaf> {
    let cone: Cone = match b {
        None => nodes.cone(a),
        Some(b) => nodes.cone(a).merged(&nodes.cone(b)),
    };
    if cone.cosine <= 0.0 || !trustworthy(nodes, a) || !b.is_none_or(|b| trustworthy(nodes, b)) {
        return None;
    }
    // With n off the axis by φ and the cone of half-angle θ: φ + θ < 90° when and only when cos φ > sin θ.
    let sine = (1.0 - (cone.cosine * cone.cosine).min(1.0)).sqrt();
    let needed = sine + 1e-7;
    for bits in [2u32, 3, 5, 8, 12, 20] {
        let n = quantised(&cone.axis, bits);
        let as_float = from_integers(&n);
        let along = dot(&as_float, &cone.axis);
        if along > 0.0 && along * along > needed * needed * dot(&as_float, &as_float) {
            return Some(Leaf::Monotone(n.map(Into::into)));
        }
    }
    None
}
