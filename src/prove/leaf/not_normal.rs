//! `not_normal`: factors α, β with (p−q)·(αv+βw) > 0 throughout.

use smallvec::SmallVec;

use crate::claim::tree::Leaf;
use crate::prove::float_chain::UNIT;
use crate::prove::half_plane::{Rectangle, Signs, Span, round_bisector};
use crate::prove::node::{Node, Nodes};
use crate::prove::vector::{Vector, dot, greater, lesser, norm1, sub};

/// `not_normal` for two different nodes that are not adjacent.
pub fn not_normal(nodes: &Nodes, a: &Node, b: &Node) -> Option<Leaf> {
    let signs: Signs = [if a.has_end { -1 } else { 0 }, if b.has_end { -1 } else { 0 }];
    let factors = if a.is_run() || b.is_run() {
        factors_of_runs(nodes, a, b, signs)
    } else {
        factors_of_parts(nodes, a, b, signs)
    }?;
    Some(Leaf::NotNormal(factors.map(Into::into)))
}

fn factors_of_parts(nodes: &Nodes, a: &Node, b: &Node, signs: Signs) -> Option<[i64; 2]> {
    let (points, tangents) = ([nodes.hull(a), nodes.hull(b)], [nodes.tangents(a), nodes.tangents(b)]);
    // Most pieces are cubics; where the compiler knows the numbers of points, it needs no loops.
    if let ([Ok(p), Ok(q)], [Ok(v), Ok(w)]) = (
        points.map(<&[Vector; 4]>::try_from),
        tangents.map(<&[Vector; 3]>::try_from),
    ) {
        return factors_of_geometry(a, b, signs, [p, q], [v, w]);
    }
    factors_of_geometry(a, b, signs, points, tangents)
}

#[inline(always)]
fn factors_of_geometry(
    a: &Node,
    b: &Node,
    signs: Signs,
    [points_a, points_b]: [&[Vector]; 2],
    [tangents_a, tangents_b]: [&[Vector]; 2],
) -> Option<[i64; 2]> {
    if has_zero(tangents_a) || has_zero(tangents_b) {
        return None;
    }
    // The chord's components are at most `extent` in magnitude, and each off by `chord_error`.
    let mut extent = 0.0;
    for axis in 0..3 {
        let span = greater(a.high[axis], b.high[axis]) - lesser(a.low[axis], b.low[axis]);
        extent = greater(span, extent);
    }
    let chord_error = a.margin + b.margin;
    let error = |node: &Node, tangents: &[Vector]| {
        let most = tangents.iter().fold(0.0, |most, v| greater(norm1(v), most));
        most * chord_error + 3.0 * extent * node.tangent_error + 8.0 * UNIT * most * extent
    };
    let errors = [error(a, tangents_a), error(b, tangents_b)];
    // Coordinates from here, so that products stay small beside a large common offset.
    let origin = points_a[0];
    let unit = |side: usize, products: &ChordProducts| {
        let sign = products.sign(errors[side])?;
        let mut factors = [0, 0];
        factors[side] = sign;
        (signs[side] == 0 || sign == i64::from(signs[side])).then_some(factors)
    };
    let of_v = ChordProducts::new(points_a, points_b, tangents_a, &origin);
    if let Some(found) = unit(0, &of_v) {
        return Some(found);
    }
    let of_w = ChordProducts::new(points_a, points_b, tangents_b, &origin);
    if let Some(found) = unit(1, &of_w) {
        return Some(found);
    }
    let mut rectangles: SmallVec<[Rectangle; 16]> = SmallVec::new();
    let mut span = Span::default();
    let (v_count, w_count) = (tangents_a.len(), tangents_b.len());
    for (p_v, p_w) in of_v.of_a.chunks_exact(v_count).zip(of_w.of_a.chunks_exact(w_count)) {
        for (q_v, q_w) in of_v.of_b.chunks_exact(v_count).zip(of_w.of_b.chunks_exact(w_count)) {
            let rectangle = Rectangle {
                a: range(p_v, q_v),
                b: range(p_w, q_w),
            };
            if !span.include(&rectangle) {
                return None;
            }
            rectangles.push(rectangle);
        }
    }
    round_bisector(&rectangles, span.bisector()?, errors, signs)
}

