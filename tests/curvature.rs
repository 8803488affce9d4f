//! The claims `curvature` and `thickness`: what is proved of known and of random curves, against exact derivatives.
#![cfg(feature = "prove")]

mod curve_support;

use std::io::Cursor;

use curve_support::{bezier, bspline, fraction};
use knotproof::certificate::{Document, Encoding};
use knotproof::check::{Verdict, check};
use knotproof::claim::curvature::Content;
use knotproof::claim::msd::{Convention, Lower};
use knotproof::claim::thickness;
use knotproof::curve::{Bezier, Curve, Form, read_curve};
use knotproof::number::{Integer, Rational, RationalVector};
use knotproof::prove::curvature::{Certified, Options, PointPiece, Status, certify, write_checked};
use knotproof::prove::thickness as prove_thickness;
use proptest::prelude::*;

fn file(name: &str) -> Curve {
    let path = format!("{}/certs/curves/{name}.json", env!("CARGO_MANIFEST_DIR"));
    read_curve(std::fs::read(path).expect(name)).expect(name).curve
}

fn options(width: u32) -> Options {
    Options {
        relative_width: Rational::new(1.into(), Integer::from(10).pow(width)),
        name: None,
        snapped_joints: None,
    }
}

fn proved(curve: &Curve, width: u32) -> Document<'_, Content> {
    let found = certify(curve, &options(width)).expect("no point");
    assert_eq!(found.status, Status::Certified);
    let document = found.document.expect("a document");
    for encoding in [Encoding::Json, Encoding::Binary] {
        let mut bytes = Cursor::new(Vec::new());
        write_checked(&document, encoding, &mut bytes).expect("accepted");
        assert!(matches!(check(bytes.get_ref().as_slice()), Verdict::Accepted { .. }));
    }
    document
}

/// κ² from exact derivatives; nothing where the curve is not regular.
fn squared_at(piece: &Bezier, u: &Rational) -> Option<Rational> {
    let v = piece.derivatives(u, 2).expect("inside");
    let zero = fraction(0, 1);
    let at = |k: usize, i: usize| v[k].get(i).unwrap_or(&zero).clone();
    let square = |x: Rational| &x * &x;
    let speed = (0..3).fold(zero.clone(), |sum, i| sum + square(at(1, i)));
    let bend = [(0, 1), (1, 2), (2, 0)]
        .iter()
        .map(|(i, j)| square(at(1, *i) * at(2, *j) - at(1, *j) * at(2, *i)))
        .fold(zero.clone(), |sum, x| sum + x);
    (speed != zero).then(|| bend / (&speed * &speed * &speed))
}

/// No sample is above the upper bound, the witness attains the lower one, and (upper − lower)/upper is as asked.
fn holds(curve: &Curve, content: &Content, width: u32, samples: i64) {
    let chain = curve.chain();
    let statement = &content.statement;
    for piece in chain.pieces() {
        for k in 0..=samples {
            if let Some(squared) = squared_at(piece, &fraction(k, samples)) {
                assert!(
                    squared <= statement.upper_squared,
                    "{statement:?}: {squared} at {k}/{samples}"
                );
            }
        }
    }
    let witness = &content.evidence;
    let attained = squared_at(&chain.pieces()[witness.piece], &witness.u).expect("regular");
    assert!(attained >= statement.lower_squared, "{statement:?}");
    assert!(attained <= statement.upper_squared, "{statement:?}");
    let rest = fraction(1, 1) - options(width).relative_width;
    assert!(
        statement.lower_squared >= &statement.upper_squared * &rest * &rest,
        "{statement:?}"
    );
}

#[test]
fn exact_maxima() {
    // Squares: circle of radius 3/2, ellipse a/b² = 3, parabola y = x², a circular arc beside lines, a segment.
    for (name, squared) in [
        ("nurbs-circle-radius-3-2", fraction(4, 9)),
        ("nurbs-circle", fraction(1, 1)),
        ("nurbs-ellipse", fraction(9, 1)),
        ("parabola", fraction(4, 1)),
        ("stadium", fraction(1, 1)),
        ("segment", fraction(0, 1)),
        ("square", fraction(0, 1)),
    ] {
        let curve = file(name);
        let statement = proved(&curve, 9).claim.statement;
        assert_eq!(
            [&statement.lower_squared, &statement.upper_squared],
            [&squared, &squared],
            "{name}"
        );
    }
}

