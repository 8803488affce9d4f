//! All double normals of a smooth closed polynomial curve, with proof: pairs of parts are excluded, and in each box that is left the map (f, g) of MP06's
//! equations (1) and (2) has exactly one zero, by the operator of Krawczyk (1969).

use knotproof::curve::{Bezier, Curve};
use knotproof::number::{Integer, Rational, RationalExt};

use crate::exact::{Point, control_points, dot, fraction, minus, whole};
use crate::table::Exact;

/// Parts that are at least so small are tried as boxes.
const DEPTH: u32 = 4;
/// Zeros are enclosed to this many bits after the point.
const BITS: u32 = 64;

type Interval = [Rational; 2];

/// A double normal.
pub struct DoubleNormal {
    /// The parameters of its ends, number of the piece and local parameter added.
    pub ends: [Interval; 2],
    pub length: Exact,
}

/// What was shown.
pub struct All {
    /// The double normals, the shortest first. There is no other.
    pub found: Vec<DoubleNormal>,
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
}

/// A box in which there is exactly one zero, and where the zero is.
struct Zero {
    numbers: [usize; 2],
    unique_in: [Interval; 2],
    at: [Interval; 2],
}

/// All double normals. The curve is closed, polynomial, smooth at its joints, and has none at a joint.
///
/// # Panics
/// When the boxes do not get small enough, or a zero is at an end of a piece.
pub fn double_normals(curve: &Curve) -> All {
    let chain = curve.chain();
    assert!(chain.closed());
    let pieces = chain.pieces();
    let parts: Vec<Part> = (0..chain.count())
        .map(|i| Part::new(whole(i as i64), whole(i as i64 + 1), control_points(&pieces[i])))
        .collect();
    let mut stack: Vec<(Part, Part)> = Vec::new();
    for i in 0..parts.len() {
        stack.extend((i..parts.len()).map(|j| (parts[i].clone(), parts[j].clone())));
    }
    let total = whole(chain.count() as i64);
    let smallest = fraction(1, 1 << DEPTH);
    let mut zeros: Vec<Zero> = Vec::new();
    while let Some((a, b)) = stack.pop() {
        assert!(stack.len() < 10_000, "too many pairs of parts");
        if is_not_normal(&a, &b) || is_cone(&a, &b, &total) {
            continue;
        }
        let small = &a.end - &a.start <= smallest && &b.end - &b.start <= smallest;
        let numbers = [&a, &b].map(|part| part.start.to_integer().to_u64().expect("a piece") as usize);
        match small.then(|| krawczyk(pieces, numbers, [&a, &b], &zeros)).flatten() {
            Some(Some(zero)) if !zero.is_beyond_its_pieces() => note(&mut zeros, zero),
            Some(_) => {}
            None if a.start == b.start && a.end == b.end => {
                let [left, right] = a.halves();
                stack.extend([
                    (left.clone(), left.clone()),
                    (left, right.clone()),
                    (right.clone(), right),
                ]);
            }
            None if &a.end - &a.start >= &b.end - &b.start => stack.extend(a.halves().map(|half| (half, b.clone()))),
            None => stack.extend(b.halves().map(|half| (a.clone(), half))),
        }
    }
    let mut found: Vec<DoubleNormal> = zeros.iter().map(|zero| zero.double_normal(pieces)).collect();
    found.sort_by(|a, b| a.length.ends().0.cmp(b.length.ends().0));
    All { found }
}

impl Zero {
    /// Boxes reach beyond the pieces, where the polynomials are not the curve.
    fn is_beyond_its_pieces(&self) -> bool {
        self.at
            .iter()
            .any(|[low, high]| high.numer().is_negative() || *low > whole(1))
    }

    fn double_normal(&self, pieces: &[Bezier]) -> DoubleNormal {
        assert!(
            self.at
                .iter()
                .all(|[low, high]| low.numer().is_positive() && *high < whole(1)),
            "a zero at a joint"
        );
        let [p, q] = [0, 1].map(|i| boxed(&segment(&pieces[self.numbers[i]], &self.at[i])));
        let x: Vec<Interval> = p.iter().zip(&q).map(|(p, q)| sum(p, &scaled(q, -1))).collect();
        let [low, high] = interval_dot(&x, &x);
        DoubleNormal {
            ends: [0, 1].map(|i| self.at[i].clone().map(|u| u + whole(self.numbers[i] as i64))),
            length: Exact::root_between(&low, &high),
        }
    }
}

fn is_inside(at: &[Interval; 2], container: &[Interval; 2]) -> bool {
    (0..2).all(|i| container[i][0] <= at[i][0] && at[i][1] <= container[i][1])
}

/// Keeps a zero that is new, and does not lie in a box in which another is the only one.
fn note(zeros: &mut Vec<Zero>, zero: Zero) {
    for known in zeros.iter().filter(|known| known.numbers == zero.numbers) {
        if is_inside(&zero.at, &known.unique_in) {
            return;
        }
        let apart = (0..2).any(|i| known.at[i][1] < zero.at[i][0] || zero.at[i][1] < known.at[i][0]);
        assert!(apart, "zeros that cannot be told apart");
    }
    zeros.push(zero);
}

