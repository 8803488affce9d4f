//! Double normals of a curve in floating point, by sampling and Newton's method: not all, but those reported are there.

use knotproof::curve::{Curve, Joint};
use knotproof::number::{Rational, RationalExt};

type Vector = [f64; 3];

fn dot(a: &Vector, b: &Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn sub(a: &Vector, b: &Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn norm(a: &Vector) -> f64 {
    dot(a, a).sqrt()
}

/// A corner or an end: its point, the direction into it and the one out of it.
struct Vertex {
    piece: usize,
    at_end: bool,
    point: Vector,
    incoming: Option<Vector>,
    outgoing: Option<Vector>,
}

/// A curve's homogeneous control points.
pub struct FloatCurve {
    pieces: Vec<Vec<[f64; 4]>>,
    vertices: Vec<Vertex>,
}

/// Starting points on each piece.
const STARTS: usize = 14;

impl FloatCurve {
    /// In floating point.
    pub fn new(curve: &Curve) -> Self {
        let chain = curve.chain();
        let padded =
            |point: &[Rational]| -> Vector { std::array::from_fn(|i| point.get(i).map_or(0.0, RationalExt::to_f64)) };
        let pieces = chain.pieces().iter().map(|piece| {
            (0..=piece.degree())
                .map(|k| {
                    let w = piece.weights().map_or(1.0, |weights| weights.get(k).to_f64());
                    let [x, y, z] = padded(&piece.point(k));
                    [x * w, y * w, z * w, w]
                })
                .collect()
        });
        let pieces: Vec<Vec<[f64; 4]>> = pieces.collect();
        let mut vertices = Vec::new();
        let count = chain.count();
        for joint in 0..=count {
            let corner = chain.joint(joint) == Some(Joint::Corner);
            let end = !chain.closed() && (joint == 0 || joint == count);
            if !corner && !end {
                continue;
            }
            let before = if joint > 0 {
                Some(joint - 1)
            } else {
                chain.closed().then_some(count - 1)
            };
            let after = if joint < count { Some(joint) } else { None };
            let (piece, at_end) = after.map_or((count - 1, true), |piece| (piece, false));
            let here = &chain.pieces()[piece];
            vertices.push(Vertex {
                piece,
                at_end,
                point: padded(&here.point(if at_end { here.degree() } else { 0 })),
                incoming: before
                    .and_then(|i| chain.pieces()[i].end_direction())
                    .map(|v| padded(&v)),
                outgoing: after
                    .and_then(|i| chain.pieces()[i].start_direction())
                    .map(|v| padded(&v)),
            });
        }
        FloatCurve { pieces, vertices }
    }

    /// c, c', c'' on a piece.
    fn evaluate(&self, piece: usize, u: f64) -> [Vector; 3] {
        let points = &self.pieces[piece];
        let n = points.len() - 1;
        let casteljau = |mut row: Vec<[f64; 4]>| {
            while row.len() > 1 {
                row = row
                    .windows(2)
                    .map(|pair| std::array::from_fn(|i| (1.0 - u) * pair[0][i] + u * pair[1][i]))
                    .collect();
            }
            row.first().copied().unwrap_or([0.0; 4])
        };
        let difference = |row: &[[f64; 4]], factor: f64| -> Vec<[f64; 4]> {
            row.windows(2)
                .map(|pair| std::array::from_fn(|i| factor * (pair[1][i] - pair[0][i])))
                .collect()
        };
        let first = difference(points, n as f64);
        let second = difference(&first, n as f64 - 1.0);
        let [a, b, c] = [casteljau(points.clone()), casteljau(first), casteljau(second)];
        let (w, w1, w2) = (a[3], b[3], c[3]);
        let p: Vector = std::array::from_fn(|i| a[i] / w);
        let p1: Vector = std::array::from_fn(|i| (b[i] - w1 * p[i]) / w);
        let p2: Vector = std::array::from_fn(|i| (c[i] - 2.0 * w1 * p1[i] - w2 * p[i]) / w);
        [p, p1, p2]
    }

    /// Lengths of double normals, each with its two places (piece and local parameter).
    pub fn double_normals(&self, critical: bool) -> Vec<(f64, [(usize, f64); 2])> {
        let mut found = Vec::new();
        for i in 0..self.pieces.len() {
            for j in i..self.pieces.len() {
                for k in 0..STARTS * STARTS {
                    let start = |k: usize| (k as f64 + 0.5) / STARTS as f64;
                    found.extend(self.newton((i, start(k / STARTS)), (j, start(k % STARTS))));
                }
            }
        }
        if critical {
            for (a, vertex) in self.vertices.iter().enumerate() {
                for other in &self.vertices[a + 1..] {
                    let chord = sub(&other.point, &vertex.point);
                    if norm(&chord) > 1e-9
                        && vertex.surely_critical(&other.point)
                        && other.surely_critical(&vertex.point)
                    {
                        found.push((norm(&chord), [vertex.place(), other.place()]));
                    }
                }
                found.extend((0..self.pieces.len()).flat_map(|piece| self.feet(vertex, piece)));
            }
        }
        found
    }

    /// A double normal that Newton's method finds well inside two pieces, where it surely is one.
    fn newton(&self, mut s: (usize, f64), mut t: (usize, f64)) -> Option<(f64, [(usize, f64); 2])> {
        for _ in 0..25 {
            let ([p, p1, p2], [q, q1, q2]) = (self.evaluate(s.0, s.1), self.evaluate(t.0, t.1));
            let x = sub(&p, &q);
            let (f, g) = (dot(&x, &p1), dot(&x, &q1));
            let [[a, b], [c, d]] = [
                [dot(&p1, &p1) + dot(&x, &p2), -dot(&p1, &q1)],
                [dot(&p1, &q1), dot(&x, &q2) - dot(&q1, &q1)],
            ];
            let determinant = a * d - b * c;
            if determinant.abs() < 1e-5 * (a * a + b * b + c * c + d * d) {
                return None;
            }
            let (ds, dt) = ((f * d - g * b) / determinant, (a * g - c * f) / determinant);
            (s.1, t.1) = (s.1 - ds, t.1 - dt);
            if ![s.1, t.1].iter().all(|u| (1e-4..=1.0 - 1e-4).contains(u)) {
                return None;
            }
            if ds.abs() + dt.abs() < 1e-13 {
                let (length, speed) = (norm(&x), norm(&p1).min(norm(&q1)));
                let apart = s.0 != t.0 || (s.1 - t.1).abs() > 1e-3;
                let converged = f.abs() + g.abs() < 1e-10 * length * speed;
                return (apart && length > 1e-3 && speed > 1e-3 && converged).then_some((length, [s, t]));
            }
        }
        None
    }

    /// Chords from a vertex to a foot inside a piece, by the sign of (c(t)−E)·c'(t).
    fn feet(&self, vertex: &Vertex, piece: usize) -> Vec<(f64, [(usize, f64); 2])> {
        let product = |t: f64| {
            let [q, q1, _] = self.evaluate(piece, t);
            dot(&sub(&q, &vertex.point), &q1)
        };
        let mut found = Vec::new();
        for k in 0..64 {
            let (mut low, mut high) = ((k as f64 + 0.01) / 64.02, (k as f64 + 1.01) / 64.02);
            if product(low) * product(high) >= 0.0 {
                continue;
            }
            let rising = product(low) < 0.0;
            for _ in 0..80 {
                let middle = 0.5 * (low + high);
                if (product(middle) < 0.0) == rising {
                    low = middle
                } else {
                    high = middle
                }
            }
            let [q, q1, _] = self.evaluate(piece, low);
            let length = norm(&sub(&q, &vertex.point));
            if length > 1e-3 && norm(&q1) > 1e-3 && vertex.surely_critical(&q) {
                found.push((length, [vertex.place(), (piece, low)]));
            }
        }
        found
    }
}

impl Vertex {
    fn place(&self) -> (usize, f64) {
        (self.piece, if self.at_end { 1.0 } else { 0.0 })
    }

    /// Is the chord to `other` critical here, beyond doubt?
    fn surely_critical(&self, other: &Vector) -> bool {
        let x = sub(other, &self.point);
        let cosine = |v: &Vector| dot(&x, v) / (norm(&x) * norm(v));
        match (&self.incoming, &self.outgoing) {
            (Some(a), Some(b)) => {
                let (a, b) = (cosine(a), cosine(b));
                a * b < 0.0 && a.abs().min(b.abs()) > 1e-9
            }
            (None, Some(v)) => cosine(v) < -1e-9,
            (Some(v), None) => cosine(v) > 1e-9,
            (None, None) => false,
        }
    }
}
