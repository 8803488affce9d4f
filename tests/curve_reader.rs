//! The reader of curve files: what it accepts, what it refuses and where, and that nothing makes it panic.

mod curve_support;

use curve_support::{bezier, bspline, fraction, integers};
use knotproof::curve::{
    Bezier, Curve, CurveFault, Form, ReadError, ReadFault, ReadOptions, read_curve, read_curve_with, write_curve,
};
use knotproof::number::{Integer, NumberError, Rational, RationalVector};
use proptest::prelude::*;

/// A document with the given members after the version.
fn document(members: &str) -> String {
    format!("{{\"knotproof\":\"curve/1\",{members}}}")
}

/// A clamped cubic with one member replaced.
fn cubic(degree: &str, knots: &str, points: &str, rest: &str) -> String {
    document(&format!(
        "\"bspline\":{{\"degree\":{degree},\"knots\":{knots},\"points\":{points}{rest}}}"
    ))
}

const KNOTS: &str = "[0,0,0,0,1,1,1,1]";
const POINTS: &str = "[[0,0],[1,2],[3,2],[4,0]]";

fn pieces(pieces: &str) -> String {
    document(&format!("\"bezier\":{{\"pieces\":{pieces}}}"))
}

fn refusal(json: &str) -> (String, ReadFault) {
    let ReadError { path, fault } = read_curve(json).expect_err(json);
    (path, fault)
}

fn curve_refusal(json: &str) -> (String, CurveFault) {
    match refusal(json) {
        (path, ReadFault::Curve(fault)) => (path, fault),
        other => panic!("{json}: {other:?}"),
    }
}

fn at(path: &str, fault: CurveFault) -> (String, CurveFault) {
    (path.to_string(), fault)
}

#[test]
fn numbers_mean_what_the_file_says() {
    let line = |numbers: &str| {
        let json = document(&format!(
            "{numbers}\"bezier\":{{\"pieces\":[{{\"points\":[[0.2,\"0.2\"],[\"1/5\",\"0x1.8p1\"]]}}]}}"
        ));
        let Form::Bezier(pieces) = read_curve(&json).unwrap().curve.into_form() else {
            panic!("Bézier pieces")
        };
        pieces[0].points().iter().collect::<Vec<Rational>>()
    };
    let fifth = fraction(1, 5);
    let three = fraction(3, 1);
    let decimal = vec![fifth.clone(), fifth.clone(), fifth.clone(), three.clone()];
    assert_eq!(line(""), decimal);
    assert_eq!(line("\"numbers\":\"decimal\","), decimal);
    let near = fraction(3_602_879_701_896_397, 1 << 54);
    assert_eq!(
        line("\"numbers\":\"binary64\","),
        vec![near.clone(), near, fifth, three]
    );
}

