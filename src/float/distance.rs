//! The distance of two curves: branch and bound on the tensor Bernstein coefficients of the squared distance of two pieces, then Newton's method.

use std::collections::BinaryHeap;

use super::FloatError;
use super::bound::{Least, flat};
use super::curve::Curve;
use super::double_normal::step;
use super::piece::{Piece, Pieces, Vector, affine, binomials, dot, middle, sub};

/// A shortest connection of two curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Connection {
    /// Its length.
    pub distance: f64,
    /// The parameter of its end on the one curve.
    pub parameter: f64,
    /// The parameter of its end on the other curve.
    pub other_parameter: f64,
    /// Down to this length the search has excluded a shorter one, up to rounding: about `distance`, or less where the search ended early.
    pub lower: f64,
}

/// Rectangles of parameters before the search ends early.
const BUDGET: usize = 100_000;
/// Relative width of the squared distance that a search may leave that ends early.
const GREATEST_WIDTH: f64 = 1e-6;
/// Equally near places that are looked at more closely.
const MOST_CANDIDATES: usize = 64;
/// Relative width of the squared distance at which the search ends.
const WIDTH: f64 = 1e-13;

/// A rectangle of local parameters of two pieces.
struct Rectangle {
    pieces: (usize, usize),
    start: (f64, f64),
    width: (f64, f64),
    /// Coefficients of D and W, row by row: the parameter of the second piece runs fastest. Empty until needed.
    coefficients: Vec<[f64; 2]>,
    columns: usize,
}

impl Curve {
    /// The least distance to another curve of the same dimension, ends included, and where it is attained; one place if there are several.
    ///
    /// # Errors
    /// [`FloatError::Dimension`]; [`FloatError::Budget`] when 100,000 rectangles do not suffice to bring [`Connection::lower`] within 10⁻⁶ of the distance.
    /// Where curves run side by side at a constant distance, such as concentric arcs, the search ends early.
    pub fn distance_to(&self, other: &Curve) -> Result<Connection, FloatError> {
        if self.dimension != other.dimension {
            return Err(FloatError::Dimension);
        }
        let (one, two) = (middle(self), middle(other));
        let origin: Vector = std::array::from_fn(|i| one[i] / 2.0 + two[i] / 2.0);
        let search = Search {
            first: Pieces::new(self, &origin),
            second: Pieces::new(other, &origin),
        };
        let mut result: Option<Connection> = None;
        let (places, lower) = search.places()?;
        for (pieces, u) in places {
            for (u, v) in [u, search.polish(pieces, u)] {
                let s = search.first.all[pieces.0].parameter(u);
                let t = search.second.all[pieces.1].parameter(v);
                let distance = self.accurate_distance(s, other, t)?;
                if result.is_none_or(|best| distance < best.distance) {
                    result = Some(Connection {
                        distance,
                        parameter: s,
                        other_parameter: t,
                        lower: lower.min(distance),
                    });
                }
            }
        }
        result.ok_or(FloatError::Budget)
    }
}

struct Search {
    first: Pieces,
    second: Pieces,
}

/// Two pieces, and a local parameter on each.
type Place = ((usize, usize), (f64, f64));

impl Search {
    /// The places where the distance is least, up to rounding, and the bound reached.
    fn places(&self) -> Result<(Vec<Place>, f64), FloatError> {
        let scale = self.first.scale.max(self.second.scale);
        let rounding = 32.0 * f64::EPSILON * scale * scale;
        let (mut best, mut best_place) = self.upper_bound();
        let mut heap = BinaryHeap::new();
        let boxes = |pieces: &Pieces| -> Vec<(Vector, Vector)> { pieces.all.iter().map(extent).collect() };
        let (one, two) = (boxes(&self.first), boxes(&self.second));
        for (i, a) in one.iter().enumerate() {
            for (j, b) in two.iter().enumerate() {
                let gap: Vector = std::array::from_fn(|k| (a.0[k] - b.1[k]).max(b.0[k] - a.1[k]).max(0.0));
                let lower = dot(&gap, &gap);
                if lower <= best + rounding {
                    heap.push(Least(lower, whole((i, j))));
                }
            }
        }
        let mut places = Vec::new();
        let mut budget = BUDGET;
        let mut bound = f64::INFINITY;
        while let Some(Least(lower, mut rectangle)) = heap.pop() {
            if lower > best - WIDTH * best + rounding || places.len() == MOST_CANDIDATES {
                break;
            }
            if rectangle.coefficients.is_empty() {
                let (a, b) = (
                    &self.first.all[rectangle.pieces.0],
                    &self.second.all[rectangle.pieces.1],
                );
                (rectangle.coefficients, rectangle.columns) = squared(a, b);
                let (least, _) = range(&rectangle.coefficients);
                let (value, place) = rectangle.at_corners();
                if value < best {
                    (best, best_place) = (value, place);
                }
                heap.push(Least(lower.max(least), rectangle));
                continue;
            }
            let (least, most) = range(&rectangle.coefficients);
            let middle = (
                rectangle.start.0 + rectangle.width.0 / 2.0,
                rectangle.start.1 + rectangle.width.1 / 2.0,
            );
            if best <= 4.0 * rounding && least <= best {
                // As good as 0: if it really is, nothing can be nearer.
                let (u, v) = self.polish(rectangle.pieces, middle);
                let x = self.chord(rectangle.pieces, (u, v));
                if dot(&x, &x).sqrt() <= 8.0 * f64::EPSILON * scale {
                    return Ok((vec![(rectangle.pieces, (u, v))], 0.0));
                }
            }
            if flat(least, most, rounding) || rectangle.width.0.max(rectangle.width.1) < 2f64.powi(-50) {
                places.push((rectangle.pieces, middle));
                continue;
            }
            budget -= 1;
            if budget == 0 {
                if lower < best * (1.0 - GREATEST_WIDTH) {
                    return Err(FloatError::Budget);
                }
                bound = lower;
                break;
            }
            for half in rectangle.halves() {
                let (value, place) = half.at_corners();
                if value < best {
                    (best, best_place) = (value, place);
                }
                let (least, _) = range(&half.coefficients);
                if least <= best + rounding {
                    heap.push(Least(least, half));
                }
            }
        }
        places.push(best_place);
        Ok((places, bound.min(best).max(0.0).sqrt()))
    }

