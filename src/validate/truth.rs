//! The exact result of a case.

use num_traits::{Signed, Zero};

use super::condition::{Condition, curvature_unit, torsion_unit};
use super::distance;
use super::domain::{Asked, ExactDomain};
use super::structure::{Expected, Multiplicity};
use crate::curve::{BSpline, Curve, Side};
use crate::engine::{Case, FloatCurve, Operation};
use crate::number::{Rational, RationalExt, sqrt_enclosure};

/// Bits of square roots.
const ROOT_BITS: u32 = 90;

/// A number between two fractions, and its unit in the last place.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosed {
    /// At least this.
    pub lower: Rational,
    /// At most this.
    pub upper: Rational,
    /// The unit.
    pub unit: f64,
}

/// A point or vector, and the unit in the last place of its coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactVector {
    /// The coordinates.
    pub vector: Vec<Rational>,
    /// The unit.
    pub unit: f64,
}

/// The exact result of an operation, with the unit in which deviations from it are counted.
///
/// For points and curves the unit is 2^-52 times the largest coordinate of the control points. For other results it is by how much they move when every number
/// on the way is off by a relative 2^-52; `docs/validate.md` has the formulas.
#[derive(Debug, Clone, PartialEq)]
pub enum Truth {
    /// A point, or a derivative with its one-sided values.
    Vectors(Vec<ExactVector>),
    /// A curvature or torsion with its one-sided values.
    Values {
        /// The values.
        choices: Vec<Enclosed>,
        /// Whether the sign is a matter of convention.
        unsigned: bool,
    },
    /// One or more curves.
    Curves(Box<Expected>),
    /// A distance.
    Distance {
        /// Between which bounds.
        bounds: Enclosed,
        /// Where the upper one is attained, in words.
        attained: String,
    },
    /// The polytope of a convex domain.
    Domain(Box<ExactDomain>),
    /// There is no such distance.
    NoDistance,
    /// It is not known, for this reason.
    Unknown(String),
}

/// Squared bounds of the shortest double normal.
#[derive(Debug, Clone, PartialEq)]
pub enum MsdBounds {
    /// There is no double normal.
    None,
    /// Between these squares.
    Squared {
        /// At least.
        lower: Rational,
        /// At most.
        upper: Rational,
    },
}

/// Finds the shortest double normal of a curve; the reason when it does not. The judge has no search of its own for that.
pub type MsdOracle<'a> = dyn Fn(&Curve) -> Result<MsdBounds, String> + 'a;

/// The exact result of a case. `msd` is asked for shortest double normals.
pub fn truth(case: &Case, msd: &MsdOracle<'_>) -> Truth {
    match case.curve.exact() {
        Ok(spline) => of_curve(case, spline, msd).unwrap_or_else(Truth::Unknown),
        Err(error) => Truth::Unknown(format!("the case is about no curve: {error}")),
    }
}

fn of_curve(case: &Case, spline: BSpline, msd: &MsdOracle<'_>) -> Result<Truth, String> {
    let number = |t: &f64| Rational::from_f64(*t).ok_or_else(|| format!("the parameter {t} is not finite"));
    let about = About {
        curve: &case.curve,
        spline,
    };
    match &case.operation {
        Operation::Point { parameter } => about.point(&number(parameter)?),
        Operation::Derivative { parameter, order, .. } => about.derivative(&number(parameter)?, *order),
        Operation::Curvature { parameter, .. } => about.curvature(&number(parameter)?),
        Operation::Torsion { parameter, .. } => about.torsion(&number(parameter)?),
        Operation::InsertKnot { parameter, times } => about.insertion(number(parameter)?, *times),
        Operation::RemoveKnot { parameter, times } => about.removal(number(parameter)?, *times),
        Operation::ElevateDegree { times } => Ok(about.elevation(*times)),
        Operation::Split { parameter } => about.split(number(parameter)?),
        Operation::Decompose => Ok(about.decomposition()),
        Operation::NearestPoint { target } => {
            let exact: Option<Vec<Rational>> = target.iter().map(|x| Rational::from_f64(*x)).collect();
            let exact = exact.ok_or("the target is not finite")?;
            let scale = target.iter().fold(Condition::scale(&case.curve), |s, x| s.max(x.abs()));
            Ok(Truth::of_distance(
                &distance::to_point(&about.spline, &exact, scale),
                scale,
                "the curve",
            ))
        }
        Operation::CurveDistance { other } => {
            let scale = Condition::scale(&case.curve).max(Condition::scale(other));
            let other = other.exact().map_err(|e| format!("the other curve is none: {e}"))?;
            Ok(Truth::of_distance(
                &distance::between(&about.spline, &other, scale),
                scale,
                "the two curves",
            ))
        }
        Operation::Msd => Ok(Truth::of_msd(&msd(&Curve::from(about.spline))?, &case.curve)),
        Operation::ConvexDomain {
            point,
            half_width,
            level,
            positive,
        } => {
            let asked = Asked {
                point: *point,
                half_width: *half_width,
                level: *level,
                positive: *positive,
            };
            let domain = ExactDomain::new(&case.curve, about.spline, &asked)?;
            Ok(Truth::Domain(Box::new(domain)))
        }
    }
}

