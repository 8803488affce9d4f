//! The rows of GKK09: the polytopes of its levels, what it takes for their error, and what their error is.

use std::io::Cursor;

use num_traits::{Signed, Zero};

use super::{CompareError, Row, Standing, Value};
use crate::certificate::Encoding;
use crate::check::domain::Context;
use crate::claim::domain::{Evidence, Outcome};
use crate::curve::{Curve, Form};
use crate::number::{Integer, Rational, RationalExt};
use crate::prove::domain::levels::{Degree, Level, Levels};
use crate::prove::domain::{Bounds, Options, Problem, Question, QuestionError, Status, certify, write_checked};
use crate::prove::linear_program::GoodLp;

/// Levels beyond this are refused.
pub const MOST_LEVELS: u32 = 16;
/// No level of more inequalities is computed.
pub const MOST_INEQUALITIES: usize = 400_000;

const GKK09: &str = "GKK09";
const CERTIFIED: &str = "certified";
/// Rows of the certified outer polytope at most.
const BUDGET: usize = 20_000;
/// Up to this level areas are fractions; beyond, and in space, these grow too long, and measures are enclosed.
const EXACT_LEVELS: usize = 6;
/// The certified domain is this part narrower than the error of the last level.
const NARROWER: f64 = 1.0 / 128.0;

/// Whose convex domain is compared, and how far.
#[derive(Clone, Debug)]
pub struct DomainOptions {
    /// The control point, from 0.
    pub point: usize,
    /// The box; `None` is a square or cube around the point, its edge twice the longest side of the box of all control points.
    pub bounds: Option<Bounds>,
    /// The sign; `None` is that which the curve has.
    pub sign: Option<crate::claim::domain::Sign>,
    /// A part of the curve in its own parameter; `None` is the whole curve.
    pub interval: Option<[Rational; 2]>,
    /// The last level, at most [`MOST_LEVELS`].
    pub levels: u32,
    /// Where GKK09 stops: at the first level whose relative error (20) is at most this.
    pub tolerance: Option<Rational>,
}

impl DomainOptions {
    /// The set that is asked for.
    ///
    /// # Errors
    /// [`QuestionError`].
    pub fn problem(&self, curve: &Curve) -> Result<Problem, QuestionError> {
        let bounds = self.bounds.clone().unwrap_or_else(|| Bounds::Edge(usual_edge(curve)));
        let question = Question {
            point: self.point,
            sign: self.sign,
            interval: self.interval.clone(),
            bounds,
        };
        Problem::new(curve, &question)
    }
}

/// Twice the longest side of the box of all control points; 1 when they are one point.
fn usual_edge(curve: &Curve) -> Rational {
    let d = curve.dimension();
    let mut ends: Vec<Option<[Rational; 2]>> = vec![None; d];
    let mut add = |axis: usize, x: Rational| {
        ends[axis] = Some(match ends[axis].take() {
            None => [x.clone(), x],
            Some([low, high]) => [low.min(x.clone()), high.max(x)],
        });
    };
    match curve.form() {
        Form::BSpline(spline) => (0..spline.count() * d).for_each(|k| add(k % d, spline.points().get(k))),
        Form::Bezier(pieces) => pieces.iter().for_each(|piece| {
            (0..=piece.degree()).for_each(|k| {
                let point = piece.point(k);
                point.into_iter().enumerate().for_each(|(axis, x)| add(axis, x));
            });
        }),
    }
    let sides = ends.into_iter().flatten().map(|[low, high]| high - low);
    let longest = sides.max().unwrap_or_default();
    match longest.is_zero() {
        true => Rational::from_integer(Integer::ONE),
        false => longest * Rational::from_integer(2.into()),
    }
}

/// A level of GKK09; errors are relative to the measure of the level, but for [`successive`](LevelComparison::successive).
#[derive(Clone, Debug)]
pub struct LevelComparison {
    /// How often every knot interval was halved.
    pub level: u32,
    /// Coefficients that have to be ≥ 0; those at shared ends count twice.
    pub inequalities: usize,
    /// The area or volume of the polytope, enclosed; 0 when it is empty or flat.
    pub measure: [Rational; 2],
    /// The area or volume of the box where the sign is right at the ends of the level's parts, enclosed: it contains the whole domain.
    pub outer_measure: [Rational; 2],
    /// GKK09's (20) for the step that led here: the polytope without the one before, relative to that, enclosed. `None` while the one before is empty.
    pub successive: Option<[Rational; 2]>,
    /// (outer − inner)/inner, enclosed: the level's own bound of its error. `None` while it is empty.
    pub own: Option<[Rational; 2]>,
    /// The error, enclosed by the certified measure of the domain. `None` while the level is empty, or when nothing was certified.
    pub error: Option<[Rational; 2]>,
}

