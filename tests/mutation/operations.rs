//! The truth about results of operations, by the operations of `curve` and the search for distances.

use knotproof::certificate::Document;
use knotproof::claim::values::{Entry, Operation, Outcome, Side};
use knotproof::curve::{self, BSpline, Curve, Form};
use knotproof::number::{Integer, Rational, RationalVector};
use knotproof::prove::values::{Kind, Options, certify};

/// Is every entry true?
pub fn values_are_true(document: &Document) -> bool {
    let Some(content) = document.claim.values() else {
        return false;
    };
    let entries = &content.statement.entries;
    entries.iter().all(|entry| is_true(&document.curve, entry))
}

fn is_true(curve: &Curve, entry: &Entry) -> bool {
    let spline = spline_of(curve);
    match (&entry.operation, &entry.outcome) {
        (Operation::Point { parameter }, Outcome::Point(point)) => spline.evaluate(parameter).as_ref() == Ok(point),
        (Operation::Derivative { parameter, order, side }, Outcome::Vector(vector)) => {
            derivatives(&spline, parameter, *side, *order as usize).is_some_and(|found| found.last() == Some(vector))
        }
        (Operation::Curvature { parameter, side }, Outcome::ValueSquared(squared)) => {
            // In the plane: (x'y'' − y'x'')²/(x'² + y'²)³.
            derivatives(&spline, parameter, *side, 2).is_some_and(|found| {
                let [a, b] = [&found[1], &found[2]];
                let turn = &a[0] * &b[1] - &a[1] * &b[0];
                let speed = &a[0] * &a[0] + &a[1] * &a[1];
                &turn * &turn == squared * &speed * &speed * &speed
            })
        }
        (Operation::InsertKnot { parameter, times }, Outcome::Curve(result)) => {
            let Ok(found) = spline.insert_knot(parameter, *times as usize) else {
                return false;
            };
            agrees(&spline_of(result), &found)
        }
        (Operation::RemoveKnot { parameter, times }, Outcome::Curve(result)) => {
            let again = spline_of(result).insert_knot(parameter, *times as usize);
            again.is_ok_and(|again| agrees(&again, &spline))
        }
        (Operation::Split { parameter }, Outcome::Curves(results)) => {
            let Ok((first, second)) = spline.split(parameter) else {
                return false;
            };
            agrees(&spline_of(&results[0]), &first) && agrees(&spline_of(&results[1]), &second)
        }
        (Operation::Decompose, Outcome::Curve(result)) => curve.chain().pieces() == result.chain().pieces(),
        (Operation::NearestPoint { target }, Outcome::DistanceSquared { lower, upper }) => is_near(
            curve,
            Kind::NearestPoint,
            vec![target.clone()],
            Vec::new(),
            [lower, upper],
        ),
        (Operation::CurveDistance { other }, Outcome::DistanceSquared { lower, upper }) => is_near(
            curve,
            Kind::CurveDistance,
            Vec::new(),
            vec![other.as_ref().clone()],
            [lower, upper],
        ),
        _ => false,
    }
}

/// These certificates are about splines and single pieces.
fn spline_of(curve: &Curve) -> BSpline {
    let pieces = match curve.form() {
        Form::BSpline(spline) => return spline.clone(),
        Form::Bezier(pieces) => pieces,
    };
    let [piece] = pieces.as_slice() else {
        panic!("one piece");
    };
    let count = piece.degree() + 1;
    let knots: Vec<Rational> = (0..2 * count)
        .map(|i| Rational::from_integer(Integer::from(i / count)))
        .collect();
    BSpline::new(
        piece.dimension(),
        piece.degree(),
        RationalVector::from_rationals(&knots),
        piece.points().clone(),
        piece.weights().cloned(),
    )
    .expect("a spline")
}

fn derivatives(spline: &BSpline, parameter: &Rational, side: Side, order: usize) -> Option<Vec<Vec<Rational>>> {
    let (start, end) = spline.domain();
    let side = match side {
        Side::Left if *parameter == start => return None,
        Side::Right if *parameter == end => return None,
        Side::Left => curve::Side::Before,
        Side::Right => curve::Side::After,
    };
    spline.derivatives(parameter, side, order).ok()
}

/// The same knots, and the same points at many parameters.
fn agrees(a: &BSpline, b: &BSpline) -> bool {
    let (start, end) = a.domain();
    let parameters = (0..=64).map(|k| &start + (&end - &start) * Rational::new(Integer::from(k), Integer::from(64)));
    a.degree() == b.degree()
        && a.knots() == b.knots()
        && parameters.into_iter().all(|t| a.evaluate(&t) == b.evaluate(&t))
}

/// Does the interval meet one that is found anew?
fn is_near(
    curve: &Curve,
    kind: Kind,
    targets: Vec<Vec<Rational>>,
    others: Vec<Curve>,
    [lower, upper]: [&Rational; 2],
) -> bool {
    let options = Options {
        operations: Some(vec![kind]),
        samples: 0,
        targets,
        others,
        relative_width: Rational::new(1.into(), Integer::from(10).pow(12)),
        name: None,
        snapped_joints: None,
    };
    let Ok(found) = certify(curve, &options) else {
        return false;
    };
    let entries = &found.document.claim.statement.entries;
    entries.iter().all(|entry| match &entry.outcome {
        Outcome::DistanceSquared {
            lower: least,
            upper: most,
        } => lower <= most && upper >= least,
        _ => false,
    })
}