#[test]
fn a_cubic_whose_maximum_is_known() {
    // y = x³ for x from 0 to 1: κ is greatest where 45x⁴ = 1.
    let points = RationalVector::from_rationals(&[
        fraction(0, 1),
        fraction(0, 1),
        fraction(1, 3),
        fraction(0, 1),
        fraction(2, 3),
        fraction(0, 1),
        fraction(1, 1),
        fraction(1, 1),
    ]);
    let piece = Bezier::new(2, points, None).expect("a piece");
    let curve = Curve::new(2, Form::Bezier(vec![piece])).expect("a curve");
    for width in [3, 9, 15, 30] {
        let claim = proved(&curve, width).claim;
        holds(&curve, &claim, width, 64);
        // κ² = 36x²/(1 + 9x⁴)³ = 36x²/(6/5)³ with x² = 1/√45, so (κ²)² = 36²·5⁶/(45·6⁶).
        let fourth = fraction(36 * 36 * 15_625, 45 * 46_656);
        let [lower, upper] = [&claim.statement.lower_squared, &claim.statement.upper_squared];
        assert!(lower * lower <= fourth && fourth <= upper * upper, "{width}");
    }
}

#[test]
fn all_example_curves() {
    let folder = format!("{}/certs/curves", env!("CARGO_MANIFEST_DIR"));
    let mut decided = 0;
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let json = std::fs::read(entry.expect("an entry").path()).expect("a file");
        let curve = read_curve(json).expect("a curve").curve;
        let Certified { document, status, .. } = certify(&curve, &options(9)).expect("no point");
        if let Some(document) = document {
            assert_eq!(status, Status::Certified);
            let samples = if curve.chain().count() > 100 { 3 } else { 48 };
            holds(&curve, &document.claim, 9, samples);
            decided += 1;
        }
    }
    assert!(decided >= 30, "{decided}");
}

#[test]
fn parameters_that_are_not_regular_are_named() {
    let why = |curve: &Curve| match certify(curve, &options(9)).expect("no point") {
        Certified {
            document: None,
            status: Status::Undecided(why),
            ..
        } => why,
        _ => panic!("a document"),
    };
    let cusp = why(&file("cusp"));
    assert!(cusp.contains("vanishes at the parameter 1/2"), "{cusp}");
    let coincident = why(&file("coincident-ends"));
    assert!(
        coincident.contains("unbounded") && coincident.ends_with("the parameter 0"),
        "{coincident}"
    );
    // The cusp of (s², s³) at s = 0 for s from −1 to 2, at the parameter 1/3, which halving never meets.
    let points = [(1, -1, 1), (-1, 2, 1), (0, -4, 1), (4, 8, 1)];
    let numbers: Vec<Rational> = points
        .iter()
        .flat_map(|(x, y, q)| [fraction(*x, *q), fraction(*y, *q)])
        .collect();
    let piece = Bezier::new(2, RationalVector::from_rationals(&numbers), None).expect("a piece");
    let third = why(&Curve::new(2, Form::Bezier(vec![piece])).expect("a curve"));
    assert!(third.contains("0.33333"), "{third}");
}

#[test]
fn corners_are_told() {
    let found = certify(&file("square"), &options(9)).map(|found| found.corners);
    assert_eq!(found.ok(), Some(vec![0, 1, 2, 3]));
}

#[test]
fn a_piece_that_is_a_point_is_refused() {
    let piece = |x: [i64; 4]| Bezier::new(2, RationalVector::from_rationals(&x.map(|x| fraction(x, 1))), None);
    let pieces = [[0, 0, 1, 0], [1, 0, 1, 0]].map(|x| piece(x).expect("a piece"));
    let curve = Curve::new(2, Form::Bezier(pieces.to_vec())).expect("a curve");
    assert_eq!(certify(&curve, &options(9)).err(), Some(PointPiece(1)));
}

