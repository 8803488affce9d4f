//! Newton's method for double normals (MP06, equations 1–9), in binary64, along the chain.

use super::float_chain::FloatChain;
use super::vector::{dot, sub};

/// A point of the chain: piece and local parameter.
pub type Location = (usize, f64);

/// A double normal, approximately.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Candidate {
    /// The end that comes first.
    pub s: Location,
    /// The other end.
    pub t: Location,
    /// Its squared length.
    pub squared: f64,
}

/// Steps before giving up.
const STEPS: usize = 12;

/// Looks for a double normal near a pair of parameters.
pub fn double_normal(floats: &FloatChain, s: Location, t: Location) -> Option<Candidate> {
    let (mut s, mut t) = (s, t);
    let mut settled = 0;
    for _ in 0..STEPS {
        let ([p, p1, p2], [q, q1, q2]) = (floats.evaluate(s.0, s.1), floats.evaluate(t.0, t.1));
        let x = sub(&p, &q);
        let (f, g) = (dot(&x, &p1), dot(&x, &q1));
        let jacobian = [
            [dot(&p1, &p1) + dot(&x, &p2), -dot(&p1, &q1)],
            [dot(&p1, &q1), dot(&x, &q2) - dot(&q1, &q1)],
        ];
        let [ds, dt] = step(&jacobian, f, g);
        if !ds.is_finite() || !dt.is_finite() || ds.abs() > 3.0 || dt.abs() > 3.0 {
            return None;
        }
        s = moved(floats, s, s.1 - ds)?;
        t = moved(floats, t, t.1 - dt)?;
        if ds.abs().max(dt.abs()) < 1e-9 {
            settled += 1;
            if settled == 2 {
                return candidate(floats, s, t);
            }
        }
    }
    None
}

/// The Newton step J⁻¹(f, g); where J is nearly singular (a continuum of double normals), the shortest vector that solves the system best.
fn step(jacobian: &[[f64; 2]; 2], f: f64, g: f64) -> [f64; 2] {
    let [[a, b], [c, d]] = *jacobian;
    let determinant = a * d - b * c;
    let size = a * a + b * b + c * c + d * d;
    if determinant.abs() > 1e-7 * size {
        return [(f * d - g * b) / determinant, (g * a - f * c) / determinant];
    }
    // (JᵀJ + λ)⁻¹Jᵀ(f, g) with λ small beside the one large eigenvalue.
    let shift = 1e-9 * size;
    let (p, q, r) = (a * a + c * c + shift, a * b + c * d, b * b + d * d + shift);
    let (u, v) = (a * f + c * g, b * f + d * g);
    let normal = p * r - q * q;
    [(u * r - v * q) / normal, (v * p - u * q) / normal]
}

/// The parameter of a point nearest or farthest from `point`, with all else fixed: the foot of a perpendicular, near `t`.
pub fn foot(floats: &FloatChain, point: &super::vector::Vector, t: Location) -> Option<Location> {
    let mut t = t;
    for _ in 0..STEPS {
        let [q, q1, q2] = floats.evaluate(t.0, t.1);
        let x = sub(&q, point);
        let dt = dot(&x, &q1) / (dot(&q1, &q1) + dot(&x, &q2));
        if !dt.is_finite() || dt.abs() > 3.0 {
            return None;
        }
        t = moved(floats, t, t.1 - dt)?;
        if dt.abs() < 1e-12 {
            return Some(t);
        }
    }
    None
}

/// The location `u` of a piece, on a neighbouring piece if it is outside [0, 1].
fn moved(floats: &FloatChain, (piece, _): Location, u: f64) -> Option<Location> {
    let count = floats.pieces.len();
    if (0.0..=1.0).contains(&u) {
        return Some((piece, u));
    }
    let (next, u) = if u > 1.0 {
        (piece + 1, u - 1.0)
    } else {
        (piece.wrapping_sub(1), u + 1.0)
    };
    if next < count {
        return Some((next, u.clamp(0.0, 1.0)));
    }
    match (floats.closed, piece) {
        (true, 0) if next == usize::MAX => Some((count - 1, u.clamp(0.0, 1.0))),
        (true, _) => Some((0, u.clamp(0.0, 1.0))),
        (false, _) => Some((piece, if next == count { 1.0 } else { 0.0 })),
    }
}

/// Accepts what is orthogonal at both ends and not a point with itself.
fn candidate(floats: &FloatChain, s: Location, t: Location) -> Option<Candidate> {
    let (s, t) = if (s.0, s.1) <= (t.0, t.1) { (s, t) } else { (t, s) };
    let ([p, p1, _], [q, q1, _]) = (floats.evaluate(s.0, s.1), floats.evaluate(t.0, t.1));
    let x = sub(&p, &q);
    let squared = dot(&x, &x);
    let count = floats.pieces.len() as f64;
    let apart = (t.0 as f64 + t.1) - (s.0 as f64 + s.1);
    if apart < 1e-6 || floats.closed && count - apart < 1e-6 {
        return None;
    }
    // Not a chord that collapses towards one point: its length must not vanish beside the speed over that stretch of parameter.
    let orthogonal = |tangent| dot(&x, tangent).powi(2) <= 1e-12 * squared * dot(tangent, tangent);
    (orthogonal(&p1) && orthogonal(&q1)).then_some(Candidate { s, t, squared })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check::chain::Chain;
    use crate::curve::read_curve;

    #[test]
    fn mp06_shortest_double_normal() {
        let text = std::fs::read_to_string("certs/curves/mp06-figure-1.json").unwrap();
        let curve = read_curve(text.as_bytes()).unwrap().curve;
        let chain = Chain::new(&curve).unwrap();
        let floats = FloatChain::new(&chain);
        let found = double_normal(&floats, (0, 0.45), (2, 0.75)).unwrap();
        // MP06 print s = 0.4774 on the first and t = 0.7845 on the third segment, at a distance of 0.4427.
        assert!((found.s.1 - 0.477_368_614_194).abs() < 1e-11);
        assert!((found.t.1 - 0.784_510_932_858).abs() < 1e-11);
        assert!((found.squared.sqrt() - 0.442_675_170_376_606_6).abs() < 1e-14);
    }
}
