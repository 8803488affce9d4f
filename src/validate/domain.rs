//! Polytopes of convex domains: the exact one of a level, and how far vertices returned are from its own.

use num_traits::{Signed, Zero};

use super::condition::Condition;
use super::verdict::{Kind, Verdict, Wrong};
use super::words;
use crate::check::domain::Context;
use crate::check::polynomial::halves;
use crate::claim::domain::{Box as Bounds, Domain, Row, Sign};
use crate::curve::{BSpline, Curve};
use crate::engine::FloatCurve;
use crate::number::{Integer, Rational, RationalExt};
use crate::polytope::{HalfSpace, Intersection, Polytope, hull2, hull3, intersect};

/// Levels of more rows are not judged.
const MOST_ROWS: usize = 40_000;
/// Exact vertices are rounded to this many bits below the size of the case before distances are measured.
const GRID_BITS: i32 = 100;
/// What that may change in a distance, as a part of the size.
const GRID_ERROR: f64 = 1.0 / (1_u128 << 98) as f64;

/// Parameters of the operation.
pub(super) struct Asked {
    pub(super) point: usize,
    pub(super) half_width: f64,
    pub(super) level: u32,
    pub(super) positive: bool,
}

/// The polytope of a level, exactly.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactDomain {
    /// Normal and constant of every half-space.
    rows: Vec<(Vec<Integer>, Integer)>,
    /// The polytope, its vertices rounded to a grid far below the unit; nothing when it is empty or flat.
    body: Option<Body>,
    /// A point of its interior.
    interior: Vec<Rational>,
    /// The largest magnitude of a coordinate of the case.
    size: f64,
}

/// A convex polygon or polyhedron.
#[derive(Debug, Clone, PartialEq)]
struct Body {
    points: Vec<Vec<Rational>>,
    /// Counter-clockwise seen from outside; in the plane the two ends of an edge.
    facets: Vec<Vec<usize>>,
    /// For each facet a vector that points outside, and its product with the facet's points.
    planes: Vec<(Vec<Rational>, Rational)>,
}

impl ExactDomain {
    /// The polytope that is asked for.
    pub(super) fn new(curve: &FloatCurve, spline: BSpline, asked: &Asked) -> Result<ExactDomain, String> {
        match spline.dimension() {
            2 => ExactDomain::within::<2>(curve, spline, asked),
            _ => ExactDomain::within::<3>(curve, spline, asked),
        }
    }

    fn within<const D: usize>(curve: &FloatCurve, spline: BSpline, asked: &Asked) -> Result<ExactDomain, String> {
        let center = curve.points.get(asked.point).ok_or("there is no such control point")?;
        let reach = center.iter().fold(0.0_f64, |most, x| most.max(x.abs())) + asked.half_width;
        let size = Condition::scale(curve).max(reach);
        let exact = |x: f64| Rational::from_f64(x).ok_or("the box is not finite");
        let width = exact(asked.half_width)?;
        let center = center.iter().map(|x| exact(*x)).collect::<Result<Vec<_>, _>>()?;
        let curve = Curve::from(spline);
        let domain = Domain {
            points: vec![asked.point],
            sign: if asked.positive { Sign::Positive } else { Sign::Negative },
            interval: [0, curve.chain().count()].map(|end| Rational::from_integer(end.into())),
            open: [false; 2],
            bounds: Bounds {
                low: center.iter().map(|x| x - &width).collect(),
                high: center.iter().map(|x| x + &width).collect(),
            },
        };
        let context = Context::new(&curve, &domain).map_err(|error| error.to_string())?;
        let mut half_spaces = level_rows::<D>(&context, asked.level)?;
        for axis in 0..D {
            for high in [false, true] {
                let side = context.row(&Row::Side { axis, high }).map(|row| row.affine);
                let side = side.and_then(|affine| Some((affine.linear.try_into().ok()?, affine.constant)));
                let (normal, constant) = side.ok_or("the box has no such side")?;
                half_spaces.push(HalfSpace { normal, constant });
            }
        }
        let found = match intersect(&half_spaces) {
            Intersection::Bounded(polytope) => Some(polytope),
            _ => None,
        };
        let rows = half_spaces
            .into_iter()
            .map(|row| (row.normal.to_vec(), row.constant))
            .collect();
        Ok(ExactDomain {
            rows,
            interior: found
                .as_ref()
                .map_or_else(Vec::new, |found| found.interior_point().to_vec()),
            body: found.map(|found| Body::of(&found, size)),
            size,
        })
    }

