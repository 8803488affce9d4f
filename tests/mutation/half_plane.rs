//! The truth about the domain of control points of one quadratic Bézier piece in the plane, where h does not depend on the parameter: everything, nothing, or a
//! half-plane cut off by the box.

use knotproof::certificate::Document;
use knotproof::claim::domain::{Outcome, Sign, Target};
use knotproof::curve::Form;
use knotproof::number::{Integer, Rational, RationalExt};
use knotproof::prove::domain::{Options, Problem, certify};
use knotproof::prove::linear_program::GoodLp;

type Point = [Rational; 2];

/// a·x + b·y + c > 0.
struct HalfPlane {
    normal: Point,
    constant: Rational,
}

fn zero() -> Rational {
    Rational::from_integer(Integer::ZERO)
}

fn cross(a: &Point, b: &Point) -> Rational {
    &a[0] * &b[1] - &a[1] * &b[0]
}

fn minus(a: &Point, b: &Point) -> Point {
    [&a[0] - &b[0], &a[1] - &b[1]]
}

impl HalfPlane {
    fn at(&self, x: &Point) -> Rational {
        &self.normal[0] * &x[0] + &self.normal[1] * &x[1] + &self.constant
    }

    fn squared(&self) -> Rational {
        &self.normal[0] * &self.normal[0] + &self.normal[1] * &self.normal[1]
    }
}

/// The polygon of all points of the box where the half-plane's function is ≥ 0.
fn cut(corners: Vec<Point>, half_plane: &HalfPlane) -> Vec<Point> {
    let mut kept = Vec::new();
    for (i, a) in corners.iter().enumerate() {
        let b = &corners[(i + 1) % corners.len()];
        let (f, g) = (half_plane.at(a), half_plane.at(b));
        if f >= zero() {
            kept.push(a.clone());
        }
        if (f < zero()) != (g < zero()) && f != zero() && g != zero() {
            let t = &f / (&f - &g);
            let d = minus(b, a);
            kept.push([&a[0] + &t * &d[0], &a[1] + &t * &d[1]]);
        }
    }
    kept
}

fn area(polygon: &[Point]) -> Rational {
    let edges = (0..polygon.len()).map(|i| cross(&polygon[i], &polygon[(i + 1) % polygon.len()]));
    edges.fold(zero(), |sum, edge| sum + edge) / Rational::from_integer(2.into())
}

fn squared_distance(a: &Point, b: &Point) -> Rational {
    let d = minus(a, b);
    &d[0] * &d[0] + &d[1] * &d[1]
}

/// The least squared distance from a point to a convex polygon in counter-clockwise order.
fn to_polygon(y: &Point, polygon: &[Point]) -> Rational {
    let edges: Vec<(&Point, &Point)> = (0..polygon.len())
        .map(|i| (&polygon[i], &polygon[(i + 1) % polygon.len()]))
        .collect();
    if edges.iter().all(|(a, b)| cross(&minus(b, a), &minus(y, a)) >= zero()) {
        return zero();
    }
    let to_edge = |(a, b): &(&Point, &Point)| {
        let (d, e) = (minus(b, a), minus(y, a));
        let squared = &d[0] * &d[0] + &d[1] * &d[1];
        if squared == zero() {
            return squared_distance(y, a);
        }
        let t = (&d[0] * &e[0] + &d[1] * &e[1]) / squared;
        let t = t.max(zero()).min(Rational::from_integer(Integer::ONE));
        squared_distance(y, &[&a[0] + &t * &d[0], &a[1] + &t * &d[1]])
    };
    edges.iter().map(to_edge).min().expect("edges")
}

