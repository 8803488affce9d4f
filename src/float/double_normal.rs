//! Newton's method for double normals (Moore and Peters 2006, equations 1–9) along the pieces of a curve.

use super::piece::{Pieces, Vector, dot, sub};

/// A point of a curve: piece and local parameter.
pub(super) type Location = (usize, f64);

/// A double normal, approximately.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    /// The end that comes first.
    pub(super) s: Location,
    /// The other end.
    pub(super) t: Location,
    /// Its length.
    pub(super) length: f64,
}

/// Steps before giving up.
const STEPS: usize = 14;

/// Looks for a double normal near a pair of parameters.
pub(super) fn find(pieces: &Pieces, mut s: Location, mut t: Location) -> Option<Candidate> {
    let mut settled = false;
    for _ in 0..STEPS {
        let ([p, p1, p2], [q, q1, q2]) = (pieces.all[s.0].evaluate(s.1), pieces.all[t.0].evaluate(t.1));
        let x = sub(&p, &q);
        let cross = dot(&p1, &q1);
        let jacobian = [
            [dot(&p1, &p1) + dot(&x, &p2), -cross],
            [cross, dot(&x, &q2) - dot(&q1, &q1)],
        ];
        let speeds = [dot(&p1, &p1).sqrt(), dot(&q1, &q1).sqrt()];
        let [ds, dt] = step(&jacobian, [dot(&x, &p1), dot(&x, &q1)], speeds);
        // NaN is not less.
        if !(ds.abs() < 3.0 && dt.abs() < 3.0) {
            return None;
        }
        s = moved(pieces, s.0, s.1 - ds);
        t = moved(pieces, t.0, t.1 - dt);
        if settled {
            return accepted(pieces, s, t);
        }
        // From here one more step is exact to rounding.
        settled = ds.abs().max(dt.abs()) < 1e-8;
    }
    None
}

/// The Newton step J⁻¹(f, g), with arc lengths in place of the two parameters, whose speeds may be far apart; where J is nearly singular (a continuum of
/// double normals), the shortest vector that solves the system best.
pub(super) fn step(jacobian: &[[f64; 2]; 2], right: [f64; 2], speeds: [f64; 2]) -> [f64; 2] {
    let [[a, b], [c, d]] = *jacobian;
    let [r, s] = speeds;
    let (a, b, c, d) = (a / r / r, b / r / s, c / r / s, d / s / s);
    let (f, g) = (right[0] / r, right[1] / s);
    let determinant = a * d - b * c;
    let size = a * a + b * b + c * c + d * d;
    let [x, y] = if determinant.abs() > 1e-9 * size {
        [(f * d - g * b) / determinant, (g * a - f * c) / determinant]
    } else {
        // (JᵀJ + λ)⁻¹Jᵀ(f, g) with λ small beside the one large eigenvalue.
        let shift = 1e-11 * size;
        let (p, q, t) = (a * a + c * c + shift, a * b + c * d, b * b + d * d + shift);
        let (u, v) = (a * f + c * g, b * f + d * g);
        let normal = p * t - q * q;
        [(u * t - v * q) / normal, (v * p - u * q) / normal]
    };
    [x / r, y / s]
}

/// The location u of a piece, on a neighbouring piece if it is outside [0, 1]; on an open curve at its end if there is none.
pub(super) fn moved(pieces: &Pieces, piece: usize, u: f64) -> Location {
    let count = pieces.all.len();
    if (0.0..=1.0).contains(&u) {
        return (piece, u);
    }
    let length = |i: usize| pieces.all[i].ends.1 - pieces.all[i].ends.0;
    let next = match (u > 1.0, piece) {
        (true, i) if i + 1 < count => i + 1,
        (true, _) if pieces.closed => 0,
        (false, i) if i > 0 => i - 1,
        (false, _) if pieces.closed => count - 1,
        _ => return (piece, u.clamp(0.0, 1.0)),
    };
    // The excess in the parameter of the neighbour.
    let ratio = length(piece) / length(next);
    if u > 1.0 {
        (next, ((u - 1.0) * ratio).min(1.0))
    } else {
        (next, (1.0 + u * ratio).max(0.0))
    }
}

/// Accepts what is orthogonal at both ends and not a point with itself.
fn accepted(pieces: &Pieces, s: Location, t: Location) -> Option<Candidate> {
    let (s, t) = if (s.0, s.1) <= (t.0, t.1) { (s, t) } else { (t, s) };
    let apart = (t.0 as f64 + t.1) - (s.0 as f64 + s.1);
    if apart < 1e-6 || pieces.closed && pieces.all.len() as f64 - apart < 1e-6 {
        return None;
    }
    let ([p, p1, _], [q, q1, _]) = (pieces.all[s.0].evaluate(s.1), pieces.all[t.0].evaluate(t.1));
    let x = sub(&p, &q);
    let length = dot(&x, &x).sqrt();
    // Both products have an error of some units in the last place of the coordinates.
    let noise = 64.0 * f64::EPSILON * pieces.scale;
    if length <= noise && apart < 1e-3 {
        // Rounding, as beside a cusp, rather than a point where the curve meets itself.
        return None;
    }
    let orthogonal =
        |tangent: &Vector| dot(&x, tangent).abs() <= (1e-10 * length + noise) * dot(tangent, tangent).sqrt();
    (orthogonal(&p1) && orthogonal(&q1)).then_some(Candidate { s, t, length })
}