/// An exact curve, and its numbers in binary64, of which the units are made.
pub(super) struct About<'c> {
    pub(super) curve: &'c FloatCurve,
    pub(super) spline: BSpline,
}

impl About<'_> {
    pub(super) fn point(&self, t: &Rational) -> Result<Truth, String> {
        let vector = self.spline.evaluate(t).map_err(|e| e.to_string())?;
        let unit = Condition::scale(self.curve) * f64::EPSILON;
        Ok(Truth::Vectors(vec![ExactVector { vector, unit }]))
    }

    fn sides(&self, t: &Rational, order: usize) -> Result<Vec<Condition>, String> {
        Condition::new(self.curve, &self.spline, t, order)
    }

    pub(super) fn derivative(&self, t: &Rational, order: usize) -> Result<Truth, String> {
        let last = |c: Condition| ExactVector {
            unit: c.sizes[order] * f64::EPSILON,
            vector: c.derivatives.into_iter().next_back().unwrap_or_default(),
        };
        Ok(Truth::Vectors(self.sides(t, order)?.into_iter().map(last).collect()))
    }

    pub(super) fn curvature(&self, t: &Rational) -> Result<Truth, String> {
        let values: Option<Vec<Enclosed>> = self.sides(t, 2)?.iter().map(curvature).collect();
        Ok(Truth::Values {
            choices: values.ok_or("the derivative is zero there: there is no curvature")?,
            unsigned: true,
        })
    }

    pub(super) fn torsion(&self, t: &Rational) -> Result<Truth, String> {
        let values: Option<Vec<Enclosed>> = self.sides(t, 3)?.iter().map(torsion).collect();
        Ok(Truth::Values {
            choices: values.ok_or("the curvature is zero there: there is no torsion")?,
            unsigned: false,
        })
    }

    pub(super) fn insertion(self, t: Rational, times: usize) -> Result<Truth, String> {
        let least = self.spline.multiplicity(&t) + times;
        let mut expected = Expected::whole(self.curve, self.spline);
        expected.multiplicity = Some(Multiplicity::AtLeast(t, least));
        Ok(Truth::Curves(Box::new(expected)))
    }

    pub(super) fn removal(self, t: Rational, times: usize) -> Result<Truth, String> {
        let most = self.spline.multiplicity(&t).checked_sub(times);
        let most = most.ok_or("the knot is not there so often")?;
        check_removable(&self.spline, &t, most)?;
        let mut expected = Expected::whole(self.curve, self.spline);
        expected.multiplicity = Some(Multiplicity::AtMost(t, most));
        Ok(Truth::Curves(Box::new(expected)))
    }

    pub(super) fn elevation(self, times: usize) -> Truth {
        let degree = self.spline.degree() + times;
        let mut expected = Expected::whole(self.curve, self.spline);
        expected.degree = Some(degree);
        Truth::Curves(Box::new(expected))
    }

    pub(super) fn split(self, t: Rational) -> Result<Truth, String> {
        let (start, end) = self.spline.domain();
        if t <= start || t >= end {
            return Err("the parameter is an end of the domain: there is nothing to split".into());
        }
        let parts = vec![(start, t.clone()), (t, end)];
        Ok(Truth::Curves(Box::new(Expected::parts(self.curve, self.spline, parts))))
    }

    pub(super) fn decomposition(self) -> Truth {
        let curve = Curve::from(self.spline.clone());
        let chain = curve.chain();
        let parts = (0..chain.count()).filter_map(|i| chain.piece(i).map(|piece| piece.knots));
        let parts = parts.collect();
        let mut expected = Expected::parts(self.curve, self.spline, parts);
        expected.bezier = true;
        Truth::Curves(Box::new(expected))
    }
}