/// Least and greatest difference.
#[inline(always)]
fn range(p: &[f64], q: &[f64]) -> [f64; 2] {
    let mut range = [f64::INFINITY, f64::NEG_INFINITY];
    for (x, y) in p.iter().zip(q) {
        range = [lesser(x - y, range[0]), greater(x - y, range[1])];
    }
    range
}

/// Products of points with tangents, all those of a point together; on the stack up to cubics.
type Products = SmallVec<[f64; 16]>;

/// The products p·v and q·v for all p∈H(A), q∈H(B) and the tangents v of one node.
struct ChordProducts {
    of_a: Products,
    of_b: Products,
    /// Least and greatest (p−q)·v.
    range: [f64; 2],
}

#[inline(always)]
fn products(points: &[Vector], tangents: &[Vector], origin: &Vector) -> Products {
    let mut products = Products::from_elem(0.0, points.len() * tangents.len());
    let all = products.as_mut_slice();
    for i in 0..points.len() {
        let local = sub(&points[i], origin);
        for k in 0..tangents.len() {
            all[i * tangents.len() + k] = dot(&local, &tangents[k]);
        }
    }
    products
}

/// Least and greatest product with tangent `k` of `count`.
#[inline(always)]
fn bounds(products: &[f64], count: usize, k: usize) -> [f64; 2] {
    let mut bounds = [products[k], products[k]];
    for i in 1..products.len() / count {
        let product = products[i * count + k];
        bounds = [lesser(product, bounds[0]), greater(product, bounds[1])];
    }
    bounds
}

impl ChordProducts {
    #[inline(always)]
    fn new(points_a: &[Vector], points_b: &[Vector], tangents: &[Vector], origin: &Vector) -> Self {
        let of_a = products(points_a, tangents, origin);
        let of_b = products(points_b, tangents, origin);
        let mut all = [f64::INFINITY, f64::NEG_INFINITY];
        for k in 0..tangents.len() {
            let (p, q) = (bounds(&of_a, tangents.len(), k), bounds(&of_b, tangents.len(), k));
            all = [lesser(p[0] - q[1], all[0]), greater(p[1] - q[0], all[1])];
        }
        ChordProducts { of_a, of_b, range: all }
    }

    /// The sign that all (p−q)·v certainly have.
    #[inline]
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
}

pub(super) fn has_zero(tangents: &[Vector]) -> bool {
    tangents.iter().any(|v| v[0] == 0.0 && v[1] == 0.0 && v[2] == 0.0)
}

/// `not_normal` with one factor 0, by cones and boxes.
fn factors_of_runs(nodes: &Nodes, a: &Node, b: &Node, signs: Signs) -> Option<[i64; 2]> {
    let mut least = [0.0; 3];
    let mut most = [0.0; 3];
    let error = a.margin + b.margin;
    for axis in 0..3 {
        least[axis] = a.low[axis] - b.high[axis] - error;
        most[axis] = a.high[axis] - b.low[axis] + error;
    }
    let center = [least[0] + most[0], least[1] + most[1], least[2] + most[2], 0.0];
    for (side, node) in [a, b].into_iter().enumerate() {
        let cone = nodes.cone(node);
        let sign = if dot(&center, &cone.axis) > 0.0 { 1.0 } else { -1.0 };
        // What fails in the middle of the box fails at a corner.
        if signs[side] < 0 && sign > 0.0 || !cone.all_positive(&center.map(|x| sign * x)) {
            continue;
        }
        let corner = |k: usize| {
            let axis = |i: usize| sign * if k >> i & 1 == 0 { least[i] } else { most[i] };
            [axis(0), axis(1), axis(2), 0.0]
        };
        if (0..8).all(|k| cone.all_positive(&corner(k))) {
            let mut factors = [0i64, 0];
            factors[side] = sign as i64;
            return Some(factors);
        }
    }
    None
}