/// Is what the document states true?
pub fn is_true(document: &Document) -> bool {
    let Some(content) = document.claim.domain() else {
        return false;
    };
    let domain = &content.statement.domain;
    let piece = match document.curve.form() {
        Form::Bezier(pieces) if pieces.len() == 1 && pieces[0].degree() == 2 && pieces[0].is_polynomial() => &pieces[0],
        _ => return recomputed(document),
    };
    if document.curve.dimension() != 2 {
        return recomputed(document);
    }
    let p: Vec<Point> = (0..3)
        .map(|k| piece.point(k).try_into().expect("two coordinates"))
        .collect();
    let sign = Rational::from_integer(if domain.sign == Sign::Positive { 1 } else { -1 }.into());
    // det(P₁ − P₀, P₂ − P₁) at three positions of the moving points gives the affine function.
    let one = || Rational::from_integer(Integer::ONE);
    let value = |x: Point| {
        let q: Vec<Point> = (0..3)
            .map(|k| {
                if domain.points.contains(&k) {
                    x.clone()
                } else {
                    p[k].clone()
                }
            })
            .collect();
        &sign * cross(&minus(&q[1], &q[0]), &minus(&q[2], &q[1]))
    };
    let constant = value([zero(), zero()]);
    let half_plane = HalfPlane {
        normal: [value([one(), zero()]) - &constant, value([zero(), one()]) - &constant],
        constant,
    };
    let flat = half_plane.squared() == zero();
    let nothing = flat && half_plane.constant <= zero();
    let (low, high) = (&domain.bounds.low, &domain.bounds.high);
    let corner = |i: usize, j: usize| [[low, high][i][0].clone(), [low, high][j][1].clone()];
    let corners = vec![corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
    // K ∩ B is not empty when and only when K contains a corner.
    let empty = nothing || corners.iter().all(|x| half_plane.at(x) <= zero());
    let polygon = if flat { corners } else { cut(corners, &half_plane) };
    match &content.statement.outcome {
        Outcome::Sandwich {
            inner_measure,
            outer_measure,
        } => !empty && *inner_measure <= area(&polygon) && *outer_measure >= area(&polygon),
        Outcome::Empty => empty,
        Outcome::Nearest {
            to,
            lower_squared,
            upper_squared,
        } => {
            let target: Point = match to {
                Target::Point(point) => point.clone().try_into().expect("two coordinates"),
                Target::Fair => match domain.points.as_slice() {
                    // |P₀ − 2P₁ + P₂|² is least where it vanishes.
                    [0] => [0, 1].map(|i| &p[1][i] + &p[1][i] - &p[2][i]),
                    [1] => [0, 1].map(|i| (&p[0][i] + &p[2][i]) / Rational::from_integer(2.into())),
                    [2] => [0, 1].map(|i| &p[1][i] + &p[1][i] - &p[0][i]),
                    _ => return false,
                },
            };
            let squared = to_polygon(&target, &polygon);
            !empty && *lower_squared <= squared && squared <= *upper_squared
        }
        Outcome::Change {
            from,
            lower_squared,
            upper_squared,
        } => {
            let from: Point = from.clone().try_into().expect("two coordinates");
            let value = half_plane.at(&from);
            if flat || value <= zero() {
                return false;
            }
            let squared = &value * &value / half_plane.squared();
            *lower_squared <= squared && squared <= *upper_squared
        }
        Outcome::Ball { lower, upper } => {
            let radius = inradius(&polygon);
            !empty && lower.to_f64() <= radius * (1.0 + 1e-9) && upper.to_f64() >= radius * (1.0 - 1e-9)
        }
    }
}

/// The same of any other curve, as far as the prover knows it.
fn recomputed(document: &Document) -> bool {
    let Some(content) = document.claim.domain() else {
        return false;
    };
    let problem = Problem {
        domain: content.statement.domain.clone(),
        position: vec![zero(); document.curve.dimension()],
        has_sign: false,
    };
    let options = Options {
        tolerance: Rational::new(1.into(), 1000.into()),
        budget: 5000,
        name: None,
        snapped_joints: None,
        measure_rounds: false,
        solver: &GoodLp,
    };
    let found = certify(&document.curve, &problem, &options).document;
    let found = found.expect("decided").claim.statement.outcome;
    match (&content.statement.outcome, &found) {
        (
            Outcome::Sandwich {
                inner_measure,
                outer_measure,
            },
            Outcome::Sandwich {
                inner_measure: least,
                outer_measure: greatest,
            },
        ) => inner_measure <= greatest && outer_measure >= least,
        (Outcome::Empty, Outcome::Empty) => true,
        (Outcome::Sandwich { .. } | Outcome::Empty, _) => false,
        (other, _) => panic!("no other truth about {other:?}"),
    }
}

/// The greatest least distance to the edges' lines, by brute force over triples of edges, in binary64.
fn inradius(polygon: &[Point]) -> f64 {
    let points: Vec<[f64; 2]> = polygon.iter().map(|p| [p[0].to_f64(), p[1].to_f64()]).collect();
    let edges: Vec<[f64; 3]> = (0..points.len())
        .filter_map(|i| {
            let (a, b) = (points[i], points[(i + 1) % points.len()]);
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let length = dx.hypot(dy);
            (length > 0.0).then(|| [-dy / length, dx / length, (dy * a[0] - dx * a[1]) / length])
        })
        .collect();
    let within = |x: [f64; 2]| {
        let distances = edges.iter().map(|e| e[0] * x[0] + e[1] * x[1] + e[2]);
        distances.fold(f64::INFINITY, f64::min)
    };
    let mut best = 0.0f64;
    for i in 0..edges.len() {
        for j in 0..i {
            for k in 0..j {
                // Equal distances to three lines.
                let [a, b, c] = [edges[i], edges[j], edges[k]];
                let (r, s) = (
                    [a[0] - b[0], a[1] - b[1], a[2] - b[2]],
                    [a[0] - c[0], a[1] - c[1], a[2] - c[2]],
                );
                let determinant = r[0] * s[1] - r[1] * s[0];
                if determinant.abs() > 1e-14 {
                    let x = (r[1] * s[2] - r[2] * s[1]) / determinant;
                    let y = (r[2] * s[0] - r[0] * s[2]) / determinant;
                    best = best.max(within([x, y]));
                }
            }
        }
    }
    best
}
