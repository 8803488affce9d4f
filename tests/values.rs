//! Results of operations: what the prover finds is accepted by the checker, and is what it must be.
#![cfg(feature = "prove")]

use std::io::Cursor;

use knotproof::certificate::{Document, Encoding};
use knotproof::check::values::check_values;
use knotproof::claim::values::{Content, Operation, Outcome, Witness};
use knotproof::curve::{BSpline, Bezier, Curve, Form, read_curve};
use knotproof::number::{Integer, Rational, RationalVector};
use knotproof::prove::domain::{Status, write_checked};
use knotproof::prove::values::{Kind, Options, ValuesError, certify};
use proptest::prelude::*;

fn fraction(numerator: i64, denominator: i64) -> Rational {
    Rational::new(numerator.into(), denominator.into())
}

fn vector(numbers: &[i64]) -> RationalVector {
    let numbers: Vec<Rational> = numbers.iter().map(|x| fraction(*x, 1)).collect();
    RationalVector::from_rationals(&numbers)
}

fn options() -> Options {
    Options {
        operations: None,
        samples: 2,
        targets: Vec::new(),
        others: Vec::new(),
        relative_width: Rational::new(1.into(), Integer::from(10).pow(9)),
        name: None,
        snapped_joints: None,
    }
}

fn curve(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_curve(std::fs::read(&path).expect(&path)).expect(name).curve
}

fn written(document: &Document<Content>) {
    for encoding in [Encoding::Json, Encoding::Binary] {
        write_checked(document, encoding, &mut Cursor::new(Vec::new())).expect("accepted");
    }
}

fn bounds<'d>(document: &'d Document<Content>) -> [&'d Rational; 2] {
    let entry = document.claim.statement.entries.last().expect("an entry");
    let Outcome::DistanceSquared { lower, upper } = &entry.outcome else {
        panic!("a distance");
    };
    [lower, upper]
}

#[test]
fn example_curves() {
    for name in [
        "nurbs-ellipse",
        "unclamped-periodic",
        "stadium",
        "cusp",
        "planar-degree-4",
        "corner-150",
    ] {
        let curve = curve(name);
        let found = certify(&curve, &options()).expect(name);
        assert_eq!(found.status, Status::Certified, "{name}");
        written(&found.document);
    }
}

#[test]
fn known_distances() {
    let circle = curve("nurbs-circle");
    let near = |x: i64, y: i64| {
        let options = Options {
            operations: Some(vec![Kind::NearestPoint]),
            targets: vec![vec![fraction(x, 1), fraction(y, 1)]],
            ..options()
        };
        let found = certify(&circle, &options).expect("a circle").document;
        written(&found);
        bounds(&found).map(Clone::clone)
    };
    assert_eq!(near(3, 0), [fraction(4, 1), fraction(4, 1)]);
    assert_eq!(near(0, 0), [fraction(1, 1), fraction(1, 1)]);
    assert_eq!(near(1, 0), [fraction(0, 1), fraction(0, 1)]);
    // (√2 − 1)² = 3 − 2√2, of which 0.1715728752538099 is the beginning.
    let [lower, upper] = near(1, 1);
    assert!(lower < fraction(1_715_728_752_538_100, 10_000_000_000_000_000));
    assert!(upper > fraction(1_715_728_752_538_099, 10_000_000_000_000_000));
    assert!(&upper - &lower <= fraction(1, 1_000_000_000) * &upper);
}

#[test]
fn known_distances_of_curves() {
    let circle = curve("nurbs-circle");
    let segment = |from: [i64; 2], to: [i64; 2]| {
        let piece = Bezier::new(2, vector(&[from[0], from[1], to[0], to[1]]), None).expect("a piece");
        Curve::new(2, Form::Bezier(vec![piece])).expect("a curve")
    };
    let between = |other: Curve| {
        let options = Options {
            operations: Some(vec![Kind::CurveDistance]),
            others: vec![other],
            ..options()
        };
        let found = certify(&circle, &options).expect("a circle");
        assert_eq!(found.status, Status::Certified);
        written(&found.document);
        let trees = found.document.claim.evidence.witnesses.iter();
        let has_tree = trees
            .into_iter()
            .all(|w| matches!(w, Witness::Distance { tree: Some(_), .. }));
        (bounds(&found.document).map(Clone::clone), has_tree)
    };
    let ([lower, upper], has_tree) = between(segment([-5, 3], [4, 3]));
    assert!(has_tree && lower <= fraction(4, 1) && upper >= fraction(4, 1));
    let ([lower, upper], has_tree) = between(segment([0, 0], [4, 3]));
    assert!(!has_tree && lower == fraction(0, 1) && upper < fraction(1, 1_000_000_000_000));
}

