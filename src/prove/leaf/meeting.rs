//! `cone` and `bend`: leaves for one node, or for two that meet.

use smallvec::SmallVec;

use super::not_normal::has_zero;
use crate::claim::tree::Leaf;
use crate::prove::cone::Cone;
use crate::prove::float_chain::UNIT;
use crate::prove::half_plane::{Rectangle, Signs, choose};
use crate::prove::node::{Node, Nodes};
use crate::prove::vector::{Vector, dot, from_integers, greater, greatest, lesser, norm1, quantised};

/// `cone` for one node or two adjacent ones.
pub fn cone(nodes: &Nodes, a: &Node, b: Option<&Node>) -> Option<Leaf> {
    const HALF_RIGHT_ANGLE: f64 = std::f64::consts::FRAC_1_SQRT_2;
    let runs = a.is_run() || b.is_some_and(Node::is_run);
    let cone = match b {
        None => nodes.cone(a),
        Some(b) if runs => {
            let (of_a, of_b) = (nodes.cone(a), nodes.cone(b));
            if of_a.cosine < HALF_RIGHT_ANGLE || of_b.cosine < HALF_RIGHT_ANGLE {
                return None;
            }
            of_a.merged(&of_b)
        }
        Some(b) => {
            let (of_a, of_b) = (nodes.tangents(a), nodes.tangents(b));
            // Within 45° of an axis any two tangents make at most a right angle.
            let far_ends = [(of_a.first(), of_b.last()), (of_a.last(), of_b.first())];
            if far_ends
                .iter()
                .any(|ends| matches!(ends, (Some(v), Some(w)) if dot(v, w) < 0.0))
            {
                return None;
            }
            Cone::around(of_a.iter().chain(of_b))
        }
    };
    if cone.cosine <= HALF_RIGHT_ANGLE {
        return None;
    }
    // A cone is only as good as the floats its tangents were.
    if !trustworthy(nodes, a) || !b.is_none_or(|b| trustworthy(nodes, b)) {
        return None;
    }
    // n may be off the axis by the angle left to 45°: cos(45° − φ) for a cone of half-angle φ.
    let sine = (1.0 - (cone.cosine * cone.cosine).min(1.0)).sqrt();
    let needed = HALF_RIGHT_ANGLE * (cone.cosine + sine) + 1e-7;
    for bits in [2u32, 3, 5, 8, 12, 20] {
        let n = quantised(&cone.axis, bits);
        let as_float = from_integers(&n);
        let along = dot(&as_float, &cone.axis);
        if along > 0.0 && along * along > needed * needed * dot(&as_float, &as_float) {
            return Some(Leaf::Cone(n.map(Into::into)));
        }
    }
    None
}

/// Are the tangents of a node so much larger than their errors that their directions are right to 10⁻⁷?
pub fn trustworthy(nodes: &Nodes, node: &Node) -> bool {
    node.is_run()
        || nodes
            .tangents(node)
            .iter()
            .all(|v| greatest(v) > 1e8 * node.tangent_error)
}

/// `bend` for one node or two adjacent ones, none of them a run.
pub fn bend(nodes: &Nodes, a: &Node, b: Option<&Node>, signs: Signs) -> Option<Leaf> {
    let second = b.unwrap_or(a);
    if a.is_run() || second.is_run() {
        return None;
    }
    let (v, w) = (nodes.tangents(a), nodes.tangents(second));
    let path = [a, second].map(|node| if node.is_point() { &[][..] } else { nodes.tangents(node) });
    // The path of one node with itself is its own.
    let path = [path[0], if b.is_some() { path[1] } else { &[] }];
    // Most pieces are cubics; where the compiler knows the numbers of tangents, it needs no loops.
    if let (Ok(v), Ok(w)) = (<&[Vector; 3]>::try_from(v), <&[Vector; 3]>::try_from(w)) {
        return bend_of_tangents([a, second], [v, w], path, signs);
    }
    bend_of_tangents([a, second], [v, w], path, signs)
}

#[inline(always)]
fn bend_of_tangents(nodes: [&Node; 2], [v, w]: [&[Vector]; 2], path: [&[Vector]; 2], signs: Signs) -> Option<Leaf> {
    if has_zero(v) || has_zero(w) {
        return None;
    }
    let mut rectangles: SmallVec<[Rectangle; 8]> = SmallVec::new();
    for x in path.into_iter().flatten() {
        rectangles.push(Rectangle {
            a: range(x, v),
            b: range(x, w),
        });
    }
    let size = greater(greatest_norm(v), greatest_norm(w));
    let tangent_error = greater(nodes[0].tangent_error, nodes[1].tangent_error);
    let error = 2.0 * size * tangent_error + 3.0 * tangent_error * tangent_error + 8.0 * UNIT * size * size;
    let factors = choose(&rectangles, [error, error], signs)?;
    Some(Leaf::Bend(factors.map(Into::into)))
}

/// Least and greatest product with some vectors.
#[inline(always)]
fn range(x: &Vector, vectors: &[Vector]) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for v in vectors {
        let product = dot(x, v);
        range = [lesser(product, range[0]), greater(product, range[1])];
    }
    range
}

#[inline(always)]
fn greatest_norm(vectors: &[Vector]) -> f64 {
    vectors.iter().fold(0.0, |most, v| greater(norm1(v), most))
}