impl Truth {
    fn of_distance(found: &distance::Enclosure, scale: f64, curves: &str) -> Truth {
        let at: Vec<String> = found.parameters.iter().map(super::words::number).collect();
        let attained = format!(
            "distance² {} at the {} {} of {curves}",
            super::words::number(&found.upper_squared),
            if at.len() == 1 { "parameter" } else { "parameters" },
            at.join(" and "),
        );
        Truth::Distance {
            bounds: Enclosed {
                lower: found.lower.clone(),
                upper: found.upper.clone(),
                unit: scale * f64::EPSILON,
            },
            attained,
        }
    }

    /// The truth that proved bounds of the shortest double normal are about a curve in binary64.
    pub fn of_msd(bounds: &MsdBounds, curve: &FloatCurve) -> Truth {
        match bounds {
            MsdBounds::None => Truth::NoDistance,
            MsdBounds::Squared { lower, upper } => Truth::Distance {
                bounds: Enclosed {
                    lower: sqrt_enclosure(lower, ROOT_BITS).0,
                    upper: sqrt_enclosure(upper, ROOT_BITS).1,
                    unit: Condition::scale(curve) * f64::EPSILON,
                },
                attained: "the shortest double normal".into(),
            },
        }
    }
}

/// A knot can have the multiplicity m when the homogeneous curve has p − m continuous derivatives there.
fn check_removable(spline: &BSpline, t: &Rational, multiplicity: usize) -> Result<(), String> {
    let (start, end) = spline.domain();
    if *t <= start || *t >= end {
        return Err("only knots inside the domain are removed".into());
    }
    let order = spline.degree() - multiplicity.min(spline.degree());
    // With k arguments s and the rest t, blossoms are combinations of the derivatives at t up to order k.
    let s = (t + &end) / Rational::from_integer(2.into());
    let mut arguments = vec![t.clone(); spline.degree()];
    for k in 0..=order {
        arguments[..k].fill(s.clone());
        let sides = [Side::Before, Side::After].map(|side| spline.blossom(t, side, &arguments));
        if sides[0] != sides[1] {
            return Err("the knot is not exactly removable".into());
        }
    }
    Ok(())
}

fn dot(a: &[Rational], b: &[Rational]) -> Rational {
    a.iter().zip(b).fold(Rational::zero(), |sum, (x, y)| sum + x * y)
}

/// |a × b|² = |a|²|b|² − (a·b)².
fn cross_squared(a: &[Rational], b: &[Rational]) -> Rational {
    let mixed = dot(a, b);
    dot(a, a) * dot(b, b) - &mixed * &mixed
}

/// κ² = |c' × c''|² / |c'|⁶, enclosed; nothing where c' = 0.
fn curvature(condition: &Condition) -> Option<Enclosed> {
    let (first, second) = (&condition.derivatives[1], &condition.derivatives[2]);
    let speed = dot(first, first);
    if speed.is_zero() {
        return None;
    }
    let square = cross_squared(first, second) / (&speed * &speed * &speed);
    let (lower, upper) = sqrt_enclosure(&square, ROOT_BITS);
    let unit = curvature_unit(condition, upper.to_f64()) * f64::EPSILON;
    Some(Enclosed { lower, upper, unit })
}

/// τ = det(c', c'', c''') / |c' × c''|²; nothing where the denominator is zero.
fn torsion(condition: &Condition) -> Option<Enclosed> {
    let [_, a, b, c] = condition.derivatives.as_slice() else {
        return None;
    };
    let area = cross_squared(a, b);
    if area.is_zero() {
        return None;
    }
    let minor = |i: usize, j: usize| &b[i] * &c[j] - &b[j] * &c[i];
    let volume = &a[0] * minor(1, 2) + &a[1] * minor(2, 0) + &a[2] * minor(0, 1);
    let torsion = volume / &area;
    let unit = torsion_unit(condition, torsion.abs().to_f64(), area.to_f64().sqrt()) * f64::EPSILON;
    Some(Enclosed {
        lower: torsion.clone(),
        upper: torsion,
        unit,
    })
}
