//! The shortest double normal of a polygon, exactly, by looking at all pairs of sides and vertices.

use knotproof::number::{Integer, Rational};

type Vector = Vec<Rational>;

fn sub(a: &[Rational], b: &[Rational]) -> Vector {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

fn dot(a: &[Rational], b: &[Rational]) -> Rational {
    a.iter().zip(b).map(|(x, y)| x * y).fold(number(0), |sum, x| sum + x)
}

fn along(p: &[Rational], s: &Rational, d: &[Rational]) -> Vector {
    p.iter().zip(d).map(|(x, y)| x + s * y).collect()
}

fn number(n: i64) -> Rational {
    Rational::from_integer(Integer::from(n))
}

fn in_unit(s: &Rational) -> bool {
    *s >= number(0) && *s <= number(1)
}

/// A polygon through `vertices`; closed when the last is the first. No two consecutive vertices are equal.
pub struct Polygon {
    starts: Vec<Vector>,
    sides: Vec<Vector>,
    closed: bool,
}

impl Polygon {
    /// From its vertices.
    pub fn new(vertices: &[Vector]) -> Self {
        let sides = vertices.windows(2).map(|pair| sub(&pair[1], &pair[0])).collect();
        let closed = vertices.first() == vertices.last();
        Polygon {
            starts: vertices[..vertices.len() - 1].to_vec(),
            sides,
            closed,
        }
    }

    /// The square of σ; `None` when there is no double normal.
    pub fn squared(&self, critical: bool) -> Option<Rational> {
        let mut lengths = Vec::new();
        for i in 0..self.sides.len() {
            for j in i + 1..self.sides.len() {
                lengths.extend(self.between_sides(i, j));
            }
        }
        if critical {
            let vertices = self.vertices();
            for (k, vertex) in vertices.iter().enumerate() {
                lengths.extend(vertices[k + 1..].iter().filter_map(|other| vertex.with_vertex(other)));
                let feet = |i: usize| vertex.with_side(&self.starts[i], &self.sides[i], i);
                lengths.extend((0..self.sides.len()).filter_map(feet));
            }
        }
        lengths.into_iter().min()
    }

    /// The same parameter of the curve: the end of side i and the start of side j?
    fn joined(&self, i: usize, j: usize) -> bool {
        i + 1 == j || self.closed && j == 0 && i + 1 == self.sides.len()
    }

    /// The length² of a chord orthogonal to both sides (all such chords between two sides are equally long).
    fn between_sides(&self, i: usize, j: usize) -> Option<Rational> {
        let (p, d, q, e) = (&self.starts[i], &self.sides[i], &self.starts[j], &self.sides[j]);
        let x = sub(p, q);
        let (dd, de, ee) = (dot(d, d), dot(d, e), dot(e, e));
        let (xd, xe) = (dot(&x, d), dot(&x, e));
        let determinant = &de * &de - &dd * &ee;
        if determinant != number(0) {
            // x·d + s d·d − t d·e = 0, x·e + s d·e − t e·e = 0.
            let s = (&xd * &ee - &xe * &de) / &determinant;
            let t = (&xd * &de - &xe * &dd) / &determinant;
            if !in_unit(&s) || !in_unit(&t) {
                return None;
            }
            let corner = |s: &Rational, end: i64| *s == number(end);
            let same = self.joined(i, j) && corner(&s, 1) && corner(&t, 0)
                || self.joined(j, i) && corner(&t, 1) && corner(&s, 0);
            let chord = sub(&along(p, &s, d), &along(q, &t, e));
            return (!same).then(|| dot(&chord, &chord));
        }
        // Parallel sides: do their projections to the common direction overlap?
        let onto = |point: &[Rational]| dot(&sub(point, p), d) / &dd;
        let (start, end) = (onto(q), onto(&along(q, &number(1), e)));
        let (low, high) = if start <= end { (start, end) } else { (end, start) };
        let (from, to) = (low.max(number(0)), high.min(number(1)));
        if from > to {
            return None;
        }
        let along_d = along(p, &onto(q), d);
        let chord = sub(&along_d, q);
        let squared = dot(&chord, &chord);
        // Two sides on one line that share no more than their common vertex have no chord.
        let touching = from == to && squared == number(0);
        let meet = |a: usize, b: usize| {
            let end = along(&self.starts[a], &number(1), &self.sides[a]);
            self.joined(a, b) && onto(&end) == from
        };
        if touching && (meet(i, j) || meet(j, i)) {
            None
        } else {
            Some(squared)
        }
    }

    fn vertices(&self) -> Vec<Vertex<'_>> {
        let count = self.sides.len();
        let last = along(&self.starts[count - 1], &number(1), &self.sides[count - 1]);
        let mut list: Vec<Vertex> = (0..count)
            .map(|k| {
                let before = if k > 0 {
                    Some(k - 1)
                } else {
                    self.closed.then_some(count - 1)
                };
                Vertex {
                    point: self.starts[k].clone(),
                    before: before.map(|i| (i, &self.sides[i])),
                    after: Some((k, &self.sides[k])),
                }
            })
            .collect();
        if !self.closed {
            list.push(Vertex {
                point: last,
                before: Some((count - 1, &self.sides[count - 1])),
                after: None,
            });
        }
        list
    }
}

