//! Exactly one double normal is shorter than a limit: everything outside a small box of parameters is excluded, and in the box the map (f, g) of
//! MP06's equations (1) and (2) is one-to-one.

use knotproof::claim::msd::Convention;
use knotproof::curve::{Bezier, Curve};
use knotproof::number::{Integer, Rational};

use crate::certified::separation;
use crate::exact::{Point, control_points, dot, fraction, minus, whole};

/// The box is made of parts of this depth.
const DEPTH: u32 = 7;

type Interval = [Rational; 2];

/// What was shown.
pub struct Only {
    /// Is there exactly one?
    pub is_unique: bool,
    /// Pairs of parts that were excluded.
    pub excluded: usize,
    /// The sides of the box, in the pieces' own parameters.
    pub size: [Rational; 2],
}

/// A dyadic part of a piece.
#[derive(Clone)]
struct Part {
    start: Rational,
    end: Rational,
    points: Vec<Point>,
    /// Differences of the control points: a positive multiple of the hodograph's.
    edges: Vec<Point>,
}

impl Part {
    fn new(start: Rational, end: Rational, points: Vec<Point>) -> Part {
        let edges = points.windows(2).map(|pair| minus(&pair[1], &pair[0])).collect();
        Part {
            start,
            end,
            points,
            edges,
        }
    }

    fn halves(&self) -> [Part; 2] {
        let half = fraction(1, 2);
        let middle = (&self.start + &self.end) * &half;
        let mut row = self.points.clone();
        let last = row.len() - 1;
        let (mut left, mut right) = (vec![row[0].clone()], vec![row[last].clone()]);
        for round in (0..last).rev() {
            for k in 0..=round {
                row[k] = row[k].iter().zip(&row[k + 1]).map(|(x, y)| (x + y) * &half).collect();
            }
            left.push(row[0].clone());
            right.push(row[round].clone());
        }
        right.reverse();
        [
            Part::new(self.start.clone(), middle.clone(), left),
            Part::new(middle, self.end.clone(), right),
        ]
    }

    fn inside(&self, interval: &Interval) -> bool {
        interval[0] <= self.start && self.end <= interval[1]
    }
}

/// Looks for double normals of a smooth closed curve that are shorter than `limit`.
pub fn shortest_double_normal(curve: &Curve, limit: &Rational) -> Only {
    let chain = curve.chain();
    assert!(chain.closed());
    let certified = separation(curve, Convention::Smooth);
    let ends = certified.ends.as_ref().expect("a box of parameters");
    assert!(certified.squared()[1] < limit * limit);
    // Three parts around each end.
    let scale = Rational::from_integer(Integer::ONE << DEPTH);
    let around = |end: &[Rational; 2]| -> Interval {
        let cell = (&end[0] * &scale).floor();
        [(&cell - whole(1)) / &scale, (cell + whole(2)) / &scale]
    };
    let target = [around(&ends[0]), around(&ends[1])];
    assert!((0..2).all(|i| target[i][0] <= ends[i][0] && ends[i][1] <= target[i][1]));
    let parts: Vec<Part> = (0..chain.count())
        .map(|i| Part::new(whole(i as i64), whole(i as i64 + 1), control_points(&chain.pieces()[i])))
        .collect();
    let mut stack: Vec<(Part, Part)> = Vec::new();
    for i in 0..parts.len() {
        stack.extend((i..parts.len()).map(|j| (parts[i].clone(), parts[j].clone())));
    }
    let total = whole(chain.count() as i64);
    let limit_squared = limit * limit;
    let mut excluded = 0;
    while let Some((a, b)) = stack.pop() {
        if is_far(&a, &b, &limit_squared) || is_not_normal(&a, &b) || is_cone(&a, &b, &total) {
            excluded += 1;
        } else if a.start == b.start && a.end == b.end {
            let [left, right] = a.halves();
            stack.extend([
                (left.clone(), left.clone()),
                (left, right.clone()),
                (right.clone(), right),
            ]);
        } else if !(a.inside(&target[0]) && b.inside(&target[1])) {
            assert!(stack.len() < 10_000, "too many pairs of parts");
            match &a.end - &a.start >= &b.end - &b.start {
                true => stack.extend(a.halves().map(|half| (half, b.clone()))),
                false => stack.extend(b.halves().map(|half| (a.clone(), half))),
            }
        }
    }
    let pieces = [0, 1].map(|i| target[i][0].to_integer().to_u64().expect("a piece") as usize);
    Only {
        is_unique: is_one_to_one(chain.pieces(), pieces, &target),
        excluded,
        size: target.map(|[start, end]| end - start),
    }
}

/// The boxes of the control points are at least the limit apart.
fn is_far(a: &Part, b: &Part, limit_squared: &Rational) -> bool {
    let gaps = differences(&a.points, &b.points)
        .into_iter()
        .map(|[low, high]| match () {
            () if low.numer().is_positive() => low,
            () if high.numer().is_negative() => -high,
            () => whole(0),
        });
    gaps.fold(whole(0), |sum, gap| sum + &gap * &gap) >= *limit_squared
}

