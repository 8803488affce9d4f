//! Finding a leaf for a pair of nodes in binary64, with room for every error.
//!
//! Whatever is returned satisfies its obligation exactly, by the error bounds of the nodes; the checker replays it all the same.

use smallvec::{SmallVec, smallvec};

use super::cone::Cone;
use super::float_chain::UNIT;
use super::half_plane::{Rectangle, Signs, choose, choose_mixed};
use super::node::{Node, Nodes};
use super::vector::{Vector, dot, from_integers, greatest, norm1, quantised, scale, sub};
use crate::claim::tree::Leaf;

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
        products.fold(f64::NEG_INFINITY, f64::max)
    } else {
        products.fold(f64::INFINITY, f64::min)
    }
}

/// The greatest magnitude of a coordinate of a node.
fn reach(node: &Node) -> f64 {
    greatest(&node.low).max(greatest(&node.high))
}

/// A certain lower bound of min n·p − max n·q.
fn gap(nodes: &Nodes, a: &Node, b: &Node, n: &Vector) -> f64 {
    let value = support(nodes, a, n, false) - support(nodes, b, n, true);
    // Hull errors, three products and three additions on each side, and the subtraction.
    value - norm1(n) * (a.error + b.error + 4.0 * UNIT * (reach(a) + reach(b)))
}