#[test]
fn degree_25() {
    let numbers: Vec<Rational> = (0..26_i64)
        .flat_map(|k| [fraction(k, 2), fraction(k * k * 7 % 11, 3), fraction(k * 5 % 7, 2)])
        .collect();
    let piece = Bezier::new(3, RationalVector::from_rationals(&numbers), None).expect("a piece");
    let curve = Curve::new(3, Form::Bezier(vec![piece])).expect("a curve");
    holds(&curve, &proved(&curve, 9).claim, 9, 40);
}

fn thick(curve: &Curve, convention: Convention, width: u32) -> thickness::Statement {
    let options = prove_thickness::Options {
        convention,
        relative_width: options(width).relative_width,
        budget: None,
        name: None,
        snapped_joints: None,
    };
    let mut found = prove_thickness::certify(curve, &options, &|_| ()).expect("certifies");
    assert_eq!(found.status, Status::Certified);
    for encoding in [Encoding::Json, Encoding::Binary] {
        found
            .write_checked(encoding, &mut Cursor::new(Vec::new()))
            .expect("accepted");
    }
    found.document.expect("a document").claim.statement
}

#[test]
fn known_thicknesses() {
    // Ellipse: b²/a = 1/3 from the curvature; stadium and circle: both numbers are 1; corners: 0; a straight arc: infinite.
    let ellipse = thick(&file("nurbs-ellipse"), Convention::Smooth, 9);
    assert_eq!(ellipse.lower_squared, Lower::Finite(fraction(1, 9)));
    assert_eq!(ellipse.upper_squared, Some(fraction(1, 9)));
    let stadium = thick(&file("stadium"), Convention::Smooth, 6);
    assert_eq!(stadium.upper_squared, Some(fraction(1, 1)));
    let square = thick(&file("square"), Convention::Smooth, 9);
    assert_eq!(square.upper_squared, Some(fraction(0, 1)));
    let parabola = thick(&file("parabola"), Convention::Critical, 9);
    assert_eq!(parabola.lower_squared, Lower::Finite(fraction(1, 4)));
    let segment = thick(&file("segment"), Convention::Critical, 9);
    assert_eq!(segment.lower_squared, Lower::Infinite);
    // Half of σ = 0.44267517037660659944…, where the least radius of curvature is 0.4269….
    let mp06 = thick(&file("mp06-figure-1"), Convention::Smooth, 12);
    let half = fraction(4_426_751_703_766_066, 20_000_000_000_000_000);
    let next = fraction(4_426_751_703_766_067, 20_000_000_000_000_000);
    let Lower::Finite(lower) = mp06.lower_squared else {
        panic!("finite")
    };
    assert!(lower <= &next * &next, "{lower}");
    assert!(mp06.upper_squared.is_some_and(|upper| upper >= &half * &half));
}

#[test]
fn open_curves_need_the_convention_critical() {
    let curve = file("parabola");
    let options = prove_thickness::Options {
        convention: Convention::Smooth,
        relative_width: fraction(1, 1000),
        budget: None,
        name: None,
        snapped_joints: None,
    };
    let refused = prove_thickness::certify(&curve, &options, &|_| ()).err();
    assert!(
        matches!(refused, Some(prove_thickness::RefusedCurve::Open)),
        "{refused:?}"
    );
}

/// What is stated of a random curve is true of it.
fn random_curve_holds(curve: &Curve) {
    match certify(curve, &options(6)) {
        Ok(Certified {
            document: Some(document),
            status,
            ..
        }) => {
            write_checked(&document, Encoding::Binary, &mut Cursor::new(Vec::new())).expect("accepted");
            let width = if status == Status::Certified { 6 } else { 0 };
            holds(curve, &document.claim, width, 12);
        }
        Ok(Certified { status, .. }) => assert!(matches!(status, Status::Undecided(_))),
        Err(PointPiece(piece)) => assert!(curve.chain().pieces()[piece].start_direction().is_none()),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_pieces(piece in bezier(6)) {
        let curve = Curve::new(piece.dimension(), Form::Bezier(vec![piece])).expect("a curve");
        random_curve_holds(&curve);
    }

    #[test]
    fn random_splines(spline in bspline(4)) {
        random_curve_holds(&Curve::from(spline));
    }
}
