//! Exact vectors and curves for the page.

use knotproof::curve::{Bezier, Curve, Form, read_curve};
use knotproof::number::{Meaning, Rational, RationalVector, parse_number};

/// A point or vector.
pub type Point = Vec<Rational>;

pub fn fraction(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

pub fn whole(n: i64) -> Rational {
    fraction(n, 1)
}

/// A printed number.
pub fn number(text: &str) -> Rational {
    parse_number(text, Meaning::Decimal).unwrap_or_else(|error| panic!("{text}: {error}"))
}

/// The numbers of a printed list.
pub fn numbers(text: &str) -> Point {
    text.split_whitespace().map(number).collect()
}

/// Printed points, "(0 1) (2 3)".
pub fn points(text: &str) -> Vec<Vec<&str>> {
    let groups = text.split(')').filter(|group| !group.trim().is_empty());
    groups
        .map(|group| group.trim().trim_start_matches('(').split([' ', ',']).collect())
        .collect()
}

/// A curve of the corpus.
pub fn file(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_curve(std::fs::read(&path).expect(&path)).expect(name).curve
}

/// A polynomial Bézier piece.
pub fn bezier(points: &[Point]) -> Bezier {
    let coordinates: Vec<Rational> = points.iter().flatten().cloned().collect();
    Bezier::new(points[0].len(), RationalVector::from_rationals(&coordinates), None).expect("control points")
}

/// A polynomial Bézier curve of one piece.
pub fn bezier_curve(points: &[Point]) -> Curve {
    Curve::new(points[0].len(), Form::Bezier(vec![bezier(points)])).expect("a curve")
}

/// Points with integer coordinates.
pub fn whole_points<const D: usize>(points: &[[i64; D]]) -> Vec<Point> {
    points.iter().map(|p| p.iter().map(|x| whole(*x)).collect()).collect()
}

/// The control points of a piece.
pub fn control_points(piece: &Bezier) -> Vec<Point> {
    (0..=piece.degree()).map(|k| piece.point(k)).collect()
}

pub fn minus(p: &[Rational], q: &[Rational]) -> Point {
    p.iter().zip(q).map(|(x, y)| x - y).collect()
}

pub fn plus(p: &[Rational], q: &[Rational]) -> Point {
    p.iter().zip(q).map(|(x, y)| x + y).collect()
}

pub fn times(p: &[Rational], factor: &Rational) -> Point {
    p.iter().map(|x| x * factor).collect()
}

pub fn dot(p: &[Rational], q: &[Rational]) -> Rational {
    p.iter().zip(q).fold(whole(0), |sum, (x, y)| sum + x * y)
}

pub fn squared(p: &[Rational]) -> Rational {
    dot(p, p)
}

pub fn absolute(x: &Rational) -> Rational {
    if x.numer().is_negative() { -x } else { x.clone() }
}

/// The greatest absolute coordinate.
pub fn infinity(p: &[Rational]) -> Rational {
    p.iter().map(absolute).max().expect("a coordinate")
}

/// p − 2q + r.
pub fn second_difference(p: &[Rational], q: &[Rational], r: &[Rational]) -> Point {
    minus(&minus(r, q), &minus(q, p))
}

/// Inner second differences of a list of points.
pub fn second_differences(points: &[Point]) -> Vec<Point> {
    points
        .windows(3)
        .map(|p| second_difference(&p[0], &p[1], &p[2]))
        .collect()
}

pub fn cross(p: &[Rational], q: &[Rational]) -> Point {
    (0..3)
        .map(|i| &p[(i + 1) % 3] * &q[(i + 2) % 3] - &p[(i + 2) % 3] * &q[(i + 1) % 3])
        .collect()
}

/// "(0, 3/2)".
pub fn shown(p: &[Rational]) -> String {
    let texts: Vec<String> = p.iter().map(ToString::to_string).collect();
    format!("({})", texts.join(", "))
}
