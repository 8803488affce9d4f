//! The curve in binary64, for searching.

use crate::check::values::pieces::Pieces;
use crate::number::RationalExt;

/// A vector; the third coordinate of a planar one is 0.
pub type Vector = [f64; 3];

/// a − b.
pub fn sub(a: &Vector, b: &Vector) -> Vector {
    [0, 1, 2].map(|i| a[i] - b[i])
}

/// a·b.
pub fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// |a − b|².
pub fn squared(a: &Vector, b: &Vector) -> f64 {
    let difference = sub(a, b);
    dot(&difference, &difference)
}

/// Pieces by their homogeneous control points.
pub struct FloatCurve {
    pieces: Vec<Vec<[f64; 4]>>,
}

/// A place on a curve: a piece and a local parameter.
pub type Place = (usize, f64);

impl FloatCurve {
    /// Rounded.
    pub fn new(pieces: &Pieces) -> FloatCurve {
        let rounded = pieces.pieces.iter().map(|piece| {
            let weights = piece.weights();
            (0..=piece.degree())
                .map(|k| {
                    let mut point = [0.0, 0.0, 0.0, weights[k].to_f64()];
                    for (axis, x) in piece.control_point(k).iter().enumerate() {
                        point[axis] = x.to_f64() * point[3];
                    }
                    point
                })
                .collect()
        });
        FloatCurve {
            pieces: rounded.collect(),
        }
    }

    /// How far apart two control points are on an axis, at most.
    pub fn size(&self) -> f64 {
        let points = || self.pieces.iter().flatten();
        (0..3)
            .map(|axis| {
                let along = || points().map(|point| point[axis] / point[3]);
                along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
            })
            .fold(0.0, f64::max)
    }

    /// c, c' and c'' with respect to the local parameter.
    pub fn at(&self, (piece, u): Place) -> [Vector; 3] {
        let mut row = self.pieces[piece].clone();
        let n = row.len() - 1;
        // Second differences are of the row before the row before the last.
        let mut lifted = [[0.0; 4]; 3];
        for round in (1..=n).rev() {
            if round == 2 {
                let factor = (n * (n - 1)) as f64;
                lifted[2] = [0, 1, 2, 3].map(|i| factor * (row[2][i] - 2.0 * row[1][i] + row[0][i]));
            }
            if round == 1 {
                lifted[1] = [0, 1, 2, 3].map(|i| n as f64 * (row[1][i] - row[0][i]));
            }
            for k in 0..round {
                row[k] = [0, 1, 2, 3].map(|i| (1.0 - u) * row[k][i] + u * row[k + 1][i]);
            }
        }
        lifted[0] = row[0];
        let w = [lifted[0][3], lifted[1][3], lifted[2][3]];
        let c = [0, 1, 2].map(|i| lifted[0][i] / w[0]);
        let first = [0, 1, 2].map(|i| (lifted[1][i] - w[1] * c[i]) / w[0]);
        let second = [0, 1, 2].map(|i| (lifted[2][i] - 2.0 * w[1] * first[i] - w[2] * c[i]) / w[0]);
        [c, first, second]
    }

    /// The point.
    pub fn point(&self, place: Place) -> Vector {
        self.at(place)[0]
    }

    /// About `count` places, evenly spread over the pieces, the ends of pieces among them.
    pub fn samples(&self, count: usize) -> Vec<Place> {
        let each = (count / self.pieces.len()).clamp(1, 64);
        let step = (self.pieces.len() * each / count.max(1)).max(1);
        let last = (self.pieces.len() - 1, 1.0);
        let all = (0..self.pieces.len()).flat_map(|i| (0..each).map(move |k| (i, k as f64 / each as f64)));
        all.step_by(step).chain([last]).collect()
    }

    /// A local minimum of |c − q|² on a piece, from a place on it.
    pub fn nearest(&self, q: &Vector, (piece, start): Place) -> (f64, Place) {
        let value = |u: f64| squared(&self.point((piece, u)), q);
        let mut best = (value(start), start);
        let mut step = 1.0 / 64.0;
        while step > 1e-7 {
            let next = [best.1 - step, best.1 + step].map(|u| u.clamp(0.0, 1.0));
            match next
                .map(|u| (value(u), u))
                .into_iter()
                .min_by(|a, b| a.0.total_cmp(&b.0))
            {
                Some(found) if found.0 < best.0 => best = found,
                _ => step /= 4.0,
            }
        }
        for _ in 0..4 {
            let [c, first, second] = self.at((piece, best.1));
            let x = sub(&c, q);
            let curvature = dot(&first, &first) + dot(&x, &second);
            if curvature <= 0.0 {
                break;
            }
            let u = (best.1 - dot(&x, &first) / curvature).clamp(0.0, 1.0);
            let found = value(u);
            // Near the minimum values cannot tell, but Newton's step is right.
            if found <= best.0 * (1.0 + 1e-14) {
                best = (found, u);
            } else {
                break;
            }
        }
        (best.0, (piece, best.1))
    }

    /// A local minimum of |c − d|² on a pair of pieces, from places on them.
    pub fn approach(&self, other: &FloatCurve, mut s: Place, mut t: Place) -> (f64, Place, Place) {
        for _ in 0..24 {
            let before = (s, t);
            s = self.nearest(&other.point(t), s).1;
            t = other.nearest(&self.point(s), t).1;
            if before == (s, t) {
                break;
            }
        }
        let value = |s: Place, t: Place| squared(&self.point(s), &other.point(t));
        let mut best = value(s, t);
        for _ in 0..6 {
            let ([c, c1, c2], [d, d1, d2]) = (self.at(s), other.at(t));
            let x = sub(&c, &d);
            let (a, b, e) = (
                dot(&c1, &c1) + dot(&x, &c2),
                -dot(&c1, &d1),
                dot(&d1, &d1) - dot(&x, &d2),
            );
            let (g, h) = (dot(&x, &c1), -dot(&x, &d1));
            let determinant = a * e - b * b;
            if a <= 0.0 || determinant <= 0.0 {
                break;
            }
            let next = (
                (s.0, (s.1 - (e * g - b * h) / determinant).clamp(0.0, 1.0)),
                (t.0, (t.1 - (a * h - b * g) / determinant).clamp(0.0, 1.0)),
            );
            let found = value(next.0, next.1);
            if found > best * (1.0 + 1e-14) {
                break;
            }
            (s, t) = next;
            best = found;
        }
        (best, s, t)
    }
}