#[test]
fn escaped_strings_are_numbers_too() {
    let json = pieces(r#"[{"points":[["\u0031","-1.5e3"],[2,3]]}]"#);
    let file = read_curve(&json).unwrap();
    let Form::Bezier(pieces) = file.curve.form() else {
        panic!("Bézier pieces")
    };
    assert_eq!(pieces[0].points(), &integers(&[1, -1500, 2, 3]));
    assert_eq!((file.name, file.snapped), (None, 0));
}

#[test]
fn names_are_kept() {
    let json = document(r#""name":"a \"b\" ü","bezier":{"pieces":[{"points":[[0,0],[1,1]]}]}"#);
    let file = read_curve(&json).unwrap();
    assert_eq!(file.name.as_deref(), Some("a \"b\" ü"));
    let again = read_curve(write_curve(&file.curve, file.name.as_deref())).unwrap();
    assert_eq!(again, file);
}

#[test]
fn closedness_is_asserted() {
    let closed = "\"bezier\":{\"pieces\":[{\"points\":[[0,0],[1,0],[0,1],[0,0]]}]}";
    let open = "\"bezier\":{\"pieces\":[{\"points\":[[0,0],[1,0]]}]}";
    let read = |assertion: &str, form: &str| read_curve(document(&format!("\"closed\":{assertion},{form}")));
    assert!(read("true", closed).unwrap().curve.is_closed());
    assert!(!read("false", open).unwrap().curve.is_closed());
    assert_eq!(read("true", open).unwrap_err().fault, ReadFault::NotClosed);
    assert_eq!(read("false", closed).unwrap_err().fault, ReadFault::NotOpen);
    assert_eq!(read("false", closed).unwrap_err().path, "closed");
    // Of an unclamped spline the chain's ends count, not the control points.
    let spline = "\"bspline\":{\"degree\":2,\"knots\":[-2,-1,0,1,2,3,4,5],\"points\":[[0,0],[2,0],[1,2],[0,0],[2,0]]}";
    assert!(read("true", spline).unwrap().curve.is_closed());
}

#[test]
fn joints_are_snapped_on_request_only() {
    let json = pieces(
        r#"[{"points":[[0,0],[1,0.3]]},{"points":[["1","0.30001"],[2,0]],"weights":[2,3]},{"points":[[2,0],[0,0]]}]"#,
    );
    assert_eq!(curve_refusal(&json), at("bezier.pieces[1].points[0]", CurveFault::Gap));
    let options = ReadOptions { snap_joints: true };
    let file = read_curve_with(&json, options).unwrap();
    assert_eq!(file.snapped, 1);
    let Form::Bezier(list) = file.curve.form() else {
        panic!("Bézier pieces")
    };
    assert_eq!(list[1].point(0), vec![fraction(1, 1), fraction(3, 10)]);
    assert_eq!(list[1].weights(), Some(&integers(&[2, 3])));
    // The closing joint only when closedness is asserted.
    let open = r#""bezier":{"pieces":[{"points":[[0,0],[1,0]]},{"points":[[1,0],[0,0.001]]}]}"#;
    assert_eq!(read_curve_with(document(open), options).unwrap().snapped, 0);
    let file = read_curve_with(document(&format!("\"closed\":true,{open}")), options).unwrap();
    assert_eq!(file.snapped, 1);
    let Form::Bezier(list) = file.curve.form() else {
        panic!("Bézier pieces")
    };
    assert_eq!(list[0].point(0), vec![fraction(0, 1), fraction(1, 1000)]);
}

#[test]
fn documents_of_another_shape_are_refused() {
    let is = |json: &str, path: &str, check: fn(&ReadFault) -> bool| {
        let (found, fault) = refusal(json);
        assert!(check(&fault), "{json}: {fault:?}");
        assert_eq!(found, path, "{json}");
    };
    let syntax: fn(&ReadFault) -> bool = |f| matches!(f, ReadFault::Syntax { .. });
    let unknown: fn(&ReadFault) -> bool = |f| matches!(f, ReadFault::UnknownField { .. });
    let missing: fn(&ReadFault) -> bool = |f| matches!(f, ReadFault::MissingField { .. });
    let duplicate: fn(&ReadFault) -> bool = |f| matches!(f, ReadFault::DuplicateField { .. });
    let wrong: fn(&ReadFault) -> bool = |f| matches!(f, ReadFault::WrongType { .. });
    is("", "", syntax);
    is("{", "", syntax);
    is(
        &cubic("3", KNOTS, "[[0,0],[1,NaN]]", ""),
        "bspline.points[1][1]",
        syntax,
    );
    is(
        &cubic("3", KNOTS, "[[0,0],[1,-Infinity]]", ""),
        "bspline.points[1][1]",
        syntax,
    );
    is(&format!("{} []", cubic("3", KNOTS, POINTS, "")), "", syntax);
    is(
        &cubic("3", KNOTS, POINTS, ",\"rational\":true"),
        "bspline.rational",
        unknown,
    );
    is(&document("\"units\":\"mm\""), "units", unknown);
    is(
        &pieces(r#"[{"points":[[0,0],[1,1]]},{"points":[[1,1],[2,2]],"color":1}]"#),
        "bezier.pieces[1].color",
        unknown,
    );
    is("{\"bezier\":{\"pieces\":[]}}", "", missing);
    is(&document("\"bspline\":{\"degree\":3}"), "bspline", missing);
    is(&document("\"bezier\":{}"), "bezier", missing);
    is(&document("\"name\":\"a\",\"name\":\"b\""), "", duplicate);
    is("[]", "", wrong);
    is("3", "", wrong);
    is(&cubic("-1", KNOTS, POINTS, ""), "bspline.degree", wrong);
    is(&cubic("\"3\"", KNOTS, POINTS, ""), "bspline.degree", wrong);
    is(&cubic("2.5", KNOTS, POINTS, ""), "bspline.degree", wrong);
    is(&cubic("3", "null", POINTS, ""), "bspline.knots", wrong);
    is(&cubic("3", KNOTS, "[[0,0],7]", ""), "bspline.points[1]", wrong);
    is(
        &cubic("3", KNOTS, POINTS, ",\"weights\":null"),
        "bspline.weights",
        wrong,
    );
    is(&document("\"closed\":\"yes\""), "closed", wrong);
    is(&document("\"name\":7"), "name", wrong);
    let fault = ReadFault::Version {
        found: "curve/2".into(),
    };
    // A later version may have other fields: the version is what is wrong.
    assert_eq!(
        refusal("{\"knotproof\":\"curve/2\",\"surface\":[]}"),
        ("knotproof".into(), fault.clone())
    );
    assert_eq!(
        refusal(&cubic("3", KNOTS, POINTS, "").replace("curve/1", "curve/2")),
        ("knotproof".into(), fault)
    );
    let fault = ReadFault::Meaning { found: "float".into() };
    assert_eq!(refusal(&document("\"numbers\":\"float\"")), ("numbers".into(), fault));
    assert_eq!(
        refusal("{\"knotproof\":\"curve/1\"}"),
        (String::new(), ReadFault::NoForm)
    );
    let both =
        document("\"bspline\":{\"degree\":1,\"knots\":[0,0,1,1],\"points\":[[0,0],[1,1]]},\"bezier\":{\"pieces\":[]}");
    assert_eq!(refusal(&both), (String::new(), ReadFault::TwoForms));
    assert_eq!(
        read_curve(b"{\"\xff\":1}").unwrap_err().fault,
        ReadFault::NotUtf8 { offset: 2 }
    );
}

#[test]
fn syntax_errors_name_line_and_column() {
    let ReadFault::Syntax { at, .. } = refusal("{\n \"knotproof\": \"curve/1\",\n }").1 else {
        panic!("a syntax error")
    };
    assert_eq!((at.line, at.column), (3, 2));
}

#[test]
fn texts_that_are_no_numbers_are_refused() {
    let with = |number: &str| refusal(&cubic("3", KNOTS, &format!("[[0,0],[1,2],[3,2],[4,{number}]]"), ""));
    for text in ["null", "true", "[]", "{}"] {
        let (path, fault) = with(text);
        assert_eq!(path, "bspline.points[3][1]");
        assert!(matches!(fault, ReadFault::NotANumber { .. }), "{text}: {fault:?}");
    }
    for text in ["\"NaN\"", "\"inf\"", "\"-Infinity\""] {
        let fault = with(text).1;
        assert!(
            matches!(fault, ReadFault::Number(NumberError::NotFinite { .. })),
            "{text}: {fault:?}"
        );
    }
    assert_eq!(with("\"\"").1, ReadFault::Number(NumberError::Empty));
    assert!(matches!(
        with("\"1/0\"").1,
        ReadFault::Number(NumberError::ZeroDenominator { .. })
    ));
    assert!(matches!(
        with("\"1,5\"").1,
        ReadFault::Number(NumberError::Unexpected { .. })
    ));
    assert!(matches!(
        with("1e999999999").1,
        ReadFault::Number(NumberError::ExponentTooLarge { .. })
    ));
    let long = "1".repeat(1_000_000);
    assert!(matches!(with(&long).1, ReadFault::Number(NumberError::TooLong { .. })));
    let binary = cubic("3", KNOTS, POINTS, "").replace("[4,0]", "[1e999,0]");
    let binary = binary.replace("\"bspline\"", "\"numbers\":\"binary64\",\"bspline\"");
    assert!(matches!(
        refusal(&binary).1,
        ReadFault::Number(NumberError::Overflow { .. })
    ));
}

#[test]
fn data_that_is_no_curve_is_refused() {
    use CurveFault as F;
    let bspline = |knots: &str, points: &str| curve_refusal(&cubic("3", knots, points, ""));
    let weights = |weights: &str| curve_refusal(&cubic("3", KNOTS, POINTS, &format!(",\"weights\":{weights}")));
    let degree = |degree: &str| curve_refusal(&cubic(degree, KNOTS, POINTS, ""));
    assert_eq!(degree("0"), at("bspline.degree", F::Degree { found: 0 }));
    assert_eq!(degree("65"), at("bspline.degree", F::Degree { found: 65 }));
    assert_eq!(
        degree("4"),
        at("bspline.points", F::PointCount { found: 4, expected: 5 })
    );
    assert_eq!(
        bspline(KNOTS, "[[0,0]]"),
        at("bspline.points", F::PointCount { found: 1, expected: 4 })
    );
    assert_eq!(
        bspline(KNOTS, "[]"),
        at("bspline.points", F::PointCount { found: 0, expected: 2 })
    );
    assert_eq!(
        bspline(KNOTS, "[[0],[1],[2],[3]]"),
        at("bspline.points[0]", F::Dimension { found: 1 })
    );
    assert_eq!(
        bspline(KNOTS, "[[0,0,0,0]]"),
        at("bspline.points[0]", F::Dimension { found: 4 })
    );
    assert_eq!(
        bspline(KNOTS, "[[]]"),
        at("bspline.points[0]", F::Dimension { found: 0 })
    );
    let mixed = F::MixedDimensions { found: 3, expected: 2 };
    assert_eq!(
        bspline(KNOTS, "[[0,0],[1,2],[3,2,1],[4,0]]"),
        at("bspline.points[2]", mixed)
    );
    let count = F::KnotCount { found: 7, expected: 8 };
    assert_eq!(bspline("[0,0,0,0,1,1,1]", POINTS), at("bspline.knots", count));
    assert_eq!(
        bspline("[0,0,0,0,1,1,1,\"1/2\"]", POINTS),
        at("bspline.knots[7]", F::DecreasingKnots)
    );
    assert_eq!(
        bspline("[0,0,0,1,1,2,2,2]", POINTS),
        at("bspline.knots", F::EmptyDomain)
    );
    let six = "[[0,0],[1,2],[3,2],[4,0],[5,1],[6,0],[7,1],[8,8]]";
    let torn = F::InteriorMultiplicity {
        multiplicity: 4,
        degree: 3,
    };
    assert_eq!(bspline("[0,0,0,0,1,1,1,1,2,2,2,2]", six), at("bspline.knots[4]", torn));
    let end = F::EndMultiplicity {
        multiplicity: 5,
        degree: 3,
    };
    assert_eq!(bspline("[0,0,0,0,0,1,1,2,2,2,2,2]", six), at("bspline.knots[0]", end));
    let count = F::WeightCount { found: 3, expected: 4 };
    assert_eq!(weights("[1,1,1]"), at("bspline.weights", count));
    assert_eq!(weights("[1,1,0,1]"), at("bspline.weights[2]", F::NonPositiveWeight));
    assert_eq!(weights("[1,-0.1,1,1]"), at("bspline.weights[1]", F::NonPositiveWeight));

    assert_eq!(curve_refusal(&pieces("[]")), at("bezier.pieces", F::NoPieces));
    let one = F::PointCount { found: 1, expected: 2 };
    assert_eq!(
        curve_refusal(&pieces(r#"[{"points":[[0,0]]}]"#)),
        at("bezier.pieces[0].points", one)
    );
    let none = F::PointCount { found: 0, expected: 2 };
    assert_eq!(
        curve_refusal(&pieces(r#"[{"points":[]}]"#)),
        at("bezier.pieces[0].points", none)
    );
    let high: Vec<String> = (0..66).map(|i| format!("[{i},0]")).collect();
    let high = pieces(&format!("[{{\"points\":[{}]}}]", high.join(",")));
    assert_eq!(
        curve_refusal(&high),
        at("bezier.pieces[0].points", F::Degree { found: 65 })
    );
    let mixed = F::MixedDimensions { found: 3, expected: 2 };
    let two = pieces(r#"[{"points":[[0,0],[1,1]]},{"points":[[1,1,0],[2,2,0]]}]"#);
    assert_eq!(curve_refusal(&two), at("bezier.pieces[1].points", mixed));
    let two = pieces(r#"[{"points":[[0,0],[1,1]]},{"points":[[1,1],[2,2]],"weights":[1,-1]}]"#);
    assert_eq!(
        curve_refusal(&two),
        at("bezier.pieces[1].weights[1]", F::NonPositiveWeight)
    );
}

#[test]
fn absurd_sizes_are_refused_early() {
    // Five digits a denominator, all prime to each other: the least common denominator would have millions of bits.
    let mut sieve = vec![true; 100_000];
    let mut points = Vec::new();
    for n in 2..sieve.len() {
        if sieve[n] {
            (2 * n..100_000).step_by(n).for_each(|multiple| sieve[multiple] = false);
            points.push(format!("[\"1/{n}\",0]"));
        }
    }
    let knots: Vec<String> = (0..points.len() + 2).map(|k| k.to_string()).collect();
    let json = cubic(
        "1",
        &format!("[{}]", knots.join(",")),
        &format!("[{}]", points.join(",")),
        "",
    );
    let (path, fault) = curve_refusal(&json);
    assert!(path.starts_with("bspline.points["), "{path}");
    assert!(matches!(fault, CurveFault::TooManyBits { .. }), "{fault:?}");
}

#[test]
fn curves_of_long_numbers_survive_writing() {
    let big = Rational::new(Integer::ONE, Integer::from(3).pow(40_000));
    let points = RationalVector::from_rationals(&[big.clone(), -&big, fraction(1, 2), &big + fraction(1, 1)]);
    let piece = Bezier::new(2, points, None).unwrap();
    let curve = Curve::new(2, Form::Bezier(vec![piece])).unwrap();
    assert_eq!(read_curve(write_curve(&curve, None)).unwrap().curve, curve);
    let bigger = RationalVector::from_rationals(&[fraction(0, 1), &big * &big, fraction(1, 2), fraction(0, 1)]);
    let error = Bezier::new(2, bigger, None).unwrap_err();
    assert!(matches!(error.fault, CurveFault::TooManyBits { .. }));
}

#[test]
fn errors_say_what_was_found_and_expected() {
    let message = |json: &str| read_curve(json).unwrap_err().to_string();
    assert_eq!(
        message(&cubic("3", KNOTS, POINTS, ",\"weights\":[1,1,0,1]")),
        "bspline.weights[2]: found a weight that is not positive, expected a positive one"
    );
    assert_eq!(
        message(&pieces("[]")),
        "bezier.pieces: found no pieces, expected at least one"
    );
    assert_eq!(
        message(&cubic("3", "null", POINTS, "")),
        "bspline.knots: line 1 column 57: invalid type: null, expected a sequence"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn splines_survive_writing(spline in bspline(5), name in proptest::option::of(".*")) {
        let curve = Curve::from(spline);
        let file = read_curve(write_curve(&curve, name.as_deref())).unwrap();
        prop_assert_eq!(file.curve, curve);
        prop_assert_eq!(file.name, name);
    }

    #[test]
    fn chains_survive_writing(first in bezier(4), more in prop::collection::vec(bezier(4), 0..4)) {
        // Each piece is moved to where the one before ends.
        let d = first.dimension();
        let mut list = vec![first];
        for piece in more.into_iter().filter(|piece| piece.dimension() == d) {
            let before = &list[list.len() - 1];
            let end = before.point(before.degree());
            let start = piece.point(0);
            let moved: Vec<Rational> = piece.points().iter().enumerate()
                .map(|(i, x)| x - &start[i % d] + &end[i % d])
                .collect();
            let points = RationalVector::from_rationals(&moved);
            list.push(Bezier::new(d, points, piece.weights().cloned()).unwrap());
        }
        let curve = Curve::new(d, Form::Bezier(list)).unwrap();
        prop_assert_eq!(read_curve(write_curve(&curve, None)).unwrap().curve, curve);
    }

    #[test]
    fn any_bytes_are_read_without_panic(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = read_curve(&bytes).map_err(|error| error.to_string());
    }

    #[test]
    fn damaged_files_are_read_without_panic(
        spline in bspline(3),
        edits in prop::collection::vec((any::<prop::sample::Index>(), prop::sample::select(&b"0123456789-+./\"[]{},:eEnpx \\"[..])), 1..6),
    ) {
        let mut bytes = write_curve(&Curve::from(spline), Some("name")).into_bytes();
        for (index, byte) in edits {
            let index = index.index(bytes.len());
            bytes[index] = byte;
        }
        for snap_joints in [false, true] {
            let options = ReadOptions { snap_joints };
            match read_curve_with(&bytes, options) {
                // What is accepted is a curve with a chain.
                Ok(file) => prop_assert!(file.curve.chain().count() > 0),
                Err(error) => prop_assert!(!error.to_string().is_empty()),
            }
        }
    }
}