    /// The squared distance of the nearest two ends of pieces, and where it is.
    fn upper_bound(&self) -> (f64, Place) {
        let ends = |pieces: &Pieces| -> Vec<(usize, f64, Vector)> {
            let first = (0, 0.0, affine(&pieces.all[0].control[0]));
            let last = pieces.all.iter().enumerate();
            let last = last.map(|(i, piece)| (i, 1.0, affine(&piece.control[piece.degree()])));
            std::iter::once(first).chain(last).collect()
        };
        let (one, two) = (ends(&self.first), ends(&self.second));
        let mut least = (f64::INFINITY, ((0, 0), (0.0, 0.0)));
        for (i, u, p) in &one {
            for (j, v, q) in &two {
                let x = sub(p, q);
                let square = dot(&x, &x);
                if square < least.0 {
                    least = (square, ((*i, *j), (*u, *v)));
                }
            }
        }
        least
    }

    fn chord(&self, pieces: (usize, usize), (u, v): (f64, f64)) -> Vector {
        let [p, ..] = self.first.all[pieces.0].evaluate(u);
        let [q, ..] = self.second.all[pieces.1].evaluate(v);
        sub(&p, &q)
    }

    /// Newton's method for the least distance of two pieces, from a place near it, within their ends.
    fn polish(&self, pieces: (usize, usize), (mut u, mut v): (f64, f64)) -> (f64, f64) {
        for _ in 0..12 {
            let [p, p1, p2] = self.first.all[pieces.0].evaluate(u);
            let [q, q1, q2] = self.second.all[pieces.1].evaluate(v);
            let x = sub(&p, &q);
            // The gradient and the Hessian of half the squared distance.
            let (f, g) = (dot(&x, &p1), -dot(&x, &q1));
            let (a, b, d) = (
                dot(&p1, &p1) + dot(&x, &p2),
                -dot(&p1, &q1),
                dot(&q1, &q1) - dot(&x, &q2),
            );
            let held_u = u == 0.0 && f > 0.0 || u == 1.0 && f < 0.0;
            let held_v = v == 0.0 && g > 0.0 || v == 1.0 && g < 0.0;
            let [du, dv] = match (held_u, held_v) {
                (true, true) => return (u, v),
                (true, false) => [0.0, g / d],
                (false, true) => [f / a, 0.0],
                (false, false) => step(&[[a, b], [b, d]], [f, g], [dot(&p1, &p1).sqrt(), dot(&q1, &q1).sqrt()]),
            };
            if !du.is_finite() || !dv.is_finite() {
                return (u, v);
            }
            let next = ((u - du).clamp(0.0, 1.0), (v - dv).clamp(0.0, 1.0));
            if (next.0 - u).abs().max((next.1 - v).abs()) < 1e-17 {
                return next;
            }
            (u, v) = next;
        }
        (u, v)
    }
}

fn whole(pieces: (usize, usize)) -> Rectangle {
    Rectangle {
        pieces,
        start: (0.0, 0.0),
        width: (1.0, 1.0),
        coefficients: Vec::new(),
        columns: 0,
    }
}