    /// Judges vertices, in any order; none is an empty polytope.
    pub(super) fn judge(&self, vertices: &[Vec<f64>], most: f64) -> Verdict {
        let unit = self.size * f64::EPSILON;
        let dimension = self.rows[0].0.len();
        if let Some(vertex) = vertices.iter().find(|vertex| vertex.len() != dimension) {
            let (found, expected) = (
                format!("{} coordinates", vertex.len()),
                format!("{dimension} coordinates"),
            );
            return Verdict::Wrong(Wrong::form(found, expected));
        }
        if let Some(vertex) = vertices.iter().find(|vertex| vertex.iter().any(|x| !x.is_finite())) {
            return Verdict::Wrong(Wrong {
                kind: Kind::NotFinite,
                place: String::new(),
                found: words::floats(vertex),
                expected: "numbers".into(),
                ulps: f64::INFINITY,
            });
        }
        let points: Vec<Vec<Rational>> = vertices.iter().map(|vertex| exactly(vertex)).collect();
        // A vertex outside by so much is wrong whatever the other ones are.
        let mut outside = 0.0_f64;
        for (i, point) in points.iter().enumerate() {
            let (by, row) = self.violation(point);
            let ulps = by / unit;
            if ulps > most {
                return Verdict::Wrong(self.outside(i, &vertices[i], row, ulps));
            }
            outside = outside.max(ulps);
        }
        let Some(body) = &self.body else {
            // Nothing is inside; what was returned is not farther outside than the tolerance.
            return Verdict::Right { ulps: outside };
        };
        let Some(found) = Body::around(&points) else {
            return self.flat(points.is_empty(), most, unit);
        };
        let slack = self.size * GRID_ERROR;
        let mut ulps = 0.0_f64;
        for point in points.iter().filter(|point| self.violation(point).0 > 0.0) {
            ulps = ulps.max((body.distance(point) + slack) / unit);
        }
        let mut worst: Option<&Vec<Rational>> = None;
        for vertex in &body.points {
            let off = found.distance(vertex);
            let off = if off > 0.0 { (off + slack) / unit } else { 0.0 };
            if off > ulps {
                (ulps, worst) = (off, Some(vertex));
            }
        }
        if ulps <= most {
            return Verdict::Right { ulps };
        }
        Verdict::Wrong(Wrong {
            kind: Kind::OtherValue,
            place: String::new(),
            found: format!("{} vertices with nothing as near", vertices.len()),
            expected: match worst {
                Some(vertex) => format!("the vertex {}", words::point(vertex)),
                None => "vertices of the polytope".into(),
            },
            ulps,
        })
    }

    /// How far a point is outside the half-space that it violates most, and which that is; 0 inside. Infinite where nothing is inside.
    fn violation(&self, point: &[Rational]) -> (f64, usize) {
        let mut worst = (0.0, 0);
        for (i, (normal, constant)) in self.rows.iter().enumerate() {
            let value = value(normal, constant, point);
            if !value.is_negative() {
                continue;
            }
            let square = normal.iter().fold(Integer::ZERO, |sum, x| sum + x * x);
            let by = match square.is_zero() {
                true => f64::INFINITY,
                false => (&value * &value / Rational::from_integer(square)).to_f64().sqrt(),
            };
            if by > worst.0 {
                worst = (by, i);
            }
        }
        worst
    }