/// No chord is orthogonal to both tangents: a combination of the two products has one sign (docs/approximation.md, Theorem 3 (x)).
fn is_not_normal(a: &Part, b: &Part) -> bool {
    let x = differences(&a.points, &b.points);
    let (v, w) = (boxed(&a.edges), boxed(&b.edges));
    let tests: [(i64, i64); 4] = [(1, 0), (0, 1), (1, 1), (1, -1)];
    tests.iter().any(|(alpha, beta)| {
        let combined: Vec<Interval> = v
            .iter()
            .zip(&w)
            .map(|(v, w)| sum(&scaled(v, *alpha), &scaled(w, *beta)))
            .collect();
        is_definite(&interval_dot(&x, &combined))
    })
}

/// Equal or touching parts whose tangents are within a right angle of each other (Theorem 3 (a)).
fn is_cone(a: &Part, b: &Part, total: &Rational) -> bool {
    let meets = |x: &Rational, y: &Rational| x == y || (x - y == *total);
    let touch = a.start == b.start || meets(&a.end, &b.start) || meets(&b.end, &a.start);
    let all: Vec<&Point> = a.edges.iter().chain(&b.edges).collect();
    touch && all.iter().all(|v| all.iter().all(|w| dot(v, w).numer().is_positive()))
}

/// The determinant of the Jacobian (4), its entries taken at independent points of the box, is not 0: by the mean value theorem, row by row, (f, g) takes no
/// value twice.
fn is_one_to_one(pieces: &[Bezier], numbers: [usize; 2], target: &[Interval; 2]) -> bool {
    let enclosed = |i: usize| -> [Vec<Interval>; 3] {
        let offset = whole(numbers[i] as i64);
        let (from, to) = (&target[i][0] - &offset, &target[i][1] - &offset);
        let piece = &pieces[numbers[i]];
        let n = piece.degree();
        let points: Vec<Point> = (0..=n)
            .map(|k| {
                let arguments: Vec<Rational> = (0..n)
                    .map(|j| if j < n - k { from.clone() } else { to.clone() })
                    .collect();
                piece.blossom(&arguments)
            })
            .collect();
        let derivative = |points: &[Point], degree: usize| -> Vec<Point> {
            let factor = whole(degree as i64) / (&to - &from);
            let edges = points.windows(2).map(|pair| minus(&pair[1], &pair[0]));
            edges.map(|edge| edge.iter().map(|x| x * &factor).collect()).collect()
        };
        let first = derivative(&points, n);
        let second = derivative(&first, n - 1);
        [boxed(&points), boxed(&first), boxed(&second)]
    };
    let ([p, p1, p2], [q, q1, q2]) = (enclosed(0), enclosed(1));
    let x: Vec<Interval> = p.iter().zip(&q).map(|(p, q)| sum(p, &scaled(q, -1))).collect();
    let cross = interval_dot(&p1, &q1);
    let fs = sum(&interval_dot(&x, &p2), &interval_dot(&p1, &p1));
    let gt = sum(&interval_dot(&x, &q2), &scaled(&interval_dot(&q1, &q1), -1));
    // f_t = −c'(s)·c'(t) = −g_s.
    is_definite(&sum(&product(&fs, &gt), &product(&cross, &cross)))
}

fn boxed(points: &[Point]) -> Vec<Interval> {
    let axis = |i: usize| {
        let all = || points.iter().map(|p| p[i].clone());
        [all().min().expect("points"), all().max().expect("points")]
    };
    (0..points[0].len()).map(axis).collect()
}

fn differences(p: &[Point], q: &[Point]) -> Vec<Interval> {
    boxed(p)
        .iter()
        .zip(&boxed(q))
        .map(|(p, q)| sum(p, &scaled(q, -1)))
        .collect()
}

fn sum(x: &Interval, y: &Interval) -> Interval {
    [&x[0] + &y[0], &x[1] + &y[1]]
}

fn scaled(x: &Interval, factor: i64) -> Interval {
    let mut ends = x.clone().map(|end| end * whole(factor));
    ends.sort();
    ends
}

fn product(x: &Interval, y: &Interval) -> Interval {
    let mut ends = [&x[0] * &y[0], &x[0] * &y[1], &x[1] * &y[0], &x[1] * &y[1]];
    ends.sort();
    let [low, _, _, high] = ends;
    [low, high]
}

fn interval_dot(x: &[Interval], y: &[Interval]) -> Interval {
    let zero = [whole(0), whole(0)];
    x.iter().zip(y).fold(zero, |total, (x, y)| sum(&total, &product(x, y)))
}

fn is_definite(x: &Interval) -> bool {
    x[0].numer().is_positive() || x[1].numer().is_negative()
}
