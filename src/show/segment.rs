//! A Bézier piece in binary64.

use super::Point;
use crate::curve::Bezier;

/// A Bézier piece with affine control points and weights.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment {
    /// Control points.
    pub points: Vec<Point>,
    /// Weights, none for a polynomial piece.
    pub weights: Vec<f64>,
}

/// A point of a curve with the first two derivatives.
pub(super) struct Jet {
    pub(super) point: Point,
    pub(super) first: Point,
    pub(super) second: Point,
}

impl Segment {
    /// The piece, its numbers rounded to the nearest binary64.
    pub fn new(piece: &Bezier) -> Segment {
        let mut points = vec![[0.0; 3]; piece.degree() + 1];
        for (i, x) in piece.points().to_f64s().into_iter().enumerate() {
            points[i / piece.dimension()][i % piece.dimension()] = x;
        }
        let weights = match piece.weights() {
            Some(weights) if !piece.is_polynomial() => weights.to_f64s(),
            _ => Vec::new(),
        };
        Segment { points, weights }
    }

    /// The point at the local parameter `u`, from 0 to 1.
    pub fn point(&self, u: f64) -> Point {
        self.jet(u).point
    }

    /// The polynomial part restricted to `[from, to]` of the local parameter; weights are restricted likewise.
    pub fn part(&self, from: f64, to: f64) -> Segment {
        let homogeneous = self.homogeneous();
        let count = homogeneous.len();
        let blossom = |k: usize| {
            let mut row = homogeneous.clone();
            for round in 1..count {
                let u = if round <= k { to } else { from };
                for i in 0..count - round {
                    row[i] = std::array::from_fn(|axis| (1.0 - u) * row[i][axis] + u * row[i + 1][axis]);
                }
            }
            row[0]
        };
        let rows: Vec<[f64; 4]> = (0..count).map(blossom).collect();
        Segment {
            points: rows.iter().map(|[x, y, z, w]| [x / w, y / w, z / w]).collect(),
            weights: if self.weights.is_empty() {
                Vec::new()
            } else {
                rows.iter().map(|row| row[3]).collect()
            },
        }
    }

    fn homogeneous(&self) -> Vec<[f64; 4]> {
        let weight = |k: usize| self.weights.get(k).copied().unwrap_or(1.0);
        let points = self.points.iter().enumerate();
        points
            .map(|(k, [x, y, z])| {
                let w = weight(k);
                [x * w, y * w, z * w, w]
            })
            .collect()
    }

    /// Point and derivatives by de Casteljau, then the quotient rule.
    pub(super) fn jet(&self, u: f64) -> Jet {
        let mut row = self.homogeneous();
        let n = row.len() - 1;
        // Differences of the rows with one and two steps to go are the derivatives over n and n(n−1).
        let (mut first, mut second) = ([0.0; 4], [0.0; 4]);
        for round in 0..n {
            let last = n - round;
            if last == 2 {
                let factor = (n * (n - 1)) as f64;
                second = std::array::from_fn(|axis| factor * (row[2][axis] - 2.0 * row[1][axis] + row[0][axis]));
            }
            if last == 1 {
                first = std::array::from_fn(|axis| n as f64 * (row[1][axis] - row[0][axis]));
            }
            for i in 0..last {
                row[i] = std::array::from_fn(|axis| (1.0 - u) * row[i][axis] + u * row[i + 1][axis]);
            }
        }
        let [value, w] = [row[0], [row[0][3]; 4]];
        let point: Point = std::array::from_fn(|axis| value[axis] / w[0]);
        let velocity: Point = std::array::from_fn(|axis| (first[axis] - first[3] * point[axis]) / w[0]);
        let acceleration: Point = std::array::from_fn(|axis| {
            (second[axis] - 2.0 * first[3] * velocity[axis] - second[3] * point[axis]) / w[0]
        });
        Jet {
            point,
            first: velocity,
            second: acceleration,
        }
    }

    /// So many points at equal steps of the parameter, both ends among them.
    pub fn samples(&self, count: usize) -> Vec<Point> {
        (0..count).map(|i| self.point(i as f64 / (count - 1) as f64)).collect()
    }
}

impl Jet {
    /// The curvature vector: towards the center of curvature, as long as the curvature. Zero where the curve does not move.
    pub(super) fn curvature_vector(&self) -> Point {
        let speed_squared = dot(&self.first, &self.first);
        if speed_squared == 0.0 {
            return [0.0; 3];
        }
        let along = dot(&self.second, &self.first) / speed_squared;
        std::array::from_fn(|axis| (self.second[axis] - along * self.first[axis]) / speed_squared)
    }
}

pub(super) fn dot(a: &Point, b: &Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn length(a: &Point) -> f64 {
    dot(a, a).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quarter_circle() -> Segment {
        Segment {
            points: vec![[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
            weights: vec![1.0, 1.0, 2.0],
        }
    }

    #[test]
    fn points_of_a_circle_lie_on_it_and_its_curvature_is_one() {
        for i in 0..=10 {
            let jet = quarter_circle().jet(f64::from(i) / 10.0);
            assert!((length(&jet.point) - 1.0).abs() < 1e-14);
            let towards_center = jet.curvature_vector();
            for axis in 0..2 {
                assert!((towards_center[axis] + jet.point[axis]).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_part_is_the_same_curve() {
        let (whole, part) = (quarter_circle(), quarter_circle().part(0.25, 0.75));
        for i in 0..=4 {
            let u = f64::from(i) / 4.0;
            let (a, b) = (part.point(u), whole.point(0.25 + u / 2.0));
            assert!((a[0] - b[0]).abs() < 1e-14 && (a[1] - b[1]).abs() < 1e-14);
        }
    }
}