    fn outside(&self, number: usize, vertex: &[f64], row: usize, ulps: f64) -> Wrong {
        let (normal, constant) = &self.rows[row];
        let dimension = normal.len();
        let names = ["x", "y", "z"];
        // Divided by the largest coefficient the numbers can be read.
        let largest = normal.iter().map(Integer::abs).max().filter(|x| !x.is_zero());
        let largest = largest.unwrap_or(Integer::ONE);
        let share = |x: &Integer| words::number(&Rational::new(x.clone(), largest.clone()));
        let terms: Vec<String> = (0..dimension)
            .map(|axis| format!("{}·{}", share(&normal[axis]), names[axis]))
            .collect();
        let side = if row + 2 * dimension >= self.rows.len() {
            "a side of the box"
        } else {
            "a coefficient of the level"
        };
        Wrong {
            kind: Kind::OtherValue,
            place: format!("vertex {number}"),
            found: words::floats(vertex),
            expected: format!("{side}: {} + {} ≥ 0", terms.join(" + "), share(constant)),
            ulps,
        }
    }

    /// Of a polytope with interior nothing, or nothing with interior, was returned: wrong by at least the radius of a ball in it.
    fn flat(&self, empty: bool, most: f64, unit: f64) -> Verdict {
        let radius = self.rows.iter().filter_map(|(normal, constant)| {
            let square = normal.iter().fold(Integer::ZERO, |sum, x| sum + x * x);
            let value = value(normal, constant, &self.interior);
            (!square.is_zero()).then(|| (&value * &value / Rational::from_integer(square)).to_f64().sqrt())
        });
        let ulps = radius.fold(f64::INFINITY, f64::min) / unit;
        if ulps <= most {
            return Verdict::Unjudged("the polytope is too thin to tell it from nothing".into());
        }
        Verdict::Wrong(Wrong {
            kind: Kind::OtherValue,
            place: String::new(),
            found: if empty {
                "no vertices"
            } else {
                "vertices without an interior"
            }
            .into(),
            expected: format!("a polytope around {}", words::point(&self.interior)),
            ulps,
        })
    }
}

fn value(normal: &[Integer], constant: &Integer, point: &[Rational]) -> Rational {
    let terms = normal.iter().zip(point).map(|(n, x)| x * n);
    terms.fold(Rational::from_integer(constant.clone()), |sum, term| sum + term)
}

fn exactly(numbers: &[f64]) -> Vec<Rational> {
    let exact = |x: &f64| Rational::from_f64(*x).unwrap_or_default();
    numbers.iter().map(exact).collect()
}

/// The coefficients of all spans after so many halvings.
fn level_rows<const D: usize>(context: &Context, level: u32) -> Result<Vec<HalfSpace<D>>, String> {
    let whole: usize = context.sections.iter().map(|section| section.coefficients.len()).sum();
    if whole.checked_shl(level).is_none_or(|rows| rows > MOST_ROWS) {
        return Err("the level has too many coefficients".into());
    }
    let mut rows = Vec::new();
    for section in &context.sections {
        let mut columns: Vec<Vec<Integer>> = (0..D)
            .map(|axis| section.coefficients.iter().map(|c| c.linear[axis].clone()).collect())
            .collect();
        columns.push(section.coefficients.iter().map(|c| c.constant.clone()).collect());
        let mut parts = vec![columns];
        for _ in 0..level {
            parts = parts
                .iter()
                .flat_map(|part| {
                    let (left, right): (Vec<_>, Vec<_>) = part.iter().map(|column| halves(column)).unzip();
                    [left, right]
                })
                .collect();
        }
        for part in parts {
            for k in 0..part[0].len() {
                rows.push(HalfSpace {
                    normal: std::array::from_fn(|axis| part[axis][k].clone()),
                    constant: part[D][k].clone(),
                });
            }
        }
    }
    Ok(rows)
}

impl Body {
    /// A polytope, its vertices rounded.
    fn of<const D: usize>(polytope: &Polytope<D>, size: f64) -> Body {
        let exponent = GRID_BITS - size.log2().ceil() as i32;
        let factor = Rational::from_integer(Integer::ONE << exponent.unsigned_abs());
        let factor = if exponent < 0 { factor.recip() } else { factor };
        let round = |x: &Rational| (x * &factor).round() / &factor;
        let points = (0..polytope.vertex_count()).map(|v| polytope.vertex(v).iter().map(round).collect());
        Body::new(
            points.collect(),
            polytope.facets().map(|facet| facet.vertices).collect(),
        )
    }

