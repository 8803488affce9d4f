//! The curve of a certificate.

use knotproof::certificate::FormatError;
use serde_json::{Value, json};

use crate::common::case::{Case, Cases};
use crate::common::document::{Certificate, exact};

fn spline(degree: Value, knots: Value, points: Value) -> Value {
    json!({ "bspline": { "degree": degree, "knots": exact(knots), "points": points.as_array().expect("points").iter().cloned().map(exact).collect::<Value>() } })
}

fn malformed(error: &FormatError) -> bool {
    matches!(error, FormatError::Malformed { .. })
}

/// Cases of the curve.
pub fn cases() -> Vec<Case> {
    let mut cases = Cases::new("curve");
    let square = || json!([[0, 0], [1, 0], [1, 1], [0, 1]]);
    let knots = || json!([0, 0, 0, 1, 2, 2, 2]);
    let good = spline(json!(2), knots(), square());
    cases.accept("spline", &Certificate::new(good.clone()));
    let refused = [
        ("degree-0", spline(json!(0), json!([0, 1, 2, 3, 4]), square())),
        ("negative-degree", spline(json!(-1), knots(), square())),
        ("fractional-degree", spline(json!(2.0), knots(), square())),
        ("degree-as-a-string", spline(json!("2"), knots(), square())),
        (
            "degree-65",
            spline(
                json!(65),
                json!((0..132).map(|i| i / 66).collect::<Vec<_>>()),
                json!((0..66).map(|i| [i, i * i]).collect::<Vec<_>>()),
            ),
        ),
        (
            "too-few-points",
            spline(json!(2), json!([0, 0, 0, 1, 1]), json!([[0, 0], [1, 0]])),
        ),
        ("too-few-knots", spline(json!(2), json!([0, 0, 0, 1, 2, 2]), square())),
        (
            "too-many-knots",
            spline(json!(2), json!([0, 0, 0, 1, 2, 2, 2, 2]), square()),
        ),
        (
            "decreasing-knots",
            spline(json!(2), json!([0, 0, 0, 3, 2, 2, 2]), square()),
        ),
        (
            "interior-multiplicity",
            spline(
                json!(2),
                json!([0, 0, 0, 1, 1, 1, 2, 2, 2]),
                json!([[0, 0], [1, 0], [1, 1], [0, 1], [2, 2], [3, 3]]),
            ),
        ),
        (
            "end-multiplicity",
            spline(json!(2), json!([0, 0, 0, 0, 2, 2, 2]), square()),
        ),
        ("empty-domain", spline(json!(2), json!([0, 0, 1, 1, 1, 2, 2]), square())),
        (
            "mixed-dimensions",
            spline(json!(2), knots(), json!([[0, 0], [1, 0], [1, 1, 1], [0, 1]])),
        ),
        ("dimension-1", spline(json!(2), knots(), json!([[0], [1], [2], [3]]))),
        (
            "dimension-4",
            spline(
                json!(2),
                knots(),
                json!([[0, 0, 0, 0], [1, 0, 0, 0], [1, 1, 0, 0], [0, 1, 0, 0]]),
            ),
        ),
        ("no-points", spline(json!(2), knots(), json!([]))),
        ("nothing", json!({})),
        ("null", Value::Null),
        (
            "both-forms",
            json!({ "bspline": good["bspline"], "bezier": { "pieces": [{ "points": [["0", "0"], ["1", "0"]] }] } }),
        ),
        ("no-pieces", json!({ "bezier": { "pieces": [] } })),
        (
            "gap-between-pieces",
            json!({ "bezier": { "pieces": [{ "points": [["0", "0"], ["1", "0"]] }, { "points": [["1", "1"], ["2", "0"]] }] } }),
        ),
        (
            "one-control-point",
            json!({ "bezier": { "pieces": [{ "points": [["0", "0"]] }] } }),
        ),
        (
            "pieces-of-different-dimension",
            json!({ "bezier": { "pieces": [{ "points": [["0", "0"], ["1", "0"]] }, { "points": [["1", "0", "0"], ["2", "0", "0"]] }] } }),
        ),
    ];
    for (name, curve) in refused {
        cases.malformed(name, Certificate::new(curve).json(), malformed);
    }
    let weights = |list: Value| {
        let mut curve = good.clone();
        curve["bspline"]["weights"] = list;
        Certificate::new(curve)
    };
    cases.accept("weights", &weights(json!(["1", "1/2", "3", "1"])));
    cases.accept("equal-weights", &weights(json!(["7", "7", "7", "7"])));
    for (name, list) in [
        ("zero-weight", json!(["1", "0", "1", "1"])),
        ("negative-weight", json!(["1", "-1", "1", "1"])),
        ("too-few-weights", json!(["1", "1", "1"])),
        ("too-many-weights", json!(["1", "1", "1", "1", "1"])),
        ("no-weights", json!([])),
    ] {
        cases.malformed(name, weights(list).json(), malformed);
    }
    // With the hash of the curve without weights, so that nothing else is wrong.
    let null = Certificate::new(good.clone()).with_field("/curve/bspline", "weights", Value::Null);
    cases.malformed("weights-null", null.json(), malformed);
    let other_form = Certificate::new(good.clone()).with_field("/curve", "bezier", Value::Null);
    cases.malformed("other-form-null", other_form.json(), malformed);
    let greatest = knotproof::number::Integer::from(2).pow(65_536);
    let with_coordinate = |x: String| {
        let mut curve = good.clone();
        curve["bspline"]["points"][1][0] = json!(x);
        Certificate::new(curve)
    };
    cases.malformed(
        "coordinate-of-65537-bits",
        with_coordinate(greatest.to_string()).json(),
        malformed,
    );
    cases.malformed(
        "denominator-of-65537-bits",
        with_coordinate(format!("1/{greatest}")).json(),
        malformed,
    );
    // Two denominators of which each is small enough, but not their least common multiple.
    let power = |base: i64, exponent: u32| format!("1/{}", knotproof::number::Integer::from(base).pow(exponent));
    let with_denominators = |two: u32, three: u32| {
        let mut curve = good.clone();
        curve["bspline"]["points"][1][0] = json!(power(2, two));
        curve["bspline"]["points"][2][1] = json!(power(3, three));
        Certificate::new(curve)
    };
    cases.accept("common-denominator-of-60000-bits", &with_denominators(30_000, 18_900));
    cases.malformed(
        "common-denominator-of-80000-bits",
        with_denominators(40_000, 25_200).json(),
        |_| true,
    );
    for (name, text) in NOT_CANONICAL {
        cases.malformed(
            &format!("coordinate-{name}"),
            with_coordinate(text.to_string()).json(),
            malformed,
        );
    }
    let number = good.clone();
    for (name, value) in [
        ("number", json!(1)),
        ("fraction-as-a-number", json!(0.5)),
        ("null", Value::Null),
        ("list", json!(["1"])),
        ("boolean", json!(true)),
    ] {
        let mut curve = number.clone();
        curve["bspline"]["points"][1][0] = value;
        cases.malformed(&format!("coordinate-{name}"), Certificate::new(curve).json(), malformed);
    }
    cases.list()
}

/// Numbers that are not in their canonical spelling.
pub const NOT_CANONICAL: [(&str, &str); 22] = [
    ("plus-sign", "+1"),
    ("leading-zero", "01"),
    ("leading-zero-of-a-denominator", "1/02"),
    ("minus-zero", "-0"),
    ("not-reduced", "2/4"),
    ("denominator-1", "3/1"),
    ("zero-over-two", "0/2"),
    ("denominator-0", "1/0"),
    ("negative-denominator", "1/-2"),
    ("two-slashes", "1/2/3"),
    ("exponent", "1e3"),
    ("decimal-point", "0.5"),
    ("hexadecimal", "0x1p0"),
    ("leading-space", " 1"),
    ("trailing-space", "1 "),
    ("empty-string", ""),
    ("minus-alone", "-"),
    ("two-signs", "--1"),
    ("infinity", "inf"),
    ("other-digits", "١"),
    ("trailing-line-feed", "1\n"),
    ("underscore", "1_000"),
];