/// `far` for two different nodes.
pub fn far(nodes: &Nodes, a: &Node, b: &Node, target: Target) -> Option<Leaf> {
    if target.length.is_infinite() {
        return None;
    }
    let mut apart = [0.0; 4];
    for axis in 0..3 {
        apart[axis] = if a.low[axis] > b.high[axis] {
            a.low[axis] - b.high[axis]
        } else if b.low[axis] > a.high[axis] {
            a.high[axis] - b.low[axis]
        } else {
            0.0
        };
    }
    let error = a.error + b.error + 4.0 * UNIT * (reach(a) + reach(b));
    for axis in 0..3 {
        if apart[axis].abs() - error > target.length {
            let mut n = [0; 3];
            n[axis] = if apart[axis] > 0.0 { 1 } else { -1 };
            return Some(far_leaf(n));
        }
    }
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
    let needed = (-0.5 * slack.log2()).max(0.0) as u32;
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
    if slack > 64.0 * (a.error + b.error + 4.0 * UNIT * (reach(a) + reach(b))) {
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
    let error = norm1(&n) * (a.error + b.error + 4.0 * UNIT * (reach(a) + reach(b)));
    let value = support(nodes, a, &n, false) - support(nodes, b, &n, true);
    value + 4.0 * error >= target.length * norm * (1.0 - 16.0 * UNIT)
}

/// `not_normal` for two different nodes that are not adjacent.
pub fn not_normal(nodes: &Nodes, a: &Node, b: &Node) -> Option<Leaf> {
    let signs: Signs = [if a.has_end { -1 } else { 0 }, if b.has_end { -1 } else { 0 }];
    if a.is_run() || b.is_run() {
        return not_normal_of_runs(nodes, a, b, signs);
    }
    let (points_a, points_b) = (nodes.hull(a), nodes.hull(b));
    let (tangents_a, tangents_b) = (nodes.tangents(a), nodes.tangents(b));
    if has_zero(tangents_a) || has_zero(tangents_b) {
        return None;
    }
    // The chord's components are at most `extent` in magnitude, and each off by `chord_error`.
    let mut extent = 0.0f64;
    for axis in 0..3 {
        extent = extent.max(a.high[axis].max(b.high[axis]) - a.low[axis].min(b.low[axis]));
    }
    let chord_error = a.error + b.error + 4.0 * UNIT * (reach(a) + reach(b));
    let error = |node: &Node, tangents: &[Vector]| {
        let most = tangents.iter().map(norm1).fold(0.0, f64::max);
        most * chord_error + 3.0 * extent * node.tangent_error + 8.0 * UNIT * most * extent
    };
    let errors = [error(a, tangents_a), error(b, tangents_b)];
    // Coordinates from here, so that products stay small beside a large common offset.
    let origin = points_a[0];
    let of_v = ChordProducts::new(points_a, points_b, tangents_a, &origin);
    if let Some(sign) = of_v
        .sign(errors[0])
        .filter(|sign| signs[0] == 0 || *sign == i64::from(signs[0]))
    {
        return Some(Leaf::NotNormal([sign.into(), 0.into()]));
    }
    let of_w = ChordProducts::new(points_a, points_b, tangents_b, &origin);
    if let Some(sign) = of_w
        .sign(errors[1])
        .filter(|sign| signs[1] == 0 || *sign == i64::from(signs[1]))
    {
        return Some(Leaf::NotNormal([0.into(), sign.into()]));
    }
    let mut rectangles: SmallVec<[Rectangle; 16]> = SmallVec::new();
    of_v.each_chord(&of_w, |a, b| rectangles.push(Rectangle { a, b }));
    let factors = choose_mixed(&rectangles, errors, signs)?;
    Some(Leaf::NotNormal(factors.map(Into::into)))
}

/// Products of points with tangents, all those of a point together; on the stack up to cubics.
type Products = SmallVec<[f64; 16]>;

/// The products p·v and q·v for all p∈H(A), q∈H(B) and the tangents v of one node.
struct ChordProducts {
    of_a: Products,
    of_b: Products,
    tangents: usize,
    /// Least and greatest (p−q)·v.
    range: [f64; 2],
}

impl ChordProducts {
    fn new(points_a: &[Vector], points_b: &[Vector], tangents: &[Vector], origin: &Vector) -> Self {
        let count = tangents.len();
        let products = |points: &[Vector]| {
            let mut products = Products::with_capacity(points.len() * count);
            let mut bounds: SmallVec<[[f64; 2]; 4]> = smallvec![[f64::INFINITY, f64::NEG_INFINITY]; count];
            for point in points {
                let local = sub(point, origin);
                for (tangent, bounds) in tangents.iter().zip(bounds.iter_mut()) {
                    let product = dot(&local, tangent);
                    *bounds = [bounds[0].min(product), bounds[1].max(product)];
                    products.push(product);
                }
            }
            (products, bounds)
        };
        let ((of_a, bounds_a), (of_b, bounds_b)) = (products(points_a), products(points_b));
        let mut range = [f64::INFINITY, f64::NEG_INFINITY];
        for (p, q) in bounds_a.iter().zip(&bounds_b) {
            range = [range[0].min(p[0] - q[1]), range[1].max(p[1] - q[0])];
        }
        ChordProducts {
            of_a,
            of_b,
            tangents: count,
            range,
        }
    }

    /// The sign that all (p−q)·v certainly have.
    fn sign(&self, error: f64) -> Option<i64> {
        let error = error * 1.000_001;
        if self.range[0] > error {
            Some(1)
        } else if self.range[1] < -error {
            Some(-1)
        } else {
            None
        }
    }

    /// The ranges of (p−q)·v and (p−q)·w for each p, q, with `other` holding the products with the w.
    fn each_chord(&self, other: &ChordProducts, mut found: impl FnMut([f64; 2], [f64; 2])) {
        let range = |p: &[f64], q: &[f64]| {
            let mut range = [f64::INFINITY, f64::NEG_INFINITY];
            for (x, y) in p.iter().zip(q) {
                range = [range[0].min(x - y), range[1].max(x - y)];
            }
            range
        };
        for (p_v, p_w) in self.of_a.chunks(self.tangents).zip(other.of_a.chunks(other.tangents)) {
            for (q_v, q_w) in self.of_b.chunks(self.tangents).zip(other.of_b.chunks(other.tangents)) {
                found(range(p_v, q_v), range(p_w, q_w));
            }
        }
    }
}

fn has_zero(tangents: &[Vector]) -> bool {
    tangents.iter().any(|v| v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0)
}

/// `not_normal` with one factor 0, by cones and boxes.
fn not_normal_of_runs(nodes: &Nodes, a: &Node, b: &Node, signs: Signs) -> Option<Leaf> {
    let mut least = [0.0; 3];
    let mut most = [0.0; 3];
    let error = a.error + b.error + 4.0 * UNIT * (reach(a) + reach(b));
    for axis in 0..3 {
        least[axis] = a.low[axis] - b.high[axis] - error;
        most[axis] = a.high[axis] - b.low[axis] + error;
    }
    let center = [0, 1, 2].map(|i| least[i] + most[i]);
    let center = [center[0], center[1], center[2], 0.0];
    for (side, node) in [a, b].into_iter().enumerate() {
        let cone = nodes.cone(node);
        let sign = if dot(&center, &cone.axis) > 0.0 { 1.0 } else { -1.0 };
        if signs[side] < 0 && sign > 0.0 {
            continue;
        }
        let corner = |k: usize| {
            let axis = |i: usize| sign * if k >> i & 1 == 0 { least[i] } else { most[i] };
            [axis(0), axis(1), axis(2), 0.0]
        };
        if (0..8).all(|k| cone.all_positive(&corner(k))) {
            let mut factors = [0i64, 0];
            factors[side] = sign as i64;
            return Some(Leaf::NotNormal(factors.map(Into::into)));
        }
    }
    None
}

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
        Some(b) => Cone::around(nodes.tangents(a).iter().chain(nodes.tangents(b))),
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
fn trustworthy(nodes: &Nodes, node: &Node) -> bool {
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
    if has_zero(v) || has_zero(w) {
        return None;
    }
    let range = |x: &Vector, vectors: &[Vector]| {
        let products = vectors.iter().map(|v| dot(x, v));
        products.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| {
            [low.min(y), high.max(y)]
        })
    };
    let path = [a, second]
        .into_iter()
        .filter(|node| !node.is_point())
        .flat_map(|node| nodes.tangents(node));
    let rectangles: SmallVec<[Rectangle; 16]> = path
        .map(|x| Rectangle {
            a: range(x, v),
            b: range(x, w),
        })
        .collect();
    let most = |vectors: &[Vector]| vectors.iter().map(norm1).fold(0.0, f64::max);
    let (size, tangent_error) = (most(v).max(most(w)), a.tangent_error.max(second.tangent_error));
    let error = 2.0 * size * tangent_error + 3.0 * tangent_error * tangent_error + 8.0 * UNIT * size * size;
    let factors = choose(&rectangles, [error, error], signs)?;
    Some(Leaf::Bend(factors.map(Into::into)))
}