#[test]
fn what_is_not_offered() {
    let (eight, parabola) = (curve("figure-eight"), curve("parabola"));
    let asking = |curve: &Curve, kind| {
        let options = Options {
            operations: Some(vec![kind]),
            ..options()
        };
        certify(curve, &options).err()
    };
    for kind in [
        Kind::InsertKnot,
        Kind::Split,
        Kind::Decompose,
        Kind::Torsion,
        Kind::NearestPoint,
    ] {
        let error = asking(&eight, kind);
        assert!(matches!(error, Some(ValuesError::NotOffered { kind: found, .. }) if found == kind));
    }
    assert_eq!(asking(&parabola, Kind::Split), None);
    let wrong = Options {
        targets: vec![vec![fraction(0, 1); 3]],
        ..options()
    };
    let expected = ValuesError::Dimension { expected: 2, found: 3 };
    assert_eq!(certify(&parabola, &wrong).err(), Some(expected));
    let still = Curve::new(
        2,
        Form::Bezier(vec![Bezier::new(2, vector(&[1, 1, 1, 1]), None).expect("a piece")]),
    )
    .expect("a curve");
    let expected = ValuesError::PointPiece { other: None, piece: 0 };
    assert_eq!(certify(&still, &options()).err(), Some(expected));
}

#[test]
fn a_removable_knot_is_found() {
    let spline = BSpline::new(
        2,
        3,
        vector(&[0, 0, 0, 0, 4, 4, 4, 4]),
        vector(&[0, 0, 1, 3, 4, -1, 6, 2]),
        None,
    );
    let spline = spline
        .expect("a spline")
        .insert_knot(&fraction(1, 1), 2)
        .expect("inserts");
    let curve = Curve::from(spline);
    let found = certify(&curve, &options()).expect("a curve").document;
    written(&found);
    let times = found
        .claim
        .statement
        .entries
        .iter()
        .find_map(|entry| match &entry.operation {
            Operation::RemoveKnot { times, .. } => Some(*times),
            _ => None,
        });
    assert_eq!(times, Some(2));
}

/// Splines of small integers, of any continuity, clamped or not, polynomial or rational.
fn splines() -> impl Strategy<Value = Curve> {
    (2usize..=3, 1usize..=4, 0usize..=3).prop_flat_map(|(dimension, degree, more)| {
        let count = degree + 1 + more;
        (
            prop::collection::vec(0i64..=2, count + degree),
            prop::collection::vec(-9i64..=9, count * dimension),
            prop::option::of(prop::collection::vec(1i64..=5, count)),
        )
            .prop_filter_map(
                "a curve without pieces that are points",
                move |(steps, points, weights)| {
                    let mut knots = vec![0];
                    knots.extend(steps.iter().scan(0, |knot, step| {
                        *knot += step;
                        Some(*knot)
                    }));
                    let weights = weights.map(|weights| vector(&weights));
                    let spline = BSpline::new(dimension, degree, vector(&knots), vector(&points), weights).ok()?;
                    let curve = Curve::from(spline);
                    knotproof::check::chain::Chain::new(&curve).is_ok().then_some(curve)
                },
            )
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn found_is_accepted(curve in splines()) {
        let options = Options { samples: 1, targets: vec![vec![fraction(1, 3); curve.dimension()]], ..options() };
        let found = certify(&curve, &options).expect("a curve");
        prop_assert_eq!(check_values(&curve, &found.document.claim), Ok(()));
    }

    #[test]
    fn changed_is_rejected(curve in splines(), entry in any::<prop::sample::Index>()) {
        let options = Options {
            operations: Some(vec![Kind::Point, Kind::Derivative, Kind::Curvature, Kind::InsertKnot, Kind::ElevateDegree, Kind::Split]),
            samples: 1,
            ..options()
        };
        let mut content = certify(&curve, &options).expect("a curve").document.claim;
        let entries = &mut content.statement.entries;
        let number = entry.index(entries.len());
        let little = Rational::new(1.into(), Integer::from(10).pow(30));
        match &mut entries[number].outcome {
            Outcome::Point(numbers) | Outcome::Vector(numbers) => numbers[0] += little,
            Outcome::ValueSquared(number) | Outcome::Value(number) => *number += little,
            Outcome::Curve(result) => **result = moved(result),
            Outcome::Curves(results) => results[1] = moved(&results[1]),
            Outcome::DistanceSquared { .. } => unreachable!("no distances"),
        }
        prop_assert!(check_values(&curve, &content).is_err());
    }
}

/// With a control point moved that acts in the domain: one in the middle.
fn moved(curve: &Curve) -> Curve {
    let Form::BSpline(spline) = curve.form() else {
        panic!("a spline");
    };
    let mut points: Vec<Rational> = spline.points().iter().collect();
    let (start, end) = spline.domain();
    let acting = (0..spline.count()).find(|i| {
        let (from, to) = (spline.knots().get(*i), spline.knots().get(i + spline.degree() + 1));
        from < to && from < end && to > start
    });
    points[acting.expect("a control point") * spline.dimension()] += fraction(1, 1_000_000_000);
    BSpline::new(
        spline.dimension(),
        spline.degree(),
        spline.knots().clone(),
        RationalVector::from_rationals(&points),
        spline.weights().cloned(),
    )
    .expect("a spline")
    .into()
}