/// Levels of GKK09 beside the certified domain.
#[derive(Clone, Debug)]
pub struct DomainComparison {
    /// The set.
    pub problem: Problem,
    /// In which degree the sign function was written: the paper's, or its own when a piece is rational.
    pub degree: Degree,
    /// The levels, in their order from 0.
    pub levels: Vec<LevelComparison>,
    /// Bounds of the area or volume of K ∩ B that the checker accepted; `[0, 0]` when it is empty.
    pub certified: Option<[Rational; 2]>,
}

/// Computes the levels and the certified domain, and adds their rows.
pub(super) fn compare(
    curve: &Curve,
    options: &DomainOptions,
    problem: Problem,
    rows: &mut Vec<Row>,
) -> Result<DomainComparison, CompareError> {
    let chain = curve.chain();
    let polynomial = chain.pieces().iter().all(crate::curve::Bezier::is_polynomial);
    let degree = if polynomial { Degree::Paper } else { Degree::True };
    let mut levels = {
        let context = Context::new(curve, &problem.domain).map_err(failed)?;
        match curve.dimension() {
            2 => all_levels::<2>(&context, degree, options),
            _ => all_levels::<3>(&context, degree, options),
        }
    };
    let own = levels.iter().rev().find_map(|level| level.own.as_ref());
    let width = own.map_or(1e-6, |own| own[1].to_f64() * NARROWER).clamp(1e-9, 1e-3);
    let certified = certified_rows(curve, &problem, width, rows)?;
    for level in &mut levels {
        match &certified {
            // A sign that is 0 whatever the point is leaves polytopes of all levels as they are, and no point of the domain.
            Some([_, most]) if most.is_zero() => level.own = None,
            Some(certified) if level.measure[0].is_positive() => {
                level.error = Some(relative(certified, &level.measure));
            }
            _ => {}
        }
    }
    let found = DomainComparison {
        problem,
        degree,
        levels,
        certified,
    };
    level_rows(&found, options, curve.dimension(), rows);
    Ok(found)
}

fn failed(error: impl std::fmt::Display) -> CompareError {
    CompareError::Failed(error.to_string())
}

/// (whole − part)/part for a part of the whole, both enclosed, the part positive.
fn relative(whole: &[Rational; 2], part: &[Rational; 2]) -> [Rational; 2] {
    let least = (&whole[0] - &part[1]) / &part[1];
    [least.max(Rational::zero()), (&whole[1] - &part[0]) / &part[0]]
}

fn all_levels<const D: usize>(context: &Context, degree: Degree, options: &DomainOptions) -> Vec<LevelComparison> {
    let mut found: Vec<LevelComparison> = Vec::new();
    // The paper's degree is asked for only where all pieces are polynomial.
    let Ok(mut levels) = Levels::<D>::new(context, degree, |_| true) else {
        return found;
    };
    for _ in 0..=options.levels.min(MOST_LEVELS) {
        if !found.is_empty() && levels.inequalities() > MOST_INEQUALITIES {
            break;
        }
        let outer_measure = levels.outer_measure();
        let (mut level, _) = levels.step(D == 2 && found.len() <= EXACT_LEVELS);
        if let Some(exact) = level.exact_measure.take() {
            level.measure = [exact.clone(), exact];
        }
        let stop = stops(&level, options);
        let zero = || [Rational::zero(), Rational::zero()];
        let outer_measure = outer_measure.unwrap_or_else(zero);
        found.push(LevelComparison {
            level: level.level,
            inequalities: level.inequalities,
            own: level.measure[0]
                .is_positive()
                .then(|| relative(&outer_measure, &level.measure)),
            measure: level.measure,
            outer_measure,
            successive: level.relative_error,
            error: None,
        });
        if stop {
            break;
        }
    }
    found
}

fn stops(level: &Level, options: &DomainOptions) -> bool {
    let tolerance = options.tolerance.as_ref();
    let error = level.relative_error.as_ref();
    error
        .zip(tolerance)
        .is_some_and(|(error, tolerance)| error[1] <= *tolerance)
}

/// "area" or "volume".
fn measure_name(dimension: usize) -> &'static str {
    if dimension == 2 { "area" } else { "volume" }
}