struct Vertex<'p> {
    point: Vector,
    before: Option<(usize, &'p Vector)>,
    after: Option<(usize, &'p Vector)>,
}

impl Vertex<'_> {
    /// Is the chord to `other` critical here?
    fn critical(&self, other: &[Rational]) -> bool {
        let x = sub(other, &self.point);
        let at = |side: Option<(usize, &Vector)>| side.map(|(_, d)| dot(&x, d));
        match (at(self.before), at(self.after)) {
            // A vertex without a turn is an ordinary point where both products have one sign or vanish together.
            (Some(a), Some(b)) => a * b <= number(0),
            (None, Some(b)) => b <= number(0),
            (Some(a), None) => a >= number(0),
            (None, None) => false,
        }
    }

    fn with_vertex(&self, other: &Vertex) -> Option<Rational> {
        let chord = sub(&other.point, &self.point);
        (self.critical(&other.point) && other.critical(&self.point)).then(|| dot(&chord, &chord))
    }

    /// The chord to the foot on a side the vertex is not on.
    fn with_side(&self, start: &[Rational], side: &[Rational], number_of_side: usize) -> Option<Rational> {
        let own = |part: Option<(usize, &Vector)>| part.is_some_and(|(i, _)| i == number_of_side);
        if own(self.before) || own(self.after) {
            return None;
        }
        let s = dot(&sub(&self.point, start), side) / dot(side, side);
        let foot = along(start, &s, side);
        let chord = sub(&foot, &self.point);
        (in_unit(&s) && self.critical(&foot)).then(|| dot(&chord, &chord))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn squared(vertices: &[&[i64]], critical: bool) -> Option<Rational> {
        let vertices: Vec<Vector> = vertices
            .iter()
            .map(|point| point.iter().map(|x| number(*x)).collect())
            .collect();
        Polygon::new(&vertices).squared(critical)
    }

    #[test]
    fn known_polygons() {
        let square: [&[i64]; 5] = [&[0, 0], &[1, 0], &[1, 1], &[0, 1], &[0, 0]];
        assert_eq!(
            [false, true].map(|critical| squared(&square, critical)),
            [1, 1].map(|n| Some(number(n)))
        );
        let triangle: [&[i64]; 4] = [&[0, 0], &[4, 0], &[0, 3], &[0, 0]];
        assert_eq!(squared(&triangle, false), None);
        // The altitude on the hypotenuse, 12/5.
        assert_eq!(squared(&triangle, true), Some(number(144) / number(25)));
        let bow: [&[i64]; 4] = [&[-1, -1], &[1, 1], &[1, -1], &[-1, 1]];
        assert_eq!(squared(&bow, false), Some(number(0)));
        let line: [&[i64]; 3] = [&[0, 0, 0], &[1, 1, 2], &[3, 3, 6]];
        assert_eq!([false, true].map(|critical| squared(&line, critical)), [None, None]);
        let folded: [&[i64]; 3] = [&[0, 0], &[3, 0], &[1, 0]];
        assert_eq!(squared(&folded, false), Some(number(0)));
        // Skew sides at distance 2.
        let skew: [&[i64]; 4] = [&[-5, 0, 0], &[5, 0, 0], &[0, 5, 2], &[0, -5, 2]];
        assert_eq!(squared(&skew, false), Some(number(4)));
    }
}
