//! MP06's sampling method and its Newton iteration, decided in binary64. Lengths of what they find are then computed exactly.

use std::collections::HashMap;

use knotproof::curve::Chain;
use knotproof::number::{Rational, RationalExt};

use crate::exact::control_points;

type Vector = [f64; 3];

/// A sample: its piece and parameter, point and unit tangent.
pub struct Sample {
    pub piece: usize,
    pub parameter: Rational,
    point: Vector,
    tangent: Vector,
}

/// c, c', c'' of a piece in binary64.
pub struct Piece(Vec<Vector>);

impl Piece {
    pub fn all(chain: &Chain) -> Vec<Piece> {
        let vector = |p: &Vec<Rational>| std::array::from_fn(|axis| p[axis].to_f64());
        let piece = |points: Vec<Vec<Rational>>| Piece(points.iter().map(vector).collect());
        chain
            .pieces()
            .iter()
            .map(|bezier| piece(control_points(bezier)))
            .collect()
    }

    fn evaluate(&self, u: f64) -> [Vector; 3] {
        let n = self.0.len() - 1;
        let mut row = self.0.clone();
        let mut found = [[0.0; 3]; 3];
        for round in (0..=n).rev() {
            // Of the differences after n − k rounds come the derivatives of order k.
            match round {
                2 => {
                    found[2] = scale(
                        &sub(&sub(&row[2], &row[1]), &sub(&row[1], &row[0])),
                        (n * (n - 1)) as f64,
                    )
                }
                1 => found[1] = scale(&sub(&row[1], &row[0]), n as f64),
                _ => {}
            }
            for k in 0..round {
                row[k] = std::array::from_fn(|i| row[k][i] * (1.0 - u) + row[k + 1][i] * u);
            }
        }
        found[0] = row[0];
        found
    }
}

/// Samples of all pieces at the same local parameters.
pub fn samples(pieces: &[Piece], parameters: &[Rational]) -> Vec<Sample> {
    let mut all = Vec::new();
    for (i, piece) in pieces.iter().enumerate() {
        for parameter in parameters {
            let [point, first, _] = piece.evaluate(parameter.to_f64());
            let speed = dot(&first, &first).sqrt();
            all.push(Sample {
                piece: i,
                parameter: parameter.clone(),
                point,
                tangent: scale(&first, 1.0 / speed),
            });
        }
    }
    all
}

/// k/n for 0 < k < n.
pub fn inner_parameters(n: i64) -> Vec<Rational> {
    (1..n).map(|k| Rational::new(k.into(), n.into())).collect()
}

/// A chord from one sample to another with its length and its products with the two unit tangents.
#[derive(Clone, Copy)]
pub struct Found {
    pub length: f64,
    pub ends: [usize; 2],
    pub products: [f64; 2],
}

/// Calls `look` with all chords, in both directions, that are shorter than `reach`.
pub fn short_chords(samples: &[Sample], reach: f64, mut look: impl FnMut(Found)) {
    let cell = |p: &Vector| p.map(|x| (x / reach).floor() as i32);
    let mut cells: HashMap<[i32; 3], Vec<usize>> = HashMap::new();
    for (i, sample) in samples.iter().enumerate() {
        cells.entry(cell(&sample.point)).or_default().push(i);
    }
    for (i, p) in samples.iter().enumerate() {
        let at = cell(&p.point);
        for code in 0..27 {
            let near = [at[0] + code % 3 - 1, at[1] + code / 3 % 3 - 1, at[2] + code / 9 - 1];
            for &j in cells.get(&near).into_iter().flatten().filter(|j| **j > i) {
                let q = &samples[j];
                let x = sub(&q.point, &p.point);
                let length = dot(&x, &x).sqrt();
                if length == 0.0 || length >= reach {
                    continue;
                }
                let products = [dot(&x, &p.tangent) / length, -dot(&x, &q.tangent) / length];
                for (ends, products) in [([i, j], products), ([j, i], [products[1], products[0]])] {
                    look(Found { length, ends, products });
                }
            }
        }
    }
}

