//! `pedal`: leaves for parts that bend around one point, as on circles, rounded corners and parallel arcs, where double normals come in families.

use crate::check::element::Node as ExactNode;
use crate::check::part::Part;
use crate::check::rule::pedal::Seen;
use crate::claim::tree::Leaf;
use crate::number::{Integer, Rational, RationalExt};
use crate::prove::float_chain::FloatChain;
use crate::prove::newton::Location;
use crate::prove::node::{Kind, Node, Nodes};
use crate::prove::vector::{Vector, dot, sub};

/// What is to be shown of a pair.
pub struct Aim<'a> {
    /// The bound of σ².
    pub lower_squared: &'a Rational,
    /// √ of it.
    pub length: f64,
    /// How much longer the double normals may be.
    pub slack: f64,
}

/// A point z and how far the tangents of two parts are from it.
pub struct Estimate {
    z: [f64; 2],
    /// Of each part: the distance at its start, and the least and greatest deviations from that along it.
    seen: [[f64; 3]; 2],
    /// Are the parts on different sides of z?
    opposite: bool,
}

/// Do two parts seem to bend around one point, far enough apart for a leaf? Quick, since most pairs do not.
pub fn estimate(nodes: &Nodes, a: &Node, b: &Node, aim: &Aim) -> Option<Estimate> {
    let floats = nodes.floats;
    let (s, t) = (a.middle()?, b.middle()?);
    let (of_a, of_b) = (center(floats, s)?, center(floats, t)?);
    let apart = sub(&of_a, &of_b);
    let size = a.diagonal_squared().max(b.diagonal_squared());
    if dot(&apart, &apart) > 0.25 * size {
        return None;
    }
    let z = [(of_a[0] + of_b[0]) / 2.0, (of_a[1] + of_b[1]) / 2.0];
    let around = |node: &Node| -> Option<[f64; 3]> {
        let Kind::Part { piece, index, depth } = node.kind else {
            return None;
        };
        let width = 2f64.powi(-(depth as i32));
        let at = |k: f64| tangent_distance(floats, (piece, (index as f64 + k) * width), &z);
        let start = at(0.0);
        let others = [at(0.25), at(0.5), at(0.75), at(1.0)].map(|distance| distance - start);
        let least = others.iter().copied().fold(0.0, f64::min);
        let greatest = others.iter().copied().fold(0.0, f64::max);
        Some([start, least, greatest])
    };
    let seen = [around(a)?, around(b)?];
    let from = |location: Location| {
        let [point, ..] = floats.evaluate(location.0, location.1);
        [point[0] - z[0], point[1] - z[1], 0.0, 0.0]
    };
    let opposite = dot(&from(s), &from(t)) < 0.0;
    let [of_a, of_b] = seen.map(|[start, least, greatest]| [start + least, start + greatest]);
    let reached = if opposite {
        of_a[0] + of_b[0]
    } else {
        (of_a[0] - of_b[1]).max(of_b[0] - of_a[1])
    };
    (reached > aim.length - 1e-13 * (of_a[1] + of_b[1])).then_some(Estimate { z, seen, opposite })
}

/// The center of curvature at a place of the curve.
fn center(floats: &FloatChain, at: Location) -> Option<Vector> {
    let [point, first, second] = floats.evaluate(at.0, at.1);
    let cross = first[0] * second[1] - first[1] * second[0];
    let factor = dot(&first, &first) / cross;
    let center = [point[0] - first[1] * factor, point[1] + first[0] * factor, 0.0, 0.0];
    center.iter().all(|x| x.is_finite()).then_some(center)
}

/// How far the tangent at a place is from z.
fn tangent_distance(floats: &FloatChain, at: Location, z: &[f64; 2]) -> f64 {
    let [point, first, _] = floats.evaluate(at.0, at.1);
    let cross = (point[0] - z[0]) * first[1] - (point[1] - z[1]) * first[0];
    cross.abs() / dot(&first, &first).sqrt()
}