impl Rectangle {
    /// The least value at its four corners, and where it is.
    fn at_corners(&self) -> (f64, Place) {
        let (n, m) = (self.coefficients.len(), self.columns);
        let mut least = (f64::INFINITY, (self.pieces, self.start));
        for (i, u, v) in [(0, 0.0, 0.0), (m - 1, 0.0, 1.0), (n - m, 1.0, 0.0), (n - 1, 1.0, 1.0)] {
            let c = self.coefficients[i];
            if c[0] / c[1] < least.0 {
                let place = (self.start.0 + u * self.width.0, self.start.1 + v * self.width.1);
                least = (c[0] / c[1], (self.pieces, place));
            }
        }
        least
    }

    /// Two halves, across the parameter along which the coefficients change more.
    fn halves(self) -> [Rectangle; 2] {
        let m = self.columns;
        let change = |a: &[f64; 2], b: &[f64; 2]| (a[0] / a[1] - b[0] / b[1]).abs();
        let along_rows = self.coefficients.chunks_exact(m).flat_map(|row| row.windows(2));
        let second: f64 = along_rows.map(|pair| change(&pair[0], &pair[1])).fold(0.0, f64::max);
        let below = self.coefficients.iter().zip(&self.coefficients[m..]);
        let first: f64 = below.map(|(a, b)| change(a, b)).fold(0.0, f64::max);
        let across_first = first * (self.coefficients.len() / m - 1) as f64 >= second * (m - 1) as f64;
        let mut right = self.coefficients;
        let left = if across_first {
            halve(&mut right, m, m)
        } else {
            halve(&mut right, 1, m)
        };
        let (mut width, mut start) = (self.width, self.start);
        if across_first {
            width.0 /= 2.0;
            start.0 += width.0;
        } else {
            width.1 /= 2.0;
            start.1 += width.1;
        }
        let (pieces, columns) = (self.pieces, m);
        [(left, self.start), (right, start)].map(|(coefficients, start)| Rectangle {
            pieces,
            start,
            width,
            coefficients,
            columns,
        })
    }
}

/// De Casteljau's algorithm along rows (`stride` 1) or columns (`stride` = `columns`): the left half; the right one takes the place of the whole.
fn halve(all: &mut [[f64; 2]], stride: usize, columns: usize) -> Vec<[f64; 2]> {
    let mut left = all.to_vec();
    let (lines, n) = if stride == 1 {
        (all.len() / columns, columns)
    } else {
        (columns, all.len() / columns)
    };
    for line in 0..lines {
        let first = if stride == 1 { line * columns } else { line };
        for round in 1..=n {
            left[first + (round - 1) * stride] = all[first];
            for j in 0..n - round {
                let (a, b) = (all[first + j * stride], all[first + (j + 1) * stride]);
                all[first + j * stride] = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
            }
        }
    }
    left
}

/// The least and greatest ratio.
fn range(coefficients: &[[f64; 2]]) -> (f64, f64) {
    super::bound::ratios(coefficients).0
}

fn extent(piece: &Piece) -> (Vector, Vector) {
    let start = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    piece.control.iter().map(affine).fold(start, |(low, high), p| {
        (
            std::array::from_fn(|i| low[i].min(p[i])),
            std::array::from_fn(|i| high[i].max(p[i])),
        )
    })
}

/// The coefficients of |X(u) v(t) − Y(t) w(u)|² and w²v², and the number of columns.
fn squared(a: &Piece, b: &Piece) -> (Vec<[f64; 2]>, usize) {
    let (n, m) = (a.degree(), b.degree());
    let products = |control: &[[f64; 4]]| -> Vec<Vec<(f64, usize, usize)>> {
        // For each k the pairs i + j = k with C(n, i) C(n, j) / C(2n, k).
        let n = control.len() - 1;
        let (row, total) = (binomials(n), binomials(2 * n));
        (0..=2 * n)
            .map(|k| {
                let pairs = k.saturating_sub(n)..=k.min(n);
                pairs.map(|i| (row[i] * row[k - i] / total[k], i, k - i)).collect()
            })
            .collect()
    };
    let (first, second) = (products(&a.control), products(&b.control));
    // Differences of homogeneous points, exact to rounding whatever the cancellation.
    let chord = |i: usize, j: usize| -> Vector {
        let (p, q) = (&a.control[i], &b.control[j]);
        std::array::from_fn(|k| p[k] * q[3] - q[k] * p[3])
    };
    let chords: Vec<Vector> = (0..=n)
        .flat_map(|i| (0..=m).map(move |j| (i, j)))
        .map(|(i, j)| chord(i, j))
        .collect();
    let mut all = Vec::with_capacity((2 * n + 1) * (2 * m + 1));
    for rows in &first {
        for columns in &second {
            let mut sum = [0.0; 2];
            for (f, i, i2) in rows {
                for (g, j, j2) in columns {
                    sum[0] += f * g * dot(&chords[i * (m + 1) + j], &chords[i2 * (m + 1) + j2]);
                    sum[1] += f * g * a.control[*i][3] * a.control[*i2][3] * b.control[*j][3] * b.control[*j2][3];
                }
            }
            all.push(sum);
        }
    }
    (all, 2 * m + 1)
}
