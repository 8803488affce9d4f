//! Curves held against parts of an exact curve, modulo affine reparametrisation.

use super::condition::Condition;
use super::verdict::{Kind, Wrong};
use super::words;
use crate::curve::BSpline;
use crate::engine::{FileError, FloatCurve};
use crate::number::{Integer, Rational, RationalExt};

/// Parameters this near, relative to the domain, are the same knot: one rounding and then some.
const SAME_KNOT_BITS: u32 = 44;

/// What is asked of the multiplicity of a knot in the result.
#[derive(Debug, Clone, PartialEq)]
pub enum Multiplicity {
    /// The knot occurs so often or more.
    AtLeast(Rational, usize),
    /// The knot occurs so often or less.
    AtMost(Rational, usize),
}

/// The curves that a structural operation must return.
#[derive(Debug, Clone, PartialEq)]
pub struct Expected {
    source: BSpline,
    parts: Vec<(Rational, Rational)>,
    unit: f64,
    /// The unit of a result on another domain, whose knots were rounded when it was moved there.
    moved_unit: f64,
    /// The degree of the result, where the operation sets it.
    pub degree: Option<usize>,
    /// A knot of the result.
    pub multiplicity: Option<Multiplicity>,
    /// Whether every part must be one Bézier curve.
    pub bezier: bool,
}

impl Expected {
    /// One curve, the same as `source`, which is the exact `curve`.
    pub fn whole(curve: &FloatCurve, source: BSpline) -> Expected {
        let parts = vec![source.domain()];
        Expected::parts(curve, source, parts)
    }

    /// As many curves as `parts`, each the same as `source` on an interval of its domain.
    pub fn parts(curve: &FloatCurve, source: BSpline, parts: Vec<(Rational, Rational)>) -> Expected {
        let scale = Condition::scale(curve);
        let unit = scale * f64::EPSILON;
        let knots = &curve.knots[curve.degree..curve.knots.len() - curve.degree];
        let gaps = knots.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > 0.0);
        let shortest = gaps.fold(f64::INFINITY, f64::min);
        let length = knots[knots.len() - 1] - knots[0];
        let ratio = curve.weights.as_deref().map_or(1.0, |weights| {
            let least = weights.iter().copied().fold(f64::INFINITY, f64::min);
            weights.iter().copied().fold(0.0, f64::max) / least
        });
        let speed = 2.0 * curve.degree as f64 * ratio * length / shortest;
        Expected {
            source,
            parts,
            unit,
            moved_unit: unit * (1.0 + speed),
            degree: None,
            multiplicity: None,
            bezier: false,
        }
    }

    /// The number of curves expected.
    pub fn count(&self) -> usize {
        self.parts.len()
    }

    /// How many units the curves `found` are off, or in what way they are not of the right form.
    ///
    /// Each is compared with its part at as many exact parameters of every span as determine a curve of its degree.
    pub(super) fn compare(&self, found: &[&FloatCurve]) -> Result<Deviation, Wrong> {
        if found.len() != self.parts.len() {
            return Err(Wrong::form(
                format!("{} curves", found.len()),
                format!("{} curves", self.parts.len()),
            ));
        }
        let mut worst = Deviation::default();
        for (i, (curve, part)) in found.iter().zip(&self.parts).enumerate() {
            let name = if found.len() == 1 {
                String::new()
            } else {
                format!("curves[{i}]")
            };
            self.compare_one(curve, part, &name, &mut worst).map_err(|mut wrong| {
                if wrong.place.is_empty() {
                    wrong.place = name.clone();
                }
                wrong
            })?;
        }
        Ok(worst)
    }

    fn compare_one(
        &self,
        found: &FloatCurve,
        part: &(Rational, Rational),
        name: &str,
        worst: &mut Deviation,
    ) -> Result<(), Wrong> {
        let components = components(found).map_err(|error| Wrong {
            kind: if error.what.contains("finite number") {
                Kind::NotFinite
            } else {
                Kind::NotACurve
            },
            place: name.to_string(),
            found: error.to_string(),
            expected: "a curve".into(),
            ulps: f64::INFINITY,
        })?;
        let (Some(first), Some(last)) = (components.first(), components.last()) else {
            return Err(Wrong::form("nothing", "a curve"));
        };
        let (first, last) = (first.domain().0, last.domain().1);
        let unit = if self.check_form(found, &components, part, (&first, &last))? {
            self.moved_unit
        } else {
            self.unit
        };
        let (start, end) = part;
        let stretch = (&last - &first) / (end - start);
        for curve in &components {
            let degree = self.source.degree().max(curve.degree());
            let rational = self.source.weights().is_some() || curve.weights().is_some();
            let samples = if rational { 2 * degree } else { degree };
            let (a, b) = curve.domain();
            let place = |s: &Rational| start + (s - &first) / &stretch;
            for (a, b) in self.spans(&(place(&a), place(&b))) {
                for j in 0..=samples {
                    let share = Rational::new(Integer::from(j), Integer::from(samples));
                    let t = &a + share * (&b - &a);
                    let there = &first + (&t - start) * &stretch;
                    let (Ok(expected), Ok(got)) = (self.source.evaluate(&t), curve.evaluate(&there)) else {
                        return Err(Wrong::form("a curve that has no point there", "a point"));
                    };
                    let off = expected.iter().zip(&got).map(|(x, y)| (x - y).to_f64().abs());
                    let ulps = off.fold(0.0, f64::max) / unit;
                    if ulps > worst.ulps || worst.place.is_empty() {
                        let dot = if name.is_empty() { "" } else { ", " };
                        worst.ulps = ulps;
                        worst.place = format!("{name}{dot}at the parameter {}", words::number(&t));
                        worst.expected = expected;
                        worst.found = got;
                    }
                }
            }
        }
        Ok(())
    }

    /// Dimension, degree and knots of a result; whether it is on another domain than asked for.
    fn check_form(
        &self,
        found: &FloatCurve,
        components: &[BSpline],
        part: &(Rational, Rational),
        (first, last): (&Rational, &Rational),
    ) -> Result<bool, Wrong> {
        if found.dimension() != self.source.dimension() {
            return Err(Wrong::form(
                format!("{} coordinates", found.dimension()),
                format!("{} coordinates", self.source.dimension()),
            ));
        }
        if let Some(degree) = self.degree
            && found.degree != degree
        {
            return Err(Wrong::form(
                format!("degree {}", found.degree),
                format!("degree {degree}"),
            ));
        }
        if self.bezier && found.points.len() != found.degree + 1 {
            return Err(Wrong::form(
                format!(
                    "a piece of degree {} with {} control points",
                    found.degree,
                    found.points.len()
                ),
                "a Bézier curve",
            ));
        }
        let (start, end) = part;
        let shrink = (end - start) / (last - first);
        let near = Rational::new(Integer::ONE, Integer::ONE << SAME_KNOT_BITS) * (end - start);
        let knots = || components.iter().flat_map(|curve| curve.knots().iter());
        // Components share the knot between them.
        let most_at_once = |count: &dyn Fn(&BSpline) -> usize| components.iter().map(count).max().unwrap_or(0);
        match &self.multiplicity {
            Some(Multiplicity::AtLeast(t, least)) => {
                let count = most_at_once(&|curve| {
                    let at = |s: Rational| start + (s - first) * &shrink;
                    curve
                        .knots()
                        .iter()
                        .filter(|s| distance(&at(s.clone()), t) <= near)
                        .count()
                });
                if count < *least {
                    return Err(Wrong::form(
                        format!("the knot {} {count} times", words::number(t)),
                        format!("{least} times"),
                    ));
                }
            }
            // A knot beside it, of a multiplicity of its own, may be taken for the same one: only the knot itself is counted.
            Some(Multiplicity::AtMost(t, most)) => {
                let count = knots().filter(|s| s == t).count();
                if count > *most {
                    return Err(Wrong::form(
                        format!("the knot {} {count} times", words::number(t)),
                        format!("at most {most} times"),
                    ));
                }
            }
            None => {}
        }
        Ok(distance(first, start) > near || distance(last, end) > near)
    }

    /// The non-empty spans of the source within a part.
    fn spans(&self, part: &(Rational, Rational)) -> Vec<(Rational, Rational)> {
        let (start, end) = part;
        let mut ends = vec![start.clone()];
        ends.extend(self.source.knots().iter().filter(|t| start < t && t < end));
        ends.push(end.clone());
        ends.dedup();
        ends.windows(2).map(|pair| (pair[0].clone(), pair[1].clone())).collect()
    }
}