    fn new(points: Vec<Vec<Rational>>, facets: Vec<Vec<usize>>) -> Body {
        let plane = |facet: &Vec<usize>| {
            let at = |k: usize| &points[facet[k]];
            let edge = subtract(at(1), at(0));
            let normal = match edge.len() {
                2 => vec![edge[1].clone(), -&edge[0]],
                _ => cross(&edge, &subtract(at(2), at(0))),
            };
            let offset = dot(&normal, at(0));
            (normal, offset)
        };
        let planes = facets.iter().map(plane).collect();
        Body { points, facets, planes }
    }

    /// The hull of points; nothing when it has no interior.
    fn around(points: &[Vec<Rational>]) -> Option<Body> {
        let dimension = points.first()?.len();
        let count = Rational::from_integer(points.len().into());
        let sum = |axis: usize| points.iter().fold(Rational::zero(), |sum, point| sum + &point[axis]);
        let middle: Vec<Rational> = (0..dimension).map(|axis| sum(axis) / &count).collect();
        let facets = match dimension {
            2 => {
                let array = |point: &Vec<Rational>| [point[0].clone(), point[1].clone()];
                let cycle = hull2(&points.iter().map(array).collect::<Vec<_>>(), &array(&middle)).ok()?;
                let next = cycle.iter().cycle().skip(1);
                cycle.iter().zip(next).map(|(a, b)| vec![*a, *b]).collect()
            }
            _ => {
                let array = |point: &Vec<Rational>| [point[0].clone(), point[1].clone(), point[2].clone()];
                let triangles = hull3(&points.iter().map(array).collect::<Vec<_>>(), &array(&middle)).ok()?;
                triangles.into_iter().map(|triangle| triangle.to_vec()).collect()
            }
        };
        Some(Body::new(points.to_vec(), facets))
    }

    /// The distance of a point, 0 inside: exact squares, rounded at the end.
    fn distance(&self, point: &[Rational]) -> f64 {
        let mut least: Option<Rational> = None;
        for number in 0..self.facets.len() {
            // The nearest point is in a facet that is seen from the point.
            if let Some(square) = self.facet_distance(number, point)
                && least.as_ref().is_none_or(|least| square < *least)
            {
                least = Some(square);
            }
        }
        least.map_or(0.0, |square| square.to_f64().sqrt())
    }

    /// The squared distance of a facet; nothing when the point is behind it.
    fn facet_distance(&self, number: usize, point: &[Rational]) -> Option<Rational> {
        let facet = &self.facets[number];
        let at = |k: usize| &self.points[facet[k]];
        let (normal, offset) = &self.planes[number];
        let height = dot(normal, point) - offset;
        if !height.is_positive() {
            return None;
        }
        if point.len() == 2 {
            return Some(segment(at(0), at(1), point));
        }
        let pairs = || (0..facet.len()).map(|k| (at(k), at((k + 1) % facet.len())));
        let above = pairs().all(|(a, b)| {
            let turn = cross(&subtract(b, a), &subtract(point, a));
            !dot(&turn, normal).is_negative()
        });
        if above {
            return Some(&height * &height / dot(normal, normal));
        }
        pairs().map(|(a, b)| segment(a, b, point)).min()
    }
}

fn subtract(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    a.iter().zip(b).map(|(x, y)| x - y).collect()
}

fn dot(a: &[Rational], b: &[Rational]) -> Rational {
    a.iter().zip(b).fold(Rational::zero(), |sum, (x, y)| sum + x * y)
}

fn cross(a: &[Rational], b: &[Rational]) -> Vec<Rational> {
    let minor = |i: usize, j: usize| &a[i] * &b[j] - &a[j] * &b[i];
    vec![minor(1, 2), minor(2, 0), minor(0, 1)]
}

/// The squared distance of a point and a segment.
fn segment(a: &[Rational], b: &[Rational], point: &[Rational]) -> Rational {
    let (edge, arm) = (subtract(b, a), subtract(point, a));
    let (along, length) = (dot(&edge, &arm), dot(&edge, &edge));
    if !along.is_positive() {
        return dot(&arm, &arm);
    }
    if along >= length {
        let arm = subtract(point, b);
        return dot(&arm, &arm);
    }
    dot(&arm, &arm) - &along * &along / length
}

#[cfg(test)]
mod tests;