/// Exactly one zero near a pair of parts, none, or no answer: the operator K(X) = m − Y F(m) + (1 − Y J(X))(X − m), on a box X three times as wide as the parts.
/// K(X) inside X: exactly one zero in X, and it is in K(X). K(X) and X disjoint: none. The only zero may also be one that is known: then there is none that is new.
fn krawczyk(pieces: &[Bezier], numbers: [usize; 2], parts: [&Part; 2], known: &[Zero]) -> Option<Option<Zero>> {
    let wide = |part: &Part, i: usize| -> Interval {
        let (from, width) = (&part.start - whole(numbers[i] as i64), &part.end - &part.start);
        [&from - &width, &from + &width * whole(2)]
    };
    let first = [wide(parts[0], 0), wide(parts[1], 1)];
    let next = step(pieces, numbers, &first)?;
    if (0..2).any(|i| next[i][1] < first[i][0] || first[i][1] < next[i][0]) {
        return Some(None);
    }
    let inside = (0..2).all(|i| first[i][0] < next[i][0] && next[i][1] < first[i][1]);
    if !inside {
        return None;
    }
    // A zero that is known and lies in X is the one of X.
    if known
        .iter()
        .any(|zero| zero.numbers == numbers && is_inside(&zero.at, &first))
    {
        return Some(None);
    }
    let width = |x: &[Interval; 2]| &x[0][1] - &x[0][0] + &x[1][1] - &x[1][0];
    let narrow = Rational::new(Integer::ONE, Integer::ONE << (BITS * 3 / 4));
    let mut at = next;
    loop {
        let next = step(pieces, numbers, &at)?;
        let next = [0, 1].map(|i| {
            [
                next[i][0].clone().max(at[i][0].clone()),
                next[i][1].clone().min(at[i][1].clone()),
            ]
        });
        if next == at || width(&at) < narrow {
            break;
        }
        at = next;
    }
    Some(Some(Zero {
        numbers,
        unique_in: first,
        at,
    }))
}

/// K(X), rounded outward; `None` where the Jacobian at the middle is nearly singular.
fn step(pieces: &[Bezier], numbers: [usize; 2], x: &[Interval; 2]) -> Option<[Interval; 2]> {
    let middle = [0, 1].map(|i| {
        let middle = (&x[i][0] + &x[i][1]) / whole(2);
        [middle.clone(), middle]
    });
    let (values, jacobian) = system(pieces, numbers, &middle);
    let (_, everywhere) = system(pieces, numbers, x);
    let at = |i: usize, j: usize| jacobian[i][j][0].clone();
    let determinant = at(0, 0) * at(1, 1) - at(0, 1) * at(1, 0);
    let entry = |x: Rational| Rational::from_f64((x / &determinant).to_f64());
    if determinant == whole(0) {
        return None;
    }
    let inverse = [
        [entry(at(1, 1))?, entry(-at(0, 1))?],
        [entry(-at(1, 0))?, entry(at(0, 0))?],
    ];
    let point = |x: &Rational| -> Interval { [x.clone(), x.clone()] };
    let mut found = middle.clone();
    for i in 0..2 {
        let newton = &inverse[i][0] * &values[0][0] + &inverse[i][1] * &values[1][0];
        found[i] = sum(&middle[i], &point(&-newton));
        for j in 0..2 {
            let product_ij = sum(
                &product(&point(&inverse[i][0]), &everywhere[0][j]),
                &product(&point(&inverse[i][1]), &everywhere[1][j]),
            );
            let rest = sum(&point(&whole(i64::from(i == j))), &scaled(&product_ij, -1));
            let radius = sum(&x[j], &scaled(&middle[j], -1));
            found[i] = sum(&found[i], &product(&rest, &radius));
        }
        let unit = Integer::ONE << BITS;
        found[i] = [
            Rational::new(found[i][0].floor_shifted(BITS), unit.clone()),
            Rational::new(found[i][1].ceil_shifted(BITS), unit),
        ];
    }
    Some(found)
}

/// (f, g) and its Jacobian (4) over a box of local parameters.
fn system(pieces: &[Bezier], numbers: [usize; 2], x: &[Interval; 2]) -> ([Interval; 2], [[Interval; 2]; 2]) {
    let [[p, p1, p2], [q, q1, q2]] = [0, 1].map(|i| jet(&pieces[numbers[i]], &x[i]));
    let x: Vec<Interval> = p.iter().zip(&q).map(|(p, q)| sum(p, &scaled(q, -1))).collect();
    let cross = interval_dot(&p1, &q1);
    let values = [interval_dot(&x, &p1), interval_dot(&x, &q1)];
    let fs = sum(&interval_dot(&x, &p2), &interval_dot(&p1, &p1));
    let gt = sum(&interval_dot(&x, &q2), &scaled(&interval_dot(&q1, &q1), -1));
    (values, [[fs, scaled(&cross, -1)], [cross, gt]])
}

/// c, c', c'' over an interval of the local parameter.
fn jet(piece: &Bezier, interval: &Interval) -> [Vec<Interval>; 3] {
    let points = segment(piece, interval);
    let width = &interval[1] - &interval[0];
    if width == whole(0) {
        // The polynomial's derivatives at a point, from the segment of length 1 that begins there.
        let points = segment(piece, &[interval[0].clone(), &interval[0] + whole(1)]);
        let first = derivative(&points, &whole(1));
        let second = derivative(&first, &whole(1));
        return [&points, &first, &second].map(|all| boxed(&all[..1]));
    }
    let first = derivative(&points, &width);
    let second = derivative(&first, &width);
    [boxed(&points), boxed(&first), boxed(&second)]
}

fn derivative(points: &[Point], width: &Rational) -> Vec<Point> {
    let factor = whole(points.len() as i64 - 1) / width;
    let edges = points.windows(2).map(|pair| minus(&pair[1], &pair[0]));
    edges.map(|edge| edge.iter().map(|x| x * &factor).collect()).collect()
}

/// The control points of the polynomial on an interval, which may reach beyond the piece.
fn segment(piece: &Bezier, interval: &Interval) -> Vec<Point> {
    let n = piece.degree();
    let point = |k: usize| {
        let arguments: Vec<Rational> = (0..n).map(|j| interval[usize::from(j >= n - k)].clone()).collect();
        piece.blossom(&arguments)
    };
    (0..=n).map(point).collect()
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