/// The parts of a curve between interior knots of multiplicity degree + 1, at which it may be discontinuous: most curves are in one part.
fn components(found: &FloatCurve) -> Result<Vec<BSpline>, FileError> {
    let order = found.degree + 1;
    let (knots, count) = (&found.knots, found.points.len());
    let mut starts = vec![0];
    if knots.len() == count + order && found.weights.as_ref().is_none_or(|weights| weights.len() == count) {
        let breaks = (1..count).filter(|k| k + order < knots.len() && knots[*k] == knots[k + found.degree]);
        starts.extend(breaks.filter(|k| knots[*k] > knots[0] && knots[*k] < knots[knots.len() - 1]));
    }
    let ends = starts[1..].iter().copied().chain([count]);
    let part = |(start, end): (usize, usize)| {
        let curve = FloatCurve {
            degree: found.degree,
            knots: knots.get(start..end + order).unwrap_or(knots).to_vec(),
            points: found.points[start..end].to_vec(),
            weights: found
                .weights
                .as_ref()
                .map(|weights| weights.get(start..end).unwrap_or(weights).to_vec()),
        };
        curve.exact()
    };
    starts.iter().copied().zip(ends).map(part).collect()
}

fn distance(a: &Rational, b: &Rational) -> Rational {
    if a > b { a - b } else { b - a }
}

/// The largest deviation seen, with its place.
#[derive(Debug, Default)]
pub(super) struct Deviation {
    pub(super) ulps: f64,
    pub(super) place: String,
    pub(super) expected: Vec<Rational>,
    pub(super) found: Vec<Rational>,
}