/// Which chords are tested, and how.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Test {
    /// As printed, without an absolute value; all chords in both directions.
    Printed,
    /// Magnitudes; all chords in both directions.
    BothWays,
    /// Magnitudes; chords between two segments only from the one with the lower number, as MP06's number of tests has it.
    OneWay,
}

/// The shortest chord shorter than `reach` that passes the doubly normal test.
pub fn shortest(samples: &[Sample], epsilon: [f64; 2], test: Test, reach: f64) -> Option<Found> {
    let mut best: Option<Found> = None;
    short_chords(samples, reach, |found| {
        if test == Test::OneWay && samples[found.ends[0]].piece > samples[found.ends[1]].piece {
            return;
        }
        let passes = |i: usize| {
            let product = match test {
                Test::Printed => found.products[i],
                _ => found.products[i].abs(),
            };
            product < epsilon[i]
        };
        if best.is_none_or(|best| found.length < best.length) && passes(0) && passes(1) {
            best = Some(found);
        }
    });
    best
}

/// What Newton's method does from the chords that pass the test.
#[derive(Default)]
pub struct NewtonRuns {
    pub starts: usize,
    /// How many iterations those took that converged to a chord of two different points.
    pub iterations: Vec<usize>,
    /// The shortest chord found: pieces and parameters.
    pub shortest: Option<(f64, [(usize, f64); 2])>,
}

/// MP06, equations (3) to (9), until a step is shorter than `tolerance`; runs that leave their pieces are given up.
pub fn newton(pieces: &[Piece], samples: &[Sample], epsilon: f64, tolerance: f64) -> NewtonRuns {
    let mut runs = NewtonRuns::default();
    for (i, p) in samples.iter().enumerate() {
        for q in &samples[i + 1..] {
            let x = sub(&q.point, &p.point);
            let limit = epsilon * dot(&x, &x).sqrt();
            if dot(&x, &p.tangent).abs() >= limit || dot(&x, &q.tangent).abs() >= limit {
                continue;
            }
            runs.starts += 1;
            let start = [p.parameter.to_f64(), q.parameter.to_f64()];
            let Some((count, [u, v])) = iterate(&pieces[p.piece], &pieces[q.piece], start, tolerance) else {
                continue;
            };
            if p.piece == q.piece && (u - v).abs() < 10.0 * tolerance {
                continue;
            }
            runs.iterations.push(count);
            let x = sub(&pieces[p.piece].evaluate(u)[0], &pieces[q.piece].evaluate(v)[0]);
            let length = dot(&x, &x).sqrt();
            if runs.shortest.is_none_or(|best| length < best.0) {
                runs.shortest = Some((length, [(p.piece, u), (q.piece, v)]));
            }
        }
    }
    runs
}

fn iterate(a: &Piece, b: &Piece, start: [f64; 2], tolerance: f64) -> Option<(usize, [f64; 2])> {
    let [mut u, mut v] = start;
    for count in 1..=50 {
        let ([p, p1, p2], [q, q1, q2]) = (a.evaluate(u), b.evaluate(v));
        let x = sub(&p, &q);
        let (f, g) = (dot(&x, &p1), dot(&x, &q1));
        let (fs, ft) = (dot(&x, &p2) + dot(&p1, &p1), -dot(&q1, &p1));
        let (gs, gt) = (dot(&p1, &q1), dot(&x, &q2) - dot(&q1, &q1));
        let determinant = fs * gt - ft * gs;
        let (du, dv) = ((gt * f - ft * g) / determinant, (fs * g - gs * f) / determinant);
        (u, v) = (u - du, v - dv);
        if !(0.0..=1.0).contains(&u) || !(0.0..=1.0).contains(&v) {
            return None;
        }
        if (du * du + dv * dv).sqrt() < tolerance {
            return Some((count, [u, v]));
        }
    }
    None
}

fn sub(p: &Vector, q: &Vector) -> Vector {
    std::array::from_fn(|i| p[i] - q[i])
}

fn dot(p: &Vector, q: &Vector) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

fn scale(p: &Vector, factor: f64) -> Vector {
    p.map(|x| x * factor)
}