/// The leaf for an estimate; whether it holds is for the checker's rule to say.
pub fn leaf(nodes: &Nodes, a: &ExactNode, b: &ExactNode, estimate: &Estimate, aim: &Aim) -> Option<Leaf> {
    let (ExactNode::Part(a), ExactNode::Part(b)) = (a, b) else {
        return None;
    };
    let chain = nodes.context.chain;
    let near = |center: &[Rational; 2]| {
        let off = [0, 1].map(|i| center[i].to_f64() - estimate.z[i]);
        off[0].hypot(off[1]) < 1e-6 * aim.length
    };
    // The center of an arc exactly, or the estimate in about 50 bits.
    let exact = [a, b]
        .into_iter()
        .find_map(|part| exact_center(chain, part).filter(near));
    let z = match exact {
        Some(z) => z,
        None => [Rational::from_f64(estimate.z[0])?, Rational::from_f64(estimate.z[1])?],
    };
    let common = z[0].denom().lcm(z[1].denom());
    // Lengths are multiples of 1/r, a small part of the slack.
    let bits = (64.0 / aim.slack).log2().ceil() - (common.bits() as f64 - 1.0);
    let r = common << (bits.clamp(0.0, 2000.0) as u32);
    let z = [0, 1].map(|i| z[i].numer() * r.div_exact(z[i].denom()));
    let needed = ceiling_root(&(Rational::from_integer(&r * &r) * aim.lower_squared));
    let start = |part: &Part| -> Option<Integer> {
        let (distance, unit) = Seen::new(chain, part, [&z[0], &z[1]], &r).squares();
        (!unit[0].is_zero())
            .then(|| (&distance[0] / &unit[0]).sqrt_floor())
            .flatten()
    };
    let scaled = |x: f64| {
        Some(
            (Rational::from_f64(x)? * Rational::from_integer(r.clone()))
                .floor()
                .to_integer(),
        )
    };
    // Deviations between the samples are allowed for, rounding errors of the samples are not deviations.
    let least = |k: usize| -> Option<Integer> {
        let [start_at, least, _] = estimate.seen[k];
        let margin = if -least > 1e-13 * start_at { 1.2 * least } else { 0.0 };
        Some(start([a, b][k])? + scaled(margin)?)
    };
    let greatest = |k: usize| -> Option<Integer> {
        let [start_at, _, greatest] = estimate.seen[k];
        let margin = if greatest > 1e-13 * start_at {
            1.2 * greatest
        } else {
            0.0
        };
        Some(start([a, b][k])? + scaled(margin)? + Integer::from(2))
    };
    let two = Integer::from(2);
    let witness = |l: Integer, m: Integer| Some(Leaf::Pedal(Box::new([z[0].clone(), z[1].clone(), r.clone(), l, m])));
    if estimate.opposite {
        let (l, m) = (least(0)?, least(1)?);
        let surplus = &l + &m - &needed;
        if surplus.is_negative() {
            return None;
        }
        let l = l - surplus / two;
        let m = needed - &l;
        return witness(l, m);
    }
    let outer = if estimate.seen[0][0] > estimate.seen[1][0] {
        0
    } else {
        1
    };
    let (far, near) = (least(outer)?, greatest(1 - outer)?);
    let surplus = &far - &near - &needed;
    if surplus.is_negative() {
        return None;
    }
    let far = far - surplus / two;
    let near = needed - &far;
    if outer == 0 {
        witness(far, near)
    } else {
        witness(near, far)
    }
}

/// The least integer whose square is at least x ≥ 0.
fn ceiling_root(x: &Rational) -> Integer {
    let floor = x.floor().to_integer().sqrt_floor().unwrap_or_default();
    if Rational::from_integer(&floor * &floor) >= *x {
        floor
    } else {
        floor + Integer::from(1)
    }
}

/// Where the normals at the two ends of a part meet, exactly.
fn exact_center(chain: &crate::check::chain::Chain, part: &Part) -> Option<[Rational; 2]> {
    let whole = Part::whole(chain, part.piece);
    let ends = Seen::new(chain, &whole, [&Integer::ZERO, &Integer::ZERO], &Integer::from(1)).ends()?;
    // (z − p)·d = 0 at both ends.
    let [(p, d), (q, e)] = &ends;
    let (f, g) = (&p[0] * &d[0] + &p[1] * &d[1], &q[0] * &e[0] + &q[1] * &e[1]);
    let determinant = &d[0] * &e[1] - &d[1] * &e[0];
    if determinant.numer().is_zero() {
        return None;
    }
    let z = [
        (&f * &e[1] - &g * &d[1]) / &determinant,
        (&d[0] * &g - &e[0] * &f) / &determinant,
    ];
    z.iter().all(|x| x.denom().bits() < 300).then_some(z)
}