fn certified_rows(
    curve: &Curve,
    problem: &Problem,
    width: f64,
    rows: &mut Vec<Row>,
) -> Result<Option<[Rational; 2]>, CompareError> {
    let options = Options {
        tolerance: Rational::from_f64(width).unwrap_or_else(|| Rational::new(Integer::ONE, Integer::from(1_000_000))),
        budget: BUDGET,
        name: None,
        snapped_joints: None,
        measure_rounds: false,
        solver: &GoodLp,
    };
    let found = certify(curve, problem, &options);
    let (standing, why) = match &found.status {
        Status::Certified => (Standing::Certified, None),
        Status::Undecided(why) => (Standing::Undecided, Some(why)),
    };
    let row = |key, quantity: String, value| {
        let row = Row::new(CERTIFIED, key, quantity, value, standing);
        match why {
            Some(why) => row.remark(why.as_str()),
            None => row,
        }
    };
    let measure = format!("{} of the convex domain in the box", measure_name(curve.dimension()));
    let Some(document) = &found.document else {
        rows.push(row("certified.domain.measure", measure, Value::None));
        return Ok(None);
    };
    write_checked(document, Encoding::Binary, &mut Cursor::new(Vec::new())).map_err(failed)?;
    let Outcome::Sandwich {
        inner_measure,
        outer_measure,
    } = &document.claim.statement.outcome
    else {
        let empty = row("certified.domain.measure", measure, Value::Number(Rational::zero()));
        rows.push(empty.remark("the domain is empty"));
        return Ok(Some([Rational::zero(), Rational::zero()]));
    };
    let between = Value::Between(inner_measure.clone(), Some(outer_measure.clone()));
    rows.push(row("certified.domain.measure", measure, between));
    let error = (outer_measure - inner_measure) / inner_measure;
    let quantity = "its relative error, outer less inner polytope".to_string();
    rows.push(row("certified.domain.error", quantity, Value::Number(error)));
    if let Evidence::Sandwich { rows: outer, .. } = &document.claim.evidence {
        let quantity = "half-spaces of its outer polytope".to_string();
        rows.push(row("certified.domain.rows", quantity, count(outer.len())));
    }
    Ok(Some([inner_measure.clone(), outer_measure.clone()]))
}

fn count(number: usize) -> Value {
    Value::Count(i64::try_from(number).unwrap_or(i64::MAX))
}

fn level_rows(found: &DomainComparison, options: &DomainOptions, dimension: usize, rows: &mut Vec<Row>) {
    let between = |bounds: &Option<[Rational; 2]>| match bounds {
        Some([low, high]) => Value::Between(low.clone(), Some(high.clone())),
        None => Value::None,
    };
    let name = measure_name(dimension);
    let (mut before_is_empty, mut first) = (true, true);
    for level in &found.levels {
        let row = |key: &str, quantity: &str, value, standing| {
            let quantity = format!("level {}, {quantity}", level.level);
            Row::new(GKK09, format!("gkk09.{}.{key}", level.level), quantity, value, standing)
        };
        let empty = level.measure[0].is_zero();
        rows.push(row(
            "inequalities",
            "inequalities",
            count(level.inequalities),
            Standing::Exact,
        ));
        let measure = row("measure", name, between(&Some(level.measure.clone())), Standing::Exact);
        rows.push(match empty {
            true => measure.remark("empty, which says nothing about the domain"),
            false => measure,
        });
        let successive = row(
            "successive",
            "error (20), less the level before",
            between(&level.successive),
            Standing::Printed,
        );
        rows.push(match &level.successive {
            Some(_) => successive.remark("a difference of iterates bounds nothing"),
            None if first => successive.if_none("there is no level before"),
            None if before_is_empty => successive.if_none("the level before is empty"),
            None => successive,
        });
        let nothing = match &found.certified {
            Some([_, most]) if most.is_zero() => "the domain is empty",
            _ => "the level is empty",
        };
        let own = "error at most, by the signs at its own parameters";
        rows.push(row("own", own, between(&level.own), Standing::Proved).if_none(nothing));
        let why = match found.certified {
            None if !empty => "the domain was not certified",
            _ => nothing,
        };
        rows.push(row("error", "true error", between(&level.error), Standing::Proved).if_none(why));
        (before_is_empty, first) = (empty, false);
    }
    let Some(tolerance) = &options.tolerance else {
        return;
    };
    let quantity = format!("level at which (20) ≤ {} stops", tolerance.format());
    let last = found.levels.last();
    let stopped = last.filter(|level| level.successive.as_ref().is_some_and(|error| error[1] <= *tolerance));
    let row = |value| Row::new(GKK09, "gkk09.stop", quantity.clone(), value, Standing::Printed);
    rows.push(match stopped {
        None => row(Value::None).remark("not reached"),
        Some(level) => match &level.error {
            Some([least, _]) if least > tolerance => {
                row(Value::Count(level.level.into())).remark("the true error is above the tolerance")
            }
            Some([_, most]) if most <= tolerance => {
                row(Value::Count(level.level.into())).remark("the true error is at most the tolerance")
            }
            _ => row(Value::Count(level.level.into())),
        },
    });
}
